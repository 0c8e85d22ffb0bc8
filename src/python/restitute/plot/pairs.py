# SPDX-License-Identifier: BSD-3-Clause
"""Restitution pairs as lines and maps, with what lies beyond the limits of the model."""
from __future__ import annotations

import os
from typing import Any

import matplotlib
import numpy as np

from restitute.errors import DomainError
from restitute.plot.sheet import RED, STYLE, axes_of, legend, look
from restitute.values import fit_shape, one_of

QUANTITIES = {"ez": "$e_z$", "ex": "$e_x$"}
TITLES = {"ez": "Normal restitution", "ex": "Tangential restitution"}
# bits of restitute_result.flags: the name in a legend, the hatching of a map
_LIMITS = {1: ("v / cₛ too large", "\\\\\\"), 2: ("a / R too large", "///"),
           4: ("slide too long", "---"), 8: ("unlike bodies", "|||"),
           16: ("time not measured", "...")}
_LETTERS = {"chi": "χ", "psi": "ψ", "delta1": "δ₁", "delta2": "δ₂", "gamma": "γ",
            "friction": "friction μ", "speed_m_s": "speed v (m/s)",
            "angle_deg": "angle from the normal θ (degrees)"}
_UNITS = {"_kg_m3": "kg/m³", "_kg_m2": "kg m²", "_rad_s": "rad/s", "_m_s": "m/s", "_pa_s": "Pa s",
          "_deg": "degrees", "_pa": "Pa", "_kg": "kg", "_hz": "Hz", "_m": "m", "_s": "s"}
_MOST_CURVES, _MOST_MARKS = 15, 30


def label(column: str) -> str:
    """A column as an axis names it.

    >>> from restitute import plot
    >>> plot.label("radius2_m"), plot.label("psi")
    ('radius2 (m)', 'ψ')
    """
    for ending, unit in _UNITS.items():
        if column.endswith(ending) and column not in _LETTERS:
            return f"{column[:-len(ending)].replace('_', ' ')} ({unit})"
    return _LETTERS.get(column, column.replace("_", " "))


def limits_of(flags: int) -> str:
    """The limits that are passed, in words."""
    return ", ".join(name for bit, (name, _) in _LIMITS.items() if flags & bit)


def _scale(ax, axis, values, log):
    """A logarithmic axis if it is wanted, or over more than two decades."""
    low, high = np.nanmin(values), np.nanmax(values)
    if log or (log is None and 0 < low <= high / 100):
        getattr(ax, f"set_{axis}scale")("log")
    return low, high


def mark_limits(ax: Any, x: Any, y: Any, flags: Any) -> None:
    """Cross out the points whose flags are not 0, and count them in the legend."""
    beyond = (np.asarray(flags) != 0) & np.isfinite(y)
    if beyond.any():
        words = f"beyond a limit\nof the model:\n{beyond.sum()} of {np.isfinite(y).sum()}"
        ax.plot(x[beyond], y[beyond], linestyle="", marker="x", markersize=4.5, color=RED,
                markeredgewidth=0.9, zorder=5, label=words)


def shade_limits(ax: Any, x: Any, y: Any, flags: Any) -> None:
    """Shade where flags are set, one hatching a limit, over a grid as of `contour`."""
    for bit, (name, hatch) in _LIMITS.items():
        beyond = ((np.asarray(flags) & bit) != 0).astype(float)
        if beyond.any():
            with matplotlib.rc_context(STYLE):  # the colour of hatches
                ax.contourf(x, y, beyond, levels=[0.5, 1.5], colors=[RED], alpha=0.1, zorder=1)
                ax.contourf(x, y, beyond, levels=[0.5, 1.5], colors="none", hatches=[hatch],
                            zorder=1)
                ax.fill_between([], [], facecolor="#f5e6e6", edgecolor=STYLE["hatch.color"],
                                linewidth=0, hatch=hatch, label=name)


