# SPDX-License-Identifier: BSD-3-Clause
"""Tables: built, looked up for arrays, saved, sent, all pairs of some materials."""

import os
import pickle
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import restitute
from restitute import _library
from restitute.command import main

pytestmark = pytest.mark.component("table")
BALL = dict(radius=0.001, density=1200, friction=0.3)


@pytest.fixture(scope="module")
def rubber():
    return restitute.Material.standard_solid(1e6, 3e6, 300.0)


@pytest.fixture(scope="module")
def table(rubber):
    return restitute.Table.build(rubber, **BALL, speeds=(0.01, 1), tolerance=1e-4)


@pytest.fixture
def speeds():
    random = np.random.default_rng(1)
    return 10 ** random.uniform(-2, 0, 500), random.uniform(-3, 3, 500)


def test_pairs_are_those_of_impacts_within_the_tolerance(rubber, table):
    normal, sliding = np.geomspace(0.011, 0.9, 7)[:, None], np.array([0.001, 0.03, 0.7])
    ez, ex = table.pair(normal, sliding, check=False)
    solved = restitute.pair(rubber, **BALL, normal_speed=normal, tangential_speed=sliding,
                            method="sync", tolerance=1e-6, radius_limit=1, displacement_limit=99)
    assert ez.shape == ex.shape == (7, 3)
    # the tolerance of the table and of the impact
    assert np.abs(ez - solved.ez).max() < 1.01e-4
    assert np.abs(ex - solved.ex).max() < 1.01e-4


def test_one_pair_is_of_numbers_and_no_pairs_are_none(table):
    ez, ex = table.pair(0.02, 0.001)
    assert isinstance(ez, float) and ez == table.pair([0.02], 0.001).ez[0]
    assert table.pair([], 0.1).ez.shape == (0,)


def test_speeds_out_of_range_are_refused_by_their_place(table):
    with pytest.raises(restitute.DomainError, match=r"normal_speed\[1\].*= -1: must be in"):
        table.pair([1, -1], 0)
    with pytest.raises(restitute.DomainError, match=r"sliding_speed\[0\].*nan"):
        table.pair([1, 1], [np.nan, 0])


def test_what_is_beyond_range_or_limits_is_counted(table):
    with pytest.warns(restitute.ModelLimitWarning) as said:
        table.pair([0.001, 0.02, 0.5, 3], [0, 0, 0, 3000])
    words = [str(one.message) for one in said]
    assert words[0] == ("2 of 4 normal speeds are outside the table's range, 0.01 to 1 m/s, whose "
                        "ends are taken")
    assert words[1].startswith("2 of 4 impacts: contact radius above 0.1")
    assert words[2].startswith("1 of 4 impacts: sliding distance above 0.3")
    assert said[0].filename == __file__
    assert table.beyond([0.001, 0.5]).tolist() == [True, False]
    assert "contact not small against the sphere from 0.171 m/s on" in table.limits


def test_flags_of_arrays_are_those_of_the_library(table, speeds):
    one, single = _library.ffi.new("int *"), []
    for normal, sliding in zip(*speeds):
        _library.call(_library.table.restitute_table_flags, table._handle, _library.ffi.NULL,
                      normal, sliding, one)
        single.append(one[0])
    flags = table.pair(*speeds, check=False).flags
    assert flags.tolist() == single
    assert set(single) == {0, 2, 4, 6}


