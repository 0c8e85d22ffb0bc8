# SPDX-License-Identifier: BSD-3-Clause
"""Tables of restitution pairs: some ten nanoseconds a pair, with a verified error."""

from __future__ import annotations

import os
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.collisions import Body, after, records_of
from restitute.impact import LIMITS
from restitute.lookups import TableContact, TablePairs
from restitute.materials import Material
from restitute.scenes import Impacts
from restitute.values import broadcast, fit_shape, number, numbers

__all__ = ["Table"]

_FROM = (("fast_speed", "not slow against shear waves from {:.4g} m/s on"),
         ("large_contact_speed", "contact not small against the sphere from {:.4g} m/s on"),
         ("long_slide_speed", "long slide at 45 degrees from {:.4g} m/s on"))


def _shapes(struct: Any) -> dict[str, tuple[int, ...]]:
    n, places = struct.speeds, struct.stick_cells + struct.slip_cells + 2
    return {"relaxation_time": (struct.terms,), "modulus": (struct.terms,), "speed": (n,),
            "ez": (n, 2), "strain": (n, 4), "ex": (n, places, 4)}


class Table:
    """Restitution pairs of one contact over normal and sliding speed.

    Made by `Table.build` or `Table.load`; immutable. Threads may share it, and it can be pickled.

    Attributes
    ----------
    info : types.SimpleNamespace
        The members of the library's `restitute_table_info`: `speed` (m/s, the range), `error_ez`
        and `error_ex` (verified), `tolerance`, `chi`, `friction`, `radius`, `mass`,
        `fast_speed`, `large_contact_speed`, `long_slide_speed`, `rebound_speed`, ...

    Examples
    --------
    >>> import restitute
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> table = Table.build(rubber, radius=0.001, density=1200, friction=0.3,
    ...                     speeds=(0.01, 0.1), tolerance=1e-3)
    >>> ez, ex = table.pair([0.02, 0.05], 0.01)
    >>> small = table.contact(radius=0.0008, density=1200, friction=0.5)
    >>> print(table.pair(0.02, 0.01, small).ez.round(2))
    0.59
    """

    def __init__(self, handle: Any):
        if not isinstance(handle, ffi.CData):
            raise TypeError("Table(...): take Table.load of a file, or Table.build of a contact")
        self._handle = ffi.gc(handle, _library.table.restitute_table_destroy)
        struct = _library.struct("table_info", "table")
        call(_library.table.restitute_table_describe, self._handle, struct)
        self.info = SimpleNamespace(**_library.members(struct))
        self._data: dict[str, Any] = {}

    @classmethod
    def build(cls, material: Any, *, speeds: Any = (1e-4, 100.0), tolerance: float = 1e-5,
              threads: int = 1, max_impacts: int | None = None, time_limit: float | None = None,
              speed_limit: float | None = None, radius_limit: float | None = None,
              displacement_limit: float | None = None, dundurs_limit: float | None = None,
              **contact: Any) -> Table:
        """Build a table of one contact: hundredths of a second to seconds.

        Parameters
        ----------
        material : Material, name or path
        speeds : float or (float, float)
            Lowest and highest normal speed, m/s.
        tolerance : float
            Largest absolute error of ez and ex, in [1e-7, 0.1].
        threads : int
            The table has the same bits for any; 0: as many as there are.
        max_impacts, time_limit : int and float (s), optional
            Refinement ends at 0.8 of them; default 12000 and 20. inf: no limit of time.
        speed_limit, radius_limit, displacement_limit, dundurs_limit : float, optional
            Limits of the model.
        **contact
            As in `pair`: `radius`, `density` or `mass`, `friction`, `radius2`, `partner`, ...

        Raises
        ------
        DomainError, SolverError
            A value is out of its range; `max_impacts` is too small for any table.
        KeyboardInterrupt
            By Ctrl-C, at once.

        Warns
        -----
        ToleranceWarning
            The verified error is above the tolerance.
        ModelLimitWarning
            Contact times are outside the window in which the material was measured.
        """
        given = {"threads": threads, "tolerance": tolerance, "max_impacts": max_impacts,
                 "time_limit": time_limit, "speed_limit": speed_limit,
                 "radius_limit": radius_limit, "displacement_limit": displacement_limit,
                 "dundurs_limit": dundurs_limit}
        options = _library.struct("table_options", "table", **{
            name: value for name, value in given.items() if value is not None})
        options.speed = fit_shape("speeds", numbers("speeds", speeds), (2,)).tolist()
        handle = ffi.new("restitute_table **")
        scene, kept = _scene(material, contact)
        function = _library.table.restitute_table_build
        status, message = _library.interruptible(function, scene, options, handle, keep=kept,
                                                 options=options)
        if message:
            _library.warn(message, errors.ToleranceWarning if status else errors.ModelLimitWarning)
        return cls(handle[0])

    @classmethod
    def load(cls, path: str | os.PathLike) -> Table:
        """A table from its HDF5 file; table_files.h says how it is laid out.

        Raises
        ------
        FileError, FormatError
            It cannot be read; it is no table, or damaged.
        MissingComponent
            This installation has no component table_files, as a wheel; `pickle` keeps a table, too.
        """
        handle = ffi.new("restitute_table **")
        call(_files().restitute_table_read, _library.string(path), handle)
        return cls(handle[0])

    def save(self, path: str | os.PathLike) -> None:
        """Write the table into an HDF5 file, whole or not at all (`FileError`)."""
        not_csv("path", path)
        call(_files().restitute_table_write, self._handle, _library.string(path))

    @classmethod
    def from_data(cls, data: dict[str, Any]) -> Table:
        """A table of the numbers that `data` gives."""
        struct, kept = _library.struct("table_data", "table"), []
        if not isinstance(data, dict):
            raise TypeError(f"data = {errors.shown(data)}: must be what Table.data gives")
        names = _library.members(struct)
        for name in data.keys() & names:
            value = data[name]
            setattr(struct, name, value.encode() if isinstance(value, str) else
                    type(names[name])(number(name, value)))
        for name, shape in _shapes(struct).items():
            values = np.ascontiguousarray(numbers(name, data.get(name, ())))
            if values.shape != shape:
                raise errors.DomainError(f"data: {name} has the shape {values.shape}, must have "
                                         f"{shape}")
            kept.append(_library.pointer(values.ravel()))
            setattr(struct, name, kept[-1])
        handle = ffi.new("restitute_table **")
        call(_library.table.restitute_table_create, struct, handle)
        return cls(handle[0])

    @property
    def data(self) -> dict[str, Any]:
        """All numbers of the table, the members of the library's `restitute_table_data`: `speed`
        (n,), `ez` (n, 2), `ex` (n, places of psi, 4), `strain` (n, 4), ..."""
        if not self._data:
            struct = _library.struct("table_data", "table")
            call(_library.table.restitute_table_data_get, self._handle, struct)
            self._data = _library.members(struct)
            for name, shape in _shapes(struct).items():
                values = np.empty(shape)
                ffi.memmove(ffi.from_buffer(values), getattr(struct, name), values.nbytes)
                self._data[name] = values
        return self._data

    def __reduce__(self):
        return Table.from_data, (self.data,)

    @property
    def speed(self) -> tuple[float, float]:
        """Lowest and highest normal speed, m/s."""
        return self.info.speed

    @property
    def material(self) -> Material:
        """The solid that the table is for."""
        names = ("relaxation_time", "modulus", "equilibrium_modulus", "parallel_viscosity",
                 "poisson_ratio")
        window = self.data["shortest"], self.data["longest"]
        return Material.prony(*(self.data[name] for name in names),
                              window=window if window[0] < window[1] else None)

    @property
    def limits(self) -> list[str]:
        """Which limits of the model are passed, and from which speed on, in words."""
        rebound = self.info.rebound_speed
        words = [f"no rebound up to {rebound:.4g} m/s"] if rebound > 0 else []
        words += [text.format(getattr(self.info, name)) for name, text in _FROM
                  if np.isfinite(getattr(self.info, name))]
        beta, limit = abs(self.data["dundurs_beta"]), self.data["dundurs_limit"]
        coupled = beta > limit and self.info.friction > 0
        return words + [f"Dundurs' |beta| {beta:.3g} above {limit:g}"] * coupled

    def contact(self, material: Any = None, *, touch_gap: float = 1e-6,
                **contact: Any) -> TableContact:
        """Another contact of this table: solid spheres of other sizes, another friction.

        Parameters
        ----------
        material : Material, optional
            That of the table (default), or with all times and all moduli times a factor each.
        touch_gap : float
            For `collide`: how far apart, over the radii, bodies still touch; in [0, 1].
        **contact
            As in `pair`; without friction that of the table.

        Raises
        ------
        DomainError
            The table does not serve it.
        """
        made = TableContact(touch_gap=touch_gap)
        contact = {"friction": self.info.friction, **contact}
        scene, _kept = _scene(self.material if material is None else material, contact)
        call(_library.table.restitute_table_contact_set, self._handle, scene, made.struct)
        return made

    def pair(self, normal_speed: Any, sliding_speed: Any = 0.0,
             contact: TableContact | None = None, *, check: bool = True,
             **other: Any) -> TablePairs:
        """The pairs of impacts.

        Parameters
        ----------
        normal_speed : array_like
            m/s, approaching, in [0, 1e100]. Beyond the range its end is taken.
        sliding_speed : array_like
            m/s, of the contact point: tangential speed + radius * spin. Both broadcast.
        contact : TableContact, optional
            By default the table's own.
        check : bool
            Count what is beyond the range and the limits, which takes longer than the look-up.

        Raises
        ------
        DomainError
            The first speed that is out of its range.

        Warns
        -----
        ModelLimitWarning
            How many speeds are beyond the range of the table, or beyond a limit of the model.
        """
        if other:
            raise TypeError(f"'{min(other)}' is no keyword of Table.pair: give normal_speed and "
                            "sliding_speed, which is tangential_speed + radius * spin")
        normal, sliding, shape = _speeds(normal_speed, sliding_speed)
        ez, ex = np.empty(normal.size), np.empty(normal.size)
        call(_library.table.restitute_table_pair_many, self._handle, _struct(contact), ez.size,
             *map(_library.pointer, (normal, sliding, ez, ex)))
        if check:
            self._warn(normal, sliding, contact)
        return TablePairs(ez.reshape(shape)[()], ex.reshape(shape)[()],
                          partial(self.flags, normal_speed, sliding_speed, contact))

    def collide(self, first: Body, second: Body,
                contact: TableContact | None = None) -> tuple[Body, Body, TablePairs]:
        """What two bodies that touch, or many pairs of them, do: `restitute.collide` by the table.

        Parameters
        ----------
        first, second : Body
            Of any size, with the table's chi. What deforms is what the table was built for. Half
            the size of solid spheres is 32 times the speed in the table.
        contact : TableContact, optional
            By default the table's own; the size is that of the bodies.

        Raises
        ------
        DomainError
            The first pair that does not touch or that separates, or that the table does not serve.

        Warns
        -----
        ModelLimitWarning
            How many impacts are beyond the range of the table, whose end is then taken.
        """
        shape, bodies = records_of(first, second, {})
        count = int(np.prod(shape))
        ez, ex, error, beyond = np.empty(count), np.empty(count), ffi.new("restitute_error *"), 0
        function, arrays = _library.table.restitute_table_collide, [
            *(_library.pointer(body, "restitute_body[]") for body in bodies),
            _library.pointer(ez), _library.pointer(ex)]
        for i in range(count):
            status = function(self._handle, _struct(contact), *(one + i for one in arrays), error)
            beyond += error.message[0] != b"\0"
            if status < 0:
                place = f"{list(map(int, np.unravel_index(i, shape)))}: " if shape else ""
                raise _library.exception(status, place + _library.message_of(error))
        if beyond:
            which = f"{beyond} of {count} impacts are" if count > 1 else "the impact is"
            _library.warn(f"{which} outside the table's range, whose ends are taken",
                          errors.ModelLimitWarning)
        first, second = after((first, second), bodies, shape, [])
        return first, second, TablePairs(ez.reshape(shape)[()], ex.reshape(shape)[()])

    def beyond(self, normal_speed: Any, contact: TableContact | None = None) -> Any:
        """Whether normal speeds (m/s) are outside the range, whose end is then taken."""
        low, high = self.speed
        speed = np.asarray(normal_speed, float) * (contact.speed_factor if contact else 1)
        if self.info.speeds <= 2 and low < high:  # e_z is the same at all speeds
            return np.zeros(speed.shape, bool)[()]
        return (speed < low) | (speed > high)

    def flags(self, normal_speed: Any, sliding_speed: Any = 0.0,
              contact: TableContact | None = None) -> Any:
        """Which limits of the model impacts pass: of the table's own contact, or of another one.

        Returns
        -------
        ndarray of int
            Bits as in `restitute.impact.LIMITS`. Outside the range those of its ends.
        """
        data, (normal, sliding, shape) = self.data, _speeds(normal_speed, sliding_speed)
        nodes, strain = data["speed"], data["strain"]
        of = contact or SimpleNamespace(**data, speed_factor=1, strain_factors=np.ones(4))
        coupled = of.psi_factor < np.inf and abs(of.dundurs_beta) > data["dundurs_limit"]
        place = np.clip(normal * of.speed_factor, data["low"], data["high"])
        i = np.clip(np.searchsorted(nodes, place, "right") - 1, 0, len(nodes) - 2)
        with np.errstate(all="ignore"):  # ratios are powers of the speed between nodes
            u = np.log(place / nodes[i]) / np.log(nodes[i + 1] / nodes[i])
            low, high = strain[i].T, strain[i + 1].T
            powers = (low > 0) & np.isfinite(low) & np.isfinite(high)
            at = np.where(powers, low * (high / low) ** u, np.maximum(low, high))
            at *= np.array([*of.strain_factors])[:, None]
            passed = (at[0] > data["speed_limit"], at[1] > data["radius_limit"],
                      at[2] * np.abs(sliding) > data["displacement_limit"] * normal,
                      np.full(normal.shape, coupled),
                      (at[3] < data["shortest"]) | (at[3] > data["longest"]))
        return sum(bit * hit for (bit, *_), hit in zip(LIMITS, passed)).reshape(shape)[()]

    def _warn(self, normal, sliding, contact):
        outside = int(np.count_nonzero(self.beyond(normal, contact)))
        if outside:
            low, high = (end / (contact.speed_factor if contact else 1) for end in self.speed)
            which = (f"{outside} of {normal.size} normal speeds are" if normal.size > 1 else
                     "the normal speed is")
            _library.warn(f"{which} outside the table's range, {low:.6g} to {high:.6g} m/s, whose "
                          "ends are taken", errors.ModelLimitWarning)
        flags = self.flags(normal, sliding, contact)
        for bit, _, option, _, words in LIMITS:
            count = int(np.count_nonzero(flags & bit))
            if count:
                which = f"{count} of {flags.size} impacts: " if flags.size > 1 else ""
                limit = self.data[option] if option else 0
                _library.warn(which + words.format(limit), errors.ModelLimitWarning)

    def __repr__(self):
        low, high = self.speed
        return (f"<restitute.Table {low:.4g} to {high:.4g} m/s, errors {self.info.error_ez:.1g}, "
                f"{self.info.error_ex:.1g}>")


