# SPDX-License-Identifier: BSD-3-Clause
"""Pairs of arrays of impacts: reference values, broadcasting, refusals, warnings, histories."""

import ast
import signal
import threading
import warnings
from pathlib import Path

import numpy as np
import pytest

import restitute
from restitute import DomainError, Impacts, Material, ModelLimitWarning, ToleranceWarning, pair

RUBBER = Material.standard_solid(1e6, 3e6, 300.0, name="rubber", density=1100)
# A gentle impact: no limit of the model is passed.
BALL = dict(radius=0.001, density=1200, friction=0.3, speed=0.01)

# chi, psi, delta1, gamma, ez, ex of tests/data/impact_truth.csv and tests/cli/test_batch_truth.sh.
TRUTH = np.array([
    [1.1666666666666667, 1.61024, 0.297421, 0.00189351, 0.515970297702, 0.2528355288],
    [2.26, 2.73024, 7.12413, 0, 0.015102848360, 0.0039478924],
    [1.1666666666666667, 0.864392, 0.446919, 50.9936, 0.999273654442, 0.3890445556],
    [1.168, 5.35045, 0, 1, 1, -0.1268024185],
    [2.397, 0.0554072, 16.3653, 0.0306157, 0.662078621933, -0.1648365917]])


@pytest.mark.parametrize("method", ["euler", "sync"])
def test_pairs_are_those_of_the_reference(method):
    chi, psi, delta1, gamma, ez, ex = TRUTH.T
    result = pair(chi=chi, psi=psi, delta1=delta1, gamma=gamma, method=method)
    np.testing.assert_allclose(result.ez, ez, rtol=0, atol=1e-3)  # the default tolerance
    np.testing.assert_allclose(result.ex, ex, rtol=0, atol=1e-3)
    assert result.method == method and (result.status == 0).all()


def test_delta2_stands_for_delta1_or_gamma():
    whole = pair(psi=2, delta1=[0.5, 2.0], gamma=4)
    assert (pair(psi=2, delta1=[0.5, 2.0], delta2=[1.0, 4.0]).ez == whole.ez).all()
    assert (pair(psi=2, delta2=[1.0, 4.0], gamma=4).ez == whole.ez).all()


def test_arrays_broadcast_and_every_place_is_its_own_impact():
    speed, angle = np.array([[0.01], [0.02], [0.005]]), np.array([0, 30.0, 60, 80])
    result = pair(RUBBER, **{**BALL, "speed": speed}, angle=angle, spin=np.zeros((2, 1, 1)))
    assert result.shape == result.ez.shape == result.status.shape == (2, 3, 4)
    one = pair(RUBBER, **{**BALL, "speed": 0.005}, angle=60.0)
    assert one.shape == () and one.ez == result.ez[1, 2, 2] and one.ex == result.ex[0, 2, 2]
    assert pair(RUBBER, **{**BALL, "speed": []}).ez.shape == (0,)


def test_normal_and_tangential_speed_are_speed_and_angle():
    polar = pair(RUBBER, **BALL, angle=30)
    parts = {**BALL, "normal_speed": 0.01 * np.cos(np.pi / 6), "speed": None}
    other = pair(RUBBER, **parts, tangential_speed=0.01 * np.sin(np.pi / 6))
    assert other.ex == pytest.approx(polar.ex, rel=1e-12)


def test_a_mass_is_a_density_and_a_material_gives_its_own():
    mass = 4 / 3 * np.pi * 0.001**3 * 1100
    both = {"radius": 0.001, "radius2": 0.002, "speed": 0.01, "partner": "same",
            "friction": 0.3}
    own = pair(RUBBER, **both)
    assert pair(RUBBER, **both, mass=mass, mass2=8 * mass).ez == pytest.approx(own.ez, rel=1e-12)
    fast = pair(RUBBER, **both, density2=np.inf)
    assert fast.ez != own.ez
    wall = pair(RUBBER, **{**both, "radius2": [0.002, np.inf]})
    ball = {**both, "radius2": None}
    assert wall.ez[0] == own.ez and wall.ez[1] == pair(RUBBER, **ball).ez
    rigid = pair(RUBBER, **{**ball, "partner": "rigid"})  # the same rule against a rigid partner
    assert rigid.ez == pair(RUBBER, **{**ball, "partner": "rigid"}, mass=mass).ez != own.ez
    with pytest.raises(TypeError, match="density2 or mass2 is missing: .*partner='same': both"):
        pair(RUBBER, **{**both, "partner": "rigid"})
    with pytest.raises(TypeError, match="density or mass is missing: .*the material has none"):
        pair(Material.elastic(1e6), **ball)


