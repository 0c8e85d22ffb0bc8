# SPDX-License-Identifier: GPL-2.0-or-later
"""The memory of contacts: a new run, a restart in their middle and two ranks change no motion, nor
does it matter whether pairs are computed in batches; the same spheres may meet again, and the call
counter says that our law ran."""
import random
import re

from scenes import MOTION as MOTION_OF_SPHERES
from scenes import STYLE, WALL, box, check, dump, law, liggghts, material, mesh, motions, sphere

RUBBER = material("rubber", model="standard_solid", modulus1_pa=1e8, modulus2_pa=2e8, viscosity_pa_s=3e3)
A, B, C, D = (-0.1, -0.1, 0), (0.1, -0.1, 0), (0.1, 0.1, 0), (-0.1, 0.1, 0)
SQUARE = mesh("square", [(A, B, C), (A, C, D)])
LAW = law(f"{RUBBER} friction 0.3") + law(f"{RUBBER} friction 0.4 partner rigid", "_1_2")
MOTION = f"""
    fix floor all mesh/surface file {SQUARE} type 2
    fix bottom all {WALL} mesh n_meshes 1 meshes floor
    fix side all {WALL} primitive type 2 xplane -0.015
    fix down all gravity 50 vector 0 0 -1
    timestep 1.5e-6
    fix move all nve/sphere
    variable calls equal f_restitute[1]
    variable meetings equal f_restitute[2]
    """
STEPS = 500


def crowd():
    """A cube of 27 spheres that fly into each other, the floor and the wall."""
    draw = random.Random(5)
    lines = ""
    for n in range(27):
        place = [0.0099 * (n // 9 - 1), 0.0099 * (n // 3 % 3 - 1), 0.0052 + 0.0099 * (n % 3)]
        lines += sphere(n + 1, [x + draw.gauss(0, 3e-5) for x in place], [draw.gauss(0, 0.2) for _ in range(3)],
                        [draw.gauss(0, 20) for _ in range(3)], 0.00495)
    return lines


def finish(name, lines, ranks=1):
    text = liggghts(lines, ranks)
    check(f"  {ranks} by 1 by 1 MPI processor grid" in text, f"not {ranks} ranks along x")
    counts = re.findall(r"restitute: (\d+) contacts, (\d+) steps", text)
    return motions(name)[-1], [tuple(map(int, found)) for found in counts]


def compare(what, found, wanted, tolerance):
    """Relative to the largest of each kind."""
    error = max(abs(found[tag][name] - wanted[tag][name]) / max(abs(its[name]) for its in wanted.values())
                for tag in wanted for name in wanted[tag])
    print(f"{what}: {error:.1e}")
    check(len(found) == len(wanted) and error <= tolerance, f"{what}: another motion, by {error:.1e}")


START = box(half_width=0.1) + LAW + crowd() + STYLE + MOTION
whole, ((contacts, calls),) = finish("whole", START + dump("whole", STEPS) + f"run {STEPS}")
print(f"{contacts} contacts, {calls} steps of contacts")
check(contacts > 40 and calls > 10 * contacts, "too few contacts for a test")

runs, counts = finish("runs", START + f"run {STEPS // 2}\n" + dump("runs", STEPS) + f"run {STEPS // 2}\n")
compare("two runs", runs, whole, 0)
check([sum(c) for c in zip(*counts)] == [contacts, calls], f"{counts} are not {contacts}, {calls}")

# In LIGGGHTS the script names laws, pair style, walls and meshes again after a restart.
half, _ = finish("half", START + dump("half", STEPS // 2) + f"run {STEPS // 2}\nwrite_restart middle.restart")
check(sum(s["fx"] != 0 for s in half.values()) > 5, "few spheres touch when the restart is written")
before, neighbors = box().split("region")[0], box().split("create_box 2 box")[1]
again = before + LAW + "read_restart middle.restart" + neighbors + STYLE + MOTION + dump("restarted", STEPS) + \
    f"run {STEPS // 2}\n"
restarted, _ = finish("restarted", again)
compare("a restart in mid-contact", restarted, whole, 0)

split = START.replace("boundary", "processors 2 1 1\nboundary")
two, ((contacts_of_two, calls_of_two),) = finish("two", split + dump("two", STEPS) + f"run {STEPS}", ranks=2)
# Sums of forces round in another order, and impacts multiply differences.
compare("two ranks", two, whole, 1e-8)
check((contacts_of_two, calls_of_two) == (contacts, calls), f"two ranks count {contacts_of_two}, {calls_of_two}")

EARLY = 50


def early(name, more=""):
    """Early, when many touch: what spheres do, forces and torques of pairs by tags, virial."""
    text = liggghts(START + more + f"""
        compute pairs all pair/gran/local id force torque
        compute virial all pressure thermo_temp virial
        thermo_style custom step c_virial[1] c_virial[2] c_virial[3] c_virial[4] c_virial[5] c_virial[6]
        thermo_modify format float %.17g
        dump pairs all local {EARLY} pairs.txt {" ".join(f"c_pairs[{k}]" for k in range(1, 10))}
        dump_modify pairs format "%g %g %g{" %.17g" * 6}"
        """ + dump(name, EARLY, MOTION_OF_SPHERES + " f_sums" * bool(more)) + f"run {EARLY}")
    virial = re.findall(rf"^ +{EARLY} (.*)$", text, re.MULTILINE)[0].split()
    with open("pairs.txt") as file:
        rows = [line.split() for line in file.read().split("ITEM: ENTRIES")[-1].splitlines()[1:]]
    pairs = {tuple(row[:2]): dict(enumerate(map(float, row[3:]))) for row in rows}
    return motions(name, MOTION_OF_SPHERES + " f_sums" * bool(more))[-1], pairs, {0: dict(enumerate(map(float, virial)))}


# What stores sums of normal forces needs the force of each contact at once.
batches = early("batches")
singles = early("singles", "fix sums all property/atom sum_normal_force_ scalar yes no no 0.0\n")
sums = [its.pop("f_sums") for its in singles[0].values()]
forces = sum(any(force.values()) for force in batches[1].values())
print(f"{forces} pairs with a force; sums of normal forces up to {max(sums):.0f} N")
check(forces > 10 and max(sums) > 100, "the forces of pairs are missing")
for what, one, other in zip(("motions", "forces of pairs", "virial"), batches, singles):
    compare(f"batches, {what}", one, other, 1e-12)  # the parts of a force add up in another order
