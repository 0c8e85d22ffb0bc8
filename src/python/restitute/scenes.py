# SPDX-License-Identifier: BSD-3-Clause
"""From keywords to impacts that the library solves: broadcasting, masses, materials."""
from __future__ import annotations

import os
from functools import partial
from typing import Any

import numpy as np

from restitute import _library, errors
from restitute.columns import Columns
from restitute.materials import Material, as_material
from restitute.values import broadcast, numbers, span, unmasked

__all__ = ["DIMENSIONLESS", "SCENE", "Impacts", "describe"]

#: Keywords of an impact in the numbers of the paper, and in SI units.
DIMENSIONLESS = ("chi", "psi", "delta1", "gamma", "delta2")
SCENE = ("radius", "density", "mass", "inertia", "radius2", "density2", "mass2", "inertia2",
         "partner", "friction", "speed", "angle", "normal_speed", "tangential_speed", "spin",
         "spin2", "rotation_blocked", "time_shift", "wave_density")

# What the library never sees as such: above the first, up to the second, in words.
_MOST = np.finfo(float).max
_RANGES = {"speed": (0, _MOST, "must be finite and > 0"),
           "angle": (-5e-324, np.nextafter(90, 0), "must be in [0, 90)"),
           "density": (0, _MOST, "must be finite and > 0"),
           "density2": (0, np.inf, "must be > 0 (inf: held fast)")}
_LIGHT = 10  # kg/m^3: what is lighter was perhaps given in g/cm^3, in which all solids are
_LARGE = 0.5, 500  # m: was perhaps given in mm


