# SPDX-License-Identifier: BSD-3-Clause
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

_HOME = {
    "errors": ("Error", "DomainError", "FileError", "FormatError", "SolverError",
               "MissingComponent", "ToleranceWarning", "ModelLimitWarning"),
    "materials": ("Material", "material", "material_names", "shear_modulus", "solids"),
    "scenes": ("Impacts", "describe"),
    "solving": ("methods",),
    "impact": ("pair", "solve", "Pairs"),
    "histories": ("history", "History"),
    "collisions": ("collide", "Body"),
    "executor": ("map_chunks",),
    "table": ("Table", "build_tables"),
    "contact": ("ContactLaw",),
    "fitting": ("fit_drop_test", "fit_dma"),
}
_MODULES = ("plot", "paper")
__all__ = sorted([name for names in _HOME.values() for name in names] + [*_MODULES, "version"])


def version():
    """Version of the library in use, "major.minor.patch"."""
    from restitute import _library

    return _library.text(_library.core.restitute_version())


def __getattr__(name):
    if name in _MODULES:
        return import_module(f"restitute.{name}")
    for module, names in _HOME.items():
        if name in names:
            value = getattr(import_module(f"restitute.{module}"), name)
            globals()[name] = value
            return value
    if name == "__version__":
        return version()
    raise AttributeError(f"module 'restitute' has no attribute '{name}'")


def __dir__():
    return __all__
