# SPDX-License-Identifier: BSD-3-Clause
"""From keywords to impacts that the library solves: broadcasting, masses, materials, what is missing."""
from __future__ import annotations

import difflib
import os
from typing import Any, Iterable

import numpy as np

from restitute import _library, errors
from restitute.materials import Material, material as material_of

__all__ = ["DIMENSIONLESS", "SCENE", "Columns", "Impacts", "describe"]

#: Keywords of an impact in the numbers of the paper, and in SI units.
DIMENSIONLESS = ("chi", "psi", "delta1", "gamma", "delta2")
SCENE = ("radius", "density", "mass", "inertia", "radius2", "density2", "mass2", "inertia2", "partner", "friction", "speed",
         "angle", "normal_speed", "tangential_speed", "spin", "spin2", "rotation_blocked", "time_shift", "wave_density")

#: Keywords that the library never sees as such: lowest and highest (both excluded, but angle's 0), in words.
_RANGES = {"speed": (0, np.inf, "must be finite and > 0"), "density": (0, np.inf, "must be finite and > 0"),
           "angle": (-5e-324, 90, "must be in [0, 90)")}


class Columns:
    """Records of a struct of the library: each member is an attribute, an array of the common shape."""

    _hidden: tuple = ("struct_size",)

    def __init__(self, records: np.ndarray):
        self._records = records

    @property
    def shape(self) -> tuple:
        """Shape of every member."""
        return self._records.shape

    def _members(self) -> list:
        return [name for name in self._records.dtype.names if name not in self._hidden]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._members():
            raise AttributeError(f"'{name}' is not one of {', '.join(dir(self))}")
        return self._records[name][()]

    def __dir__(self):
        return [*self._members(), *(name for name in vars(self) if not name.startswith("_"))]

    def __len__(self):
        return len(self._records)

    def __repr__(self):
        return f"<restitute.{type(self).__name__} of shape {self.shape}>"


