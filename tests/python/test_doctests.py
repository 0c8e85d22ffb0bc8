# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the docstrings of the package."""

import doctest
import importlib
import pkgutil

import pytest

import restitute

MODULES = ["restitute"] + [
    module.name
    for module in pkgutil.walk_packages(restitute.__path__, "restitute.")
    if not module.name.endswith("__main__")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings_give_what_they_show(name, tmp_path, monkeypatch):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name.startswith("restitute"):
            raise
        pytest.skip(f"no {missing.name} here")
    monkeypatch.chdir(tmp_path)
    options = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    assert doctest.testmod(module, optionflags=options).failed == 0
