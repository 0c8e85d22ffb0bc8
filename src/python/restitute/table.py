# SPDX-License-Identifier: BSD-3-Clause
"""Tables of restitution pairs: some ten nanoseconds a pair, with a verified error."""
from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any, Callable, Sequence

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.executor import map_chunks
from restitute.impact import LIMITS
from restitute.materials import Material
from restitute.scenes import Impacts

__all__ = ["Table", "TableContact", "TablePairs", "build_tables"]


class TablePairs:
    """Pairs that a table gives; `ez, ex = table.pair(...)` takes them apart.

    Attributes
    ----------
    ez, ex : ndarray
        Of the broadcast shape of the speeds.
    flags : ndarray of int or None
        Which limits of the model are passed, see `Table.flags`; None for a contact that is not the
        table's own.
    """

    def __init__(self, ez, ex, flags):
        self.ez, self.ex, self._flags = ez, ex, flags

    @property
    def flags(self) -> Any:
        return self._flags()

    def __iter__(self):
        return iter((self.ez, self.ex))

    def __repr__(self):
        return f"<restitute.TablePairs ez={self.ez}, ex={self.ex}>"


_LIMITS = (("fast_speed", "not slow against shear waves from {:.4g} m/s on"),
           ("large_contact_speed", "contact not small against the sphere from {:.4g} m/s on"),
           ("long_slide_speed", "long slide at 45 degrees from {:.4g} m/s on"))


class TableContact:
    """Another contact that a table serves, made by `Table.contact`.

    Attributes
    ----------
    speed_factor, psi_factor : float
        Speed in the table over speed of this contact; psi v_n/|v_t|.
    radius, mass : float
        Effective ones, m and kg.
    """

    def __init__(self, struct):
        self._struct = struct
        self.__dict__.update(_library.members(struct))