class Impacts:
    """Impacts ready to be solved, from the keywords of `restitute.pair`.

    Can be pickled. `impacts[10:20]` are some of them, in flat order.

    Attributes
    ----------
    kind : str
        "scene" (SI units) or "impact" (numbers of the paper).
    shape : tuple
        That of all keywords broadcast.
    records : ndarray
        restitute_scene or restitute_impact in flat order; `material` is the place in `solids`.
    solids : list of Material
    refused : dict of int to str
        Flat index and reason of those whose keywords are out of range.

    Raises
    ------
    TypeError
        Keywords that are unknown, missing or of both kinds.

    Examples
    --------
    >>> ball = Impacts(Material.elastic(1e6), radius=[1e-3, 2e-3], density=1100, speed=0.1,
    ...                friction=0.3)
    >>> ball.shape, ball.numbers().chi.round(3)
    ((2,), array([1.167, 1.167]))
    """

    def __init__(self, material: Any = None, **values: Any):
        values = {name: value for name, value in values.items() if value is not None}
        self.kind = _kind(material, values)
        self.solids: list[Material] = []
        self._checks: list[tuple] = []
        columns = (self._impact_columns(values) if self.kind == "impact"
                   else self._scene_columns(material, values))
        self.shape = broadcast(columns)
        self.records = _library.structs(self.kind, int(np.prod(self.shape)))
        for name, column in columns.items():
            self.records.reshape(self.shape)[name] = column
        self.refused: dict[int, str] = {}
        for bad, text in self._checks:
            for i in np.flatnonzero(np.broadcast_to(bad, self.shape)).tolist():
                self.refused.setdefault(i, text(partial(_at, self.shape, i)))
        del self._checks

    def _in_range(self, name, value, low, high, words):
        bad = ~((value > low) & (value <= high))
        if np.any(bad):
            self._checks.append((bad, lambda at: f"{name} = {at(value):.15g}: {words}"))

    def _impact_columns(self, values):
        columns = {name: numbers(name, value) for name, value in values.items()}
        if "psi" not in columns:
            raise TypeError("psi is missing: must be in [0, 1e12] (inf: no friction)")
        if "delta2" in columns:
            known = [name for name in ("gamma", "delta1") if name in columns]
            if len(known) != 1:
                raise TypeError("delta2 needs delta1 or gamma beside it, one of them")
            value, delta2 = columns[known[0]], columns.pop("delta2")
            self._in_range(known[0], value, 0, _MOST, "must be finite and > 0 beside delta2")
            self._in_range("delta2", delta2, 0, 1e12, "must be in (0, 1e12]")
            with np.errstate(all="ignore"):  # (25): delta2 = delta1 sqrt(gamma)
                if known[0] == "gamma":
                    columns["delta1"] = delta2 / np.sqrt(value)
                else:
                    columns["gamma"] = (delta2 / value) ** 2
        elif "gamma" not in columns and np.any(columns.get("delta1", 0) > 0):
            raise TypeError("gamma is missing: delta1 > 0 needs gamma (0: Kelvin-Voigt) or delta2")
        return columns

    def _scene_columns(self, material, values):
        for name, words in (("material", ""), ("radius", ": must be > 0"),
                            ("friction", ": must be >= 0 (inf: no slip)")):
            if {"material": material, **values}.get(name) is None:
                raise TypeError(f"{name} is missing{words}")
        partner, shift = values.pop("partner", "rigid"), values.pop("time_shift", 1.0)
        self.solids, place, deformable = combine(material, partner, shift)
        number = {name: numbers(name, value, "biuf" if name == "rotation_blocked" else "iuf")
                  for name, value in values.items()}
        broadcast({"material": place, **number})
        for name, allowed in _RANGES.items():
            if name in number:
                self._in_range(name, number[name], *allowed)
        warn_of_light({**number, "density of the material": [m.density for m in self.solids]})
        _warn_of_large(number)
        own = ("radius2", "inertia2", "friction", "spin2", "rotation_blocked", "wave_density")
        columns = {name: number[name] for name in own if name in number}
        for name in ("radius", "inertia", "spin"):
            if name in number:
                columns[f"{name}1"] = number[name]
        if "rotation_blocked" in number:
            columns["rotation_blocked"] = number["rotation_blocked"] != 0
        if "wave_density" not in number:
            known = [m.density if m.density > 0 else 0 for m in self.solids]
            columns["wave_density"] = np.array(known)[place]
        columns.update(_speeds(number), material=place, deformable=deformable)
        columns["mass1"] = self._mass(number, "", place, deformable)
        if "radius2" in number and np.any(np.isfinite(number["radius2"])):
            columns["mass2"] = np.where(np.isinf(number["radius2"]), np.inf,
                                        self._mass(number, "2", place, deformable))
        else:
            for name in ("mass2", "density2", "inertia2", "spin2"):
                if np.any(np.isfinite(number.get(name, 0)) & (number.get(name, 0) != 0)):
                    raise TypeError(f"{name} needs a partner sphere, radius2")
                columns.pop(name, None)
        return columns

    def _mass(self, number, body, place, deformable):
        """Of a mass, a density, or the density of the body's material: of the material that is
        given for sphere 1, and for sphere 2 where it is sure to be of one."""
        mass, density, radius = f"mass{body}", f"density{body}", number[f"radius{body}"]
        if mass in number and density in number:
            raise TypeError(f"{mass} and {density} are both given: one determines the other")
        if mass in number:
            return number[mass]
        value = number.get(density)
        if value is None:
            known = [(m.parts or (m, m))[body == "2"].density for m in self.solids]
            sure = (deformable == 2) | np.array([not body or bool(m.parts) for m in
                                                 self.solids])[place]
            value = np.where(sure, np.array(known)[place], np.nan)
            why = np.where(sure, "the material has none",
                           "or partner='same': both spheres are of the material")
            words = f"{density} or {mass} is missing: must be > 0"
            if np.all(np.isnan(value)):
                raise TypeError(f"{words} ({why.flat[0]})")
            self._checks.append((np.isnan(value) & np.isfinite(radius),
                                 lambda at: f"{words} ({at(why)})"))
        with np.errstate(all="ignore"):
            return 4 / 3 * np.pi * radius**3 * value

    def __len__(self):
        return len(self.records)

    def __getitem__(self, part: slice | np.ndarray) -> Impacts:
        some = object.__new__(Impacts)
        some.kind, some.records, some.refused = self.kind, self.records[part].copy(), {}
        some.shape = some.records.shape
        some.solids, place = self._used(some.records)
        some.records["material"] = place
        return some

    def _used(self, records):
        """The solids of records, and the place of each among them."""
        if not self.solids:
            return [], 0
        used, place = np.unique(records["material"], return_inverse=True)
        return [self.solids[i] for i in used.tolist()], place

    def bound(self, begin: int = 0, end: int | None = None) -> np.ndarray:
        """Records for C, with the addresses of materials; valid as long as these impacts are."""
        records = self.records[begin:end].copy()
        if self.solids:
            solids, place = self._used(records)
            records["material"] = np.array([solid.address for solid in solids], np.uint64)[place]
        return records

    def numbers(self) -> Columns:
        """Dimensionless numbers and, of scenes, their scales: `restitute_numbers` of the library.

        Returns
        -------
        Columns
            chi, psi, delta1, gamma, delta2, radius, mass, modulus, length_z, length_x, time, force;
            nan where they have no meaning. One call a scene: for some, not for millions.
        """
        values = _library.structs("numbers", len(self))
        for name in values.dtype.names[1:]:
            values[name] = np.nan
        if self.kind == "impact":
            for name in DIMENSIONLESS[:4]:
                values[name] = self.records[name]
            gamma = np.where(values["delta1"] == 0, 0, values["gamma"])
            with np.errstate(invalid="ignore"):
                values["delta2"] = values["delta1"] * np.sqrt(gamma)
        else:
            scene = _library.pointer(self.bound(), "restitute_scene[]")
            number = _library.pointer(values, "restitute_numbers[]")
            for i in range(len(self)):
                _library.core.restitute_scene_numbers(scene + i, number + i, _library.ffi.NULL)
        return Columns(values.reshape(self.shape))

    def describe(self) -> str:
        """The scene in words; see `describe`."""
        return describe(self)

    def __repr__(self):
        return f"<restitute.Impacts ({self.kind}) of shape {self.shape}>"