def test_other_sizes_and_frictions_are_served(rubber, table):
    scene = dict(radius=0.0007, density=1200, friction=0.6)
    contact = table.contact(**scene)
    assert contact.speed_factor == pytest.approx(0.7**-5)
    with pytest.warns(restitute.ModelLimitWarning, match="^sliding distance above"):
        pair = table.pair(0.1, 0.5, contact)
    with pytest.warns(restitute.ModelLimitWarning, match="^sliding distance above"):
        solved = restitute.pair(rubber, **scene, normal_speed=0.1, tangential_speed=0.5,
                                method="sync", tolerance=1e-6)
    assert pair.ez == pytest.approx(solved.ez, abs=1.01e-4)
    assert pair.ex == pytest.approx(solved.ex, abs=1.01e-4)
    assert pair.flags == solved.flags == 4
    given = table.contact(radius=0.0007, density=1200, friction=table.info.friction)
    own = table.contact(radius=0.0007, density=1200)
    assert table.pair(0.02, 0.01, own).ex == table.pair(0.02, 0.01, given).ex
    # 0.01 to 1 m/s of the table's own ball, times 0.7^5
    with pytest.warns(restitute.ModelLimitWarning, match="^the normal speed is outside the "
                                                         "table's range, 0.0016807 to 0.16807 m/s"):
        table.pair(0.5, 0, contact)
    with pytest.raises(restitute.DomainError, match="^material: must be"):
        table.contact(restitute.Material.elastic(1e6), **BALL)
    with pytest.raises(restitute.DomainError, match="chi = "):
        table.contact(**BALL, rotation_blocked=True)


def test_flags_of_another_contact_are_those_of_the_library_and_of_impacts(speeds):
    solid = restitute.Material.standard_solid(1e6, 3e6, 300.0, 0.4, window=(2e-4, 1e-3))
    with pytest.warns(restitute.ModelLimitWarning, match="leave the window"):
        table = restitute.Table.build(solid, **BALL, speeds=(0.01, 1), tolerance=1e-3)
    assert table.limits[-1] == "Dundurs' |beta| 0.167 above 0.1" and table.material == solid
    for change in {}, dict(friction=0), dict(partner="same"), dict(radius=0.0012):
        ball = {**BALL, **change}
        contact = table.contact(**ball)
        ours, one, single = (one / contact.speed_factor for one in speeds), _library.ffi.new(
            "int *"), []
        normal, sliding = ours
        for speed in zip(normal, sliding):
            _library.call(_library.table.restitute_table_flags, table._handle, contact.struct,
                          *speed, one)
            single.append(one[0])
        flags = table.flags(normal, sliding, contact)
        assert flags.tolist() == single
        assert np.all(flags & 8 == (0 if change in (dict(friction=0), dict(partner="same")) else 8))
        with pytest.warns(restitute.ModelLimitWarning):
            solved = restitute.pair(solid, **ball, normal_speed=normal, tangential_speed=sliding,
                                    method="sync")
        # But for impacts within some hundredths of a limit.
        assert np.count_nonzero(flags != solved.flags) < 20 < np.count_nonzero(flags & 16) < 480


def test_bodies_collide_as_by_solving(rubber, table):
    speed = np.array([0.02, 0.1, 0.5])
    ball = restitute.Body(position=(0, 0, 0.001), radius=0.001, mass=1200 * 4 / 3e9 * np.pi,
                          velocity=speed[:, None] * [1, 0.5, -1], spin=(3, -40, 5))
    floor, before = restitute.Body(normal=(0, 0, 1)), ball.velocity.copy()
    own, still, pairs = table.collide(ball, floor)
    solved, _, exact = restitute.collide(rubber, ball, floor, friction=0.3, method="sync",
                                         tolerance=1e-6, radius_limit=1, displacement_limit=99)
    # pairs differ by 1.01e-4 at most, and speeds at the contact are below twice the normal one
    assert np.abs(own.velocity - solved.velocity).max() < 2.02e-4 * speed.max()
    assert np.abs(pairs.ez - exact.ez).max() < 1.01e-4 > np.abs(pairs.ex - exact.ex).max()
    assert np.all(still.velocity == 0) and np.array_equal(ball.velocity, before)
    with pytest.warns(restitute.ModelLimitWarning, match="^the impact is outside the table"):
        table.collide(ball._replace(velocity=(0, 0, -3.0)), floor)
    with pytest.raises(restitute.DomainError, match=r"^\[1\]: .*not closing"):
        table.collide(ball._replace(velocity=[(0, 0, -0.1), (0, 0, 0.1)]), floor)


