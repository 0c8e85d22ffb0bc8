# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the docstrings of the package, and those of two pages."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest

import restitute
from restitute import _library

MODULES = ["restitute"] + [
    module.name
    for module in pkgutil.walk_packages(restitute.__path__, "restitute.")
    if not module.name.endswith("__main__")
]
OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings_give_what_they_show(name, tmp_path, monkeypatch):
    if name == "restitute.fitting" and not _library.available("fit"):
        pytest.skip("the component fit is not in this build")
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name.startswith("restitute"):
            raise
        pytest.skip(f"no {missing.name} here")
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(module, optionflags=OPTIONS).failed == 0


@pytest.mark.parametrize("name", ["python.md", "coming_from.md"])
def test_examples_of_a_page_give_what_they_show(name, tmp_path, monkeypatch):
    if name == "coming_from.md" and not _library.available("fit"):
        pytest.skip("the component fit is not in this build")
    pytest.importorskip("matplotlib").use("agg")
    monkeypatch.chdir(tmp_path)
    page = Path(__file__).parents[2] / "docs" / name
    assert doctest.testfile(str(page), False, optionflags=OPTIONS).failed == 0
