# SPDX-License-Identifier: BSD-3-Clause
"""Tables of all pairs of some materials."""
from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable

from restitute.executor import map_chunks
from restitute.table import Table
from restitute.values import whole

__all__ = ["build_tables"]


def build_tables(materials: Sequence[Any], *, executor: Any = None, threads: int = 1,
                 retries: int = 3, progress: Callable[[int, int], Any] | None = None,
                 **keywords: Any) -> list[list[Table]]:
    """The tables of all pairs of some materials: both bodies deform.

    Parameters
    ----------
    materials : sequence of n Materials, names or paths
    executor : concurrent.futures.Executor or distributed.Client, optional
        Build there, a table a task; by default in `threads` threads. The bits are the same.
    progress : callable
        progress(tables done, of all).
    **keywords
        As of `Table.build`, without `partner`.

    Returns
    -------
    list of n lists of n Tables
        tables[i][j] is tables[j][i], of the materials i and j.

    Raises
    ------
    DomainError, SolverError
        The first failure. What runs then, or at Ctrl-C, ends within its `time_limit`.

    Examples
    --------
    >>> import restitute
    >>> rubber, glass = restitute.Material.kelvin_voigt(1e6, 50.0), restitute.Material.elastic(1e7)
    >>> tables = build_tables([rubber, glass], radius=0.01, density=1000, friction=0.3,
    ...                       speeds=(0.01, 1), tolerance=1e-2)
    >>> tables[0][1] is tables[1][0], len(tables)
    (True, 2)
    """
    threads = whole("threads", threads, 0, 1024) or os.cpu_count() or 1
    pairs = [(i, j) for j in range(len(materials)) for i in range(j + 1)]
    tasks = [(materials[i], "same" if i == j else materials[j], keywords) for i, j in pairs]
    pool = None if executor else ThreadPoolExecutor(threads)
    try:
        built = dict(zip(pairs, map_chunks(_build_task, tasks, executor or pool, retries=retries,
                                           progress=progress)))
    finally:
        if pool:
            pool.shutdown(wait=False)
    count = range(len(materials))
    return [[built[min(i, j), max(i, j)] for j in count] for i in count]


def _build_task(task):
    material, partner, keywords = task
    return Table.build(material, partner=partner, **keywords)
