# SPDX-License-Identifier: BSD-3-Clause
"""Solids: constructors against closed forms, names, files, pickles."""

import pickle

import numpy as np
import pytest

import restitute
from restitute import DomainError, FormatError, Material


def test_moduli_of_a_standard_solid_are_the_closed_forms():
    solid = Material.standard_solid(1e6, 3e6, 300.0)
    tau, t, w = 1e-4, np.geomspace(1e-7, 1e-1, 7), np.geomspace(1e-1, 1e9, 6)
    np.testing.assert_allclose(solid.relaxation_modulus(t), 1e6 + 3e6 * np.exp(-t / tau), 1e-14)
    complex_modulus = 1e6 + 3e6 * 1j * w * tau / (1 + 1j * w * tau)
    # The closed form cancels to about 1e-15 of its larger part, the storage modulus.
    np.testing.assert_allclose(solid.storage_modulus(w), complex_modulus.real, 1e-14)
    np.testing.assert_allclose(solid.loss_modulus(w), complex_modulus.imag, 1e-6)


def test_the_library_gives_the_same_relaxation_modulus():
    solid, core = restitute.material("polyisobutylene"), restitute._library.core
    for t in (1e-12, 1e-3, 1.0, 1e8):
        # Thirty terms in another order: 30 roundings.
        assert solid.relaxation_modulus(t) == pytest.approx(
            core.restitute_material_modulus(solid._handle, t), rel=1e-14)


def test_moduli_of_huge_arguments_do_not_warn_and_wrong_ones_are_named():
    solid = Material.prony([1e-30, 1e30], [1.0, 2.0], parallel_viscosity=5.0)
    assert solid.storage_modulus([0.0, 1e300]).tolist() == [0.0, 3.0]
    for modulus in (solid.storage_modulus, solid.loss_modulus):
        for wrong in (-1.0, np.nan, np.inf):
            with pytest.raises(DomainError, match=rf"frequency\[1\] = {wrong:g}: must be finite"):
                modulus([1, wrong])
    with pytest.raises(DomainError, match=r"time\[0, 1\] = -1: must be > 0"):
        solid.relaxation_modulus([[1.0, -1.0]])
    with pytest.raises(DomainError, match="^time = 0: must be > 0"):
        solid.relaxation_modulus(0)
    assert solid.loss_modulus(2.0) == pytest.approx(10.0 + 2 / 2e30, rel=1e-15)
    assert solid.relaxation_modulus(np.ones((2, 3))).shape == (2, 3)


@pytest.mark.parametrize(
    "solid, series",
    [
        (Material.elastic(5.0), ([], [], 5.0, 0.0)),
        (Material.kelvin_voigt(5.0, 2.0), ([], [], 5.0, 2.0)),
        (Material.maxwell(4.0, 2.0), ([0.5], [4.0], 0.0, 0.0)),
        (Material.standard_solid(1.0, 4.0, 2.0), ([0.5], [4.0], 1.0, 0.0)),
        (Material.prony([2, 1], [3, 4], 5, 6), ([1, 2], [4, 3], 5.0, 6.0)),
    ],
)
def test_constructors_give_their_series(solid, series):
    assert [np.asarray(part).tolist() for part in solid.series] == [
        np.asarray(part).tolist() for part in series]


def test_shear_moduli_come_from_young_and_shore():
    assert restitute.shear_modulus(youngs=210e9, poisson_ratio=0.3) == pytest.approx(80.769e9, 1e-4)
    # By hand: E = 0.0981 (56 + 457.4016)/(0.137505 101.6) = 3.60507 MPa.
    assert 3 * restitute.shear_modulus(shore_a=[60])[0] == pytest.approx(3.60507e6, rel=1e-5)
    with pytest.raises(DomainError, match=r"shore_a = 100: must be in \[10, 95\]"):
        restitute.shear_modulus(shore_a=100)
    with pytest.raises(TypeError):
        restitute.shear_modulus(youngs=1, shore_a=50)


def test_an_unlike_pair_has_dundurs_constant_and_its_density():
    one, other = restitute.material("aluminium_oxide"), restitute.material("soda_lime_glass")
    solid = Material.effective(one, other)
    g, nu = (154e9, 29.2e9), (0.23, 0.2)  # as tests/cli/test_model_limits.sh
    a, b = ((1 - 2 * n) / x for x, n in zip(g, nu))
    c, d = ((1 - n) / x for x, n in zip(g, nu))
    assert solid.dundurs == pytest.approx((a - b) / (2 * (c + d)), rel=2e-3)  # rounded moduli
    assert solid.parts == (one, other) and solid.density == one.density


def test_shifting_times_shifts_the_modulus():
    for solid in (restitute.material("polyisobutylene"), Material.kelvin_voigt(1e6, 5.0),
                  Material.effective(Material.maxwell(1e6, 1.0), Material.elastic(2e6))):
        shifted = solid.shifted(10.0)
        np.testing.assert_allclose(shifted.storage_modulus([1.0, 1e4]),
                                   solid.storage_modulus([10.0, 1e5]), rtol=1e-12)
        assert shifted.series.parallel_viscosity == 10 * solid.series.parallel_viscosity
        assert shifted.name == solid.name and solid.shifted(1) is solid


def test_a_temperature_shifts_by_the_cited_constants():
    cold = restitute.material("polyisobutylene", temperature=0)
    factor = 10 ** (8.61 * 25 / (200.4 - 25))
    warm = restitute.material("polyisobutylene")
    np.testing.assert_allclose(cold.series.relaxation_time / warm.series.relaxation_time, factor)
    with pytest.raises(DomainError, match="no shift of times .* steel"):
        restitute.material("steel", temperature=20)
    with pytest.raises(DomainError, match="must be above -175.4 degrees"):
        restitute.material("polyisobutylene", temperature=-200)


