# SPDX-License-Identifier: BSD-3-Clause
"""`restitute fit`: material constants from measured impacts or a DMA curve."""
import re
from types import SimpleNamespace

from restitute.command import options, problem
from restitute.command.options import Refusal, bounded, number, number_text, one_of, say, shown

DONE, FAILED = 0, 1
_EPILOG = """Examples:
  restitute fit --input drop.csv --radius 0.01 --density 7800 --output rubber.json \\
      --figure rubber.svg
  restitute fit --dma curve.csv --output rubber.json

Columns of DROP.csv: ez, or rebound_height_m, or rebound_ratio (of rebound to drop height, the
square of ez); speed_m_s, or drop_height_m; and optional ex, angle_deg, contact_time_s,
temperature_c, weight, sigma_ez, sigma_ex, sigma_contact_time_s, friction, partner, radius_m,
mass_kg, density_kg_m3 and the others of restitute pair. With ex and without friction, friction is
fitted. Columns of CURVE.csv: frequency_hz, storage_pa, loss_pa and optional temperature_c.

Exit status: 0 done, 1 done, but the data do not follow the model or leave constants open (remarks
say which), 2 bad usage or input, nothing written, 130 interrupted.
"""
# Columns that are no fields of a scene, and the keywords of fit_drop_test and fit_dma.
_DROP = {"ez": "ez", "ex": "ex", "contact_time_s": "contact_time", "sigma_ez": "sigma_ez",
         "sigma_ex": "sigma_ex", "sigma_contact_time_s": "sigma_contact_time", "weight": "weight",
         "drop_height_m": "drop_height", "rebound_height_m": "rebound_height",
         "rebound_ratio": "rebound_ratio", "temperature_c": "temperature"}
_CURVE = {"frequency_hz": "frequency", "storage_pa": "storage", "loss_pa": "loss",
          "temperature_c": "temperature"}
# What an empty cell of a column of the scene stands for; of others none may be empty.
_NEUTRAL = {"radius2": problem.INFINITY, "mass2": problem.INFINITY, "density2": problem.INFINITY,
            "inertia": 0.0, "inertia2": 0.0, "spin": 0.0, "spin2": 0.0}
_SCENE = tuple(name for name in problem.SI if name not in problem.SOLID)
_OF_DROPS = ("model", "terms", "known", "loss", "confidence", "starts", "seed", "threads")


def add(subparsers):
    """The parser of `restitute fit`."""
    parser = subparsers.add_parser("fit", usage="restitute fit --input DROP.csv|--dma CURVE.csv "
                                   "[OPTION...]", epilog=_EPILOG)
    group = parser.add_argument_group("Input and output")
    add_all(group, (
        ("input", "DROP.csv", "measured impacts, one a row, columns by name", None),
        ("dma", "CURVE.csv", "instead: storage and loss modulus over frequency", None),
        ("name", "TEXT", "name in the material file; default that of the input", None),
        ("output", "FILE.json", "the material file, and all numbers in FILE.json.meta.json", None),
        ("figure", "FILE", "data, fit and residuals, .svg, .png or .pdf; needs matplotlib",
         options.ending(".svg", ".png", ".pdf"))))
    group = parser.add_argument_group("The scene of all impacts")
    problem.add_fields(group, [name for name in _SCENE if name != "speed"])
    options.add(group, "partner", "rigid|same|FILE|NAME", "one of the two bodies deforms "
                "(default), both do and are of the solid, or the material of the partner",
                problem.read_partner)
    options.add_flag(group, "rotation-blocked", "the spheres cannot rotate")
    group = parser.add_argument_group("The fit")
    problem.add_fields(group, ["poisson_ratio"])
    add_all(group, (
        ("model", "NAME", "elastic, kelvin_voigt, standard_solid (default), maxwell or prony",
         one_of("elastic", "kelvin_voigt", "standard_solid", "maxwell", "prony")),
        ("terms", "TAU,...", "relaxation times of the model prony, s, 1 to 20", _read_terms),
        ("known", "NAME=VALUE,...", "constants that are not fitted: modulus1, modulus2, modulus, "
         "viscosity; equilibrium, term1, term2, ...; in place of modulus1, modulus or equilibrium "
         "also youngs_modulus, E = 2 (1+nu) G, and shore_a, of which Gent (1958) makes E (see "
         "restitute pair)", _read_known),
        ("loss", "squares|huber|cauchy", "how large residuals count; default squares",
         one_of("squares", "huber", "cauchy")),
        ("confidence", "P", "of the intervals, in [0.5, 0.999]; default 0.95", bounded(0.5, 0.999)),
        ("reference-temperature", "T", "in C, of the constants; default that of the first row",
         bounded(-273.15, 1e4)),
        ("wlf", "C1:C2", "shifts of times by temperature; default: a free shift a temperature",
         _read_wlf),
        ("noise", "RATIO", "with --dma: relative error of the moduli, in [1e-4, 0.5]; default 0.01",
         bounded(1e-4, 0.5)),
        ("starts", "N", "local fits, 1 to 100; default 5, or 8 where residuals are large",
         bounded(1, 100, whole=True)),
        ("seed", "N", "of the scan for starts; default 1", bounded(0, 2**32 - 1, whole=True)),
        ("threads", "N", "1 to 1024; default 1, all processors from 200 rows on",
         bounded(1, 1024, whole=True))))
    options.add_flag(group, "tension", "with --dma: the moduli are those of tension")


