# SPDX-License-Identifier: BSD-3-Clause
"""Threads of Python share one material, table and law; calls of the library overlap."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

import restitute


@pytest.mark.component("contact", "table")
def test_threads_that_share_all_get_the_bits_of_one():
    rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    ball = dict(radius=1e-3, friction=0.3)
    table = restitute.Table.build(rubber, density=1200, **ball, speeds=(0.01, 1), tolerance=1e-3)
    law, speed = restitute.ContactLaw(rubber), np.geomspace(0.01, 0.1, 5000)

    def work(start):
        start.wait()
        states = law.states(5000)
        found = [states, *table.pair(speed, 0.01), *law.step(
            states, 1e-6, overlap=speed * 1e-5, velocity=[0.1, 0, 0.1], **ball)]
        pair = restitute.pair(rubber, density=1200, **ball, normal_speed=speed[::100],
                              tangential_speed=0.01, method="sync", threads=2)
        return np.concatenate([np.ravel(values) for values in (*found, pair.ez, pair.ex)])

    alone = work(Barrier(1))
    with ThreadPoolExecutor(3) as pool:
        for result in pool.map(work, [Barrier(3, timeout=60)] * 3):
            assert np.array_equal(result, alone)
