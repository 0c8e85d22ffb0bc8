# SPDX-License-Identifier: GPL-2.0-or-later
"""What cannot be computed, or no preload, ends the run with a message that names it. Contacts
that begin too fast for the time step, or deep, are reported."""
import re

from scenes import MATERIALS, STYLE, WALL, box, check, law, liggghts, material, sphere

rubber = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
other = material("other", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=4e4)
LAW = law(f"{rubber} friction 0.3")
BALLS = sphere(1, (0, 0, 0), (0.03, 0.02, 0)) + sphere(2, (0.01, 0, 0), (0, 0, 0))
RUN = "fix move all nve/sphere\ntimestep 1e-6\nrun 100\n"


def refused(what, words, lines, **how):
    text = " ".join(liggghts(lines, fails=True, **how).split())
    found = text[re.search(r"ERROR(?: on proc 0)?: |$", text).start():][:300]
    print(f"{what}: {found}")
    for word in words:
        check(word in found, f"{what}: the message does not say '{word}'")


def refused_law(what, words, line):
    refused(what, ["model restitute: types 1 1"] + words, box() + BALLS + law(line) + STYLE)


refused("a missing preload", ["Invalid model"], box() + BALLS + LAW + STYLE + RUN, plugin="")
refused("no tangential model", ["Unknown normal model"], box() + LAW + "pair_style gran model restitute")
refused("another normal model", ["Unknown tangential model"],
        box() + LAW + "pair_style gran model hertz tangential restitute")
refused("another tangential model", ["Unknown normal model"],
        box() + LAW + "pair_style gran model restitute tangential history")
refused("no law", ["variable restitute string"], box() + BALLS + STYLE)
refused("a pair of types without law", ["types 1 2", "partner"],
        box() + BALLS + law(f"{rubber} friction 0.3", "_1_1") + STYLE + RUN)
refused("units lj", ["units lj", "must be si or cgs", "Pa"], box().replace("units si", "units lj") + LAW + STYLE)
refused_law("no file", ["nowhere.json"], "nowhere.json friction 0.3")
refused_law("no friction", ["friction MU"], rubber)
refused_law("a word that is none", ["'fricton'"], f"{rubber} fricton 0.3")
refused_law("7 elements", ["elements = 7"], f"{rubber} friction 0.3 elements 7")
refused_law("30 terms without a window", ["30 terms"], f"{MATERIALS}/polyisobutylene.json friction 0.3")
refused_law("one term for five decades", ["terms = 1", "longest = 1 s", "misses G(t)", "at most 50 %"],
            f"{MATERIALS}/polyisobutylene.json friction 0.3 terms 1 window 1e-5 1")
refused("a wall before the pair style", ["must come after"],
        box() + LAW + f"fix floor all {WALL} primitive type 2 zplane 0")
refused("small pages", ["page 5300", "53 numbers"],
        box() + BALLS + LAW + STYLE + "neigh_modify page 5000 one 100\n" + RUN)
refused("a time step of less than ten in a contact", ["sphere 1 and 2", "step 1", "less than ten steps"],
        box() + BALLS + LAW + STYLE + RUN.replace("1e-6", "2e-4"))
refused("rRESPA", ["run_style verlet"], box() + BALLS + LAW + STYLE + "run_style respa 2 2\n" + RUN)

liggghts(box() + BALLS + LAW + STYLE + RUN + "write_restart law.restart")
AGAIN = "atom_style granular\nnewton off\ncommunicate single vel yes\nread_restart law.restart\n"
refused("a restart with another law", ["types 1 1", "another law", "other.json"], law(f"{other} friction 0.3") + AGAIN +
        STYLE)
refused("a restart without the pair style", ["pair_style again"], LAW + AGAIN + RUN)


def reported(name, words, ratio, lines):
    """A contact is counted as beyond a ratio, and warned of once."""
    text = liggghts(box() + lines)
    warnings = [line for line in text.splitlines() if words in line and "WARNING" in line]
    report = [line for line in text.splitlines() if ratio in line]
    print(f"{name}:", *warnings + report, sep="\n  ")
    check(len(warnings) == 1, f"{name}: {len(warnings)} warnings, not 1")
    check(len(report) == 1 and report[0].endswith("contacts beyond 1: 1"), f"{name}: the report does not count it")


# A step between the law's and the longest one runs, but a warning says what the contact asks for.
reported("a long time step", "time step", "time step over the law's", BALLS + LAW + STYLE + RUN.replace("1e-6", "1e-5"))
reported("spheres put into each other", "times the overlap", "first overlap over 2 steps'",
         sphere(1, (0, 0, 0), (0.03, 0, 0)) + sphere(2, (0.00999, 0, 0), (0, 0, 0)) + LAW + STYLE + RUN)

# So does a law that misses its material by more than a fifth.
text = liggghts(box() + BALLS + law(f"{MATERIALS}/polyisobutylene.json friction 0.3 terms 3 window 1e-5 1e-2") + STYLE + RUN)
warnings = [line for line in text.splitlines() if "misses G(t)" in line and "WARNING" in line]
print("\n".join(warnings))
check(len(warnings) == 1, f"{len(warnings)} warnings of the reduced series, not 1")
