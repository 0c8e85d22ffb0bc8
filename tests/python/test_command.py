# SPDX-License-Identifier: BSD-3-Clause
"""The command's main in this process: numbers, names, messages, exit statuses. What its files look
like is tested by tests/cli."""
import csv
import json
import os
import pathlib
import signal
import subprocess
import sys

import pytest

import restitute
from restitute.command import COMMANDS, main, options, parser_of, problem
from restitute.command.partial import Partial

DOCS = pathlib.Path(__file__).parents[2] / "docs"
BALL = ["--radius", "0.005", "--friction", "0.3", "--speed", "0.1"]


@pytest.fixture
def run(capfd):
    """run(word, ...): exit status, standard output, standard error."""
    def call(*words):
        status = main(list(words))
        return (status, *capfd.readouterr())
    return call


def refused(run, *words):
    status, out, err = run(*words)
    assert (status, out) == (2, "")
    assert err.startswith("restitute: ") and err.count("\n") == 1
    return err


@pytest.mark.parametrize(("text", "value"), [
    ("7/6", 7 / 6), ("-1.5e-3", -1.5e-3), ("+.5", 0.5), ("5.", 5), ("INF", float("inf")),
    ("1e-320", 1e-320), ("0e-999", 0)])
def test_numbers_are_decimal_or_fractions(text, value):
    assert options.number(text) == value


@pytest.mark.parametrize(("text", "why"), [
    ("1,5", "a decimal comma; write 1.5"), ("5mm", 'with the unit "mm"'), ("1e3 kg/m^3", "kg/m^3"),
    ("pi/4", "write 0.785398163397448"), ("2*pi", "write 6.28318530717959"), (" 1", "blanks"),
    ("1/0", "division by zero"), ("1e999", "too large"), ("1e-999", "too large or too small")])
def test_what_is_no_number_is_named_as_what_it_is(text, why):
    with pytest.raises(ValueError, match="."):
        options.number(text)
    with pytest.raises(options.Refusal) as refusal:
        options.read_number(text, "--psi", "must be > 0", lambda x: x > 0)
    assert why in str(refusal.value) and str(refusal.value).endswith(": must be > 0")


@pytest.mark.parametrize("text", ["", "nan", "0x10", "1e", "1_000", "--1", "1/2/3", "٣",
                                  "1 2", "e5"])
def test_what_else_is_no_number(text):
    with pytest.raises(ValueError, match="is not a number"):
        options.number(text)


@pytest.mark.parametrize(("option", "meant"), [
    ("--speeed", "--speed"), ("--diameter", "--radius, half of it"), ("--mu", "--friction"),
    ("--nu", "--poisson-ratio"), ("--E", "--youngs-modulus"), ("--Speed", "--speed")])
def test_an_unknown_option_is_answered_by_the_one_that_was_meant(run, option, meant):
    assert f"unknown option; did you mean {meant}?" in refused(run, "pair", option, "1")


def test_an_option_that_resembles_none_is_answered_by_the_help(run):
    err = refused(run, "pair", "--xyzzy", "1")
    assert err == "restitute: --xyzzy: unknown option; see --help\n"


@pytest.mark.parametrize(("words", "meant"), [
    (["pari"], "pair"), (["pair", "--psi", "1", "--method", "sinc"], "sync"),
    (["pair", "--psi", "1", "--format", "jsn"], "json"),
    (["pair", *BALL, "--material", "steal"], "steel"),
    (["pair", *BALL, "--material", "steel", "--partner", "sam"], "same")])
def test_a_misspelt_word_is_answered_by_the_one_that_was_meant(run, words, meant):
    assert f"did you mean {meant}?" in refused(run, *words)


def test_whatever_follows_an_option_is_its_value(run):
    assert "--psi = -1: must be in" in refused(run, "pair", "--psi", "-1")
    assert '--psi = "--chi" is not a number' in refused(run, "pair", "--psi", "--chi")
    assert "takes no value" in refused(run, "pair", "--rotation-blocked=1")


@pytest.mark.parametrize("field", problem.FIELDS.values(), ids=lambda field: field.name)
def test_each_field_has_one_name_and_accepts_its_older_ones(field):
    assert problem.field_of_column(field.key) is field
    assert problem.field_of_column(field.key.upper()) is field
    suffix = field.key[len(field.name):]
    assert all(problem.field_of_column(name + suffix) is field for name in field.older)
    if suffix:
        assert problem.field_of_column(field.name) is None
        assert problem.similar_column(field.name) == f"; did you mean {field.key}?"


