# SPDX-License-Identifier: GPL-2.0-or-later
"""The drum, short: on one rank and on two the same contacts; its balls do not leave it; LIGGGHTS's own law runs, too."""
import os
import re
import subprocess

from scenes import check, liggghts

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
