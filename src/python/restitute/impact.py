# SPDX-License-Identifier: BSD-3-Clause
"""Restitution pairs of one impact or of arrays of them."""
from __future__ import annotations

from typing import Any, Callable

import numpy as np

from restitute import _library, errors
from restitute._library import ffi
from restitute.scenes import Columns, Impacts
from restitute.solving import OPTIONS, Solved, options, solve_records

__all__ = ["LIMITS", "Pairs", "pair", "solve"]

#: The limits of the model: flag, name, its option, the member of the result that it bounds, in words.
LIMITS = ((1, "FAST", "speed_limit", "speed_ratio", "speed above {:g} of the shear wave speed"),
          (2, "LARGE_CONTACT", "radius_limit", "radius_ratio", "contact radius above {:g} of the sphere's"),
          (4, "LONG_SLIDE", "displacement_limit", "displacement_ratio", "sliding distance above {:g} of the contact radius"),
          (8, "COUPLED", "dundurs_limit", "dundurs_beta", "Dundurs' |beta| above {:g}"))


class Pairs(Columns):
    """What came out of `pair`: arrays of the shape of the input, in SI units or those of the paper (T, d0, a_el).

    Attributes
    ----------
    ez, ex : ndarray
        Restitution coefficients; ex > 0 if the contact point turns back.
    error_ez, error_ex : ndarray
        Their estimated errors.
    contact_time, max_indentation, max_contact_radius, max_normal_force : ndarray
    speed_ratio, radius_ratio, displacement_ratio, dundurs_beta, flags : ndarray
        What strains the model, and bits of those that pass their limits (`LIMITS`).
    work, elements, steps, element_spacing, time_step, terms_merged, merging_bound : ndarray
        Of the computation, see `restitute_result` in include/restitute/restitute.h.
    status : ndarray of int
        0 done, positive done with a remark, negative failed (its numbers are nan).
    ledger : Columns or None
        With energies=True: rebound_z, viscous_z, left_z, residual_z, rebound_x, friction_x, viscous_x, left_x,
        residual_x, as fractions of the energy that came in.
    method : str
    impacts : Impacts
    settings : Columns-like
        restitute_options in use: `settings.tolerance`, `settings.radius_limit`, ...
    """

    _hidden = ("struct_size", "method")

    def __init__(self, impacts: Impacts, solved: Solved, settings: dict):
        shape = impacts.shape
        super().__init__(solved.results.reshape(shape))
        self.impacts, self._asked, self._messages = impacts, settings, {**solved.messages, **impacts.refused}
        self.status = solved.status.reshape(shape)[()]
        self.ledger = None if solved.ledgers is None else Columns(solved.ledgers.reshape(shape))
        self.method = settings["method"]

    @property
    def settings(self) -> Any:
        """restitute_options in use."""
        return options(**self._asked)

    def message(self, index: Any = ()) -> str:
        """Why this impact failed, or the library's remarks on it; empty if there are none.

        Parameters
        ----------
        index : int or tuple of int
            Place in the arrays; not needed for one impact.
        """
        flat = int(np.ravel_multi_index(index if isinstance(index, tuple) else (index,), self.shape)) if self.shape else 0
        if flat not in self._messages and np.ravel(self.status)[flat] != 0 or np.ravel(self.flags)[flat] != 0:
            again = solve_records(self.impacts[flat:flat + 1], {**self._asked, "threads": 1})
            self._messages.setdefault(flat, again.messages.get(0, ""))
        return self._messages.get(flat, "")

    def words(self) -> np.ndarray:
        """A line for each impact: empty, or a remark and the names of the limits that are passed ("FAST
        LARGE_CONTACT"), or why it failed. Array of str of the shape of the input."""
        status, flags = np.ravel(self.status), np.ravel(self.flags)
        kinds, place = np.unique(status.astype(np.int64) * 16 + flags, return_inverse=True)
        lines = np.array([_line(*divmod(int(kind), 16)) for kind in kinds], object)[place.ravel()]
        for i in np.flatnonzero(status < 0):
            lines[i] = self.message(tuple(int(k) for k in np.unravel_index(i, self.shape)))
        return lines.reshape(self.shape)

    def limits(self) -> list[tuple[str, int, str]]:
        """The limits of the model that are passed: (name, by how many impacts, in words).

        >>> from restitute import Material
        >>> pair(Material.elastic(1e6), radius=0.01, density=1000, speed=[0.1, 5], radius_limit=0.3).limits()
        [('FAST', 1, "1 of 2 impacts: ..."), ('LARGE_CONTACT', 1, "1 of 2 impacts: contact radius above 0.3 of the sphere's, up to 0.344")]
        """
        passed, flags = [], np.ravel(self.flags)
        for bit, name, option, member, words in LIMITS:
            hit = (flags & bit) != 0
            if np.any(hit):
                most = np.max(np.abs(np.ravel(getattr(self, member))[hit]))
                of = f"{np.count_nonzero(hit)} of {flags.size} impacts: " if self.shape else ""
                text = f"{words.format(getattr(self.settings, option))}, {'up to ' if self.shape else ''}{most:.3g}"
                passed.append((name, int(np.count_nonzero(hit)), of + text))
        return passed