def add_all(group, table):
    """Options of rows (name, metavar, help, reader)."""
    for row in table:
        options.add(group, *row)


def _read_terms(text, place):
    times = [bounded(1e-30, 1e30)(item, place) for item in text.split(",")]
    if len(times) > 20:
        raise Refusal(f"{place}: more than 20 relaxation times")
    return times


def _read_known(text, place):
    known = {}
    for item in text.split(","):
        name, equals, value = item.partition("=")
        if name in known:
            raise Refusal(f"{place}: {name} is given twice")
        if not equals:
            raise Refusal(f'{place}: "{item[:40]}" is no NAME=VALUE; see --help')
        known[name] = bounded(0, 1e30)(value, f"{place}: {name}")
    return known


def _read_wlf(text, place):
    try:
        c1, c2 = map(number, text.split(":"))
        if 0 <= c1 <= 1e6 and 1e-6 <= c2 <= 1e6:
            return c1, c2
    except (ValueError, OverflowError):
        pass
    raise Refusal(f'{place} = "{text[:64]}": must be C1:C2, two positive numbers')


def run(arguments):
    """Fit, and write report, material file and figure."""
    from restitute import _library

    if not _library.available("fit"):
        raise Refusal("fit: this build has no component fit, which needs GSL")
    _check_kind(arguments)
    done = (_fit_drops if arguments.dma is None else _fit_curve)(arguments)
    _write(arguments, done)
    for remark in done.fit.remarks:
        say(f"remark: {remark}")
    return DONE if done.fit.is_good else FAILED


def _check_kind(arguments):
    """Options of the other kind of input would be passed over without a word."""
    given = arguments.given
    if ("input" in given) == ("dma" in given):
        raise Refusal("give --input, measured impacts, or --dma, a curve of moduli; see --help")
    if "input" in given and ("tension" in given or "noise" in given):
        raise Refusal("--tension, --noise: need --dma")
    for name in (*_OF_DROPS, *_SCENE, "partner", "rotation_blocked") if "dma" in given else ():
        if name in given:
            raise Refusal(f"{given[name]}: not with --dma")
    if arguments.output and not arguments.output.endswith(".json"):
        raise Refusal(f"--output = {arguments.output}: a material file must end in .json")


# ------------------------------------------------------------------------------------------ input


class _Rows:
    """A table of measurements.

    Attributes
    ----------
    numbers : dict of str to ndarray
        The columns `known`, by their keywords; nan where a cell is empty.
    called : dict of str to str
        What the file calls a column, by its keyword or name.
    rest : list of int
        The other columns.
    """

    def __init__(self, path, known):
        from restitute.command import cases

        self.source = "standard input" if path == "-" else path
        self.content = cases.read_bytes(path)
        self.table = cases.Table(self.content, self.source)
        if not self.table.lines:
            raise Refusal(f"{self.source}: has column names but no rows")
        self.numbers, self.called, self.rest = {}, {}, []
        for i, column in enumerate(self.table.names):
            keyword = known.get(column.casefold())
            if keyword is None:
                self.rest.append(i)
                continue
            if keyword in self.numbers:
                raise Refusal(f"{self.source}: columns {self.called[keyword]} and {column} are the "
                              "same")
            self.called[keyword], self.numbers[keyword] = column, self._read(column, i)

    def _read(self, column, i):
        import numpy as np

        from restitute.command import cases

        cells = self.table.cells[i]
        values, reasons = cases.numbers([cell or "0" for cell in cells], number)
        for row, cell in enumerate(cells):
            if cell in reasons:
                why = f" ({reasons[cell]})" if reasons[cell] else ""
                raise self.refuse(row, f'{column} = "{cell[:64]}" is not a number{why}')
        return np.where([cell == "" for cell in cells], np.nan, values)

    def refuse(self, row, text):
        """A Refusal that names a row."""
        return Refusal(f"{self.source} line {self.table.lines[row]} (row {row + 1}): {text}")

    def in_words(self, why):
        """What the library says of points[i] or row[i], of the line and the column of the file."""
        text = str(why)
        found = re.fullmatch(r"(?:points|row)\[(\d+)\][.: ]*(\w*)(.*)", text, re.S)
        if found is None:
            return Refusal(f"{self.source}: {problem.in_words_of(self.place, text)}")
        return self.refuse(int(found[1]), self.place(found[2]) + found[3])

    def place(self, name):
        """What the file calls a field or a measured value."""
        return self.called.get(name, name)

    def check_temperature(self, arguments):
        """Options of temperatures need the column."""
        if "temperature" not in self.numbers and {"wlf", "reference_temperature"} & \
                arguments.given.keys():
            raise Refusal(f"--wlf, --reference-temperature: {self.source} has no column "
                          "temperature_C")


