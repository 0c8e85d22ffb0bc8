# SPDX-License-Identifier: BSD-3-Clause
"""Impacts of bodies in space, in any frame of reference."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import ffi
from restitute.impact import Pairs, report, split
from restitute.scenes import combine
from restitute.solving import OPTIONS, Solved, options, solver
from restitute.values import broadcast, numbers

__all__ = ["Body", "collide"]
_VECTORS = ("position", "velocity", "spin", "normal")


class Body(NamedTuple):
    """Spheres, or planes that nothing moves (radius infinite). SI units; arrays that broadcast."""

    position: Any = (0.0, 0.0, 0.0)  #: m, of the centre; of any point of a plane; shape (..., 3)
    velocity: Any = (0.0, 0.0, 0.0)  #: m/s
    spin: Any = (0.0, 0.0, 0.0)  #: rad/s, right-handed
    radius: Any = np.inf  #: m; inf: a plane
    mass: Any = np.inf  #: kg; inf: a sphere held fast
    inertia: Any = 0.0  #: kg m^2; 0: of a solid sphere
    normal: Any = (0.0, 0.0, 0.0)  #: of a plane, out of it


def records_of(first: Body, second: Body, columns: dict) -> tuple[tuple, list[np.ndarray]]:
    """The shape that bodies and columns broadcast to, and records of restitute_body, flat."""
    sizes, given = {}, {}
    for word, body in (("first", first), ("second", second)):
        for name, value in body._asdict().items():
            place, value = f"{word}.{name}", numbers(f"{word}.{name}", value)
            if name in _VECTORS and value.shape[-1:] != (3,):
                raise errors.DomainError(f"{place}: has the shape {value.shape}, must end in 3")
            given[word, name] = value
            sizes[place] = value[..., 0] if name in _VECTORS else value
    shape = broadcast({**columns, **sizes})
    records = {word: _library.structs("body", int(np.prod(shape))) for word in ("first", "second")}
    for (word, name), value in given.items():
        records[word].reshape(shape)[name] = value
    return shape, list(records.values())


def after(bodies: Any, records: Any, shape: tuple, failed: Any) -> list[Body]:
    """The bodies with the velocities and spins of records, nan where an impact failed."""
    for record in records:
        for name in ("velocity", "spin"):
            record[name][failed] = np.nan
    return [body._replace(velocity=record["velocity"].reshape(*shape, 3),
                          spin=record["spin"].reshape(*shape, 3))
            for body, record in zip(bodies, records)]


def collide(material: Any, first: Body, second: Body, *, partner: Any = "rigid",
            friction: Any = None, touch_gap: Any = 1e-6, wave_density: Any = 0.0,
            method: str = "euler", on_error: str = "raise",
            **settings: Any) -> tuple[Body, Body, Pairs]:
    """What two bodies that touch, or many pairs of them, do: pair by pair, in one thread.

    Parameters
    ----------
    material, partner, friction, wave_density, method, **settings
        As in `restitute.pair`, friction required, too; all broadcast but method and settings.
    first, second : Body
        Before the impact. One may be a plane.
    touch_gap : float, in [0, 1]
        How far apart, over the sum of the radii, bodies still touch.
    on_error : "raise" or "nan"

    Returns
    -------
    first, second : Body
        With the velocities and spins after the impact, arrays of shape (..., 3).
    pairs : Pairs
        In SI units.

    Raises
    ------
    DomainError
        Also for bodies that do not touch or that separate.

    Examples
    --------
    >>> from restitute import Material
    >>> rubber, floor = Material.standard_solid(1e6, 2e6, 50.0), Body(normal=(0, 0, 1))
    >>> ball = Body(position=(0, 0, 0.01), velocity=[(0.1, 0, -0.2), (0, 0, -0.1)], radius=0.01,
    ...             mass=4e-3)
    >>> after, _, pairs = collide(rubber, ball, floor, friction=0.3, radius_limit=1)
    >>> print(pairs.ez.round(2), after.velocity[:, 2].round(3), after.spin[0].round(1))
    [0.9  0.91] [0.18  0.091] [ 0. 10.  0.]
    """
    chosen, rest = split(settings)
    for name in rest:
        raise TypeError(f"'{name}' is no keyword of collide"
                        f"{errors.suggestion(name, [*collide.__kwdefaults__, *OPTIONS])}")
    if friction is None:
        raise TypeError("friction is missing: must be >= 0 (inf: no slip)")
    solids, place, deformable = combine(material, partner, 1.0)
    columns = {"material": np.array([s.address for s in solids], np.uint64)[place],
               "deformable": deformable, "friction": numbers("friction", friction),
               "touch_gap": numbers("touch_gap", touch_gap),
               "wave_density": numbers("wave_density", wave_density)}
    shape, bodies = records_of(first, second, columns)
    count = int(np.prod(shape))
    between = _library.structs("collision", count)
    for name, value in columns.items():
        between.reshape(shape)[name] = value
    asked, solved = {"method": method, **chosen}, Solved.empty(count)
    error, strike = ffi.new("restitute_error *"), _library.core.restitute_collide
    kinds = ("restitute_collision[]", "restitute_body[]", "restitute_body[]", "restitute_result[]")
    pointers = [_library.pointer(record, kind)
                for record, kind in zip((between, *bodies, solved.results), kinds)]
    with solver(options(**asked)) as pointer:
        for i in range(count):
            solved.status[i] = strike(pointer, *(p + i for p in pointers), error)
            if error.message[0] != b"\0":
                solved.messages[i] = _library.message_of(error)
    pairs = report(None, shape, solved, asked, on_error)
    first, second = after((first, second), bodies, shape, solved.status < 0)
    return first, second, pairs
