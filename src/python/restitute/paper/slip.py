# SPDX-License-Identifier: BSD-3-Clause
"""From which psi on the contact slips to the end, by simulation: the algorithm of the paper.

(5), (8)-(17): positions first, then the forces of all elements, the inner displacements by backward
Euler, velocities last; fixed step, fixed elements; friction on a slipping element has the direction
of the trial force. It shares no code with the library, nor the formula (31).
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

    def at_rest(self):
        """b, shape (n, half)."""
        return self.u + self.arm * self.w

    def move(self, force, at_rest):
        """Move the elements so that they bear these forces."""
        distance = (force - at_rest) / self.stiffness
        self.u += distance
        self.w = self.kept * (self.w + distance)


def critical_psi(chi, delta1, gamma, radius, time, elements: int) -> np.ndarray:
    """Least psi without stick at any time in any element, by bisection.

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
    forces = _normal_forces(Foundation(delta1, gamma, step, half), spacing, step, 20 * steps)
    low, high = np.ones(len(step)), np.full(len(step), 4 * chi)  # psi_c <= 4 chi - 1
    while np.max(high - low) > 1e-7:
        psi = 0.5 * (low + high)
        stuck = _sticks(Foundation(delta1, gamma, step, half), forces, chi, psi, spacing, step)
        low, high = np.where(stuck, psi, low), np.where(stuck, high, psi)
    return np.where(forces[-1].any(axis=1), np.nan, 0.5 * (low + high))


def _normal_forces(foundation, spacing, step, most):
    """Forces of all elements, step by step until all spheres have separated."""
    profile = ((np.arange(foundation.u.shape[1]) + 0.5) * spacing) ** 2
    depth, velocity = np.zeros_like(step), np.ones_like(step)
    forces: list[np.ndarray] = []
    while len(forces) < most and (not forces or forces[-1].any() or (velocity > 0).any()):
        depth += step * velocity
        rest = foundation.at_rest()
        force = np.maximum(rest + foundation.stiffness * (depth - profile - foundation.u), 0)
        foundation.move(force, rest)
        velocity -= step * 15 / 8 * spacing * force.sum(axis=1, keepdims=True)
        forces.append(force)
    return forces


def _sticks(foundation, forces, chi, psi, spacing, step):
    """Whether some element sticks at some time, shape (n,)."""
    velocity, stuck = psi[:, None].copy(), np.zeros(len(step), bool)
    for normal in forces:
        rest = foundation.at_rest()
        trial = rest + foundation.stiffness * step * velocity
        force = np.clip(trial, -normal, normal)
        stuck |= ((force == trial) & (normal > 0)).any(axis=1)
        if stuck.all():
            break
        foundation.move(force, rest)
        velocity -= step * 15 / 4 * chi * spacing * force.sum(axis=1, keepdims=True)
    return stuck
