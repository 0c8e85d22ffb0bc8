# SPDX-License-Identifier: GPL-2.0-or-later
"""A settled bed stays so: its energy, of motion and height, does not grow. For 100000 steps, or
as many as the first argument says."""
import random
import sys

from scenes import Scene, check, material

SOLID = material("soft", model="standard_solid", modulus1_pa=2e7, modulus2_pa=1e8, viscosity_pa_s=5e3)
WORDS = SOLID + " friction 0.5"
STEPS = int(sys.argv[1]) if len(sys.argv) > 1 else 100000
GRAVITY = 9.81

scene = Scene(half_width=0.1)
draw = random.Random(7)
for n in range(24):
    level, place = divmod(n, 4)
    x, y = 0.0055 * (2 * (place % 2) - 1), 0.0055 * (2 * (place // 2) - 1)
    scene.add((x + draw.gauss(0, 3e-4), y + draw.gauss(0, 3e-4), 0.0055 + 0.0105 * level), (0, 0, 0),
              radius=draw.uniform(0.0035, 0.005), density=1100)
scene.run(f"""
    pair_style restitute
    pair_coeff * * {WORDS}
    fix floor all wall/restitute {WORDS} zplane 0 NULL
    fix side all wall/restitute {WORDS} zcylinder 0.0125
    fix down all gravity {GRAVITY} vector 0 0 -1
    fix move all nve/sphere
    neighbor 0.0005 bin
    neigh_modify delay 0 page 20000 one 400
    timestep 3e-6
    """)


def energies():
    """Of motion, and of motion and height, J."""
    x, v, omega, radius, mass = (scene.all(name) for name in ("x", "v", "omega", "radius", "rmass"))
    def square(a):
        return sum(c * c for c in a)
    motion = sum(0.5 * mass[t] * (square(v[t]) + 0.4 * radius[t] ** 2 * square(omega[t])) for t in x)
    return motion, motion + sum(GRAVITY * mass[t] * x[t][2] for t in x)


def course(steps, looks):
    found = []
    for _ in range(looks):
        scene.run(f"run {steps // looks}")
        found.append(energies())
    return found


start = energies()[1]
for n in range(10):
    motion, settled = course(20000, 1)[0]
    print(f"settling, step {(n + 1) * 20000}: energy of motion {motion:.2e} J of {start:.2e} J")
rest = course(STEPS, 100)
scene.close()
tops = [max(whole for _, whole in rest[k:k + 25]) - settled for k in (0, 25, 50, 75)]
print(f"{STEPS} steps at rest: motion and height change by at most", " ".join(f"{top:.1e}" for top in tops),
      f"J in each quarter; energy of motion at the end {rest[-1][0]:.1e} J")
check(settled < 0.95 * start, f"the bed did not fall: {settled:.2e} of {start:.2e} J")
check(max(motion for motion, _ in rest) < 1e-2 * start, "the bed has not settled")
# Contacts store some 1e-6 of the energy of the fall and give it back when a sphere rolls into a
# better place.
check(max(tops) <= 2e-6 * start, "the energy of the bed grows")
