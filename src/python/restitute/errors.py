# SPDX-License-Identifier: BSD-3-Clause
"""What can go wrong, as exceptions with the library's words; what a result strains, as warnings."""
from __future__ import annotations


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
    """A value lies outside its allowed range."""


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
