# SPDX-License-Identifier: BSD-3-Clause
"""How figures look, and how they become files that are the same every time."""
from __future__ import annotations

import io
import os
import textwrap
import warnings
from typing import Any

import matplotlib
import numpy as np
from matplotlib import cm
from matplotlib.figure import Figure

RED = "#b03030"  # limits, and what is beyond them
# Text stays text in SVG; a fixed salt gives the same identifiers every time.
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "restitute", "pdf.fonttype": 42,
         "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans", "text.usetex": False,
         "font.size": 10, "axes.titlesize": 11, "legend.fontsize": 9, "legend.frameon": False,
         "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "#444444",
         "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6,
         "hatch.linewidth": 0.6, "hatch.color": "#cf9f9f", "savefig.dpi": 150}
_METADATA: dict = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}
_DASHES: tuple = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (6, 2, 1.5, 2, 1.5, 2)))
_MARKS = "os^vDPX"


def look(index: int, count: int, **more: Any) -> dict:
    """Keywords of `plot` for curve `index` of `count`, told apart in grey print too.

    >>> from restitute import plot
    >>> plot.look(1, 3, marker="")["color"]
    '#277e8e'
    """
    colour = matplotlib.colors.to_hex(cm.viridis(0.85 * index / max(count - 1, 1)))
    return {"color": colour, "linestyle": _DASHES[index % len(_DASHES)], "markersize": 3.5,
            "marker": _MARKS[index % len(_MARKS)], "markerfacecolor": "none", **more}


def _plain(text):
    """A text that is no formula, whatever is in it."""
    return "".join(c if c.isprintable() else " " for c in text).replace("$", r"\$")


def sheet(panels: int = 1, title: str = "", note: str = "", origin: str = "", *,
          shown: bool = False) -> Any:
    """A sheet with panels side by side, for `save`.

    Parameters
    ----------
    title, note, origin : str
        What it shows, given what, made how.
    shown : bool
        A figure of pyplot, which a notebook or `show` displays; else none that a window belongs to.

    Returns
    -------
    ax : Axes, or ndarray of Axes for several panels

    >>> from restitute import plot
    >>> ax = plot.sheet(title="Steel on rubber", note="friction 0.3")
    """
    lines = textwrap.wrap(_plain(note), 62 * panels) + [_plain(origin)] * bool(origin)
    head = 0.24 * bool(title) + 0.2 * len(lines) + 0.08
    size = ({1: 7.4, 2: 10.8}.get(panels, 4.5 * panels), 4.2 + head)
    with matplotlib.rc_context(STYLE):
        if shown:
            from matplotlib import pyplot

            figure = pyplot.figure(figsize=size, layout="constrained")
        else:
            figure = Figure(figsize=size, layout="constrained")
        cells = figure.add_gridspec(2, panels, height_ratios=[head, 4.2])
        top = figure.add_subplot(cells[0, :])
        top.axis("off")
        top.text(0, 1, _plain(title), size=13, va="top", transform=top.transAxes)
        top.text(0, 0, "\n".join(lines), size=9, color="#555555", transform=top.transAxes)
        axes = np.array([figure.add_subplot(cells[1, i]) for i in range(panels)])
    return axes[0] if panels == 1 else axes


def axes_of(ax: Any, panels: int = 1) -> Any:
    """The axes that are given, or those of a new sheet."""
    if ax is None:
        return sheet(panels, shown=True)
    if np.size(ax) != panels:
        raise ValueError(f"ax: {np.size(ax)} axes are given, must be {panels}")
    return np.ravel(ax) if panels > 1 else ax


def legend(ax: Any, title: str = "") -> None:
    """The legend right of the axes, where no data are."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), borderaxespad=0,
                  title=title or None, frameon=False)


def save(ax: Any, file: Any, format: str | None = None) -> None:
    """Write the figure of these axes; the same figure gives the same bytes.

    Parameters
    ----------
    ax : Axes, array of Axes or Figure
    file : path or binary stream
        A path ends in .svg, .png or .pdf.
    format : str
        "svg", "png" or "pdf"; of a stream.

    Raises
    ------
    ValueError
        The ending is another one.
    """
    figure = ax if isinstance(ax, Figure) else np.ravel(ax)[0].figure
    format = format or os.path.splitext(os.fspath(file))[1][1:].lower()
    if format not in _METADATA:
        raise ValueError(f"{file}: must end in .svg, .png or .pdf")
    whole = io.BytesIO()
    with matplotlib.rc_context(STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # a name may have letters that the font lacks
        figure.savefig(whole, format=format, metadata=_METADATA[format], bbox_inches="tight")
    if hasattr(file, "write"):
        file.write(whole.getvalue())
    else:
        with open(file, "wb") as stream:
            stream.write(whole.getvalue())
