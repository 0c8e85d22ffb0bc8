# SPDX-License-Identifier: BSD-3-Clause
"""Options, methods, and solving records of impacts: in pieces here, in chunks elsewhere."""
from __future__ import annotations

import difflib
import time
from typing import Any, Callable, NamedTuple

import numpy as np

from restitute import _library, errors
from restitute._library import ffi
from restitute.executor import map_chunks
from restitute.scenes import Impacts

__all__ = ["METHODS", "OPTIONS", "Solved", "methods", "options", "solve_records"]

#: Component and function of each method.
METHODS = {"euler": ("core", "restitute_method_euler"), "sync": ("core", "restitute_method_sync"),
           "cvode": ("cvode", "restitute_method_cvode"), "cvode-bdf": ("cvode", "restitute_method_cvode_bdf"),
           "cvode-adams": ("cvode", "restitute_method_cvode_adams"), "bem": ("bem", "restitute_method_bem"),
           "bem-paper": ("bem", "restitute_method_bem_paper")}

#: Members of restitute_options that are keywords of `pair`, `history` and `collide`; their ranges and defaults are in
#: include/restitute/restitute.h.
OPTIONS = ("tolerance", "elements", "time_step", "threads", "max_work", "time_limit", "speed_limit", "radius_limit",
           "displacement_limit", "dundurs_limit")

_PIECE_SECONDS = 0.2  # between two looks for Ctrl-C; each piece costs a solver a thread, some 10 us


def methods() -> list[str]:
    """Names of the methods that are installed.

    >>> "sync" in methods()
    True
    """
    return [name for name, (component, _) in METHODS.items() if _library.available(component)]


def method_of(name: str) -> Any:
    """The library's method of this name."""
    if name not in METHODS:
        near = difflib.get_close_matches(str(name), METHODS, 1)
        raise errors.DomainError(f"method = {name!r}: {f'did you mean {near[0]}? ' if near else ''}must be one of "
                                 f"{', '.join(methods())}")
    component, function = METHODS[name]
    if not _library.available(component):
        raise errors.MissingComponent(f"method = {name!r}: the component {component} is not installed with this package")
    return getattr(getattr(_library, component), function)()


def options(method: str = "euler", **members: Any) -> Any:
    """restitute_options with these members, checked by the library. None stands for the default.

    Raises
    ------
    DomainError, MissingComponent, TypeError
        The text names the value and its range.
    """
    for name in members:
        if name not in OPTIONS:
            raise TypeError(f"'{name}' is no option: {', '.join(OPTIONS)}")
    value = _library.struct("options")
    value.method = method_of(method)
    for name, member in members.items():
        if member is not None:
            try:
                setattr(value, name, member)
            except (TypeError, OverflowError):
                raise errors.DomainError(f"{name} = {member!r}: is not a number of its kind") from None
    _library.call(_library.core.restitute_solve_many, 0, ffi.NULL, value, ffi.NULL, ffi.NULL)
    return value


class Solved(NamedTuple):
    """What came out, in flat order. Records hold no addresses, so that they can be sent."""

    results: np.ndarray
    status: np.ndarray
    ledgers: np.ndarray | None
    messages: dict  # of int to str, where the library was asked case by case


