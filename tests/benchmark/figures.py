# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the records on run time, for report.py.

No text holds a formula beside words: as SVG, most renderers would set both over each other.
"""
import textwrap

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.colors import Normalize, to_rgba  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

COLOURS = {"euler": "#0072b2", "sync": "#d55e00", "cvode": "#56b4e9", "paper-euler": "#009e73"}
OTHERS = {"refused": "#bbbbbb", "unstable": "#000000", "wrong": "#ff00ff", "too slow": "#e8e8ff"}
plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 11,
                     "axes.grid": True, "grid.color": "#dddddd", "axes.axisbelow": True})


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def precision(curves, scenes, path):
    """curves: median time, least, median and largest error of each setting of a method. A line
    through the medians, a band from the least to the largest error."""
    figure, axes = plt.subplots(figsize=(9, 5.6), layout="constrained")
    for method, points in curves.items():
        time, *errors = zip(*points)
        least, middle, largest = ([max(1e-10, e) for e in error] for error in errors)
        axes.fill_between(time, least, largest, color=COLOURS[method], alpha=0.12, linewidth=0)
        axes.loglog(time, middle, "o-", color=COLOURS[method], markersize=4, label=method)
    axes.set(title=f"Median of {scenes} scenes, band from least to largest error",
             xlabel="time of one impact (s)", ylabel="larger of the errors of e_z and e_x",
             ylim=(1e-10, 1.5))
    axes.legend(loc="lower left")
    save(figure, path)


def omissions(rows, path):
    """Bars of an omission, one a method."""
    names = list(dict.fromkeys(f"{row['left_out']}:\n" + textwrap.fill(
        f"{row['full']} / {row['lean']}", 60) for row in rows))
    figure, axes = plt.subplots(figsize=(9, 1.2 + 0.48 * len(names)), layout="constrained")
    for k, (method, colour) in enumerate(COLOURS.items()):
        ratios = [float(row["ratio"] or "nan") for row in rows if row["method"] == method]
        if ratios:
            axes.barh(np.arange(len(names)) + 0.26 * (k - 1), ratios, 0.24, color=colour,
                      edgecolor="#444444", linewidth=0.5, label=method)
    axes.axvline(1, color="#444444", linewidth=0.8)
    axes.set_yticks(range(len(names)), names, fontsize=8)
    axes.set(xscale="log", xlabel="time of the first over that of the second",
             ylim=(len(names) - 0.4, -0.6))
    axes.grid(axis="y", visible=False)
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=len(COLOURS), frameon=False)
    save(figure, path)


def stability(runs, found, scenes, methods, levels, path):
    """A panel a method (down) and number of steps (across): the error or verdict at each place of
    delta1 and gamma. Places without a run would have been too slow."""
    size, colours, norm = 2.1, plt.get_cmap("viridis"), Normalize(-8, 0)
    figure, panels = plt.subplots(len(methods), levels, sharex=True, sharey=True, squeeze=False,
                                  figsize=(size * levels + 1.5, size * len(methods) + 0.9),
                                  layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.35 / figure.get_figheight()))
    for method, line in zip(methods, panels):
        for level, axes in enumerate(line, 1):
            image = np.full((13, 13, 4), to_rgba(OTHERS["too slow"]))
            for i in np.flatnonzero((runs.method == method) & (runs.steps_asked == 10**level)):
                scene, error = scenes[runs.place[i]], max(1e-8, runs.error[i])
                colour = OTHERS.get(found[i]) or colours(norm(np.log10(error)))
                x, y = (round(np.log10(v)) + 6 for v in (scene.delta1, scene.gamma))
                image[y, x] = to_rgba(colour)
            axes.imshow(image, origin="lower", extent=(-6.5, 6.5, -6.5, 6.5))
            axes.set(xticks=range(-6, 7, 3), yticks=range(-6, 7, 3))
            axes.set_title(f"{method}, {10**level} steps", fontsize=9)
            axes.grid(visible=False)
    figure.supxlabel("log₁₀ δ₁")
    figure.supylabel("log₁₀ γ")
    figure.colorbar(plt.cm.ScalarMappable(norm, colours), ax=panels, shrink=0.6,
                    label="log₁₀ of the error of (e_z, e_x)")
    patches = [Patch(facecolor=c, edgecolor="#888888", label=name) for name, c in OTHERS.items()]
    figure.legend(handles=patches, loc="upper center", ncols=4, frameon=False)
    save(figure, path)


def differences(psi, kinds, ez, ex, names, limit, path):
    """Absolute differences over psi, a colour and a mark a kind of solid."""
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True, layout="constrained")
    for axes, difference, symbol in zip(panels, (ez, ex), ("e_z", "e_x")):
        axes.axhline(limit, color="#888888", linestyle="--", label=f"{limit:g}")
        for kind, name in enumerate(names):
            chosen = kinds == kind
            axes.loglog(psi[chosen], np.fmax(1e-8, abs(difference[chosen])), "os^v"[kind % 4],
                        markersize=3, label=name)
        axes.set(title=f"|difference in {symbol}|", xlabel="ψ", ylim=(7e-9, 1e-2))
    panels[1].legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), frameon=False)
    save(figure, path)