def _scene(rows, arguments):
    """The keywords of the scene: what options give, and columns."""
    from restitute.command import cases
    import numpy as np

    given = {name: value for name, value in problem.values_of(arguments).items()
             if name in (*_SCENE, "partner", "rotation_blocked")}
    names = [rows.table.names[i] for i in rows.rest]
    scene = cases.Cases(names, [rows.table.cells[i] for i in rows.rest] or [rows.table.lines],
                        rows.source, rows.table.lines)
    for i, column in enumerate(names):
        field = problem.field_of_column(column)
        name = field.name if field else column.casefold()
        if name not in (_SCENE if field else ("partner", "rotation_blocked")):
            similar = problem.similar_column(column) or options.did_you_mean(column, _DROP)
            raise Refusal(f'{rows.source}: unknown column "{column[:40]}"; known are listed by '
                          f"--help{similar}")
        if name in given:
            raise rows.refuse(0, f"column {column} and option {arguments.given[name]} both give "
                              "the value")
        scene.known[name], rows.called[name] = i, column
    scene.read()
    if scene.reasons:
        row = min(scene.reasons)
        raise rows.refuse(row, scene.reasons[row])
    values = {name: np.full(scene.rows, _NEUTRAL.get(name, np.nan), object)
              for name in scene.known}
    for some, found in scene.values(0, scene.rows, {}):
        for name in scene.known:
            if name in found:
                values[name][some] = found[name]
            elif name not in _NEUTRAL:
                raise rows.refuse(some[0], f"{rows.called[name]} is empty: "
                                  f"{problem.FIELDS[name].allowed}")
    given.update((name, column if name == "partner" else column.astype(float))
                 for name, column in values.items())
    return given


def _partner(words):
    """Materials in place of names."""
    import numpy as np

    def opened(word):
        return word if word in ("rigid", "same") else problem.material_of(word)

    return opened(words) if isinstance(words, str) else np.frompyfunc(opened, 1, 1)(words)


# ------------------------------------------------------------------------------------------- fits


def _name(arguments, path):
    import os

    return arguments.name if arguments.name is not None else os.path.basename(path)


def _check_outputs(arguments, rows, partners):
    """No output is an input, and all can be written, before the work is done."""
    from restitute.command import files, provenance

    places = files.Places()
    places.read("--input", arguments.input)
    places.read("--dma", arguments.dma)
    for word in partners:
        provenance.read_materials(places, {"partner": word})
    if arguments.output:
        files.check(arguments.output, "--output")
        places.write("--output", arguments.output, ".meta.json")
    if arguments.figure:
        files.check(arguments.figure, "--figure")
        options.need("matplotlib", "--figure")
        places.write("--figure", arguments.figure)
    places.check()


