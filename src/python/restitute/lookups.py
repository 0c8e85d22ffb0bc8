# SPDX-License-Identifier: BSD-3-Clause
"""What tables are asked for, and what they answer."""
from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from restitute import _library
from restitute.values import one_by_one, span

__all__ = ["TableContact", "TablePairs"]


class TableContact:
    """Another contact that a table serves, made by `Table.contact`.

    Attributes
    ----------
    speed_factor, psi_factor : float
        Speed in the table over speed of this contact; psi v_n/|v_t|.
    radius, mass : float
        Effective ones, m and kg.
    strain_factors : tuple of 4 floats
        Of what strains the model, over the table's; see `restitute_table_contact` in table.h.
    dundurs_beta : float
    """

    def __init__(self, **members: Any):
        self.struct = _library.struct("table_contact", "table", **members)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "struct":
            raise AttributeError(name)
        return getattr(self.struct, name)

    def __reduce__(self):
        return partial(TableContact, **_library.members(self.struct)), ()


class TablePairs:
    """Pairs from a table: as `restitute.Pairs`, `ez, ex = table.pair(...)` takes them apart, and
    `pairs[1]` and `len` are as of the arrays.

    Attributes
    ----------
    ez, ex : ndarray
        Of the broadcast shape of the speeds.
    """

    def __init__(self, ez: Any, ex: Any, flags: Any = None):
        self.ez, self.ex, self._flags = ez, ex, flags

    @property
    def flags(self) -> Any:
        """Which limits of the model are passed (`Table.flags`); None after `Table.collide`."""
        if callable(self._flags):
            self._flags = self._flags()
        return self._flags

    def __iter__(self):
        return iter((self.ez, self.ex))

    def __len__(self):
        return len(one_by_one(self.ez))

    def __getitem__(self, index: Any) -> TablePairs:
        one_by_one(self.ez)
        flags = self.flags
        return TablePairs(self.ez[index], self.ex[index], None if flags is None else flags[index])

    def __reduce__(self):
        return TablePairs, (self.ez, self.ex, self.flags)

    def __repr__(self):
        count = " x ".join(map(str, np.shape(self.ez))) or "1"
        return f"TablePairs({count}: ez {span(self.ez, digits=3)}, ex {span(self.ex, digits=3)})"