@pytest.mark.parametrize("function", [pair, restitute.history, restitute.describe, Impacts,
                                      pytest.param(lambda *solid, speed, **ball:
                                               restitute.Table.build(*solid, **ball), id="table")])
def test_friction_is_required_of_all_alike(function):
    with pytest.raises(TypeError, match=r"^friction is missing: must be >= 0 \(inf: no slip\)"):
        function(RUBBER, radius=0.001, speed=0.01)


@pytest.mark.parametrize("name", ["density", "density2"])
def test_a_density_in_grams_a_cubic_centimetre_is_warned_of(name):
    with pytest.warns(restitute.UnitWarning, match=f"^{name} = 1.15 kg/m.3 is less than a solid"):
        Impacts(RUBBER, **{**BALL, "partner": "same", "radius2": 0.001, name: 1.15})


@pytest.mark.parametrize("name", ["radius", "radius2"])
def test_a_radius_in_millimetres_is_warned_of(name):
    ball = {**BALL, "partner": "same", "radius2": 0.001, name: 5}
    with pytest.warns(restitute.UnitWarning, match=f"^{name} = 5 m is large .* in m, not mm$"):
        Impacts(RUBBER, **ball)
    del ball["density"]
    Impacts(RUBBER, **ball, mass=1e3, mass2=1e3)  # no warning: the size is meant, or is a scale
    Impacts(RUBBER, **{**BALL, "radius2": np.inf})  # a wall


def test_a_density_in_grams_a_cubic_centimetre_of_a_material_is_warned_of():
    light = Material.elastic(1e6, density=1.15)
    with pytest.warns(restitute.UnitWarning, match="^density of the material = 1.15 kg/m"):
        Impacts(light, radius=0.001, friction=0.3, speed=0.1)


def test_materials_and_partners_broadcast_with_the_rest():
    steel = restitute.material("steel")
    result = pair([RUBBER, steel], partner=[["rigid"], ["same"], [steel]], **BALL,
                  dundurs_limit=0.5)
    assert result.shape == (3, 2) and len(result.impacts.solids) == 4
    assert result.ez[0, 0] == pair(RUBBER, **BALL).ez
    assert result.ez[1, 0] == pair(RUBBER, partner="same", **BALL).ez
    assert result.ez[2, 0] == pair(Material.effective(RUBBER, steel), **BALL).ez
    assert result.ez[0, 1] == pytest.approx(1, abs=1e-3)  # elastic; the tolerance


def test_a_time_shift_is_a_shifted_material():
    result = pair(RUBBER, **BALL, time_shift=[0.1, 1, 10])
    assert result.ez[2] == pair(RUBBER.shifted(10), **BALL).ez
    assert result.ez[1] == pair(RUBBER, **BALL).ez != result.ez[0]


def test_a_rotation_that_is_blocked_changes_ex_alone():
    free, blocked = (pair(RUBBER, **BALL, angle=10, rotation_blocked=b) for b in (False, True))
    assert free.ez == blocked.ez and abs(free.ex - blocked.ex) > 0.01


def test_energies_add_up():
    ledger = pair(psi=[0.5, 3], delta1=1, gamma=1, energies=True).ledger
    normal = ledger.rebound_z + ledger.viscous_z + ledger.left_z
    np.testing.assert_allclose(normal, 1 - ledger.residual_z, rtol=1e-14)
    assert (ledger.friction_x > 0).all() and pair(psi=1).ledger is None


@pytest.mark.parametrize("keywords, words", [
    ({"speeed": 1}, "'speeed' .* did you mean speed"),
    ({"psi": 1}, r"numbers of the paper \(psi\) and SI units"),
    ({"mass": 1}, "mass and density are both given"),
    ({"radius": None}, "radius is missing"),
    ({"speed": None}, "give speed"),
    ({"tangential_speed": 1}, "give speed"),
    ({"density2": 5000}, "density2 needs a partner sphere"),
    ({"friction": None}, "^friction is missing: must be >= 0"),
    ({"delta": 5}, "'delta' .* did you mean delta1"),
    ({"velocity": 5}, "'velocity' .* did you mean speed"),
    ({"time_shift": 2, "partner": RUBBER}, "time_shift beside")])
