# SPDX-License-Identifier: BSD-3-Clause
"""What results and other objects have in common: copies, pickles, lengths, indices, one line."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import restitute
from restitute import Material, pair

RUBBER = Material.standard_solid(1e6, 3e6, 300.0, name="rubber", density=1100)
BALL = dict(radius=0.001, density=1200, friction=0.3)


def pairs():
    return pair(RUBBER, **BALL, speed=0.01, angle=[0, 30, 60], energies=True)


def drop_fit():
    return restitute.fit_drop_test(
        drop_height=[0.1, 0.2, 0.5, 1], rebound_height=[0.07, 0.14, 0.34, 0.66], radius=0.02,
        mass=0.04, model="kelvin_voigt", known={"modulus1": 3e9})


def dma_fit():
    omega = 2 * np.pi * np.geomspace(0.1, 1000, 25)
    return restitute.fit_dma(omega / (2 * np.pi), RUBBER.storage_modulus(omega),
                             RUBBER.loss_modulus(omega))


def table():
    return restitute.Table.build(RUBBER, **BALL, speeds=(0.01, 0.02), tolerance=0.01)


MADE = {
    "pairs": (pairs, lambda one: (one.ex, one.ledger.rebound_z, one.settings.tolerance,
                                  one.message(1), one.impacts.shape, one.words())),
    "history": (lambda: restitute.history(psi=1, delta1=1, gamma=1, samples=20),
                lambda one: (one.indentation, one.result.ez, len(one))),
    "events": (lambda: restitute.history(psi=1, events=True).events,
               lambda one: (one.time, one.word, one.work.steps)),
    "fields": (lambda: restitute.history(psi=1, method="bem", fields=2).fields,
               lambda one: (one.pressure, one.spacing)),
    "numbers": (lambda: restitute.Impacts(psi=[1, 2]).numbers(), lambda one: (one.psi, one.chi)),
    "drop fit": (drop_fit, lambda one: (one.value, one.fitted["ez"], one.residuals["ez"],
                                        one.material, str(one))),
    "DMA fit": (dma_fit, lambda one: (one.value, one.curves()["loss"][2], one.material, str(one))),
    "material": (lambda: Material.effective(RUBBER, Material.elastic(1e7)),
                 lambda one: (one, one.parts, one.name, one.density)),
    "table": (table, lambda one: (one.pair(0.015, 0.01).ex, one.speed)),
    "pairs of a table": (lambda: table().pair([0.011, 0.02], 0.01),
                         lambda one: (one.ez, one.ex, one.flags)),
    "contact of a table": (lambda: table().contact(radius=0.0009, density=1200, friction=0.5),
                           lambda one: (one.speed_factor, one.struct.touch_gap)),
    "contact law": (lambda: restitute.ContactLaw("steel", partner="same", elements=8),
                    lambda one: (one.state_size, one.time_scale(1.0, 0.01, 1.0))),
}
NEEDS = {"events": "cvode", "fields": "bem", "drop fit": "fit", "DMA fit": "fit",
         "table": "table", "pairs of a table": "table", "contact of a table": "table",
         "contact law": "contact"}


@pytest.mark.parametrize("kind", [
    pytest.param(kind, marks=pytest.mark.component(NEEDS.get(kind, "core"))) for kind in MADE])
def test_copies_and_pickles_are_what_they_are_of(kind):
    make, facts = MADE[kind]
    one = make()
    for other in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert type(other) is type(one)
        for fact, same in zip(facts(one), facts(other)):
            np.testing.assert_array_equal(fact, same)


def test_a_pool_of_processes_returns_pairs():
    with ProcessPoolExecutor(1) as pool:
        there = pool.submit(pair, psi=[1.0, 2.0], delta1=1, gamma=1).result()
    assert np.array_equal(there.ez, pair(psi=[1, 2], delta1=1, gamma=1).ez)


def test_pairs_have_the_length_and_the_indices_of_their_arrays():
    grid = pair(RUBBER, **{**BALL, "friction": [[0.3], [-1]]}, speed=0.01, angle=[0, 30, 60],
                on_error="nan", energies=True)
    assert len(grid) == 2 and len(grid[0]) == 3
    for index in (0, (0, 1), (slice(None), 2), (..., [2, 0])):
        assert np.array_equal(grid[index].ex, grid.ex[index], equal_nan=True)
        assert np.array_equal(grid[index].ledger.friction_x, grid.ledger.friction_x[index],
                              equal_nan=True)
    assert "friction = -1" in grid[1].message(2) and grid[0].message(2) == ""
    for one_impact in (lambda: len(grid[0, 1]), lambda: grid[0, 1][0]):
        with pytest.raises(TypeError, match="the result of one impact, .* or ez, ex = result"):
            one_impact()
    with pytest.raises(IndexError):
        grid[2]


@pytest.mark.parametrize("speed", [0.015, [0.011, 0.015], [0.011, 0.012, 0.02]])
@pytest.mark.component("table")
def test_pairs_of_impacts_and_of_tables_unpack_alike(speed):
    for result in (pair(RUBBER, **BALL, speed=speed), table().pair(speed)):
        ez, ex = result
        assert np.array_equal(ez, result.ez) and np.array_equal(ex, result.ex)
        if np.ndim(speed):
            assert len(result) == len(speed) and result[1].ez == ez[1]
            assert np.array_equal(result[1:].flags, result.flags[1:])
        else:
            with pytest.raises(TypeError, match="the result of one impact"):
                result[0]


def test_a_history_has_the_length_and_the_indices_of_its_samples():
    run = restitute.history(psi=1, delta1=1, gamma=1, samples=20, method="sync")
    assert len(run) == 20 and len(run[::4]) == 5
    assert np.array_equal(run[::4].normal_force, run.normal_force[::4])
    assert run[3].time == run.time[3]


def test_results_are_one_line_with_numbers_and_units():
    with pytest.warns(restitute.ModelLimitWarning):
        strained = pair(RUBBER, **BALL, speed=[0.01, 0.02, 1])
    assert repr(strained) == ("Pairs(3 impacts: ez 0.511 to 0.716, ex 0.0515 to 0.0736, "
                              "contact time 0.000113 to 0.000301 s, 1 flagged)")
    assert repr(pair(psi=2, delta1=1, gamma=1)) == (
        "Pairs(1 impact: ez 0.779, ex 0.491, contact time 2.25 T)")
    failed = repr(pair(psi=[[1, -1]], on_error="nan"))
    assert failed == "Pairs(1 x 2 impacts: ez 1, ex 0.423, contact time 2.94 T, 1 failed)"
    run = repr(restitute.history(psi=1, samples=20))
    assert run.startswith("History(20 samples: time 0 to 2.94") and " d0, normal force " in run
    numbers = repr(restitute.Impacts(psi=[1, 2], delta1=0).numbers())
    assert numbers.startswith("Columns(2 rows: chi 1.17, psi 1 to 2, delta1 0,")
    assert "\n" not in repr(strained) + run + numbers


def test_members_that_do_not_exist_are_answered_with_those_that_do():
    with pytest.raises(AttributeError, match="'eez' is not one of .*ez"):
        pair(psi=1).eez  # noqa: B018
