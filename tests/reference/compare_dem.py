#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares results of run_lammps.py and run_liggghts.py with the reference impacts:

    PYTHONPATH=build/release/python python3 compare_dem.py [--figure FILE.svg] RESULTS.csv ...

Prints the table of docs/reference_impacts.md.
"""
import argparse
import csv
from collections import defaultdict

import numpy as np
import reference_set
from reference_set import part

SLIP = ("stick first", "gross slip then stick", "gross slip")
DRAWN = ("coeff_restitution, mindlin", "coeff_restitution, mindlin_rescale/force",
         "hertz, tangential history", "hooke/history, pairs", "hooke/history, walls",
         "contact law of restitute")
GAIN = 1e-3  # of the kinetic energy; errors of the time step are below


def read_results(paths):
    """Of each (code, model) the numbers of the impacts, e_z and e_x."""
    found = defaultdict(list)
    for path in paths:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                values = int(row["impact"]), float(row["ez"]), float(row["ex"])
                found[row["code"].split()[0], row["model"]].append(values)
    return {name: np.array(rows).T for name, rows in found.items()}


class Comparison:
    """One model: the impacts that it ended, and where it is off."""

    def __init__(self, impacts, results):
        number, ez, ex = results
        ended = np.isfinite(ez)
        self.impacts = part(impacts, np.searchsorted(impacts["impact"], number[ended]))
        self.off_ez = ez[ended] - self.impacts["ez"]
        self.off_ex = ex[ended] - self.impacts["ex"]
        still = self.impacts["slip"] == "none"
        kept = reference_set.energy_ratio(self.impacts, ez[ended], np.where(still, 1, ex[ended]))
        self.gain, self.number, self.ended = kept - 1, len(ez), int(ended.sum())

    def cells(self):
        """The cells of its row in the table."""
        at = [np.nanmedian(np.abs(self.off_ex[self.impacts["slip"] == slip])) for slip in SLIP]
        gains = self.gain > GAIN
        largest = f"{100 * self.gain.max():.2g} %" if gains.any() else "-"
        ez, ex = np.abs(self.off_ez), np.abs(self.off_ex)
        numbers = (*np.quantile(ez, (0.5, 0.99)), *at, np.nanquantile(ex, 0.9), np.nanmax(ex))
        return [f"{self.ended}", *(f"{value:.2g}" for value in numbers), f"{gains.sum()}", largest]


HEADER = ("code", "model", "impacts", "e_z: median", "99 %", "e_x, stick first", "slip, then stick",
          "gross slip", "90 %", "largest", "gain energy", "by at most")


def table(comparisons):
    rows = [HEADER, ["---"] * len(HEADER)]
    rows += [[*name, *one.cells()] for name, one in comparisons.items()]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


# Colour, marker and size; told apart in grey print too.
LOOK = {"stick first": ("#440154", "o", 2), "gross slip then stick": ("#21918c", "x", 2),
        "gross slip": ("#b5b5b5", ".", 2)}


def figure(comparisons, path):
    """Errors of e_x over the angle, a panel a model."""
    import matplotlib
    from matplotlib.figure import Figure

    from restitute.plot import save
    from restitute.plot.sheet import STYLE

    with matplotlib.rc_context(STYLE | {"font.size": 8, "axes.titlesize": 9}):
        rows = -(-len(comparisons) // 3)
        sheet = Figure(figsize=(9, 2.4 * rows + 0.4), layout="constrained")
        panels = sheet.subplots(rows, 3, sharex=True, sharey=True, squeeze=False)
        for panel, ((code, model), one) in zip(panels.flat, comparisons.items()):
            for slip, (colour, marker, size) in LOOK.items():
                here = one.impacts["slip"] == slip
                panel.plot(one.impacts["angle_deg"][here], one.off_ex[here], marker, color=colour,
                           markersize=size, markeredgewidth=0.6, label=slip, rasterized=True)
            panel.set_title(f"{code}: {model}")
        for panel in panels[:, 0]:
            panel.set_ylabel("error of e$_x$")
        for panel in panels[-1]:
            panel.set_xlabel("angle of impact (degrees)")
        panels.flat[0].legend(loc="upper right", handletextpad=0.1, markerscale=1.5)
        save(panels, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", nargs="+")
    parser.add_argument("--figure")
    parser.add_argument("--input", default=reference_set.FILE)
    asked = parser.parse_args()
    impacts = reference_set.read(asked.input)
    comparisons = {name: Comparison(impacts, results)
                   for name, results in read_results(asked.results).items()}
    print(table(comparisons))
    if asked.figure:
        figure({name: one for name, one in comparisons.items() if name[1] in DRAWN}, asked.figure)


if __name__ == "__main__":
    main()
