# SPDX-License-Identifier: BSD-3-Clause
"""Restitution pairs of one impact or of arrays of them."""
from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from restitute import _library, errors
from restitute._library import core
from restitute.columns import Columns
from restitute.scenes import Impacts
from restitute.solving import OPTIONS, Solved, options, solve_impacts
from restitute.values import one_by_one, one_of, span

__all__ = ["LIMITS", "Pairs", "pair", "solve"]

#: Error of ez over a_max/R where the sphere deforms (docs/soft_contacts.md).
SOFT_CONTACT_ERROR = 0.18

#: Limits of the model: flag, name, its option, what it bounds, in words. The window of a material
#: has no option.
LIMITS = (
    (1, "FAST", "speed_limit", "speed_ratio", "speed above {:g} of the shear wave speed"),
    (2, "LARGE_CONTACT", "radius_limit", "radius_ratio",
     "contact radius above {:g} of the sphere's"),
    (4, "LONG_SLIDE", "displacement_limit", "displacement_ratio",
     "sliding distance above {:g} of the contact radius"),
    (8, "COUPLED", "dundurs_limit", "dundurs_beta", "Dundurs' |beta| above {:g}"),
    (16, "UNMEASURED", "", "contact_time",
     "contact time outside the window in which the material was measured"),
)


