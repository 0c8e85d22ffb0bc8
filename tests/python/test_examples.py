# SPDX-License-Identifier: BSD-3-Clause
"""The programs and notebooks of examples/python run, and say what README.md says they do."""

import json
import runpy
import sys
import warnings
from pathlib import Path

import pytest

from restitute import ModelLimitWarning, _library

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples" / "python"
FIT = ("fit.py", "from_a_drop_test_to_a_map.ipynb")


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder of its own, and no window for figures."""
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelLimitWarning)  # what examples talk about
        yield tmp_path
    pyplot.close("all")


def needs(path):
    if path.name in FIT and not _library.available("fit"):
        pytest.skip("the component fit is not in this build")


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.name)
def test_a_program_runs_and_draws_its_figure(path, place, monkeypatch, capsys):
    needs(path)
    monkeypatch.setattr(sys, "argv", [str(path), "figure.svg"])
    runpy.run_path(str(path), run_name="__main__")
    printed = capsys.readouterr().out
    assert printed
    assert (place / "figure.svg").exists() == ("figure.svg" in printed)


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.name)
def test_a_notebook_runs_from_its_first_cell_to_its_last(path, place, monkeypatch):
    needs(path)
    monkeypatch.chdir(EXAMPLES)
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    names = {"__name__": "__main__"}
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    for number, cell in enumerate(code, 1):
        assert not cell["outputs"], f"cell {number} has outputs: strip them before committing"
        exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), names)


def test_the_first_lines_of_the_readme_are_the_first_example():
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    start = lines.index("```python") + 1
    shown = lines[start : lines.index("```", start)]
    program = (EXAMPLES / "first_impact.py").read_text(encoding="utf-8").splitlines()
    assert shown == [line for line in program if not line.startswith("# SPDX")]


def test_the_first_example_prints_what_the_readme_says(capsys):
    runpy.run_path(str(EXAMPLES / "first_impact.py"))
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert capsys.readouterr().out in readme
