# SPDX-License-Identifier: BSD-3-Clause
"""What describes an impact: one table for options, columns and JSON keys, and the way from given
values to the keywords of `restitute.pair`.

A field has one name everywhere: the option `--speed`, the keyword `speed`, and with its unit the
column and JSON key `speed_m_s`. Older names are accepted.
"""
import re
from functools import cache
from itertools import combinations

from restitute.command import options
from restitute.command.options import Refusal, bounded, did_you_mean, number, read_number
from restitute.errors import DomainError, Error

INFINITY = float("inf")
_SUFFIXES = {"1": "", "m": "_m", "kg/m^3": "_kg_m3", "kg": "_kg", "kg m^2": "_kg_m2", "m/s": "_m_s",
             "deg": "_deg", "rad/s": "_rad_s", "Pa": "_pa", "Pa s": "_pa_s", "C": "_c"}
# name older-name | unit | range | what the numbers at its ends mean | help
_TABLE = """
chi | 1 | [1/3, 1000] | | (1-nu)/(2-nu) (1 + m R^2/J); default 7/6, a solid incompressible sphere
psi | 1 | [0, 1e12] | | (2-2nu)/(2-nu) |tangential velocity of the contact point| /
    (friction * normal velocity); 0: no slip; required
delta1 | 1 | [0, 1e12] | | eta sqrt(a_el/(G1 m (1-nu))); default 0: elastic
gamma | 1 | [0, inf] | inf: elastic | G1/G2; 0: Kelvin-Voigt, inf: elastic; required if delta1 > 0
delta2 | 1 | (0, 1e12] | | delta1 sqrt(gamma); instead of gamma or of delta1
modulus1 modulus | Pa | [0, inf) | | instead of --material: shear modulus G1 of a standard solid,
    Pa; 0: Maxwell; alone: elastic
youngs_modulus | Pa | (0, inf) | | instead of --modulus1: E = 2 (1+nu) G1, Pa
shore_a | 1 | [10, 95] | | instead of --modulus1: hardness Shore A, S, of which Gent (1958) makes
    E = 0.0981 MPa (56 + 7.62336 S)/(0.137505 (254 - 2.54 S)); a guide only
modulus2 | Pa | (0, inf) | | G2, Pa, in series with the dashpot; without it Kelvin-Voigt
viscosity | Pa s | (0, inf) | | eta of the dashpot, Pa s
poisson_ratio poisson | 1 | [0, 0.5] | | Poisson's ratio of that solid; default 0.5
time_shift | 1 | (0, inf) | | a_T: relaxation times and viscosity are multiplied by it, as by a
    change of temperature; default 1
temperature | C | [-273.15, 1e4] | | instead of --time-shift: degrees Celsius, for a --material
    whose shift of times with temperature is known; default that of its constants
radius radius1 | m | (0, inf) | | radius of the sphere, m; required
density density1 | kg/m^3 | (0, inf) | | density of the sphere, kg/m^3; this or --mass; default that
    of its material
mass mass1 | kg | (0, inf) | | mass of the sphere, kg
inertia inertia1 | kg m^2 | (0, inf) | | moment of inertia, kg m^2; default solid, 2/5 m R^2
radius2 | m | (0, inf] | inf: a wall | radius of the partner, m; default inf: a wall
density2 | kg/m^3 | (0, inf] | inf: held fast | density of the partner sphere, kg/m^3; this or
    --mass2; default that of its material
mass2 | kg | (0, inf] | inf: held fast | mass of the partner sphere, kg; inf: held fast
inertia2 | kg m^2 | (0, inf) | | its moment of inertia, kg m^2; default solid
speed velocity | m/s | (0, inf) | | speed of the sphere's centre relative to the partner, m/s;
    required
angle | deg | [0, 90) | | angle between the velocity and the normal, degrees; default 0
spin spin1 | rad/s | (-inf, inf) | | spin of the sphere, rad/s; positive spin adds to the sliding
    velocity v sin(angle) + R1 spin + R2 spin2, backspin is negative; default 0
spin2 | rad/s | (-inf, inf) | | spin of the partner sphere, rad/s, of the same sign; default 0
friction | 1 | [0, inf] | inf: no slip | coefficient of friction; inf: no slip; required
"""
_WORDS = {"(0, inf)": "finite and > 0", "[0, inf)": "finite and >= 0", "(0, inf]": "> 0",
          "[0, inf]": ">= 0", "(-inf, inf)": "finite"}