class Impacts:
    """Impacts ready to be solved, from the keywords of `restitute.pair`.

    Can be pickled; `impacts[10:20]` are some of them in flat order.

    Attributes
    ----------
    kind : str
        "scene" (SI) or "impact" (numbers of the paper).
    shape : tuple
        That of all keywords broadcast.
    records : ndarray
        restitute_scene or restitute_impact of flat order. In `material` stands the place in `solids` + 1.
    solids : list of Material
    refused : dict of int to str
        Those (by flat index) whose values contradict each other, and why.

    Raises
    ------
    TypeError
        Keywords that are unknown, missing or of both kinds.

    Examples
    --------
    >>> ball = Impacts(Material.elastic(1e6), radius=[0.001, 0.002], density=1100, speed=0.1)
    >>> ball.shape, ball.numbers().chi.round(3)
    ((2,), array([1.167, 1.167]))
    """

    def __init__(self, material: Any = None, **values: Any):
        values = {name: value for name, value in values.items() if value is not None}
        self.solids: list[Material] = []
        self._checks: list[tuple] = []
        _check_names(material, values)
        if material is None and not any(name in SCENE for name in values):
            self.kind, columns = "impact", self._impact_columns(values)
        else:
            self.kind, columns = "scene", self._scene_columns(material, values)
        self._given = values
        self._fill(columns)

    def _fill(self, columns):
        try:
            self.shape = np.broadcast_shapes(*(np.shape(column) for column in columns.values()))
        except ValueError:
            shapes = ", ".join(f"{name} {np.shape(column)}" for name, column in columns.items() if np.ndim(column))
            raise errors.DomainError(f"shapes that do not broadcast: {shapes}") from None
        records = _library.structs(self.kind, int(np.prod(self.shape)))
        for name, column in columns.items():
            records.reshape(self.shape)[name] = column
        self.records = records
        self.refused = {}
        for bad, text in reversed(self._checks):
            bad = np.broadcast_to(bad, self.shape).ravel()
            self.refused.update((int(i), text(int(i), self.shape)) for i in np.flatnonzero(bad))
        del self._checks

    def _refuse(self, bad, text):
        """Refuse where `bad`; text(flat index, shape) says why."""
        if np.any(bad):
            self._checks.append((bad, text))

    def _in_range(self, name, value, low, high, words):
        value = _numbers(name, value)
        with np.errstate(invalid="ignore"):
            bad = ~((value > low) & (value < high))
        self._refuse(bad, lambda i, shape: f"{name} = {_at(value, i, shape):.15g}: {words}")
        return value

    def _impact_columns(self, values):
        columns = {name: _numbers(name, value) for name, value in values.items()}
        if "psi" not in columns:
            raise TypeError("psi is missing: must be in [0, 1e12] (inf: no friction)")
        if {"delta1", "gamma", "delta2"} <= columns.keys():
            raise TypeError("delta1, gamma and delta2 are given: two of them determine the third")
        if "delta2" in columns:
            known = "gamma" if "gamma" in columns else "delta1"
            if known not in columns:
                raise TypeError("delta2 needs delta1 or gamma beside it")
            value = self._in_range(known, columns[known], 0, np.inf, "must be finite and > 0 beside delta2")
            delta2 = columns.pop("delta2")
            self._in_range("delta2", delta2, 0, 1.0000000001e12, "must be in (0, 1e12]")
            with np.errstate(all="ignore"):  # (25): delta2 = delta1 sqrt(gamma)
                other = delta2 / np.sqrt(value) if known == "gamma" else (delta2 / value) ** 2
            columns["delta1" if known == "gamma" else "gamma"] = other
        elif "gamma" not in columns and np.any(columns.get("delta1", 0) > 0):
            raise TypeError("gamma is missing: delta1 > 0 needs gamma (0: Kelvin-Voigt) or delta2")
        return columns

    def _scene_columns(self, material, values):
        if material is None:
            raise TypeError("material is missing: a Material, its name or a file")
        if "radius" not in values:
            raise TypeError("radius is missing: must be > 0")
        partner = values.get("partner", "rigid")
        solid, deformable = self._combine(material, partner, values.get("time_shift", 1.0))
        number = {name: _numbers(name, value) for name, value in values.items() if name not in ("partner", "time_shift")}
        for name in number:
            if name in _RANGES:
                self._in_range(name, number[name], *_RANGES[name])
        columns = {"material": solid + 1, "deformable": deformable, "radius1": number["radius"]}
        columns.update({name: number[name] for name in ("radius2", "inertia2", "friction", "spin2") if name in number})
        columns.update({f"{name}1": number[name] for name in ("inertia", "spin") if name in number})
        if "rotation_blocked" in number:
            columns["rotation_blocked"] = number["rotation_blocked"] != 0
        self._masses(columns, number, solid, deformable)
        _speeds(columns, number)
        known = np.array([m.density for m in self.solids])[solid]
        columns["wave_density"] = number.get("wave_density", np.where(known > 0, known, 0))
        return columns

    def _combine(self, material, partner, time_shift):
        """Place of each solid in self.solids, made once a combination; and which bodies deform."""
        made: dict[tuple, tuple[int, int]] = {}
        opened: dict[Any, Material] = {}

        def solid(one, other, shift):
            key = (one if isinstance(one, str) else id(one), other if isinstance(other, str) else id(other), shift)
            if key not in made:
                made[key] = (len(self.solids), 2 if isinstance(other, str) and other == "same" else 1)
                self.solids.append(_solid_of(one, other, shift, opened))
            return made[key]

        one, other = _objects(material), _objects(partner)
        if one.ndim == other.ndim == np.ndim(time_shift) == 0:
            place, deformable = solid(one[()], other[()], float(time_shift))
            return np.int64(place), np.int32(deformable)
        found = np.frompyfunc(solid, 3, 1)(one, other, _numbers("time_shift", time_shift))
        pairs = np.array(found.ravel().tolist(), np.int64).reshape(*found.shape, 2)
        return pairs[..., 0], pairs[..., 1]

    def _masses(self, columns, number, solid, deformable):
        """Masses from masses or densities; a density that is not given is the material's where that is sure."""
        for own, body in (("", "1"), ("2", "2")):
            if f"mass{own}" in number and f"density{own}" in number:
                raise TypeError(f"mass{own} and density{own} are both given: one determines the other")
        wall = "radius2" not in number or not np.any(np.isfinite(number["radius2"]))
        for name in ("mass2", "density2", "inertia2", "spin2"):
            if wall and name in number and np.any(np.isfinite(number[name]) & (number[name] != 0)):
                raise TypeError(f"{name} needs a partner sphere, radius2")
        if wall:
            for name in ("mass2", "density2", "inertia2", "spin2"):
                number.pop(name, None), columns.pop(name, None)
        columns["mass1"] = self._mass(number, "", 0, solid, deformable)
        if not wall:
            columns["mass2"] = np.where(np.isinf(number["radius2"]), np.inf,
                                        self._mass(number, "2", 1, solid, deformable))

    def _mass(self, number, own, body, solid, deformable):
        if f"mass{own}" in number:
            return number[f"mass{own}"]
        density = number.get(f"density{own}")
        if density is None:
            known = [(m._parts or (m, m))[body].density for m in self.solids]
            sure = (deformable == 2) | np.array([m._parts is not None for m in self.solids])[solid]
            density = np.where(sure, np.array(known)[solid], np.nan)
            radius2 = number["radius2"] if body else 0.0
            self._refuse(~(density > 0) & np.isfinite(radius2),
                         lambda i, shape: f"density{own} or mass{own} is missing: must be > 0"
                         + (" (the material has none)" if _at(sure, i, shape) else ""))
        with np.errstate(all="ignore"):
            return 4 / 3 * np.pi * number[f"radius{own}"] ** 3 * density

    def __len__(self):
        return len(self.records)

    def __getitem__(self, part: slice) -> Impacts:
        some = object.__new__(Impacts)
        some.kind, some.solids, some.records = self.kind, self.solids, self.records[part]
        some.shape, some._given = some.records.shape, {}
        first = range(len(self.records))[part].start
        some.refused = {i - first: text for i, text in self.refused.items() if first <= i < first + len(some)}
        return some

    def bound(self, begin: int = 0, end: int | None = None) -> np.ndarray:
        """Records for C, with addresses of materials; valid as long as these impacts are."""
        records = self.records[begin:end].copy()
        addresses = np.array([0, *(solid.address for solid in self.solids)], np.uint64)
        records["material"] = addresses[records["material"].astype(np.int64)]
        return records

    def numbers(self) -> Columns:
        """Dimensionless numbers (chi, psi, delta1, gamma, delta2) and, of scenes, the scales of the library's
        `restitute_numbers` (time, length_z, ...), arrays of the shape; nan where they have no meaning or the scene
        is refused. One call a scene: for some, not for millions."""
        values = _library.structs("numbers", len(self))
        for name in values.dtype.names[1:]:
            values[name] = np.nan
        if self.kind == "impact":
            for name in ("chi", "psi", "delta1", "gamma"):
                values[name] = self.records[name]
            elastic = self.records["delta1"] == 0
            with np.errstate(invalid="ignore"):
                values["delta2"] = np.where(elastic, 0, values["delta1"] * np.sqrt(values["gamma"]))
        else:
            records = self.bound()
            scene = _library.pointer(records, "restitute_scene[]")
            number = _library.pointer(values, "restitute_numbers[]")
            for i in range(len(self)):
                _library.core.restitute_scene_numbers(scene + i, number + i, _library.ffi.NULL)
        return Columns(values.reshape(self.shape))

    def describe(self) -> str:
        """The scene in words; arrays as "from ... to ...".

        >>> Impacts(material_of("steel"), partner=Material.elastic(1e6, name="rubber"), radius=0.005, speed=1).describe()
        'sphere of Structural steel, R = 5 mm, on a wall of rubber, speed 1 m/s, angle 0 degrees, friction 0'
        """
        return describe(self)

    def __repr__(self):
        return f"<restitute.Impacts ({self.kind}) of shape {self.shape}>"