def lines(x: Any, pairs: Any, quantity: str = "ez", *, curves: Any = None, key: str = "",
          xlabel: str = "speed (m/s)", log: bool | None = None, ax: Any = None) -> Any:
    """e_z or e_x over x, e.g. e_x(v) for some angles. Points beyond a limit are crossed out.

    Parameters
    ----------
    x : array_like
        Of a shape that broadcasts to that of the pairs, e.g. what `restitute.pair` was given.
    pairs
        Of `restitute.pair`, or anything with `ez`, `ex` and `flags`; nan leaves a gap.
    quantity : {"ez", "ex"}
    curves : array_like
        Broadcasts likewise; points that are equal in it belong to one curve. Numbers or texts.
    key : str
        Title of the legend.
    log : bool
        A logarithmic axis; by default one of more than two decades.

    Returns
    -------
    ax : Axes
    """
    one_of("quantity", quantity, QUANTITIES)
    ax = axes_of(ax)
    y = np.asarray(getattr(pairs, quantity), float)
    given = {"x": x, "curves": 0 if curves is None else curves,
             "flags": getattr(pairs, "flags", 0)}
    x, of, flags = (fit_shape(*one, y.shape).ravel() for one in given.items())
    y, (names, of) = y.ravel(), np.unique(of, return_inverse=True)
    for k, name in enumerate(names):
        rows = np.flatnonzero(of.ravel() == k)
        rows = rows[np.argsort(x[rows], kind="stable")]
        text = os.path.splitext(os.path.basename(name))[0] if _words(names) else f"{name:.4g}"
        style = look(k, len(names), **({"marker": ""} if len(rows) > _MOST_MARKS else {}))
        ax.plot(x[rows], y[rows], label=None if curves is None else text, **style)
    mark_limits(ax, x, y, flags)
    _scale(ax, "x", x, log)
    ax.set(xlabel=xlabel, ylabel=QUANTITIES[quantity])
    if quantity == "ez":
        ax.set_ylim(0, 1.03 * ax.get_ylim()[1])  # marks at the top are not cut
    legend(ax, key)
    return ax


def _levels(z, noise):
    """5 to 13 levels at an interval of 1, 2 or 5 times a power of ten; none if z does not vary."""
    low, high = np.nanmin(z), np.nanmax(z)
    if not high - low > max(noise, 1e-4):
        return []
    power = 10 ** np.floor(np.log10((high - low) / 13))
    interval = next(f * power for f in (1, 2, 5, 10) if high - low <= 13 * f * power)
    return interval * (np.arange(np.ceil(low / interval), np.floor(high / interval) + 1) + 0.0)


def map(x: Any, y: Any, pairs: Any, quantity: str = "ex", *, xlabel: str = "speed (m/s)",
        ylabel: str = "angle from the normal (degrees)", log: Any = (None, None),
        noise: float = 1e-4, ax: Any = None) -> Any:
    """e_z or e_x as contours over x and y, e.g. e_x(v, angle). What is beyond a limit is shaded.

    Parameters
    ----------
    x, y : array_like
        Of shapes that broadcast to that of the pairs, which are all nodes of a grid.
    pairs, quantity
        As in `lines`.
    log : pair of bool
        Logarithmic axes; by default those of more than two decades.
    noise : float
        Values that differ by less are the same.

    Returns
    -------
    ax : Axes
    """
    one_of("quantity", quantity, QUANTITIES)
    ax = axes_of(ax)
    z = np.asarray(getattr(pairs, quantity), float)
    (x, i), (y, j) = (np.unique(fit_shape(name, values, z.shape), return_inverse=True)
                      for name, values in (("x", x), ("y", y)))
    shape, nodes = (len(y), len(x)), (j.ravel(), i.ravel())
    different = len(np.unique(nodes[0] * len(x) + nodes[1]))
    if min(shape) < 2 or different < z.size or 2 * different < len(x) * len(y):
        raise DomainError(f"map: {z.size} pairs are no grid of {len(x)} values of x by {len(y)} of "
                          "y, each node at most once, few missing and both at least 2")
    full, flags = np.full(shape, np.nan), np.zeros(shape, int)
    full[nodes] = z.ravel()
    flags[nodes] = fit_shape("flags", getattr(pairs, "flags", 0), z.shape).ravel()
    ax.set(xlim=_scale(ax, "x", x, log[0]), ylim=_scale(ax, "y", y, log[1]), xlabel=xlabel,
           ylabel=ylabel)
    levels = _levels(full, noise)
    if len(levels):
        drawn = ax.contour(x, y, np.ma.masked_invalid(full), levels=levels, colors="#3b518b",
                           linewidths=np.where(levels == 0, 2.2, 1.1), zorder=2)
        for text in ax.clabel(drawn, fmt="%g", fontsize=8, zorder=3):
            text.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85})
    else:
        ax.text(0.5, 0.5, f"restitution = {np.nanmean(full):.4g} everywhere", ha="center",
                transform=ax.transAxes)
    shade_limits(ax, x, y, flags)
    legend(ax)
    return ax


