# SPDX-License-Identifier: BSD-3-Clause
"""Where the energy of the spheres goes: soft_sphere.py [TABLE.csv [FIGURE]]"""
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

PARTS = {"potential_J": ("of height", "#3f3f3f"), "kinetic_J": ("of motion", "#f0c060"),
         "stored_J": ("stored in contacts", "#5b8db8"),
         "friction_J": ("lost to friction", "#a6a6a6"),
         "viscous_J": ("lost in dashpots", "#d9d9d9")}


def main(table="soft_sphere.csv", figure="soft_sphere.svg"):
    energy = np.genfromtxt(table, delimiter=",", names=True)
    labels, colours = zip(*PARTS.values())
    plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none"})
    sheet, axes = plt.subplots(figsize=(7.2, 4.2), layout="constrained")
    millijoules = [1e3 * energy[name] for name in PARTS]
    axes.stackplot(energy["time_s"], *millijoules, labels=labels, colors=colours)
    axes.set(xlabel="time (s)", ylabel="energy (mJ)", title="Rubber spheres drop into a box",
             ylim=0, xlim=energy["time_s"][[0, -1]])
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    sheet.savefig(figure, metadata={"Date": None} if figure.endswith(".svg") else {})


if __name__ == "__main__":
    main(*sys.argv[1:])