def _check_names(material, values):
    for name in values:
        if name not in SCENE and name not in DIMENSIONLESS:
            near = difflib.get_close_matches(name, SCENE + DIMENSIONLESS, 1, 0.7)
            raise TypeError(f"'{name}' is no keyword of an impact"
                            f"{f'; did you mean {near[0]}?' if near else ': ' + ', '.join(SCENE + DIMENSIONLESS)}")
    pure = [name for name in DIMENSIONLESS if name in values]
    physical = [name for name in SCENE if name in values] + (["material"] if material is not None else [])
    if pure and physical:
        raise TypeError(f"numbers of the paper ({', '.join(pure)}) and SI units ({', '.join(physical)}) are both given: "
                        "use one kind")
    if not pure and not physical:
        raise TypeError("no impact is described: give psi, delta1, gamma or a material, radius, speed")


def _numbers(name, value):
    try:
        return np.asarray(value, float)
    except (TypeError, ValueError):
        raise errors.DomainError(f"{name} = {value!r}: is not a number or an array of numbers") from None


def _at(value, index, shape):
    return np.broadcast_to(value, shape).flat[index]


def _speeds(columns, number):
    if "speed" in number:
        if {"normal_speed", "tangential_speed"} & number.keys():
            raise TypeError("speed and normal_speed or tangential_speed are given: use speed with angle, or the other two")
        angle = np.radians(number.get("angle", 0.0))
        columns["normal_speed"] = number["speed"] * np.cos(angle)
        columns["tangential_speed"] = number["speed"] * np.sin(angle)
    elif "normal_speed" not in number:
        raise TypeError("speed is missing: must be > 0 (or normal_speed)")
    elif "angle" in number:
        raise TypeError("angle needs speed; beside normal_speed give tangential_speed")
    else:
        columns.update({name: number[name] for name in ("normal_speed", "tangential_speed") if name in number})


