# SPDX-License-Identifier: GPL-2.0-or-later
"""The memory of contacts: a restart in their middle, a swap of atoms, new neighbor lists, a new
run change no bit."""
from scenes import Scene, check, material

RUBBER = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
WORDS = RUBBER + " friction 0.3 rolling sds 2e4 0.1 0.05 twisting marshall details yes"
LAW = f"""
    pair_style restitute
    pair_coeff * * {WORDS}
    """
MOTION = f"""
    fix floor all wall/restitute {WORDS} zplane -0.1 NULL
    timestep 1e-6
    fix move all nve/sphere
    neigh_modify every 1 delay 0 check no
    """


def impacts(dummy_first=False, switches=()):
    """A sphere hits the floor, and two collide obliquely, with spins; all touch after 100 steps."""
    scene = Scene(switches=switches)
    if dummy_first:
        scene.add((0.3, 0.3, 0.3), (0, 0, 0))
    scene.add((0.05, 0, -0.09500001), (0.02, -0.01, -0.03), (5, 0, -1))
    scene.add((0, 0, 0), (0.03, 0.02, 0.01), (1, -2, 3), radius=0.005)
    scene.add((0.0119, 0.0015460, 0), (0, 0, 0.005), (0, 4, 0), radius=0.007)
    scene.run(LAW + MOTION)
    return scene


def finish(scene, steps):
    scene.run(f"run {steps}")
    bits = scene.bits()
    scene.close()
    return bits


def same(name, found, wanted):
    for tag in wanted:
        check(found[tag] == wanted[tag], f"{name}: atom {tag}: {found[tag]} is not {wanted[tag]}")
    print(f"{name}: the same bits")


half = finish(impacts(), 100)
check(all(sum(abs(f) for f in half[tag]["f"]) > 0 for tag in half), "not all atoms touch after 100 steps")
whole = finish(impacts(), 300)
check(all(sum(abs(f) for f in whole[tag]["f"]) == 0 for tag in whole), "not all atoms are apart after 300 steps")

scene = impacts()
scene.run("run 100")
same("two runs", finish(scene, 200), whole)

scene = impacts()
scene.run("run 100")
scene.run("write_restart middle.restart")
scene.run(f"clear\nread_restart middle.restart\n{MOTION}")
same("a restart that reads the law from its file", finish(scene, 200), whole)

scene = Scene()
scene.run(f"clear\nread_restart middle.restart\n{LAW}{MOTION}")
same("a restart with the law given again", finish(scene, 200), whole)

# Without the first atom LAMMPS moves the last one into its place: the two that touch are now in the
# other order. Its own store of histories for threads would change their signs.
for switches in (), ("-sf", "omp"):
    scene = impacts(True, switches)
    scene.run("run 100\ngroup dummy id 1\ndelete_atoms group dummy compress no")
    order = scene.lammps.extract_atom("id")
    check([order[i] for i in range(3)] == [4, 2, 3], "LAMMPS did not reorder the atoms")
    scene.run("run 200")
    bits = scene.bits()
    scene.close()
    same(" ".join(("atoms reordered",) + switches), {tag - 1: bits[tag] for tag in bits}, whole)
