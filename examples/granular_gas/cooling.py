# SPDX-License-Identifier: BSD-3-Clause
"""Cooling of five gases, from the table that granular_gas writes: cooling.py TABLE.csv FIGURE"""
import csv
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402

LABELS = ("constant restitution 0.8", "Kelvin-Voigt, no friction", "Kelvin-Voigt, friction 0.3",
          "standard solid, no friction", "polyisobutylene, friction 0.3")
COLOURS = ("#888888", "#1f6f8b", "#c4451c", "#5b8c2a", "#7a4fa3")
DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (9, 2, 3, 2)))  # for grey print


def courses(path):
    """Columns of each gas, in the order of the file."""
    gases = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(line for line in file if line.strip() and line[0] != "#"):
            numbers = {name: float(value) for name, value in row.items() if name != "gas"}
            for name, value in numbers.items():
                gases.setdefault(row["gas"], {}).setdefault(name, []).append(value)
    return list(gases.values())


def main(table, figure):
    plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "axes.grid": True,
                         "grid.color": "#dddddd"})
    sheet, (left, right) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
    for gas, label, colour, dash in zip(courses(table), LABELS, COLOURS, DASHES):
        left.loglog(gas["time"], gas["T"], color=colour, linestyle=dash, linewidth=2.5)
        left.loglog(gas["time"], gas["T_theory"], ":", color="black", linewidth=1, alpha=0.8)
        right.semilogx(gas["time"], gas["exponent"], color=colour, linestyle=dash, linewidth=2.5,
                       label=label)
    left.plot([], [], ":", color="black", label="theory, Maxwell's velocities")
    left.set(ylabel="temperature T / T₀")
    right.set(ylabel="p, where T falls as 1 / time to the power p", ylim=(0, 2.6), xlim=(10, None),
              yticks=(0, 0.5, 1, 1.5, 5 / 3, 2, 2.5),
              yticklabels=("0", "0.5", "1", "1.5", "5/3", "2", "2.5"))
    for axes, place in ((left, "lower left"), (right, "lower right")):
        axes.set_xlabel("time, mean free paths over the first rms speed")
        axes.legend(loc=place, handlelength=3.6)
    sheet.savefig(figure, metadata={"Date": None} if figure.endswith(".svg") else {})


if __name__ == "__main__":
    main(*sys.argv[1:])
