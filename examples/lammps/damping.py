# SPDX-License-Identifier: GPL-2.0-or-later
"""What a constant damping gets wrong: restitution of two polymer beads over speed and angle, in
LAMMPS with pair_style restitute and with its own hertz/material, damping tsuji and tangential
mindlin, beside the library.

The damping of LAMMPS is fitted to a head-on impact at 1 m/s: its modulus is that of the bead
after the time scale of that impact, its e_z that of the library. Run by examples/lammps/run;
writes damping.csv.
"""
import json
import math
import os

from scenes import Scene, library_pairs

HERE = os.path.dirname(os.path.abspath(__file__))
BEAD = os.path.join(HERE, "bead.json")
RADIUS, DENSITY, FRICTION, NU = 0.005, 1100, 0.3, 0.45
HEAD_ON = [(10 ** (-3 + k / 4), 0) for k in range(15)]
OBLIQUE = [(speed, angle) for speed in (0.001, 0.1) for angle in (2, *range(5, 90, 5))]


def library(cases, radius=RADIUS):
    bead = dict(material=BEAD, partner="same", radius1_m=radius, radius2_m=radius, density1_kg_m3=DENSITY,
                density2_kg_m3=DENSITY, friction=FRICTION)
    return library_pairs([bead | dict(speed_m_s=speed, angle_deg=angle) for speed, angle in cases])


def impact(speed, angle, time, style, radius=RADIUS):
    """(ez, ex) of LAMMPS, 200 steps in the contact time."""
    normal, along = speed * math.cos(math.radians(angle)), speed * math.sin(math.radians(angle))
    scene = Scene()
    scene.add((0, 0, 0), (normal, along, 0), radius=radius, density=DENSITY)
    scene.add((2 * radius * (1 + 1e-9), 0, 0), (0, 0, 0), radius=radius, density=DENSITY)
    scene.run(f"{style}\ntimestep {time / 200!r}\nfix move all nve/sphere\nrun 600")
    v, spin = scene.all("v"), scene.all("omega")
    scene.close()
    sliding = v[2][1] - v[1][1] - radius * (spin[1][2] + spin[2][2])
    return (v[2][0] - v[1][0]) / normal, sliding / along if angle else 0


def damped(radius=RADIUS, friction=FRICTION):
    """Words of pair_style granular, fitted to a head-on impact at 1 m/s. Where it is small, the
    coefficient of restitution that LAMMPS is given is not what comes out, so it is searched for."""
    answer, = library([(1, 0)], radius)
    with open(BEAD) as file:
        bead = json.load(file)
    time, tau = answer["contact_time"] / 2.94, bead["viscosity_pa_s"] / bead["modulus2_pa"]
    modulus = 2 * (1 + NU) * (bead["modulus1_pa"] + bead["modulus2_pa"] * math.exp(-time / tau))
    low, high = 0, 1
    while high - low > 1e-4:
        tried = (low + high) / 2
        normal, tangential = f"hertz/material {modulus!r} {tried!r} {NU}", f"mindlin NULL 1.0 {friction}"
        words = f"{normal} tangential {tangential} damping tsuji"
        style = "pair_style granular\npair_coeff * * " + words
        found, _ = impact(1, 0, answer["contact_time"], style, radius)
        low, high = (tried, high) if found < answer["ez"] else (low, tried)
    return words


def main():
    styles = (f"pair_style restitute\npair_coeff * * {BEAD} friction {FRICTION}",
              "pair_style granular\npair_coeff * * " + damped())
    with open("damping.csv", "w") as out:
        out.write("speed_m_s,angle_deg,ez_library,ex_library,ez_restitute,ex_restitute,ez_damping,ex_damping\n")
        for cases in (HEAD_ON, OBLIQUE):
            for (speed, angle), answer in zip(cases, library(cases)):
                found = [value for style in styles for value in impact(speed, angle, answer["contact_time"], style)]
                row = (speed, angle, answer["ez"], answer["ex"], *found)
                out.write(",".join(f"{value:.6g}" for value in row) + "\n")


if __name__ == "__main__":
    main()
