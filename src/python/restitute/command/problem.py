# SPDX-License-Identifier: BSD-3-Clause
"""What describes an impact: one table for options, columns and JSON keys, and from given values to keywords of
`restitute.pair`.

A field has one name everywhere: the option `--speed`, the keyword `speed`, and with its unit the column and JSON key
`speed_m_s`. Older names are accepted.
"""
import os
from collections import namedtuple

from restitute.command.options import Refusal, add, add_flag, bounded, did_you_mean, listed, one_of, read_number

_INFINITY = float("inf")
_POSITIVE, _FIXED = "must be finite and > 0", "must be > 0 (inf: held fast)"
Field = namedtuple("Field", "name unit low high ends allowed help options columns empty")
Field.__doc__ = """A number of an impact. `ends` are brackets of the range [low, high]; `options` and `columns` are
older names; an `empty` cell means that it is not given."""
Field.key = property(lambda field: field.name + _SUFFIXES[field.unit])
Field.option = property(lambda field: "--" + field.name.replace("_", "-"))
_SUFFIXES = {"1": "", "m": "_m", "kg/m^3": "_kg_m3", "kg": "_kg", "kg m^2": "_kg_m2", "m/s": "_m_s", "deg": "_deg",
             "rad/s": "_rad_s", "Pa": "_pa", "Pa s": "_pa_s"}


def _field(name, unit, low, high, ends, allowed, help, options="", columns="", empty=True):
    return Field(name, unit, low, high, ends, allowed, help, options.split(), columns.split(), empty)


