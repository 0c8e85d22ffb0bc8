# SPDX-License-Identifier: BSD-3-Clause
"""The contact force of soft-sphere DEM, for arrays of contacts."""
from __future__ import annotations

from collections import namedtuple

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.materials import Material

__all__ = ["ContactForces", "ContactLaw"]

ContactForces = namedtuple("ContactForces", "normal tangential")
ContactForces.__doc__ = """Forces on body 1, N: `normal`, shape (n,), along minus the normal; `tangential`, shape
(n, 3). Body 2 gets the opposite."""


class ContactLaw:
    """A viscoelastic contact with friction and memory (docs/contact.md); immutable, and threads may share it.

    The state of a contact is a row of an array, which the caller keeps from the first overlap until
    the bodies separate. The normal points from body 1 into body 2; relative motion is 1 minus 2.

    Parameters
    ----------
    material : Material
    partner : "rigid" or "same"
        One body deforms, or both, of the material.
    elements : int
        8, 16, 24 or 32: the error falls with the square.
    terms : int
        Most Prony terms kept, 1 to 8. A material with more is reduced, for which `shortest` and
        `longest` (s) must be given: the time step and the longest contact time of interest.
    slip_cycles, frictionless, details : bool
        See `restitute_contact_law_options` in contact.h.

    Raises
    ------
    DomainError
        A value is out of its range; the reduced series misses more than half of G(t).

    Examples
    --------
    A sphere of 1 mm bounces on a wall (velocity Verlet):

    >>> import numpy as np, restitute
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> law, mass, speed = restitute.ContactLaw(rubber), 5e-6, -0.1
    >>> step, states, overlap, force = float(law.time_step_limit(mass, 1e-3, 0.1)), law.states(1), 0.0, 0.0
    >>> while overlap >= 0:
    ...     half = speed + step / 2 * force / mass
    ...     overlap -= step * half
    ...     if overlap <= 0:
    ...         break
    ...     force = law.step(states, step, overlap=overlap, velocity=[0, 0, -half], radius=1e-3,
    ...                      inverse_mass=1 / mass).normal[0]
    ...     speed = half + step / 2 * force / mass
    >>> pair = restitute.pair(rubber, radius=1e-3, mass=mass, friction=0.3, speed=0.1)
    >>> bool(abs(speed / 0.1 - pair.ez) < 0.01)
    True
    """

    def __init__(self, material: Material, *, partner="rigid", elements=8, terms=4, slip_cycles=False,
                 shortest=0.0, longest=0.0, frictionless=False, details=False):
        if partner not in ("rigid", "same"):
            raise errors.DomainError(f"partner = {partner!r}: must be rigid or same; see Material.effective")
        options = _library.struct("contact_law_options", "contact", deformable=2 if partner == "same" else 1,
                                  elements=elements, terms=terms, slip_cycles=slip_cycles, shortest=shortest,
                                  longest=longest, frictionless=frictionless, details=details)
        handle = ffi.new("restitute_contact_law **")
        status, message = call(_library.contact.restitute_contact_law_create, material._handle, options, handle)
        self._handle = ffi.gc(handle[0], _library.contact.restitute_contact_law_destroy)
        if status:
            _library.warn(message, errors.ToleranceWarning)

    @property
    def state_size(self) -> int:
        """Numbers of the state of a contact."""
        return _library.contact.restitute_contact_law_state_size(self._handle)

    @property
    def hash(self) -> int:
        """A number that two laws share if they are the same, for restart files."""
        return _library.contact.restitute_contact_law_hash(self._handle)

    def states(self, count: int) -> np.ndarray:
        """States of new contacts, zeros of shape (count, state_size)."""
        return np.zeros((count, self.state_size))

    def time_scale(self, mass, radius, speed) -> np.ndarray:
        """Largest overlap over speed, s, of impacts of effective masses (kg) and radii (m) at normal speeds (m/s).
        Arrays broadcast. An elastic impact lasts 2.943 of it."""
        return self._times(_library.contact.restitute_contact_time_scale, mass, radius, speed)

    def time_step_limit(self, mass, radius, speed) -> np.ndarray:
        """Largest time step that is safe for such impacts, s: a fiftieth of the contact time."""
        return self._times(_library.contact.restitute_contact_time_step_limit, mass, radius, speed)

    def _times(self, function, *numbers):
        numbers = np.broadcast_arrays(*(np.asarray(number, float) for number in numbers))
        times, one = np.empty(numbers[0].shape), ffi.new("double *")
        for place in np.ndindex(times.shape):
            call(function, self._handle, *(number[place] for number in numbers), one)
            times[place] = one[0]
        return times

    def motions(self, count: int) -> np.ndarray:
        """Records of `restitute_contact_motion`, shape (count,), at rest: to be filled in and given to `step`."""
        return _library.structs("contact_motion", count, "contact")

    def step(self, states, step, motions=None, *, rows=None, **members) -> ContactForces:
        """Advance contacts by a time step, their states in place.

        Parameters
        ----------
        states : ndarray of float, shape (n, state_size)
        step : float
            s.
        motions : ndarray, optional
            Of `motions`, shape (m,); by default a new one.
        rows : array_like of int, shape (m,), optional
            Which contacts; by default all. No row twice.
        **members : array_like
            What is written into `motions`, broadcast to shape (m,) or (m, 3): `overlap` (m, at the
            end of the step), `normal`, `velocity` (m/s, of the surface of body 1 relative to that
            of 2), `spin` (rad/s), `inverse_mass` and `inverse_tangential_mass` (1/kg), `radius`
            (m), `friction`.

        Returns
        -------
        ContactForces

        Raises
        ------
        DomainError
            A contact failed: its state is untouched, all others have advanced. The exception has
            the `index`, the `statuses` of all, and their `forces`.
        """
        pointers = self._pointers(states, rows)
        if motions is None:
            motions = self.motions(len(pointers))
        elif len(motions) != len(pointers):
            raise errors.DomainError(f"motions: {len(motions)} are given, must be {len(pointers)}, one a contact")
        for name, value in members.items():
            if name not in motions.dtype.names[1:]:
                raise TypeError(f"step() has no '{name}': {', '.join(motions.dtype.names[1:])}")
            motions[name] = value
        rates = _library.struct("contact_rates", "contact")
        call(_library.contact.restitute_contact_rates_set, self._handle, step, rates)
        forces = np.zeros(len(pointers), _library.array_type("contact_force"))
        statuses = np.zeros(len(pointers), np.int32)
        out = ContactForces(forces["normal"], forces["tangential"])
        try:
            call(_library.contact.restitute_contact_step_many, self._handle, rates, len(pointers),
                 _library.pointer(motions, "restitute_contact_motion[]"), _library.pointer(pointers, "double *[]"),
                 _library.pointer(forces, "restitute_contact_force[]"), _library.pointer(statuses))
        except errors.Error as problem:
            problem.statuses, problem.forces = statuses, out
            problem.index = int(np.argmax(statuses < 0)) if (statuses < 0).any() else None
            raise
        return out

    def _pointers(self, states, rows=None):
        """Where the states are, as an array of pointers."""
        size = self.state_size
        if not (isinstance(states, np.ndarray) and states.dtype == float and states.flags.c_contiguous
                and states.flags.writeable and states.shape[1:] == (size,)):
            raise errors.DomainError(f"states: must be a writable, contiguous array of float of shape (n, {size})")
        if rows is None:
            rows = np.arange(len(states))
        else:
            rows = np.asarray(rows, np.intp).ravel()
            if rows.size and not 0 <= rows.min() <= rows.max() < len(states):
                raise errors.DomainError(f"rows = {rows.min()} to {rows.max()}: must be in [0, {len(states) - 1}]")
            if np.bincount(rows).max(initial=0) > 1:
                raise errors.DomainError("rows: a contact is given twice")
        return states.ctypes.data + rows.astype(np.uint64) * np.uint64(8 * size)

    def _each(self, function, states, *more):
        """Call function(law, more of a row, state, error) for each state; arrays of more are (n,) or (n, 3)."""
        for k, address in enumerate(self._pointers(states)):
            call(function, self._handle, *(one[k] for one in more[:-1]), ffi.cast("double *", int(address)),
                 *more[-1][k])

    def peek(self, states, normal=(0, 0, 1)) -> ContactForces:
        """The forces of the last step again, without advancing; `normal` (3,) or (n, 3), unit vectors of now."""
        forces = np.zeros(len(states), _library.array_type("contact_force"))
        where = _library.pointer(forces, "restitute_contact_force[]")
        self._each(_library.contact.restitute_contact_peek, states, _vectors(normal, len(states)),
                   [(where + k,) for k in range(len(states))])
        return ContactForces(forces["normal"], forces["tangential"])

    def details(self, states, radius) -> np.ndarray:
        """What contacts have done since they began; of a law made with `details`.

        Returns
        -------
        ndarray, shape (n,)
            Records of `restitute_contact_details`: `contact_radius`, `stick_radius` (m), `work`,
            `stored`, `friction`, `viscous` (J), `friction_power`, `viscous_power` (W).
        """
        records = _library.structs("contact_details", len(states), "contact")
        where = _library.pointer(records, "restitute_contact_details[]")
        self._each(_library.contact.restitute_contact_details_get, states, np.broadcast_to(radius, len(states)),
                   [(where + k,) for k in range(len(states))])
        return records

    def turn(self, states, before, after) -> None:
        """Turn the memory of contacts whose normal jumps; `before`, `after` (3,) or (n, 3), unit vectors."""
        count = len(states)
        self._each(_library.contact.restitute_contact_turn, states, _vectors(before, count), _vectors(after, count),
                   [()] * count)

    def series(self) -> dict:
        """The Prony series that the law computes with: `equilibrium_modulus` (Pa), `parallel_viscosity` (Pa s),
        `relaxation_time` (s) and `modulus` (Pa), arrays, and `error_bound`, relative, of a reduced series."""
        out = [ffi.new("double *"), ffi.new("double *"), ffi.new("size_t *"), ffi.new("double[8]"),
               ffi.new("double[8]"), ffi.new("double *")]
        call(_library.contact.restitute_contact_law_series, self._handle, *out)
        count = out[2][0]
        return {"equilibrium_modulus": out[0][0], "parallel_viscosity": out[1][0],
                "relaxation_time": np.array(list(out[3])[:count]), "modulus": np.array(list(out[4])[:count]),
                "error_bound": out[5][0]}


def _vectors(vectors, count):
    """`count` vectors for C."""
    array = np.ascontiguousarray(np.broadcast_to(np.asarray(vectors, float), (count, 3)))
    return [ffi.from_buffer("double[]", one) for one in array]
