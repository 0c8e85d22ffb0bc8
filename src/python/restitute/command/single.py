# SPDX-License-Identifier: BSD-3-Clause
"""`restitute pair`: the restitution pair of one impact; of many by the module batch."""
import signal

from restitute.command import options, problem
from restitute.command.options import Refusal, number_text, say, shown
from restitute.errors import Error

_EPILOG = """One impact:
  restitute pair --chi 7/6 --psi 2 --delta1 1 --gamma 1
  restitute pair --material polyisobutylene --radius 0.005 --density 7800 --friction 0.3 \\
      --speed 0.05 --angle 30
Many, from a file or a grid:
  restitute pair --input cases.csv --output results.csv
  restitute pair --material polyisobutylene --radius 0.005 --density 7800 --friction 0.3 \\
      --grid speed=1e-4:0.05:9:log,angle=0:80:9 --output grid.csv --figure grid.svg

Columns of CASES.csv:
{columns}
rotation_blocked is 0 or 1. Options give the values of columns that are absent. A result row holds
the input columns, then ez, ex, contact_time, max_indentation (s and m; T and d0 if dimensionless),
radius_ratio (largest contact radius over R; in SI units), error_ez, error_ex, method and status,
which is empty or tells why the row failed. Provenance goes into FILE.meta.json.

ez, ex: minus the velocity after over the velocity before, normal and tangential, of the contact
point. Exit status: 0 done, 1 some rows failed, 2 bad usage or input, nothing written, 130
interrupted.
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
    options.add(group, "grid", "AXES", "one or two axes NAME=FROM:TO:N[:log], NAME of any number "
                "above, or material=FILE:FILE:...: all impacts of the grid, for example "
                "speed=0.1:10:9:log,angle=5:85:9")
    options.add(group, "output", "FILE", "write here and not to standard output")
    options.add_figure(group, "with --grid, or --input with one or two columns that vary: a figure")
    options.add_flag(group, "contours",
                     "with --figure: contours over both axes, the last one to the right")
    options.add(group, "threads", "N", "with --input and --grid: number of threads, 1 to 1024; "
                "default all processors", options.bounded(1, 1024, whole=True))
    options.add(group, "scheduler", "ADDRESS", "with --input and --grid: solve on the workers of "
                "this dask scheduler; needs dask.distributed")
    options.add_flag(group, "resume", "continue an interrupted run from FILE.partial")


def run(arguments):
    """Solve and write one impact, or hand many over to the module batch."""
    if arguments.input is not None or arguments.grid is not None:
        from restitute.command import batch

        return batch.run(arguments)
    from restitute.command import files, provenance

    for name, needs in (("figure", "--grid"), ("resume", "--input or --grid"),
                        ("contours", "--grid or --input, and --figure"),
                        ("threads", "--input or --grid"), ("scheduler", "--input or --grid")):
        if name in arguments.given:
            value = getattr(arguments, name)
            raise Refusal(f"--{name}{'' if value is True else f' = {value}'}: needs {needs}")
    import restitute

    result = solve(arguments, {"output": arguments.output}, restitute.pair, energies=True)
    write = {None: _text, "text": _text, "csv": _csv, "json": _json}[arguments.format]
    units = dict.fromkeys(("ez", "ex", "error_ez", "error_ex"), "1")
    units.update(_UNITS if result.impacts.kind == "scene" else _SCALES, work="nominal s")
    record = provenance.record(arguments, provenance.settings(arguments, {"input": None}), units)
    content = write(arguments, result.impacts, result, record)
    files.write(*([(arguments.output, content)] if arguments.format == "json" else
                  provenance.with_record(arguments.output, content, record)))
    return 0


def solve(arguments, outputs, function, **more):
    """What `restitute.pair` or `restitute.history` makes of the impact that the options describe.
    None of the outputs, by the names of their options, may be an input or another one."""
    import warnings

    from restitute.command import provenance

    values, place = problem.values_of(arguments), problem.place_of_options(arguments)
    keywords = problem.keywords(values, place)
    problem.impacts(keywords, place)
    provenance.check_places(arguments, values, *(
        (f"--{option}", path, ".meta.json") for option, path in outputs.items()))
    # Nothing is being written, and an impact may take long: signals end the process at once.
    with warnings.catch_warnings(), options.signals_are(signal.SIG_DFL):
        warnings.simplefilter("ignore")  # the message says the same of one impact
        try:
            made = function(**keywords, **{**problem.solution(arguments), **more})
        except Error as why:
            raise Refusal(problem.in_words_of(place, str(why))) from None
    message = getattr(made, "result", made).message()
    if message:
        say(f"remark: {message}")
    return made


_UNITS = {"contact_time": "s", "max_indentation": "m", "max_contact_radius": "m",
          "max_normal_force": "N", "element_spacing": "m", "time_step": "s"}
_SCALES = {"contact_time": "T", "max_indentation": "d0", "max_contact_radius": "a_el",
           "max_normal_force": "m v_z0^2/d0", "element_spacing": "a_el", "time_step": "T"}
_NUMBERS = ("chi", "psi", "delta1", "gamma", "delta2")


def _text(arguments, impact, result, record):
    numbers, ledger = impact.numbers(), result.ledger
    shown_numbers = "  ".join(f"{name} = {getattr(numbers, name):.6g}" for name in _NUMBERS
                              if getattr(numbers, name) == getattr(numbers, name))
    chi, ez = numbers.chi, result.ez
    critical = 2 * chi * (1 + ez) - ez if 2 * chi > 1 else 1.0  # (31)
    lines = [f"restitute {record['version']}: {shown(impact.describe())}",
             *_note(arguments, impact), "", "Restitution",
             f"  normal       ez = {result.ez:9.6f} +- {result.error_ez:.1e}",
             f"  tangential   ex = {result.ex:9.6f} +- {result.error_ex:.1e}"]
    if result.status:
        lines.append(f"  remark: {remark(result)}")
    lines += ["", "Impact", *_lengths(impact, result, numbers), *_limits(impact, result), "",
              "Dimensionless numbers", f"  {shown_numbers}",
              f"  slip lasts to the end of contact from psi = {critical:.6g} on", "",
              "Energy, as fractions of what came in",
              "              rebound    friction     viscous        left    residual",
              f"  normal     {ledger.rebound_z:8.5f}           -    {ledger.viscous_z:8.5f}    "
              f"{ledger.left_z:8.5f}    {ledger.residual_z:8.1e}",
              f"  tangential {ledger.rebound_x:8.5f}    {ledger.friction_x:8.5f}    "
              f"{ledger.viscous_x:8.5f}    {ledger.left_x:8.5f}    {ledger.residual_x:8.1e}",
              "", "Numerics", *_numerics(impact, result)]
    return "\n".join(lines) + "\n"


def _note(arguments, impact):
    """Which of the two bodies is of the material, where that was concluded."""
    if impact.kind == "scene" and not {"density", "mass", "partner"} & arguments.given.keys():
        yield (f"  taken: the sphere is of the material, {impact.solids[0].density:g} kg/m^3, and "
               "the partner rigid; if not, give --density")


def _lengths(impact, result, numbers):
    units = _UNITS if impact.kind == "scene" else _SCALES
    for label, name, scale in (("contact time", "contact_time", "time"),
                               ("largest indentation", "max_indentation", "length_z"),
                               ("largest contact radius", "max_contact_radius", "length_x"),
                               ("largest normal force", "max_normal_force", "force")):
        value, unit = getattr(result, name), getattr(numbers, scale)
        relative = f"   ({value / unit:.6g} {_SCALES[name]})" if unit > 0 else ""
        yield f"  {label:22} {value:<12.6g} {units[name]}{relative}"


def _limits(impact, result):
    """How far the scene strains the model, and what of it passes a limit, in words."""
    from restitute.impact import LIMITS

    if impact.kind != "scene":
        return
    yield from ("", "Model limits")
    labels = ("v_z0/wave speed", "contact radius/R", "slide/contact radius", "Dundurs' beta")
    for label, (flag, _, option, member, _) in zip(labels, LIMITS):
        limit = getattr(result.settings, option)
        yield f"  {label:22} {getattr(result, member):<12.3g} (limit {limit:g})"
        cost = result.soft_contact() if member == "radius_ratio" else ""
        cost = f": {cost}" if cost else ""
        yield from (f"    passed: {text}{cost}" for text in _flags(result.flags & flag))
    low, high = impact.solids[0].window
    if high < float("inf"):
        yield (f"  {'contact time':22} {result.contact_time:<12.3g} (measured from {low:.3g} to "
               f"{high:.3g} s)")
        yield from (f"    passed: {text}" for text in _flags(result.flags & 16))


def _flags(flags):
    """What the model neglects, of each flag."""
    from restitute import _library
    from restitute.impact import LIMITS

    text = _library.core.restitute_flag_text
    return [_library.text(text(bit)) for bit, *_ in LIMITS if flags & bit]


def _numerics(impact, result):
    units = _UNITS if impact.kind == "scene" else _SCALES
    return [f"  {'method':22} {result.method}, tolerance {result.settings.tolerance:g}",
            f"  {'elements':22} {result.elements}, spacing {result.element_spacing:.6g} "
            f"{units['element_spacing']}",
            f"  {'steps':22} {result.steps} of {result.time_step:.6g} {units['time_step']}",
            f"  {'work':22} {result.work:.3g} nominal seconds",
            f"  {'relaxation times merged':22} {result.terms_merged}, bound on their effect "
            f"{result.merging_bound:.1e}"]


def _csv(arguments, impact, result, record):
    """The options given become the input columns."""
    from restitute.command.cases import RESULTS, csv_row

    row = {problem.FIELDS[name].key if name in problem.FIELDS else name:
           "1" if value is True else value if isinstance(value, str) else number_text(value)
           for name, value in problem.values_of(arguments).items()}
    row.update((name, number_text(getattr(result, name))) for name in RESULTS[:-2]
               if name != "radius_ratio" or impact.kind == "scene")
    row.update(method=result.method, status=result.words()[()])
    return csv_row(row) + csv_row(row.values())


def _json(arguments, impact, result, record):
    from restitute.command import provenance

    def members(columns, names):
        return {name: provenance.of_number(getattr(columns, name).item()) for name in names}

    about = members(result, (
        "ez", "ex", "error_ez", "error_ex", *_UNITS, "work", "merging_bound", "speed_ratio",
        "radius_ratio", "displacement_ratio", "dundurs_beta", "elements", "steps", "terms_merged"))
    about.update(flags=_flags(result.flags), method=result.method, status=remark(result))
    return provenance.text({"meta": record, "scene": impact.describe(), "result": about,
                            "numbers": members(impact.numbers(), _NUMBERS),
                            "energy": members(result.ledger, dir(result.ledger))})


def remark(result):
    """What the library says of the status; empty if it is well."""
    from restitute import _library

    text = _library.core.restitute_status_text
    return _library.text(text(result.status)) if result.status else ""