DIMENSIONLESS = {field.name: field for field in (
    _field("chi", "1", 1 / 3, 1000, "[]", "must be in [1/3, 1000]",
           "(1-nu)/(2-nu) (1 + m R^2/J), in [1/3, 1000]; default 7/6, a solid incompressible sphere", empty=False),
    _field("psi", "1", 0, 1e12, "[]", "must be in [0, 1e12]",
           "(2-2nu)/(2-nu) |tangential velocity of the contact point| / (friction * normal velocity), in [0, 1e12]; "
           "0: no slip; required", empty=False),
    _field("delta1", "1", 0, 1e12, "[]", "must be in [0, 1e12]",
           "eta sqrt(a_el/(G1 m (1-nu))), in [0, 1e12]; default 0: elastic", empty=False),
    _field("gamma", "1", 0, _INFINITY, "[]", "must be >= 0 (inf: elastic)",
           "G1/G2, >= 0; 0: Kelvin-Voigt, inf: elastic; required if delta1 > 0", empty=False),
    _field("delta2", "1", 0, 1e12, "(]", "must be in (0, 1e12]",
           "delta1 sqrt(gamma), in (0, 1e12]; instead of gamma or of delta1", empty=False),
)}
SOLID = {field.name: field for field in (
    _field("modulus1", "Pa", 0, _INFINITY, "[)", "must be finite and >= 0",
           "instead of --material: shear modulus G1 of a standard solid, Pa; 0: Maxwell; alone: elastic", "modulus",
           "modulus1_Pa"),
    _field("youngs_modulus", "Pa", 0, _INFINITY, "()", _POSITIVE,
           "instead of --modulus1: E = 2 (1 + nu) G1, Pa"),
    _field("shore_a", "1", 20, 90, "[]", "must be in [20, 90]",
           "instead of --modulus1: hardness Shore A, in [20, 90], of which Gent (1958) makes "
           "E = 0.0981 MPa (56 + 7.62336 S)/(0.137505 (254 - 2.54 S)); a guide only"),
    _field("modulus2", "Pa", 0, _INFINITY, "()", _POSITIVE,
           "G2, Pa, in series with the dashpot; without it Kelvin-Voigt", columns="modulus2_Pa"),
    _field("viscosity", "Pa s", 0, _INFINITY, "()", _POSITIVE, "eta of the dashpot, Pa s", columns="viscosity_Pa_s"),
    _field("poisson_ratio", "1", 0, 0.5, "[]", "must be in [0, 0.5]", "Poisson's ratio of that solid; default 0.5",
           "poisson"),
    _field("time_shift", "1", 0, _INFINITY, "()", _POSITIVE,
           "a_T: relaxation times and viscosity are multiplied by it, as by a change of temperature; default 1"),
)}
BODIES = {field.name: field for field in (
    _field("radius", "m", 0, _INFINITY, "()", _POSITIVE, "radius of the sphere, m; required", "radius1", "radius1_m",
           empty=False),
    _field("density", "kg/m^3", 0, _INFINITY, "()", _POSITIVE,
           "density of the sphere, kg/m^3; this or --mass; default the material's", "density1", "density1_kg_m3"),
    _field("mass", "kg", 0, _INFINITY, "()", _POSITIVE, "mass of the sphere, kg", "mass1", "mass1_kg"),
    _field("inertia", "kg m^2", 0, _INFINITY, "()", _POSITIVE, "moment of inertia, kg m^2; default solid, 2/5 m R^2",
           "inertia1", "inertia1_kg_m2"),
    _field("radius2", "m", 0, _INFINITY, "(]", "must be > 0 (inf: a wall)",
           "radius of the partner, m; default inf: a wall"),
    _field("density2", "kg/m^3", 0, _INFINITY, "(]", _FIXED,
           "density of the partner sphere, kg/m^3; this or --mass2; default its material's"),
    _field("mass2", "kg", 0, _INFINITY, "(]", _FIXED, "mass of the partner sphere, kg; inf: held fast"),
    _field("inertia2", "kg m^2", 0, _INFINITY, "()", _POSITIVE, "its moment of inertia, kg m^2; default solid"),
    _field("speed", "m/s", 0, _INFINITY, "()", _POSITIVE,
           "speed of the sphere's centre relative to the partner, m/s; required", "velocity", "velocity_m_s",
           empty=False),
    _field("angle", "deg", 0, 90, "[)", "must be in [0, 90)",
           "angle between the velocity and the normal, degrees, in [0, 90); default 0", empty=False),
    _field("spin", "rad/s", -_INFINITY, _INFINITY, "()", "must be finite",
           "spin of the sphere, rad/s; positive spin adds to the sliding velocity v sin(angle) + R1 spin + R2 spin2, "
           "backspin is negative; default 0", "spin1", "spin1_rad_s"),
    _field("spin2", "rad/s", -_INFINITY, _INFINITY, "()", "must be finite",
           "spin of the partner sphere, rad/s, of the same sign; default 0"),
    _field("friction", "1", 0, _INFINITY, "[]", "must be >= 0 (inf: no slip)",
           "coefficient of friction, >= 0; inf: no slip; required", empty=False),
)}
SI = {**SOLID, **BODIES}
FIELDS = {**DIMENSIONLESS, **SI}
WORDS = ("material", "partner", "rotation_blocked")  # columns that are no numbers
_BY_COLUMN = {column.casefold(): field for field in FIELDS.values() for column in (field.key, *field.columns)}


def field_of_column(column):
    """The field that a column or JSON key means, by its name or an older one; None if it is none."""
    return _BY_COLUMN.get(column.casefold())


def similar_column(column):
    """"; did you mean ...?" for an unknown column that resembles a known one, e.g. without its unit; or nothing."""
    plain = column.casefold().replace("-", "_")
    for field in FIELDS.values():
        if plain in (field.name, *[option.replace("-", "_") for option in field.options]):
            return f"; did you mean {field.key}?"
    return did_you_mean(column, [*_BY_COLUMN, *WORDS])


def fits(field, value):
    """Whether a number, or each of an array, lies in the range of a field."""
    above = value >= field.low if field.ends[0] == "[" else value > field.low
    return above & (value <= field.high if field.ends[1] == "]" else value < field.high)


def read_field(field, text, place):
    """The number of a field from its text, or a Refusal."""
    return read_number(text, place, field.allowed, lambda value: fits(field, value))


def read_partner(text, place):
    """rigid, same, or what names the partner's own material."""
    if text in ("rigid", "same") or _is_file(text) or _is_known(text):
        return text
    raise Refusal(f'{place} = "{text[:64]}": must be rigid, same or a material file, .json or .csv'
                  f"{did_you_mean(text, ['rigid', 'same', *_names()])}")


