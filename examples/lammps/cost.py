# SPDX-License-Identifier: GPL-2.0-or-later
"""Run time of pair_style restitute beside LAMMPS's own hertz/material and mindlin on the same
crowd of spheres.

Styles take turns. Of their times on the processor the shortest count. Run by
examples/lammps/run; prints a table.
"""
import json
import os
import re
import subprocess
import sys

from scenes import PLUGIN

HERE = os.path.dirname(os.path.abspath(__file__))
ROUNDS, STEPS = 5, 2000


def solid(name, **values):
    with open(name + ".json", "w") as out:
        json.dump({"name": name, "poisson_ratio": 0.3} | values, out)
    return name + ".json friction 0.5"


STYLES = {
    "hertz/material, mindlin": ("granular", "hertz/material 2e9 0.7 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji"),
    "elastic": ("restitute", solid("elastic", model="elastic", modulus_pa=7.69e8)),
    "Kelvin-Voigt": ("restitute", solid("voigt", model="kelvin_voigt", modulus1_pa=7.69e8, viscosity_pa_s=2e3)),
    "standard solid": ("restitute", solid("standard", model="standard_solid", modulus1_pa=7.69e8, modulus2_pa=5e8,
                                          viscosity_pa_s=2e4)),
    "standard solid, no friction": ("restitute", "standard.json friction 0"),
    "three terms": ("restitute", solid("three", model="prony", equilibrium_modulus_pa=7.69e8, terms=[
        {"tau_s": 10.0 ** -k, "modulus_pa": 2e8} for k in (4, 5, 6)])),
}


def time_of(style, words):
    """Seconds of the run and of its pair style, contacts, doubles a contact."""
    lmp = os.path.join(os.path.dirname(sys.executable), "lmp")
    text = subprocess.run([lmp, "-in", f"{HERE}/in.cost", "-log", "none", "-nocite", "-var", "plugin", PLUGIN,
                           "-var", "style", style, "-var", "words", words, "-var", "steps", str(STEPS)],
                          check=True, capture_output=True, text=True).stdout
    last = text.rsplit("Loop time of ", 1)
    contacts = float(last[0].strip().splitlines()[-1].split()[-1]) / 2  # counted from both sides
    share = float(re.search(r"([\d.]+)% CPU use", last[1]).group(1)) / 100  # others may use the machine, too
    numbers = re.search(r"(\d+) numbers a contact", text)
    return (share * float(last[1].split()[0]), share * float(re.search(r"Pair +\| (\S+)", last[1]).group(1)), contacts,
            int(numbers.group(1)) if numbers else 3)


best = {}
for _ in range(ROUNDS):
    for name, (style, words) in STYLES.items():
        now = time_of(style, words)
        best[name] = tuple(map(min, now, best.get(name, now)))
base = best["hertz/material, mindlin"][0]
print("| contact | doubles a contact | run time, ratio | pair style, ns a contact and step |")
print("|---|---|---|---|")
for name, (run, pair, contacts, numbers) in best.items():
    print(f"| {name} | {numbers} | {run / base:.2f} | {1e9 * pair / STEPS / contacts:.0f} |")
