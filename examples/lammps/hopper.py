# SPDX-License-Identifier: GPL-2.0-or-later
"""A hopper of polymer beads with pair_style restitute and with a constant damping: what an
engineer sees of the difference.

    hopper.py [BEADS]                   default 500: some minutes on one core

Runs in.hopper with both laws, and prints a table. The damping is that of damping.py: LAMMPS's own
hertz/material and mindlin, fitted at 1 m/s. Writes hopper-LAW.txt and hopper-frames.txt for
draw.py.
"""
import math
import os
import re
import subprocess
import sys
from statistics import mean

from damping import BEAD, DENSITY, HERE, damped
from scenes import PLUGIN

GRAVITY, SIZE, OUTLET, FRICTION = 9.81, 0.03, 0.45, 0.5  # as in in.hopper
LAWS = {"restitute": "restitute", "granular": "constant damping"}


def run(law, beads, damping):
    lmp = os.path.join(os.path.dirname(sys.executable), "lmp")
    command = [lmp, "-in", f"{HERE}/in.hopper", "-log", f"hopper-{law}.log", "-screen", "none", "-nocite"]
    values = {"plugin": PLUGIN, "bead": BEAD, "n": str(beads), "law": law, "damping": damping,
              "series": f"hopper-{law}.txt", "frames": f"hopper-{law}.frames"}
    subprocess.run(command + [word for pair in values.items() for word in ("-var", *pair)], check=True)


def series(law):
    """Columns by name."""
    with open(f"hopper-{law}.txt") as file:
        names, *rows = (line.split() for line in file)
    return {name: [float(row[k]) for row in rows] for k, name in enumerate(names)}


def when(s, mass):
    """The time at which this mass has come out, or nan."""
    k = next((k for k, out in enumerate(s["discharged_kg"]) if out >= mass), None)
    if k is None:
        return math.nan
    low, high = s["discharged_kg"][k - 1:k + 1]
    return s["time_s"][k - 1] + (s["time_s"][k] - s["time_s"][k - 1]) * (mass - low) / (high - low)


def seconds(law):
    """On the processor; others may use the machine, too."""
    with open(f"hopper-{law}.log") as file:
        text = file.read()
    return sum(float(time) * float(share) / 100
               for time, share in re.findall(r"Loop time of (\S+)[\s\S]*?\n([\d.]+)% CPU use", text))


def beverloo(beads):
    """kg/s through a round outlet in a flat floor: Beverloo, Leniger and van de Velde, Chem. Eng.
    Sci. 15 (1961) 260, with 0.58 and 1.4 for spheres; a bulk density of 0.6 of the solid."""
    return 0.58 * 0.6 * DENSITY * math.sqrt(GRAVITY) * (2 * OUTLET * SIZE - 1.4 * SIZE * beads ** (-1 / 3)) ** 2.5


def numbers(law, opened):
    """What the table says of a run."""
    s = series(law)
    mass = s["mass_kg"][-1]
    first = next(k for k, time in enumerate(s["time_s"]) if time >= opened)
    energy = [a + b for a, b in zip(s["kinetic_j"], s["potential_j"])]
    flowing = [k for k, out in enumerate(s["discharged_kg"]) if 0.1 * mass < out < 0.9 * mass]
    out = [when(s, share * mass) for share in (0.2, 0.7, 0.98)]
    rise = [1000 * s["rising_j"][k] / (s["discharged_kg"][k] * GRAVITY) for k in flowing]
    return {"contacts of a bead before the outlet opens": f"{s['contacts'][first]:.2f}",
            "discharge rate, from 20 to 70 %, g/s": f"{1000 * 0.5 * mass / (out[1] - out[0]):.1f}",
            "98 % are out after, s": f"{out[2] - opened:.3f}",
            "contacts of a bead while they flow": f"{mean(s['contacts'][k] for k in flowing):.2f}",
            "rebound of beads on the floor while they flow, mean height, mm": f"{mean(rise):.3f}",
            "energy dissipated since the opening, mJ": f"{1000 * (energy[first] - energy[-1]):.2f}",
            "processor time, s": f"{seconds(law):.0f}"}


def frame(law, number):
    """Beads of the rear half, the nearest last: x, z, radius and height in the full hopper, over
    the size of the hopper."""
    with open(f"hopper-{law}.frames") as file:
        lines = file.read().split("ITEM: ATOMS")[1:][number].split("ITEM:")[0].splitlines()[1:]
    beads = [[float(word) / SIZE for word in line.split()[-5:]] for line in lines]
    return [(x, z, r, height) for x, y, z, r, height in sorted(beads, key=lambda bead: -bead[1]) if y > 0]


def main():
    beads = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    damping = damped(0.5 * SIZE * beads ** (-1 / 3), FRICTION)
    for law in LAWS:
        run(law, beads, damping)
    report(beads)


def report(beads):
    opened = 4.5 * math.sqrt(SIZE / GRAVITY)
    tables = [numbers(law, opened) for law in LAWS]
    print(f"{beads} beads. Beverloo: {1000 * beverloo(beads):.1f} g/s")
    print(f"| | {' | '.join(LAWS.values())} |\n|---|---|---|")
    for name in tables[0]:
        print(f"| {name} | {' | '.join(table[name] for table in tables)} |")
    with open("hopper-frames.txt", "w") as out:
        for law, number in ("restitute", 0), ("restitute", 3), ("granular", 3), ("restitute", -1):
            out.writelines(" ".join(f"{value:.4f}" for value in bead) + "\n" for bead in frame(law, number))
            out.write("\n\n")


if __name__ == "__main__":
    main()
