# SPDX-License-Identifier: BSD-3-Clause
"""Drawings of boxes and arrows:  boxes.py FIGURES

which_method.svg of docs/which_method.md and house.svg of CONTRIBUTING.md.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 10})
ASK, ANSWER, OTHER = "#fdf1ea", "#e3f0f4", "#f2f2f2"


class Drawing:
    """Boxes on a canvas; a box is (left, right, bottom, top)."""

    def __init__(self, width, height):
        self.figure, self.axes = plt.subplots(figsize=(width, height))
        self.figure.subplots_adjust(0, 0, 1, 1)
        self.axes.set(xlim=(0, width), ylim=(0, height))
        self.axes.axis("off")

    def box(self, left, top, width, text, colour, height=0.62):
        """A box with a title, the first line, in bold, and more lines."""
        self.axes.add_patch(plt.Rectangle((left, top - height), width, height, facecolor=colour,
                                          edgecolor="#555555", linewidth=1))
        title, *more = text.split("\n")
        lines = [(title, "bold"), *((line, "normal") for line in more)]
        for number, (line, weight) in enumerate(lines):
            y = top - height * (number + 1) / (len(lines) + 1)
            self.axes.text(left + width / 2, y, line, ha="center", va="center", weight=weight)
        return left, left + width, top - height, top

    def arrow(self, begin, end):
        """From one place to another."""
        self.axes.annotate("", end, begin, arrowprops={"arrowstyle": "-|>", "color": "#555555"})

    def across(self, one, other):
        """From the right side of a box to the left side of another."""
        self.arrow((one[1], (one[2] + one[3]) / 2), (other[0], (other[2] + other[3]) / 2))

    def down(self, one, other):
        """From the bottom of a box to the top of another, straight where that is possible."""
        left, right = max(one[0], other[0]), min(one[1], other[1])
        x = (left + right) / 2
        self.arrow((x, one[2]), (x, other[3]))

    def save(self, path):
        self.figure.savefig(path, metadata={"Date": None})
        plt.close(self.figure)


QUESTIONS = (
    ("single impacts, maps, fits\nnumbers for a paper",
     (("euler (default)\nerror 1e-3"), ("sync\nmany impacts; errors to 1e-8"),
      ("cvode\nwhen elements slip, stick, leave"), ("bem\nanother method, as a check"))),
    ("an event-driven simulation\nDSMC, kinetic theory, rings",
     (("a table\none material, all sizes and speeds"), ("build_tables\nall pairs of some materials"))),
    ("a soft-sphere simulation\nforces in every step",
     (("the contact law\nLAMMPS, LIGGGHTS, your own code"),
      ("constant damping\nif only the flow rate counts"))),
)


def which_method(path):
    """What is wanted, and what gives it."""
    drawing = Drawing(9.6, 6.6)
    root = drawing.box(0.1, 3.72, 2.2, "What do you want?", ASK)
    top = 6.5
    for question, answers in QUESTIONS:
        middle = top - 0.76 * len(answers) / 2 + 0.38
        asked = drawing.box(2.9, middle, 2.8, question, ASK)
        drawing.across(root, asked)
        for answer in answers:
            drawing.across(asked, drawing.box(6.3, top, 3.2, answer, ANSWER))
            top -= 0.76
        top -= 0.18
    drawing.save(path)


def house(path):
    """Which folder may use which: arrows go down."""
    drawing = Drawing(9.6, 6.2)
    command = drawing.box(0.3, 6.1, 9.0, "command\nsrc/python/restitute/command", OTHER)
    package = drawing.box(0.3, 5.1, 9.0, "Python package\nsrc/python/restitute: on the public headers", OTHER)
    drawing.down(command, package)
    headers = drawing.box(0.3, 4.1, 9.0, "public interface\ninclude/restitute, fortran/public; "
                          "DEM adapters and examples use it, too", ASK)
    drawing.down(package, headers)
    for k, text in enumerate(("files\nJSON, CSV", "table_files\nHDF5", "table\ntables", "fit\nGSL",
                              "contact\nDEM force", "cvode\nSUNDIALS", "bem\nFFTW")):
        part = drawing.box(0.3 + 1.3 * k, 3.1, 1.2, text, ANSWER)
        drawing.down(headers, part)
    core = drawing.box(0.3, 2.1, 9.0, "core: solver, euler, sync, base\nsrc: objects, checks, units, memory, in C",
                       ANSWER)
    for k in range(7):
        drawing.arrow((0.9 + 1.3 * k, 2.48), (0.9 + 1.3 * k, 2.1))
    mathematics = drawing.box(0.3, 1.1, 9.0, "mathematics\nfortran: common, euler, sync, cvode, bem; no state, no "
                              "input or output", ANSWER)
    drawing.down(core, mathematics)
    drawing.save(path)


def main(figures):
    which_method(figures / "which_method.svg")
    house(figures / "house.svg")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
