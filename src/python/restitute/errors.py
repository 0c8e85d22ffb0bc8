# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, as exceptions with the library's words; what a result strains, as warnings.

Keywords that are unknown, missing or contradict each other are a TypeError, as everywhere in
Python. A keyword whose value cannot be used is a DomainError.
"""
from __future__ import annotations

import difflib
import reprlib
from collections.abc import Iterable
from typing import Any


class Error(Exception):
    """A call of the library failed. The text names the value, the place and the allowed range.

    Attributes
    ----------
    status : int
        What the library returned, a negative `restitute_status`.
    index : int or None
        Of the case that failed, in a call for many.
    """

    status = 0
    index: int | tuple | None = None


class DomainError(Error, ValueError):
    """A value lies outside its allowed range, or is of the wrong kind or shape."""


class FormatError(Error, ValueError):
    """A file does not have the expected form."""


class FileError(Error, OSError):
    """A file cannot be read or written."""


class SolverError(Error, ArithmeticError):
    """An impact could not be solved: too much work, a step that is not stable, no convergence."""


class MissingComponent(Error, ImportError):
    """A part of the library is not installed here; the text says which."""


class ToleranceWarning(UserWarning):
    """The estimated error of some results is above the requested tolerance."""


class ModelLimitWarning(UserWarning):
    """Some results strain an assumption of the model; the text says how many, and which."""


class UnitWarning(UserWarning):
    """A value looks as if it were in another unit than the one that is asked for."""


_OTHER_WORDS = {"velocity": "speed", "v": "speed", "mu": "friction", "nu": "poisson_ratio",
                "height": "drop_height", "diameter": "radius", "theta": "angle",
                "E": "youngs_modulus"}


def suggestion(word: Any, known: Iterable[str]) -> str:
    """"; did you mean NAME?" where a known name is near, else all of them."""
    word, known = str(word), list(known)
    near = [name for name in known if name == _OTHER_WORDS.get(word) or name.startswith(word)]
    near = near or difflib.get_close_matches(word, known, 1, 0.7)
    return f"; did you mean {near[0]}?" if near else f": must be one of {', '.join(known)}"


def shown(value: Any) -> str:
    """A value in a message, shortened."""
    try:
        return " ".join(reprlib.repr(value).split())
    except ValueError:  # Python writes no integer of more than 4300 digits
        return "a number of thousands of digits"
