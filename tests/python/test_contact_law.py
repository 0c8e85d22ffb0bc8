# SPDX-License-Identifier: BSD-3-Clause
"""The contact law: arrays of contacts."""

import numpy as np
import pytest

import restitute
from restitute import ContactLaw, DomainError

pytestmark = pytest.mark.component("contact")
MASS, RADIUS, FRICTION = 5e-6, 1e-3, 0.3


@pytest.fixture(scope="module")
def rubber():
    return restitute.Material.standard_solid(1e6, 3e6, 300.0)


def impacts(law, normal_speed, tangential_speed):
    """Spheres that bounce on a wall (velocity Verlet): minus velocity after over before, of the
    contact point. Spheres that have left rest in the array, as in a program of DEM."""
    n, step = len(normal_speed), float(np.min(law.time_step_limit(MASS, RADIUS, normal_speed)))
    velocity = np.stack([tangential_speed, 0 * normal_speed, -normal_speed], 1)
    spin = np.zeros(n)  # about y: the contact point moves with v_x - R w_y
    overlap, force, states = np.zeros(n), np.zeros((n, 3)), law.states(n)
    inertia, active = 0.4 * MASS * RADIUS**2, np.arange(n)
    while active.size:
        for half in (0, 1):
            velocity[active] += step / 2 * force[active] / MASS
            spin[active] -= step / 2 * RADIUS * force[active, 0] / inertia
            if half:
                break
            overlap[active] -= step * velocity[active, 2]
            surface = velocity[active]
            surface[:, 0] -= RADIUS * spin[active]
            forces = law.step(states, step, rows=active, overlap=overlap[active], velocity=surface,
                              normal=[0, 0, -1], radius=RADIUS, friction=FRICTION,
                              inverse_mass=1 / MASS, inverse_tangential_mass=3.5 / MASS)
            force[active] = forces.tangential
            force[active, 2] += forces.normal
        active = active[overlap[active] > 0]
    return velocity[:, 2] / normal_speed, -(velocity[:, 0] - RADIUS * spin) / tangential_speed


def test_spheres_that_bounce_have_the_pair_of_an_impact(rubber):
    normal, angle = np.array([0.01, 0.03, 0.1]), np.radians([20, 45, 60])
    ez, ex = impacts(restitute.ContactLaw(rubber), normal, normal * np.tan(angle))
    pair = restitute.pair(rubber, radius=RADIUS, mass=MASS, friction=FRICTION, method="sync",
                          tolerance=1e-5, normal_speed=normal, radius_limit=1,
                          displacement_limit=9, tangential_speed=normal * np.tan(angle))
    # contact.h states 0.01 for 99 % of impacts with the default elements and this step
    assert np.abs(ez - pair.ez).max() < 0.01
    assert np.abs(ex - pair.ex).max() < 0.01


def test_a_batch_of_some_rows_is_those_contacts_stepped_one_by_one(rubber):
    law, rows = restitute.ContactLaw(rubber, details=True), [3, 0]
    motion = dict(velocity=[0.01, 0, 0.1], radius=RADIUS, friction=0.3, inverse_mass=1 / MASS)
    many, single = law.states(4), law.states(4)
    overlap = np.array([2e-6, 1e-6])
    for k in (1, 2):
        forces = law.step(many, 1e-6, rows=rows, overlap=k * overlap, **motion)
        for place, row in enumerate(rows):
            one = law.step(single[row:row + 1], 1e-6, overlap=k * overlap[place], **motion)
            assert one.normal[0] == forces.normal[place] > 0
            assert np.array_equal(one.tangential[0], forces.tangential[place])
    assert np.array_equal(many, single)
    assert not many[1].any() and not many[2].any()
    details = law.details(many, RADIUS)
    assert np.all(details["contact_radius"][rows] > 0) and details["contact_radius"][1] == 0


def test_motions_of_the_caller_are_used_in_place(rubber):
    law = restitute.ContactLaw(rubber)
    motions = law.motions(2)
    motions["overlap"], motions["radius"] = [1e-6, 2e-6], RADIUS
    motions["velocity"], motions["friction"] = [0, 0, 1], FRICTION
    given = law.step(law.states(2), 1e-6, motions)
    states = law.states(2)
    named = law.step(states, 1e-6, overlap=[1e-6, 2e-6], radius=RADIUS, velocity=[0, 0, 1],
                     friction=FRICTION)
    assert np.array_equal(given.normal, named.normal) and named.normal[1] > named.normal[0] > 0


