# SPDX-License-Identifier: BSD-3-Clause
"""Structs of the library as arrays."""
from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from restitute.values import span

__all__ = ["Columns"]


class Columns:
    """Records of a struct of the library: each member is an array of the common shape.

    `len`, iteration and indices are those of these arrays: `columns[2]`, `columns[:, 0]`.
    """

    _hidden: tuple = ("struct_size",)

    def __init__(self, records: Any):
        self._records = np.asarray(records)

    @property
    def shape(self) -> tuple:
        """Shape of every member."""
        return self._records.shape

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # also before there are records, in copies that are being made
            raise AttributeError(name)
        if name not in self._members():
            raise AttributeError(f"'{name}' is not one of {', '.join(dir(self))}")
        return self._records[name][()]

    def _members(self):
        return [name for name in self._records.dtype.names or () if name not in self._hidden]

    def __dir__(self):
        return self._members() + [name for name in vars(self) if not name.startswith("_")]

    def __len__(self):
        return len(self._records)

    def __getitem__(self, index: Any) -> Any:
        return Columns(self._records[index])

    def __iter__(self) -> Iterator:
        return (self[i] for i in range(len(self)))

    def __bool__(self):
        return True  # not by its length, which one row does not have

    def __repr__(self):
        rows = " x ".join(map(str, self.shape)) or "1"
        values = (f"{name} {span(getattr(self, name), digits=3)}" for name in self._members())
        return f"{type(self).__name__}({rows} rows: {', '.join(values)})"
