# SPDX-License-Identifier: BSD-3-Clause
"""`restitute pair --input` and `--grid`: rows are solved in pieces, in order, into OUT.partial,
which becomes OUT at the end."""
import os
import time
import warnings
from contextlib import contextmanager, nullcontext
from types import SimpleNamespace
from typing import Any

import numpy as np

from restitute.command import cases as case_files
from restitute.command import files, grid, options, problem, provenance
from restitute.command.options import Refusal, say
from restitute.command.partial import Partial
from restitute.command.rows import Rows
from restitute.errors import Error
from restitute.values import span

DONE, FAILED, INTERRUPTED = 0, 1, 130
_NAMED_FAILURES = 5


def run(arguments, made=None):
    """Solve the rows of a file or a grid, or `made.cases`, which `made.source` records; then
    `made.finish(batch)` gives the exit status. All that can be refused is, before anything is
    written."""
    _check_options(arguments)
    with _scheduler(arguments) as executor:
        batch = _Batch(arguments, made)
        try:
            batch.open()
            batch.solve(executor)
            batch.write()
        except KeyboardInterrupt:
            return batch.interrupted()
        except Exception as why:
            if executor is None and not isinstance(why, (Refusal, Error)):
                raise
            text = str(why) if isinstance(why, (Refusal, Error)) else \
                f"--scheduler = {arguments.scheduler}: {type(why).__name__}: {why}"
            more = "; continue with --resume when that is mended" \
                if batch.partial and not batch.written else ""
            raise Refusal(f"{text}{more}") from None
        finally:
            batch.leave()
    try:
        return made.finish(batch) if made else batch.report()
    except KeyboardInterrupt:
        return batch.interrupted()


def _check_options(arguments):
    if arguments.input is not None and arguments.grid is not None:
        raise Refusal("--input and --grid are both given: use one")
    if arguments.format == "text":
        raise Refusal('--format = "text": must be csv or json with --input and --grid')
    if arguments.contours and not arguments.figure:
        raise Refusal("--contours: needs --figure")
    if arguments.resume and files.is_stream(arguments.output):
        raise Refusal("--resume: needs --output FILE")
    if arguments.figure:
        options.need("matplotlib", "--figure")
    if arguments.format is None and (arguments.output or "").lower().endswith((".h5", ".hdf5")):
        options.need("h5py", f"--output = {arguments.output}")
        arguments.format = "hdf5"
    arguments.format = arguments.format or "csv"


