# SPDX-License-Identifier: BSD-3-Clause
"""`restitute paper`: figures by name, each a batch of its own whose rows become a CSV, a figure and
checks."""
import argparse
import os

from restitute.command import options, problem
from restitute.command.options import Refusal, emit, listed

_DRAWN = (".svg", ".pdf")
_ROWS = (".csv", ".csv.meta.json", ".csv.partial", ".csv.partial.json")
_EPILOG = """A figure becomes NAME.csv, NAME.svg and NAME.pdf in the folder --output, or here:
  restitute paper fig4 --output figures
  restitute paper all --output figures --material polyisobutylene
fig4, fig6: ez; fig5, fig8, fig9: ex over delta1 and psi; fig7: ex without slip; fig10, fig11: psi_c
and the error of its formula; maxwell, temperature (takes --material), tangent, friction: beyond the
paper. Impacts are drawn at random in SI units; their scatter about the curves of the dimensionless
numbers is printed. The method is sync and the tolerance 1e-5, if not said otherwise.
Exit status: 0 done, 1 some rows or checks failed, 2 bad usage or input, 130 interrupted.
"""


def add(subparsers):
    """The parser of `restitute paper`."""
    parser = subparsers.add_parser("paper", usage="restitute paper FIGURE [OPTION...]",
                                   epilog=_EPILOG)
    parser.add_argument("figure", nargs="?", metavar="FIGURE", help="fig4 to fig11, maxwell, "
                        "temperature, tangent, friction, or all of them")
    problem.add_solution(parser)
    group = parser.add_argument_group("Input and output")
    options.add(group, "material", "FILE|NAME", "polyisobutylene, for the figure temperature",
                problem.read_material)
    options.add(group, "seed", "N", "the impacts that are drawn, 0 to 4294967295; default 2017",
                options.bounded(0, 2**32 - 1, whole=True))
    options.add(group, "output", "FOLDER", "where the files go; made if there is none")
    options.add(group, "threads", "N", "number of threads, 1 to 1024; default all processors",
                options.bounded(1, 1024, whole=True))
    options.add(group, "scheduler", "ADDRESS", "solve on the workers of this dask scheduler; needs "
                "dask.distributed")
    options.add_flag(group, "resume", "continue an interrupted figure from NAME.csv.partial")


def run(arguments):
    """Make one figure, or all."""
    options.need("matplotlib", "paper")
    from restitute.command import batch
    from restitute.paper import SPECS

    names = list(SPECS) if arguments.figure == "all" else [arguments.figure]
    folder = arguments.output or "."
    _check(arguments, names, SPECS, folder)
    status = batch.DONE
    for name in names:
        if name == "temperature" and arguments.material is None:
            emit(f"{name}: left out, needs --material\n")
            continue
        made = _Made(name, arguments, os.path.join(folder, name))
        one = batch.run(made.arguments, made)
        if one == batch.INTERRUPTED:
            return one
        status = max(status, one)
    return status


def _check(arguments, names, known, folder):
    """What is wrong is said before anything is drawn."""
    from restitute.command import provenance

    if arguments.figure is None:
        raise Refusal(f"the name of a figure is missing: must be {listed([*known, 'all'])}")
    if names[0] not in known:
        raise Refusal(f'"{names[0][:64]}": must be fig4 to fig11, maxwell, temperature, tangent, '
                      f"friction or all{options.did_you_mean(names[0], known)}")
    if arguments.tolerance is not None and arguments.tolerance < 1e-6:
        raise Refusal(f"--tolerance = {arguments.tolerance:g}: must be at least 1e-6 with a "
                      "figure, whose lines are solved with a hundredth")
    if arguments.material is not None:
        if "temperature" not in names:
            raise Refusal("--material: only with the figure temperature, or all")
        problem.material_of(arguments.material)
    elif names == ["temperature"]:
        raise Refusal("--material is missing: the figure temperature needs that of polyisobutylene")
    try:
        if not os.path.isdir(folder):
            os.mkdir(folder)
    except OSError:
        raise Refusal(f"--output = {folder[:200]}: must be a folder, or a new one in a folder that "
                      "there is") from None
    provenance.check_places(arguments, {"material": arguments.material or ()}, *(
        ("--output", os.path.join(folder, name + ending))
        for name in names for ending in (*_ROWS, *_DRAWN)))


class _Made:
    """A figure whose impacts the module batch solves: `arguments` of the batch, `cases` with their
    numbers before them, and for the record the `source` that they are made of."""

    def __init__(self, name, arguments, path):
        from restitute.paper import Figure

        own = {"input": None, "grid": None, "figure": None, "contours": False, "format": "csv",
               "output": path + ".csv", "method": arguments.method or "sync",
               "tolerance": arguments.tolerance or 1e-5,
               "given": {**arguments.given, "method": "--method", "tolerance": "--tolerance"}}
        for option in ("material", "output"):
            own["given"].pop(option, None)
        self.path, self.arguments = path, argparse.Namespace(**{**vars(arguments), **own})
        seed = 2017 if arguments.seed is None else arguments.seed
        self.figure = Figure(name, seed=seed, method=own["method"], tolerance=own["tolerance"])
        self.source = {"figure": name, "seed": seed}
        self.cases = self._cases(arguments.material)

    def _cases(self, material):
        from restitute.command.cases import Cases

        figure, count = self.figure, len(self.figure.curve)
        cells = {"curve": [str(curve) for curve in figure.curve]}
        if figure.aims:
            aims = {**figure.aims, "chi": [7 / 6] * count, "tau_T": figure.aims["tau"],
                    "ez_numbers": figure.expected.ez, "ex_numbers": figure.expected.ex}
            for key in ("chi", "psi", "delta1", "gamma", "tau_T", "ez_numbers", "ex_numbers"):
                cells[key] = [options.number_text(x) if x == x else "" for x in aims[key]]
        known, columns = {}, dict(figure.columns)
        if not figure.aims:
            columns["material"] = [material] * count
        for name, values in columns.items():
            field = problem.FIELDS.get(name)
            texts = list(values) if field is None else [
                options.number_text(x) if field.fits(x) else "" for x in values]
            if any(texts):
                known[name], cells[field.key if field else name] = len(cells), texts
        cases = Cases(list(cells), list(cells.values()))
        cases.known = known
        return cases

    def finish(self, done):
        """Draw and check what the batch has solved."""
        from types import SimpleNamespace

        from restitute.command import batch, files

        rows, name = done.rows, self.figure.name
        ez, ex, contact_time = rows.values[:3]
        self.figure.pairs = SimpleNamespace(ez=ez, ex=ex, contact_time=contact_time,
                                            flags=rows.flags(), status=rows.solved - 1)
        checks, ax = self.figure.checks(), self.figure.draw()
        files.write(*((path, files.image(ax, path)) for path in map(self.path.__add__, _DRAWN)))
        emit("\n  ".join([f"{name}: {self.figure.spec.title}", *map(str, checks)]) + "\n")
        failed = not all(check.good for check in checks)
        return max(done.report(), batch.FAILED if failed else batch.DONE)
