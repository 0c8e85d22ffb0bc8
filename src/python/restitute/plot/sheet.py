# SPDX-License-Identifier: BSD-3-Clause
"""How figures look, and how they become files that are the same every time."""
from __future__ import annotations

import io
import os
import textwrap
import warnings

import matplotlib
import numpy as np
from matplotlib import cm
from matplotlib.figure import Figure

# Text stays text in SVG; a fixed salt gives the same identifiers every time.
STYLE = {"svg.fonttype": "none", "svg.hashsalt": "restitute", "pdf.fonttype": 42, "font.family": "DejaVu Sans",
         "mathtext.fontset": "dejavusans", "font.size": 10, "axes.titlesize": 11, "axes.spines.top": False,
         "axes.spines.right": False, "axes.edgecolor": "#444444", "axes.grid": True, "grid.color": "#dddddd",
         "grid.linewidth": 0.6, "legend.frameon": False, "lines.linewidth": 1.5, "hatch.linewidth": 0.6, "hatch.color": "#cf9f9f",
         "text.usetex": False, "figure.dpi": 100, "savefig.dpi": 150}
_METADATA = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}
DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (6, 2, 1.5, 2, 1.5, 2)))
MARKS = "os^vDPX"
RED = "#b03030"


def look(index: int, count: int) -> dict:
    """Colour, dashes and mark of curve `index` of `count`, told apart in grey print too: keywords of `plot`."""
    return {"color": matplotlib.colors.to_hex(cm.viridis(0.85 * index / max(count - 1, 1))),
            "linestyle": DASHES[index % len(DASHES)], "marker": MARKS[index % len(MARKS)], "markersize": 3.5,
            "markerfacecolor": "none", "markeredgewidth": 0.9}


def _plain(text):
    """A text that is no formula, whatever is in it."""
    return "".join(c if c.isprintable() else " " for c in text).replace("$", r"\$")


def sheet(panels: int = 1, title: str = "", note: str = "", origin: str = "", *, shown: bool = False):
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
        top.text(0, 0, "\n".join(lines), size=9.5, va="bottom", color="#555555", transform=top.transAxes)
        axes = np.array([figure.add_subplot(cells[1, i]) for i in range(panels)])
    return axes[0] if panels == 1 else axes


def axes_of(ax, panels=1):
    """The axes that are given, or those of a new sheet."""
    if ax is None:
        return sheet(panels, shown=True)
    if panels > 1 and np.size(ax) != panels:
        raise ValueError(f"ax: {np.size(ax)} axes are given, must be {panels}")
    return np.ravel(ax) if panels > 1 else ax


def legend(ax, title="") -> None:
    """The legend right of the axes, where no data are."""
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        ax.legend(handles, labels, loc="upper left", bbox_to_anchor=(1.01, 1.02), borderaxespad=0, title=title or None,
                  fontsize=9 if len(labels) < 12 else 7.5, alignment="left", frameon=False)


def save(ax, file, format: str | None = None) -> None:
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
        raise ValueError(f"{os.fspath(file)}: must end in .svg, .png or .pdf")
    whole = io.BytesIO()
    with matplotlib.rc_context(STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # a name may have letters that the font lacks
        figure.savefig(whole, format=format, metadata=_METADATA[format], bbox_inches="tight", pad_inches=0.08)
    if hasattr(file, "write"):
        file.write(whole.getvalue())
        return
    with open(file, "wb") as stream:
        stream.write(whole.getvalue())