class Pairs(Columns):
    """What came out of `pair`: arrays of the shape of the input, SI or in units of the paper.

    `ez, ex = pair(...)` takes it apart, however many impacts there are. `pairs[1]`, `pairs[:, 0]`
    and `len` are as of the arrays: to go through the impacts, use their indices. Can be pickled.

    Attributes
    ----------
    ez, ex : ndarray
        Restitution coefficients; ex > 0 if the contact point turns back.
    error_ez, error_ex : ndarray
        Their estimated errors.
    contact_time, max_indentation, max_contact_radius, max_normal_force : ndarray
        s, m, m, N; or T, d0, a_el, m v_z0^2/d0.
    speed_ratio, radius_ratio, displacement_ratio, dundurs_beta, flags : ndarray
        What strains the model, and bits of those that pass their limits (`LIMITS`).
    work, elements, steps, element_spacing, time_step, terms_merged, merging_bound : ndarray
        Of the computation, see `restitute_result` in include/restitute/restitute.h.
    status : ndarray of int
        0 done, positive done with a remark, negative failed (its numbers are nan).
    ledger : Columns or None
        With energies=True: rebound_z, viscous_z, left_z, residual_z, rebound_x, friction_x,
        viscous_x, left_x, residual_x, as fractions of the energy that came in.
    method : str
    impacts : Impacts or None
    """

    _hidden = ("struct_size", "method")

    def __init__(self, impacts: Impacts | None, shape: tuple, solved: Solved, asked: dict):
        super().__init__(solved.results.reshape(shape))
        self.impacts, self._asked, self._solved = impacts, asked, solved
        self.status = solved.status.reshape(shape)[()]
        ledgers = solved.ledgers
        self.ledger = None if ledgers is None else Columns(ledgers.reshape(shape))
        self.method = asked["method"]

    def __iter__(self) -> Iterator:
        return iter((self.ez, self.ex))

    def __len__(self):
        return len(one_by_one(self.ez))

    def __getitem__(self, index: Any) -> Pairs:
        one_by_one(self.ez)
        place = np.arange(self._records.size).reshape(self.shape)[index]
        some, (results, status, ledgers, messages) = np.ravel(place), self._solved
        messages = {i: messages[k] for i, k in enumerate(some.tolist()) if k in messages}
        solved = Solved(results[some], status[some], ledgers if ledgers is None else ledgers[some],
                        messages)
        impacts = None if self.impacts is None else self.impacts[some]
        return Pairs(impacts, np.shape(place), solved, self._asked)

    def __repr__(self):
        count = " x ".join(map(str, self.shape)) or "1"
        time = span(self.contact_time, " T" if self.of_the_paper else " s", digits=3)
        parts = [f"ez {span(self.ez, digits=3)}", f"ex {span(self.ex, digits=3)}",
                 f"contact time {time}"]
        for hit, word in ((self.flags != 0, "flagged"), (self.status < 0, "failed")):
            parts += [f"{np.sum(hit)} {word}"] if np.any(hit) else []
        return f"Pairs({count} impact{'s' * (count != '1')}: {', '.join(parts)})"

    @property
    def of_the_paper(self) -> bool:
        """Whether numbers are in units of the paper, not SI."""
        return self.impacts is not None and self.impacts.kind == "impact"

    @property
    def settings(self) -> Any:
        """restitute_options in use: `settings.tolerance`, `settings.radius_limit`, ..."""
        return options(**self._asked)

    def message(self, *index: Any) -> str:
        """Why the impact at this index failed, or the library's remarks on it; or an empty text.

        >>> pair(psi=[1, -1], on_error="nan").message(1)
        'psi = -1: must be in [0, 1e+12] or inf'
        """
        flat = int(np.ravel_multi_index(index, self.shape)) if index else 0
        strained = np.ravel(self.status)[flat] != 0 or np.ravel(self.flags)[flat] != 0
        messages = self._solved.messages
        if strained and flat not in messages and self.impacts is not None:
            again = solve_impacts(self.impacts[flat:flat + 1], {**self._asked, "threads": 1})
            messages[flat] = again.messages.get(0, "")
        return messages.get(flat, "")

    def words(self) -> np.ndarray:
        """A line for each impact, an array of str of the shape: empty, or a remark and the names
        of limits that are passed ("FAST LARGE_CONTACT"), or why it failed.

        >>> pair(psi=[1, -1], on_error="nan").words()
        array(['', 'psi = -1: must be in [0, 1e+12] or inf'], dtype=object)
        """
        status = np.ravel(self.status)
        kinds, place = np.unique(status * 32 + np.ravel(self.flags), return_inverse=True)
        lines = np.array([_line(*divmod(int(kind), 32)) for kind in kinds], object)[place.ravel()]
        for i in np.flatnonzero(status < 0):
            lines[i] = self.message(*np.unravel_index(i, self.shape))
        return lines.reshape(self.shape)

    def limits(self) -> list[tuple[str, int, str]]:
        """The limits of the model that are passed: name, by how many impacts, in words.

        >>> import warnings
        >>> from restitute import Material, errors
        >>> with warnings.catch_warnings():
        ...     warnings.simplefilter("ignore", errors.ModelLimitWarning)
        ...     balls = pair(Material.elastic(1e6), radius=0.01, density=1000, friction=0,
        ...                  speed=[0.1, 2], speed_limit=1, radius_limit=0.2)
        >>> balls.limits()
        [('LARGE_CONTACT', 1,
          "1 of 2 impacts: contact radius above 0.2 of the sphere's, up to 0.33")]
        """
        passed, flags = [], np.ravel(self.flags)
        for bit, name, option, member, words in LIMITS:
            hit = (flags & bit) != 0
            if np.any(hit) and not option:
                passed.append((name, int(np.sum(hit)), self._outside_window(hit)))
            elif np.any(hit):
                most = np.max(np.abs(np.ravel(getattr(self, member))[hit]))
                text = words.format(getattr(self.settings, option))
                worst = f"{most:.3g}"
                if name == "LARGE_CONTACT" and (cost := self.soft_contact(hit)):
                    worst += f" ({cost})"
                passed.append((name, int(np.sum(hit)), _of(hit, self.shape, text, worst)))
        return passed

    def soft_contact(self, hit: Any = True) -> str:
        """What the largest contact of those that are `hit` costs if the sphere is what deforms
        (docs/soft_contacts.md), in words; empty if nothing, or no impact in SI units."""
        if self.impacts is None or self.impacts.kind != "scene":
            return ""
        ratio = np.max(np.ravel(self.radius_ratio)[hit])
        if ratio > 1:
            return "more than the sphere: are moduli in Pa, lengths in m, speeds in m/s?"
        if ratio > 0.5:
            return "beyond 0.5 no bound of the error is known"
        records = self.impacts.records[hit]
        used = [self.impacts.solids[i].series for i in set(np.ravel(records["material"]).tolist())]
        elastic = all(s.modulus.size == 0 and s.parallel_viscosity == 0 for s in used)  # ez = 1
        ez, ex = ([f"ez is known to about +-{SOFT_CONTACT_ERROR * ratio:.1g}"] * (not elastic),
                  [f"ex {'is known ' * elastic}to {'about ' * elastic}+-{1.3 * ratio**0.65:.1g} "
                   "if it sticks"] * bool(np.any(records["friction"] > 0)))
        return ", ".join(ez + ex)

    def _outside_window(self, hit):
        """Contact times outside of windows, in words."""
        time = np.ravel(self.contact_time)[hit]
        windows, where = set(), "the window in which the material was measured"
        if self.impacts and self.impacts.solids:
            used = set(self.impacts.records["material"][hit].tolist())
            windows = {self.impacts.solids[i].window for i in used}
        if len(windows) == 1:
            shortest, longest = windows.pop()
            where = (f"the window {shortest:.3g} to {longest:.3g} s in which the material was "
                     "measured" if shortest <= longest else "the windows in which the two "
                     "materials were measured: they have no time in common")
        if not self.shape:
            return f"contact time {time[0]:.3g} s is outside {where}"
        return (f"{time.size} of {hit.size} impacts: contact times from {time.min():.3g} to "
                f"{time.max():.3g} s are outside {where}")


