# SPDX-License-Identifier: BSD-3-Clause
"""--grid: all impacts of one or two axes."""
import numpy as np

from restitute.command import problem
from restitute.command.cases import Cases
from restitute.command.options import Refusal, bounded, did_you_mean, number_text

_MOST_POINTS, _MOST_IMPACTS = 10000, 1000000  # on an axis; kept in memory for the figure
_AXIS = "NAME=FROM:TO:N[:log]"


class _Axis:
    """Column, its cells in order, whether their spacing is logarithmic."""

    def __init__(self, text):
        name, equals, values = text.partition("=")
        name = name.replace("-", "_")
        field = next((f for f in problem.FIELDS.values() if name in (f.name, f.key, *f.older)),
                     None)
        if not equals or not (field or name == "material"):
            known = [*problem.FIELDS, "material"]
            raise Refusal(f'--grid: "{text[:64]}" must be {_AXIS}, NAME that of an option such as '
                          "speed, angle or psi, or material=FILE:FILE:..."
                          f"{did_you_mean(name, known) if equals else ''}")
        if field:
            self.column = field.key
            self._read_numbers(field, name, values.split(":"))
            return
        self.column, self.log = "material", False
        self.cells = [file for file in values.split(":") if file]
        if not self.cells:
            raise Refusal("--grid: material must be FILE:FILE:...")

    def _read_numbers(self, field, name, parts):
        self.log = len(parts) == 4 and parts[3] == "log"
        if len(parts) != 3 and not self.log:
            raise Refusal(f"--grid: {name} must be FROM:TO:N or FROM:TO:N:log")
        place = f"--grid: {name}"
        low, high = (field.read(text, place) for text in parts[:2])
        count = bounded(1, _MOST_POINTS, whole=True)(parts[2], f"{place}: N")
        if not np.isfinite([low, high]).all():
            raise Refusal(f"{place}: both ends must be finite")
        if self.log and not (low > 0 and high > 0):
            raise Refusal(f"{place} = {high if low > 0 else low:g}: must be > 0 on a logarithmic "
                          "axis")
        if not (low == high if count == 1 else low < high):
            raise Refusal(f"{place}: FROM = {low:g} must be "
                          f"{'(with one point)' if count == 1 else 'less than'} TO = {high:g}")
        points = np.geomspace(low, high, count) if self.log else np.linspace(low, high, count)
        # Ten digits are enough for a point between the ends, and read well.
        texts = [f"{float(f'{point:.10g}'):.15g}" for point in points]
        texts[-1], texts[0] = number_text(high), number_text(low)
        self.cells = texts


def read(text):
    """The cases of --grid, the last axis varying fastest.

    Curves of a figure are made of the first axis: those of a speed, over the angle, and of
    materials.
    """
    axes = [_Axis(part) for part in text.split(",") if part]
    if not 1 <= len(axes) <= 2:
        raise Refusal("--grid: one or two axes, not more" if axes else
                      f"--grid: is empty: must be {_AXIS}")
    if len({axis.column for axis in axes}) < len(axes):
        raise Refusal(f"--grid: {axes[0].column} is given twice")
    columns = [axis.column for axis in axes]
    if columns[1:] == ["material"] or columns == ["angle_deg", "speed_m_s"]:
        axes.reverse()
    inner = len(axes[-1].cells) if len(axes) == 2 else 1
    outer = len(axes[0].cells)
    if inner * outer > _MOST_IMPACTS:
        raise Refusal(f"--grid: {inner * outer} impacts: must be at most {_MOST_IMPACTS}")
    cells = [[cell for cell in axes[0].cells for _ in range(inner)]]
    if len(axes) == 2:
        cells.append(axes[1].cells * outer)
    return Cases([axis.column for axis in axes], cells,
                 log=tuple(axis.column for axis in axes if axis.log)), {"grid": text}
