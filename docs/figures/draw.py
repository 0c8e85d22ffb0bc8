# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/records/measurements.md and docs/sync.md: draw.py CURVES DATA FIGURES

CURVES has what `measurements` and `sync_panels` print, DATA is tests/data.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

BLUE, RED, GREY = "#1f6f8b", "#c4451c", "#888888"
plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 11,
                     "grid.color": "#dddddd"})


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def beside(computed, measured, psi_c, sign, said, path, **labels):
    """A computed curve through measured points, with the line beyond which all slips."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    x, y = np.loadtxt(computed, delimiter=",").T
    axes.plot(x, sign * y, color=BLUE, linewidth=2.5, label="restitute")
    table = np.genfromtxt(measured, delimiter=",", comments="#", skip_header=0)
    table = table[~np.isnan(table[:, 0])]  # without the line of names
    axes.plot(table[:, 0], sign * table[:, 1], "o", color=RED, markersize=5, label=said)
    axes.axvline(psi_c, color=GREY, linestyle="--", linewidth=1.5)
    for text, place, where in (("stick occurs", -6, "right"), ("slip to the end", 6, "left")):
        axes.annotate(text, (psi_c, 1), (place, -14), xycoords=("data", "axes fraction"),
                      textcoords="offset points", ha=where, color="#555555")
    axes.set(**labels)
    axes.grid()
    axes.legend(loc="lower right")
    save(figure, path)


def pieces(path):
    """Arrays of the pieces of a file that empty lines part."""
    parts = path.read_text().split("\n\n")
    return [np.loadtxt(part.splitlines(), ndmin=2) for part in parts if part.strip()]


def sync_panels(curves, path):
    """Edge and stick radius of an impact, points of collocation, times of the same angle."""
    figure, axes = plt.subplots(figsize=(7.2, 4.6), layout="constrained")
    s, edge, stick = np.loadtxt(curves / "sync_curves.dat").T
    axes.fill_between(s, stick, edge, color="#f6dfd6")
    for number, (time, radius) in enumerate(a.T for a in pieces(curves / "sync_angles.dat")):
        axes.plot(time, radius, "--", color="#999999", linewidth=1,
                  label="" if number else "same edge angle")
    axes.plot(s, edge, color="#333333", linewidth=2, label="edge A(s)")
    axes.plot(s, stick, color=RED, linewidth=2.5, label="stick radius c(s)")
    points = np.loadtxt(curves / "sync_points.dat")
    ends = points[points[:, 2] > 0]
    axes.plot(*points.T[:2], "o", color=BLUE, markersize=3, label="points of collocation")
    axes.plot(*ends.T[:2], "o", color=BLUE, markersize=7, fillstyle="none", label="ends of panels")
    axes.plot([1.245, 1.245], [0, 1.05], ":", color=GREY)
    for text, x, y, where, colour in (
            ("all stick", 0.98, 0.4, "center", BLUE), ("gross slip", 0.42, 0.3, "center", RED),
            ("slip zone", 2.0, 0.67, "center", RED), ("stick ends", 2.02, 0.04, "right", RED),
            ("slip begins", 1.05, 0.94, "right", RED), ("stick begins", 0.7, 0.86, "right", BLUE),
            ("compression", 1.22, 1.06, "right", GREY), ("restitution", 1.27, 1.06, "left", GREY),
            ("stick zone", 1.6, 0.3, "center", BLUE)):
        axes.text(x, y, text, ha=where, va="center", color=colour)
    axes.set(xlabel="time s", ylabel="radius X", xlim=(0, 3.5), ylim=(0, 1.12))
    axes.legend(loc="upper right")
    save(figure, path)


def main(curves, data, figures):
    beside(curves / "kharaz.csv", data / "kharaz_oblique.csv", 28.2, 1, "measured (Kharaz et al.)",
           figures / "kharaz.svg", xlim=(0, 90), ylim=(0.5, 1), xticks=range(0, 91, 15),
           xlabel="angle from the normal, degrees",  # psi_c: tan(angle) = 0.092 (4 chi - 1)/0.859
           ylabel=r"tangential restitution of the centre, $e_t$")
    beside(curves / "fem.csv", data / "fem_oblique.csv", 5.79, -1,
           "finite elements (Chung and Ooi)", figures / "fem.svg", xlim=(0, 19), ylim=(0, 6),
           xticks=range(0, 19, 2),
           xlabel="Vₜ / (μ Vₙ)", ylabel="−R w′ / (μ Vₙ)")  # psi_c: (4 chi - 1)/0.824
    sync_panels(curves, figures / "sync-panels.svg")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