def read_switch(text, place):
    """0 or 1."""
    if text not in ("0", "1"):
        raise Refusal(f'{place} = "{text[:64]}": must be 0 or 1')
    return text == "1"


# ------------------------------------------------------------------------------------------------ options


def add_fields(group, fields, skip=()):
    """Options of these fields, whose older names are accepted."""
    for field in fields.values():
        if field.name not in skip:
            add(group, field.option[2:], "NUMBER", field.help,
                lambda text, place, field=field: read_field(field, text, place), also=field.options)


def add_scene(parser, skip=()):
    """Options of an impact in SI units."""
    group = parser.add_argument_group("An impact in SI units, a sphere against a wall or a second sphere")
    add(group, "material", "FILE|NAME",
        "what deforms: a material file, .json, or .csv with tau_s,G_Pa, or a name of restitute materials; "
        "this or --modulus1")
    add_fields(group, SI, skip)
    add(group, "partner", "rigid|same|FILE|NAME",
        "rigid: one of the two bodies deforms (default); same: both do, and are of the material; else the material of "
        "the partner, if it is another one", read_partner)
    add_flag(group, "rotation-blocked", "the spheres cannot rotate")


def add_impact(parser):
    """Options of an impact, dimensionless or in SI units."""
    add_fields(parser.add_argument_group("An impact in dimensionless numbers"), DIMENSIONLESS)
    add_scene(parser)


def add_solution(parser):
    """Options that say how impacts are solved."""
    group = parser.add_argument_group("How it is solved")
    add(group, "method", "NAME",
        "euler (default): the foundation of the paper; sync: fast and precise, for tables and tolerances below 1e-3; "
        "cvode, cvode-bdf, cvode-adams: adaptive order and step, with events (component cvode); bem, bem-paper: "
        "boundary elements, an independent check (component bem)", read_method)
    add(group, "tolerance", "ERROR", "absolute error of ez and ex, in [1e-8, 0.1]; default 1e-3", bounded(1e-8, 0.1))
    add(group, "elements", "N", "elements over the largest contact radius, 4 to 1000000; default chosen",
        bounded(4, 1e6, whole=True))
    add(group, "time-step", "STEP", "in T, or in s with a material; > 0; default chosen; not with sync",
        bounded(1e-300, 1e300))
    add(group, "max-work", "SECONDS", "most work an impact may take, in nominal seconds, the same on every machine; "
        "default 10", bounded(1e-9, _INFINITY))
    add(group, "time-limit", "SECONDS", "processor time an impact may take; 0 (default): 1, no limit with --elements, "
        "--time-step or bem", bounded(0, _INFINITY))
    for name, what, default in (("speed", "FAST above this normal speed over wave speed", 0.1),
                                ("radius", "LARGE_CONTACT above this contact radius over radius", 0.1),
                                ("displacement", "LONG_SLIDE above this slide over contact radius", 0.3),
                                ("dundurs", "COUPLED above this constant of Dundurs", 0.1)):
        add(group, f"{name}-limit", "RATIO", f"flag {what}; default {default}", bounded(0, _INFINITY))


_SOLUTION = ("method", "tolerance", "elements", "time_step", "max_work", "time_limit", "speed_limit", "radius_limit",
             "displacement_limit", "dundurs_limit")


def solution(arguments, **defaults):
    """The keywords of `restitute.pair` that say how: what was given, else these defaults, else nothing."""
    given = {name: getattr(arguments, name) for name in _SOLUTION if getattr(arguments, name) is not None}
    return {**defaults, **given}


def read_method(text, place):
    """A method that this installation has."""
    from restitute._places import LIBRARIES

    methods = {"euler": "core", "sync": "core", "cvode": "cvode", "cvode-bdf": "cvode", "cvode-adams": "cvode",
               "bem": "bem", "bem-paper": "bem"}
    built = [name for name, component in methods.items() if component in LIBRARIES]
    if text in built:
        return text
    among = f"must be among {', '.join(built)}"
    if text in methods:
        needs = {"cvode": "SUNDIALS; Debian: libsundials-dev", "bem": "FFTW; Debian: libfftw3-dev"}[methods[text]]
        raise Refusal(f'{place} = "{text}": the component {methods[text]} is not in this build ({needs}); {among}')
    raise Refusal(f'{place} = "{text[:64]}": is not in this build; {among}{did_you_mean(text, built)}')


