# SPDX-License-Identifier: GPL-2.0-or-later
"""What cannot be computed ends the run with a message that names it; a time step too long for a contact is reported."""

from scenes import MATERIALS, Scene, check, material

rubber = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
other = material("other", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=4e4)
glass = material("glass", model="elastic", modulus_pa=3e10)
LAW = f"pair_style restitute\npair_coeff * * {rubber} friction 0.3\n"
RUN = "fix move all nve/sphere\ntimestep 1e-6\nrun 100"


def refused(what, words, lines, **scene_words):
    scene = Scene(**scene_words)
    scene.add((0, 0, 0), (0.03, 0.02, 0))
    scene.add((0.01, 0, 0), (0, 0, 0))
    try:
        scene.run(lines)
    except Exception as problem:
        message = " ".join(str(problem).split())
        print(f"{what}: {message}")
        for word in words:
            check(word in message, f"{what}: the message does not say '{word}'")
    else:
        check(False, what + ": was not refused")
    scene.close()


for units in ("lj", "real", "metal", "micro"):
    refused("units " + units, ["units " + units, "must be si or cgs", "Pa"], LAW + RUN, units=units)
refused("no file", ["nowhere.json"], "pair_style restitute\npair_coeff * * nowhere.json friction 0.3")
refused("no friction", ["friction MU"], f"pair_style restitute\npair_coeff * * {rubber}")
refused("a word that is none", ["'fricton'"], f"pair_style restitute\npair_coeff * * {rubber} fricton 0.3")
refused("a number that is none", ["'0.3x'"], f"pair_style restitute\npair_coeff * * {rubber} friction 0.3x")
refused("a word without value", ["'elements'"], f"pair_style restitute\npair_coeff * * {rubber} friction 0.3 elements")
refused("7 elements", ["elements = 7"], f"pair_style restitute\npair_coeff * * {rubber} friction 0.3 elements 7")
refused("30 terms without a window", ["30 terms"],
        f"pair_style restitute\npair_coeff * * {MATERIALS}/polyisobutylene.json friction 0.3")
refused("one term for five decades", ["terms = 1", "longest = 1 s", "misses G(t)", "at most 50 %"],
        f"pair_style restitute\npair_coeff * * {MATERIALS}/polyisobutylene.json friction 0.3 terms 1 window 1e-5 1")
refused("a pair of types without law", ["types 1 2", "partner"],
        LAW.replace("* *", "1 1") + f"pair_coeff 2 2 {glass} friction 0.3\n" + RUN, kinds=2)
refused("rigid bodies", ["rigid bodies"], LAW + "fix move all rigid single\nrun 1")
refused("a minimizer", ["minimizer"], LAW + "minimize 0 1e-9 10 10")
refused("rRESPA", ["run_style verlet"], LAW + "run_style respa 2 2\n" + RUN)
refused("no velocities of ghosts", ["comm_modify vel yes"], "comm_modify vel no\n" + LAW + RUN)
refused("a time step of less than ten in a contact", ["atoms 1 and 2", "step 1", "less than ten steps"],
        LAW + RUN.replace("1e-6", "2e-4"))
refused("no time step", ["step"], LAW + RUN.replace("1e-6", "0"))
refused("a periodic wall", ["periodic"], f"fix w all wall/restitute {rubber} friction 0.3 zplane 0 NULL",
        boundary="f f p")
refused("a wall without place", ["xplane"], f"fix w all wall/restitute {rubber} friction 0.3")
refused("a wall that shears into the spheres", ["shear"],
        f"fix w all wall/restitute {rubber} friction 0.3 zplane 0 NULL shear z 1")

for name, solid in (("another law", other), ("a law of another size", glass)):
    refused("a restart with " + name, ["restart file", "types 1 1", solid], LAW + RUN + f"""
        write_restart law.restart
        clear
        read_restart law.restart
        pair_style restitute
        pair_coeff * * {solid} friction 0.3
        {RUN}""")
    refused("a restart with a wall of " + name, ["restart file", "wall", solid], LAW + f"""
        fix w all wall/restitute {rubber} friction 0.3 zplane -0.1 NULL
        {RUN}
        write_restart law.restart
        clear
        read_restart law.restart
        fix w all wall/restitute {solid} friction 0.3 zplane -0.1 NULL
        {RUN}""")



def log_of(lines):
    """What LAMMPS says of two spheres that meet."""
    scene = Scene(screen="log.txt")
    scene.add((0, 0, 0), (0.03, 0, 0))
    scene.add((0.01, 0, 0), (0, 0, 0))
    scene.run(lines)
    scene.close()
    with open("log.txt") as log:
        return log.read()


def warned_once(text, words):
    warnings = [line for line in text.splitlines() if words in line and "WARNING" in line]
    print("\n".join(warnings))
    check(len(warnings) == 1, f"{len(warnings)} warnings of '{words}', not 1")


# A step between the law's and the longest one runs, but a warning says what the contact asks for.
text = log_of(LAW + RUN.replace("1e-6", "1e-5"))
warned_once(text, "time step")
check("contacts beyond 1: 1" in text, "the report does not count the contact")

# So does a law that misses its material by more than a fifth.
warned_once(log_of(f"pair_style restitute\npair_coeff * * {MATERIALS}/polyisobutylene.json friction 0.3 terms 3 window 1e-5 1e-2\n"
                   + RUN), "misses G(t)")
