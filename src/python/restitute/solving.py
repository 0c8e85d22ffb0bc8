# SPDX-License-Identifier: BSD-3-Clause
"""Options, methods, and solving impacts: in pieces here, in chunks elsewhere."""
from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import call, core, ffi, pointer
from restitute.executor import map_chunks
from restitute.scenes import Impacts
from restitute.values import whole

__all__ = ["METHODS", "OPTIONS", "Solved", "methods", "options", "solve_impacts", "solver"]

#: Component of each method.
METHODS = {"euler": "core", "sync": "core", "cvode": "cvode", "cvode-bdf": "cvode",
           "cvode-adams": "cvode", "bem": "bem", "bem-paper": "bem"}

#: Members of restitute_options that are keywords.
OPTIONS = ("tolerance", "elements", "time_step", "threads", "max_work", "time_limit",
           "speed_limit", "radius_limit", "displacement_limit", "dundurs_limit")

_PIECE = 0.4  # s between two looks for Ctrl-C. A piece costs one solver a thread, some 10 us.


def methods() -> list[str]:
    """Names of the methods that are installed.

    >>> "sync" in methods()
    True
    """
    return [name for name, component in METHODS.items() if _library.available(component)]


def _method(name):
    if not isinstance(name, str) or name not in METHODS:
        raise errors.DomainError(f"method = {errors.shown(name)}"
                                 f"{errors.suggestion(name, methods())}")
    library = getattr(_library, METHODS[name])
    return getattr(library, f"restitute_method_{name.replace('-', '_')}")()


def options(method: str = "euler", **members: Any) -> Any:
    """restitute_options with these members, checked by the library; None is the default.

    Raises
    ------
    DomainError, MissingComponent, TypeError
        The text names the value and its range.
    """
    for name in members:
        if name not in OPTIONS:
            raise TypeError(f"'{name}' is no option{errors.suggestion(name, OPTIONS)}")
    given = {name: member for name, member in members.items() if member is not None}
    value = _library.struct("options", method=_method(method), **given)
    call(core.restitute_solve_many, 0, ffi.NULL, value, ffi.NULL, ffi.NULL)
    return value


@contextmanager
def solver(settings: Any) -> Iterator[Any]:
    """A solver of the library with these options."""
    made = ffi.new("restitute_solver **")
    call(core.restitute_solver_create, settings, made)
    try:
        yield made[0]
    finally:
        core.restitute_solver_destroy(made[0])


class Solved(NamedTuple):
    """What came out, in flat order; without addresses, so that it can be sent."""

    results: np.ndarray
    status: np.ndarray
    ledgers: np.ndarray | None
    messages: dict  #: of int to str, of impacts that were solved one by one

    @classmethod
    def empty(cls, count: int, energies: bool = False) -> Solved:
        ledgers = _library.structs("ledger", count) if energies else None
        return cls(_library.structs("result", count), np.zeros(count, np.int32), ledgers, {})


def solve_impacts(impacts: Impacts, settings: dict, *, energies: bool = False, stop: bool = False,
                  executor: Any = None, chunk: int | None = None, retries: int = 3,
                  progress: Callable[[int, int], Any] | None = None) -> Solved:
    """Solve impacts in flat order.

    Parameters
    ----------
    settings : dict
        Keywords of `options`.
    energies : bool
        With ledgers, one by one in one thread.
    stop : bool
        End with the first piece or chunk that has a failure.
    executor, retries
        As in `restitute.map_chunks`; each chunk is solved by one thread.
    chunk : int, optional
        Impacts a chunk; by default so many that there are 256 chunks, and at most 4096.
    progress : callable
        Called with the number of impacts done and of all.
    """
    total = len(impacts)
    size = min(-(-total // 256), 4096) if chunk is None else whole("chunk", chunk, 1, 10**9)
    if executor is None or total == 0:
        return _solve_here(impacts, settings, energies, stop, progress)
    tasks = [(impacts[i:i + size], {**settings, "threads": 1}, energies, stop, None)
             for i in range(0, total, size)]

    def count(done, _):
        if progress:
            progress(min(done * size, total), total)

    solved, begin = Solved.empty(total, energies), 0
    for part in map_chunks(_solve_task, tasks, executor, retries=retries, progress=count):
        end = begin + len(part.status)
        for column, piece in zip(solved[:3], part[:3]):
            if column is not None:
                column[begin:end] = piece
        solved.messages.update({begin + i: text for i, text in part.messages.items()})
        begin = end
        if stop and np.any(part.status < 0):
            break
    return solved


def _solve_task(task: tuple) -> Solved:
    return _solve_here(*task)


def _solve_here(impacts, settings, energies, stop, progress):
    value, total = options(**settings), len(impacts)
    solved = Solved.empty(total, energies)
    least = value.threads or os.cpu_count() or 1  # so that every thread has an impact
    begin, piece = 0, least
    with solver(value) as made:
        while begin < total and not (stop and np.any(solved.status[:begin] < 0)):
            end, since = min(begin + piece, total), time.monotonic()
            if energies or total == 1:
                solve_singly(impacts, made, solved, begin, end)
            else:
                _solve_piece(impacts, value, solved, begin, end)
            took, begin = time.monotonic() - since, end
            if took < _PIECE / 2:
                piece *= 2
            elif took > 2 * _PIECE:
                piece = max(least, piece // 2)
            if progress:
                progress(begin, total)
    solved.results["method"] = 0
    return solved


def _solve_piece(impacts, settings, solved, begin, end):
    name = "solve_scene_many" if impacts.kind == "scene" else "solve_many"
    error, refused = ffi.new("restitute_error *"), 1000
    solved.status[begin:end] = refused  # stays where the call is refused as a whole
    status = getattr(core, f"restitute_{name}")(
        end - begin, pointer(impacts.bound(begin, end), f"restitute_{impacts.kind}[]"), settings,
        pointer(solved.results[begin:end], "restitute_result[]"), pointer(solved.status[begin:end]),
        error)
    if solved.status[begin] == refused:
        raise _library.exception(status, _library.message_of(error))


def solve_singly(impacts: Impacts, made: Any, solved: Solved, begin: int, end: int,
                 samples: Any = ffi.NULL) -> None:
    """Solve some impacts one by one, for their ledgers, messages and history."""
    one = core.restitute_solve_scene if impacts.kind == "scene" else core.restitute_solve
    cases = pointer(impacts.bound(begin, end), f"restitute_{impacts.kind}[]")
    results = pointer(solved.results, "restitute_result[]")
    ledgers = solved.ledgers is not None and pointer(solved.ledgers, "restitute_ledger[]")
    error = ffi.new("restitute_error *")
    for i in range(begin, end):
        ledger = ledgers + i if ledgers else ffi.NULL
        solved.status[i] = one(made, cases + (i - begin), results + i, ledger, samples, error)
        if error.message[0] != b"\0":
            solved.messages[i] = _library.message_of(error)
