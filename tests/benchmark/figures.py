# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the records on run time, for report.py."""
import math

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

COLOURS = {"euler": "#0072b2", "sync": "#d55e00", "cvode": "#56b4e9", "paper-euler": "#009e73"}
OTHERS = {"refused": "#bbbbbb", "unstable": "#000000", "wrong": "#ff00ff", "too slow": "#e8e8ff"}
plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 11, "axes.grid": True,
                     "grid.color": "#dddddd", "axes.spines.top": False, "axes.spines.right": False})


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def precision(curves, scenes, path):
    """{method: (median time, least, median, largest error) of each setting}: a line through the medians, a band from
    the least to the largest error."""
    figure, axes = plt.subplots(figsize=(9, 5.6), layout="constrained")
    for method, points in curves.items():
        time, least, middle, largest = zip(*(((p[0], *(max(1e-10, e) for e in p[1:])) for p in points)))
        axes.fill_between(time, least, largest, color=COLOURS[method], alpha=0.12, linewidth=0)
        axes.loglog(time, middle, "o-", color=COLOURS[method], linewidth=2, markersize=4, label=method)
    axes.set(title=f"Error against run time: median of {scenes} scenes, band from least to largest error", ylim=(1e-10, 1.5),
             xlabel="time of one impact (s)", ylabel=r"larger of the errors of $e_z$ and $e_x$")
    axes.legend(loc="lower left")
    save(figure, path)


def omissions(rows, methods, path):
    """A bar a method and omission."""
    rows = [row for row in rows if row["ratio"]]
    figure, axes = plt.subplots(figsize=(9, 1 + 0.26 * len(rows)), layout="constrained")
    axes.barh(range(len(rows)), [float(row["ratio"]) for row in rows], color=[COLOURS[row["method"]] for row in rows])
    axes.set_yticks(range(len(rows)), [f"{row['method']}: {row['full']} / {row['lean']}" for row in rows], fontsize=9)
    axes.set(title="What leaving out saves: time of the first over that of the second", xlabel="ratio",
             ylim=(len(rows) - 0.4, -0.6))
    axes.grid(axis="y", visible=False)
    save(figure, path)


def stability(cells, methods, steps, path):
    """A panel a method (down) and number of steps (across): colour of the error or of the verdict at each place of
    delta1 and gamma. Places without a run would have been too slow."""
    size = 2.2
    figure, panels = plt.subplots(len(methods), len(steps), figsize=(size * len(steps) + 1.5, size * len(methods) + 0.7),
                                  sharex=True, sharey=True, squeeze=False, layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.3 / figure.get_figheight()))
    colours, norm = plt.get_cmap("viridis"), Normalize(-8, 0)
    for axes, ((method, n), found) in zip(panels.flat, cells.items()):
        axes.set_facecolor(OTHERS["too slow"])
        for row, verdict in found:
            colour = OTHERS.get(verdict) or colours(norm(math.log10(max(1e-8, row["error"]))))
            axes.add_patch(plt.Rectangle((math.log10(row["scene"]["delta1"]) - 0.5, math.log10(row["scene"]["gamma"]) - 0.5),
                                         1, 1, color=colour, linewidth=0))
        axes.set(title=f"{method}, {n} steps", xlim=(-6.5, 6.5), ylim=(-6.5, 6.5), aspect="equal", xticks=range(-6, 7, 3),
                 yticks=range(-6, 7, 3))
        axes.title.set_fontsize(10)
        axes.grid(visible=False)
    for axes in panels[-1]:
        axes.set_xlabel(r"$\log_{10}\,\delta_1$")
    for axes in panels[:, 0]:
        axes.set_ylabel(r"$\log_{10}\,\gamma$")
    figure.colorbar(plt.cm.ScalarMappable(norm, colours), ax=panels, shrink=0.6,
                    label=r"$\log_{10}$ of the error of $(e_z, e_x)$")
    figure.legend(handles=[Patch(facecolor=colour, edgecolor="#888888", label=name) for name, colour in OTHERS.items()],
                  loc="upper center", ncols=len(OTHERS), frameon=False)
    save(figure, path)


def differences(psi, kinds, ez, ex, names, limit, path):
    """Absolute differences over psi, a colour a kind of solid."""
    figure, panels = plt.subplots(1, 2, figsize=(9, 4.2), sharey=True, layout="constrained")
    for axes, difference, symbol in zip(panels, (ez, ex), ("e_z", "e_x")):
        axes.axhline(limit, color="#888888", linestyle="--", label=f"{limit:g}")
        for kind, name in enumerate(names):
            chosen = kinds == kind
            axes.loglog(psi[chosen], [max(1e-8, abs(d)) for d in difference[chosen]], "o", markersize=3, label=name)
        axes.set(title=f"|difference in ${symbol}$|", xlabel=r"$\psi$", ylim=(7e-9, 1e-2))
    panels[0].legend(loc="upper left")
    save(figure, path)