def _fit_drops(arguments):
    import os

    import numpy as np

    import restitute
    from restitute.errors import Error

    rows = _Rows(arguments.input, _DROP)
    scene = _scene(rows, arguments)
    if "speed" not in scene and "drop_height" not in rows.numbers:
        raise Refusal(f"{rows.source}: column speed_m_s (or drop_height_m) is missing")
    if not rows.numbers.keys() & {"ez", "rebound_height", "rebound_ratio", "ex", "contact_time"}:
        raise Refusal(f"{rows.source}: column ez (or rebound_height_m, rebound_ratio, ex, "
                      "contact_time_s) is missing")
    if "weight" in rows.numbers and any(name.startswith("sigma_") for name in rows.numbers):
        raise Refusal(f"{rows.source}: columns weight and sigma_...: give one kind")
    rows.check_temperature(arguments)
    words = scene.get("partner", "rigid")
    _check_outputs(arguments, rows, {words} if isinstance(words, str) else set(words))
    count = len(rows.table.lines)
    settings = {name: getattr(arguments, name) for name in (
        "model", "terms", "loss", "confidence", "reference_temperature", "wlf", "starts", "seed",
        "poisson_ratio") if getattr(arguments, name) is not None}
    settings["threads"] = arguments.threads or (
        1 if count < 200 else len(os.sched_getaffinity(0)))
    if "weight" in rows.numbers:
        weight = rows.numbers["weight"]
        rows.numbers["weight"] = np.where(np.isnan(weight), 1.0, weight)
    try:
        fit = restitute.fit_drop_test(
            **{**rows.numbers, **scene, "partner": _partner(words)}, **settings,
            known=_known(arguments), name=_name(arguments, rows.source), progress=_progress())
    except (Error, TypeError) as why:
        raise rows.in_words(why) from None
    finally:
        _progress()(None)
    correlation = fit.correlation
    quality = (f"rms of the residuals of {fit.values} values {fit.rms:.3g}, noise {fit.noise:.3g}; "
               f"{fit.rank} constants or combinations of them determined, intervals of "
               f"{100 * (arguments.confidence or 0.95):g} %; {fit.impacts} impacts solved")
    numbers = {"confidence": arguments.confidence or 0.95, "correlation": correlation.tolist(),
               "values": fit.values, "rank": fit.rank, "rms": fit.rms, "noise": fit.noise,
               "condition": fit.condition, "flags": fit.flags}
    density = arguments.density if isinstance(words, str) and words == "same" else None
    return SimpleNamespace(fit=fit, rows=rows, quality=quality, numbers=numbers, density=density,
                           constants=list(zip(fit.names, fit.value, fit.low, fit.high)),
                           correlation=correlation, drawn=dict)


def _known(arguments):
    """The known constants, with a shear modulus in place of E or hardness."""
    from restitute import shear_modulus
    from restitute.fitting import MODELS

    known, nu = dict(arguments.known or {}), arguments.poisson_ratio
    model = arguments.model or "standard_solid"
    for name, keyword in (("youngs_modulus", "youngs"), ("shore_a", "shore_a")):
        if name in known:
            modulus = MODELS[model][0]
            if modulus in known:
                raise Refusal(f"--known: {modulus} and {name} are both given")
            known[modulus] = float(shear_modulus(**{keyword: known.pop(name)},
                                                 poisson_ratio=0.5 if nu is None else nu))
    allowed = [*MODELS[model], *(f"term{k + 1}" for k in range(len(arguments.terms or ())))]
    for name in known:
        if name not in allowed:
            raise Refusal(f'--known: "{name[:40]}" is no constant of this model: must be one of '
                          f"{options.listed(allowed)}")
    if (model == "prony") != bool(arguments.terms):
        raise Refusal("--terms and --model prony belong together")
    return known


def _progress():
    """A function that shows the part done on a terminal; None: the line is wiped."""
    import os

    if not os.isatty(2):
        return lambda done: None
    return lambda done: options.write_all(
        2, "\r\x1b[K" if done is None else f"\rfit: {100 * done:.0f} %")


def _fit_curve(arguments):
    import restitute
    from restitute.errors import Error

    rows = _Rows(arguments.dma, _CURVE)
    for i in rows.rest:
        similar = options.did_you_mean(rows.table.names[i], _CURVE)
        raise Refusal(f'{rows.source}: unknown column "{rows.table.names[i][:40]}"; known are '
                      f"listed by --help{similar}")
    for column in ("frequency_Hz", "storage_Pa", "loss_Pa"):
        if _CURVE[column.casefold()] not in rows.numbers:
            raise Refusal(f"{rows.source}: column {column} is missing")
    rows.check_temperature(arguments)
    _check_outputs(arguments, rows, ())
    settings = {name: getattr(arguments, name) for name in (
        "reference_temperature", "wlf", "noise", "poisson_ratio")
        if getattr(arguments, name) is not None}
    try:
        fit = restitute.fit_dma(**rows.numbers, **settings, tension=arguments.tension,
                                name=_name(arguments, rows.source))
    except Error as why:
        raise rows.in_words(why) from None
    constants = [("equilibrium_modulus_pa", fit.equilibrium_modulus)]
    constants += [(f"modulus_pa[tau={tau:.6g}]", modulus) for tau, modulus in
                  zip(fit.relaxation_time, fit.modulus)]
    constants += [(f"shift_{t:g}", shift) for t, shift in zip(fit.temperature, fit.shift)]
    constants += [(f"wlf_c{k + 1}", c) for k, c in enumerate(fit.wlf) if c == c]
    return SimpleNamespace(
        fit=fit, rows=rows, density=None, correlation=(), numbers={
            "rms": fit.rms, "worst": fit.worst, "flags": fit.flags},
        constants=[(*constant, float("nan"), float("nan")) for constant in constants],
        quality=f"Prony series of {fit.modulus.size} terms, relative residuals: rms {fit.rms:.3g}, "
        f"largest {fit.worst:.3g}", drawn=lambda: _curve(arguments, fit, rows.numbers))