def test_keywords_that_do_not_fit_together_are_refused(keywords, words):
    with pytest.raises(TypeError, match=words):
        pair(RUBBER, **{**BALL, **keywords})


@pytest.mark.parametrize("keywords, words", [
    ({"speed": [1, 2, 0]}, r"impacts\[2\]: speed = 0: must be finite and > 0"),
    ({"angle": [[0, 90]]}, r"impacts\[0, 1\]: angle = 90: must be in \[0, 90\)"),
    ({"density": np.nan}, "^density = nan: must be"),
    ({"angle": [np.inf, 0]}, r"impacts\[0\]: angle = inf: must be"),
    ({"speed": 1e999, "angle": 0.0}, "^speed = inf: must be finite"),
    ({"radius2": 0.1, "density2": -1}, r"^density2 = -1: must be > 0 \(inf: held fast\)"),
    ({"friction": [0, -0.1]}, r"impacts\[1\]: friction = -0.1: must be"),
    ({"radius": "wide"}, "radius = 'wide': must be a number"),
    ({"radius": True}, "radius = True: must be a number"),
    ({"spin": 10**400}, "spin = 1000.*: must be a number"),
    ({"speed": np.datetime64("2020-01-01")}, "speed = .*2020-01-01.*: must be a number"),
    ({"angle": np.ma.masked_equal([1, 2], 2)}, r"angle: is a masked array; take \.filled"),
    ({"radius": 1e200}, r"^radius \(m\) = 1e\+200: must be"),
    ({"chunk": 0}, "chunk = 0: must be a whole number in"),
    ({"executor": 5}, "executor = 5: must be a concurrent.futures.Executor or"),
    ({"partner": 5}, "partner = 5: must be a Material, its name or a file"),
    ({"method": ["sync"]}, r"method = \['sync'\]: must be one of"),
    ({"angle": [1, 2], "spin": [1, 2, 3]}, r"do not broadcast: .*spin \(3,\)"),
    ({"tolerance": 1}, "tolerance = 1: must be in"),
    ({"threads": 1.5}, "threads = 1.5: must be a whole number"),
    ({"method": "sinc"}, "'sinc'; did you mean sync"),
    ({"on_error": "ignore"}, "on_error = 'ignore'"),
    ({"time_shift": -1}, "time_shift = -1")])
def test_values_out_of_range_are_refused_with_value_place_and_range(keywords, words):
    with pytest.raises(DomainError, match=words):
        pair(RUBBER, **{**BALL, **keywords})


@pytest.mark.parametrize("keywords, words", [
    ({"delta2": [1, 0], "gamma": 1}, r"impacts\[1\]: delta2 = 0: must be in \(0, 1e12\]"),
    ({"delta2": 1, "gamma": np.inf}, "gamma = inf: must be finite and > 0 beside delta2"),
    ({"delta2": 1, "delta1": 0}, "delta1 = 0: must be finite and > 0 beside delta2"),
    ({"delta1": 1, "gamma": -4}, "gamma = -4: must be")])
def test_numbers_of_the_paper_out_of_range_are_refused(keywords, words):
    with pytest.raises(DomainError, match=words):
        pair(psi=1, **keywords)
    impacts = Impacts(psi=1, **keywords)
    assert impacts.numbers().shape == impacts.shape
    with pytest.raises(TypeError, match="delta2 needs delta1 or gamma beside it, one of them"):
        Impacts(psi=1, delta2=1)


def test_failed_impacts_are_nan_and_say_why():
    rows = {**BALL, "friction": [0.3, -1, 0.3], "angle": [10, 10, 95]}
    result = pair(RUBBER, **rows, on_error="nan", energies=True)
    assert np.isnan(result.ez).tolist() == [False, True, True]
    assert np.isnan(result.ledger.rebound_z).tolist() == [False, True, True]
    assert result.status.tolist() == [0, -3, -3]
    assert result.words().tolist() == ["", result.message(1), "angle = 95: must be in [0, 90)"]
    assert result.message(1).startswith("friction = -1: must be")
    counts = []
    with pytest.raises(DomainError) as caught:
        pair(RUBBER, **{**BALL, "friction": np.where(np.arange(5000) == 5, -1, 0.1)},
             progress=lambda *count: counts.append(count))
    assert caught.value.index == (5,) and caught.value.status == -3
    assert counts[-1][0] < 5000  # the rest is not solved


