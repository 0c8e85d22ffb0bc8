# SPDX-License-Identifier: BSD-3-Clause
"""`restitute pair --input` and `--grid`: rows are solved in pieces, in order, into OUT.partial, which
becomes OUT at the end."""
import io
import os
import signal
import time
import warnings
from contextlib import contextmanager, nullcontext
from types import SimpleNamespace

import numpy as np

from restitute.command import cases as case_files
from restitute.command import files, grid, options, problem, provenance
from restitute.command.options import Refusal, say
from restitute.command.partial import Partial
from restitute.command.rows import Rows

DONE, FAILED, INTERRUPTED = 0, 1, 130
_NAMED_FAILURES = 5
_FORMATS = {".h5": "hdf5", ".hdf5": "hdf5"}


def run(arguments, made=None):
    """Solve the rows of a file or a grid. Everything that can be refused is, before anything is
    written.

    Parameters
    ----------
    made : optional
        Instead of them `made.cases`, and `made.source` for the record. At the end
        `made.finish(batch, interrupted)` gives the exit status.
    """
    batch = _Batch(arguments, made)
    with _interrupts() as interrupts, _scheduler(arguments) as executor:
        try:
            batch.solve(executor, interrupts)
        except KeyboardInterrupt:
            say(f"interrupted after {batch.done} of {batch.cases.rows} rows"
                f"{'; continue with --resume' if batch.partial else ''}")
            return INTERRUPTED
        except Refusal as why:
            raise Refusal(batch.left(why)) from None
        finally:
            batch.leave()
    return made.finish(batch, interrupts.came) if made else batch.report()