def test_columns_of_older_versions_are_known():
    old = """chi psi delta1 gamma delta2 radius1_m density1_kg_m3 mass1_kg inertia1_kg_m2 radius2_m
    density2_kg_m3 mass2_kg inertia2_kg_m2 speed_m_s angle_deg spin_rad_s spin2_rad_s friction
    modulus1_Pa modulus2_Pa viscosity_Pa_s poisson_ratio time_shift"""
    found = [problem.field_of_column(name).name for name in old.split()]
    new = [name for name in problem.FIELDS
           if name not in ("youngs_modulus", "shore_a", "temperature")]
    assert sorted(found) == sorted(new)


def pair_of(run, *words):
    status, out, _ = run("pair", *words, "--format", "csv")
    assert status == 0
    return next(csv.DictReader(out.splitlines()))


def test_older_options_give_the_same_under_the_name_of_today(run):
    new = pair_of(run, "--material", "steel", *BALL, "--angle", "30")
    old = pair_of(run, "--material", "steel", "--radius1", "0.005", "--friction", "0.3",
                  "--velocity", "0.1", "--angle", "30")
    assert new == old and "speed_m_s" in new and "radius_m" in new


def test_moduli_are_accepted_as_youngs_modulus_and_as_hardness(run):
    ball = [*BALL, "--density", "1100", "--poisson-ratio", "0.49"]
    young = pair_of(run, *ball, "--youngs-modulus", "2.98e6")
    shear = pair_of(run, *ball, "--modulus1", "1e6")  # E = 2 (1 + nu) G
    assert young["max_indentation"] == shear["max_indentation"]
    shore = float(pair_of(run, *ball, "--shore-a", "60")["max_indentation"])
    # Gent's formula by hand: 3.605 MPa at Shore A 60. The indentation goes as E^(-2/5).
    expected = float(young["max_indentation"]) * (3.605 / 2.98) ** -0.4
    assert shore == pytest.approx(expected, rel=1e-4)  # 3.605 has four digits
    err = refused(run, "pair", *ball, "--shore-a", "60", "--modulus1", "1e6")
    assert "--modulus1 and --shore-a are both given" in err


def test_a_sphere_against_a_rigid_partner_has_the_density_of_its_material(run):
    taken = pair_of(run, *BALL, "--material", "polyisobutylene")
    given = pair_of(run, *BALL, "--material", "polyisobutylene", "--density", "920")
    assert taken["ez"] == given["ez"]
    assert "the sphere is of the material, 920 kg/m^3" in run(
        "pair", *BALL, "--material", "polyisobutylene")[1]
    err = refused(run, "pair", *BALL, "--modulus1", "1e6")
    assert "--density or --mass is missing" in err


def test_each_of_two_bodies_has_the_density_of_its_own_material(run):
    spheres = [*BALL, "--radius2", "0.01", "--material", "steel", "--partner", "aluminium_oxide"]
    taken = pair_of(run, *spheres)
    assert taken["ez"] == pair_of(run, *spheres, "--density", "7850", "--density2", "4000")["ez"]


def test_gamma_without_delta1_is_not_ignored(run):
    err = refused(run, "pair", "--psi", "2", "--gamma", "1")
    assert "--delta1 is missing: --gamma needs delta1 (0: elastic) or delta2" in err


def test_the_scene_is_said_in_words(run):
    out = run("pair", "--material", "steel", "--partner", "polyisobutylene", *BALL)[1]
    assert "sphere of Structural steel, R = 5 mm, on a wall of Polyisobutylene" in out


def test_messages_have_the_name_that_the_user_gave(run):
    assert "--velocity = 0: must be" in refused(run, "pair", "--velocity", "0")
    err = refused(run, "pair", "--material", "steel", *BALL, "--density", "1", "--mass1", "1")
    assert "--density and --mass1 are both given" in err
    err = refused(run, "pair", "--material", "steel", *BALL, "--mass2", "1")
    assert err == "restitute: --mass2 needs a partner sphere, --radius2\n"


def test_json_has_what_text_has(run):
    document = json.loads(run("pair", "--psi", "2", "--delta1", "1", "--gamma", "1", "--format",
                              "json")[1])
    pair = restitute.pair(psi=2, delta1=1, gamma=1, energies=True)
    assert document["result"]["ex"] == pair.ex
    assert document["energy"]["friction_x"] == pair.ledger.friction_x
    assert document["numbers"]["delta2"] == 1 and document["meta"]["units"]["time_step"] == "T"


def test_an_exception_of_the_library_is_a_message(run):
    err = refused(run, "pair", "--psi", "2", "--delta1", "100", "--gamma", "0", "--time-step", "1")
    assert "time_step = 1" in err


