# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of any type, order and value, and files of any bytes, by hypothesis: documented exceptions
alone, shapes as promised, results of contiguous copies. FUZZ_EXAMPLES: how many, by default 40."""

import os
import warnings
from functools import lru_cache, partial
from itertools import product

import numpy as np
import pytest

import restitute
from restitute.command.measured import Rows
from restitute.command.options import Refusal

hypothesis = pytest.importorskip("hypothesis", reason="no hypothesis (Debian: python3-hypothesis)")
from hypothesis import HealthCheck, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.extra import numpy as npst  # noqa: E402

EXAMPLES = os.environ.get("FUZZ_EXAMPLES")
fuzz = settings(max_examples=int(EXAMPLES or 40), deadline=None, derandomize=not EXAMPLES,
                database=None, suppress_health_check=list(HealthCheck))
RUBBER = restitute.Material.standard_solid(1e6, 3e6, 300.0, density=1200, name="rubber")
SHAPES = ((), (0,), (1,), (3,), (2, 3), (2, 1), (3, 2, 1))
MATCHING = (((3,), ()), ((2, 3), (2, 1), (3,), ()), ((3, 2, 1), (2, 1), (1,)), ((0,), (1,), ()))
TYPES = ("f8", ">f8", "f4", "f2", "g", "i1", "i8", "u8", "bool", "O", "c16", "S3", "U3", "m8[s]")
PLAIN = ("f8", "f8", ">f8", "f4", "g")
DOCUMENTED = (restitute.ModelLimitWarning, restitute.ToleranceWarning, restitute.UnitWarning)
QUICK = {"method": "sync", "tolerance": 0.05, "max_work": 0.01}


def array(draw, low, high, shape, odd):
    """Of numbers in [low, high], anyhow in memory. `odd`: which of its properties is any."""
    one = usual = st.floats(np.log(low), np.log(high)).map(np.exp)
    if odd == "values":
        one |= usual | st.floats() | st.sampled_from([low, high, -low, 0.0, 1e300, np.nan, np.inf])
    shapes = st.sampled_from(SHAPES if odd == "shape" else (shape,))
    values = draw(npst.arrays("f8", shapes, elements=one, fill=st.nothing()))
    with np.errstate(all="ignore"):
        values = values.astype(draw(st.sampled_from(TYPES if odd == "type" else PLAIN)))
    layout = draw(st.sampled_from("plain strided reversed fortran frozen spread list".split()))
    if layout == "strided" and values.ndim:
        values = np.repeat(values, 2, axis=-1)[..., ::2]
    elif layout == "reversed" and values.ndim:
        values = np.ascontiguousarray(values[::-1])[::-1]
    elif layout == "fortran":
        values = np.asfortranarray(values)
    elif layout == "spread" and values.size == 1:
        values = np.broadcast_to(values, (2, *values.shape))
    values.flags.writeable = layout not in ("frozen", "spread")
    return values.tolist() if layout == "list" else values


@st.composite
def arrays(draw, matching=None, **ranges):
    """By name: one odd array, or none, or all are odd; the others plain, of shapes that match."""
    matching = matching or [one for some in MATCHING for one in product(some, repeat=len(ranges))]
    odd = draw(st.sampled_from((*ranges, *ranges, "none", "all")))
    kinds = st.sampled_from(("type", "values", "shape"))
    return {name: array(draw, *ranges[name], shape, draw(kinds) if odd in (name, "all") else "")
            for name, shape in zip(ranges, draw(st.sampled_from(matching)))}


def outcome(call, given):
    """What a call returns, or the exception. NumPy's warnings are errors (pyproject.toml)."""
    with warnings.catch_warnings():
        for category in DOCUMENTED:
            warnings.simplefilter("ignore", category)
        try:
            return tuple(call(**given))
        except restitute.Error as problem:
            return type(problem), str(problem)


def check(call, **given):
    """`call` of arrays gives what it gives of contiguous float64 copies; None if it is refused."""
    kept = {name: np.array(one) for name, one in given.items()}
    found = outcome(call, given)
    for name, one in kept.items():  # inputs stay
        assert repr(one.tolist()) == repr(np.asarray(given[name]).tolist())
    refused = isinstance(found[0], type)
    if all(one.dtype.kind in "iuf" for one in kept.values()):
        with np.errstate(all="ignore"):
            copies = {name: np.array(one, "f8", order="C") for name, one in kept.items()}
        expected = outcome(call, copies)
        assert found == expected if refused else not isinstance(expected[0], type)
        for one, other in zip(found, () if refused else expected):
            assert np.shape(one) == np.shape(other) and np.array_equal(one, other, equal_nan=True)
    return None if refused else found


def check_pairs(call, **given):
    found = check(call, **given)
    if found is not None:
        ez, ex = found
        assert np.shape(ez) == np.shape(ex) == np.broadcast_shapes(*map(np.shape, given.values()))
        assert np.all((0 <= ez) & (ez <= 1) & (abs(ex) <= 1) | np.isnan(ez) & np.isnan(ex))