def test_the_bits_are_the_same_for_any_number_of_threads_and_after_pickling(rubber, table, speeds):
    other = restitute.Table.build(rubber, **BALL, speeds=(0.01, 1), tolerance=1e-4, threads=2)
    again = pickle.loads(pickle.dumps(table))
    ez, ex = table.pair(*speeds, check=False)
    for one in (other, again):
        pair = one.pair(*speeds, check=False)
        assert np.array_equal(pair.ez, ez) and np.array_equal(pair.ex, ex)
    assert again.info == table.info


@pytest.mark.component("table_files")
def test_a_saved_table_loads_with_the_same_bits(table, speeds, tmp_path):
    path = tmp_path / "rubber.h5"
    table.save(path)
    loaded = restitute.Table.load(path)
    assert np.array_equal(loaded.pair(*speeds, check=False).ex, table.pair(*speeds, check=False).ex)
    path.write_bytes(path.read_bytes()[:3000])
    with pytest.raises(restitute.FormatError, match="damaged or cut"):
        restitute.Table.load(path)
    with pytest.raises(restitute.FileError, match="cannot be read"):
        restitute.Table.load(tmp_path / "none.h5")
    with pytest.raises(restitute.FileError, match="cannot be written"):
        table.save(tmp_path / "none" / "rubber.h5")


def test_a_table_is_not_made_of_a_path_and_not_written_as_text(table, tmp_path):
    with pytest.raises(TypeError, match="take Table.load of a file, or Table.build"):
        restitute.Table("a.h5")
    with pytest.raises(restitute.DomainError, match="t.csv: a table is an HDF5 file, not CSV"):
        table.save(tmp_path / "t.csv")


def test_data_of_other_shapes_are_refused_before_they_are_read(table):
    for name in ("speed", "ez", "ex", "strain", "modulus"):
        with pytest.raises(restitute.DomainError, match=rf"^data: {name} has the shape"):
            restitute.Table.from_data({**table.data, name: table.data[name][1:]})
    with pytest.raises(restitute.DomainError, match=r"must have \(1000000000,\)$"):
        restitute.Table.from_data({**table.data, "speeds": 10**9})
    with pytest.raises(TypeError, match=r"^data = b'\.\.': must be what Table\.data gives$"):
        restitute.Table.from_data(b"..")


def test_an_installation_without_files_says_what_else_keeps_a_table(table, monkeypatch):
    monkeypatch.delitem(_library.LIBRARIES, "table_files", raising=False)
    with pytest.raises(restitute.errors.MissingComponent, match="use pickle"):
        table.save("never.h5")


def test_bad_options_and_scenes_are_refused_by_name(rubber):
    for words, change in (
            ("tolerance = 1: must be", dict(tolerance=1)),
            ("speeds .m/s. = 2 to 1", dict(speeds=(2, 1))),
            ("one contact in SI units", dict(radius=[0.001, 0.002])),
            ("density = -1: must be", dict(density=-1))):
        with pytest.raises(restitute.DomainError, match=words):
            restitute.Table.build(rubber, **{**BALL, **change})
    with pytest.raises(TypeError, match="did you mean friction"):
        restitute.Table.build(rubber, radius=0.001, density=1200, fricton=0.3)
    for speed in ("speed", "normal_speed", "spin"):
        with pytest.raises(TypeError, match=f"'{speed}' is no keyword of a table.*see speeds"):
            restitute.Table.build(rubber, **BALL, **{speed: 1})
    for words, change in (("^threads = 1.5: must be a whole", dict(threads=1.5)),
                          (r"^speeds: has the shape \(3,\)", dict(speeds=(1, 2, 3)))):
        with pytest.raises(restitute.DomainError, match=words):
            restitute.Table.build(rubber, **BALL, **change)


