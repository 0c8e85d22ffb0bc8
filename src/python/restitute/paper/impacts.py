# SPDX-License-Identifier: BSD-3-Clause
"""Impacts in SI units drawn at random that have given dimensionless numbers (22)-(24).

The formulas are written out here a second time, from the paper, so that a figure tests those of the
library.
"""
from __future__ import annotations

import math
import warnings

import numpy as np

from restitute import errors
from restitute.constants import solids

CHI = 7 / 6  # an incompressible solid sphere


class Random:
    """Seeded random numbers, SplitMix64: the same on every machine."""

    def __init__(self, seed: int):
        self.state = seed

    def bits(self) -> int:
        """64 of them."""
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        z = (self.state ^ (self.state >> 30)) * 0xBF58476D1CE4E5B9 & mask
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB & mask
        return z ^ (z >> 31)

    def even(self, low, high):
        """Even in [low, high)."""
        return low + (high - low) * (self.bits() >> 11) * 2.0**-53

    def log(self, low, high):
        """Even in the logarithm."""
        return math.exp(self.even(math.log(low), math.log(high)))


def draw(random: Random, psi, delta1, gamma, tau) -> dict:
    """An impact with these numbers, by the keywords of `restitute.pair` and `restitute.solids`.

    Sizes, densities, moduli, friction, speeds, Poisson's ratio and moments of inertia are random, a
    wall or a second sphere; viscosity and sliding speed, part of it by spin, follow. psi = 0: no
    slip. tau not nan: a Maxwell body with this tau/T instead of delta1 and gamma.
    """
    nu, modulus = random.even(0.13, 0.5), random.log(1e6, 1e11)  # 2/5 <= k <= 2/3 at chi = 7/6
    speed, friction = random.log(1e-4, 0.1), random.log(0.05, 1)
    share = random.even(0, 1)
    k = 1 / (CHI * (2 - nu) / (1 - nu) - 1)  # J = k m R^2 of both spheres (22)
    bodies, partner = [_sphere(random), (math.inf, math.inf)], "rigid"
    if random.bits() % 2:
        bodies[1] = _sphere(random)
        partner = "same" if random.bits() % 2 else "rigid"
    mass, radius = (1 / sum(1 / body[i] for body in bodies) for i in (0, 1))
    effective = modulus / (2 if partner == "same" else 1)
    a_el = (15 * mass * speed**2 * radius**2 * (1 - nu) / (32 * effective)) ** 0.2  # (24)
    # (22) solved for the sliding speed, of which a share is the centre's and the rest the spin's
    sliding = (psi or 1.0) * friction * speed * (2 - nu) / (2 - 2 * nu)
    row = {}
    for (m, r), own in zip(bodies, ("", "2")):
        row.update({f"radius{own}": r, f"mass{own}": m,
                    f"inertia{own}": k * m * r**2 if m < math.inf else 0.0})
    row.update(speed=math.hypot(speed, share * sliding),
               angle=math.degrees(math.atan2(share * sliding, speed)),
               spin=(1 - share) * sliding / row["radius"], friction=friction if psi else math.inf,
               modulus1=modulus, modulus2=math.inf, viscosity=0.0, poisson_ratio=nu,
               partner=partner)
    if not math.isnan(tau):
        row.update(modulus1=0.0, modulus2=modulus,
                   viscosity=modulus * tau * a_el**2 / (radius * speed))
    elif delta1 > 0:  # (23)
        row["viscosity"] = (delta1 / math.sqrt(a_el / (effective * mass * (1 - nu)))
                            * modulus / effective)
        row["modulus2"] = modulus / gamma if gamma > 0 else math.inf
    return row


def _sphere(random):
    """Mass and radius."""
    radius, density = random.log(1e-4, 0.1), random.log(500, 1e4)
    return 4 / 3 * math.pi * radius**3 * density, radius


def keywords(columns: dict) -> dict:
    """Columns of drawn impacts as keywords of `restitute.pair`."""
    given = dict(columns)
    solid = [given.pop(name) for name in ("modulus1", "modulus2", "viscosity", "poisson_ratio")]
    return {"material": solids(*solid), **given}


def in_numbers(psi, delta1, gamma, tau, **how):
    """Impacts of dimensionless numbers alone, arrays of one shape, solved by sync.

    A Maxwell body is one of G = 1 Pa in a scene whose T, a_el and d0 are 1.
    """
    import restitute

    how = {"method": "sync", "on_error": "nan", **how}
    if np.all(np.isnan(tau)):
        return restitute.pair(chi=CHI, psi=psi, delta1=delta1, gamma=gamma, **how)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.ModelLimitWarning)
        return restitute.pair(solids(0.0, 1.0, tau), radius=1, mass=64 / 15, friction=1,
                              normal_speed=1, tangential_speed=1.5 * psi, **how)
