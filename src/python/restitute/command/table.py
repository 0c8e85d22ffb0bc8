# SPDX-License-Identifier: BSD-3-Clause
"""`restitute table`: build a table of restitution pairs, tell about it, look up in it."""
import re

from restitute.command import options, problem
from restitute.command.options import Refusal, bounded, emit, number_text, shown
from restitute.errors import Error

DONE, FAILED = 0, 1
_BUILD = """Example:
  restitute table build --material polyisobutylene --radius 0.005 --density 7800 --friction 0.3 \\
      --speed 1e-5:0.05 --output pib.h5

The errors are verified while the table is built. Exit status: 0 done, 1 the tolerance was not
reached (the table is written, with its errors), 2 bad usage, nothing written, 130 interrupted.
"""
_INFO = "Exit status: 0 done, 2 no such table, or damaged.\n"
_QUERY = """Example:
  restitute table query pib.h5 --normal-speed 0.05 --tangential-speed 0.02

Exit status: 0 done, 1 some rows failed, 2 bad usage or input, nothing written.
"""
_ACTIONS = """
  restitute table build --output FILE [OPTION...]   build a table of restitution pairs (ez, ex)
  restitute table info FILE                         what a table is, and its verified error
  restitute table query FILE [OPTION...]            look up one pair or many
"""
_SPEEDS = {"normal_speed": (0.0, 1e100), "tangential_speed": (-1e100, 1e100)}


def add(subparsers):
    """The parser of `restitute table`."""
    table = subparsers.add_parser("table", usage=_ACTIONS, epilog="restitute table build --help, "
                                  "and likewise for the others\n")
    actions = table.add_actions()
    build = actions.add_parser("build", usage="restitute table build --output FILE [OPTION...]",
                               epilog=_BUILD)
    problem.add_scene(build, skip=("speed", "angle", "spin", "spin2"))
    group = build.add_argument_group("The table")
    for name, metavar, help, read in (
            ("output", "FILE", "the table, an HDF5 file; required", None),
            ("speed", "FROM:TO", "normal speeds, m/s; default 1e-4:100", _read_range),
            ("tolerance", "ERROR", "largest error of ez and ex, in [1e-7, 0.1]; default 1e-5",
             bounded(1e-7, 0.1)),
            ("threads", "N", "number of threads, 1 to 1024; default all processors",
             bounded(1, 1024, whole=True)),
            ("max-impacts", "N", "limit of impacts for refinement; default 12000",
             bounded(1, 1e15, whole=True)),
            ("time-limit", "SECONDS", "limit of time for refinement, s; default 20, inf: no limit",
             bounded(1e-3, problem.INFINITY))):
        options.add(group, name, metavar, help, read)
    options.add_figure(group, "ez and ex, shaded beyond the limits of the model")
    info = actions.add_parser("info", usage="restitute table info FILE [OPTION...]", epilog=_INFO)
    info.add_argument("file", nargs="?", metavar="FILE", help="the table")
    options.add(info, "format", "text|json", "default text", options.one_of("text", "json"))
    query = actions.add_parser("query", usage="restitute table query FILE [OPTION...]",
                               epilog=_QUERY)
    query.add_argument("file", nargs="?", metavar="FILE", help="the table")
    for name, metavar, help, read in (
            ("normal-speed", "V", "normal speed, m/s, >= 0; required",
             bounded(*_SPEEDS["normal_speed"])),
            ("tangential-speed", "U", "sliding speed of the contact point, spin included, m/s; "
             "default 0", bounded(*_SPEEDS["tangential_speed"])),
            ("input", "CASES.csv", "many: columns normal_speed_m_s and tangential_speed_m_s; "
             "-: standard input", None),
            ("format", "text|csv", "default text; with --input csv", options.one_of("text", "csv")),
            ("output", "FILE", "write here and not to standard output", None)):
        options.add(query, name, metavar, help, read)