def test_speeds_of_other_shapes_and_kinds_are_refused_by_name(table):
    with pytest.raises(restitute.DomainError, match=r"do not broadcast: normal_speed \(2,\), slid"):
        table.pair([0.1, 0.2], [0.1, 0.2, 0.3])
    with pytest.raises(restitute.DomainError, match="^sliding_speed: is a masked array"):
        table.pair(0.1, np.ma.masked_array([0.1], [True]))


def test_another_keyword_of_a_look_up_says_what_the_sliding_speed_is(table):
    with pytest.raises(TypeError, match=r"is tangential_speed \+ radius \* spin$"):
        table.pair(0.1, tangential_speed=0.1)


def test_a_table_that_misses_its_tolerance_warns(rubber):
    with pytest.warns(restitute.ToleranceWarning, match="tolerance"):
        table = restitute.Table.build(rubber, **BALL, speeds=(0.01, 1), tolerance=1e-7,
                                      max_impacts=3000)
    assert max(table.info.error_ez, table.info.error_ex) > 1e-7


def test_ctrl_c_ends_a_build_and_the_wait_for_it_at_once(rubber):
    before = threading.active_count()
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    since = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        restitute.Table.build(rubber, **BALL, tolerance=1e-7, time_limit=5, max_impacts=10**6)
    assert time.monotonic() - since < 2  # the build itself would take 4 s and more
    while threading.active_count() > before:  # it ends, too
        time.sleep(0.01)
    assert time.monotonic() - since < 3


def test_tables_of_all_pairs_are_those_built_one_by_one_here_or_elsewhere(rubber):
    glass, done = restitute.Material.elastic(1e7, 0.3), []
    build = dict(**BALL, radius2=0.001, density2=1200, speeds=(0.05, 0.5), tolerance=1e-2)
    tables = restitute.build_tables([rubber, glass], **build, threads=2,
                                    progress=lambda *state: done.append(state))
    assert done == [(1, 3), (2, 3), (3, 3)]
    single = {(0, 0): (rubber, "same"), (0, 1): (rubber, glass), (1, 1): (glass, "same")}
    with ProcessPoolExecutor(1) as pool:
        others = restitute.build_tables([rubber, glass], **build, executor=pool)
    for (i, j), (material, partner) in single.items():
        alone = restitute.Table.build(material, partner=partner, **build)
        for one in (tables[i][j], tables[j][i], others[i][j]):
            assert np.array_equal(one.data["ex"], alone.data["ex"])
    with pytest.raises(restitute.DomainError, match="friction"):
        restitute.build_tables([rubber, glass], **{**build, "friction": -1})


@pytest.mark.component("table_files")
def test_the_command_echoes_the_contact_and_names_bad_cells(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    build = ["table", "build", "--shore-a", "60", "--radius", "0.005", "--density", "1100",
             "--friction", "1/2", "--speed", "0.01:0.1", "--tolerance", "1e-2", "--output", "t.h5"]
    assert main(build) == 0
    said = capfd.readouterr()
    assert said.out.startswith("sphere, R = 5 mm, on a wall") and said.err == ""
    assert "the other rigid: friction 0.5\nt.h5: errors" in said.out
    (tmp_path / "cases.csv").write_text('name,normal_speed_m_s\na,0.05\nb,5mm\nc,"0,5"\nd,-1\n')
    assert main(["table", "query", "t.h5", "--input", "cases.csv"]) == 1
    rows = capfd.readouterr().out.splitlines()
    assert rows[1].startswith("a,0.05,0.") and rows[1].endswith(",")
    assert 'is not a number (with the unit ""mm""' in rows[2] and "decimal comma" in rows[3]
    assert 'normal_speed_m_s = ""-1"" is out of its range, [0, 1e+100]' in rows[4]