# ----------------------------------------------------------------------------------------- output


def _write(arguments, done):
    """Material file with its record, figure, and the report at last: all of them or none."""
    from restitute.command import files, provenance

    outputs, model = [], done.fit.model
    if arguments.output:
        constants = [dict(zip(("name", "value", "low", "high"), (
            name, *map(provenance.of_number, numbers)))) for name, *numbers in done.constants]
        fit = {"model": model, "constants": constants, "remarks": done.fit.remarks,
               **{name: provenance.of_number(value) if isinstance(value, float) else value
                  for name, value in done.numbers.items()}}
        import restitute

        settings = {"version": restitute.version(), "input": done.rows.source,
                    "fingerprint": provenance.fingerprint(done.rows.content)}
        record = provenance.record(arguments, settings, {}, fit=fit)
        outputs += [(arguments.output, provenance.text(_material_file(done))),
                    (files.beside(arguments.output, ".meta.json"), provenance.text(record))]
    if arguments.figure:
        outputs.append((arguments.figure, _figure(arguments.figure, done)))
    files.write(*outputs, (None, _report(done)))


def _material_file(done):
    """The file that every other command reads."""
    import restitute

    material, model = done.fit.material, done.fit.model
    source = f"restitute {restitute.version()} fit of {done.rows.source[:200]}: {done.quality}"
    content = {"name": material.name[:127], "source": source[:511], "model": model,
               "poisson_ratio": material.poisson_ratio}
    if done.density is not None:
        content["density_kg_m3"] = done.density
    series = material.series
    if model == "prony":
        content["terms"] = [{"tau_s": tau, "modulus_pa": modulus} for tau, modulus in
                            zip(series.relaxation_time.tolist(), series.modulus.tolist())]
        content["equilibrium_modulus_pa"] = series.equilibrium_modulus
    else:
        content.update((name, float(value)) for name, value, *_ in done.constants
                       if "modulus" in name or "viscosity" in name)
    return content


def _report(done):
    lines = [f"{shown(done.rows.source)}: {done.fit.model}", ""]
    for name, value, low, high in done.constants:
        ends = "" if low != low else " known" if low == high else \
            f" {low:.6g} to {high:.6g}" if 0 < low and high < problem.INFINITY else \
            f" above {low:.6g}" if low > 0 else \
            f" below {high:.6g}" if high < problem.INFINITY else " not determined"
        lines.append(f"  {name:26} {value:<13.6g}{ends}")
    for i, row in enumerate(done.correlation):
        if i == 1:
            lines += ["", "  correlations of the logarithms"]
        if i:
            lines.append(f"  {done.constants[i][0]:26} " + " ".join(f"{c:6.3f}" for c in row[:i]))
    return "\n".join([*lines, "", f"  {done.quality}", ""])


def _curve(arguments, fit, numbers):
    """What plot.fit draws: shear moduli."""
    factor = 1 / (2 * (1 + fit.material.poisson_ratio)) if arguments.tension else 1
    return {**{name: factor * numbers[name] for name in ("storage", "loss")},
            **{name: numbers.get(name) for name in ("frequency", "temperature")}}


def _figure(path, done):
    import io
    import os

    import restitute
    from restitute import plot

    note = ",  ".join(f"{name} = {number_text(float(f'{value:.4g}'))}" for name, value, *_ in
                      done.constants[:6])
    axes = plot.sheet(2, f"{done.fit.material.name[:100]}: {done.fit.model}", note,
                      f"restitute {restitute.version()} fit")
    plot.fit(done.fit, **done.drawn(), ax=axes)
    image = io.BytesIO()
    plot.save(axes, image, os.path.splitext(path)[1][1:].lower())
    return image.getvalue()
