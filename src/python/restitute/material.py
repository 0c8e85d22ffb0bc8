# SPDX-License-Identifier: BSD-3-Clause
"""Linear-viscoelastic solids."""
from __future__ import annotations

import os

import numpy as np

from restitute import _library
from restitute._library import call, ffi

__all__ = ["Material"]


class Material:
    """A linear-viscoelastic solid: its shear relaxation modulus and Poisson ratio,

        G(t) = G_inf + sum_k G_k exp(-t/tau_k) + eta_inf delta(t).

    Immutable; threads may share it. Made by one of its constructors.

    Attributes
    ----------
    name, source, model : str
        What a file says; empty without one.
    density : float
        kg/m^3; nan if none is given.
    """

    def __init__(self, handle, name="", source="", model="", density=np.nan):
        self._handle = ffi.gc(handle, _library.core.restitute_material_destroy)
        self.name, self.source, self.model, self.density = name, source, model, density

    @classmethod
    def _made(cls, function, *arguments, **about):
        handle = ffi.new("restitute_material **")
        call(function, *arguments, handle)
        return cls(handle[0], **about)

    @classmethod
    def elastic(cls, modulus: float, poisson_ratio: float = 0.5, **about) -> Material:
        """Elastic solid of shear modulus `modulus` (Pa)."""
        return cls._made(_library.core.restitute_material_elastic, modulus, poisson_ratio, model="elastic", **about)

    @classmethod
    def standard_solid(cls, modulus1: float, modulus2: float, viscosity: float, poisson_ratio: float = 0.5,
                       **about) -> Material:
        """Standard solid: spring G1 parallel to a spring G2 and a dashpot eta in series (Pa, Pa, Pa s)."""
        return cls._made(_library.core.restitute_material_standard_solid, modulus1, modulus2, viscosity, poisson_ratio,
                         model="standard_solid", **about)

    @classmethod
    def prony(cls, relaxation_time, modulus, equilibrium_modulus: float = 0.0, parallel_viscosity: float = 0.0,
              poisson_ratio: float = 0.5, **about) -> Material:
        """Prony series.

        Parameters
        ----------
        relaxation_time, modulus : array_like, shape (n,)
            tau_k (s), G_k (Pa).
        equilibrium_modulus, parallel_viscosity : float
            G_inf (Pa), eta_inf (Pa s).
        """
        tau, g = np.broadcast_arrays(np.atleast_1d(relaxation_time), np.atleast_1d(modulus))
        tau, g = np.array(tau, float, ndmin=1), np.array(g, float, ndmin=1)
        return cls._made(_library.core.restitute_material_prony, equilibrium_modulus, parallel_viscosity, len(tau),
                         _library.pointer(tau), _library.pointer(g), poisson_ratio, model="prony", **about)

    @classmethod
    def read(cls, path: str | os.PathLike) -> Material:
        """A material from a .json or .csv file."""
        info = _library.struct("material_info", "files")
        handle = ffi.new("restitute_material **")
        call(_library.files.restitute_material_read, _library.string(path), handle, info)
        return cls(handle[0], *(_library.text(part) for part in (info.name, info.source, info.model)), info.density)

    @property
    def poisson_ratio(self) -> float:
        """nu."""
        return _library.core.restitute_material_poisson_ratio(self._handle)

    def __repr__(self):
        return f"<restitute.Material {self.name or self.model}>"