def _words(values):
    return np.asarray(values).dtype.kind not in "fiu"


def grid_axes(columns: dict, contours: bool = False, ordered: bool = False) -> tuple:
    """Which columns are the axis and the curves of a figure of rows: those two that vary.

    Parameters
    ----------
    columns : dict of str to array_like, shape (rows,)
    contours : bool
        The curves are the second axis.
    ordered : bool
        The last column is the axis and the first one the curves, whichever has more values.

    Returns
    -------
    x, curves : str, and str or None

    Raises
    ------
    ValueError
        No figure can be made; the text says why.

    >>> from restitute import plot
    >>> plot.grid_axes({"psi": [1, 2, 3], "gamma": [1, 1, 1]})
    ('psi', None)
    """
    count = {name: len(np.unique(values)) for name, values in columns.items()}
    varying = list(columns)[::-1] if ordered else [name for name in columns if count[name] > 1]
    if len(varying) not in (1, 2):
        raise ValueError(f"{'more than two' if varying else 'no'} columns vary: must be one or two")
    if not ordered:
        varying.sort(key=lambda name: (_words(columns[name]), -count[name]))
    x, curves = (*varying, None)[:2]
    if _words(columns[x]):
        raise ValueError(f"{x} has no numbers to be an axis: vary another one too")
    if curves is None and contours:
        raise ValueError("contours: needs two columns or axes that vary")
    if curves and not contours and count[curves] > _MOST_CURVES:
        raise ValueError(f"{count[curves]} curves of {curves}: must be at most {_MOST_CURVES}; or "
                         "take contours")
    if contours:
        if _words(columns[curves]):
            raise ValueError("contours: needs two columns of numbers that vary")
        rows, n, m = len(columns[x]), count[x], count[curves]
        nodes = set(zip(*(np.asarray(columns[name]).tolist() for name in (x, curves))))
        if min(n, m) < 3 or n * m != rows or len(nodes) != rows:
            raise ValueError(f"contours: {rows} rows are no full grid of {n} by {m}, each node "
                             "once and both at least 3")
    return x, curves


def grid(columns: dict, pairs: Any, *, axes: Any = None, contours: bool = False, log: Any = (),
         noise: float = 1e-4, ax: Any = None) -> Any:
    """e_z and e_x of the rows of a batch or grid, in two panels.

    Parameters
    ----------
    columns : dict of str to array_like, shape (rows,)
        By canonical name; numbers or texts.
    pairs
        `ez`, `ex`, `flags` of shape (rows,); nan where a row failed.
    axes : tuple
        The column along x and that of the curves, or None; by default from `grid_axes`.
    contours : bool
        Contours over both columns.
    log : collection of str
        Columns whose axis is logarithmic; others are if they span more than two decades.
    noise : float
        Values that differ by less are the same.

    Returns
    -------
    ax : ndarray of two Axes
    """
    ax = axes_of(ax, 2)
    columns = {name: np.asarray(values) for name, values in columns.items()}
    x, curves = axes or grid_axes(columns, contours)
    scale = [True if name in log else None for name in (x, curves)]
    for panel, (quantity, title) in zip(ax, TITLES.items()):
        if contours:
            map(columns[x], columns[curves], pairs, quantity, xlabel=label(x),
                ylabel=label(curves), log=scale, noise=noise, ax=panel)
        elif quantity == "ez" and {x, curves} == {"speed_m_s", "angle_deg"}:
            normal = columns["speed_m_s"] * np.cos(np.radians(columns["angle_deg"]))
            lines(normal, pairs, "ez", xlabel="normal speed v cos θ (m/s)", ax=panel,
                  log=scale[x != "speed_m_s"])
        else:
            lines(columns[x], pairs, quantity, curves=columns.get(curves),
                  key=label(curves) if curves else "", xlabel=label(x), log=scale[0], ax=panel)
        panel.set_title(title)
    if ax[0].get_legend():
        ax[0].get_legend().remove()
    return ax
