# SPDX-License-Identifier: GPL-2.0-or-later
"""The drum, short: on one rank and on two the same contacts; LIGGGHTS's own law and rolling
friction run, too."""
import os
import re
import subprocess

from scenes import STYLE, WALL, box, check, dump, law, liggghts, motions, sphere

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")

with open(f"{SCRIPTS}/in.drum") as script:
    DRUM = script.read()
with open("drum.stl", "w") as out:
    subprocess.run(["awk", "-v", "radius=0.08", "-v", "depth=0.04", "-v", "facets=48", "-f", f"{SCRIPTS}/drum.awk"],
                   stdout=out, check=True)


def drum(ranks=1, **variables):
    """What the drum prints of its second run, and its last line of numbers."""
    variables = {"rubber": f"{SCRIPTS}/rubber.json", "settle": 4000, "turn": 2000, "ranks": ranks} | variables
    text = liggghts("".join(f"variable {name} index {value}\n" for name, value in variables.items()) + DRUM, ranks)
    second = text.split("Setting up run")[2]
    check("WARNING: restitute" not in text, f"a warning: {second}")
    return second, [float(word) for word in second.split("Loop time")[0].split("restitute:")[0].split("\n")[-2].split()]


one, numbers = drum()
two, other = drum(2)
contacts = [re.search(r"(\d+) contacts, (\d+) steps", text).groups() for text in (one, two)]
print(f"{int(numbers[1])} balls; contacts and steps on one rank {contacts[0]}, on two {contacts[1]}")
print(f"energies of motion {numbers[2:]}, on two ranks {other[2:]}")
check(int(contacts[0][0]) > 1000, "too few contacts for a test")
check(contacts[0] == contacts[1], "two ranks meet other contacts")
check(numbers[1] == other[1] == 2947, "balls were lost")
# Sums round in another order; thousands of contacts in between.
check(all(abs(a - b) <= 1e-6 * a for a, b in zip(numbers[2:], other[2:])), "two ranks move otherwise")
own, numbers = drum(model="hertz")
check("restitute:" not in own and numbers[1] == 2947, "LIGGGHTS's own law does not run")

# A ball that rolls on a plane, which it just touches at first.
left = {}
for rolling in ("", " rolling_friction cdt"):
    liggghts(box() + law(f"{SCRIPTS}/rubber.json friction 0.4") + """
        fix roll all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1
        """ + sphere(1, (0, 0, 0.005), (0.1, 0, 0), (0, 20, 0)) + 
             STYLE.replace("\n    pair_coeff", rolling + "\npair_coeff") + f"""
        fix floor all {WALL}{rolling} primitive type 2 zplane 0
        fix down all gravity 9.81 vector 0 0 -1
        fix move all nve/sphere
        timestep 5e-6
        """ + dump("ball", 10000) + "run 10000")
    left[rolling] = motions("ball")[-1][1]["vx"]
# Decelerated by mu_r g 5/7 for 0.05 s; the ball sinks in first.
lost = 0.1 * 9.81 * 5 / 7 * 0.05
print(f"a rolling ball loses {0.1 - left['']:.1e} m/s, with friction {0.1 - left[rolling]:.4f}, wanted {lost:.4f}")
check(abs(0.1 - left[""]) < 1e-3 * lost and abs(0.1 - left[rolling] - lost) < 0.05 * lost, "rolling friction is off")

# Two balls of opposite spins meet head-on: they roll on each other, without slip.
liggghts(box() + law(f"{SCRIPTS}/rubber.json friction 0.4") + """
    fix roll all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1
    """ + sphere(1, (0, 0, 0), (0.1, 0, 0), (0, 0, 20)) + sphere(2, (0.01001, 0, 0), (-0.1, 0, 0), (0, 0, -20)) +
         STYLE.replace("\n    pair_coeff", " rolling_friction cdt\npair_coeff") + """
    timestep 5e-6
    fix move all nve/sphere
    """ + dump("balls", 500) + "run 500")
before, after = ((step[1]["vx"], step[1]["omegaz"]) for step in motions("balls"))
# The torque mu_r F R/2 turns a sphere of 0.4 m R^2 while F changes m v.
wanted = 0.1 * (before[0] - after[0]) / (0.8 * 0.005)
print(f"balls that roll on each other lose {before[1] - after[1]:.6f} rad/s, wanted {wanted:.6f}")
check(after[0] < 0 < after[1] and abs(before[1] - after[1] - wanted) < 1e-9 * wanted, "pairs feel no rolling friction")