@fuzz
@given(st.sampled_from(("raise", "nan")), arrays(psi=(1e-2, 10), delta1=(0.1, 10), gamma=(0.1, 10)))
def test_pair(on_error, numbers):
    check_pairs(partial(restitute.pair, on_error=on_error, **QUICK), **numbers)


@fuzz
@given(arrays(radius=(1e-3, 0.1), speed=(1e-3, 10), angle=(1e-2, 80), friction=(0.01, 2)))
def test_scene(scene):
    check_pairs(partial(restitute.pair, RUBBER, density=1100, **QUICK), **scene)


@lru_cache
def the_table():
    return restitute.Table.build(RUBBER, radius=0.001, density=1200, friction=0.3,
                                 speeds=(0.01, 0.1), tolerance=0.01)


@pytest.mark.component("table")
@fuzz
@given(arrays(normal_speed=(1e-4, 10), sliding_speed=(1e-4, 10)))
def test_table(speeds):
    check_pairs(the_table().pair, **speeds)


@fuzz
@given(arrays([(s, s, time) for s in ((1,), (2,), (3,)) for time in SHAPES],
              tau=(1e-9, 1e9), modulus=(1e-2, 1e12), time=(1e-9, 1e9)))
def test_material(given):
    def call(tau, modulus, time):
        made = restitute.Material.prony(tau, modulus, 1e6)
        return [made.relaxation_modulus(time), made.storage_modulus(time), made.loss_modulus(time),
                made.shifted(10).series.relaxation_time]

    for one in (check(call, **given) or ())[:3]:
        assert np.shape(one) == np.shape(given["time"]) and np.all(np.isfinite(one))


@pytest.mark.component("contact")
@fuzz
@given(st.sampled_from((1e-7, 1e-6, 1e-5, 1e-4) * 4 + (0, -1, np.nan, 1e300, "1")),
       arrays(list(product(((), (1,), (2,)), ((3,), (2, 3)), ((), (2,)))),
              overlap=(1e-9, 1e-5), velocity=(1e-4, 1), radius=(1e-3, 1e-2)))
def test_contact_step(step, motion):
    def call(**motion):
        law = restitute.ContactLaw(RUBBER)
        states = law.states(2)
        force = law.step(states, step, friction=0.3, **motion)
        assert np.all(force.normal >= 0) and np.all(np.isfinite(force.tangential))
        return force.normal, force.tangential, states

    check(call, **motion)


@pytest.mark.component("fit")
@fuzz
@given(arrays([((n,),) * 3 for n in (3, 4, 6)],
              frequency=(1e-3, 1e3), storage=(1e5, 1e9), loss=(1e5, 1e9)))
def test_fit_dma(curve):
    check(lambda **curve: restitute.fit_dma(**curve).material.series, **curve)


@pytest.mark.component("fit")
@settings(fuzz, max_examples=max(10, fuzz.max_examples // 4))
@given(arrays(list(product(((3,), (1, 3), ()), repeat=2)), ez=(0.1, 1), speed=(0.1, 2)))
def test_fit_drop_test(drops):
    check(lambda **drops: restitute.fit_drop_test(
        **drops, radius=0.01, mass=0.01, model="kelvin_voigt", starts=1,
        known={"modulus1": 1e7}).material.series, **drops)


@pytest.mark.component("files")
@fuzz
@given(st.one_of(st.binary(max_size=80), st.text(max_size=80).map(str.encode)),
       st.sampled_from((b"", b"tau_s,G_Pa\n", b'{"name": "a", "model": "elastic", ')),
       st.sampled_from((b"", b"}", b"1e-3,1e6\n")), st.sampled_from(("csv", "json")))
def test_material_files(tmp_path_factory, middle, begin, end, kind):
    path = tmp_path_factory.getbasetemp() / f"fuzz.{kind}"
    path.write_bytes(begin + middle + end)
    try:
        assert restitute.Material.read(path).model
    except restitute.Error as problem:
        assert str(path)[-40:] in str(problem)
        assert not any(c < " " or c == "\x7f" for c in str(problem))


@fuzz
@given(st.binary(max_size=60) | st.text('0123456789.,+-eE"\n\r\t #;infa', max_size=60)
       .map(str.encode), st.sampled_from((b"", b"speed,ez\n", b"speed,ez\n1,")))
def test_measured_files(tmp_path_factory, rows, begin):
    path = tmp_path_factory.getbasetemp() / "measured.csv"
    path.write_bytes(begin + rows)
    try:
        found = Rows(str(path), {"speed": "speed", "ez": "ez"})
        for one in found.numbers.values():
            assert one.dtype == float and len(one) == len(found.table.lines)
    except Refusal as problem:
        assert str(problem)