def _of(hit, shape, text, most):
    """How many of how many; of one impact that is not said."""
    if not shape:
        return f"{text}: {most}"
    return f"{np.sum(hit)} of {hit.size} impacts: {text}, up to {most}"


def _line(status, flags):
    names = " ".join(name for bit, name, *_ in LIMITS if flags & bit)
    remark = _library.text(core.restitute_status_text(status)) if status else ""
    return "; ".join(text for text in (remark, names) if text)


def split(keywords: dict) -> tuple[dict, dict]:
    """Keywords of options, and the rest."""
    settings = {name: value for name, value in keywords.items() if name in OPTIONS}
    return settings, {name: value for name, value in keywords.items() if name not in OPTIONS}


def solve(impacts: Impacts, *, method: str = "euler", energies: bool = False,
          on_error: str = "raise", executor: Any = None, chunk: int | None = None, retries: int = 3,
          progress: Callable[[int, int], Any] | None = None, **settings: Any) -> Pairs:
    """Solve impacts; keywords and result are those of `pair`.

    >>> solve(Impacts(psi=[2], delta1=1, gamma=1)).ez.round(2)
    array([0.78])
    """
    one_of("on_error", on_error, ("raise", "nan"))
    asked, stop = {"method": method, **settings}, on_error == "raise"
    options(**asked)
    if impacts.refused and stop:
        first = min(impacts.refused)
        _fail(impacts.shape, first, core.RESTITUTE_ERROR_DOMAIN, impacts.refused[first])
    solved = solve_impacts(impacts, asked, energies=energies, stop=stop, executor=executor,
                           chunk=chunk, retries=retries, progress=progress)
    solved.status[list(impacts.refused)] = core.RESTITUTE_ERROR_DOMAIN
    solved.messages.update(impacts.refused)
    return report(impacts, impacts.shape, solved, asked, on_error)


def report(impacts: Impacts | None, shape: tuple, solved: Solved, asked: dict,
           on_error: str = "raise") -> Pairs:
    """The pairs of what was solved: failures become an exception or nan, strains warnings."""
    failed = solved.status < 0
    pairs = Pairs(impacts, shape, solved, asked)
    if np.any(failed) and on_error == "raise":
        first = int(np.argmax(failed))
        text = pairs.message(*np.unravel_index(first, shape))
        _fail(shape, first, solved.status[first], text)
    for records in (part for part in (solved.results, solved.ledgers) if part is not None):
        for name in (name for name in records.dtype.names if records.dtype[name].kind == "f"):
            records[name][failed] = np.nan
    missed = solved.status == core.RESTITUTE_TOLERANCE_NOT_REACHED
    if np.any(missed):
        worst = max(solved.results[name][missed].max() for name in ("error_ez", "error_ex"))
        text = f"the estimated error is above the tolerance {pairs.settings.tolerance:g}"
        _library.warn(_of(missed, shape, text, f"{worst:.2g}"), errors.ToleranceWarning)
    for _, _, text in pairs.limits():
        _library.warn(text, errors.ModelLimitWarning)
    return pairs


