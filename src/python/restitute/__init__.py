# SPDX-License-Identifier: BSD-3-Clause
# ruff: noqa: F401
"""Restitution coefficients of viscoelastic spheres in oblique impact, with friction.

    >>> import restitute
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0, poisson_ratio=0.5)
    >>> result = restitute.pair(rubber, radius=0.001, density=1200, friction=0.3,
    ...                         speed=0.01, angle=[0, 30, 60])
    >>> result.ez.round(3)
    array([...])

SI units, arrays in and out. Names are loaded when they are first used.
"""
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # which names there are, for type checkers
    from restitute import paper, plot
    from restitute.citing import cite
    from restitute.collisions import Body, collide
    from restitute.constants import shear_modulus, solids
    from restitute.contact import ContactLaw
    from restitute.errors import (
        DomainError,
        Error,
        FileError,
        FormatError,
        MissingComponent,
        ModelLimitWarning,
        SolverError,
        ToleranceWarning,
        UnitWarning,
    )
    from restitute.executor import map_chunks
    from restitute.fitting import fit_dma, fit_drop_test
    from restitute.histories import History, history
    from restitute.impact import Pairs, pair, solve
    from restitute.materials import Material, material, material_names
    from restitute.scenes import Impacts, describe
    from restitute.solving import methods
    from restitute.table import Table
    from restitute.tables import build_tables

# Where each name comes from at run time, as above.
_HOME = {name: module for module, names in {
    "citing": "cite", "collisions": "Body collide", "constants": "shear_modulus solids",
    "contact": "ContactLaw",
    "errors": "DomainError Error FileError FormatError MissingComponent ModelLimitWarning "
              "SolverError ToleranceWarning UnitWarning",
    "executor": "map_chunks", "fitting": "fit_dma fit_drop_test", "histories": "History history",
    "impact": "Pairs pair solve",
    "materials": "Material material material_names",
    "scenes": "Impacts describe", "solving": "methods", "table": "Table",
    "tables": "build_tables",
}.items() for name in names.split()}
__all__ = sorted([*_HOME, "paper", "plot", "version"])


def version():
    """Version of the library in use, "major.minor.patch"."""
    from restitute import _library

    return _library.text(_library.core.restitute_version())


def __getattr__(name):
    if name in ("plot", "paper"):
        return import_module(f"restitute.{name}")
    if name == "__version__":
        return version()
    if name not in _HOME:
        raise AttributeError(f"module 'restitute' has no attribute '{name}'")
    globals()[name] = value = getattr(import_module(f"restitute.{_HOME[name]}"), name)
    return value


def __dir__():
    return __all__