@pytest.mark.parametrize(("error", "expected"), [
    (KeyboardInterrupt(), 130), (BrokenPipeError(), 141), (MemoryError(), 2)])
def test_statuses_of_interruption_of_a_broken_pipe_and_without_memory(
        run, monkeypatch, error, expected):
    def stop(words):
        raise error
    monkeypatch.setattr("restitute.command._run", stop)
    assert run("pair")[0] == expected


def test_a_signal_ends_a_long_impact_at_once():
    # Euler at 1e-8 takes minutes.
    words = ["pair", "--psi", "0.01", "--tolerance", "1e-8", "--max-work", "inf", "--time-limit",
             "inf"]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    process = subprocess.Popen([sys.executable, "-m", "restitute.command", *words], env=env)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(1.5)
    process.send_signal(signal.SIGINT)
    assert process.wait(20) in (-signal.SIGINT, 130)


def test_a_signal_while_rows_are_written_is_not_lost(run, monkeypatch, tmp_path):
    def commit(partial, rows, committed=Partial.commit):
        committed(partial, rows)
        os.kill(os.getpid(), signal.SIGINT)
    monkeypatch.setattr(Partial, "commit", commit)
    out = str(tmp_path / "o.csv")
    status, _, err = run("pair", "--grid", "psi=1:2:3", "--output", out)
    assert status == 130 and err == f"restitute: interrupted after 3 of 3 rows, all in {out}\n"
    assert sorted(os.listdir(tmp_path)) == ["o.csv", "o.csv.meta.json"]


def test_a_signal_while_numpy_is_imported_ends_the_command_without_a_word(tmp_path):
    (tmp_path / "numpy.py").write_text(  # as the C code of NumPy does
        "import os, signal, traceback\n"
        "try:\n    os.kill(os.getpid(), signal.SIGINT)\n    sum(range(1000))\n"
        "except KeyboardInterrupt:\n    traceback.print_exc()\n    raise ImportError\n")
    code = "import sys; from restitute.command import main; sys.exit(main())"
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])}
    done = subprocess.run([sys.executable, "-c", code, "pair", "--psi", "1"], env=env,
                          capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


@pytest.mark.parametrize(("words", "remark"), [
    (["--density", "1.15"], "density = 1.15 kg/m^3 is less than a solid has; 1.15 g/cm^3 are 1150"),
    (["--density", "1.15", "--angle", "30"], "density = 1.15 kg/m^3 is less")])
def test_what_looks_like_another_unit_is_remarked_once(run, words, remark):
    status, _, err = run("pair", *BALL, "--material", "steel", *words)
    assert status == 0 and err.count(remark) == 1
    err = run("pair", "--material", "steel", "--radius", "0.005", "--friction", "0.3", *words[:2],
              "--grid", "speed=0.01:0.1:50")[2]
    assert err.count(remark) == 1


def test_a_radius_in_millimetres_is_remarked_once(run):
    words = ["pair", "--material", "steel", "--partner", "same", "--radius", "5", "--friction",
             "0.3", "--speed", "0.5"]
    status, _, err = run(*words)
    assert status == 0 and err.count("radius = 5 m is large for an impact; it is in m, not mm") == 1


def test_a_sphere_without_density_is_pointed_at_the_same_partner(run):
    err = refused(run, "pair", *BALL, "--material", "steel", "--radius2", "0.005")
    assert "--density2 or --mass2 is missing" in err and "(or --partner same: both" in err


def test_a_grid_has_the_contact_radius_and_says_how_far_limits_are_exceeded(run):
    words = ["pair", "--material", "rubber", "--radius", "0.003", "--friction", "0.5", "--grid"]
    status, out, err = run(*words, "speed=0.01:1:3:log")
    rows = list(csv.DictReader(out.splitlines()))
    alone = restitute.pair("rubber", radius=0.003, friction=0.5, speed=0.01)
    assert float(rows[0]["radius_ratio"]) == alone.radius_ratio
    most = float(rows[2]["radius_ratio"])
    assert "1 of 3 rows exceed the limit LARGE_CONTACT" in err and f"up to {most:.3g}\n" in err
    assert "radius_ratio" not in run("pair", "--grid", "psi=1:2:3")[1]


def test_materials_are_listed_and_shown(run):
    listed = run("materials")[1]
    assert all(name in listed for name in restitute.material_names())
    shown = run("materials", "show", "polyisobutylene")[1]
    assert "920 kg/m^3" in shown and shown.count("\n") == 41  # 30 terms and what stands above them
    warm = run("materials", "polyisobutylene", "--temperature", "40")[1]
    assert warm.startswith("Polyisobutylene (NBS), 25 C, shifted to 40 C\n")
    assert "did you mean steel?" in refused(run, "materials", "show", "stel")


@pytest.mark.parametrize(("words", "same"), [
    (["steel"], restitute.material("steel")),
    (["polyisobutylene", "--temperature", "40"], restitute.material("polyisobutylene", 40)),
    (["damper.json"], restitute.Material.kelvin_voigt(1e6, 50.0, density=1100.0))],
    ids=["elastic", "prony", "kelvin_voigt"])
def test_a_material_that_is_shown_as_json_is_a_material_file(run, tmp_path, monkeypatch, words,
                                                             same):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "damper.json").write_text(
        '{"name": "damper", "poisson_ratio": 0.5, "model": "kelvin_voigt", "modulus1_pa": 1e6, '
        '"viscosity_pa_s": 50, "density_kg_m3": 1100}')
    file = tmp_path / "shown.json"
    file.write_text(run("materials", "show", *words, "--format", "json")[1])
    assert restitute.Material.read(file) == same


