# SPDX-License-Identifier: BSD-3-Clause
"""Shear moduli of other constants, and solids of arrays of constants."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from restitute import errors
from restitute.materials import Material
from restitute.values import broadcast, numbers, refuse

__all__ = ["shear_modulus", "solids"]


def shear_modulus(*, youngs: Any = None, shore_a: Any = None, poisson_ratio: Any = 0.5) -> Any:
    """The shear modulus (Pa) of Young's modulus or of a hardness: G = E/(2 (1 + nu)).

    Parameters
    ----------
    youngs : array_like
        E, Pa.
    shore_a : array_like, in [10, 95]
        Instead of E: Shore A hardness S, with E = 0.0981 MPa (56 + 7.62336 S)/(0.137505 (254 -
        2.54 S)), A. N. Gent, Rubber Chemistry and Technology 31 (1958) 896. A rough estimate of
        the slow (equilibrium) modulus.
    poisson_ratio : array_like

    Examples
    --------
    >>> shear_modulus(youngs=[2.6e9], poisson_ratio=0.3)
    array([1.e+09])
    >>> shear_modulus(shore_a=[60, 70]).round(-4)
    array([1200000., 1840000.])
    """
    if (youngs is None) == (shore_a is None):
        raise TypeError("shear_modulus needs youngs or shore_a, one of them")
    if shore_a is not None:
        s = numbers("shore_a", shore_a)
        refuse("shore_a", s, ~((s >= 10) & (s <= 95)), "must be in [10, 95]")
        youngs = 0.0981e6 * (56 + 7.62336 * s) / (0.137505 * (254 - 2.54 * s))
    columns = numbers("youngs", youngs), numbers("poisson_ratio", poisson_ratio)
    broadcast(dict(zip(("youngs", "poisson_ratio"), columns)))
    return (columns[0] / (2 * (1 + columns[1])))[()]


def _solid(modulus1: float, modulus2: float, viscosity: float, poisson_ratio: float) -> Material:
    if viscosity == 0:
        return Material.elastic(modulus1, poisson_ratio)
    if modulus1 == 0:
        return Material.maxwell(modulus2, viscosity, poisson_ratio)
    if math.isinf(modulus2):
        return Material.kelvin_voigt(modulus1, viscosity, poisson_ratio)
    return Material.standard_solid(modulus1, modulus2, viscosity, poisson_ratio)


def solids(modulus1: Any, modulus2: Any = math.inf, viscosity: Any = 0.0,
           poisson_ratio: Any = 0.5) -> np.ndarray:
    """Solids of arrays of constants: Materials in their broadcast shape, one a combination.

    Without viscosity elastic; with modulus1 = 0 Maxwell bodies; with modulus2 infinite
    Kelvin-Voigt solids.

    Raises
    ------
    DomainError
        With `index`, in flat order, of the first combination out of range.

    Examples
    --------
    >>> solids([1e6, 1e6, 2e6]).shape
    (3,)
    """
    given = {"modulus1": modulus1, "modulus2": modulus2, "viscosity": viscosity,
             "poisson_ratio": poisson_ratio}
    given = {name: numbers(name, value) for name, value in given.items()}
    broadcast(given)
    columns = np.broadcast_arrays(*given.values())
    rows = np.stack([c.ravel() for c in columns], axis=1)
    _, first, place = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    made = np.empty(len(first), object)
    for k in np.argsort(first):
        try:
            made[k] = _solid(*rows[first[k]])
        except errors.DomainError as error:
            error.index = int(first[k])
            raise
    return made[place.ravel()].reshape(columns[0].shape)
