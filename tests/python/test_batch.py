# SPDX-License-Identifier: BSD-3-Clause
"""Batches and grids of the command, beyond what tests/cli asks of them: what a cell may be, what is
said of many rows, other formats, resume from any byte, elsewhere."""
import csv
import io
import json
import os
import pathlib
import pty
import subprocess
import sys

import numpy as np
import pytest

import restitute
from restitute.command import cases, main, options, rows

BALL = ["--radius", "0.005", "--density", "7800", "--friction", "0.3"]
PACKAGE = pathlib.Path(restitute.__file__).parents[1]
FLAGS = {"LARGE_CONTACT": 2, "LONG_SLIDE": 4}


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(tmp_path, capfd):
    """run(CASES or None, word, ...): exit status, rows of the result, standard error."""
    def call(text, *words):
        if text is not None:
            (tmp_path / "cases.csv").write_text(text, "utf-8")
            words = ("--input", "cases.csv", *words)
        status = main(["pair", *words])
        out, err = capfd.readouterr()
        return status, list(csv.DictReader(io.StringIO(out))), err
    return call


# The balls of these tests press deeper than the model is good for.
deep = pytest.mark.filterwarnings("ignore::restitute.errors.ModelLimitWarning")


def column(table, name):
    return np.array([float(row[name] or "nan") for row in table])


def test_rows_have_the_bits_of_the_package(run):
    psi, delta1 = np.random.default_rng(3).uniform(0.1, 5, (2, 50))
    text = "psi,delta1\n" + "".join(f"{p!r},{d!r}\n" for p, d in zip(psi.tolist(), delta1.tolist()))
    status, table, err = run(text, "--gamma", "0.5")
    pairs = restitute.pair(psi=psi, delta1=delta1, gamma=0.5)
    assert (status, err) == (0, "")
    for name in ("ez", "ex", "contact_time", "max_indentation", "error_ez", "error_ex"):
        assert np.array_equal(column(table, name), getattr(pairs, name))


def test_a_cell_may_be_a_fraction_and_a_column_have_an_older_name(run):
    _, table, _ = run("velocity_m_s,radius1_m,angle_deg\n1/2,7/1000,30\n", "--material", "steel",
                      "--friction", "0.3")
    pair = restitute.pair("steel", density=restitute.material("steel").density, radius=0.007,
                          speed=0.5, angle=30, friction=0.3, dundurs_limit=0.5)
    assert float(table[0]["ez"]) == pair.ez and table[0]["velocity_m_s"] == "1/2"


def test_unknown_columns_are_passed_through_and_named(run):
    status, table, err = run('label,psi,note\n"a, b",1,7\n#c,2,\n"#d\n\n#e",3,x\n')
    assert status == 0 and [row["label"] for row in table] == ["a, b", "#d\n\n#e"]
    assert [row["note"] for row in table] == ["7", "x"]
    assert err == "restitute: remark: cases.csv: passed through as unknown: label, note\n"


@pytest.mark.parametrize(("cell", "why"), [
    ("5mm", 'with the unit "mm"'), ('"1,5"', "a decimal comma; write 1.5"), ("1e999", "too large"),
    ("1e-999", "too large or too small"), ("٣", "is not a number"), ("1_0", "is not a number"),
    ("", "psi is empty: must be in [0, 1e12]"), ("nan", "is not a number"), ("1e", "is not a num")])
def test_a_bad_cell_is_named_as_what_it_is_and_alone_fails(run, cell, why):
    status, table, err = run(f"psi,delta1\n1,0\n{cell},0\n2,0\n")
    assert status == 1 and why in table[1]["status"]
    assert "cases.csv line 3 (row 2): psi" in err and "1 of 3 rows failed" in err
    assert [row["ez"] != "" for row in table] == [True, False, True]