class Field:
    """A number of an impact: `name`, `key` and `option` as in speed, speed_m_s and --speed, `older`
    names that are accepted too, its unit, and the range in words, `allowed`."""

    def __init__(self, row):
        cells = re.split(r" ?\| ?", row, maxsplit=4)
        names, self.unit, ends, special, help = cells
        self.name, self.older = names.split()[0], names.split()[1:]
        self.key, self.option = self.name + _SUFFIXES[self.unit], "--" + self.name.replace("_", "-")
        low, high = ends[1:-1].split(", ")
        self.low, self.high = number(low), number(high)
        self.with_low, self.with_high = ends[0] == "[", ends[-1] == "]"
        self.allowed = f"must be {_WORDS.get(ends, f'in {ends}')}"
        self.allowed += f" ({special})" if special else ""
        self.help = help if ends in _WORDS else f"{help}; in {ends}"

    def fits(self, value):
        """Whether a number, or each of an array, lies in the range."""
        above = value >= self.low if self.with_low else value > self.low
        return above & (value <= self.high if self.with_high else value < self.high)

    def read(self, text, place):
        """The number from its text, or a Refusal."""
        return read_number(text, place, self.allowed, self.fits)


def _rows(table):
    """The rows of a table in text; a row goes on in lines that begin with blanks."""
    return [" ".join(row.split()) for row in re.split(r"\n(?! )", table.strip())]


FIELDS = {field.name: field for field in map(Field, _rows(_TABLE))}
DIMENSIONLESS = ("chi", "psi", "delta1", "gamma", "delta2")
SOLID = ("modulus1", "youngs_modulus", "shore_a", "modulus2", "viscosity", "poisson_ratio",
         "time_shift", "temperature")
SI = tuple(name for name in FIELDS if name not in DIMENSIONLESS)
SCENE = tuple(name for name in SI if name not in SOLID)
WORDS = ("material", "partner", "rotation_blocked")  # columns that are no numbers
# What a row must have; an empty cell of another column means that it is not given.
NEVER_EMPTY = (*DIMENSIONLESS, "radius", "speed", "angle", "friction")
_BY_COLUMN = {(name + _SUFFIXES[field.unit]).casefold(): field
              for field in FIELDS.values() for name in (field.name, *field.older)}


def field_of_column(column):
    """The field that a column or JSON key means, by its name or an older one; None if none."""
    return _BY_COLUMN.get(column.casefold())


def similar_column(column):
    """"; did you mean ...?" for a column that resembles a known one, e.g. without unit; or ""."""
    plain = column.casefold().replace("-", "_")
    for field in FIELDS.values():
        if plain in (field.name, *field.older):
            return f"; did you mean {field.key}?"
    return did_you_mean(column, [*(field.key for field in FIELDS.values()), *WORDS])


def read_partner(text, place):
    """rigid, same, or what names the partner's own material."""
    if text in ("rigid", "same") or text.endswith((".json", ".csv")) or text in names():
        return text
    raise Refusal(f'{place} = "{text[:64]}": must be rigid, same or a material file, .json or '
                  f".csv, or a name{did_you_mean(text, ['rigid', 'same', *names()])}")


def read_switch(text, place):
    """0 or 1."""
    if text not in ("0", "1"):
        raise Refusal(f'{place} = "{text[:64]}": must be 0 or 1')
    return text == "1"


# ---------------------------------------------------------------------------------------- options


def add_fields(group, fields):
    """Options of the fields of these names."""
    for field in (FIELDS[name] for name in fields):
        options.add(group, field.option[2:], "NUMBER", field.help, field.read, also=field.older)


def add_scene(parser, skip=()):
    """Options of an impact in SI units, without the fields `skip`."""
    group = parser.add_argument_group(
        "An impact in SI units, a sphere against a wall or a second sphere")
    options.add(group, "material", "FILE|NAME", "what deforms: a material file, .json, or .csv "
                "with tau_s,G_Pa, or a name of restitute materials; this or --modulus1",
                read_material)
    add_fields(group, [name for name in SI if name not in skip])
    options.add(group, "partner", "rigid|same|FILE|NAME", "rigid: one of the two bodies deforms "
                "(default); same: both do, and are of the material; else the material of the "
                "partner, if it is another one", read_partner)
    options.add_flag(group, "rotation-blocked", "the spheres cannot rotate")