def _line(status, flags):
    names = " ".join(name for bit, name, *_ in LIMITS if flags & bit)
    remark = _library.text(_library.core.restitute_status_text(status)) if status else ""
    return "; ".join(text for text in (remark, names) if text)


def solve(impacts: Impacts, *, method: str = "euler", energies: bool = False, on_error: str = "raise", executor: Any = None,
          chunk: int | None = None, retries: int = 3, progress: Callable[[int, int], Any] | None = None,
          **settings: Any) -> Pairs:
    """Solve impacts; keywords and result are those of `pair`.

    >>> solve(Impacts(psi=2, delta1=1, gamma=1)).ez.round(3)
    0.547
    """
    if on_error not in ("raise", "nan"):
        raise errors.DomainError(f"on_error = {on_error!r}: must be raise or nan")
    asked = {"method": method, **settings}
    options(**asked)
    if impacts.refused and on_error == "raise":
        _raise(impacts, min(impacts.refused), _library.core.RESTITUTE_ERROR_DOMAIN, impacts.refused[min(impacts.refused)])
    solved = solve_records(impacts, asked, energies=energies, stop=on_error == "raise", executor=executor, chunk=chunk,
                           retries=retries, progress=progress)
    solved.status[list(impacts.refused)] = _library.core.RESTITUTE_ERROR_DOMAIN
    failed = solved.status < 0
    if np.any(failed) and on_error == "raise":
        first = int(np.argmax(failed))
        text = solved.messages.get(first) or solve_records(impacts[first:first + 1], {**asked, "threads": 1}).messages[0]
        _raise(impacts, first, solved.status[first], text)
    for records in (solved.results, solved.ledgers):
        for name in records.dtype.names if records is not None and np.any(failed) else ():
            if records.dtype[name].kind == "f":
                records[name][failed] = np.nan
    pairs = Pairs(impacts, solved, asked)
    _warn(pairs)
    return pairs


def _raise(impacts, flat, status, text):
    index = tuple(int(i) for i in np.unravel_index(flat, impacts.shape))
    error = _library.exception(status, f"impacts[{', '.join(map(str, index))}]: {text}" if index else text)
    error.index = index
    raise error


def _warn(pairs):
    missed = np.ravel(pairs.status) == _library.core.RESTITUTE_TOLERANCE_NOT_REACHED
    if np.any(missed):
        worst = max(np.max(np.ravel(e)[missed]) for e in (pairs.error_ez, pairs.error_ex))
        of = f"{np.count_nonzero(missed)} of {missed.size} impacts: " if pairs.shape else ""
        _library.warn(f"{of}the estimated error is above the tolerance {pairs.settings.tolerance:g}, "
                      f"{'up to ' if pairs.shape else ''}{worst:.2g}; method=\"sync\" or more max_work reach it",
                      errors.ToleranceWarning)
    for _, _, text in pairs.limits():
        _library.warn(text, errors.ModelLimitWarning)