def test_a_contact_that_fails_is_named_and_the_others_advance(rubber):
    law = restitute.ContactLaw(rubber)
    states = law.states(3)
    with pytest.raises(restitute.DomainError, match=r"motions\[1\].*friction = -1: must be") as at:
        law.step(states, 1e-6, overlap=1e-6, radius=RADIUS, velocity=[0, 0, 1],
                 friction=[0.3, -1, 0.3])
    assert at.value.index == 1
    assert np.all((at.value.statuses < 0) == [False, True, False])
    assert states[0].any() and not states[1].any() and states[2].any()
    assert at.value.forces.normal[2] > 0


@pytest.mark.parametrize(
    "states, rows, words",
    [(lambda law: law.states(2)[:, :-1], None, "states: must be a contiguous"),
     (lambda law: law.states(2).astype(np.float32), None, "states: must be"),
     (lambda law: law.states(2), [0, 2], r"rows = 0 to 2: must be in \[0, 1\]"),
     (lambda law: law.states(2), [-1], "rows = -1"),
     (lambda law: law.states(2), [1, 1], "given twice")])
def test_states_that_are_none_never_reach_the_library(rubber, states, rows, words):
    law = restitute.ContactLaw(rubber)
    with pytest.raises(restitute.DomainError, match=words):
        law.step(states(law), 1e-6, rows=rows, overlap=0, radius=RADIUS)


def test_times_broadcast_and_fall_with_the_fifth_root_of_the_speed():
    law = restitute.ContactLaw(restitute.Material.elastic(1e6))
    scale = law.time_scale(MASS, RADIUS, [0.1, 3.2])
    # the overlap is iterated: 24 halvings of an error of its logarithm below 20
    assert scale.shape == (2,) and scale[0] / scale[1] == pytest.approx(2, rel=20 / 2**24)
    assert law.time_step_limit([[MASS], [2 * MASS]], RADIUS, [0.1, 1, 2]).shape == (2, 3)


def test_options_are_checked_by_name(rubber):
    with pytest.raises(restitute.DomainError, match="elements = 9"):
        restitute.ContactLaw(rubber, elements=9)
    with pytest.raises(TypeError, match="'element' is no keyword here; did you mean elements"):
        restitute.ContactLaw(rubber, element=8)
    with pytest.raises(restitute.DomainError, match="partner = 'wall'"):
        restitute.ContactLaw(rubber, partner="wall")
    pib = restitute.material("polyisobutylene")
    with pytest.raises(restitute.DomainError, match="shortest"):
        restitute.ContactLaw(pib)
    with pytest.warns(restitute.ToleranceWarning, match="misses G.t. of the 30 terms"):
        assert restitute.ContactLaw(pib, shortest=1e-6, longest=1e-2).state_size > 48


def test_members_of_a_motion_are_checked_by_name(rubber):
    law = restitute.ContactLaw(rubber)
    with pytest.raises(TypeError, match="'frict' is no keyword of step; did you mean friction"):
        law.step(law.states(1), 1e-6, overlap=1e-6, radius=RADIUS, frict=0.3)
    for motions in ([1], np.full(1, 104, np.uint64)):  # 104: the size of a motion
        with pytest.raises(restitute.DomainError, match="^motions: must be an array that"):
            law.step(law.states(1), 1e-6, motions)
    with pytest.raises(restitute.DomainError, match=r"motions: have the shape \(3,\), must be 1"):
        law.step(law.states(1), 1e-6, law.motions(3))
    with pytest.raises(TypeError, match="^friction is missing: must be in .* the law frictionless"):
        law.step(law.states(1), 1e-6, overlap=1e-6, radius=RADIUS)


def test_both_bodies_deform_at_half_the_stiffness(rubber):
    motion = dict(overlap=1e-6, radius=RADIUS, velocity=[0, 0, 1], friction=FRICTION)
    soft, hard = (law.step(law.states(1), 1e-6, **motion).normal[0] for law in
                  (restitute.ContactLaw(rubber, partner=p) for p in ("same", "rigid")))
    assert soft == pytest.approx(hard / 2, rel=1e-12)


def test_a_law_takes_a_material_by_name_and_refuses_what_is_none():
    assert ContactLaw("steel").state_size == ContactLaw(restitute.material("steel")).state_size
    with pytest.raises(DomainError, match="^material = 5: must be a Material, its name or a file"):
        ContactLaw(5)
    law = ContactLaw("steel")
    with pytest.raises(DomainError, match=r"^friction = .*: is a masked|^friction: is a masked"):
        law.step(law.states(1), 1e-6, friction=np.ma.masked_array([0.3], [True]))
    with pytest.raises(DomainError, match=r"^overlap: has the shape \(2,\), must broadcast to"):
        law.step(law.states(3), 1e-6, overlap=[1, 2])
    with pytest.raises(DomainError, match=r"^step \(s\) = 0: must be in"):
        law.step(law.states(1), 0, friction=FRICTION)
    with pytest.raises(DomainError, match="shapes do not broadcast: mass"):
        law.time_scale([1, 2], 1, [1, 2, 3])
