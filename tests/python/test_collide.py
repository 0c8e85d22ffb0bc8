# SPDX-License-Identifier: BSD-3-Clause
"""Bodies in space: conservation, agreement with `pair`, refusals."""

import numpy as np
import pytest

from restitute import Body, DomainError, Material, collide, pair

RUBBER = Material.standard_solid(1e6, 2e6, 50.0)
FLOOR = Body(normal=(0, 0, 1))


def test_a_ball_on_a_floor_rebounds_as_pair_says():
    speed, angle = 0.2, np.radians([[0.0], [30], [60]])
    velocity = speed * np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], axis=-1)
    ball = Body((0, 0, 0.01), velocity, radius=0.01, mass=[4e-3, 8e-3])
    after, floor, pairs = collide(RUBBER, ball, FLOOR, friction=0.3, radius_limit=1)
    alone = pair(RUBBER, radius=0.01, mass=[4e-3, 8e-3], friction=0.3, speed=speed,
                 angle=[[0], [30], [60]], radius_limit=1)
    assert pairs.shape == alone.shape == (3, 2)
    np.testing.assert_allclose(pairs.ez, alone.ez, rtol=1e-12)  # other roundings of the same scene
    np.testing.assert_allclose(after.velocity[..., 2], speed * np.cos(angle) * pairs.ez, 1e-12)
    sliding = after.velocity[..., 0] - 0.01 * after.spin[..., 1]
    np.testing.assert_allclose(sliding, -pairs.ex * speed * np.sin(angle), atol=1e-12)
    assert (floor.velocity == 0).all() and floor.velocity.shape == (3, 2, 3)


def test_momentum_of_two_spheres_is_conserved():
    rng = np.random.default_rng(4)
    n, radius = 50, 0.01
    axis = rng.normal(size=(n, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    mass = rng.uniform(1e-3, 1e-2, (2, n, 1))
    velocity = 0.05 * rng.normal(size=(2, n, 3)) + 0.3 * np.array([axis, -axis])  # approaching
    one = Body(0 * axis, velocity[0], rng.normal(size=(n, 3)), radius, mass[0, :, 0])
    other = Body(2 * radius * axis, velocity[1], rng.normal(size=(n, 3)), radius, mass[1, :, 0])
    first, second, pairs = collide(RUBBER, one, other, partner="same", friction=0.5, radius_limit=1,
                                   displacement_limit=9)
    before = mass[0] * one.velocity + mass[1] * other.velocity
    after = mass[0] * first.velocity + mass[1] * second.velocity
    np.testing.assert_allclose(after, before, atol=1e-15)  # of 1e-3: rounding
    approach = np.sum((one.velocity - other.velocity) * axis, axis=1)
    leaving = np.sum((second.velocity - first.velocity) * axis, axis=1)
    np.testing.assert_allclose(leaving, pairs.ez * approach, rtol=1e-9)
    inertia = 0.4 * mass * radius**2
    spins = inertia[0] * first.spin + inertia[1] * second.spin
    spins += np.cross(other.position, mass[1] * second.velocity)
    old = inertia[0] * one.spin + inertia[1] * other.spin
    old += np.cross(other.position, mass[1] * other.velocity)
    np.testing.assert_allclose(spins, old, atol=1e-16)  # of 1e-5: rounding


def test_bodies_that_do_not_touch_are_refused_or_nan():
    ball = Body([(0, 0, 0.01), (0, 0, 0.02)], (0, 0, -0.1), radius=0.01, mass=4e-3)
    with pytest.raises(DomainError, match=r"impacts\[1\]: ") as caught:
        collide(RUBBER, ball, FLOOR, friction=0, radius_limit=1)
    assert caught.value.index == (1,)
    after, _, pairs = collide(RUBBER, ball, FLOOR, friction=0, radius_limit=1, on_error="nan")
    assert np.isnan(after.velocity[1]).all() and np.isnan(pairs.ez).tolist() == [False, True]
    assert pairs.message(1) in str(caught.value)
    with pytest.raises(TypeError, match="'psi' is no keyword of collide"):
        collide(RUBBER, ball, FLOOR, psi=1)


def test_vectors_of_other_lengths_and_unknown_keywords_are_refused_by_name():
    ball = Body((0, 0, 0.01), (0, 0, -1), radius=0.01, mass=1)
    with pytest.raises(DomainError, match=r"^first.velocity: has the shape \(2,\), must end in 3"):
        collide(RUBBER, ball._replace(velocity=(0, 1)), FLOOR, friction=0)
    with pytest.raises(DomainError, match="^second.radius = 'wide': must be a number"):
        collide(RUBBER, ball, FLOOR._replace(radius="wide"), friction=0)
    with pytest.raises(TypeError, match="^friction is missing: must be >= 0"):
        collide(RUBBER, ball, FLOOR)
    with pytest.raises(TypeError, match="'mu' is no keyword of collide; did you mean friction"):
        collide(RUBBER, ball, FLOOR, mu=0.3)