def test_limits_that_are_passed_are_counted_in_one_warning_each():
    with pytest.warns(ModelLimitWarning) as caught:
        result = pair(RUBBER, **{**BALL, "speed": [[0.01], [1.0], [2.0]]}, angle=[0, 10])
    assert len(caught) == 1 and caught[0].filename == __file__
    assert str(caught[0].message).startswith("4 of 6 impacts: contact radius above 0.1 of the sp")
    assert result.limits()[0][:2] == ("LARGE_CONTACT", 4)
    assert result.words()[:, 0].tolist() == ["", "LARGE_CONTACT", "LARGE_CONTACT"]
    assert result.message(1, 1).startswith("contact radius/R = ")
    with pytest.warns(ModelLimitWarning, match="^contact radius above 0.1 of the sphere's: 0.2"):
        pair(RUBBER, **{**BALL, "speed": 1})


def test_package_and_library_say_alike_what_a_large_contact_costs():
    elastic, smooth = Material.elastic(1e6), dict(friction=0)
    for solid, ball, cost in (
            (RUBBER, dict(speed=1), " (ez is known to about +-0.04, ex to +-0.5 if it sticks)"),
            (RUBBER, dict(speed=1, **smooth), " (ez is known to about +-0.04)"),
            (elastic, dict(speed=1), " (ex is known to about +-0.5 if it sticks)"),
            (elastic, dict(speed=1, **smooth), ""),
            (elastic, dict(speed=15), " (beyond 0.5 no bound of the error is known)"),
            (RUBBER, dict(speed=1e5), " (more than the sphere: are moduli in Pa, lengths in m, "
                                      "speeds in m/s?)")):
        with pytest.warns(ModelLimitWarning) as caught:
            result = pair(solid, **{**BALL, **ball}, speed_limit=np.inf)
        for text in (str(caught[0].message), result.message()):
            assert text.endswith(cost) and (cost or not text.endswith(")")), text
    with pytest.warns(ModelLimitWarning, match=r"up to 0.2\d+ \(ez is .*, ex .*sticks\)$"):
        pair([RUBBER, elastic], **{**BALL, "speed": 1, "friction": [0, 0.3]}, speed_limit=np.inf)


def test_a_missed_tolerance_is_a_warning():
    with pytest.warns(ToleranceWarning, match="1 of 2 impacts: .* above the tolerance 1e-06"):
        result = pair(psi=[0.5, np.inf], delta1=[1, 0], gamma=1, tolerance=1e-6, max_work=1e-3)
    assert result.status.tolist() == [2, 0]
    assert result.words()[0] == "the estimated error is above the requested tolerance"


def test_threads_and_pieces_change_no_bit():
    psi = np.linspace(0.1, 4, 60)
    one = pair(psi=psi, delta1=1, gamma=1, method="sync")
    two = pair(psi=psi, delta1=1, gamma=1, method="sync", threads=2)
    singly = [pair(psi=p, delta1=1, gamma=1, method="sync") for p in psi]
    for name in ("ez", "ex", "error_ex", "work"):
        assert (getattr(one, name) == getattr(two, name)).all()
        assert (getattr(one, name) == [getattr(s, name) for s in singly]).all()


def test_control_c_ends_a_batch_and_progress_is_told():
    counts = []
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pair(psi=np.linspace(0.1, 3, 100_000), delta1=1, gamma=1,
             progress=lambda done, total: counts.append((done, total)))
    timer.join()
    assert counts == sorted(counts) and 0 < counts[-1][0] < counts[-1][1] == 100_000


def test_numbers_and_words_of_a_scene():
    impacts = Impacts(RUBBER, **BALL, angle=[0, 45])
    numbers = impacts.numbers()
    # (22) for a solid incompressible sphere: chi = 7/6, psi = 2/3 tan(angle)/mu.
    np.testing.assert_allclose(numbers.chi, 7 / 6, rtol=1e-14)
    np.testing.assert_allclose(numbers.psi, [0, 2 / 3 / 0.3], rtol=1e-14)
    np.testing.assert_allclose(numbers.gamma, 1 / 3, rtol=1e-14)
    assert Impacts(psi=1, delta1=2, gamma=4).numbers().delta2 == 4
    assert impacts.describe().startswith("sphere of rubber, R = 1 mm, on a rigid wall: ")
    assert "0 to 45 degrees" in impacts.describe()
    steel = {**BALL, "density": 7800}
    assert "rigid sphere, R = 1 mm, on a wall of rubber" in restitute.describe(RUBBER, **steel)
    unknown = restitute.Material.elastic(1e6, name="rubber")
    assert "one of them of rubber" in restitute.describe(unknown, **steel)
    assert restitute.describe(RUBBER, **BALL, partner="same", radius2=[0.1, np.inf]) == (
        "sphere of rubber, R = 1 mm, on a sphere or a wall of the same: 0.01 m/s, 0 degrees, "
        "friction 0.3")


