# SPDX-License-Identifier: BSD-3-Clause
"""Restitution pairs of one impact or of arrays of them."""
from __future__ import annotations

import time

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.material import Material

__all__ = ["Pairs", "pair"]

_SI = ("radius", "mass", "density", "inertia", "radius2", "mass2", "density2", "inertia2", "friction", "speed", "angle",
       "normal_speed", "tangential_speed", "spin", "spin2")
_DIMENSIONLESS = ("chi", "psi", "delta1", "gamma")


class Pairs:
    """What came out of `pair`: arrays of the shape of the input, in SI units or those of the paper.

    Every member of the library's `restitute_result` is an attribute, among them `ez`, `ex`, `error_ez`, `error_ex`,
    `contact_time`, `max_indentation`, `max_contact_radius`, `max_normal_force`, `radius_ratio`, `flags`.

    Attributes
    ----------
    status : ndarray of int
        0 done, positive a remark, negative failed (its numbers are nan).
    """

    def __init__(self, records, status):
        self._records, self.status = records, status

    def __getattr__(self, name):
        if name.startswith("_") or name in ("struct_size", "method") or name not in self._records.dtype.names:
            raise AttributeError(f"no '{name}' in a result: {', '.join(self._records.dtype.names[1:-1])}")
        return self._records[name][()]

    def __dir__(self):
        return ["status", *self._records.dtype.names[1:-1]]

    def __repr__(self):
        return f"<restitute.Pairs shape={self.status.shape}>"


def options(method="euler", *, threads=1, **members):
    """restitute_options with these members. Unknown methods are refused by name."""
    value = _library.struct("options", threads=threads)
    value.method = _method(method)
    for name, member in members.items():
        if member is not None:
            setattr(value, name, member)
    return value


def _method(name):
    makers = {"euler": ("core", "restitute_method_euler"), "sync": ("core", "restitute_method_sync"),
              "cvode": ("cvode", "restitute_method_cvode"), "bem": ("bem", "restitute_method_bem")}
    if name not in makers:
        raise errors.DomainError(f"method = {name!r}: must be one of {', '.join(makers)}")
    component, function = makers[name]
    return getattr(getattr(_library, component), function)()


def scenes(material, *, radius, friction=0.0, mass=None, density=None, radius2=np.inf, mass2=None, density2=None,
           inertia=0.0, inertia2=0.0, speed=None, angle=0.0, normal_speed=None, tangential_speed=0.0, spin=0.0, spin2=0.0,
           both_deform=False):
    """restitute_scene records of broadcast arrays, and the broadcast shape."""
    columns = dict(radius1=radius, friction=friction, radius2=radius2, inertia1=inertia, inertia2=inertia2, spin1=spin,
                   spin2=spin2, deformable=np.where(both_deform, 2, 1))
    columns["mass1"] = mass if density is None else _sphere_mass(density, radius)
    columns["mass2"] = mass2 if mass2 is not None else np.inf if density2 is None else _sphere_mass(density2, radius2)
    if speed is not None:
        normal_speed = speed * np.cos(np.radians(angle))
        tangential_speed = speed * np.sin(np.radians(angle))
    columns["normal_speed"], columns["tangential_speed"] = normal_speed, tangential_speed
    columns["material"] = int(ffi.cast("uintptr_t", material._handle))
    return _records("scene", columns)


def _sphere_mass(density, radius):
    return 4 / 3 * np.pi * np.asarray(density, float) * np.asarray(radius, float) ** 3


def _records(kind, columns):
    shape = np.broadcast_shapes(*(np.shape(column) for column in columns.values()))
    records = _library.structs(kind, int(np.prod(shape)))
    for name, column in columns.items():
        records[name] = np.broadcast_to(column, shape).ravel()
    return records, shape


def solve(kind, records, settings, progress=None):
    """Solve records of restitute_scene or restitute_impact, in pieces of about 0.2 s, between which Ctrl-C works.

    Returns records of restitute_result and statuses. `progress` is called with the number of rows done.
    """
    many = getattr(_library.core, {"scene": "restitute_solve_scene_many", "impact": "restitute_solve_many"}[kind])
    results, status = _library.structs("result", len(records)), np.zeros(len(records), np.int32)
    begin, piece, error = 0, 64, ffi.new("restitute_error *")
    while begin < len(records):
        end, since = min(begin + piece, len(records)), time.monotonic()
        many(end - begin, _library.pointer(records[begin:end], f"restitute_{kind}[]"), settings,
             _library.pointer(results[begin:end], "restitute_result[]"), _library.pointer(status[begin:end]), error)
        if time.monotonic() - since < 0.1:
            piece *= 2
        begin = end
        if progress:
            progress(begin)
    return results, status


def pair(material: Material | None = None, *, method="euler", tolerance=None, threads=1, **impact) -> Pairs:
    """The restitution pair of one impact, or of arrays of them.

    >>> import restitute
    >>> restitute.pair(chi=7/6, psi=[0.5, 2], delta1=1, gamma=1).ez.round(3)
    array([...])
    """
    settings = options(method, threads=threads, tolerance=tolerance)
    if material is None:
        records, shape = _records("impact", impact)
        kind = "impact"
    else:
        records, shape = scenes(material, **impact)
        kind = "scene"
    results, status = solve(kind, records, settings)
    return Pairs(results.reshape(shape), status.reshape(shape))