# ------------------------------------------------------------------------------------- values to keywords


def values_of(arguments):
    """The values of an impact that the options give, by their names."""
    return {name: getattr(arguments, name) for name in (*FIELDS, *WORDS)
            if getattr(arguments, name, None) not in (None, False)}


def place_of_options(arguments):
    """place(name): what the user calls a field on the command line."""
    return lambda name: arguments.given.get(name, "--" + name.replace("_", "-"))


def place_of_columns(name):
    """What the user calls a field in a table, if there is no older name for it there."""
    return FIELDS[name].key if name in FIELDS else name


def keywords(values, place):
    """The keywords of `restitute.pair` for given values.

    Parameters
    ----------
    values : dict
        Numbers or arrays by the names of FIELDS, and those of WORDS. What is not given is not in it.
    place : callable
        place(name) is what the user calls a field.

    Raises
    ------
    Refusal
        What is missing, or does not go together.
    """
    physical = [name for name in values if name not in DIMENSIONLESS]
    if physical and len(physical) < len(values):
        raise Refusal("dimensionless values (chi, psi, delta1, gamma, delta2) and values in SI units or a material are "
                      "both given: use one kind")
    if not values:
        raise Refusal("no impact is described: give psi, delta1, gamma or a material, radius, speed; see restitute "
                      "pair --help")
    return _scene(values, place) if physical else _impact(values, place)


def _missing(name, place):
    return Refusal(f"{place(name)} is missing: {FIELDS[name].allowed}")


def _impact(values, place):
    """(25): delta2 = delta1 sqrt(gamma) gives whichever of the two is missing."""
    if "psi" not in values:
        raise _missing("psi", place)
    given = dict(values)
    delta2 = given.pop("delta2", None)
    if delta2 is None:
        if "gamma" not in given and _any(given.get("delta1", 0) > 0):
            raise Refusal(f"{place('gamma')} is missing: delta1 > 0 needs gamma (0: Kelvin-Voigt) or delta2")
        if "gamma" in given and "delta1" not in given:
            raise Refusal(f"{place('delta1')} is missing: {place('gamma')} needs delta1 (0: elastic) or delta2")
        return given
    if "delta1" in given and "gamma" in given:
        raise Refusal("delta1, gamma and delta2 are given: two of them determine the third")
    other = "gamma" if "gamma" in given else "delta1"
    if other not in given:
        raise Refusal("delta2 needs delta1 or gamma beside it")
    known = given[other]
    if not _all((known > 0) & (known < _INFINITY)):
        raise Refusal(f"{place(other)} = {_first_bad(known):.15g}: must be finite and > 0 beside delta2")
    if other == "gamma":
        given["delta1"] = delta2 / known ** 0.5
    else:
        given["gamma"] = (delta2 / known) ** 2
    return given


def _any(test):
    return test.any() if hasattr(test, "any") else test


def _all(test):
    return test.all() if hasattr(test, "all") else test


def _first_bad(known):
    return known if not hasattr(known, "shape") else known[~((known > 0) & (known < _INFINITY))][0]


def _scene(values, place):
    for one, other in (("density", "mass"), ("density2", "mass2"), ("modulus1", "youngs_modulus"),
                       ("modulus1", "shore_a"), ("youngs_modulus", "shore_a")):
        if one in values and other in values:
            raise Refusal(f"{place(one)} and {place(other)} are both given: one determines the other")
    scene = {name: values[name] for name in BODIES if name in values}
    material = solid(values, place)
    for name in ("radius", "speed", "friction"):
        if name not in values:
            raise _missing(name, place)
    partner = values.get("partner", "rigid")
    own = {"rigid": None, "same": material}[partner] if partner in ("rigid", "same") else material_of(partner)
    if own not in (None, material):
        material_of_pair = _pair(material, own, values)
    else:
        material_of_pair = material
    _complete(scene, "", material, place)
    if "radius2" in scene and _all(scene["radius2"] < _INFINITY):
        _complete(scene, "2", own, place)
    else:
        _refuse_partner_values(scene, place)
    scene.update(material=material_of_pair, both_deform=partner == "same")
    if "rotation_blocked" in values:
        scene["rotation_blocked"] = values["rotation_blocked"]
    return scene


