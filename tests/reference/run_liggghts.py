#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs reference impacts through LIGGGHTS's own contact model (docs/reference_impacts.md):

    python3 run_liggghts.py --output liggghts.csv [--every 1]

The output has a row for each impact. LIGGGHTS (Debian: liggghts) takes e_z from 0.05 to 1 and E
from 5 MPa on, so moduli and densities are multiplied by the same number, which changes no motion.
"""
import argparse
import csv
import math
import subprocess
import tempfile
from pathlib import Path

import dem

MODEL = "hertz, tangential history"
YOUNGS = 1e9
LEAST_EZ = 0.05


def scene(impact, steps):
    """Input lines of one impact, which end with a line of its result."""
    width, radius = 5 * max(impact.radii), min(impact.radii)
    lines = f"""
        clear
        units si
        atom_style granular
        atom_modify map array sort 0 0
        boundary f f f
        newton off
        communicate single vel yes
        region box block {-width!r} {width!r} {-width!r} {width!r} {-width!r} {width!r} units box
        create_box 1 box
        neighbor {0.1 * radius!r} bin
        neigh_modify delay 0
        fix m1 all property/global youngsModulus peratomtype {YOUNGS!r}
        fix m2 all property/global poissonsRatio peratomtype {impact.nu!r}
        fix m3 all property/global coefficientRestitution peratomtypepair 1 {impact.ez!r}
        fix m4 all property/global coefficientFriction peratomtypepair 1 {impact.friction!r}
        pair_style gran model hertz tangential history
        pair_coeff * *
        timestep {impact.dt!r}
        """
    for i, radius in enumerate(impact.radii):
        (along, normal), tag = impact.velocities[i], i + 1
        density = impact.densities[i] * YOUNGS / impact.youngs
        lines += f"""
        create_atoms 1 single 0 0 {impact.places[i]!r} units box
        set atom {tag} diameter {2 * radius!r} density {density!r}
        set atom {tag} vx {along!r} vz {normal!r}
        set atom {tag} omegay {impact.spins[i]!r}
        """
    if impact.wall:
        lines += ("fix wall all wall/gran model hertz tangential history "
                  "primitive type 1 zplane 0.0\n")
    lines += f"""
        fix move all nve/sphere
        dump d all custom {steps} {impact.number}.txt id z vx vz omegay
        dump_modify d sort id format "%d %.17g %.17g %.17g %.17g"
        thermo {steps}
        run {steps}
        undump d
        """
    return "\n".join(line.strip() for line in lines.splitlines() if line.strip()) + "\n"


def result(impact, path):
    """e_z and e_x of the last step in a dump; nan if the bodies still touch."""
    lines = path.read_text().splitlines()[-len(impact.radii):]
    z, vx, vz, spin = zip(*(map(float, line.split()[1:]) for line in lines))
    return impact.pair(list(zip(vx, vz)), spin) if impact.separated(z) else (math.nan, math.nan)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", required=True)
    parser.add_argument("--every", type=int, default=1, help="only every N-th impact")
    parser.add_argument("--input", default=dem.FILE)
    parser.add_argument("--program", default="liggghts")
    asked = parser.parse_args()
    impacts = [i for i in dem.impacts(asked.input)[::asked.every] if i.ez >= LEAST_EZ]
    with tempfile.TemporaryDirectory() as place, open(asked.output, "w", newline="") as file:
        # A damped impact of Hertz takes longer than an elastic one: at e_z = 0.05 twice as long
        text = "".join(scene(i, dem.STEPS * (2 if i.ez > 0.5 else 6)) for i in impacts)
        Path(place, "scenes.in").write_text(text)
        subprocess.run([asked.program, "-log", "none", "-screen", "none", "-in", "scenes.in"],
                       cwd=place, check=True)
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["impact", "code", "model", "ez", "ex", "time"])
        for impact in impacts:
            ez, ex = result(impact, Path(place, f"{impact.number}.txt"))
            out.writerow([impact.number, "LIGGGHTS", MODEL, f"{ez:.10g}", f"{ex:.10g}", "nan"])


if __name__ == "__main__":
    main()