def _fail(shape, flat, status, text):
    index = tuple(int(i) for i in np.unravel_index(flat, shape))
    where = f"impacts[{', '.join(map(str, index))}]: " if index else ""
    error = _library.exception(status, where + text)
    error.index = index
    raise error


def pair(material: Any = None, *, method: str = "euler", energies: bool = False,
         on_error: str = "raise", executor: Any = None, chunk: int | None = None, retries: int = 3,
         progress: Callable[[int, int], Any] | None = None, **keywords: Any) -> Pairs:
    """The restitution pair of one impact, or of arrays of them that broadcast as NumPy does.

    Give a material and SI units, or the numbers of the paper; never both.

    Parameters
    ----------
    material : Material, name, path, or array_like of them
        What deforms; of sphere 1 where `partner` is a Material.
    radius : float, m
    density, mass : float, kg/m^3, kg
        Of sphere 1: one of them. Default the density of `material`.
    inertia : float, kg m^2
        Default that of a solid sphere.
    radius2, density2, mass2, inertia2 : float
        Of a partner sphere; default a wall. Its density: default that of its material, unless
        `partner` is "rigid". Infinite density or mass: held fast.
    partner : "rigid", "same", Material, name, path, or array_like of them
        One body deforms (default), both of the same material, or both of unlike ones.
    friction : float, >= 0
        Required; inf: no slip.
    speed, angle : float, m/s, degrees in [0, 90)
        Of the centre, and between the velocity and the normal; or `normal_speed` and
        `tangential_speed`, m/s.
    spin, spin2 : float, rad/s
        Positive spin adds to the sliding velocity.
    rotation_blocked : bool
    time_shift : float
        a_T: relaxation times and viscosities are multiplied by it.
    wave_density : float, kg/m^3
        For the wave speed; default the material's, or that of the denser sphere.
    chi, psi, delta1, gamma, delta2 : float
        Numbers of the paper, (22), (23), (25): psi, two of the last three (none: elastic), and chi,
        7/6 by default.
    method : str
        One of `restitute.methods()`; "sync" is the fast one for small tolerances.
    tolerance, elements, time_step, threads, max_work, time_limit : float or int
        See `restitute_options` in include/restitute/restitute.h; one value for all impacts.
    speed_limit, radius_limit, displacement_limit, dundurs_limit : float
        Limits of the model above which a result is flagged.
    energies : bool
        Fill `ledger`, in one thread.
    on_error : "raise" or "nan"
        What becomes of failed impacts: an exception for the first, or nan and a negative status.
    executor : concurrent.futures.Executor or distributed.Client, optional
        Solve there, `chunk` impacts at a time, each in one thread, with the same bits. A chunk
        whose worker dies is sent again, at most `retries` times.
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
        The text names the value, its range and the impact, whose place is `index`.
    KeyboardInterrupt
        Ctrl-C ends a long batch within about a second, or after the impact that is solved.

    Warns
    -----
    ToleranceWarning, ModelLimitWarning
        How many of how many impacts miss the tolerance or pass a limit.

    References
    ----------
    Willert, Kusche and Popov, Facta Universitatis Mech. Eng. 15(2), 2017; docs/theory.md.

    Examples
    --------
    >>> import restitute
    >>> restitute.pair(psi=[0.5, 2], delta1=1, gamma=1).ez.round(2)
    array([0.78, 0.78])
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> balls = restitute.pair(rubber, radius=0.001, density=1200, friction=0.3,
    ...                        speed=[[0.01], [0.02]], angle=[0, 30, 60])
    >>> balls.ex.shape
    (2, 3)
    """
    settings, impact = split(keywords)
    return solve(Impacts(material, **impact), method=method, energies=energies, on_error=on_error,
                 executor=executor, chunk=chunk, retries=retries, progress=progress, **settings)
