# SPDX-License-Identifier: GPL-2.0-or-later
"""Twenty impacts of two spheres and of a sphere and a wall: LAMMPS gives the library's (ez, ex)
and converges to it."""
import math
import os
from statistics import mean

from scenes import MATERIALS, Scene, check, library_pairs, material

glass = material("glass", model="elastic", modulus_pa=3e10, poisson_ratio=0.2)
rubber = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
gel = material("gel", model="kelvin_voigt", modulus1_pa=2e9, viscosity_pa_s=5000)
putty = material("putty", model="maxwell", modulus_pa=2e9, viscosity_pa_s=5e5, poisson_ratio=0.4)
polymer = MATERIALS + "/polyisobutylene.json"
WORDS = {polymer: "terms 8 window 1e-5 1e-2"}

# material, speed (m/s), angle (degrees), partner of the same material or a rigid one, a wall?
CASES = [
    (glass, 0.05, 0, "same", False), (glass, 0.2, 20, "same", False), (glass, 0.1, 40, "rigid", False),
    (glass, 0.3, 60, "rigid", True), (glass, 0.5, 80, "same", True),
    (rubber, 0.01, 10, "same", False), (rubber, 0.03, 35, "same", False), (rubber, 0.1, 50, "rigid", False),
    (rubber, 0.05, 25, "rigid", True), (rubber, 0.02, 70, "same", True),
    (gel, 0.01, 15, "same", False), (gel, 0.05, 30, "same", False), (gel, 0.1, 45, "rigid", True),
    (gel, 0.03, 5, "rigid", False), (putty, 0.02, 20, "same", False), (putty, 0.08, 55, "rigid", True),
    (polymer, 0.002, 30, "rigid", False), (polymer, 0.01, 45, "same", False), (polymer, 0.005, 10, "rigid", True),
    (polymer, 0.02, 65, "same", True),
]
RADIUS, DENSITY, FRICTION = 0.005, 2000, 0.3


def library_case(solid, speed, angle, partner, is_wall):
    case = dict(material=solid, partner=partner, radius1_m=RADIUS, density1_kg_m3=DENSITY, speed_m_s=speed,
                angle_deg=angle, friction=FRICTION, radius2_m="inf", density2_kg_m3="")
    return case if is_wall else case | dict(radius2_m=2 * RADIUS, density2_kg_m3=DENSITY / 2)


def impact(case, time, steps, elements, phase):
    """(ez, ex) with so many steps in the contact time; the gap closes within `phase` of a step."""
    solid, speed, angle, partner, is_wall = case
    dt = time / steps
    normal, along = speed * math.cos(math.radians(angle)), speed * math.sin(math.radians(angle))
    words = f"{solid} friction {FRICTION} elements {elements} {WORDS.get(solid, '')}"
    words += " partner rigid" if partner == "rigid" else ""
    scene = Scene()
    gap = phase * dt * normal
    first = scene.add((0, 0, 0), (normal, along, 0), radius=RADIUS, density=DENSITY)
    second = None if is_wall else scene.add((3 * RADIUS + gap, 0, 0), (0, 0, 0), radius=2 * RADIUS, density=DENSITY / 2)
    scene.run(f"""
        pair_style restitute
        pair_coeff 1 1 {words}
        {f"fix wall all wall/restitute {words} xplane NULL {RADIUS + gap!r}" if is_wall else ""}
        timestep {dt!r}
        fix move all nve/sphere
        compute met all pair restitute
        variable met equal {"f_wall[5]" if is_wall else "c_met[2]"}
        thermo_style custom step v_met
        run {int(1.5 * steps)}
        """)
    velocities, spins = scene.all("v"), scene.all("omega")
    v, spin = velocities[first], spins[first][2] * RADIUS
    if second:
        v = tuple(a - b for a, b in zip(v, velocities[second]))
        spin += spins[second][2] * 2 * RADIUS
    contacts = scene.lammps.extract_variable("met")
    scene.close()
    check(contacts == 1, f"{case}: the law met {contacts} contacts, not 1")
    return -v[0] / normal, -(v[1] + spin) / along if angle else 0


def compare(answers, steps, elements):
    """Largest error of all impacts, and mean of those whose law has all terms of the material."""
    errors = []
    for n, (case, answer) in enumerate(zip(CASES, answers)):
        ez, ex = impact(case, answer["contact_time"], steps, elements, (0.1 + 0.37 * n) % 1)
        errors.append(max(abs(ez - answer["ez"]), abs(ex - answer["ex"]) if case[2] else 0))
        print(f"{os.path.basename(case[0]):21} {case[1]:5} m/s {case[2]:2} deg {case[3]:5} "
              f"{'wall' if case[4] else 'pair'}  ez {ez:.4f} {answer['ez']:.4f}  ex {ex:.4f} {answer['ex']:.4f}  "
              f"error {errors[-1]:.4f}")
    whole = mean(error for error, case in zip(errors, CASES) if case[0] not in WORDS)
    print(f"{steps} steps in a contact, {elements} elements: largest error {max(errors):.4f}, mean {whole:.5f}")
    return max(errors), whole


pairs = library_pairs([library_case(*case) for case in CASES])
(largest, coarse), (_, finer), (_, fine) = (compare(pairs, *n) for n in ((50, 8), (200, 16), (800, 32)))
check(largest <= 0.01, "LAMMPS is off by more than the law's 0.01")
# First order would be a quarter each time; what the half-space leaves out remains, overlaps up to
# 5e-4 of the radius.
check(finer <= 0.4 * coarse and fine <= 0.7 * finer and fine <= 5e-4, "LAMMPS does not converge to the library")