def add_impact(parser):
    """Options of an impact, dimensionless or in SI units."""
    add_fields(parser.add_argument_group("An impact in dimensionless numbers"), DIMENSIONLESS)
    add_scene(parser)


# Option | argument | lowest, highest | help
_SOLUTION = """
tolerance | ERROR | 1e-8, 0.1 | absolute error of ez and ex, in [1e-8, 0.1]; default 1e-3
elements | N | 4, 1e6 | elements over the largest contact radius, 4 to 1000000; default chosen
time-step | STEP | 1e-300, 1e300 | in T, or in s with a material; > 0; default chosen; not with sync
max-work | SECONDS | 1e-9, inf | most work an impact may take, in nominal seconds, the same on every
    machine; default 10
time-limit | SECONDS | 0, inf | processor time an impact may take; 0 (default): 1, no limit with
    --elements, --time-step or bem
speed-limit | RATIO | 0, inf | flag FAST above this normal speed over wave speed; default 0.1
radius-limit | RATIO | 0, inf | flag LARGE_CONTACT above this contact radius over radius; default
    0.1
displacement-limit | RATIO | 0, inf | flag LONG_SLIDE above this slide over contact radius; default
    0.3
dundurs-limit | BETA | 0, inf | flag COUPLED above this constant of Dundurs; default 0.1
"""


def add_solution(parser):
    """Options that say how impacts are solved."""
    group = parser.add_argument_group("How it is solved")
    options.add(group, "method", "NAME", "euler (default): the foundation of the paper; sync: fast "
                "and precise, for tables and tolerances below 1e-3; cvode, cvode-bdf, cvode-adams: "
                "adaptive order and step, with events (component cvode); bem, bem-paper: boundary "
                "elements, an independent check (component bem)", read_method)
    for row in _rows(_SOLUTION):
        name, metavar, ends, help = row.split(" | ")
        low, high = map(number, ends.split(", "))
        options.add(group, name, metavar, help, bounded(low, high, whole=name == "elements"))


def solution(arguments, **defaults):
    """The keywords of `restitute.pair` that say how: what was given, else these defaults."""
    names = ["method", *(row.partition(" ")[0].replace("-", "_") for row in _rows(_SOLUTION))]
    return {**defaults, **{name: getattr(arguments, name) for name in names
                           if name in arguments.given}}


def read_method(text, place):
    """A method that this installation has."""
    from restitute.solving import METHODS, methods

    if text in methods():
        return text
    among = f"must be among {', '.join(methods())}{did_you_mean(text, methods())}"
    if text in METHODS:
        part = METHODS[text]
        needs = {"cvode": "SUNDIALS; Debian: libsundials-dev", "bem": "FFTW; Debian: libfftw3-dev"}
        raise Refusal(f'{place} = "{text}": the component {part} is not in this build '
                      f"({needs[part]}); {among}")
    raise Refusal(f'{place} = "{text[:64]}": is not in this build; {among}')


# ------------------------------------------------------------------------------ values to impacts


def values_of(arguments):
    """The values of an impact that the options give, by their names."""
    return {name: getattr(arguments, name) for name in (*FIELDS, *WORDS)
            if arguments.given.get(name)}


def place_of_options(arguments):
    """place(name): what the user calls a field on the command line."""
    return lambda name: arguments.given.get(name, "--" + name.replace("_", "-"))


def in_words_of(place, text):
    """A message of the package with the user's names of the fields in its first part."""
    fields, colon, rest = text.partition(":")
    names = (rf"(?<!\ba )(?<!/)\b({'|'.join(FIELDS)})\b(?!\.\w)"
             r"|^(material|partner|events|fields)\b(?!\.)")
    rest = rest.replace("partner='same'", f"{place('partner')} same")
    return re.sub(names, lambda word: place(word[0]), fields) + colon + rest


def impacts(keywords, place):
    """The `restitute.scenes.Impacts` of keywords; refusals have the user's names of the fields."""
    from restitute.scenes import Impacts

    try:
        made = Impacts(**keywords)
    except (TypeError, Error) as why:
        raise Refusal(in_words_of(place, str(why))) from None
    if made.refused and not made.shape:
        raise Refusal(in_words_of(place, made.refused[0]))
    return made


_MODULI = ("modulus1", "youngs_modulus", "shore_a")
EXCLUSIVE = (("density", "mass"), ("density2", "mass2"), ("temperature", "time_shift"),
             *combinations(_MODULI, 2))


