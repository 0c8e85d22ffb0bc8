# SPDX-License-Identifier: BSD-3-Clause
"""Restitution pairs as lines and maps, with what lies beyond the limits of the model."""
from __future__ import annotations

from types import SimpleNamespace

import matplotlib
import numpy as np

from restitute.plot.sheet import RED, STYLE, axes_of, legend, look

QUANTITIES = {"ez": "$e_z$", "ex": "$e_x$"}
# bits of restitute_result.flags: the name in a legend, the hatching of a map
LIMITS = {1: ("v / cₛ too large", "\\\\\\"), 2: ("a / R too large", "///"), 4: ("slide too long", "---"),
          8: ("unlike bodies", "|||")}
_LETTERS = {"chi": "χ", "psi": "ψ", "delta1": "δ₁", "delta2": "δ₂", "gamma": "γ", "friction": "friction μ",
            "speed_m_s": "speed v (m/s)", "angle_deg": "angle from the normal θ (degrees)",
            "time_shift": "time shift", "normal_speed_m_s": "normal speed (m/s)"}
_UNITS = {"_kg_m3": "kg/m³", "_kg_m2": "kg m²", "_rad_s": "rad/s", "_m_s": "m/s", "_pa_s": "Pa s", "_deg": "degrees",
          "_pa": "Pa", "_kg": "kg", "_hz": "Hz", "_m": "m", "_s": "s"}
MOST_CURVES, MOST_MARKS = 15, 30


def label(column: str) -> str:
    """A column as an axis names it.

    >>> from restitute import plot
    >>> plot.label("radius1_m"), plot.label("psi")
    ('radius1 (m)', 'ψ')
    """
    if column in _LETTERS:
        return _LETTERS[column]
    for ending, unit in _UNITS.items():
        if column.lower().endswith(ending):
            return f"{column[:-len(ending)].replace('_', ' ')} ({unit})"
    return column.replace("_", " ")


def _logarithmic(values):
    """Over more than two decades."""
    return np.nanmin(values) > 0 and np.nanmax(values) >= 100 * np.nanmin(values)


def mark_limits(ax, x, y, flags, total=None) -> None:
    """Cross out the points whose flags are not 0, and count them in the legend."""
    beyond = (np.asarray(flags) != 0) & np.isfinite(y)
    if beyond.any():
        count = f"{beyond.sum()} of {total or np.isfinite(y).sum()}"
        ax.plot(np.broadcast_to(x, beyond.shape)[beyond], y[beyond], linestyle="", marker="x", markersize=4.5, color=RED,
                markeredgewidth=0.9, zorder=5, label=f"beyond a limit\nof the model:\n{count}")


def shade_limits(ax, x, y, flags) -> None:
    """Shade where flags are set, one hatching a limit, over a grid of x and y."""
    for bit, (name, hatch) in LIMITS.items():
        beyond = ((np.asarray(flags) & bit) != 0).astype(float)
        if beyond.any():
            with matplotlib.rc_context(STYLE):  # the colour of hatches
                ax.contourf(x, y, beyond, levels=[0.5, 1.5], colors=[RED], alpha=0.1, zorder=1)
                ax.contourf(x, y, beyond, levels=[0.5, 1.5], colors="none", hatches=[hatch], zorder=1)
                ax.fill_between([], [], facecolor="#f5e6e6", edgecolor=STYLE["hatch.color"], linewidth=0, hatch=hatch,
                                label=name)


