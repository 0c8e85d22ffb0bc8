# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of any type, order and value, and files of any bytes, by hypothesis: only documented
exceptions, results of the promised shape, and those of contiguous copies. FUZZ_EXAMPLES sets how
many of each (default 40, always the same)."""

import os
import warnings
from functools import lru_cache, partial

import numpy as np
import pytest

import restitute
from restitute.command.measured import Rows
from restitute.command.options import Refusal

hypothesis = pytest.importorskip("hypothesis", reason="no hypothesis (Debian: python3-hypothesis)")
from hypothesis import HealthCheck, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.extra import numpy as npst  # noqa: E402

fuzz = settings(max_examples=int(os.environ.get("FUZZ_EXAMPLES", 40)), deadline=None,
                derandomize="FUZZ_EXAMPLES" not in os.environ, database=None,
                suppress_health_check=list(HealthCheck))
RUBBER = restitute.Material.standard_solid(1e6, 3e6, 300.0, density=1200, name="rubber")
SHAPES = ((), (0,), (1,), (3,), (2, 3), (2, 1), (3, 2, 1))
ROWS = ((), (3,), (6,), (2, 2))
TYPES = ("f8", ">f8", "f4", "f2", "g", "i1", "i8", "u8", "bool", "O", "c16", "S3", "U3", "m8[s]")
DOCUMENTED = (restitute.ModelLimitWarning, restitute.ToleranceWarning, restitute.UnitWarning)
QUICK = {"method": "sync", "tolerance": 0.05, "max_work": 0.01}


@st.composite
def arrays(draw, low, high, shapes=SHAPES):
    """An array, mostly of numbers in [low, high], in any place and order of memory."""
    usual = st.floats(np.log(low), np.log(high)).map(np.exp)
    odd = st.one_of(st.floats(), st.sampled_from([low, high, -low, 0.0, 1e300, np.nan, np.inf]))
    one = usual if draw(st.integers(0, 2)) else st.one_of(usual, usual, odd)
    shape = draw(st.sampled_from(shapes))
    values = draw(npst.arrays("f8", shape, elements=one, fill=st.nothing()))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        values = values.astype(draw(st.sampled_from(TYPES)) if draw(st.booleans()) else "f8")
    layout = draw(st.sampled_from("plain strided reversed fortran frozen spread list".split()))
    if layout == "strided" and shape:
        values = np.repeat(values, 2, axis=-1)[..., ::2]
    elif layout == "reversed" and shape:
        values = np.ascontiguousarray(values[::-1])[::-1]
    elif layout == "fortran":
        values = np.asfortranarray(values)
    elif layout == "spread":
        values = np.broadcast_to(values, (2, *shape)) if values.size == 1 else values
    values.flags.writeable = layout not in ("frozen", "spread")
    return values.tolist() if layout == "list" else values


def outcome(call, given):
    """What a call returns, or the type and the text of the exception. The warnings that the
    package documents are no matter; those of NumPy are errors (pyproject.toml)."""
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
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            copies = {name: np.ascontiguousarray(one).astype("f8").reshape(one.shape)
                      for name, one in kept.items()}
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
@given(on_error=st.sampled_from(("raise", "nan")), psi=arrays(1e-2, 10), delta1=arrays(0.1, 10),
       gamma=arrays(0.1, 10))
def test_pair(on_error, **numbers):
    check_pairs(partial(restitute.pair, on_error=on_error, **QUICK), **numbers)


@fuzz
@given(radius=arrays(1e-3, 0.1), speed=arrays(1e-3, 10), angle=arrays(1e-2, 80),
       friction=arrays(0.01, 2))
def test_scene(**scene):
    check_pairs(partial(restitute.pair, RUBBER, density=1100, **QUICK), **scene)


@lru_cache
def the_table():
    return restitute.Table.build(RUBBER, radius=0.001, density=1200, friction=0.3,
                                 speeds=(0.01, 0.1), tolerance=0.01)


@pytest.mark.component("table")
@fuzz
@given(normal_speed=arrays(1e-4, 10), sliding_speed=arrays(1e-4, 10))
def test_table(**speeds):
    check_pairs(the_table().pair, **speeds)


@fuzz
@given(tau=arrays(1e-9, 1e9), modulus=arrays(1e-2, 1e12), time=arrays(1e-9, 1e9))
def test_material(**given):
    def call(tau, modulus, time):
        made = restitute.Material.prony(tau, modulus, 1e6)
        return [made.relaxation_modulus(time), made.storage_modulus(time), made.loss_modulus(time),
                made.shifted(10).series.relaxation_time]

    for one in (check(call, **given) or ())[:3]:
        assert np.shape(one) == np.shape(given["time"]) and np.all(np.isfinite(one))


@pytest.mark.component("contact")
@fuzz
@given(step=st.sampled_from((1e-7, 1e-4, 0, -1, np.nan, 1e300, "1")),
       overlap=arrays(1e-9, 1e-5, ((), (1,), (2,))),
       velocity=arrays(1e-4, 1, ((), (3,), (2, 3), (2,))), radius=arrays(1e-3, 1e-2, ((), (2,))))
def test_contact_step(step, **motion):
    law = restitute.ContactLaw(RUBBER)

    def call(**motion):
        states = law.states(2)
        force = law.step(states, step, friction=0.3, **motion)
        assert np.all(force.normal >= 0) and np.all(np.isfinite(force.tangential))
        return force.normal, force.tangential, states

    check(call, **motion)


@pytest.mark.component("fit")
@fuzz
@given(frequency=arrays(1e-3, 1e3, ROWS), storage=arrays(1e5, 1e9, ROWS),
       loss=arrays(1e5, 1e9, ROWS))
def test_fit_dma(**curve):
    check(lambda **curve: restitute.fit_dma(**curve).material.series, **curve)


@pytest.mark.component("fit")
@settings(fuzz, max_examples=max(10, fuzz.max_examples // 4))
@given(ez=arrays(0.1, 1, ((3,), (2, 2), ())), speed=arrays(0.1, 2, ((3,), (2, 2), ())))
def test_fit_drop_test(**drops):
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
        text = str(problem)
        assert str(path)[-40:] in text and not any(c < " " or c == "\x7f" for c in text)


@fuzz
@given(st.one_of(st.binary(max_size=60), st.text('0123456789.,+-eE"\n\r\t #;infa', max_size=60)
                 .map(str.encode)), st.sampled_from((b"", b"speed,ez\n", b"speed,ez\n1,")))
def test_measured_files(tmp_path_factory, rows, begin):
    path = tmp_path_factory.getbasetemp() / "measured.csv"
    path.write_bytes(begin + rows)
    try:
        found = Rows(str(path), {"speed": "speed", "ez": "ez"})
    except Refusal as problem:
        assert str(problem)
    else:
        assert all(one.dtype == float and len(one) == len(found.table.lines)
                   for one in found.numbers.values())