def warn_of_light(number):
    """Of densities in g/cm^3."""
    for name in ("density", "density2", "density of the material"):
        value = np.ravel(number.get(name, np.inf))
        light = value[(value > 0) & (value < _LIGHT)]
        if light.size:
            _library.warn(f"{name} = {light[0]:g} kg/m^3 is less than a solid has; 1.15 g/cm^3 are "
                          "1150 kg/m^3", errors.UnitWarning)


def _warn_of_large(number):
    """Of radii in mm. A mass beside one says that the size is meant, or is a scale."""
    for name in ("radius", "radius2"):
        value = np.ravel(number.get(name, 0.0))
        large = value[(value > _LARGE[0]) & (value < _LARGE[1])]
        if large.size and name.replace("radius", "mass") not in number:
            _library.warn(f"{name} = {large[0]:g} m is large for an impact; it is in m, not mm",
                          errors.UnitWarning)


def _kind(material, values):
    known = SCENE + DIMENSIONLESS
    for name in values:
        if name not in known:
            raise TypeError(f"'{name}' is no keyword of an impact"
                            f"{errors.suggestion(name, known)}")
    pure = [name for name in DIMENSIONLESS if name in values]
    physical = [name for name in SCENE if name in values] + ["material"] * (material is not None)
    if pure and physical:
        raise TypeError(f"numbers of the paper ({', '.join(pure)}) and SI units "
                        f"({', '.join(physical)}) are both given: use one kind")
    if not pure and not physical:
        raise TypeError("no impact is described: give psi, delta1, gamma or a material, radius, "
                        "speed")
    return "impact" if pure else "scene"


def _at(shape, index, values):
    return np.broadcast_to(values, shape).flat[index]


def _speeds(number):
    parts = {name: number[name] for name in ("normal_speed", "tangential_speed") if name in number}
    good = "normal_speed" in parts and "angle" not in number
    if not (not parts if "speed" in number else good):
        raise TypeError("give speed, or speed and angle, or normal_speed, or normal_speed and "
                        "tangential_speed")
    if "speed" not in number:
        return parts
    angle = np.radians(number.get("angle", 0.0))
    with np.errstate(invalid="ignore"):
        return {"normal_speed": number["speed"] * np.cos(angle),
                "tangential_speed": number["speed"] * np.sin(angle)}


def combine(material: Any, partner: Any, time_shift: Any) -> tuple[list[Material], Any, Any]:
    """Solids of arrays of materials and partners: each combination once, in which place of the
    list the solid of each case is, and its restitute_deformable."""
    solids: list[Material] = []
    places: dict[tuple, int] = {}
    opened: dict[Any, Material] = {}

    def opening(name, value):
        if isinstance(value, (str, os.PathLike)):
            if value not in opened:
                opened[value] = as_material(name, value)
            return opened[value]
        return as_material(name, value)

    def solid(one, other, shift):
        word = isinstance(other, str) and other in ("rigid", "same")
        key = (opening("material", one).address, word or opening("partner", other).address, shift)
        if key not in places:
            if not 0 < shift < np.inf:
                raise errors.DomainError(f"time_shift = {shift:g}: must be finite and > 0")
            if not word and shift != 1:
                raise TypeError("time_shift beside a partner's own material: take "
                                "Material.shifted for each")
            found = opening("material", one).shifted(shift)
            places[key] = len(solids)
            solids.append(found if word else Material.effective(found, opening("partner", other)))
        return places[key], 2 if word and other == "same" else 1

    columns = {"material": _objects("material", material), "partner": _objects("partner", partner),
               "time_shift": numbers("time_shift", time_shift).astype(object)}
    broadcast(columns)
    found = np.frompyfunc(solid, 3, 2)(*columns.values())
    place, deformable = (np.asarray(part).astype(np.int64) for part in found)
    return solids, place, deformable


