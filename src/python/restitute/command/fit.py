# SPDX-License-Identifier: BSD-3-Clause
"""`restitute fit`: material constants from measured impacts or a DMA curve."""
import os
import warnings

from restitute.command import options, problem
from restitute.command.options import Refusal, bounded, number, one_of, say, shown

DONE, FAILED = 0, 1
_EPILOG = """Examples:
  restitute fit --input drop.csv --radius 0.01 --density 1100 --output rubber.json \\
      --figure rubber.svg
  restitute fit --dma curve.csv --output rubber.json

Columns of DROP.csv: ez, or rebound_height_m, or rebound_ratio (of rebound to drop height, the
square of ez); speed_m_s, or drop_height_m; and optional ex, angle_deg, contact_time_s,
temperature_c, weight, sigma_ez, sigma_ex, sigma_contact_time_s, friction, partner, radius_m,
mass_kg, density_kg_m3 and the others of restitute pair. With ex and without friction, friction is
fitted. Columns of CURVE.csv: frequency_hz, storage_pa, loss_pa and optional temperature_c.

FILE.json has the constants, the window of times of the data, and the density of the sphere, which
is taken to be of the fitted solid: if the wall is what deforms, give --mass and not --density.
With --dma, --density is that of the solid.

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
_OF_DROPS = ("model", "terms", "known", "loss", "confidence", "starts", "seed", "threads")
_OF_BOTH = ("poisson_ratio", "reference_temperature", "wlf")


def add(subparsers):
    """The parser of `restitute fit`."""
    parser = subparsers.add_parser("fit", usage="restitute fit --input DROP.csv|--dma CURVE.csv "
                                   "[OPTION...]", epilog=_EPILOG)
    group = parser.add_argument_group("Input and output")
    for row in (
            ("input", "DROP.csv", "measured impacts, one a row, columns by name"),
            ("dma", "CURVE.csv", "instead: storage and loss modulus over frequency"),
            ("name", "TEXT", "name in the material file; default that of the input"),
            ("output", "FILE.json", "the material file, and all numbers in FILE.json.meta.json",
             options.ending(".json"))):
        options.add(group, *row)
    options.add_figure(group, "data, fit and residuals")
    group = parser.add_argument_group("The scene of all impacts")
    own = {"density": "density of the sphere, kg/m^3; this or --mass; with --dma of the solid",
           "friction": "coefficient of friction, on which only ex depends; inf: no slip; default: "
           "fitted to the column ex"}
    for name in problem.SCENE:
        field = problem.FIELDS[name]
        if name != "speed":
            options.add(group, field.option[2:], "NUMBER", own.get(name, field.help), field.read,
                        also=field.older)
    options.add(group, "partner", "rigid|same|FILE|NAME", "one of the two bodies deforms "
                "(default), both do and are of the solid, or the material of the partner",
                problem.read_partner)
    options.add_flag(group, "rotation-blocked", "the spheres cannot rotate")
    group = parser.add_argument_group("The fit")
    problem.add_fields(group, ["poisson_ratio"])
    for row in (
            ("model", "NAME", "elastic, kelvin_voigt, standard_solid (default), maxwell or prony",
             one_of("elastic", "kelvin_voigt", "standard_solid", "maxwell", "prony")),
            ("terms", "TAU,...", "relaxation times of the model prony, s (not how many: 1e-4,1e-2 "
             "are two terms), 1 to 20", _read_terms),
            ("known", "NAME=VALUE,...", "constants that are not fitted: modulus1, modulus2, "
             "modulus, viscosity; equilibrium, term1, term2, ...; in place of the first also "
             "youngs_modulus, E = 2 (1+nu) G, and shore_a, of which Gent (1958) makes E (see "
             "restitute pair)", _read_known),
            ("loss", "squares|huber|cauchy", "how large residuals count; default squares",
             one_of("squares", "huber", "cauchy")),
            ("confidence", "P", "of the intervals, in [0.5, 0.999]; default 0.95",
             bounded(0.5, 0.999)),
            ("reference-temperature", "T", "in C, of the constants; default that of the first row",
             bounded(-273.15, 1e4)),
            ("wlf", "C1:C2", "shifts of times by temperature; default: a free shift a temperature",
             _read_wlf),
            ("noise", "RATIO", "with --dma: relative error of the moduli, in [1e-4, 0.5]; default "
             "0.01", bounded(1e-4, 0.5)),
            ("starts", "N", "local fits, 1 to 100; default 5, or 8 where residuals are large",
             bounded(1, 100, whole=True)),
            ("seed", "N", "of the scan for starts; default 1", bounded(0, 2**32 - 1, whole=True)),
            ("threads", "N", "1 to 1024; default 1, all processors from 200 rows on",
             bounded(1, 1024, whole=True))):
        options.add(group, *row)
    options.add_flag(group, "tension", "with --dma: the moduli are those of tension")


def _read_terms(text, place):
    if text.isdecimal():
        raise Refusal(f"{place} = {text}: must be relaxation times, s, not how many, as 1e-4,1e-2 "
                      f"({text}.0 for one of {text} s)")
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
    from restitute.command import measured
    from restitute.errors import ModelLimitWarning

    if not _library.available("fit"):
        raise Refusal("fit: this build has no component fit, which needs GSL")
    _check_kind(arguments.given)
    warnings.simplefilter("ignore", ModelLimitWarning)  # a remark of the fit
    path = arguments.input or arguments.dma
    if arguments.name is None:
        arguments.name = os.path.basename(path)
    rows = measured.Rows(path, _DROP if arguments.input else _CURVE)
    others, option = (_CURVE, "--dma") if arguments.input else ({**_DROP, "speed_m_s": ""},
                                                                "--input")
    for column in (rows.table.names[i] for i in rows.rest):
        if column.casefold() in others:
            raise Refusal(f"{rows.source}: column {column} is one of {option}: give {option} "
                          f"{rows.source}")
    if "temperature" not in rows.numbers and {"wlf", "reference_temperature"} & \
            arguments.given.keys():
        raise Refusal(f"--wlf, --reference-temperature: {rows.source} has no column temperature_C")
    if arguments.input:
        fit = _fit_drops(rows, measured.scene_of(rows, arguments), arguments)
    else:
        fit = _fit_curve(rows, arguments)
    fit.material.source = fit.origin(rows.source)
    _write(arguments, rows, fit)
    for remark in fit.remarks:
        say(f"remark: {remark}")
    return DONE if fit.is_good else FAILED


def _check_kind(given):
    """Options of the other kind of input would be passed over without a word."""
    if ("input" in given) == ("dma" in given):
        raise Refusal("give --input, measured impacts, or --dma, a curve of moduli; see --help")
    if "input" in given and ("tension" in given or "noise" in given):
        raise Refusal("--tension, --noise: need --dma")
    for name in (*_OF_DROPS, *problem.SCENE, *problem.WORDS) if "dma" in given else ():
        if name in given and name != "density":
            raise Refusal(f"{given[name]}: not with --dma")


def _check_outputs(arguments, partners=()):
    """No output is an input, and all can be written, before the work is done."""
    from restitute.command import provenance

    provenance.check_places(arguments, {"partner": partners}, (
        "--output", arguments.output, ".meta.json"), ("--figure", arguments.figure))
    if arguments.figure is not None:
        options.need("matplotlib", "--figure")


# ------------------------------------------------------------------------------------------- fits


def _given(arguments, names):
    return {name: getattr(arguments, name) for name in names if name in arguments.given}


def _fit_drops(rows, scene, arguments):
    import numpy as np

    import restitute
    from restitute.errors import Error

    numbers = rows.numbers
    if "speed" not in scene and "drop_height" not in numbers:
        raise Refusal(f"{rows.source}: column speed_m_s (or drop_height_m) is missing")
    if (arguments.model == "prony") != bool(arguments.terms):
        raise Refusal("--terms and --model prony belong together")
    for option, name in (("--radius", "radius"), ("--density or --mass", "mass")):
        if not {name, "density" if name == "mass" else name} & scene.keys():
            raise Refusal(f"give {option} of the sphere (or a column in {rows.source})")
    if not numbers.keys() & {"ez", "rebound_height", "rebound_ratio", "ex", "contact_time"}:
        raise Refusal(f"{rows.source}: column ez (or rebound_height_m, rebound_ratio, ex, "
                      "contact_time_s) is missing")
    if "weight" in numbers:
        if any(name.startswith("sigma_") for name in numbers):
            raise Refusal(f"{rows.source}: columns weight and sigma_...: give one kind")
        numbers["weight"] = np.where(np.isnan(numbers["weight"]), 1.0, numbers["weight"])
    words = np.atleast_1d(np.array(scene.get("partner", "rigid"), object))
    _check_outputs(arguments, set(words))
    partners = {word: word if word in ("rigid", "same") else problem.material_of(word)
                for word in words}
    few = len(rows.table.lines) < 200
    settings: dict = {"threads": 1 if few else len(os.sched_getaffinity(0)),
                      **_given(arguments, (*_OF_DROPS, *_OF_BOTH))}
    show, scene = _progress(), {**scene, "partner": np.array([partners[w] for w in words], object)}
    try:
        return restitute.fit_drop_test(**numbers, **scene, **settings, name=arguments.name,
                                       progress=show)
    except (Error, TypeError) as why:
        raise rows.in_words(why) from None
    finally:
        show(None)


def _progress():
    """A function that shows the part done on a terminal; None: the line is wiped."""
    if not os.isatty(2):
        return lambda done: None
    return lambda done: options.write_all(
        2, "\r\x1b[K" if done is None else f"\rfit: {100 * done:.0f} %")


def _fit_curve(rows, arguments):
    import restitute
    from restitute.errors import Error

    for i in rows.rest:
        raise rows.unknown(rows.table.names[i])
    for column in ("frequency_Hz", "storage_Pa", "loss_Pa"):
        if _CURVE[column.casefold()] not in rows.numbers:
            raise Refusal(f"{rows.source}: column {column} is missing")
    _check_outputs(arguments)
    try:
        return restitute.fit_dma(**rows.numbers, name=arguments.name,
                                 **_given(arguments, (*_OF_BOTH, "density", "noise", "tension")))
    except Error as why:
        raise rows.in_words(why) from None


# ----------------------------------------------------------------------------------------- output


def _write(arguments, rows, fit):
    """Material file with its record, figure, and the report at last: all of them or none."""
    import numpy as np

    from restitute import version
    from restitute.command import files, provenance

    outputs = []
    if arguments.output:
        of = provenance.of_number
        constants = [{"name": name, "value": of(value), "low": of(low), "high": of(high)} for
                     name, value, low, high in zip(fit.names, fit.value, fit.low, fit.high)]
        numbers = {name: getattr(fit, name) for name in ("confidence", "values", "rank", "rms",
                                                         "noise", "condition", "worst")
                   if hasattr(fit, name)}
        report = {"model": fit.model, "constants": constants, "remarks": fit.remarks,
                  "correlation": fit.correlation.tolist(), "flags": fit.flags,
                  **{name: of(value) for name, value in numbers.items()}}
        settings = {"version": version(), "input": rows.source,
                    "fingerprint": provenance.fingerprint(rows.table.content)}
        record = provenance.record(arguments, settings, {}, fit=report)
        outputs = provenance.with_record(arguments.output, provenance.text(fit.document()), record)
        outputs.reverse()  # what cannot be written is named by the file that was asked for
    if arguments.figure:
        outputs.append((arguments.figure, files.image(_figure(arguments, fit), arguments.figure)))
    said = f"{shown(rows.source)}: {fit.model}\n\n{fit}\n"
    if arguments.output:
        density, (low, high) = fit.material.density, fit.material.window
        sphere = ", that of the sphere" if arguments.input else ""
        said += (f"  {shown(arguments.output)}: "
                 + (f"density {density:g} kg/m^3{sphere}" if density > 0 else "without density")
                 + (", modulus assumed" if fit.assumed else "")
                 + (f", measured from {low:.3g} to {high:.3g} s\n" if high < np.inf else "\n"))
    files.write(*outputs, (None, said))


def _figure(arguments, fit):
    from restitute import plot, version

    note = ",  ".join(f"{name} = {value:.4g}" for name, value in zip(fit.names[:6], fit.value))
    axes = plot.sheet(2, f"{arguments.name[:100]}: {fit.model}", note, f"restitute {version()} fit")
    return plot.fit(fit, ax=axes)
