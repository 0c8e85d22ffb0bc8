# SPDX-License-Identifier: BSD-3-Clause
"""Work in chunks: threads, processes, dask, MPI; workers that die; the bits of one thread."""

import copy
import os
import pickle
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from restitute import DomainError, Impacts, Material, map_chunks, pair, solve

RUBBER = Material.standard_solid(1e6, 3e6, 300.0)
SPEED = np.geomspace(1e-3, 2e-2, 60).reshape(20, 3)
BALL = dict(radius=0.001, density=1200, friction=0.3, speed=SPEED, angle=[0, 30, 60])


def processes(count):
    """A pool of fresh processes: a fork of this one would have its threads' locks."""
    return ProcessPoolExecutor(count, mp_context=get_context("spawn"))


def same_bits(result):
    here = pair(RUBBER, **BALL)
    return all(np.array_equal(getattr(result, name), getattr(here, name))
               for name in ("ez", "ex", "error_ex", "work", "status", "flags"))


def die_once(task):
    """Kills its process where the file of its path is not yet there; -1 always does."""
    number, folder = task
    mark = os.path.join(folder, str(number))
    if number == -1 or (number == 3 and not os.path.exists(mark)):
        with open(mark, "a") as file:
            file.write("x")
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def test_results_come_in_order_with_progress():
    counts = []

    def square(x):
        time.sleep(0.01 * (x % 3 == 0))  # others overtake it
        return x * x

    with ThreadPoolExecutor(3) as pool:
        squares = list(map_chunks(square, range(40), pool,
                                  progress=lambda *count: counts.append(count)))
    assert squares == [x * x for x in range(40)]
    assert counts == [(i, 40) for i in range(1, 41)]
    assert list(map_chunks(abs, [])) == []


@pytest.mark.parametrize("chunk", [None, 7, 1000])
def test_threads_of_a_pool_give_the_bits_of_one(chunk):
    counts = []
    with ThreadPoolExecutor(2) as pool:
        result = pair(RUBBER, **BALL, executor=pool, chunk=chunk, energies=True,
                      progress=lambda *count: counts.append(count))
        assert same_bits(result) and counts[-1] == (60, 60)
        here = pair(RUBBER, **BALL, energies=True)
        assert (result.ledger.rebound_z == here.ledger.rebound_z).all()
        assert pair(RUBBER, **{**BALL, "speed": np.empty((0, 3))}, executor=pool).shape == (0, 3)


def test_a_chunk_takes_along_the_solids_that_it_needs():
    solids = [Material.elastic(modulus) for modulus in np.geomspace(1e6, 1e7, 50)]
    impacts = Impacts(solids, radius=0.001, density=1200, speed=0.01, friction=0.3)
    some = pickle.loads(pickle.dumps(impacts[10:12]))
    assert some.solids == solids[10:12] and len(some) == 2
    assert (solve(some).max_indentation == solve(impacts).max_indentation[10:12]).all()


def test_failures_keep_their_place_and_words():
    friction = np.full((20, 3), 0.3)
    friction[7, 2] = -1
    with ThreadPoolExecutor(2) as pool:
        with pytest.raises(DomainError, match=r"impacts\[7, 2\]: friction = -1: must be") as caught:
            pair(RUBBER, **{**BALL, "friction": friction}, executor=pool, chunk=4)
        assert caught.value.index == (7, 2)
        result = pair(RUBBER, **{**BALL, "friction": friction}, executor=pool, on_error="nan",
                      energies=True, chunk=4)
        told = [result.message(i, k) != "" for i in range(20) for k in range(3)]
        assert np.flatnonzero(told).tolist() == [7 * 3 + 2]
    assert np.argwhere(np.isnan(result.ez)).tolist() == [[7, 2]]
    assert "friction = -1" in result.message(7, 2)


def test_processes_give_the_bits_of_one_thread_though_one_is_killed():
    killed = []

    def kill(done, total):
        if not killed:
            killed.extend(list(pool._processes)[:1])
            os.kill(killed[0], signal.SIGKILL)

    with processes(2) as pool:
        assert same_bits(pair(RUBBER, **BALL, executor=pool, chunk=2, progress=kill))
    assert killed


def test_a_chunk_whose_worker_dies_is_sent_again_a_few_times(tmp_path):
    with processes(1) as pool:
        done = map_chunks(die_once, [(i, tmp_path) for i in range(6)], pool)
        assert list(done) == [0, 1, 4, 9, 16, 25]
    with processes(1) as pool, pytest.raises(BrokenExecutor):
        list(map_chunks(die_once, [(-1, tmp_path)], pool, retries=1))
    assert (tmp_path / "-1").read_text() == "xx"
    with ThreadPoolExecutor(1) as pool, pytest.raises(ZeroDivisionError):
        list(map_chunks(lambda x: 1 // x, [1, 0, 1], pool))


@pytest.mark.filterwarnings("ignore")  # of distributed
def test_a_dask_cluster_gives_the_same_bits_though_a_worker_is_killed(monkeypatch, tmp_path):
    distributed = pytest.importorskip("distributed")
    killed = []
    monkeypatch.chdir(tmp_path)
    # a busy machine answers late, and a worker that starts late is no worker that failed
    import dask

    late = {f"distributed.comm.timeouts.{name}": "120s" for name in ("connect", "tcp")}
    monkeypatch.setattr(dask.config, "config", copy.deepcopy(dask.config.config))
    dask.config.set({**late, "distributed.scheduler.allowed-failures": 10})
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                  local_directory=str(tmp_path), silence_logs=50) as cluster:
        with distributed.Client(cluster) as client:

            def kill(done, total):
                if not killed and done < total:
                    killed.append(min(client.run(os.getpid).values()))
                    os.kill(killed[0], signal.SIGKILL)

            assert same_bits(pair(RUBBER, **BALL, executor=client, chunk=2, progress=kill))
            assert len(killed) == 1


def test_a_result_that_is_lost_on_its_way_from_dask_is_asked_for_again():
    class Lost(Future):
        status = "finished"

        def result(self, timeout=None):
            raise OSError("timed out")

    class Client:
        scheduler_info, asked = None, 0

        def submit(self, function, item, pure):
            self.asked += 1
            future = Lost() if self.asked == 2 else Future()
            future.set_result(function(item))
            return future

    client = Client()
    assert list(map_chunks(abs, [-1, -2, -3], client)) == [1, 2, 3] and client.asked == 4


def test_ranks_of_mpi_give_the_bits_of_one_thread(tmp_path):
    pytest.importorskip("mpi4py.futures")
    if not shutil.which("mpiexec"):
        pytest.skip("no mpiexec here")
    program = tmp_path / "program.py"
    program.write_text(f"""
import sys
sys.path[:0] = {[os.path.dirname(__file__), *sys.path]!r}
from mpi4py.futures import MPIPoolExecutor
import test_executor as test
if __name__ == "__main__":
    with MPIPoolExecutor() as pool:
        assert test.same_bits(test.pair(test.RUBBER, **test.BALL, executor=pool, chunk=7))
        print("same bits", pool.submit(test.os.getpid).result() != test.os.getpid())
""")
    allow = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
             "OMPI_MCA_rmaps_base_oversubscribe": "1",
             "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
    done = subprocess.run(["mpiexec", "-n", "2", sys.executable, "-m", "mpi4py.futures", program],
                          env=allow, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.stdout == "same bits True\n", done.stderr