def _objects(name, value) -> np.ndarray:
    """An array of Materials or words; a word is no sequence."""
    unmasked(name, value)
    if not isinstance(value, (str, os.PathLike)):
        return np.asarray(value, object)
    array = np.empty((), object)
    array[()] = value
    return array


def _length(values: Any) -> str:
    most = float(np.max(values))
    unit, scale = (" m", 1.0) if most >= 1 else (" mm", 1e3) if most >= 1e-4 else (" um", 1e6)
    return span(values, unit, scale)


def _names(solids: list[Material]) -> str:
    names = list(dict.fromkeys(m.name or m.model.replace("_", " ") for m in solids))
    return names[0] if len(names) == 1 else f"{len(names)} materials"


def _is_of_material(records, solids):
    """Whether spheres have the density of the solid, within a tenth; None: unknown, or some do."""
    density = np.array([m.density for m in solids])[records["material"].astype(int)]
    own = records["mass1"] / (4 / 3 * np.pi * records["radius1"]**3)
    same = np.abs(own - density) <= 0.1 * density
    return bool(same.all()) if (density > 0).all() and same.any() == same.all() else None


def describe(impacts: Any = None, **keywords: Any) -> str:
    """The scene in words, from Impacts or from the keywords of `restitute.pair`.

    Examples
    --------
    >>> rubber = Material.elastic(1e6, name="rubber")
    >>> describe("steel", partner=rubber, radius=0.005, speed=1, friction=0.3)
    'sphere of Structural steel, R = 5 mm, on a wall of rubber: 1 m/s, 0 degrees, friction 0.3'
    >>> describe("steel", radius=0.005, density=2000, speed=1, friction=0.3)
    'rigid sphere, R = 5 mm, on a wall of Structural steel: 1 m/s, 0 degrees, friction 0.3'
    >>> describe(rubber, radius=[0.001, 0.005], density=1100, speed=1, angle=30, friction=0.3)
    'sphere, R = 1 to 5 mm, on a wall, one of them of rubber, the other rigid: 1 m/s, 30 degrees,
    friction 0.3'
    """
    if not isinstance(impacts, Impacts):
        impacts = Impacts(impacts, **keywords)
    r = impacts.records
    if impacts.kind == "impact":
        return ", ".join(f"{name} = {span(r[name], '')}" for name in DIMENSIONLESS[:4])
    used = [impacts.solids[i] for i in np.unique(r["material"]).astype(int)]
    wall = np.isinf(r["radius2"])
    other = "a wall" if wall.all() else "a sphere or a wall" if wall.any() else "a sphere"
    which, first, second, rigid = "", "", "", ""
    if all(m.parts for m in used):
        first, second = (f" of {_names([m.parts[k] for m in used])}" for k in (0, 1))
    elif (r["deformable"] == 2).all():
        first, second = f" of {_names(used)}", " of the same"
    elif wall.all() and (own := _is_of_material(r, impacts.solids)) is not None:
        made = f" of {_names(used)}"
        which, first, second = ("", made, "") if own else ("rigid ", "", made)
        other = "a rigid wall" if own else other
    else:
        rigid = f", one of them of {_names(used)}, the other rigid"
    if not wall.any():
        second += f", R2 = {_length(r['radius2'])}"
    speed = np.hypot(r["normal_speed"], r["tangential_speed"])
    angle = np.degrees(np.arctan2(np.abs(r["tangential_speed"]), r["normal_speed"]))
    return (f"{which}sphere{first}, R = {_length(r['radius1'])}, on {other}{second}{rigid}: "
            f"{span(speed, ' m/s')}, {span(angle, ' degrees')}, "
            f"friction {span(r['friction'], '')}"
            f"{', rotation blocked' if (r['rotation_blocked'] != 0).all() else ''}")