class Table:
    """Restitution pairs of one contact over normal and sliding speed.

    Made by `Table.build` or `Table.load`; immutable; threads may share it. It can be pickled.

    Attributes
    ----------
    info : types.SimpleNamespace
        What the table says of itself, the members of the library's `restitute_table_info`: `speed`
        (m/s, the range covered), `error_ez` and `error_ex` (verified), `tolerance`, `chi`,
        `friction`, `radius`, `mass`, `fast_speed`, `large_contact_speed`, ...
    """

    def __init__(self, handle):
        self._handle = ffi.gc(handle, _library.table.restitute_table_destroy)
        struct = _library.struct("table_info", "table")
        call(_library.table.restitute_table_describe, self._handle, struct)
        self.info = SimpleNamespace(**_library.members(struct))
        self._data = None

    @classmethod
    def build(cls, material: Material, *, speeds=(1e-4, 100.0), tolerance=1e-5, threads=1, max_impacts=None,
              time_limit=None, speed_limit=None, radius_limit=None, displacement_limit=None, **contact) -> Table:
        """Build a table of one contact: hundredths of a second to seconds.

        Parameters
        ----------
        material : Material
            What deforms.
        speeds : float or (float, float)
            Lowest and highest normal speed, m/s.
        tolerance : float
            Largest absolute error of ez and ex, in [1e-7, 0.1]. A table that misses it warns
            (`ToleranceWarning`) and states its errors.
        threads : int
            The table has the same bits for all; 0: as many as there are.
        max_impacts : int, optional
            Refinement ends at 0.8 of so many impacts; default 12000.
        time_limit : float, optional
            It ends likewise at 0.8 of so many seconds; default 20; inf: no limit.
        speed_limit, radius_limit, displacement_limit : float, optional
            Limits of the model, as in `pair`.
        **contact
            As in `pair`: `radius`, `density` or `mass`, `friction`, `radius2`, `partner`, ...

        Raises
        ------
        DomainError
            A value is out of its range, which the text names.
        SolverError
            `max_impacts` is too small for any table.
        KeyboardInterrupt
            By Ctrl-C, at once.

        Examples
        --------
        >>> import restitute
        >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
        >>> table = restitute.Table.build(rubber, radius=0.001, density=1200, friction=0.3,
        ...                               speeds=(0.01, 0.1), tolerance=1e-3)
        >>> table.pair([0.02, 0.05], 0.03).ez.shape
        (2,)
        """
        options = _library.struct("table_options", "table", threads=threads, tolerance=tolerance)
        options.speed = [float(speed) for speed in np.broadcast_to(speeds, 2)]
        for name, value in (("max_impacts", max_impacts), ("time_limit", time_limit), ("speed_limit", speed_limit),
                            ("radius_limit", radius_limit), ("displacement_limit", displacement_limit)):
            if value is not None:
                setattr(options, name, value)
        handle = ffi.new("restitute_table **")
        scene, _impacts = _scene(material, contact)
        status, message = _library.interruptible(_library.table.restitute_table_build, scene, options, handle)
        if status:
            _library.warn(message, errors.ToleranceWarning)
        return cls(handle[0])

    @classmethod
    def load(cls, path: str | os.PathLike) -> Table:
        """A table from its HDF5 file (the layout is that of table_files.h).

        Raises
        ------
        FileError, FormatError
            It cannot be read; it is no table, damaged, or of another schema.
        """
        handle = ffi.new("restitute_table **")
        call(_library.table_files.restitute_table_read, _library.string(path), handle)
        return cls(handle[0])

    def save(self, path: str | os.PathLike) -> None:
        """Write the table into an HDF5 file, whole or not at all.

        Raises
        ------
        FileError
            It cannot be written; what was there stays.
        """
        call(_library.table_files.restitute_table_write, self._handle, _library.string(path))

    @classmethod
    def from_data(cls, data: dict) -> Table:
        """A table of the numbers that `data` gave."""
        struct = _library.struct("table_data", "table")
        arrays = []
        for name, value in data.items():
            if isinstance(value, np.ndarray):
                arrays.append(np.ascontiguousarray(value, float))
                value = _library.pointer(arrays[-1].ravel())
            setattr(struct, name, value.encode() if isinstance(value, str) else value)
        handle = ffi.new("restitute_table **")
        call(_library.table.restitute_table_create, struct, handle)
        return cls(handle[0])

    @property
    def data(self) -> dict:
        """All numbers of the table, the members of the library's `restitute_table_data`: `speed` (n,), `ez` (n, 2),
        `ex` (n, places of psi, 4), `strain` (n, 3), ... (table.h says what they are)."""
        if self._data is None:
            struct = _library.struct("table_data", "table")
            call(_library.table.restitute_table_data_get, self._handle, struct)
            data = _library.members(struct)
            n, places = struct.speeds, struct.stick_cells + struct.slip_cells + 2
            shapes = {"relaxation_time": (struct.terms,), "modulus": (struct.terms,), "speed": (n,), "ez": (n, 2),
                      "strain": (n, 3), "ex": (n, places, 4)}
            for name, shape in shapes.items():
                size = int(np.prod(shape))
                values = ffi.buffer(getattr(struct, name), 8 * size) if size else b""
                data[name] = np.frombuffer(values, float).reshape(shape).copy()
            self._data = data
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
        data = self.data
        return Material.prony(data["relaxation_time"], data["modulus"], data["equilibrium_modulus"],
                              data["parallel_viscosity"], data["poisson_ratio"])

    @property
    def limits(self) -> list[str]:
        """Which limits of the model are passed, and from which speed on, in words."""
        said = [text.format(getattr(self.info, name)) for name, text in _LIMITS if np.isfinite(getattr(self.info, name))]
        rebound = self.info.rebound_speed
        return ([f"no rebound up to {rebound:.4g} m/s"] if rebound > 0 else []) + said

    def contact(self, material: Material | None = None, *, touch_gap: float = 1e-6, **contact) -> TableContact:
        """Another contact of this table: other sizes of solid spheres, other friction, the material at another
        temperature.

        Parameters
        ----------
        material : Material, optional
            That of the table (the default), or it with all times or all moduli times one factor.
        touch_gap : float
            For `collide`: how far apart, over the radii, bodies still touch; in [0, 1].
        **contact
            As in `pair`.

        Raises
        ------
        DomainError
            The table does not serve it.
        """
        struct = _library.struct("table_contact", "table", touch_gap=touch_gap)
        scene, _impacts = _scene(material or self.material, contact)
        call(_library.table.restitute_table_contact_set, self._handle, scene, struct)
        return TableContact(struct)

    def pair(self, normal_speed, sliding_speed=0.0, contact: TableContact | None = None, *, check=True) -> TablePairs:
        """The pairs of impacts.

        Parameters
        ----------
        normal_speed : array_like
            m/s, approaching, in [0, 1e100]. Beyond the range of the table its end is taken.
        sliding_speed : array_like
            m/s, of the contact point, spin included; broadcast against `normal_speed`.
        contact : TableContact, optional
            By default the table's own.
        check : bool
            Warn (`ModelLimitWarning`) how many speeds are beyond the range or beyond the limits of
            the model, which takes longer than the look-up.

        Returns
        -------
        TablePairs
        """
        normal, sliding, shape = _speeds(normal_speed, sliding_speed)
        ez, ex = np.empty(normal.size), np.empty(normal.size)
        call(_library.table.restitute_table_pair_many, self._handle, contact._struct if contact else ffi.NULL, ez.size,
             *map(_library.pointer, (normal, sliding, ez, ex)))
        if check:
            self._warn(normal, sliding, contact)
        return TablePairs(ez.reshape(shape)[()], ex.reshape(shape)[()],
                          lambda: None if contact else self.flags(normal_speed, sliding_speed))

    def beyond(self, normal_speed, contact: TableContact | None = None):
        """Whether normal speeds (m/s, an array) are outside the range of the table, whose end is then taken."""
        low, high = self.info.speed
        speed = np.asarray(normal_speed, float) * (contact.speed_factor if contact else 1)
        if self.info.speeds <= 2 and low < high:  # e_z is the same at all speeds
            return np.zeros(speed.shape, bool)[()]
        return (speed < low) | (speed > high)

    def flags(self, normal_speed, sliding_speed=0.0):
        """Which limits of the model impacts of the table's own contact pass.

        Returns
        -------
        ndarray of int
            Bits of `restitute_flag`: FAST, LARGE_CONTACT, LONG_SLIDE. Outside the range those of
            its ends.
        """
        core, data = _library.core, self.data
        normal, sliding, shape = _speeds(normal_speed, sliding_speed)
        place = np.clip(normal, data["low"], data["high"])
        nodes, strain = data["speed"], data["strain"]
        i = np.clip(np.searchsorted(nodes, place, "right") - 1, 0, len(nodes) - 2)
        with np.errstate(all="ignore"):
            u = np.log(place / nodes[i]) / np.log(nodes[i + 1] / nodes[i])
            low, high = strain[i].T, strain[i + 1].T
            at = np.where((low > 0) & np.isfinite(high), low * (high / low) ** u, np.maximum(low, high))
            slide = at[2] * np.abs(sliding) > data["displacement_limit"] * normal
        return ((at[0] > data["speed_limit"]) * core.RESTITUTE_FLAG_FAST
                | (at[1] > data["radius_limit"]) * core.RESTITUTE_FLAG_LARGE_CONTACT
                | slide * core.RESTITUTE_FLAG_LONG_SLIDE).reshape(shape)[()]

    def _warn(self, normal, sliding, contact):
        outside = int(np.count_nonzero(self.beyond(normal, contact)))
        low, high = self.info.speed
        if outside:
            _library.warn(f"{outside} of {normal.size} normal speeds are outside the table's range, {low:.6g} to "
                          f"{high:.6g} m/s, whose ends are taken", errors.ModelLimitWarning)
        if contact:
            return  # the limits in the table are those of its own contact
        flags = self.flags(normal, sliding)
        for bit, _, option, _, words in LIMITS:
            count = int(np.count_nonzero(flags & bit))
            if count:
                _library.warn(f"{count} of {flags.size} impacts: {words.format(self.data[option])}",
                              errors.ModelLimitWarning)

    def __repr__(self):
        low, high = self.info.speed
        return f"<restitute.Table {low:.4g} to {high:.4g} m/s, errors {self.info.error_ez:.1g}, {self.info.error_ex:.1g}>"