class _Batch:
    """A run.

    Attributes
    ----------
    done : int
        Rows that are written.
    partial : Partial or None
        None: a stream.
    """

    def __init__(self, arguments, made=None):
        self.arguments, self.done, self.partial, self.stream = arguments, 0, None, None
        self.output, self.figure = arguments.output, arguments.figure
        _check_options(arguments)
        self.format = arguments.format or _FORMATS.get(
            os.path.splitext(self.output or "")[1].lower(), "csv")
        if self.format == "hdf5":
            options.need("h5py", f"--output = {self.output}")
        self.given = problem.values_of(arguments)
        self.solution = problem.solution(arguments, method="euler", tolerance=1e-3)
        if made:
            self.cases, source, other = made.cases, made.source, []
        else:
            self.cases, source = (case_files.read(arguments.input) if arguments.input is not None
                                  else grid.read(arguments.grid))
            other = self.cases.check(self.given, problem.place_of_options(arguments))
        if self.figure:
            self.axes = self._figure_axes()
        from restitute.solving import options as checked

        self.limits = checked(**self.solution)
        self._check_places()
        self.cases.read()
        self.settings = provenance.settings(arguments, {**self._materials(), "input": source})
        self.rows = Rows(self.cases, self.solution["method"])
        if other:
            say(f"remark: {self.cases.source}: passed through as unknown: {', '.join(other)}")
        self._open()

    def _check_places(self):
        places, texts = files.Places(), []
        places.read("--input", self.arguments.input)
        for name in ("material", "partner"):
            if self.given.get(name) not in (None, "rigid", "same"):
                places.read(f"--{name}", self.given[name])
                texts.append(self.given[name])
            texts += self.cases.materials(name) or []
        for text in texts:
            places.read("material", text)
            places.read("prony_csv", provenance.series_of(text))
        places.write("--output", self.output, ".meta.json", ".partial", ".partial.json")
        if self.figure:
            places.write("--figure", self.figure)
        places.check()

    def _materials(self):
        """The materials that columns name: their contents belong to the inputs that a resumed run
        must find again."""
        columns = {name: self.cases.materials(name) for name in ("material", "partner")}
        return {name: {text: provenance.of_material(text) for text in texts}
                for name, texts in columns.items() if texts is not None}

    def _open(self):
        """Where rows go that need not wait for the others."""
        if not files.is_stream(self.output):
            self.partial = Partial(self.output, self.arguments.resume)
            fresh = self.partial.empty
            try:
                if not fresh:
                    self.partial.check_settings(self.settings)
                    self.partial.cut()
                if self.partial.empty:
                    self.partial.begin(self.settings, self.rows.header())
                else:
                    self.done = self.rows.read(self.partial.path)
            except BaseException:
                if fresh:
                    self.partial.remove()
                self.partial.leave()
                raise
        elif self.format == "csv":
            self.stream = 1 if files.is_standard(self.output) else \
                files.Place(self.output).open_through()
            self._send(self.rows.header())

    def _send(self, text):
        if self.partial:
            self.partial.append(text)
        elif self.stream == 1:
            options.emit(text)
        elif self.stream is not None:
            options.write_all(self.stream, text)

    def leave(self):
        """Close what is open."""
        if self.partial:
            self.partial.leave()
        if self.stream not in (None, 1):
            os.close(self.stream)

    def left(self, why):
        """A refusal after rows were written."""
        return f"{why}; continue with --resume when that is mended" if self.partial else str(why)

    def solve(self, executor, interrupts):
        """All rows, piece by piece, and the files.

        A piece has a row for each thread, and as many more as take about 0.4 s (20 s elsewhere), so
        that whoever looks on, interrupts or resumes sees rows.
        """
        threads = self.arguments.threads or len(os.sched_getaffinity(0))
        size, wanted = (threads, 0.4) if executor is None else (256, 20.0)
        for row in range(self.done):
            self._name_failure(row)
        with _progress(self.cases.rows, self.done) as progress:
            while self.done < self.cases.rows:
                begin, end = self.done, min(self.done + size, self.cases.rows)
                since = time.monotonic()
                self._solve_rows(begin, end, threads, executor)
                with interrupts.held():
                    for row in range(begin, end) if self._failures < _NAMED_FAILURES else ():
                        self._name_failure(row)
                    self._send(self.rows.lines(begin, end))
                    self.done = end
                progress(end - begin)
                took = time.monotonic() - since
                size = 2 * size if took < wanted / 2 else max(threads, size // 2) \
                    if took > 2 * wanted else size
        interrupts.holding = True  # it is not worth stopping any more
        self._write()

    _failures = 0

    def _name_failure(self, row):
        """The first few rows that fail are named at once; the rest is in the column status."""
        if not self.rows.solved[row] and self._failures < _NAMED_FAILURES:
            self._failures += 1
            say(f"{self.cases.where(row)}: {self.rows.status[row]}")

    def _solve_rows(self, begin, end, threads, executor):
        for row in (row for row in range(begin, end) if row in self.cases.reasons):
            self.rows.status[row] = self.cases.reasons[row]
        for rows, values in self.cases.values(begin, end, self.given):
            for some, impacts in _impacts(rows, values, self.cases.place, self.rows.status):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # they are counted over all rows
                    from restitute.impact import solve

                    pairs = solve(impacts, on_error="nan", threads=threads, executor=executor,
                                  **self.solution)
                self.rows.take(some, pairs)

    def _write(self):
        record = provenance.record(
            self.arguments, self.settings, self.rows.units(self.given), rows=self.cases.rows,
            failed=int(np.count_nonzero(~self.rows.solved)))
        remarks, limits = self.rows.remarks()
        record.update(remarks=dict(remarks), limits_passed=dict(limits))
        if self.format != "csv":
            content = getattr(self.rows, self.format)(record)
            files.write((self.output, content))
            if self.partial:
                self.partial.remove()
        elif self.partial:
            name = files.beside(self.output, ".meta.json")
            try:
                beside = files.NewFile(name, provenance.text(record))
            except OSError as why:
                raise files.not_written(name, why) from None
            try:
                self.partial.commit(self.cases.rows)
                beside.commit()
            finally:
                beside.drop()

    def report(self):
        """What is to be said of all rows, the figure, and the exit status."""
        from restitute.impact import LIMITS

        remarks, limits = self.rows.remarks()
        for remark, count in remarks.items():
            say(f"remark: {count} of {self.cases.rows} rows: {remark}")
        for _, name, option, _, words in LIMITS:
            if limits[name]:
                say(f"remark: {limits[name]} of {self.cases.rows} rows pass the limit {name}: "
                    f"{words.format(getattr(self.limits, option))}")
        if self.figure:
            self._draw()
        failed = np.count_nonzero(~self.rows.solved)
        if failed:
            say(f"{failed} of {self.cases.rows} rows failed; the column status says why")
        return FAILED if failed else DONE

    # ------------------------------------------------------------------------------- the figure

    def _columns(self):
        """The columns of a figure, by canonical names."""
        return {problem.FIELDS[name].key if name in problem.FIELDS else name: self.cases.column(i)
                for name, i in self.cases.known.items()}

    def _figure_axes(self):
        files.check(self.figure, "--figure")
        options.need("matplotlib", "--figure")
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

        if not self.rows.solved.any():
            raise Refusal(f"{self.figure}: not drawn, no row was solved")
        word, content = self.given.get("material"), io.BytesIO()
        title = problem.material_of(word).name if word else "Restitution coefficients"
        note = ", ".join(f"{name.replace('_', ' ')} {value:g}" + (
            f" {problem.FIELDS[name].unit}" if problem.FIELDS[name].unit != "1" else "")
            for name, value in self.given.items() if name in problem.FIELDS)
        ax = plot.sheet(2, title, note, f"restitute {restitute.version()}, method "
                        f"{self.solution['method']}, tolerance {self.solution['tolerance']:g}")
        ez, ex = self.rows.values[:2]
        pairs = SimpleNamespace(ez=ez, ex=ex, flags=self.rows.flags())
        plot.grid(self._columns(), pairs, axes=self.axes, contours=self.arguments.contours,
                  log=self.cases.log, noise=2 * self.solution["tolerance"], ax=ax)
        plot.save(ax, content, os.path.splitext(self.figure)[1][1:].lower())
        files.write((self.figure, content.getvalue()))


def _check_options(arguments):
    if arguments.input is not None and arguments.grid is not None:
        raise Refusal("--input and --grid are both given: use one")
    if arguments.format == "text":
        raise Refusal('--format = "text": must be csv or json with --input and --grid')
    if arguments.contours and not arguments.figure:
        raise Refusal("--contours: needs --figure")
    if arguments.resume and files.is_stream(arguments.output):
        raise Refusal("--resume: needs --output FILE")
    files.check(arguments.output, "--output")


def _impacts(rows, values, place, status):
    """Impacts that give the same fields: the rows among them that can be described, and
    `restitute.scenes.Impacts`. Why others cannot goes into `status`."""
    def described(values):
        return problem.impacts(problem.keywords(values, place), place)

    try:
        return [(rows, described(values))]
    except Refusal as why:
        reason = str(why)
    good = []
    for i, row in enumerate(rows):
        try:
            described({name: value[i] if np.ndim(value) else value
                       for name, value in values.items()})
            good.append(i)
        except Refusal as why:
            status[row] = str(why)
    if not good:
        return []
    try:
        some = {name: value[good] if np.ndim(value) else value for name, value in values.items()}
        return [(rows[good], described(some))]
    except Refusal:
        status[rows[good]] = reason
        return []


# --------------------------------------------------------------------------------------- the run


@contextmanager
def _progress(total, done):
    """A function that takes how many more rows are done, and shows it on a terminal."""
    if not os.isatty(2):
        yield lambda more: None
        return
    try:
        from tqdm import tqdm
    except ImportError:
        yield lambda more: None
        return
    with tqdm(total=total, initial=done, unit=" rows", desc="restitute", dynamic_ncols=True) as bar:
        yield bar.update


class _Interrupts:
    """Signals that end a run, as KeyboardInterrupt, but not while a file is being written."""

    def __init__(self):
        self.came = self.holding = False

    def handle(self, number, frame):
        """The handler."""
        self.came = True
        if not self.holding:
            raise KeyboardInterrupt

    @contextmanager
    def held(self):
        """Put them off."""
        self.holding = True
        try:
            yield
        finally:
            self.holding = False
        if self.came:
            raise KeyboardInterrupt


@contextmanager
def _interrupts():
    interrupts, before = _Interrupts(), {}
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is not signal.SIG_IGN:  # as nohup wants it
            before[number] = signal.signal(number, interrupts.handle)
    try:
        yield interrupts
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _scheduler(arguments):
    """The client of a dask scheduler, for a with statement; nothing if none is asked for."""
    if arguments.scheduler is None:
        return nullcontext()
    distributed = options.need("distributed", "--scheduler")
    try:
        return distributed.Client(arguments.scheduler, timeout=10)
    except (OSError, ValueError) as why:
        raise Refusal(f"--scheduler = {arguments.scheduler}: cannot be reached: {why}") from None
