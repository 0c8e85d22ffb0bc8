# SPDX-License-Identifier: BSD-3-Clause
"""The contact force of soft-sphere DEM, for arrays of contacts."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import call, ffi
from restitute.materials import as_material
from restitute.values import broadcast, fit_shape, number, numbers, one_of

__all__ = ["ContactForces", "ContactLaw"]


class ContactForces(NamedTuple):
    """Forces on body 1, N; body 2 gets the opposite."""

    normal: np.ndarray  #: shape (n,), >= 0, along minus the normal
    tangential: np.ndarray  #: shape (n, 3)


class ContactLaw:
    """A viscoelastic contact with friction and memory (docs/contact.md).

    The state of a contact is a row of an array. The caller keeps it from the first overlap until
    the bodies separate. The normal points from body 1 into body 2; relative motion is 1 minus 2.
    A law is immutable, can be pickled, and threads may share it.

    Parameters
    ----------
    material : Material, name or path
    partner : "rigid" or "same"
        One body deforms, or both, of the material.
    **options
        Members of `restitute_contact_law_options` (contact.h): `elements` (8, 16, 24 or 32; the
        error falls with the square), `terms` (most Prony terms kept, 1 to 8; a material with more
        needs `shortest` and `longest`, s), `slip_cycles`, `frictionless`, `details`.

    Raises
    ------
    DomainError
        A value is out of its range, or the reduced series misses more than half of G(t).

    Warns
    -----
    ToleranceWarning
        The reduced series misses a fifth of G(t).

    Examples
    --------
    A sphere of 1 mm bounces on a wall (velocity Verlet), with the e_z of an impact:

    >>> import restitute
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> law, mass, speed = restitute.ContactLaw(rubber, frictionless=True), 5e-6, -0.1
    >>> step = law.time_step_limit(mass, 1e-3, 0.1)
    >>> states, overlap, force = law.states(1), 0.0, 0.0
    >>> while overlap >= 0:
    ...     speed += step / 2 * force / mass
    ...     overlap -= step * speed
    ...     force = law.step(states, step, overlap=overlap, velocity=[0, 0, -speed],
    ...                      radius=1e-3, inverse_mass=1 / mass).normal[0]
    ...     speed += step / 2 * force / mass
    >>> ez = restitute.pair(rubber, radius=1e-3, mass=mass, friction=0.3, speed=0.1).ez
    >>> bool(abs(speed / 0.1 - ez) < 0.01)
    True
    """

    def __init__(self, material: Any, *, partner: str = "rigid", **options: Any):
        one_of("partner", partner, ("rigid", "same"))
        self._given: tuple = (material, {"partner": partner, **options})
        members = {"deformable": 2 if partner == "same" else 1, **options}
        settings = _library.struct("contact_law_options", "contact", **members)
        handle, library = ffi.new("restitute_contact_law **"), _library.contact
        status, message = call(library.restitute_contact_law_create,
                               as_material("material", material)._handle, settings, handle)
        self._handle = ffi.gc(handle[0], library.restitute_contact_law_destroy)
        self.state_size = library.restitute_contact_law_state_size(handle[0])
        if status:
            _library.warn(message, errors.ToleranceWarning)

    def __reduce__(self):
        material, keywords = self._given
        return partial(ContactLaw, **keywords), (material,)

    def states(self, count: int) -> np.ndarray:
        """States of new contacts, zeros of shape (count, state_size)."""
        return np.zeros((count, self.state_size))

    def time_scale(self, mass: Any, radius: Any, speed: Any) -> Any:
        """Largest overlap over speed, s: an elastic impact lasts 2.943 of it.

        Parameters
        ----------
        mass, radius, speed : array_like
            Effective, kg and m; normal, m/s. They broadcast.
        """
        return self._times("time_scale", mass, radius, speed)

    def time_step_limit(self, mass: Any, radius: Any, speed: Any) -> Any:
        """Largest time step that is safe for such impacts, s: a fiftieth of the contact time."""
        return self._times("time_step_limit", mass, radius, speed)

    def _times(self, name, *given):
        function = getattr(_library.contact, f"restitute_contact_{name}")
        columns = {name: numbers(name, value)
                   for name, value in zip(("mass", "radius", "speed"), given)}
        times, one = np.empty(broadcast(columns)), ffi.new("double *")
        arrays = [np.broadcast_to(column, times.shape) for column in columns.values()]
        for place in np.ndindex(times.shape):
            call(function, self._handle, *(array[place] for array in arrays), one)
            times[place] = one[0]
        return times[()]

    def motions(self, count: int) -> np.ndarray:
        """Records of `restitute_contact_motion`, shape (count,), at rest, to be filled in for
        `step`."""
        return _library.structs("contact_motion", count, "contact")

    def step(self, states: np.ndarray, step: float, motions: np.ndarray | None = None, *,
             rows: Any = None, **members: Any) -> ContactForces:
        """Advance contacts by a time step, their states in place.

        Parameters
        ----------
        states : ndarray of float, shape (n, state_size)
        step : float
            s.
        motions : ndarray, shape (m,), optional
            Of `motions`; by default new ones.
        rows : array_like of int, shape (m,), optional
            Which contacts, none twice; by default all.
        **members : array_like
            Are written into `motions`, broadcast to (m,) or (m, 3): `overlap` (m, at the end of
            the step), `normal`, `velocity` (m/s, of the surface of body 1 relative to that of 2,
            mean of the step), `spin` (rad/s), `inverse_mass`, `inverse_tangential_mass` (1/kg),
            `radius` (m, effective), `friction`: required without `motions`, unless the law is
            `frictionless`.

        Raises
        ------
        DomainError
            A contact failed: its state is as it was, all others have advanced. The exception has
            its `index`, the `statuses` of all and their `forces`.
        """
        places, required = self._places(states, rows), False
        if motions is None:
            motions, required = self.motions(len(places)), not self._given[1].get("frictionless")
        elif (getattr(motions, "dtype", None) != _library.array_type("contact_motion")
              or not motions.flags.c_contiguous):
            raise errors.DomainError("motions: must be an array that `motions` made")
        elif motions.shape != (len(places),):
            raise errors.DomainError(f"motions: have the shape {motions.shape}, must be "
                                     f"{len(places)}")
        known = list(motions.dtype.fields or ())[1:]
        for name, value in members.items():
            if name not in known:
                raise TypeError(f"'{name}' is no keyword of step{errors.suggestion(name, known)}")
            motions[name] = fit_shape(name, numbers(name, value), motions[name].shape)
        if required and "friction" not in members:
            raise TypeError("friction is missing: must be in [0, 1e6], or the law frictionless")
        rates = _library.struct("contact_rates", "contact")
        call(_library.contact.restitute_contact_rates_set, self._handle, number("step", step),
             rates)
        records = np.zeros(len(places), _library.array_type("contact_force"))
        statuses = np.zeros(len(places), np.int32)
        forces = ContactForces(records["normal"], records["tangential"])
        try:
            call(_library.contact.restitute_contact_step_many, self._handle, rates, len(places),
                 _library.pointer(motions, "restitute_contact_motion[]"),
                 _library.pointer(places, "double *[]"),
                 _library.pointer(records, "restitute_contact_force[]"),
                 _library.pointer(statuses))
        except errors.Error as problem:
            problem.index = int(np.argmax(statuses < 0)) if np.any(statuses < 0) else None
            problem.statuses, problem.forces = statuses, forces  # type: ignore[attr-defined]
            raise
        return forces

    def _places(self, states, rows=None):
        """Where the states are: an array of pointers."""
        if not (isinstance(states, np.ndarray) and states.dtype == float
                and states.flags.c_contiguous and states.flags.writeable
                and states.shape[1:] == (self.state_size,)):
            raise errors.DomainError("states: must be a contiguous array of float that can be "
                                     f"written, of shape (n, {self.state_size})")
        if rows is None:
            rows = np.arange(len(states))
        else:
            rows = np.asarray(rows, np.intp).ravel()
            if rows.size and not 0 <= rows.min() <= rows.max() < len(states):
                raise errors.DomainError(
                    f"rows = {rows.min()} to {rows.max()}: must be in [0, {len(states) - 1}]")
            if np.bincount(rows).max(initial=0) > 1:
                raise errors.DomainError("rows: a contact is given twice")
        return states.ctypes.data + rows.astype(np.uint64) * np.uint64(states.strides[0])

    def details(self, states: np.ndarray, radius: Any) -> np.ndarray:
        """What contacts have done since they began; of a law made with `details`.

        Parameters
        ----------
        radius : array_like
            Effective, m; broadcast to (n,).

        Returns
        -------
        ndarray, shape (n,)
            Records of `restitute_contact_details`: `contact_radius`, `stick_radius` (m), `work`,
            `stored`, `friction`, `viscous` (J), `friction_power`, `viscous_power` (W).
        """
        records = _library.structs("contact_details", len(states), "contact")
        where = _library.pointer(records, "restitute_contact_details[]")
        radii = fit_shape("radius", numbers("radius", radius), (len(states),))
        for k, place in enumerate(self._places(states)):
            call(_library.contact.restitute_contact_details_get, self._handle, radii[k],
                 ffi.cast("double *", int(place)), where + k)
        return records