class _Batch:
    """A run: how many rows are `done` and written; `sink`, descriptor and name of where they go as
    they come; the Partial, or None for a stream."""

    def __init__(self, arguments, made):
        from restitute.solving import options as checked

        self.arguments, self.output = arguments, arguments.output
        self.done = self.failures = 0
        self.partial: Any = None
        self.written = False
        self.sink: Any = None
        self.draws = bool(made or arguments.figure)
        self.given = problem.values_of(arguments)
        self.solution = problem.solution(arguments, method="euler", tolerance=1e-3)
        self.limits = checked(**self.solution)
        if made:
            self.cases, source, other = made.cases, made.source, []
        else:
            self.cases, source = (case_files.read(arguments.input) if arguments.input is not None
                                  else grid.read(arguments.grid))
            other = self.cases.check(self.given, problem.place_of_options(arguments))
        self.axes = self._figure_axes() if arguments.figure else None
        materials = {name: texts for name in ("material", "partner")
                     if (texts := self.cases.materials(name)) is not None}
        provenance.check_places(arguments, {**self.given, **materials}, (
            "--output", self.output, ".meta.json", ".partial", ".partial.json"),
            ("--figure", arguments.figure))
        self.cases.read()
        # What columns name belongs to the inputs that a resumed run must find again.
        self.settings = provenance.settings(arguments, {"input": source, **{
            name: {text: provenance.of_material(text) for text in texts}
            for name, texts in materials.items()}})
        self.rows = Rows(self.cases, self.given, self.solution["method"])
        if other:
            say(f"remark: {self.cases.source}: passed through as unknown: {', '.join(other)}")

    def open(self):
        """Where rows go that need not wait for the others; takes the rows that are there."""
        if files.is_stream(self.output):
            if self.arguments.format == "csv":
                self.sink = (1, "standard output") if files.is_standard(self.output) else \
                    (files.Place(self.output).open_through(), f"{self.output}:")
                self._send(self.rows.header())
            return
        partial = Partial(self.output, self.arguments.resume)
        fresh = partial.empty
        try:
            if not fresh:
                partial.check_settings(self.settings)
                partial.cut()
            if partial.empty:
                partial.begin(self.settings, self.rows.header())
            else:
                self.done = self.rows.read(partial.path)
        except BaseException:
            if fresh:
                partial.remove()
            partial.leave()
            raise
        self.partial, self.sink = partial, (partial.descriptor, f"{partial.path}:")

    def _send(self, text):
        if self.sink:
            options.write_all(self.sink[0], text, self.sink[1])

    def leave(self):
        """Close what is open."""
        if self.partial:
            self.partial.leave()
        elif self.sink and self.sink[0] != 1:
            os.close(self.sink[0])

    def solve(self, executor):
        """All rows, piece by piece: a row for each thread, and as many more as take about 0.4 s
        (20 s elsewhere), so that whoever looks on, interrupts or resumes sees rows."""
        threads = self.arguments.threads or len(os.sched_getaffinity(0))
        size, wanted = (threads, 0.4) if executor is None else (256, 20.0)
        self._name_failures(0, self.done)
        with _progress(self.cases.rows, self.done) as progress:
            while self.done < self.cases.rows:
                begin, end = self.done, min(self.done + size, self.cases.rows)
                since = time.monotonic()
                self._solve_rows(begin, end, threads=threads, executor=executor)
                self._name_failures(begin, end)
                self._send(self.rows.lines(begin, end))
                self.done = end
                progress(end - begin)
                took = time.monotonic() - since
                size = 2 * size if took < wanted / 2 else max(threads, size // 2) \
                    if took > 2 * wanted else size

    def _solve_rows(self, begin, end, **how):
        from restitute.impact import solve

        for row in np.flatnonzero(~self.cases.good[begin:end]) + begin:
            self.rows.status[row] = self.cases.reasons[row]
        for rows, values in self.cases.values(begin, end, self.given):
            for some, impacts in _impacts(rows, values, self.cases.place, self.rows.status):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # they are counted over all rows
                    pairs = solve(impacts, on_error="nan", **how, **self.solution)
                self.rows.take(some, pairs)

    def _name_failures(self, begin, end):
        """The first few rows that fail are named at once; the rest is in the column status."""
        failed = np.flatnonzero(~self.rows.solved[begin:end])[:_NAMED_FAILURES - self.failures]
        self.failures += len(failed)
        for row in begin + failed:
            say(f"{self.cases.where(row)}: {self.rows.status[row]}")

    def write(self):
        """What is written when all rows are there."""
        remarks, limits = self.rows.remarks()
        record = provenance.record(
            self.arguments, self.settings, self.rows.units(), rows=self.cases.rows,
            failed=int(np.count_nonzero(~self.rows.solved)), remarks=remarks, limits_passed=limits)
        with options.signals_wait() if self.partial else nullcontext():  # a pipe may wait for ever
            if self.arguments.format != "csv":
                files.write((self.output, getattr(self.rows, self.arguments.format)(record)))
                if self.partial:
                    self.partial.remove()
            elif self.partial:
                files.write((files.beside(self.output, ".meta.json"), provenance.text(record)),
                            between=lambda: self.partial.commit(self.cases.rows))
            self.written = bool(self.partial)

    def interrupted(self):
        """Says where the rows are."""
        unfinished = self.partial and not self.written
        done, more = self.partial.rows() if unfinished else self.done, ""
        if unfinished:
            more = "; continue with --resume"
        elif self.written:
            more = f", all in {self.output}{'; the figure may be missing' if self.draws else ''}"
        say(f"interrupted after {done} of {self.cases.rows} rows{more}")
        return INTERRUPTED

    def report(self):
        """What is to be said of all rows, the figure, and the exit status."""
        from restitute.impact import LIMITS

        of, flags = f"of {self.cases.rows} rows", self.rows.flags()
        columns = dict(zip(self.rows.numbers, self.rows.values))
        remarks, limits = self.rows.remarks()
        for remark, count in remarks.items():
            say(f"remark: {count} {of}: {remark}")
        for bit, name, option, member, words in LIMITS:
            if name not in limits:
                continue
            text = words.format(getattr(self.limits, option)) if option else words
            if member in columns:
                values = columns[member][(flags & bit) != 0]
                text += f": {span(values, ' s', digits=3)}" if not option else \
                    f", up to {values.max():.3g}"
            verb = "exceed the limit" if option else "are flagged"
            say(f"remark: {limits[name]} {of} {verb} {name}: {text}")
        if self.arguments.figure:
            self._draw()
        failed = np.count_nonzero(~self.rows.solved)
        if failed:
            say(f"{failed} {of} failed; the column status says why")
        return FAILED if failed else DONE

    # ------------------------------------------------------------------------------- the figure

    def _columns(self):
        """The columns of a figure, by canonical names."""
        return {problem.FIELDS[name].key if name in problem.FIELDS else name: self.cases.column(i)
                for name, i in self.cases.known.items()}

    def _figure_axes(self):
        from restitute import plot

        columns = self._columns()
        try:
            if self.cases.source and all(len(np.unique(of)) < 2 for of in columns.values()):
                raise ValueError("no columns vary: must be one or two")
            return plot.grid_axes(columns, self.arguments.contours, not self.cases.source)
        except ValueError as why:
            option = "--" if str(why).startswith("contours") else "--figure: "
            raise Refusal(f"{option}{why}") from None

    def _draw(self):
        import restitute
        from restitute import plot

        figure = self.arguments.figure
        if not self.rows.solved.any():
            raise Refusal(f"{figure}: not drawn, no row was solved")
        word = self.given.get("material")
        title = problem.material_of(word).name if word else "Restitution coefficients"
        units = {name: f" {field.unit}".replace(" 1", "") for name, field in problem.FIELDS.items()}
        note = ", ".join(f"{name.replace('_', ' ')} {value:g}{units[name]}"
                         for name, value in self.given.items() if name in units)
        ax = plot.sheet(2, title, note, f"restitute {restitute.version()}, method "
                        f"{self.solution['method']}, tolerance {self.solution['tolerance']:g}")
        ez, ex = self.rows.values[:2]
        plot.grid(self._columns(), SimpleNamespace(ez=ez, ex=ex, flags=self.rows.flags()),
                  axes=self.axes, contours=self.arguments.contours, log=self.cases.log,
                  noise=2 * self.solution["tolerance"], ax=ax)
        files.write((figure, files.image(ax, figure)))


def _impacts(rows, values, place, status):
    """A list of those rows, which give the same fields, that can be described, and their
    `restitute.scenes.Impacts`; or empty. Why others cannot goes into `status`."""
    def described(which):
        some = {name: value[which] if np.ndim(value) else value for name, value in values.items()}
        return problem.impacts(problem.keywords(some, place), place)

    try:
        return [(rows, described(slice(None)))]
    except Refusal as why:  # perhaps because of one of them
        status[rows] = str(why)
    good = []
    for i, row in enumerate(rows):
        try:
            described(i)
            good.append(i)
        except Refusal as why:
            status[row] = str(why)
    try:
        return [(rows[good], described(good))] if good else []
    except Refusal:
        return []


# --------------------------------------------------------------------------------------- the run


@contextmanager
def _progress(total, done):
    """A function that takes how many more rows are done, and shows it on a terminal."""
    try:
        from tqdm import tqdm
    except ImportError:
        tqdm = None
    if tqdm is None or not os.isatty(2):
        yield lambda more: None
        return
    with tqdm(total=total, initial=done, unit=" rows", desc="restitute", dynamic_ncols=True) as bar:
        yield bar.update


def _scheduler(arguments):
    """The client of a dask scheduler, for a with statement; nothing if none is asked for."""
    if arguments.scheduler is None:
        return nullcontext()
    distributed = options.need("distributed", "--scheduler")
    try:
        return distributed.Client(arguments.scheduler, timeout=10)
    except (OSError, ValueError) as why:
        raise Refusal(f"--scheduler = {arguments.scheduler}: cannot be reached: {why}") from None