def _files():
    if not _library.available("table_files"):
        raise errors.MissingComponent(
            "the component table_files (HDF5) is not installed with this package: use pickle, or "
            "build from source")
    return _library.table_files


def not_csv(name: str, path: str | os.PathLike) -> None:
    """Refuse a name ending in .csv for a table."""
    if os.fspath(path).lower().endswith(".csv"):
        raise errors.DomainError(f"{name} = {os.fspath(path)}: a table is an HDF5 file, not CSV: "
                                 "take .h5")


def _struct(contact):
    return contact.struct if contact else ffi.NULL


def _speeds(normal, sliding):
    """Both as contiguous arrays of one dimension, and their broadcast shape."""
    both = {"normal_speed": normal, "sliding_speed": sliding}
    both = {name: numbers(name, value) for name, value in both.items()}
    shape = broadcast(both)
    return (*(np.ascontiguousarray(np.broadcast_to(one, shape)).ravel()
              for one in both.values()), shape)


def _scene(material, contact):
    """The one contact of these keywords: a restitute_scene, and what must outlive it."""
    for name in ("speed", "normal_speed", "tangential_speed", "angle", "spin", "spin2"):
        if name in contact:
            raise TypeError(f"'{name}' is no keyword of a table, which is of all speeds and angles"
                            " (see speeds)")
    impacts = Impacts(material, **contact, speed=1.0)  # the library does not use it
    if impacts.kind != "scene" or impacts.shape:
        raise errors.DomainError("a table is of one contact in SI units, not of arrays or chi")
    if impacts.refused:
        raise errors.DomainError(impacts.refused[0])
    return _library.pointer(impacts.bound(), "restitute_scene[]"), impacts