@deep
def test_rows_of_a_table_may_differ_in_what_they_give(run):
    status, table, _ = run(
        "density_kg_m3,mass_kg,material,partner,speed_m_s\n"
        "7800,,steel,rigid,1\n,0.004,steel,same,2\n,,steel,polyisobutylene,1\n"
        "7800,0.004,steel,rigid,1\n7800,,stel,rigid,1\n", "--radius", "0.005", "--friction", "0.3")
    steel = restitute.material("steel")
    ball = dict(radius=0.005, friction=0.3, on_error="nan")
    expected = [restitute.pair(steel, density=7800, speed=1, **ball).ez,
                restitute.pair(steel, mass=0.004, speed=2, partner="same", **ball).ez,
                restitute.pair(steel, speed=1, partner="polyisobutylene", **ball).ez]
    assert status == 1 and column(table, "ez")[:3].tolist() == expected
    assert table[3]["status"] == (
        "density_kg_m3 and mass_kg are both given: one determines the other")
    assert "did you mean steel?" in table[4]["status"]


@deep
def test_a_solid_of_its_own_for_every_row(run):
    _, table, _ = run("modulus1_pa,youngs_modulus_pa,viscosity_pa_s\n1e6,,100\n,6e6,200\n"
                      "5e6,,500\n", *BALL, "--speed", "0.1")
    for row, modulus in zip(table, (1e6, 2e6, 5e6)):
        solid = restitute.Material.kelvin_voigt(modulus, modulus / 1e4)
        pair = restitute.pair(solid, radius=0.005, density=7800, friction=0.3, speed=0.1,
                              on_error="nan")
        assert float(row["ez"]) == pair.ez


def test_how_many_rows_pass_which_limit_stands_in_record_and_on_standard_error(run):
    status, _, err = run(None, "--material", "polyisobutylene", *BALL, "--grid",
                         "speed=0.1:10:3:log,angle=0:80:5", "--output", "out.csv")
    with open("out.csv", newline="") as file:
        words = [row["status"].split() for row in csv.DictReader(file)]
    passed = {name: sum(name in flags for flags in words) for name in FLAGS}
    with open("out.csv.meta.json") as file:
        assert json.load(file)["limits_passed"] == passed
    assert status == 0 and 0 < passed["LONG_SLIDE"] < passed["LARGE_CONTACT"] < 15
    for name, count in passed.items():
        assert f"restitute: remark: {count} of 15 rows exceed the limit {name}: " in err


def test_rows_that_miss_the_tolerance_are_counted(run):
    _, table, err = run("psi,gamma\n" + "0.5,1\n" * 5, "--delta1", "1", "--tolerance", "1e-6",
                        "--max-work", "1e-4")
    missed = sum(row["status"] != "" for row in table)
    assert missed == 5 and "remark: 5 of 5 rows: " in err and "tolerance" in err


def test_json_and_hdf5_hold_what_csv_holds(run):
    h5py = pytest.importorskip("h5py")
    text = "psi,delta1,who\n1,0,ä\nx,0,b\n0,1e12,c\n"
    for name in ("out.csv", "out.json", "out.h5"):
        assert run(text, "--gamma", "0", "--method", "sync", "--output", name, *(
            ["--format", "json"] if name == "out.json" else []))[0] == 1
        assert not os.path.exists(f"{name}.partial")
    with open("out.csv", newline="") as file:
        table = list(csv.DictReader(file))
    with open("out.json") as file:
        document = json.load(file)
    for row, other in zip(table, document["results"]):
        assert list(row) == list(other)
        for name, cell in row.items():
            assert other[name] == (cell if isinstance(other[name], str) else
                                   float(cell) if cell else None)
    with h5py.File("out.h5") as file:
        assert np.array_equal(file["ez"][:], column(table, "ez"), equal_nan=True)
        assert file["psi"].asstr()[:].tolist() == ["1", "x", "0"]
        assert file["delta1"][:].tolist() == [0, 0, 1e12]
        assert file["who"].asstr()[:].tolist() == ["ä", "b", "c"]
        assert file["contact_time"].attrs["unit"] == "T"
        record = json.loads(file.attrs["record"])
    assert record["failed"] == document["meta"]["failed"] == 1