def _read_range(text, place):
    """FROM:TO, or one number; the library checks them."""
    try:
        low, colon, high = text.partition(":")
        return options.number(low), options.number(high if colon else low)
    except (ValueError, OverflowError):
        raise Refusal(f'{place} = "{text[:64]}": must be FROM:TO or one number') from None


def run(arguments):
    """Build, tell or look up."""
    from restitute import _library

    if not _library.available("table_files"):
        raise Refusal("table: this build has no component table_files, which needs HDF5")
    action = getattr(arguments, "action", None)
    if action is None:
        raise Refusal("table: an action is missing: build, info or query; see restitute table "
                      "--help")
    if action != "build" and arguments.file is None:
        raise Refusal(f"a table file is missing: restitute table {action} FILE")
    return {"build": _build, "info": _tell, "query": _query}[action](arguments)


# ------------------------------------------------------------------------------------------ build


def _build(arguments):
    import restitute
    from restitute.command import provenance
    from restitute.table import not_csv

    _check_output(arguments)
    values, place = problem.values_of(arguments), problem.place_of_options(arguments)
    values.pop("speed", None)
    if not values:
        raise Refusal("no table is described: give --material, or moduli, and a contact; see "
                      "--help")
    keywords = problem.keywords({**values, "speed": 1.0}, place)  # for the scene in words alone
    scene = re.sub(r": .* degrees, ", ": ", problem.impacts(keywords, place).describe())
    del keywords["speed"]
    provenance.check_places(arguments, values, ("--output", arguments.output),
                            ("--figure", arguments.figure))
    not_csv("--output", arguments.output)
    settings = {name: getattr(arguments, name) for name in
                ("tolerance", "max_impacts", "time_limit") if name in arguments.given}
    if arguments.speed:
        settings["speeds"] = arguments.speed
    try:
        table = restitute.Table.build(**keywords, **settings, threads=arguments.threads or 0)
    except Error as why:
        text = re.sub("^speeds", "speed", str(why))
        raise Refusal(problem.in_words_of(place, text)) from None
    table.save(arguments.output)
    info = table.info
    emit(f"{shown(scene)}\n{shown(arguments.output)}: errors {info.error_ez:.2g} (ez), "
         f"{info.error_ex:.2g} (ex), verified at {info.checks} places; {info.impacts} impacts "
         f"solved, {info.bytes / 1e6:.3g} MB\n" + "".join(f"{limit}\n" for limit in table.limits))
    if arguments.figure:
        _draw(table, arguments.figure)
    return FAILED if max(info.error_ez, info.error_ex) > info.tolerance else DONE


def _check_output(arguments):
    from restitute.command import files

    output, speed = arguments.output, arguments.speed
    if output is None:
        raise Refusal("--output is missing: the table's file")
    if files.is_stream(output):
        raise Refusal(f"--output = {output}: a table needs a file")
    if arguments.figure:
        options.need("matplotlib", "--figure")
        if speed and speed[0] >= speed[1]:
            raise Refusal("--figure: a table of one speed has no curves")


def _draw(table, path):
    from restitute import plot
    from restitute.command import files

    info = table.info
    axes = plot.sheet(2, "Restitution of one contact", origin=f"restitute {info.version}, table, "
                      f"errors {info.error_ez:.1e}, {info.error_ex:.1e}",
                      note=f"friction {info.friction:g}, effective radius {info.radius:g} m, mass "
                      f"{info.mass:g} kg; shaded: beyond the limits of the model")
    files.write((path, files.image(plot.table(table, ax=axes), path)))


# ------------------------------------------------------------------------------------------- info


def _tell(arguments):
    import restitute

    table = restitute.Table.load(arguments.file)
    emit(_as_json(table.info) if arguments.format == "json" else _as_text(table))
    return DONE


