# SPDX-License-Identifier: BSD-3-Clause
"""The impacts of a batch: rows of a case file, or points of a grid."""
import csv
import io
import re
from typing import Any

import numpy as np

from restitute.command import options, problem, provenance
from restitute.command.options import Refusal
from restitute.errors import Error

# What Python says of quotes.
_QUOTES = {"unexpected end of data": "a quote is never closed",
           "',' expected after '\"'": "text behind the quote that ends a cell; within a cell a "
           "quote is written twice"}
_DIGITS = b"0123456789+-.eE\n"
RESULTS = ("ez", "ex", "contact_time", "max_indentation", "radius_ratio", "error_ez", "error_ex",
           "method", "status")  # in dimensionless numbers there is no radius_ratio


# -------------------------------------------------------------------------------- tables of text


class Table:
    """The cells of a CSV file, - for standard input, as they came: `cells`, a sequence a column,
    its `names`, and the `lines` on which rows begin. `content` is the file, `source` its name."""

    def __init__(self, path, rows_needed=True):
        self._place = self._begun = self._quotes = 0
        self.content = self._read(path)
        text = _decoded(self.content, self.source)
        rows: list = []
        self.lines: list = []
        try:
            for row in csv.reader(self._lines(text), strict=True):
                if self._quotes % 2:
                    raise self._refuse('a stray quote: within a cell it is written "", and the '
                                       "cell stands in quotes")
                if rows and len(row) != len(rows[0]):
                    raise self._refuse(f"{len(row)} cells, but the header has {len(rows[0])} "
                                       f"columns{_decimal_commas(row, len(rows[0]))}")
                rows.append(row)
                self.lines.append(self._begun)
                if len(rows) == 1:
                    self._check_names(row)
                self._begun = 0
        except csv.Error as why:
            if "unexpected end" in str(why):
                self._place = self._begun
            raise self._refuse(_QUOTES.get(str(why), str(why))) from None
        if not rows:
            raise Refusal(f"{self.source}: is empty; it must begin with a row of column names")
        self.cells = list(zip(*rows))
        if re.search(r"[ \t](?:[,\r\n]|\Z)|(?:\A|[,\n])[ \t]", text):
            self.cells = [tuple(cell.strip(" \t") for cell in column) for column in self.cells]
        self.names = [column[0] for column in self.cells]
        self.cells, self.lines = [column[1:] for column in self.cells], self.lines[1:]
        if rows_needed and not self.lines:
            raise Refusal(f"{self.source}: has column names but no rows")

    def _read(self, path):
        self.source = "standard input" if path == "-" else path
        try:
            with open(0 if path == "-" else path, "rb", closefd=path != "-") as file:
                return file.read()
        except OSError as why:
            raise Refusal(f"{path}: cannot be read: {why.strerror}") from None

    def where(self, row):
        """How a message names a row."""
        return f"{self.source} line {self.lines[row]} (row {row + 1})"

    def _lines(self, text):
        """Lines without comments and blank ones; neither is one within quotes, where a row that
        has begun goes on."""
        for line in io.StringIO(text, newline="\n"):
            self._place += 1
            if self._begun or not (line[0] == "#" or line.isspace()):
                self._begun = self._begun or self._place
                self._quotes += line.count('"')
                yield line

    def _refuse(self, why):
        lines = f"line {self._begun}" if self._begun == self._place else \
            f"lines {self._begun} to {self._place}, which a quote joins"
        return Refusal(f"{self.source} {lines}: {why}")

    def _check_names(self, names):
        if len(names) == 1:
            for sign, word in ((";", "semicolons"), ("\t", "tabs")):
                if sign in names[0]:
                    raise self._refuse(f"the cells are separated by {word}: must be by commas, "
                                       "with decimal points in numbers")
        names = [name.strip(" \t") for name in names]
        for i, name in enumerate(names):
            if not name:
                raise self._refuse(f"column {i + 1} has no name")
            if name in names[:i]:
                raise self._refuse(f"column {name} appears twice")