def test_a_run_goes_on_from_any_byte_with_the_same_end(run):
    text = 'psi,delta1,note\n1,0.5,"two\nlines"\n2,-1,"a ""b"""\n3,0.5,c\n'
    assert run(text, "--gamma", "1", "--output", "whole.csv")[0] == 1
    with open("whole.csv", "rb") as file:
        whole = file.read()
    with open("whole.csv.meta.json") as file:
        settings = json.load(file)["settings"]
    assert run(text, "--gamma", "1", "--output", "whole.json", "--format", "json")[0] == 1
    for length in (*range(0, len(whole), 8), len(whole)):
        with open("cut.csv.partial", "wb") as file:
            file.write(whole[:length])
        with open("cut.csv.partial.json", "w") as file:
            json.dump(settings, file)
        assert run(text, "--gamma", "1", "--output", "cut.csv", "--resume")[0] == 1
        with open("cut.csv", "rb") as file:
            assert file.read() == whole, length
    os.replace("cut.csv", "cut.json.partial")
    with open("cut.json.partial.json", "w") as file:
        json.dump(settings, file)
    assert run(text, "--gamma", "1", "--output", "cut.json", "--format", "json", "--resume")[0] == 1
    with open("whole.json") as one, open("cut.json") as other:
        assert json.load(one)["results"] == json.load(other)["results"]


def test_what_is_written_is_read_back_exactly():
    bits = np.random.default_rng(1).integers(0, 2**63, 2000)
    values = np.concatenate([bits.view(float), [0.0, 1.0, 0.1, 1e-5, 123456789.0, np.inf, np.nan]])
    texts = rows._texts(values)
    assert texts[-7:] == ["0", "1", "0.1", "1e-05", "123456789", "inf", ""]
    back = [float(text or "nan") for text in texts]
    assert np.array_equal(back, values, equal_nan=True)


def test_different_texts_are_read_as_options_are():
    texts = ["1", "-2.5e3", ".5", "5.", "7/6", "inf", "0", "0e-99", "1e400", "1e-400", "1-2", "x"]
    values, reasons = cases.numbers(texts, options.number)
    for text, value in zip(texts, values):
        if text in reasons:
            with pytest.raises((ValueError, OverflowError)):
                options.number(text)
        else:
            assert options.number(text) == value
    assert set(reasons) == {"1e400", "1e-400", "1-2", "x"}


@pytest.mark.parametrize(("text", "why"), [
    ('psi\n1"2\n', "line 2: a stray quote"), ('psi\n"1"2\n', "line 2: "),
    ('psi\n1\n"2\n3\n', "line 3: a quote is never closed"),
    ("psi,delta1\n\n1\n", "line 3: 1 cells"), ('psi,a\n1,"\n\n"\n2\n', "line 5: 1 cells")])
def test_a_bad_table_is_refused_with_its_line(tmp_path, text, why):
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(options.Refusal) as refusal:
        cases.Table(str(tmp_path / "t.csv"))
    assert f"t.csv {why}" in str(refusal.value)


@pytest.mark.filterwarnings("ignore")  # of distributed
def test_a_dask_scheduler_gives_the_same_bytes(run):
    distributed = pytest.importorskip("distributed")
    text = "psi\n" + "".join(f"{i / 100}\n" for i in range(300)) + "-1\n"
    words = ["--delta1", "1", "--gamma", "1", "--method", "sync", "--output"]
    assert run(text, *words, "here.csv")[0] == 1
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                  processes=False) as cluster:
        assert run(text, *words, "there.csv", "--scheduler", cluster.scheduler_address)[0] == 1
    with open("here.csv") as here, open("there.csv") as there:
        assert here.read() == there.read()


def test_progress_with_the_time_left_is_shown_on_a_terminal_only():
    pytest.importorskip("tqdm")
    with open("cases.csv", "w") as file:
        file.write("psi\n" + "0.5\n" * 500)
    terminal, other_end = pty.openpty()
    subprocess.run([sys.executable, "-m", "restitute.command", "pair", "--input", "cases.csv",
                    "--method", "sync", "--output", "out.csv"], check=True, timeout=60,
                   stderr=other_end, env={**os.environ, "PYTHONPATH": str(PACKAGE)})
    os.close(other_end)
    shown = os.read(terminal, 100000).decode()
    os.close(terminal)
    assert "500/500" in shown and "rows/s" in shown