def _as_text(table):
    info = table.info
    rows = [("speed", f"{info.speed[0]:.6g} to {info.speed[1]:.6g} m/s"),
            ("chi", f"{info.chi:.6g}")]
    if info.gamma == info.gamma:
        rows += [("delta1", f"{info.delta1[0]:.6g} to {info.delta1[1]:.6g}"),
                 ("gamma", f"{info.gamma:.6g}")]
    rows += [("friction", f"{info.friction:g}"),
             ("radius, mass", f"{info.radius:g} m, {info.mass:g} kg (effective)"),
             ("tolerance", f"{info.tolerance:g}"),
             ("error", f"{info.error_ez:.2g} (ez), {info.error_ex:.2g} (ex), verified at "
              f"{info.checks} places"),
             ("limits", "; ".join(table.limits) or "none is passed"),
             ("impacts solved", f"{info.impacts}"),
             ("nodes", f"{info.speeds} speeds, {info.stick_cells} + {info.slip_cells} cells of "
              f"psi; {info.bytes / 1e6:.3g} MB"),
             ("built by", shown(info.version))]
    return "".join(f"{name:16} {text}\n" for name, text in rows)


def _as_json(info):
    """The members of the library's struct, those with a unit with it in their name."""
    from restitute.command import provenance

    units = {"radius": "_m", "mass": "_kg"}
    members = {}
    for name, value in vars(info).items():
        unit = "_m_s" if name.endswith("speed") else units.get(name, "")
        of = provenance.of_number
        members[name + unit] = [of(one) for one in value] if isinstance(value, tuple) else \
            of(value) if isinstance(value, float) else value
    return provenance.text(members)


# ------------------------------------------------------------------------------------------ query


def _query(arguments):
    import restitute

    table = restitute.Table.load(arguments.file)
    for name in _SPEEDS:
        if arguments.input is not None and name in arguments.given:
            raise Refusal(f"{arguments.given[name]}: not with --input, whose columns give the "
                          "values")
    if arguments.input is not None and arguments.format == "text":
        raise Refusal("--format = text: not with --input, which gives csv")
    return (_query_one if arguments.input is None else _query_many)(arguments, table)


def _query_one(arguments, table):
    from restitute.command import files, provenance

    normal, sliding = arguments.normal_speed, arguments.tangential_speed or 0.0
    if normal is None:
        raise Refusal("--normal-speed is missing")
    provenance.check_places(arguments, {}, ("--output", arguments.output), table=arguments.file)
    ez, ex = map(number_text, table.pair(normal, sliding))
    files.write((arguments.output, f"ez,ex\n{ez},{ex}\n" if arguments.format == "csv" else
                 f"ez = {ez}\nex = {ex}\n"))
    return DONE


def _query_many(arguments, table):
    import numpy as np

    from restitute.command import cases, files, provenance

    rows = cases.Table(arguments.input, rows_needed=False)
    status = np.full(len(rows.lines), "", object)
    speeds = [_column(rows, name, status) for name in _SPEEDS]
    provenance.check_places(arguments, {}, ("--output", arguments.output), table=arguments.file)
    good = status == ""
    normal, sliding = (speed[good] for speed in speeds)
    results = np.full((2, len(good)), "", object)
    for texts, values in zip(results, table.pair(normal, sliding)):
        texts[good] = [number_text(value) for value in values.tolist()]
    files.write((arguments.output, "".join(map(cases.csv_row, (
        [*rows.names, "ez", "ex", "status"], *zip(*rows.cells, *results, status))))))
    return DONE if good.all() else FAILED


def _column(rows, name, status):
    """The numbers of a column; why a cell is refused goes into `status`."""
    import numpy as np

    from restitute.command import cases

    (low, high), column = _SPEEDS[name], f"{name}_m_s"
    if column not in rows.names:
        if name == "normal_speed":
            raise Refusal(f"{rows.source}: the column {column} is missing")
        return np.zeros(len(status))
    cells = rows.cells[rows.names.index(column)]
    values, reasons = cases.numbers(cells, options.number)
    for i in np.flatnonzero(~((values >= low) & (values <= high)) & (status == "")):
        why = f"{reasons[cells[i]]}: must be in" if cells[i] in reasons else "is out of its range,"
        status[i] = f'{column} = "{cells[i][:64]}" {why} [{low:g}, {high:g}]'
    return values
