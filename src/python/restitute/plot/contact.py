# SPDX-License-Identifier: BSD-3-Clause
"""Histories, tables, fits, moduli and costs."""
from __future__ import annotations

from typing import Any

import numpy as np

from restitute.plot.pairs import TITLES, limits_of, map, shade_limits
from restitute.plot.sheet import RED, axes_of, legend, look

# what a panel shows, two arrays, the unit, the label of dimensionless ones
_PANELS = (("Forces", "normal_force", "tangential_force", "N", "force / F₀ and μF₀"),
           ("Contact and stick radius", "contact_radius", "stick_radius", "m", "radius / aₑₗ"),
           ("Velocities", "normal_velocity", "tangential_velocity", "m/s", "velocity / v₀ and V₀"))
_PREFIXES = {1e-9: "n", 1e-6: "μ", 1e-3: "m", 1.0: "", 1e3: "k", 1e6: "M"}
_SPEED, _ANGLE = "normal speed (m/s)", "angle from the normal (degrees)"


def _prefix(values, unit):
    """The largest prefix that leaves the largest value above 0.1."""
    largest = np.nanmax(np.abs(values))
    factor = max((f for f in _PREFIXES if largest >= 0.1 * f), default=1e-9)
    return factor, _PREFIXES[factor] + unit


def history(history: Any, *, dimensionless: bool | None = None, ax: Any = None) -> Any:
    """Forces, contact and stick radius, and velocities over the time of an impact, in three panels.

    Parameters
    ----------
    history
        Of `restitute.history`: arrays of shape (n,) named as in `restitute_history`.
    dimensionless : bool
        In units of the paper; by default as the impact of the history was given.

    Returns
    -------
    ax : ndarray of three Axes
    """
    ax = axes_of(ax, 3)
    if dimensionless is None:
        dimensionless = history.result.of_the_paper
    scale, unit = (1.0, "T") if dimensionless else _prefix(history.time, "s")
    for panel, (title, first, second, si, plain) in zip(ax, _PANELS):
        values = {name: np.asarray(getattr(history, name)) for name in (first, second)}
        factor, named = (1.0, "") if dimensionless else _prefix(values[first], si)
        for k, (name, value) in enumerate(values.items()):
            panel.plot(np.asarray(history.time) / scale, value / factor, label=name.split("_")[0],
                       **look(2 * k, 4, marker=""))
        panel.axhline(0, color="#444444", linewidth=0.8)
        panel.set(title=title, xlabel=f"time ({unit})",
                  ylabel=plain if dimensionless else f"{first.split('_')[1]} ({named})")
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2, frameon=False)
    beyond = limits_of(history.result.flags)
    if beyond:
        ax[0].annotate(f"beyond the limits of the model: {beyond}", (0, -0.3), color=RED,
                       xycoords="axes fraction")
    return ax


def table(table: Any, *, ax: Any = None) -> Any:
    """e_z over the normal speed, and e_x over it and the angle, as a `restitute.Table` has them.

    Returns
    -------
    ax : ndarray of two Axes
    """
    ax = axes_of(ax, 2)
    low, high = table.speed
    speed, angle = np.geomspace(low, high, 161)[:, None], np.linspace(0, 86, 44)
    pairs = table.pair(speed, speed * np.tan(np.radians(angle)), check=False)
    ax[0].plot(speed, pairs.ez[:, 0], **look(0, 1, marker=""))
    shade_limits(ax[0], speed[:, 0], [0, 1], np.stack([pairs.flags[:, 0]] * 2))
    ax[0].set(title=TITLES["ez"], xscale="log", xlim=(low, high), ylim=(0, 1), xlabel=_SPEED,
              ylabel="$e_z$")
    map(speed, angle, pairs, "ex", xlabel=_SPEED, ylabel=_ANGLE, log=(True, False), ax=ax[1])
    ax[1].set_title(TITLES["ex"])
    return ax


def fit(fit: Any, *, ax: Any = None) -> Any:
    """Data as points and a fit as lines, and the residuals, in two panels.

    Parameters
    ----------
    fit : restitute.fits.DropFit or DmaFit

    Returns
    -------
    ax : ndarray of two Axes
    """
    ax, curves = axes_of(ax, 2), fit.curves()
    dma = "storage" in curves
    for k, (name, columns) in enumerate(curves.items()):
        known = np.argsort(columns[0], kind="stable")
        x, measured, fitted = (one[known[~np.isnan(columns[1][known])]] for one in columns)
        if not x.size:
            continue
        relative, points = name not in TITLES, look(k, len(curves), linestyle="")
        if dma or not relative:
            ax[0].plot(x, measured, **points)
            ax[0].plot(x, fitted, **look(k, len(curves), marker=""))
        rest = measured / fitted - 1 if relative else measured - fitted
        words = f"{name.replace('_', ' ')}{' (relative)' if relative and not dma else ''}"
        ax[1].plot(x, rest, label=words, **points)
    ax[1].axhline(0, color="#444444", linewidth=0.8)
    if not dma and fit.flags & 8:  # RESTITUTE_FIT_FLAG_LIMITS
        ax[1].plot([], [], "x", color=RED, label="some impacts are\nbeyond a limit\nof the model")
    xlabel = "frequency × shift (Hz)" if dma else _SPEED
    low, high = ax[1].dataLim.intervalx  # on a short logarithmic axis numbers run into each other
    xscale = "log" if dma or high > 5 * low else "linear"
    ax[0].set(title="data (points) and fit (lines)", xscale=xscale, xlabel=xlabel,
              yscale="log" if dma else "linear",
              ylabel="shear moduli (Pa)" if dma else "restitution")
    ax[1].set(title="residuals", xscale=xscale, xlabel=xlabel,
              ylabel="measured / fitted − 1" if dma else "measured − fitted")
    legend(ax[1])
    return ax


def _loglog(curves, xlabel, ylabel, ax, marker):
    ax = axes_of(ax)
    for k, (name, (x, y)) in enumerate(curves.items()):
        style = look(k, len(curves)) if marker else look(k, len(curves), marker="")
        ax.loglog(x, y, label=name, **style)
    ax.set(xlabel=xlabel, ylabel=ylabel)
    legend(ax)
    return ax


def relaxation(material: Any, time: Any, *, ax: Any = None) -> Any:
    """The relaxation modulus of a material over the time (s), shape (n,). Returns the axes."""
    curves = {material.name or "G(t)": (time, material.relaxation_modulus(time))}
    return _loglog(curves, "time (s)", "relaxation modulus (Pa)", ax, False)


def moduli(material: Any, frequency: Any, *, ax: Any = None) -> Any:
    """Storage and loss modulus over the angular frequency (rad/s), shape (n,). Returns the axes."""
    curves = {"storage G′": (frequency, material.storage_modulus(frequency)),
              "loss G″": (frequency, material.loss_modulus(frequency))}
    return _loglog(curves, "angular frequency (rad/s)", "modulus (Pa)", ax, False)


def work(runs: dict, *, xlabel: str = "error", ylabel: str = "time (s)", ax: Any = None) -> Any:
    """Cost against error: which method is the cheapest at an accuracy.

    Parameters
    ----------
    runs : dict of str to (error, cost)
        By method; arrays of shape (n,).

    Returns
    -------
    ax : Axes
    """
    return _loglog(runs, xlabel, ylabel, ax, True)