def _objects(value) -> np.ndarray:
    """An array of Materials, names or words; a Material is no sequence."""
    if isinstance(value, (str, os.PathLike, Material)):
        array = np.empty((), object)
        array[()] = value
        return array
    return np.asarray(value, object)


def _solid_of(one, other, shift: float, opened: dict) -> Material:
    def opening(value, name):
        if isinstance(value, Material):
            return value
        if not isinstance(value, (str, os.PathLike)):
            raise TypeError(f"{name} = {value!r}: must be a Material, its name or a file")
        if value not in opened:
            opened[value] = material_of(value)
        return opened[value]

    solid = opening(one, "material")
    if not 0 < shift < np.inf:
        raise errors.DomainError(f"time_shift = {shift:g}: must be finite and > 0")
    if isinstance(other, str) and other in ("rigid", "same"):
        return solid.shifted(shift)
    if shift != 1:
        raise TypeError("time_shift with a partner of its own material: shift each by Material.shifted")
    return Material.effective(solid, opening(other, "partner"))


def _quantity(values: Any, unit: str, scale: float = 1.0) -> str:
    """"5 mm", or "from 1 to 5 mm" """
    low, high = float(np.min(values)) * scale, float(np.max(values)) * scale
    return f"{low:.4g}{unit}" if low == high else f"from {low:.4g} to {high:.4g}{unit}"


def _length(values: Any) -> str:
    for unit, scale in ((" m", 1.0), (" mm", 1e3), (" um", 1e6)):
        if np.max(values) * scale >= 0.999999:
            break
    return _quantity(values, unit, scale)


def _names(solids: Iterable[Material]) -> str:
    names = list(dict.fromkeys(m.name or f"{m.model.replace('_', ' ')} of {m.relaxation_modulus(1e-30):.3g} Pa"
                               for m in solids))
    return names[0] if len(names) == 1 else f"{len(names)} materials"


def describe(impacts: Impacts | Any = None, **keywords: Any) -> str:
    """The scene in words, from Impacts or from the keywords of `restitute.pair`.

    Examples
    --------
    >>> describe(Material.elastic(1e6, name="rubber"), radius=0.005, density=1100, speed=[0.1, 2], angle=30, friction=0.3)
    'sphere, R = 5 mm, on a wall; one of them of rubber, the other rigid; speed from 0.1 to 2 m/s, angle 30 degrees, friction 0.3'
    """
    if not isinstance(impacts, Impacts):
        impacts = Impacts(impacts, **keywords)
    r = impacts.records
    if impacts.kind == "impact":
        return ", ".join(f"{name} = {_quantity(r[name], '')}" for name in ("chi", "psi", "delta1", "gamma"))
    used = [impacts.solids[i - 1] for i in np.unique(r["material"]).astype(int)]
    parts = all(m._parts for m in used) and [[m._parts[k] for m in used] for k in (0, 1)]
    same = bool(np.all(r["deformable"] == 2))
    first = f"sphere of {_names(parts[0] if parts else used)}" if parts or same else "sphere"
    second = "on a wall" if np.all(np.isinf(r["radius2"])) else "on a sphere"
    if not np.all(np.isinf(r["radius2"])) and np.any(np.isinf(r["radius2"])):
        second = "on a sphere or a wall"
    if parts:
        second += f" of {_names(parts[1])}"
    elif same:
        second += " of the same"
    if np.all(np.isfinite(r["radius2"])):
        second += f", R2 = {_length(r['radius2'])}"
    who = "" if parts or same else f"; one of them of {_names(used)}, the other rigid"
    speed, angle = np.hypot(r["normal_speed"], r["tangential_speed"]), np.degrees(
        np.arctan2(np.abs(r["tangential_speed"]), r["normal_speed"]))
    # The angle through the components and back loses some bits.
    text = (f"{first}, R = {_length(r['radius1'])}, {second}{who}{';' if who else ','} speed {_quantity(speed.round(15), ' m/s')}, "
            f"angle {_quantity(angle.round(9), ' degrees')}, friction {_quantity(r['friction'], '')}")
    return text + (", rotation blocked" if np.all(r["rotation_blocked"] != 0) else "")