def test_a_temperature_shifts_the_times_of_the_material(run, tmp_path):
    warm = restitute.pair(restitute.material("polyisobutylene", 40), radius=0.005, friction=0.3,
                          speed=0.1, density=920)
    words = ["pair", *BALL, "--material", "polyisobutylene"]
    out = run(*words, "--temperature", "40")[1]
    assert f"ez = {warm.ez:9.6f}" in out and "25 C, shifted to 40 C, R = 5 mm, on a rigid" in out
    rows = list(csv.DictReader(run(*words, "--grid", "temperature=25:40:2")[1].splitlines()))
    assert [row["temperature_c"] for row in rows] == ["25", "40"]
    assert float(rows[1]["ez"]) == warm.ez
    (tmp_path / "cases.csv").write_text("material,temperature_c\nsteel,\npolyisobutylene,40\n")
    rows = list(csv.DictReader(
        run("pair", *BALL, "--input", str(tmp_path / "cases.csv"))[1].splitlines()))
    assert [float(row["ez"]) for row in rows] == [pytest.approx(1), warm.ez]


@pytest.mark.parametrize(("words", "why"), [
    (["--material", "polyisobutylene", "--temperature", "-200"], "--temperature = -200: must be"),
    (["--material", "steel", "--temperature", "20"], "no shift of times"),
    (["--material", "steel", "--temperature", "20"], "take --time-shift"),
    (["--modulus1", "1e6", "--density", "1e3", "--temperature", "20"], "needs --material"),
    (["--material", "steel", "--temperature", "20", "--time-shift", "2"], "are both given"),
    (["--material", "steel", "--partner", "steel", "--temperature", "20"], "without --temperature"),
])
def test_a_temperature_without_a_known_shift_is_refused(run, words, why):
    assert why in refused(run, "pair", *BALL, *words)


def test_ranges_are_shown_to_the_last_digit(run):
    assert "must be a whole number in [0, 4294967295]" in refused(run, "paper", "fig4", "--seed",
                                                                  "-1")
    assert "did you mean polyisobutylene?" in refused(run, "paper", "temperature", "--material",
                                                      "polyisobutylen")


@pytest.mark.parametrize(("words", "why"), [
    (["--friction", "-1"], "--friction = -1: must be >= 0 (inf: no slip)"),
    (["--friction", "1e-40"], "--friction = 1e-40: must be 0 or >= 1e-30 (inf: no slip)")])
def test_what_the_library_refuses_has_the_name_of_its_option(run, words, why):
    assert why in refused(run, "pair", "--material", "steel", "--radius", "0.1", "--speed", "1",
                          *words)


@pytest.mark.parametrize("name", ["pair", "history", "materials"])
def test_help_names_every_option_and_imports_no_numpy(name):
    code = (f"import sys; from restitute.command import main; status = main(['{name}', '--help']); "
            "sys.exit(3 if 'numpy' in sys.modules else status)")
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    parser, _ = parser_of(name)
    for action in parser._actions:
        assert all(option in done.stdout for option in action.option_strings)


@pytest.mark.component("bem", "cvode", "fit", "table_files")
def test_the_manual_page_says_what_help_says():
    template, page = DOCS / "restitute.1.in", DOCS / "restitute.1"
    if not template.exists():
        pytest.skip("the tests of an installed package have no docs")
    lacking = [name for name, (module, _) in COMMANDS.items()
               if not pathlib.Path(options.__file__).with_name(f"{module}.py").exists()]
    if lacking:
        pytest.skip(f"not yet there: {lacking}")
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, DOCS / "manual_page.py", template], env=env,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == page.read_text(encoding="utf-8"), "run the target `manual`"
