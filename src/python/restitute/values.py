# SPDX-License-Identifier: BSD-3-Clause
"""What users hand over: numbers, arrays of them and words; what is none is refused by name."""
from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any

import numpy as np

from restitute.errors import DomainError, shown, suggestion

__all__ = ["broadcast", "fit_shape", "number", "numbers", "one_by_one", "one_of", "refuse", "span",
           "unmasked", "whole"]


def numbers(name: str, value: Any, kinds: str = "iuf",
            words: str = "a number or an array of numbers") -> np.ndarray:
    """An array of float; `kinds` are NumPy's letters of what is a number.

    >>> numbers("speed", [1, 2])
    array([1., 2.])
    """
    unmasked(name, value)
    try:
        array = np.asarray(value)
        if array.dtype.kind in kinds or array.dtype.kind == "O" and all(
                "b" in kinds if isinstance(one, (bool, np.bool_)) else hasattr(one, "__float__")
                for one in array.flat):
            return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        pass
    raise DomainError(f"{name} = {shown(value)}: must be {words}")


def unmasked(name: str, value: Any) -> None:
    """Refuse masked arrays: what is masked would be computed."""
    if isinstance(value, np.ma.MaskedArray):
        raise DomainError(f"{name}: is a masked array; take .filled(number) or .compressed()")


def number(name: str, value: Any) -> float:
    """One number."""
    array = numbers(name, value, words="one number")
    if array.ndim:
        raise DomainError(f"{name} = {shown(value)}: must be one number, no array")
    return float(array)


def whole(name: str, value: Any, low: int, high: int) -> int:
    """A whole number in [low, high]."""
    try:
        found = low - 1 if isinstance(value, bool) else operator.index(value)
    except TypeError:
        found = low - 1
    if not low <= found <= high:
        raise DomainError(f"{name} = {shown(value)}: must be a whole number in [{low:g}, {high:g}]")
    return found


def refuse(name: str, values: np.ndarray, bad: Any, words: str) -> None:
    """Refuse the first of the values that are bad."""
    if np.any(bad):
        where = np.argwhere(bad)[0].tolist()
        raise DomainError(f"{name}{where or ''} = {values[tuple(where)]:.15g}: {words}")


def one_of(name: str, value: Any, words: Iterable[str]) -> None:
    """Refuse a value that is not among these words."""
    if not isinstance(value, str) or value not in words:
        raise DomainError(f"{name} = {shown(value)}{suggestion(value, words)}")


def one_by_one(values: Any) -> Any:
    """Results of many impacts, which have a length and indices; those of one have none."""
    if np.ndim(values) == 0:
        raise TypeError("this is the result of one impact, without length and indices: take its "
                        "ez and ex, or ez, ex = result")
    return values


def broadcast(columns: dict) -> tuple:
    """The common shape of columns."""
    try:
        return np.broadcast_shapes(*(np.shape(column) for column in columns.values()))
    except ValueError:
        shapes = (f"{name} {np.shape(c)}" for name, c in columns.items() if np.ndim(c))
        raise DomainError(f"shapes do not broadcast: {', '.join(shapes)}") from None


def fit_shape(name: str, value: Any, shape: tuple) -> np.ndarray:
    """An array broadcast to a shape that it must fit."""
    try:
        return np.broadcast_to(value, shape)
    except ValueError:
        raise DomainError(f"{name}: has the shape {np.shape(value)}, must broadcast to "
                          f"{shape}") from None


def span(values: Any, unit: str = "", scale: float = 1.0, digits: int = 4) -> str:
    """"5 mm", or "1 to 5 mm"; nan is left out."""
    values = np.ravel(np.asarray(values, float))
    known = values[~np.isnan(values)]
    ends = (known.min(), known.max()) if known.size else (np.nan,)
    texts = dict.fromkeys(f"{float(end) * scale:.{digits}g}" for end in ends)
    return f"{' to '.join(texts)}{unit}"
