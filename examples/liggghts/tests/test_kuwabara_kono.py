# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS's own Kuwabara-Kono force (hertz/stiffness with limitForce) beside model restitute
for a Kelvin-Voigt solid.

Both have the same force while two spheres approach. Later the law keeps account of the surface,
which comes back more slowly than the spheres leave: its contact is smaller than that of the
overlap, and the dashpot holds back less."""
import math

from scenes import STYLE, box, check, dump, law, library_pairs, liggghts, material, motions, sphere

RADIUS, DENSITY, SPEED, G, NU = 0.005, 1000, 0.05, 1e7, 0.3
# By delta1 (docs/theory.md): ez of the force of Kuwabara and Kono and of a Kelvin-Voigt solid, both
# computed elsewhere
EXPECTED = {0.03: (0.9214, 0.9224), 0.1: (0.7683, 0.7752), 0.3: (0.4914, 0.5134), 1.0: (0.1739, 0.2008)}

mass = DENSITY * 4 / 3 * math.pi * RADIUS ** 3 / 2  # effective
radius = RADIUS / 2
stiffness = G / (1 - NU)  # E* of two like bodies


def impact(lines, time, steps):
    liggghts(box() + sphere(1, (0, 0, 0), (SPEED, 0, 0), radius=RADIUS, density=DENSITY) +
             sphere(2, (2 * RADIUS, 0, 0), (0, 0, 0), radius=RADIUS, density=DENSITY) + lines +
             f"fix move all nve/sphere\ntimestep {time / steps!r}\n{dump('end', 2 * steps)}run {2 * steps}")
    end = motions("end")[-1]
    return (end[2]["vx"] - end[1]["vx"]) / SPEED


def kuwabara_kono(eta):
    """F = sqrt(R d) (4/3 E* d + 2 E* (eta/G) v), never below 0."""
    kn, gamma = 4 / 3 * stiffness, 2 * stiffness * eta / G / mass
    numbers = {"kn": kn, "kt": 0, "gamman": gamma, "gammat": 0}
    return "".join(f"fix {name} all property/global {name} peratomtypepair 2 {' '.join([repr(value)] * 4)}\n"
                   for name, value in numbers.items()) + \
        "pair_style gran model hertz/stiffness limitForce on tangential_damping off\npair_coeff * *\n"


def viscosity(delta1):
    a_el = (15 * mass * SPEED ** 2 * radius ** 2 * (1 - NU) / (16 * G)) ** 0.2  # (24) with G/2
    return 2 * delta1 / math.sqrt(a_el / (G / 2 * mass * (1 - NU)))


solids = {delta1: material(f"voigt{delta1}", model="kelvin_voigt", modulus1_pa=G, viscosity_pa_s=viscosity(delta1),
                           poisson_ratio=NU) for delta1 in EXPECTED}
answers = library_pairs([dict(material=solid, partner="same", radius1_m=RADIUS, radius2_m=RADIUS, angle_deg=0,
                              density1_kg_m3=DENSITY, density2_kg_m3=DENSITY, speed_m_s=SPEED, friction=0.3)
                         for solid in solids.values()])
print("delta1   hertz/stiffness   model restitute   library")
for (delta1, (host, ours)), answer in zip(EXPECTED.items(), answers):
    time = answer["contact_time"]
    ez = impact(kuwabara_kono(viscosity(delta1)), time, 4000)
    own = impact(law(f"{solids[delta1]} friction 0.3") + STYLE, time, 200)
    print(f"{delta1:<8} {ez:.4f} {own:17.4f} {answer['ez']:17.4f}")
    check(abs(ez - host) <= 3e-4, f"hertz/stiffness at delta1 = {delta1}: {ez:.4f} is not {host}")  # first order in dt
    check(abs(answer["ez"] - ours) <= 1e-4, f"the library at delta1 = {delta1}: {answer['ez']:.4f} is not {ours}")
    check(abs(own - ours) <= 0.01, f"model restitute at delta1 = {delta1}: {own:.4f} is not {ours}")