def keywords(values, place):
    """The keywords of `restitute.pair` for given values, numbers or arrays by the names of FIELDS,
    and those of WORDS; or a Refusal of what is missing or does not go together, where place(name)
    is what the user calls a field."""
    given = dict(values)
    for one, other in EXCLUSIVE:
        if one in given and other in given:
            raise Refusal(f"{place(one)} and {place(other)} are both given: one determines the "
                          "other")
    partner = given.get("partner", "rigid")
    shift = next((name for name in SOLID[-2:] if name in given), None)
    if shift and isinstance(partner, str) and partner not in ("rigid", "same"):
        raise Refusal(f"{place('partner')} = {partner[:64]}: the material must be a file without "
                      f"{place(shift)}, with its times shifted")
    if given.keys() >= {"delta1", "gamma", "delta2"}:
        raise Refusal("delta1, gamma and delta2 are given: two of them determine the third")
    if set(given) <= set(DIMENSIONLESS):
        if "gamma" in given and "delta1" not in given and "delta2" not in given:
            raise Refusal(f"{place('delta1')} is missing: {place('gamma')} needs delta1 "
                          "(0: elastic) or delta2 beside it")
        return given
    if not set(given) & set(DIMENSIONLESS):
        _complete(given, place)
    return given


def _complete(given, place):
    """The material of moduli, or at a temperature."""
    moduli = [name for name in SOLID[:-2] if name in given]
    if "temperature" in given and "material" not in given:
        raise Refusal(f"{place('temperature')}: needs {place('material')}")
    if "material" in given and moduli:
        raise Refusal(f"a material file and {place(moduli[0])} are both given: use one")
    for name in ("radius", "speed", "friction"):
        if name not in given:
            raise _missing(name, place)
    if "material" not in given:
        given["material"] = _solid({name: given.pop(name) for name in moduli}, place)
    if "temperature" in given:
        try:
            given["material"] = _each(material_of, given["material"], given.pop("temperature"))
        except DomainError as why:
            text = str(why).replace("Material.shifted(a_T)", place("time_shift"))
            raise Refusal(in_words_of(place, text)) from None


def _missing(name, place):
    return Refusal(f"{place(name)} is missing: {FIELDS[name].allowed}")


def _solid(given, place):
    """The solids of moduli, an array of their shape."""
    from restitute.constants import shear_modulus, solids

    ratio, modulus1 = given.get("poisson_ratio", 0.5), given.get("modulus1")
    if modulus1 is None and ("youngs_modulus" in given or "shore_a" in given):
        modulus1 = shear_modulus(youngs=given.get("youngs_modulus"), shore_a=given.get("shore_a"),
                                 poisson_ratio=ratio)
    if modulus1 is None:
        raise Refusal(f"{place('material')} is missing: a material file, .json or .csv, or a name "
                      f"(or {place('modulus1')} and what belongs to it)")
    if "modulus2" in given and "viscosity" not in given:
        raise _missing("viscosity", place)
    if "modulus2" not in given and not (modulus1 != 0 if isinstance(modulus1, float) else
                                        modulus1.all()):
        raise _missing("modulus2", place)
    made = solids(modulus1, given.get("modulus2", INFINITY), given.get("viscosity", 0.0), ratio)
    if made.ndim == 0:
        made.item().name = "given moduli"  # for the scene in words
    return made


# -------------------------------------------------------------------------------------- materials


def names():
    """The materials that are known by name."""
    from restitute import material_names

    return material_names()


def read_material(text, place):
    """What names a material: a file, or a name."""
    if text.endswith((".json", ".csv")) or text in names():
        return text
    meant = did_you_mean(text, names()) or f": one of {', '.join(names())}"
    raise Refusal(f'{place} = "{text[:64]}": must end in .json or .csv, or be a name{meant}')


@cache
def material_of(text, temperature=None):
    """The material of a file or of a name, read once."""
    import restitute

    if isinstance(text, restitute.Material):  # an example, of Cases.check
        return text
    made = restitute.material(text, temperature=temperature)
    made.name += "" if temperature is None else f", shifted to {temperature:g} C"
    return made


def _each(function, *values):
    """function(value, ...), or an array of them if values are arrays."""
    import numpy as np

    if not any(map(np.ndim, values)):
        return function(*values)
    columns = np.broadcast_arrays(*(np.asarray(value, object) for value in values))
    return np.array([function(*some) for some in zip(*columns)])