def solve_records(impacts: Impacts, settings: dict, *, energies: bool = False, stop: bool = False, executor: Any = None,
                  chunk: int | None = None, retries: int = 3, progress: Callable[[int, int], Any] | None = None) -> Solved:
    """Solve impacts in flat order.

    Parameters
    ----------
    settings : dict
        Keywords of `options`.
    energies : bool
        With ledgers, case by case in one thread.
    stop : bool
        End with the first piece or chunk that has a failure.
    executor, retries
        As in `restitute.executor.map_chunks`; each chunk is solved by one thread.
    chunk : int, optional
        Impacts a chunk; by default so many that there are 64 chunks, and at most 4096.
    progress : callable
        Called with the number of impacts done and of all.
    """
    total = len(impacts)
    if executor is None:
        return _solve_here(impacts, settings, energies, stop, progress)
    size = chunk or min(max(1, -(-total // 64)), 4096)
    tasks = [(impacts[i:i + size], {**settings, "threads": 1}, energies) for i in range(0, total, size)]

    def count(done, _):
        if progress:
            progress(min(done * size, total), total)

    parts = []
    for part in map_chunks(_solve_task, tasks, executor, retries=retries, progress=count):
        parts.append(part)
        if stop and np.any(part.status < 0):
            break
    if not parts:
        return _solve_here(impacts, settings, energies, stop, None)
    ledgers = np.concatenate([p.ledgers for p in parts]) if energies else None
    messages = {i * size + index: text for i, p in enumerate(parts) for index, text in p.messages.items()}
    return Solved(np.concatenate([p.results for p in parts]), np.concatenate([p.status for p in parts]), ledgers, messages)


def _solve_task(task: tuple) -> Solved:
    return _solve_here(*task, False, None)


def _solve_here(impacts, settings, energies, stop, progress):
    value, total = options(**settings), len(impacts)
    solved = Solved(_library.structs("result", total), np.zeros(total, np.int32),
                    _library.structs("ledger", total) if energies else None, {})
    begin, piece = 0, max(1, value.threads)
    with _solver(value) as solver:
        while begin < total:
            end, since = min(begin + piece, total), time.monotonic()
            if energies or total == 1:
                _solve_singly(impacts, solver, solved, begin, end)
            else:
                _solve_piece(impacts, value, solved, begin, end)
            took = time.monotonic() - since
            piece = 2 * piece if took < _PIECE_SECONDS / 2 else max(1, value.threads, piece // 2) if took > 2 * _PIECE_SECONDS else piece
            begin = end
            if progress:
                progress(begin, total)
            if stop and np.any(solved.status[:end] < 0):
                break
    solved.results["method"] = 0
    return solved


class _solver:
    """A solver of the library, for a with statement."""

    def __init__(self, settings):
        self.pointer = ffi.new("restitute_solver **")
        _library.call(_library.core.restitute_solver_create, settings, self.pointer)

    def __enter__(self):
        return self.pointer[0]

    def __exit__(self, *_):
        _library.core.restitute_solver_destroy(self.pointer[0])


def _solve_piece(impacts, settings, solved, begin, end):
    kind = impacts.kind
    many = {"scene": _library.core.restitute_solve_scene_many, "impact": _library.core.restitute_solve_many}[kind]
    error = ffi.new("restitute_error *")
    solved.status[begin:end] = 1000  # stays if the call is refused as a whole
    status = many(end - begin, _library.pointer(impacts.bound(begin, end), f"restitute_{kind}[]"), settings,
                  _library.pointer(solved.results[begin:end], "restitute_result[]"),
                  _library.pointer(solved.status[begin:end]), error)
    if solved.status[begin] == 1000:
        raise _library.exception(status, _library.text(error.message))


def _solve_singly(impacts, solver, solved, begin, end):
    kind = impacts.kind
    one = {"scene": _library.core.restitute_solve_scene, "impact": _library.core.restitute_solve}[kind]
    cases = _library.pointer(impacts.bound(begin, end), f"restitute_{kind}[]")
    results = _library.pointer(solved.results[begin:end], "restitute_result[]")
    ledgers = None if solved.ledgers is None else _library.pointer(solved.ledgers[begin:end], "restitute_ledger[]")
    error = ffi.new("restitute_error *")
    for i in range(end - begin):
        ledger = ffi.NULL if ledgers is None else ledgers + i
        solved.status[begin + i] = one(solver, cases + i, results + i, ledger, ffi.NULL, error)
        text = _library.text(error.message)
        if text:
            solved.messages[begin + i] = text
