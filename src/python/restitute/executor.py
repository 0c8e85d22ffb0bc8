# SPDX-License-Identifier: BSD-3-Clause
"""Work in chunks, here or by any executor: `concurrent.futures`, `mpi4py.futures`, a dask client.

The order of results and their bits are those of one thread.
"""
from __future__ import annotations

import queue
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Future, ProcessPoolExecutor
from functools import partial
from typing import Any

from restitute.errors import DomainError, shown
from restitute.values import whole

__all__ = ["map_chunks"]


def map_chunks(function: Callable[[Any], Any], chunks: Iterable[Any], executor: Any = None, *,
               retries: int = 3,
               progress: Callable[[int, int], Any] | None = None) -> Iterator[Any]:
    """Results of function(chunk) in the order of chunks, each as soon as those before it are there.

    Parameters
    ----------
    function : callable
        Pure, and importable where it runs (not a lambda) unless the executor is of threads.
    executor : concurrent.futures.Executor or distributed.Client, optional
        By default the calling thread.
    retries : int
        How often a chunk is sent again whose worker died; to a new pool of processes, if that broke
        it. An exception of `function` is final.
    progress : callable
        Called with the number of chunks done and of all, in the calling thread.

    Raises
    ------
    BrokenExecutor, distributed.KilledWorker
        A chunk's worker died once more than `retries` times.

    Examples
    --------
    >>> list(map_chunks(abs, [-1, -2, 3]))
    [1, 2, 3]
    """
    items = list(chunks)
    if executor is None:
        for done, chunk in enumerate(items, 1):
            yield function(chunk)
            if progress:
                progress(done, len(items))
        return
    if not hasattr(executor, "submit"):
        raise DomainError(f"executor = {shown(executor)}: must be a concurrent.futures.Executor or "
                          "a distributed.Client")
    run = _Run(function, items, executor, whole("retries", retries, 0, 10**6))
    try:
        yield from run.results(progress)
    finally:
        run.end()


class _Dask:
    """A client of dask. Its own executor loses a result that dies with its worker: there the future
    is cancelled."""

    def __init__(self, client):
        self.client = client

    def submit(self, function, item):
        future: Any = Future()
        future.of_dask = self.client.submit(function, item, pure=False)
        future.of_dask.add_done_callback(partial(self._pass_on, future))
        return future

    @staticmethod
    def _pass_on(future, of_dask):
        if not future.set_running_or_notify_cancel():
            return
        try:
            future.set_result(of_dask.result())
        except BaseException as error:
            failed = of_dask.status == "error"  # else the result was lost on its way
            future.set_exception(error if failed else CancelledError())


class _Run:
    """Chunks on their way through an executor."""

    def __init__(self, function, items, executor, retries):
        self.function, self.items, self.retries = function, items, retries
        self.executor = _Dask(executor) if hasattr(executor, "scheduler_info") else executor
        self.own: ProcessPoolExecutor | None = None  # a pool in place of the caller's that broke
        self.tries = [0] * len(items)
        self.pending: dict[Future, tuple[int, Any]] = {}
        self.done: queue.SimpleQueue = queue.SimpleQueue()

    def submit(self, index):
        try:
            future = self.executor.submit(self.function, self.items[index])
        except BrokenExecutor as error:  # it broke since the last result
            future = Future()
            future.set_exception(error)
        self.pending[future] = (index, self.executor)
        future.add_done_callback(self.done.put)

    def results(self, progress):
        for index in range(len(self.items)):
            self.submit(index)
        ready: dict[int, Any] = {}
        place = done = 0
        while place < len(self.items):
            future = self.done.get()
            index, executor = self.pending.pop(future)
            error = future.exception()
            if error is not None:
                self.again(index, executor, error)
                continue
            ready[index] = future.result()
            done += 1
            if progress:
                progress(done, len(self.items))
            while place in ready:
                yield ready.pop(place)
                place += 1

    def again(self, index, executor, error):
        """Send a chunk again whose worker died; any other failure is the function's own."""
        died = isinstance(error, (BrokenExecutor, CancelledError))
        died |= type(error).__name__ == "KilledWorker"
        self.tries[index] += 1
        if not died or self.tries[index] > self.retries:
            raise error
        if isinstance(error, BrokenExecutor) and executor is self.executor:
            self.renew(error)
        self.submit(index)

    def renew(self, error):
        """A process pool that lost a worker is lost as a whole: take another one like it."""
        if not isinstance(self.executor, ProcessPoolExecutor):
            raise error
        if self.own:
            self.own.shutdown(wait=False)
        broken: Any = self.executor
        self.executor = self.own = ProcessPoolExecutor(
            broken._max_workers, mp_context=broken._mp_context, initializer=broken._initializer,
            initargs=broken._initargs)

    def end(self):
        for future in self.pending:
            future.cancel()
            getattr(future, "of_dask", future).cancel()
        if self.own:
            self.own.shutdown(wait=False)