def lines(x, pairs, quantity="ez", *, curves=None, key="", xlabel="normal speed (m/s)", log=None, ax=None):
    """e_z or e_x over x, e.g. e_z(v). Points beyond a limit of the model are crossed out.

    Parameters
    ----------
    x : array_like, shape (n,), (n, 1) or (n, m)
    pairs
        Of `restitute.pair`: `ez`, `ex`, `flags` of shape (n,), or (n, m) for m curves. NaN leaves a gap.
    quantity : {"ez", "ex"}
    curves : sequence of m
        What the curves differ in, for the legend.
    key : str
        Title of the legend.
    log : bool
        A logarithmic axis; by default one of more than two decades.

    Returns
    -------
    ax : Axes
    """
    ax = axes_of(ax)
    y = np.asarray(getattr(pairs, quantity), float)
    x = np.asarray(x, float)
    x = np.broadcast_to(x[:, None] if x.ndim < y.ndim else x, y.shape).reshape(len(y), -1)
    flags = np.broadcast_to(getattr(pairs, "flags", 0), y.shape).reshape(x.shape)
    y = y.reshape(x.shape)
    count = y.shape[1]
    names = [""] * count if curves is None else [n if isinstance(n, str) else f"{n:.4g}" for n in np.ravel(curves)]
    for k in range(count):
        order = np.argsort(x[:, k], kind="stable")
        style = {**look(k, count), **({"marker": ""} if len(x) > MOST_MARKS else {})}
        ax.plot(x[order, k], y[order, k], label=names[k], **style)
    mark_limits(ax, x, y, flags)
    if _logarithmic(x) if log is None else log:
        ax.set_xscale("log")
    ax.set(xlabel=xlabel, ylabel=QUANTITIES[quantity])
    if quantity == "ez":
        ax.set_ylim(bottom=0)
    legend(ax, key)
    return ax


def levels_of(z, noise=1e-4):
    """5 to 13 levels at an interval of 1, 2 or 5 times a power of ten; None if z does not vary."""
    low, high = np.nanmin(z), np.nanmax(z)
    if not high - low > max(noise, 1e-4):
        return None
    power = 10 ** np.floor(np.log10((high - low) / 13))
    interval = next(f * power for f in (1, 2, 5, 10) if high - low <= 13 * f * power)
    return interval * np.arange(np.ceil(low / interval), np.floor(high / interval) + 1)


def map(x, y, pairs, quantity="ex", *, xlabel="speed (m/s)", ylabel="angle from the normal (degrees)", log=(None, None),
        noise=1e-4, ax=None):
    """e_z or e_x as contours over x and y, e.g. e_x(v, angle). What lies beyond the limits is shaded.

    Parameters
    ----------
    x : array_like, shape (n,) or (n, 1)
    y : array_like, shape (m,)
    pairs
        `ez`, `ex`, `flags` of shape (n, m).
    log : tuple of bool
        Logarithmic axes; by default those of more than two decades.
    noise : float
        Values that differ by less are the same.

    Returns
    -------
    ax : Axes
    """
    ax = axes_of(ax)
    z = np.ma.masked_invalid(np.asarray(getattr(pairs, quantity), float))
    x, y = np.broadcast_arrays(np.reshape(x, (-1, 1)).astype(float), np.reshape(y, (1, -1)).astype(float))
    for axis, values, chosen in (("x", x, log[0]), ("y", y, log[1])):
        if _logarithmic(values) if chosen is None else chosen:
            getattr(ax, f"set_{axis}scale")("log")
    ax.set(xlim=(x.min(), x.max()), ylim=(y.min(), y.max()), xlabel=xlabel, ylabel=ylabel)
    levels = levels_of(z, noise)
    if levels is None:
        text = f"restitution = {0.5 * (z.min() + z.max()):.4g} everywhere"
        ax.text(0.5, 0.5, text, ha="center", transform=ax.transAxes)
    else:
        levels[abs(levels) < 1e-9] = 0  # no "-0" on a line
        lines = ax.contour(x, y, z, levels=levels, colors="#3b518b", linewidths=np.where(levels == 0, 2.2, 1.1),
                           zorder=2)
        for text in ax.clabel(lines, fmt="%g", fontsize=8, zorder=3):
            text.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85})
    shade_limits(ax, x, y, np.broadcast_to(getattr(pairs, "flags", 0), z.shape))
    legend(ax)
    return ax


def _words(values):
    return np.asarray(values).dtype.kind not in "fiu"


