# SPDX-License-Identifier: BSD-3-Clause
"""`restitute pair`: the restitution pair of one impact; of many by the module batch."""
from restitute.command import options, problem

_EPILOG = """One impact:
  restitute pair --chi 7/6 --psi 2 --delta1 1 --gamma 1
  restitute pair --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 --speed 1 --angle 30
Many, from a file or a grid:
  restitute pair --input cases.csv --output results.csv
  restitute pair --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 \\
      --grid speed=0.1:10:9:log,angle=5:85:9 --output grid.csv --figure grid.svg

Columns of CASES.csv:
{columns}
Options give the values of columns that are absent. A result row holds the input columns, then ez, ex,
contact_time, max_indentation (s and m; T and d0 if dimensionless), error_ez, error_ex, method and status,
which is empty or tells why the row failed. Provenance goes into FILE.meta.json.

ez, ex: minus the velocity after over the velocity before, normal and tangential, of the contact point.
Exit status: 0 done, 1 some rows failed, 2 bad usage or input, nothing written, 130 interrupted.
"""


def add(subparsers):
    """The parser of `restitute pair`."""
    columns = [*(field.key for field in problem.FIELDS.values()), *problem.WORDS]
    lines = ["  " + ", ".join(columns[i:i + 6]) for i in range(0, len(columns), 6)]
    parser = subparsers.add_parser("pair", usage="restitute pair [OPTION...]",
                                   epilog=_EPILOG.replace("{columns}", ",\n".join(lines)))
    problem.add_impact(parser)
    problem.add_solution(parser)
    group = parser.add_argument_group("Input and output")
    options.add(group, "format", "text|csv|json", "default text for one impact, csv for many",
                options.one_of("text", "csv", "json"))
    options.add(group, "input", "CASES.csv", "one impact a row, columns by name; -: standard input")
    options.add(group, "grid", "AXES",
                "one or two axes NAME=FROM:TO:N[:log], NAME of any number above, or material=FILE:FILE:...: all "
                "impacts of the grid, for example speed=0.1:10:9:log,angle=5:85:9")
    options.add(group, "output", "FILE", "write here and not to standard output")
    options.add(group, "figure", "FILE",
                "with --grid, or --input with one or two columns that vary: a figure of it, .svg, .png or .pdf; needs "
                "matplotlib")
    options.add_flag(group, "contours", "with --figure: contours over both axes, the last one to the right")
    options.add(group, "threads", "N",
                "with --input and --grid: number of threads, 1 to 1024; default all processors",
                options.bounded(1, 1024, whole=True))
    options.add(group, "scheduler", "ADDRESS",
                "with --input and --grid: solve on the workers of this dask scheduler; needs dask.distributed")
    options.add_flag(group, "resume", "continue an interrupted run from FILE.partial")


def run(arguments):
    """Solve and write one impact, or hand many over to the module batch."""
    if arguments.input is not None or arguments.grid is not None:
        from restitute.command import batch

        return batch.run(arguments)
    import restitute

    keywords = problem.keywords(problem.values_of(arguments), problem.place_of_options(arguments))
    result = restitute.pair(**keywords, **problem.solution(arguments))
    options.emit(f"ez = {result.ez:9.6f} +- {result.error_ez:.1e}\nex = {result.ex:9.6f} +- {result.error_ex:.1e}\n")
    return 0