def _speeds(normal, sliding):
    """Both as contiguous arrays of one dimension, and their broadcast shape."""
    both = np.broadcast_arrays(np.asarray(normal, float), np.asarray(sliding, float))
    return (*(np.array(one, float).ravel() for one in both), both[0].shape)


def _scene(material, contact):
    """The one contact of these keywords: an array of one restitute_scene, and what must outlive it."""
    if "speed" not in contact and "normal_speed" not in contact:
        contact = {**contact, "speed": 1.0}  # the library does not use it
    impacts = Impacts(material, **contact)
    if impacts.kind != "scene" or impacts.shape:
        raise errors.DomainError("a table is of one contact in SI units, not of arrays, nor of chi and psi")
    if impacts.refused:
        raise errors.DomainError(impacts.refused[0])
    return _library.pointer(impacts.bound(), "restitute_scene[]"), impacts


def build_tables(materials: Sequence[Material], *, executor: Any = None, threads: int = 1, retries: int = 3,
                 progress: Callable[[int, int], Any] | None = None, **keywords: Any) -> list[list[Table]]:
    """The tables of all pairs of some materials: both bodies deform.

    Parameters
    ----------
    materials : sequence of n Materials, names or paths
    executor : concurrent.futures.Executor or distributed.Client, optional
        Build there, a table a task; by default in `threads` threads. The tables have the same bits.
    progress : callable
        progress(tables done, of all).
    **keywords
        As of `Table.build`, without `partner`.

    Returns
    -------
    list of n lists of n Tables
        tables[i][j] is tables[j][i], of the materials i and j.

    Raises
    ------
    DomainError, SolverError
        The first failure; what is running then or at Ctrl-C ends within its `time_limit`.

    Examples
    --------
    >>> import restitute
    >>> soft, hard = restitute.Material.kelvin_voigt(1e6, 50.0), restitute.Material.elastic(1e7)
    >>> tables = build_tables([soft, hard], radius=0.01, density=1000, radius2=0.01, density2=1000, friction=0.3,
    ...                       speeds=(0.01, 1), tolerance=1e-2)
    >>> tables[0][1] is tables[1][0], len(tables)
    (True, 2)
    """
    pairs = [(i, j) for j in range(len(materials)) for i in range(j + 1)]
    tasks = [(materials[i], "same" if i == j else materials[j], keywords) for i, j in pairs]
    pool = ThreadPoolExecutor(threads) if executor is None else None
    try:
        built = dict(zip(pairs, map_chunks(_build_task, tasks, executor or pool, retries=retries, progress=progress)))
    finally:
        if pool:
            pool.shutdown(wait=False)
    return [[built[min(i, j), max(i, j)] for j in range(len(materials))] for i in range(len(materials))]


def _build_task(task):
    material, partner, keywords = task
    return Table.build(material, partner=partner, **keywords)
