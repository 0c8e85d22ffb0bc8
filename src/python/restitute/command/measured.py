# SPDX-License-Identifier: BSD-3-Clause
"""The measurements that `restitute fit` reads: columns of a CSV file by name."""
import re

import numpy as np

from restitute.command import cases, options, problem
from restitute.command.options import Refusal, number

# What an empty cell of a column of the scene stands for; of others none may be empty.
_NEUTRAL = {"radius2": problem.INFINITY, "mass2": problem.INFINITY, "density2": problem.INFINITY,
            "inertia": 0.0, "inertia2": 0.0, "spin": 0.0, "spin2": 0.0}


class Rows:
    """A table of measurements: `numbers` of the columns `known`, by their keywords, nan where a
    cell is empty; how the file has `called` them; and the `rest` of the columns, by number."""

    def __init__(self, path, known):
        self.table, self.known = cases.Table(path), known
        self.source = self.table.source
        self.numbers: dict[str, np.ndarray] = {}
        self.called: dict[str, str] = {}
        self.rest: list[int] = []
        for i, column in enumerate(self.table.names):
            keyword = known.get(column.casefold())
            if keyword is None:
                self.rest.append(i)
            elif keyword in self.numbers:
                raise Refusal(f"{self.source}: columns {self.called[keyword]} and {column} are the "
                              "same")
            else:
                self.called[keyword], self.numbers[keyword] = column, self._read(column, i)

    def _read(self, column, i):
        cells = self.table.cells[i]
        values, reasons = cases.numbers([cell or "0" for cell in cells], number)
        for row, cell in enumerate(cells):
            if cell in reasons:
                raise self.refuse(row, f'{column} = "{cell[:64]}" {reasons[cell]}')
        return np.where([cell == "" for cell in cells], np.nan, values)

    def refuse(self, row, text):
        """A Refusal that names a row."""
        return Refusal(f"{self.table.where(row)}: {text}")

    def unknown(self, column, similar=""):
        """A Refusal of a column."""
        similar = similar or options.did_you_mean(column, self.known)
        return Refusal(f'{self.source}: unknown column "{column[:40]}"; known are listed by --help'
                       f"{similar}")

    def in_words(self, why):
        """What the library says of points[i] or row[i], of the line and the column of the file."""
        text = str(why)
        if text.startswith("known: "):
            return Refusal("--" + text.replace("'", "\""))
        found = re.fullmatch(r"(?:points|row)\[(\d+)\][.: ]*(\w*)(.*)", text, re.S)
        if found is None:
            return Refusal(f"{self.source}: {problem.in_words_of(self.place, text)}")
        return self.refuse(int(found[1]), self.place(found[2]) + found[3])

    def place(self, name):
        """What the file calls a field or a measured value."""
        return self.called.get(name, name)


def scene_of(rows, arguments):
    """The keywords of the scene: what options give, and columns."""
    words = problem.WORDS[1:]
    given = {name: value for name, value in problem.values_of(arguments).items()
             if name in problem.SCENE or name in words}
    names = [rows.table.names[i] for i in rows.rest]
    scene = cases.Cases(names, [rows.table.cells[i] for i in rows.rest] or [rows.table.lines],
                        rows.table)
    for i, column in enumerate(names):
        field = problem.field_of_column(column)
        name = field.name if field else column.casefold()
        if name not in (problem.SCENE if field else words):
            raise rows.unknown(column, problem.similar_column(column))
        if name in given:
            raise rows.refuse(0, f"column {column} and option {arguments.given[name]} both give "
                              "the value")
        scene.known[name], rows.called[name] = i, column
    scene.read()
    for row in sorted(scene.reasons)[:1]:
        raise rows.refuse(row, scene.reasons[row])
    values = {name: np.full(scene.rows, _NEUTRAL.get(name), object) for name in scene.known}
    for some, found in scene.values(0, scene.rows, {}):
        for name in scene.known:
            if name in found:
                values[name][some] = found[name]
            elif name not in _NEUTRAL:
                raise rows.refuse(some[0], f"{rows.called[name]} is empty: "
                                  f"{problem.FIELDS[name].allowed}")
    return {**given, **{name: column if name == "partner" else column.astype(float)
                        for name, column in values.items()}}
