# SPDX-License-Identifier: GPL-2.0-or-later
"""Short runs of the input scripts: their output on one process and on two, and after
a restart. And a dense flow across periodic boundaries, whose contacts survive commands between
runs."""
import math
import os
import re
import subprocess
import sys

from scenes import MATERIALS, PLUGIN, check, library_pairs, material

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
VENV = os.path.dirname(sys.executable)


def lmp(script, processes=1, allowed="none", **variables):
    """What a script of the example prints. Warnings with the words `allowed` are."""
    files = {"plugin": PLUGIN, "bead": f"{SCRIPTS}/bead.json", "glass": f"{MATERIALS}/soda_lime_glass.json",
             "material": f"{MATERIALS}/polyisobutylene.json"}
    command = [f"{VENV}/mpiexec", "-n", str(processes), f"{VENV}/lmp", "-in", os.path.join(SCRIPTS, script),
               "-log", "none", "-nocite"]
    for name, value in (files | variables).items():
        command += ["-var", name, str(value)]
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, f"{script}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    check("WARNING" not in re.sub(f"WARNING: .*{allowed}", "", done.stdout), f"{script}: {done.stdout}")
    return done.stdout


def motions(name):
    """Numbers of a dump, and its text."""
    with open(name) as file:
        text = file.read()
    return [float(word) for word in text.split("\n", 9)[9].split()], text


def counts(text):
    return re.findall(r"restitute: (\d+) contacts, (\d+) steps", text)


answer, = library_pairs([dict(material=f"{MATERIALS}/polyisobutylene.json", partner="same", radius1_m=0.005,
                              radius2_m=0.005, density1_kg_m3=920, density2_kg_m3=920, speed_m_s=0.02, angle_deg=30,
                              friction=0.3)])
text = lmp("in.impact")
ez, ex = (float(re.search(rf"\b{name} = (-?[\d.]+)", text.rsplit("print", 1)[-1]).group(1)) for name in ("ez", "ex"))
print(f"in.impact: ez {ez} {answer['ez']:.4f}, ex {ex} {answer['ex']:.4f}")
check(abs(ez - answer["ez"]) <= 0.01 and abs(ex - answer["ex"]) <= 0.01, "in.impact is off")

text = lmp("in.wall")
check(counts(text)[0][0] == "2", "in.wall: the ball should bounce once and stay")

one = lmp("in.shear", 1, steps=4000, every=1000, dump="one.txt")
two = lmp("in.shear", 2, steps=4000, every=1000, dump="two.txt")
check(counts(one) == counts(two), f"in.shear: {counts(one)} and {counts(two)} contacts and steps")
check(int(counts(one)[0][0]) > 150, f"in.shear: {counts(one)} contacts and steps are too few for a test")
a, b = motions("one.txt")[0], motions("two.txt")[0]
error = max(abs(x - y) for x, y in zip(a, b))
print(f"in.shear: {counts(one)[0]} contacts and steps, on two processes the same, motions differ by {error:.1e}")
numbers = [[float(word) for word in text.split("Loop time")[0].strip().splitlines()[-1].split()[-3:]] for text in (one, two)]
print("in.shear: energies stored, lost to friction and in dashpots:", *numbers)
check(all(1e-12 < a and abs(a / b - 1) <= 1e-6 for a, b in zip(*numbers)), "in.shear loses other energies on two processes")
# Sums of forces round in another order; spins are some 100 1/s, and impacts multiply differences.
check(len(a) == len(b) == 512 * 10 and error <= 1e-9, "in.shear is another motion on two processes")

text = lmp("in.bed", steps=50000, every=10000, dump="whole.txt")
lmp("in.bed", steps=50000, every=10000, half="first")
lmp("in.bed", steps=50000, every=10000, half="second", dump="halves.txt")
(floor, _), (side, _), (beads, _) = counts(text)
print(f"in.bed: {beads} contacts of beads, {floor} with the floor, {side} with the cylinder")
check(int(floor) > 10 and int(beads) > 10, "in.bed: the beads do not meet all that is there")
check(motions("whole.txt")[1] == motions("halves.txt")[1], "in.bed: a restart changes the motion")

# in.hopper names the columns of its series. README.md says when a contact at the rim begins anew.
BEADS, SIZE, OUTLET, TAN, COS = 100, 0.03, 0.55 * 0.03, math.tan(math.pi / 6), math.cos(math.pi / 6)
lmp("in.hopper", allowed="lost or found late", n=BEADS, outlet=0.55, fill=3.8, discharge=1.5, every=500,
    frames="frames.txt")
with open("hopper.txt") as file:
    rows = [[float(word) for word in line.split()] for line in list(file)[1:]]