def _complete(scene, body, material, place):
    """The density of a body: of what is of a material that has one."""
    mass, density = f"mass{body}", f"density{body}"
    if mass in scene or density in scene:
        return
    if material is None or not material.density > 0:
        why = "" if material is None else " (its material has no density)"
        raise Refusal(f"{place(density)} or {place(mass)} is missing: must be > 0{why}")
    scene[density] = material.density


def _refuse_partner_values(scene, place):
    for name in ("mass2", "density2", "inertia2", "spin2"):
        value = scene.get(name, 0)
        if _any((value != 0) & (value != _INFINITY)) and "radius2" not in scene:
            raise Refusal(f"{place(name)} = {value:.15g}: needs a partner sphere, {place('radius2')}")


def _pair(material, partner, values):
    import restitute

    if "time_shift" in values:
        raise Refusal(f"partner = {values['partner']}: the material must be a file without time_shift")
    return restitute.Material.pair(material, partner)


# ---------------------------------------------------------------------------------------------- materials


def _is_file(text):
    return os.path.splitext(text)[1].lower() in (".json", ".csv")


def _names():
    try:
        from restitute.material import names
    except ImportError:
        return []
    return names()


def _is_known(text):
    return text in _names()


_read = {}


def material_of(text):
    """The material of a file or of a name, read once."""
    import restitute

    if text not in _read:
        named = not _is_file(text) and os.sep not in text
        if named and not _is_known(text):
            raise Refusal(f'material = "{text[:64]}": must end in .json or .csv, or be a name of restitute materials'
                          f"{did_you_mean(text, _names())}")
        _read[text] = restitute.material(text) if named else restitute.Material.read(text)
    return _read[text]


def shear_modulus(values):
    """G1 in Pa of given values: itself, by Young's modulus, or by the hardness Shore A (Gent, Rubber Chemistry and
    Technology 31, 1958)."""
    young = values.get("youngs_modulus")
    if "shore_a" in values:
        shore = values["shore_a"]
        young = 0.0981e6 * (56 + 7.62336 * shore) / (0.137505 * (254 - 2.54 * shore))
    if young is None:
        return values.get("modulus1")
    return young / (2 * (1 + values.get("poisson_ratio", 0.5)))


def solid(values, place):
    """The solid that single values describe, by a material or by numbers, its times shifted."""
    import restitute

    shift = values.get("time_shift", 1.0)
    moduli = [name for name in SOLID if name in values and name != "time_shift"]
    if "material" in values:
        if moduli:
            raise Refusal(f"a material file and {place(moduli[0])} are both given: use one")
        material = values["material"]
        material = material_of(material) if isinstance(material, str) else material
        return material if shift == 1 else material.shifted(shift)
    modulus1, modulus2 = shear_modulus(values), values.get("modulus2")
    viscosity, ratio = values.get("viscosity"), values.get("poisson_ratio", 0.5)
    if modulus1 is None:
        raise Refusal(f"{place('material')} is missing: a material file, .json or .csv, or a name (or "
                      f"{listed([place(name) for name in ('modulus1', 'youngs_modulus', 'shore_a')])} and what belongs "
                      "to it)")
    if modulus2 is not None and viscosity is None:
        raise _missing("viscosity", place)
    if modulus1 == 0 and modulus2 is None:
        raise _missing("modulus2", place)
    about = {"name": "Solid of given moduli"}
    if viscosity is None:
        return restitute.Material.elastic(modulus1, ratio, **about)
    if modulus1 == 0:
        return restitute.Material.maxwell(modulus2, viscosity * shift, ratio, **about)
    if modulus2 is None:
        return restitute.Material.kelvin_voigt(modulus1, viscosity * shift, ratio, **about)
    return restitute.Material.standard_solid(modulus1, modulus2, viscosity * shift, ratio, **about)
