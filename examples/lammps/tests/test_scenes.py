# SPDX-License-Identifier: GPL-2.0-or-later
"""The same impact in other words: units, Newton's third law, moving walls, wide cylinders; and a sphere held fast."""
import math

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
    """Two spheres; lengths in units of so many to the metre, in a frame of reference that may be turned."""
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