opened, rows = 3.8 * math.sqrt(SIZE / 9.81), [row for row in rows if row[1] == BEADS]
mass, energies = rows[0][2], [row[4] + row[5] for row in rows]
rise = max(after - before for before, after in zip(energies, energies[1:]))
print(f"in.hopper: discharged {rows[-1][3] / mass:.2f}, energy falls by {energies[0] - energies[-1]:.2e} J and never "
      f"rises by more than {rise:.1e} J")
check(rows[0][0] < opened and all(abs(row[2] / mass - 1) < 1e-12 for row in rows), "in.hopper: mass is lost")
check(all(row[3] == 0 for row in rows if row[0] < opened), "in.hopper: beads pass the closed outlet")
check(rows[-1][3] > 0.3 * mass, "in.hopper: beads do not flow")
# Contacts store some energy for a moment: less than a bead has that fell by its diameter.
check(rise <= mass / BEADS * 9.81 * SIZE / BEADS ** (1 / 3), "in.hopper: energy grows")
with open("frames.txt") as file:
    frames = [part.splitlines() for part in file.read().split("ITEM: ATOMS id x y z radius f_height\n")[1:]]
for line in (line for frame in frames for line in frame[:BEADS]):
    x, y, z, radius = map(float, line.split()[1:5])
    least, r = 0.99 * radius, math.hypot(x, y)  # an overlap of 1 % has a/R = 0.1
    check(0.9 * SIZE - r >= least and z + 0.6 * SIZE >= least, f"in.hopper: a bead is in a wall: {line}")
    check(z < radius / 2 or (OUTLET + z * TAN - r) * COS >= least, f"in.hopper: a bead is in the hopper's wall: {line}")
check(len(frames) == 4 and len(frames[-1]) == BEADS, "in.hopper: frames are missing")


CROWD = """
    units si
    atom_style sphere
    comm_modify vel yes
    newton ${newton}
    boundary p p f
    plugin load ${plugin}
    """
NEW = """
    lattice sc 0.0051
    region box block 0 6 0 6 -0.1 12
    create_box 1 box
    region fill block 0 5.9 0 5.9 0.6 6
    create_atoms 1 region fill
    set group all diameter 0.005 density 1050
    velocity all create 4e16 4711 dist gaussian
    pair_style restitute
    pair_coeff * * SOLID friction 0.5
    """
MOVE = """
    neighbor 0.0005 bin
    neigh_modify delay 0 page 20000 one 400
    fix grav all gravity 9.81 vector 0 0 -1
    fix floor all wall/restitute SOLID friction 0.5 partner rigid zplane 0.0025 NULL
    fix move all nve/sphere
    timestep 5e-6
    """
DUMP = """
    write_dump all custom ${dump} id x y z vx vy vz omegax omegay omegaz modify sort id format float %.17g
    """
SOLID = material("soft", model="prony", poisson_ratio=0.47, density_kg_m3=1050, equilibrium_modulus_pa=1.2e6,
                 terms=[{"tau_s": 2e-5, "modulus_pa": 3e6}, {"tau_s": 4e-4, "modulus_pa": 1e6}])


def crowd(name, processes, start, runs):
    """The motions at the end of a crowd of 216 soft spheres, which is new or read from a file."""
    with open("in.crowd", "w") as file:
        file.write((CROWD + start + MOVE + runs + DUMP).replace("SOLID", SOLID))
    text = lmp(os.path.abspath("in.crowd"), processes, newton="on" if processes == 1 else "off", dump="crowd.txt")
    print(f"crowd, {processes} processes, {name}: {counts(text)} contacts and steps, of floor and spheres in each run")
    return motions("crowd.txt")[1]


for processes in 1, 2:
    whole = crowd("three runs", processes, NEW, "run 600\nrun 50\nrun 50")
    between = """
        run 600
        write_restart middle.restart
        run 50
        neigh_modify page 30000 one 300
        run 50
        """
    check(crowd("commands between runs", processes, NEW, between) == whole, "crowd: commands between runs change it")
    again = crowd("a restart", processes, "read_restart middle.restart", "write_restart again.restart\nrun 50\nrun 50")
    check(again == whole, "crowd: a restart changes it")
again = crowd("a restart of a restart", processes, "read_restart again.restart", "run 50\nrun 50")
check(again == whole, "crowd: a restart from a file that was written before a run changes it")

# Files written within a run, and by run every. Atoms that LAMMPS sorts as a run begins, after
# within.300, would add their forces in another order.
UNSORTED = "\natom_modify sort 0 0\n"
within = crowd("restart files within runs", 1, NEW + UNSORTED, """
    restart 300 within.*
    run 400 every 200 "write_restart every.restart"
    restart 0
    run 100
    """)
for name, runs in ("within.300", "run 100\nrun 100"), ("every.restart", "run 100"):
    check(crowd(name, 1, "read_restart " + name + UNSORTED, runs) == within, f"crowd: a restart from {name} changes it")
