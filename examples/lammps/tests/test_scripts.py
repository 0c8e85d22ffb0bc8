# SPDX-License-Identifier: GPL-2.0-or-later
"""The input scripts of this example, short: what they print, on one process and on two, and after a restart."""
import os
import re
import subprocess
import sys

from scenes import MATERIALS, PLUGIN, check, library_pairs

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
VENV = os.path.dirname(sys.executable)


def lmp(script, processes=1, **variables):
    """What a script prints."""
    files = {"plugin": PLUGIN, "bead": f"{SCRIPTS}/bead.json", "glass": f"{MATERIALS}/soda_lime_glass.json",
             "material": f"{MATERIALS}/polyisobutylene.json"}
    command = [f"{VENV}/mpiexec", "-n", str(processes), f"{VENV}/lmp", "-in", f"{SCRIPTS}/{script}",
               "-log", "none", "-nocite"]
    for name, value in (files | variables).items():
        command += ["-var", name, str(value)]
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, f"{script}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    check("WARNING" not in done.stdout, f"{script}: {done.stdout}")
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
# Sums of forces round in another order; spins are some 100 1/s, and impacts multiply differences.
check(len(a) == len(b) == 512 * 10 and error <= 1e-9, "in.shear is another motion on two processes")

text = lmp("in.bed", steps=50000, every=10000, dump="whole.txt")
lmp("in.bed", steps=50000, every=10000, half="first")
lmp("in.bed", steps=50000, every=10000, half="second", dump="halves.txt")
(floor, _), (side, _), (beads, _) = counts(text)
print(f"in.bed: {beads} contacts of beads, {floor} with the floor, {side} with the cylinder")
check(int(floor) > 10 and int(beads) > 10, "in.bed: the beads do not meet all that is there")
check(motions("whole.txt")[1] == motions("halves.txt")[1], "in.bed: a restart changes the motion")
