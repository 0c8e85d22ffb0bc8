# SPDX-License-Identifier: BSD-3-Clause
"""From which psi on the contact slips to the end, by simulation: the algorithm of the paper.

(5), (8)-(17): positions first, then the forces of all elements, the inner displacements by backward
Euler, velocities last; fixed step, fixed elements; friction on a slipping element has the direction
of the trial force. It shares no code with the library, nor the formula (31).

As long as all elements slip, their forces do not depend on psi, and the sliding velocity is psi
less what friction took. So one run tells for every element and step up to which psi it would stick.
"""
from __future__ import annotations

import numpy as np


class Foundation:
    """Half a foundation under n spheres, each with its own standard solid in units of G1, T, a_el.

    An element that moves by du has the force b + s du, where b is that of an element at rest.
    """

    def __init__(self, delta1, gamma, step, half):
        theta, gamma = np.sqrt(32 / 15) * delta1, np.asarray(gamma, float)
        arm = (gamma > 0) & (theta > 0)  # else a dashpot beside the spring, or the spring alone
        modulus = np.where(arm, 1 / np.where(arm, gamma, 1), 0)[:, None]
        tau = np.where(arm, gamma * np.where(arm, theta, 1), 1)[:, None]
        self.kept = 1 / (1 + step / tau)
        self.arm = modulus * self.kept
        self.stiffness = 1 + np.where(gamma > 0, 0, theta)[:, None] / step + self.arm
        self.u, self.w = np.zeros((2, len(step), half))

    def at_rest(self) -> np.ndarray:
        """b, shape (n, half)."""
        return self.u + self.arm * self.w

    def move(self, force: np.ndarray, at_rest: np.ndarray) -> None:
        """Move the elements so that they bear these forces."""
        distance = (force - at_rest) / self.stiffness
        self.u += distance
        self.w = self.kept * (self.w + distance)


def critical_psi(chi, delta1, gamma, radius, time, elements: int) -> np.ndarray:
    """Largest psi at which some element sticks at some time.

    Parameters
    ----------
    chi : float
    delta1, gamma : ndarray, shape (n,)
    radius, time : ndarray, shape (n,)
        Largest contact radius (a_el) and duration (T), which set the spacing of the elements and
        the time step.
    elements : int
        Over the largest contact radius.

    Returns
    -------
    ndarray, shape (n,)
        nan where the sphere does not separate within twenty times `time`.
    """
    half, steps = elements + elements // 4 + 1, 64 * elements
    spacing, step = (np.asarray(radius) / elements)[:, None], (np.asarray(time) / steps)[:, None]
    normal, shear = (Foundation(delta1, gamma, step, half) for _ in range(2))
    profile = ((np.arange(half) + 0.5) * spacing) ** 2
    depth, velocity, taken = np.zeros_like(step), np.ones_like(step), np.zeros_like(step)
    psi = np.zeros(len(step))
    for _ in range(20 * steps):
        depth += step * velocity
        rest, rest_x = normal.at_rest(), shear.at_rest()
        force = np.maximum(rest + normal.stiffness * (depth - profile - normal.u), 0)
        touching = force > 0
        if not touching.any() and (velocity < 0).all():
            return psi
        sticks_up_to = taken + (force - rest_x) / (shear.stiffness * step)
        psi = np.maximum(psi, np.max(sticks_up_to, axis=1, where=touching, initial=0))
        normal.move(force, rest)
        shear.move(force, rest_x)
        total = spacing * force.sum(axis=1, keepdims=True)
        velocity -= step * 15 / 8 * total
        taken += step * 15 / 4 * chi * total
    return np.where(touching.any(axis=1), np.nan, psi)