def grid_axes(columns, contours: bool = False, ordered: bool = False) -> tuple:
    """Which columns are the axis and the curves of a figure of rows: the two that vary, more values along x.

    Parameters
    ----------
    columns : dict of str to array_like, shape (rows,)
    ordered : bool
        The last column that varies is x, whichever has more values.

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
    distinct = {name: len(np.unique(values)) for name, values in columns.items()}
    varying = sorted((name for name in columns if distinct[name] > 1), key=lambda name: (_words(columns[name]),
                                                                                         -distinct[name]))
    if ordered:
        varying = [name for name in reversed(columns) if distinct[name] > 1]
    varying = varying or list(columns)[:1]
    if len(varying) > 2 or not varying or (distinct[varying[0]] < 2 and len(columns[varying[0]]) != 1):
        raise ValueError(f"{'more than two' if len(varying) > 2 else 'no'} columns vary: must be one or two")
    x, curves = (*varying, None)[:2]
    if _words(columns[x]):
        raise ValueError(f"{x} has no numbers to be an axis: vary another one too")
    if contours and curves is None:
        raise ValueError("contours: needs two columns or axes that vary")
    if not contours and curves and distinct[curves] > MOST_CURVES:
        raise ValueError(f"{distinct[curves]} curves of {curves}: must be at most {MOST_CURVES}; or take contours")
    if contours:
        if _words(columns[curves]):
            raise ValueError("contours: needs two columns of numbers that vary")
        rows, nodes = len(columns[x]), distinct[x] * distinct[curves]
        different = len(set(zip(np.asarray(columns[x]).tolist(), np.asarray(columns[curves]).tolist())))
        if nodes != rows or different != rows or min(distinct[x], distinct[curves]) < 3:
            raise ValueError(f"contours: {rows} rows are no full grid of {distinct[x]} by {distinct[curves]}, each node "
                             "once and both at least 3")
    return x, curves


def grid(columns, pairs, *, axes=None, contours=False, log=(), noise=1e-4, ax=None):
    """e_z and e_x of the rows of a batch or grid, in two panels.

    Parameters
    ----------
    columns : dict of str to array_like, shape (rows,)
        By canonical name; words in a column of texts.
    pairs
        `ez`, `ex`, `flags` of shape (rows,); NaN where a row failed.
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
    x, curves = axes or grid_axes(columns, contours)
    columns = {name: np.asarray(values) for name, values in columns.items()}
    scale = [True if name in log else None for name in (x, curves)]
    distinct, of = np.unique(columns[curves], return_inverse=True) if curves else ([None], np.zeros(len(columns[x]), int))
    for panel, quantity, title in zip(ax, ("ez", "ex"), ("Normal restitution", "Tangential restitution")):
        panel.set_title(title)
        if contours:
            xs, at = np.unique(columns[x], return_inverse=True)
            full = {name: np.empty((len(xs), len(distinct))) for name in (quantity, "flags")}
            for name, values in full.items():
                values[at, of] = getattr(pairs, name)
            map(xs, distinct, SimpleNamespace(**{**full, "flags": full["flags"].astype(int)}), quantity,
                xlabel=label(x), ylabel=label(curves), log=scale, noise=noise, ax=panel)
        elif quantity == "ez" and {x, curves} == {"speed_m_s", "angle_deg"}:  # of the normal speed alone
            normal = columns["speed_m_s"] * np.cos(np.radians(columns["angle_deg"]))
            lines(normal, pairs, "ez", xlabel="normal speed v cos θ (m/s)", log=scale[x != "speed_m_s"], ax=panel)
        else:
            _curves(panel, columns[x], of, pairs, quantity, distinct, label(x), scale[0], label(curves) if curves else "")
    if ax[0].get_legend():
        ax[0].get_legend().remove()
    return ax


def _curves(ax, x, of, pairs, quantity, names, xlabel, log, key):
    """Rows as columns of one array: a curve that has fewer rows than another ends with NaN."""
    rows = [np.flatnonzero(of == k) for k in range(len(names))]
    index = np.full((max(len(r) for r in rows), len(rows)), -1)
    for k, r in enumerate(rows):
        index[:len(r), k] = r
    whole = SimpleNamespace(flags=np.where(index < 0, 0, np.asarray(pairs.flags)[index]),
                            **{quantity: np.where(index < 0, np.nan, np.asarray(getattr(pairs, quantity))[index])})
    words = None if names[0] is None else [str(n).rsplit("/", 1)[-1].split(".")[0] if _words(names) else n for n in names]
    lines(np.where(index < 0, np.nan, x[index]), whole, quantity, curves=words, key=key, xlabel=xlabel, log=log, ax=ax)
