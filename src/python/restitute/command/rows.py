# SPDX-License-Identifier: BSD-3-Clause
"""What comes out of a batch: a row for each case, its cells as they came, then the result."""
import json
import re
from collections import Counter
from operator import itemgetter

import numpy as np

from restitute.command import files, options, problem, provenance
from restitute.command.cases import RESULTS, Table, csv_row, numbers, quoted
from restitute.command.options import Refusal

_INFINITY = float("inf")
# What a number that is read back must be.
_RANGES = {"ez": (0, 1, "must be in [0, 1]"), "ex": (-1, 1, "must be in [-1, 1]"),
           "contact_time": (0, _INFINITY, "must be >= 0 (inf: no rebound)"),
           **dict.fromkeys(RESULTS[3:-2], (0, _INFINITY, "must be >= 0"))}


class Rows:
    """Results of cases: `values`, the `numbers` of a row, nan where it is not `solved`, and its
    `status`: remarks and the limits of the model that are passed, or why it failed. `given` are the
    names that options give."""

    def __init__(self, cases, given, method):
        self.cases, self.method = cases, method
        self.physical = not {*cases.known, *given} <= set(problem.DIMENSIONLESS)
        self.names = [name for name in RESULTS if self.physical or name != "radius_ratio"]
        self.numbers = self.names[:-2]
        self.values = np.full((len(self.numbers), cases.rows), np.nan)
        self.solved = np.zeros(cases.rows, bool)
        self.status = np.full(cases.rows, "", object)

    def take(self, rows, pairs):
        """The results of `restitute.pair` for these rows."""
        for value, name in zip(self.values, self.numbers):
            value[rows] = getattr(pairs, name)
        self.solved[rows], self.status[rows] = pairs.status >= 0, pairs.words()
        for row in rows[pairs.status < 0]:
            self.status[row] = problem.in_words_of(self.cases.place, self.status[row])

    def remarks(self):
        """How many rows have which remark, and how many pass which limit of the model."""
        remarks: Counter = Counter()
        limits: Counter = Counter()
        for status, count in Counter(self.status[self.solved].tolist()).items():
            remark, names = _split(status)
            limits.update(dict.fromkeys(names, count))
            if remark:
                remarks[remark] += count
        return remarks, limits

    def flags(self):
        """The limits that are passed, as bits."""
        from restitute.impact import LIMITS

        bits = {name: bit for bit, name, *_ in LIMITS}
        of = {status: sum(bits[name] for name in _split(status)[1])
              for status in set(self.status[self.solved].tolist())}
        return np.array([of.get(s, 0) if good else 0 for s, good in zip(self.status, self.solved)])

    # ------------------------------------------------------------------------------- CSV and back

    def header(self):
        """The first line."""
        return csv_row([*self.cases.names, *self.names])

    def lines(self, begin, end):
        """Rows [begin, end) as they are written."""
        columns = [quoted(cells[begin:end]) for cells in self.cases.cells]
        columns += [_texts(value[begin:end]) for value in self.values]
        columns.append([self.method if good else "" for good in self.solved[begin:end].tolist()])
        columns.append(quoted(self.status[begin:end].tolist()))
        return "\n".join(map(",".join, zip(*columns))) + "\n"

    def read(self, path):
        """Take rows that were written before; returns how many there are. If they are not what this
        run writes, a Refusal names line, column and value."""
        table, wanted = Table(path, rows_needed=False), [*self.cases.names, *self.names]
        if len(table.names) != len(wanted):
            raise Refusal(f"{path}: has {len(table.names)} columns: must be {len(wanted)}")
        for i, (name, must) in enumerate(zip(table.names, wanted)):
            if name != must:
                raise Refusal(f'{path}: column {i + 1} is "{name[:64]}": must be {must}')
        done, first = len(table.lines), len(self.cases.names)
        row, why = min([self._foreign(table.cells[:first], done),
                        *self._take(table.cells[first:], done)], key=itemgetter(0))
        if row < done:
            raise Refusal(f"{table.where(row)}: {why}")
        return done

    def _foreign(self, columns, done):
        """The first row that is not that of the case."""
        rows = [self.cases.rows]
        for cells, ours in zip(columns, self.cases.cells):
            if list(cells) != list(ours[:done]):
                rows.append(next((i for i, (a, b) in enumerate(zip(cells, ours)) if a != b), done))
        return min(rows), "does not belong to these cases; remove it to start anew"

    def _take(self, columns, done):
        """Take the results; yields the first bad row of each kind, and what is bad."""
        *columns, method, status = columns
        solved = np.array([cell != "" for cell in method], bool)
        for i, (cell, text) in enumerate(zip(method, status)):
            if cell not in ("", self.method):
                yield i, f'method = "{cell[:64]}": must be {self.method}'
            elif not cell and not text:
                yield i, "method and status are empty: neither solved nor failed"
        for k, name in enumerate(self.numbers):
            low, high, words = _RANGES[name]
            texts = list(dict.fromkeys(columns[k]))
            known = dict(zip(texts, numbers(texts, options.number)[0].tolist()))
            value = np.array([known[cell] for cell in columns[k]])
            good = np.where(solved, (value >= low) & (value <= high),
                            np.array([cell == "" for cell in columns[k]], bool))
            for i in np.flatnonzero(~good)[:1]:
                must = words if solved[i] else "must be empty, since method is empty"
                yield int(i), f'{name} = "{columns[k][i][:64]}": {must}'
            self.values[k, :done] = value
        self.solved[:done], self.status[:done] = solved, status
        yield done, ""

    # ------------------------------------------------------------------------------ other formats

    def units(self):
        """The unit of each column that has one."""
        fields = {name: problem.field_of_column(name) for name in self.cases.names}
        return {**{name: field.unit for name, field in fields.items() if field},
                **dict.fromkeys(self.numbers, "1"), "contact_time": "s" if self.physical else "T",
                "max_indentation": "m" if self.physical else "d0"}

    def json(self, record):
        """The record and all rows, one a line."""
        columns = []
        for i, cells in enumerate(self.cases.cells):
            texts = {cell: _json(value) for cell, value in self.cases.different(i).items()}
            columns.append([texts[cell] for cell in cells])
        columns += [[_json(value) for value in values.tolist()] for values in self.values]
        columns.append([json.dumps(self.method) if good else "null" for good in self.solved])
        columns.append([_json(text) for text in self.status])
        members = (json.dumps(name).replace("%", "%%") for name in [*self.cases.names, *self.names])
        row = "    {" + ", ".join(f"{member}: %s" for member in members) + "}"
        meta = provenance.text({"meta": record}).decode("utf-8")
        return meta[:-3] + ',\n  "results": [\n' + ",\n".join(map(row.__mod__, zip(*columns))) \
            + "\n  ]\n}\n"

    def hdf5(self, record):
        """The bytes of an HDF5 file: a dataset for each column, the record as an attribute."""
        h5py = options.need("h5py", "--output")
        columns = {name: self.cases.column(i) for i, name in enumerate(self.cases.names)}
        columns.update(zip(self.numbers, self.values), status=self.status)
        text = h5py.string_dtype()
        return files.hdf5({
            name.replace("/", " per "): values if values.dtype != object else
            np.array([value.encode("utf-8", "surrogateescape") for value in values], text)
            for name, values in columns.items()}, record["units"], record=provenance.text(record))


def _split(status):
    """The remark and the names of limits in a status "text; FAST LARGE_CONTACT"."""
    remark, _, names = status.rpartition("; ")
    if re.fullmatch(r"[A-Z_]+( [A-Z_]+)*", names):
        return remark, names.split()
    return status, []


def _texts(values):
    """Numbers with as many digits as are needed to read them back; nan is nothing."""
    return [text[:-2] if text[-2:] == ".0" else "" if text == "nan" else text
            for text in map(repr, values.tolist())]


def _json(value):
    return json.dumps(provenance.of_number(value) if isinstance(value, float) else value)
