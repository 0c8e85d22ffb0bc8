# SPDX-License-Identifier: BSD-3-Clause
"""The time history of one impact, its events, and its fields of pressure and traction."""
from __future__ import annotations

from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import ffi
from restitute.columns import Columns
from restitute.impact import Pairs, report, split
from restitute.scenes import Impacts
from restitute.solving import Solved, options, solve_singly, solver
from restitute.values import span, whole

__all__ = ["Events", "Fields", "History", "history"]
_MEMBERS = ("time", "indentation", "contact_radius", "stick_radius", "normal_force",
            "tangential_force", "normal_velocity", "tangential_velocity")


class Events(Columns):
    """Events in order of time: time, position, indentation, normal_velocity, tangential_velocity,
    kind, elements, and `word`, e.g. "stick-to-slip"; include/restitute/cvode.h says what they are.

    Attributes
    ----------
    work : Columns
        steps, restarts, rates, events, stiff: the work of CVODE.
    """

    def __init__(self, records: np.ndarray, work: np.ndarray):
        super().__init__(records)
        name = _library.cvode.restitute_cvode_event_text
        self.word = np.array([_library.text(name(kind)) for kind in records["kind"]], str)
        self.work = Columns(work[0])


class Fields(NamedTuple):
    """The contact at some times, in T, a_el, G_r d0/a_el, and that over mu for the traction."""

    time: np.ndarray  #: shape (count,)
    spacing: float  #: of the grid; the first contact point is in its middle
    pressure: np.ndarray  #: shape (count, cells, cells), axes time, y, x; 0 outside of the contact
    traction: np.ndarray  #: along x
    stick: np.ndarray  #: 1 sticks, 0 slips or not in contact


@dataclass(frozen=True, eq=False, repr=False)
class History:
    """Evenly spaced samples, first touch and the end of contact included; all of one shape (n,).

    `len(history)` is n, and `history[::10]` has every tenth sample. In SI units, or in T, d0, a_el,
    m v_z0^2/d0 (tangential force: times mu) and v_z0 (tangential velocity: U' of docs/theory.md,
    2).
    """

    time: np.ndarray
    indentation: np.ndarray
    contact_radius: np.ndarray
    stick_radius: np.ndarray  #: 0 in gross slip; the contact radius if all sticks
    normal_force: np.ndarray
    tangential_force: np.ndarray  #: on the contact point, braking positive
    normal_velocity: np.ndarray  #: positive into the partner
    tangential_velocity: np.ndarray  #: of the contact point
    result: Pairs  #: the pair, with ledger
    events: Events | None = None
    fields: Fields | None = None

    def __len__(self):
        return len(self.time)

    def __getitem__(self, index: Any) -> History:
        return replace(self, **{name: getattr(self, name)[index] for name in _MEMBERS})

    def __repr__(self):
        paper = self.result.of_the_paper
        time, depth, force = (" T", " d0", " F0") if paper else (" s", " m", " N")
        return (f"History({np.size(self.time)} samples: time {span(self.time, time)}, indentation "
                f"{span(self.indentation, depth, digits=3)}, normal force "
                f"{span(self.normal_force, force, digits=3)}, ez {self.result.ez:.3g}, ex "
                f"{self.result.ex:.3g})")


def history(material: Any = None, *, samples: int = 500, method: str | None = None,
            events: bool = False, fields: int = 0, **keywords: Any) -> History:
    """Solve one impact and keep what happens in it.

    Parameters
    ----------
    material, **keywords
        As in `restitute.pair`, for one impact.
    samples : int, in [2, 1e9]
        At most so many; "euler" and "bem" give no more than they make steps.
    method : str
        Default "euler", or "cvode" with events.
    events : bool
        Keep events: needs a method of the component cvode.
    fields : int, in [0, 1000]
        Snapshots of pressure and traction: needs the method "bem".

    Raises
    ------
    DomainError, SolverError
        The text names the value and its range.

    Examples
    --------
    >>> run = history(psi=0.5, delta1=1, gamma=1, samples=200, method="sync")
    >>> print(run.time.shape, run.result.ez.round(2), run.indentation.max().round(2))
    (200,) 0.78 0.79
    """
    settings, impact = split(keywords)
    impacts = Impacts(material, **impact)
    if impacts.shape:
        raise errors.DomainError(f"history: has the shape {impacts.shape}, must be one impact")
    method = method or ("cvode" if events else "euler")
    if events and not method.startswith("cvode"):
        raise errors.DomainError(f"events: the method {method} logs none; must be cvode, "
                                 "cvode-bdf or cvode-adams")
    if whole("fields", fields, 0, 1000) and method != "bem":
        raise errors.DomainError(f"fields: need the method bem, not {method}")
    whole("samples", samples, 2, 10**9)
    asked = {"method": method, **settings}
    value = options(**asked)
    block = np.full((len(_MEMBERS), samples), np.nan)
    wanted = _library.struct("history", capacity=samples)
    for name, row in zip(_MEMBERS, block):
        setattr(wanted, name, _library.pointer(row))
    solved = Solved.empty(1, energies=True)
    keeper = (_recorder("cvode", value, value.method) if events else
              _recorder("bem", value, fields) if fields else nullcontext())
    with keeper as recorder, solver(value) as pointer:
        solve_singly(impacts, pointer, solved, 0, 1, wanted)
        result = report(impacts, (), solved, asked)
        samples_of = dict(zip(_MEMBERS, block[:, :wanted.count]))
        return History(**samples_of, result=result, events=_events_of(recorder) if events else None,
                       fields=_fields_of(recorder) if fields else None)


@contextmanager
def _recorder(component, settings, argument):
    """What keeps events or fields, in place of the method of the options."""
    library, name = getattr(_library, component), f"restitute_{component}_recorder"
    made = ffi.new(f"{name} **")
    _library.call(getattr(library, f"{name}_create"), argument, made)
    try:
        settings.method = getattr(library, f"{name}_method")(made[0])
        yield made[0]
    finally:
        getattr(library, f"{name}_destroy")(made[0])


def _events_of(recorder):
    library = _library.cvode
    log, work = _library.struct("cvode_events", "cvode"), _library.structs("cvode_work", 1, "cvode")
    _library.call(library.restitute_cvode_recorder_events, recorder, log)  # their number
    records = np.zeros(log.count, _library.array_type("cvode_event"))
    log.capacity, log.event = log.count, _library.pointer(records, "restitute_cvode_event[]")
    _library.call(library.restitute_cvode_recorder_events, recorder, log)
    _library.call(library.restitute_cvode_recorder_work, recorder,
                  _library.pointer(work, "restitute_cvode_work[]"))
    return Events(records, work)


def _fields_of(recorder):
    shot, shots = _library.struct("bem_snapshot", "bem"), []
    for index in range(_library.bem.restitute_bem_recorder_count(recorder)):
        _library.call(_library.bem.restitute_bem_recorder_get, recorder, index, shot)
        grids = (np.frombuffer(ffi.buffer(grid, 8 * shot.cells**2)).reshape(shot.cells, -1)
                 for grid in (shot.pressure, shot.traction, shot.stick))
        shots.append((shot.time, shot.spacing, *(grid.copy() for grid in grids)))
    if not shots:
        raise errors.DomainError("fields: the impact has too few steps")
    time, spacing, pressure, traction, stick = zip(*shots)
    return Fields(np.array(time), spacing[0], np.array(pressure), np.array(traction),
                  np.array(stick))