def test_a_history_ends_with_the_pair():
    run = restitute.history(RUBBER, **BALL, angle=40, samples=300, method="sync")
    assert len(run.time) == 300 and run.time[-1] == run.result.contact_time
    # The last sample is interpolated in the last step: of second order in 1/300.
    assert -run.normal_velocity[-1] / run.normal_velocity[0] == pytest.approx(run.result.ez, 1e-3)
    assert run.indentation.max() == pytest.approx(run.result.max_indentation, rel=1e-4)
    assert run.result.ledger.friction_x > 0 and run.events is None is run.fields
    with pytest.raises(DomainError, match=r"has the shape \(2,\), must be one impact"):
        restitute.history(psi=[1, 2])
    for samples in (1, 10.5):
        with pytest.raises(DomainError, match=f"^samples = {samples}: must be a whole number in"):
            restitute.history(psi=1, samples=samples)


@pytest.mark.component("cvode")
def test_events_are_in_order_and_named():
    run = restitute.history(psi=1, delta1=1, gamma=1, events=True, tolerance=1e-4)
    assert run.result.method == "cvode" and (np.diff(run.events.time) >= 0).all()
    assert {"entry", "exit", "turn", "contact-end"} <= set(run.events.word)
    assert run.events.time[-1] == pytest.approx(run.result.contact_time, rel=1e-3)
    assert run.events.work.steps > 0
    with pytest.raises(DomainError, match="the method euler logs none"):
        restitute.history(psi=1, method="euler", events=True)


@pytest.mark.component("bem")
def test_fields_carry_the_normal_force():
    run = restitute.history(psi=1, delta1=0.3, gamma=1, method="bem", elements=15, fields=3,
                            tolerance=0.01)
    fields = run.fields
    assert fields.pressure.shape == fields.stick.shape == (3, *fields.pressure.shape[1:])
    force = fields.pressure.sum(axis=(1, 2)) * fields.spacing**2
    # Hertz for nu = 1/2: F = 16/3 G sqrt(R) d^1.5, so m v_z0^2/2 = 32/15 G a_el d0^2, and the unit
    # m v_z0^2/d0 is 64/15 G a_el d0. The grid of 15 cells a radius and the step are good to 2 %.
    expected = 64 / 15 * np.interp(fields.time, run.time, run.normal_force)
    np.testing.assert_allclose(force, expected, rtol=0.02)
    with pytest.raises(DomainError, match="need the method bem"):
        restitute.history(psi=1, fields=3)


def test_a_missing_component_is_named(monkeypatch):
    monkeypatch.delitem(restitute._library.LIBRARIES, "bem", raising=False)
    monkeypatch.delitem(vars(restitute._library), "bem", raising=False)
    with pytest.raises(restitute.errors.MissingComponent, match="component bem is not installed"):
        pair(psi=1, method="bem")
    assert "bem" not in restitute.methods()


def test_members_of_a_result_are_listed_and_others_refused():
    result = pair(psi=1)
    assert {"ez", "status", "ledger"} <= set(dir(result)) and "struct_size" not in dir(result)
    with pytest.raises(AttributeError, match="'e_z' is not one of .*ez"):
        result.e_z  # noqa: B018
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert result.limits() == [] and np.isnan(result.radius_ratio)


def test_type_checkers_know_the_names_that_the_package_has():
    module = ast.parse(Path(restitute.__file__).read_text())
    block = next(node for node in module.body if isinstance(node, ast.If))
    told = {(name.name, line.module.partition(".")[2])
            for line in block.body for name in line.names}
    home = {**restitute._HOME, "paper": "", "plot": ""}
    assert told == set(home.items()) and set(home) | {"version"} == set(restitute.__all__)
    assert all(getattr(restitute, name).__name__ == name for name in restitute._HOME)
