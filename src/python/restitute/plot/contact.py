# SPDX-License-Identifier: BSD-3-Clause
"""Histories, tables, fits, moduli and costs."""
from __future__ import annotations

import numpy as np

from restitute.plot.pairs import map, shade_limits
from restitute.plot.sheet import axes_of, legend, look

_PANELS = (("Forces", "normal_force", "tangential_force", "N", "force / F₀ and μF₀"),
           ("Contact and stick radius", "contact_radius", "stick_radius", "m", "radius / aₑₗ"),
           ("Velocities", "normal_velocity", "tangential_velocity", "m/s", "velocity / v₀ and V₀"))
_PREFIXES = {1e-9: "n", 1e-6: "μ", 1e-3: "m", 1.0: "", 1e3: "k", 1e6: "M"}


def _prefix(values, unit):
    """The largest prefix that leaves the largest value above 0.1."""
    largest = np.nanmax(np.abs(values))
    factor = max((f for f in _PREFIXES if largest >= 0.1 * f), default=1e-9)
    return factor, _PREFIXES[factor] + unit


def history(history, *, dimensionless=None, ax=None):
    """Forces, contact and stick radius, and velocities over the time of one impact, in three panels.

    Parameters
    ----------
    history
        Of `restitute.history`: arrays of shape (n,) named as in `restitute_history`.
    dimensionless : bool
        In units of the paper; by default what the history says, else SI units.

    Returns
    -------
    ax : ndarray of three Axes
    """
    ax = axes_of(ax, 3)
    if dimensionless is None:
        dimensionless = getattr(history, "dimensionless", False)
    time = np.asarray(history.time)
    scale, unit = (1.0, "T") if dimensionless else _prefix(time, "s")
    for panel, (title, first, second, si, plain) in zip(ax, _PANELS):
        values = [np.asarray(getattr(history, name)) for name in (first, second)]
        factor, named = (1.0, plain) if dimensionless else _prefix(values[0], si)
        for k, (name, value) in enumerate(zip((first, second), values)):
            style = {**look(2 * k + 1, 5), "marker": ""}
            panel.plot(time / scale, value / factor, label=name.split("_")[0], **style)
        panel.axhline(0, color="#444444", linewidth=0.8)
        kind = first.split("_")[1]
        panel.set(title=title, xlabel=f"time ({unit})", ylabel=named if dimensionless else f"{kind} ({named})")
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2, frameon=False)
    return ax


def table(table, *, ax=None):
    """e_z over the normal speed and e_x over normal speed and angle, as a table of a contact gives them, in two panels.

    Parameters
    ----------
    table : restitute.Table

    Returns
    -------
    ax : ndarray of two Axes
    """
    ax = axes_of(ax, 2)
    low, high = table.speed
    speed, angle = np.geomspace(low, high, 81)[:, None], np.linspace(0, 86, 44)
    pairs = table.pair(speed, speed * np.tan(np.radians(angle)), check=False)
    straight = table.pair(speed[:, 0], 0.0, check=False)
    ax[0].plot(speed, straight.ez, **{**look(0, 1), "marker": ""})
    shade_limits(ax[0], speed * [1, 1], np.ones_like(speed) * [0, 1], straight.flags[:, None] * np.array([1, 1]))
    ax[0].set(title="Normal restitution", xscale="log", xlim=(low, high), ylim=(0, 1), xlabel="normal speed (m/s)",
              ylabel="$e_z$")
    map(speed, angle, pairs, "ex", xlabel="normal speed (m/s)", ylabel="angle to the normal (degrees)", log=(True, False),
        ax=ax[1])
    ax[1].set_title("Tangential restitution")
    return ax


def fit(series, *, dma=False, ax=None):
    """Data as points and a fit as lines, and the residuals, in two panels.

    Parameters
    ----------
    series : dict of str to (x, measured, fitted)
        By quantity, "ez", "ex", "time", or "storage", "loss"; arrays of shape (n,), NaN where nothing was measured. x is
        the normal speed in m/s, or the frequency in Hz. What is neither a coefficient nor a modulus has residuals only.
    dma : bool
        Moduli over the frequency, with relative residuals.

    Returns
    -------
    ax : ndarray of two Axes
    """
    ax = axes_of(ax, 2)
    for k, (name, arrays) in enumerate(series.items()):
        x, measured, fitted = (np.asarray(values, float)[np.argsort(arrays[0])] for values in arrays)
        known = ~np.isnan(measured)
        if not known.any():
            continue
        x, measured, fitted = x[known], measured[known], fitted[known]
        style = look(k, len(series))
        relative = dma or name not in ("ez", "ex")
        if dma or not relative:
            ax[0].plot(x, measured, **{**style, "linestyle": ""})
            ax[0].plot(x, fitted, **{**style, "marker": ""})
        rest = measured / fitted - 1 if relative else measured - fitted
        ax[1].plot(x, rest, label=f"{name} (relative)" if relative and not dma else name, **{**style, "linestyle": ""})
    ax[1].axhline(0, color="#444444", linewidth=0.8)
    xlabel = "frequency × shift (Hz)" if dma else "normal speed (m/s)"
    ax[0].set(title="data (points) and fit (lines)", xscale="log", xlabel=xlabel, yscale="log" if dma else "linear",
              ylabel="shear moduli (Pa)" if dma else "restitution")
    ax[1].set(title="residuals", xscale="log", xlabel=xlabel, ylabel="measured / fitted − 1" if dma else "measured − fitted")
    legend(ax[1])
    return ax


def relaxation(material, time, *, ax=None):
    """The relaxation modulus G(t) of a material over the time (s), shape (n,); returns the axes."""
    ax = axes_of(ax)
    ax.loglog(time, material.relaxation_modulus(time), label=material.name, **{**look(0, 1), "marker": ""})
    ax.set(xlabel="time (s)", ylabel="G(t) (Pa)")
    return ax


def moduli(material, frequency, *, ax=None):
    """Storage and loss modulus of a material over the angular frequency (rad/s), shape (n,); returns the axes."""
    ax = axes_of(ax)
    for k, (name, values) in enumerate((("storage G′", material.storage_modulus(frequency)),
                                        ("loss G″", material.loss_modulus(frequency)))):
        ax.loglog(frequency, values, label=name, **{**look(k, 2), "marker": ""})
    ax.set(xlabel="angular frequency (rad/s)", ylabel="modulus (Pa)")
    legend(ax)
    return ax


def work(runs, *, ylabel="time (s)", xlabel="error", ax=None):
    """Cost against error: which method is the cheapest at an accuracy.

    Parameters
    ----------
    runs : dict of str to (error, cost)
        By method; arrays of shape (n,).

    Returns
    -------
    ax : Axes
    """
    ax = axes_of(ax)
    for k, (name, (error, cost)) in enumerate(runs.items()):
        ax.loglog(error, cost, label=name, **look(k, len(runs)))
    ax.set(xlabel=xlabel, ylabel=ylabel)
    legend(ax)
    return ax