def _decoded(content, source):
    """The text of a file. Bytes that are no UTF-8 stay what they are."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise Refusal(f"{source}: is UTF-16, as some spreadsheets write: save it as CSV in UTF-8")
    if b"\0" in content:
        line = content.count(b"\n", 0, content.index(b"\0")) + 1
        raise Refusal(f"{source} line {line}: a NUL byte; not a text file")
    text = content.decode("utf-8", "surrogateescape")
    return text[1:] if text[:1] == "\ufeff" else text  # the byte-order mark


def _decimal_commas(row, columns):
    whole = all(re.fullmatch(r"[+-]?\d+(?:[eE][+-]?\d+)?", cell) for cell in row)
    return "; decimal commas? numbers need decimal points" if whole and len(row) > columns else ""


def quoted(cells):
    """Cells as CSV has them."""
    text = "\n".join(cells)
    if text.count("\n") < len(cells) and not re.search(r'[",\r# \t]', text):
        return cells
    return ['"' + cell.replace('"', '""') + '"' if re.search(r'[",\r\n]|\A[# \t]|[ \t]\Z', cell)
            else cell for cell in cells]


def csv_row(cells):
    """A line of CSV."""
    return ",".join(quoted(list(cells))) + "\n"


# --------------------------------------------------------------------------------------- columns


def numbers(texts, read):
    """Numbers from different texts, nan where one is refused, and why by its text. read(text) gives
    a number or raises why not; it is asked where a text is no plain number."""
    other = "\n".join(texts).encode("utf-8", "surrogateescape").translate(None, _DIGITS)
    try:
        values = np.array([float(text) for text in texts] if not other else
                          [float(text) if options.NUMBER.fullmatch(text) else np.nan
                           for text in texts])
    except ValueError:
        values = np.full(len(texts), np.nan)
    reasons = {}
    with np.errstate(invalid="ignore"):
        # An infinite number or a 0 may have been too large or too small for a double.
        doubtful = ~np.isfinite(values) | (values == 0)
    for i in np.flatnonzero(doubtful):
        try:
            values[i] = read(texts[i])
        except (Refusal, ValueError, OverflowError) as why:
            reasons[texts[i]], values[i] = str(why), np.nan
    return values, reasons


def _field_values(field, name, texts):
    values, reasons = numbers(texts, lambda text: field.read(text, name))
    for i in np.flatnonzero(~field.fits(values) & ~np.isnan(values)):
        try:
            field.read(texts[i], name)
        except Refusal as why:
            reasons[texts[i]] = str(why)
    return values, reasons


def _word_values(word, name, texts):
    """Materials, partners or switches from different texts; materials are read."""
    read = {"material": problem.read_material, "partner": problem.read_partner,
            "rotation_blocked": problem.read_switch}[word]
    values, reasons = np.empty(len(texts), object), {}
    for i, text in enumerate(texts):
        try:
            if not text:
                raise Refusal(f"{name} is empty")
            values[i] = read(text, name)
            if word != "rotation_blocked" and text not in ("rigid", "same"):
                problem.material_of(text)
        except (Refusal, Error) as why:
            reasons[text] = str(why)
    return values, reasons


# ----------------------------------------------------------------------------------------- cases


class Cases:
    """Impacts, a row each: `names` of columns as the file or --grid calls them and their `cells` as
    they came; of a file its `table`. `known` is the column of a field or word; `good` says which
    rows can be solved and `reasons` why others cannot. `log` are columns that --grid spaces evenly
    in the logarithm."""

    def __init__(self, names, cells, table=None, log=()):
        self.names, self.cells, self.table, self.log = names, cells, table, log
        self.source = table and table.source
        self.rows, self.reasons, self.known, self._columns = len(cells[0]), {}, {}, {}

    def where(self, row):
        """How a message names a row."""
        return self.table.where(row) if self.table else f"grid row {row + 1}"

    def place(self, name):
        """What the user calls a field here."""
        if name in self.known:
            return self.names[self.known[name]]
        return problem.FIELDS[name].key if name in problem.FIELDS else name

    def check(self, given, option):
        """Refuses columns that do not go together, with each other or with the values that options
        give, which the user calls option(name). Returns the columns that are passed through."""
        source, other = self.source or "--grid", []
        for i, column in enumerate(self.names):
            field, word = problem.field_of_column(column), column.casefold()
            name = field.name if field else word if word in problem.WORDS else None
            if name is None:
                self._check_unknown(column, source)
                other.append(column)
            elif name in self.known:
                raise Refusal(f"{source}: columns {self.place(name)} and {column} are the same")
            elif name in given:
                raise Refusal(f"{source}: column {column} and option {option(name)} both give the "
                              "value")
            else:
                self.known[name] = i
        try:
            values = problem.keywords({**given, **self._examples(given)}, self.place)
            problem.impacts(values, self.place)
        except Refusal as why:
            raise Refusal(f"{source}: {why}") from None
        return other

    def _check_unknown(self, column, source):
        similar = problem.similar_column(column)
        if similar:
            raise Refusal(f'{source}: unknown column "{column[:64]}"{similar}')
        if column in RESULTS:
            raise Refusal(f"{source}: column {column} has the name of a result: rename it")

    def _examples(self, given):
        """A value for each known column, of which a row may leave some empty."""
        import restitute

        special = {"material": restitute.Material.elastic(1e6, density=1e3), "partner": "rigid",
                   "rotation_blocked": False, "shore_a": 50.0, "poisson_ratio": 0.3,
                   "temperature": 25.0, "density": 1e3, "density2": 1e3}
        values = {name: special.get(name, 1.0) for name in self.known}
        for one, alternative in problem.EXCLUSIVE:
            if one in values:
                values.pop(alternative, None)
        if "delta1" in values and not {"gamma", "delta2"} & {*values, *given}:
            values["delta1"] = 0.0
        if "radius2" in values and not {"density2", "mass2"} & {*values, *given}:
            values["mass2"] = np.inf
        return values

    def read(self):
        """Read the known columns, each different text once."""
        for name, i in self.known.items():
            texts = list(dict.fromkeys(self.cells[i]))
            if name in problem.FIELDS:
                values, reasons = _field_values(problem.FIELDS[name], self.names[i], texts)
            else:
                values, reasons = _word_values(name, self.names[i], texts)
            given: Any = True
            if "" in texts and name in problem.FIELDS:
                if name in problem.NEVER_EMPTY:
                    reasons[""] = f"{self.names[i]} is empty: {problem.FIELDS[name].allowed}"
                else:
                    reasons.pop("", None)
                    given = np.array([cell != "" for cell in self.cells[i]])
            if len(texts) < self.rows:
                value_of = dict(zip(texts, values.tolist()))
                values = np.array([value_of[cell] for cell in self.cells[i]], values.dtype)
            self._columns[name] = values, given
            if reasons:
                for row, cell in enumerate(self.cells[i]):
                    if cell in reasons:
                        self.reasons.setdefault(row, reasons[cell])
        self.good = np.ones(self.rows, bool)
        self.good[list(self.reasons)] = False

    def values(self, begin, end, given):
        """Rows [begin, end) that are not refused, together with those that give the same fields:
        yields rows, and arrays by name with what options give."""
        rows = begin + np.flatnonzero(self.good[begin:end])
        kind = np.zeros(len(rows), np.int64)
        sometimes = [name for name, (_, filled) in self._columns.items() if filled is not True]
        for bit, name in enumerate(sometimes):
            kind |= self._columns[name][1][rows].astype(np.int64) << bit
        for one in np.unique(kind):
            some = rows[kind == one]
            empty = {name for bit, name in enumerate(sometimes) if not one >> bit & 1}
            yield some, {**given, **{name: values[some] for name, (values, _) in
                                     self._columns.items() if name not in empty}}

    def materials(self, name):
        """The different texts of the column material or partner; None if there is no such one."""
        if name not in self.known:
            return None
        texts = dict.fromkeys(self.cells[self.known[name]])
        return [text for text in texts if text not in ("", "rigid", "same")]

    def different(self, i):
        """What the different cells of a column mean: numbers, and texts where they are none."""
        texts = list(dict.fromkeys(self.cells[i]))
        values, reasons = numbers(texts, options.number)
        return {text: text if text in reasons else value
                for text, value in zip(texts, values.tolist())}

    def column(self, i):
        """A column as numbers, nan where a cell is empty, or as texts if a cell is no number."""
        meaning = {**self.different(i), "": np.nan}
        if any(isinstance(value, str) for value in meaning.values()):
            return np.array(self.cells[i], object)
        return np.array([meaning[cell] for cell in self.cells[i]])


def read(path):
    """The cases of a file, and its record."""
    table = Table(path)
    cases = Cases(table.names, table.cells, table)
    return cases, {"file": table.source, "rows": cases.rows,
                   "fingerprint": provenance.fingerprint(table.content)}