def test_an_unknown_name_is_answered_with_a_guess():
    with pytest.raises(DomainError, match="'steal': .*; did you mean steel"):
        restitute.material("steal")


def test_files_are_read_and_their_faults_named(tmp_path):
    (tmp_path / "solid.csv").write_text("tau_s,G_Pa\n1e-3,5e6\n1,2e6\n")
    assert restitute.material(tmp_path / "solid.csv").series.modulus.tolist() == [5e6, 2e6]
    (tmp_path / "bad.json").write_text('{"name": "x"}')
    with pytest.raises(FormatError, match="bad.json"):
        Material.read(tmp_path / "bad.json")
    with pytest.raises(restitute.FileError, match="none.json") as caught:
        Material.read(tmp_path / "none.json")
    assert isinstance(caught.value, OSError)


@pytest.mark.parametrize("solid", [
    Material.standard_solid(1e6, 3e6, 0.1, 0.3, name="x", source="y", density=7.0),
    restitute.material("polyisobutylene", temperature=3.7),
    Material.effective(Material.maxwell(1e6, 0.3, 0.1), Material.elastic(2e6, 0.4))])
def test_a_pickle_has_the_same_bits(solid):
    again = pickle.loads(pickle.dumps(solid))
    assert again == solid and hash(again) == hash(solid)
    assert (again.name, again.source, again.model) == (solid.name, solid.source, solid.model)
    assert again != Material.elastic(2e6)


def test_solids_of_arrays_are_made_once_a_combination():
    made = restitute.solids([[1e6], [0]], [1e6, 2e6], [1.0, 2.0])
    assert [[s.model for s in row] for row in made] == [["standard_solid"] * 2, ["maxwell"] * 2]
    many = restitute.solids(np.full(1000, 3.0))
    assert many.shape == (1000,) and len(set(map(id, many))) == 1
    assert restitute.solids(1.0, np.inf, 2.0).item().model == "kelvin_voigt"
    with pytest.raises(DomainError, match="-1") as caught:
        restitute.solids([1.0, -1.0])
    assert caught.value.index == 1


@pytest.mark.parametrize("make, words", [
    (lambda: Material.elastic(-1.0), "-1"),
    (lambda: Material.elastic(1.0, 0.6), "0.6"),
    (lambda: Material.prony([1.0, 1.0], [1.0, 2.0]), "relaxation_time"),
    (lambda: Material.prony([[1.0]], [[2.0]]), "one dimension")])
def test_bad_constants_are_refused_by_value(make, words):
    with pytest.raises(DomainError, match=words):
        make()


@pytest.mark.parametrize(("make", "words"), [
    (lambda: Material.elastic("soft"), "^modulus = 'soft': must be one number"),
    (lambda: Material.elastic(-1), r"^modulus \(Pa\) = -1: must be"),
    (lambda: Material.elastic([1e6]), r"^modulus = \[.*\]: must be one number"),
    (lambda: Material.elastic(1e6, density="light"), "^density = 'light': must be one number"),
    (lambda: Material.prony([1, 2], [5.0]), r"have the shapes \(2,\) and \(1,\), must have one"),
    (lambda: Material.prony([], []), "equilibrium_modulus = 0, .* and no terms: one must be > 0"),
    (lambda: Material.effective("steel", 5), "^material2 = 5: must be a Material"),
    (lambda: restitute.material(None), "^material = None: must be a name or a file"),
    (lambda: restitute.material("polyisobutylene", temperature=[20, 30]),
     r"^temperature = \[20, 30\]: must be one number"),
    (lambda: restitute.shear_modulus(youngs=[1, 2], poisson_ratio=[0.1, 0.2, 0.3]),
     "shapes do not broadcast: youngs"),
    (lambda: restitute.solids([1e6, 2e6], [1, 2, 3]), "shapes do not broadcast: modulus1"),
])
def test_constants_that_are_none_are_refused_by_name(make, words):
    with pytest.raises(DomainError, match=words):
        make()


@pytest.mark.parametrize(("call", "words"), [
    (lambda: Material("steel"), "take restitute.material of a name or a file, or a constructor"),
    (lambda: Material.standard_solid(1e6, 1e6, 3, poisson=0.3), "did you mean poisson_ratio"),
    (lambda: Material.elastic(1e6, densty=1e3), "no keyword of Material.elastic; .* density")])
def test_a_wrong_call_is_told_the_right_one(call, words):
    with pytest.raises(TypeError, match=words):
        call()


@pytest.mark.component("files")
@pytest.mark.parametrize("solid", [
    Material.elastic(1e6), Material.kelvin_voigt(1e6, 50.0, name="damper", density=1100.0),
    Material.maxwell(1e6, 50.0, window=(1e-5, 2.0)), Material.standard_solid(1e6, 3e6, 300.0, 0.4),
    restitute.material("polyisobutylene", 40)], ids=str)
def test_a_saved_material_is_read_as_it_was(solid, tmp_path):
    solid.save(tmp_path / "m.json")
    again = restitute.material(tmp_path / "m.json")
    assert again == solid
    assert again.wlf == solid.wlf and again.temperature == pytest.approx(solid.temperature,
                                                                         nan_ok=True)


def test_what_cannot_be_saved_says_why(tmp_path):
    solid = Material.elastic(1e6)
    with pytest.raises(restitute.DomainError, match="must end in .json"):
        solid.save(tmp_path / "m.txt")
    with pytest.raises(restitute.FileError, match="nowhere/m.json: cannot be written: No such"):
        solid.save(tmp_path / "nowhere" / "m.json")
    with pytest.raises(restitute.DomainError, match="save each"):
        Material.effective(solid, solid).save(tmp_path / "m.json")