def pair(material: Any = None, *, method: str = "euler", energies: bool = False, on_error: str = "raise",
         executor: Any = None, chunk: int | None = None, retries: int = 3,
         progress: Callable[[int, int], Any] | None = None, **keywords: Any) -> Pairs:
    """The restitution pair of one impact, or of arrays of them that broadcast as NumPy does.

    Give SI units and a material, or the numbers of the paper; never both. The library and its header
    include/restitute/restitute.h say what each means.

    Parameters
    ----------
    material : Material, name, path, or array_like of them
        What deforms; of sphere 1 where `partner` is a Material.
    radius : float, m
    density, mass : float, kg/m^3, kg
        Of sphere 1: one of them; default the density of the material, unless `partner` is "rigid".
    inertia : float, kg m^2
        Default that of a solid sphere.
    radius2, density2, mass2, inertia2 : float
        Of the partner sphere; by default a wall. Density or mass may be infinite: held fast.
    partner : "rigid", "same", Material, name, path, or array_like of them
        Whether one body deforms (default), both of the same material, or both, of unlike ones.
    friction : float, >= 0
        Default 0; inf: no slip.
    speed, angle : float, m/s, degrees in [0, 90)
        Of the centre, and between the velocity and the normal; or normal_speed and tangential_speed, m/s.
    spin, spin2 : float, rad/s
        Positive spin adds to the sliding velocity.
    rotation_blocked : bool
    time_shift : float
        a_T: relaxation times and viscosities are multiplied by it.
    wave_density : float, kg/m^3
        For the wave speed; default the material's, or that of the denser sphere.
    chi, psi, delta1, gamma, delta2 : float
        Numbers of the paper, (22), (23), (25): psi, and two of the last three; chi is 7/6 by default.
    method : str
        One of `restitute.solving.methods()`. "sync" is the fast one for small tolerances.
    tolerance, elements, time_step, threads, max_work, time_limit : float or int
        See `restitute_options` in the header; one value for all impacts.
    speed_limit, radius_limit, displacement_limit, dundurs_limit : float
        Limits of the model above which a result is flagged.
    energies : bool
        Fill `ledger`; one thread.
    on_error : "raise" or "nan"
        What becomes of impacts that fail: an exception for the first, or nan and a negative status.
    executor : concurrent.futures.Executor or distributed.Client, optional
        Solve there, `chunk` impacts at a time, each in one thread; a chunk whose worker dies is sent again, at most
        `retries` times. The bits are those of one thread.
    progress : callable
        progress(done, total), a few times a second.

    Returns
    -------
    Pairs

    Raises
    ------
    TypeError
        Keywords that are unknown, missing or of both kinds.
    DomainError, SolverError
        The text names the value and its range, and which impact; `index` is its place.
    KeyboardInterrupt
        Ctrl-C ends a long batch within about half a second, or after the impact that is being solved.

    Warns
    -----
    ToleranceWarning, ModelLimitWarning
        How many of how many impacts miss the tolerance or pass a limit.

    Notes
    -----
    Model and numbers: Willert, Kusche and Popov, Facta Universitatis Mech. Eng. 15(2), 2017; docs/theory.md.

    Examples
    --------
    >>> import restitute
    >>> restitute.pair(chi=7/6, psi=[0.5, 2], delta1=1, gamma=1).ez.round(3)
    array([0.547, 0.547])
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> balls = restitute.pair(rubber, radius=0.001, density=1200, friction=0.3, speed=[[0.01], [0.02]],
    ...                        angle=[0, 30, 60])
    >>> balls.ex.shape
    (2, 3)
    """
    settings = {name: keywords.pop(name) for name in OPTIONS if name in keywords}
    return solve(Impacts(material, **keywords), method=method, energies=energies, on_error=on_error, executor=executor,
                 chunk=chunk, retries=retries, progress=progress, **settings)
