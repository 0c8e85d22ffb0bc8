# SPDX-License-Identifier: GPL-2.0-or-later
"""What cannot be computed ends the run with a message that names it. Contacts that begin too fast
for the time step, or with a deep overlap, are reported."""
import re

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
refused("a part of an element", ["'8.7'", "whole number"],
        f"pair_style restitute\npair_coeff * * {rubber} friction 0.3 elements 8.7")
refused("a negative limit", ["'-1'"], f"pair_style restitute\npair_coeff * * {rubber} friction 0.3 limits -1 0.1")
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
refused("a time step of less than ten in a contact", ["atoms 1 and 2", "step 1", "speed 0.02999", "less than ten steps of 0.0002", "at most 2.11e-06"],
        LAW + RUN.replace("1e-6", "2e-4"))
refused("no time step", ["step"], LAW + RUN.replace("1e-6", "0"))
refused("a periodic wall", ["periodic"], f"fix w all wall/restitute {rubber} friction 0.3 zplane 0 NULL",
        boundary="f f p")
refused("a wall without place", ["xplane"], f"fix w all wall/restitute {rubber} friction 0.3")
refused("a wall that shears into the spheres", ["shear"],
        f"fix w all wall/restitute {rubber} friction 0.3 zplane 0 NULL shear z 1")

BLOCK = "region r block 0 1 0 1 0 1 units box\n"
for what, words, before, wall in (
        ("a low wall above the high one", ["zplane 0.05 0", "low must be below high"], "", "zplane 0.05 0"),
        ("a wall without its second place", ["zplane", "two positions"], "", "zplane 0.05"),
        ("a cylinder without radius", ["xcylinder -1", "must be positive"], "", "xcylinder -1"),
        ("a region that is none", ["region r does not exist"], "", "region r"),
        ("a region that a wall moves", ["'move'", "region has its own motion"], BLOCK, "region r move x 1"),
        ("a block with variable sides", ["region r", "block with variable", "rotate"],
         "variable a equal 0\n" + BLOCK.replace("0", "v_a", 1), "region r"),
        ("an axis that is none", ["wiggle 'w'", "x, y or z"], "", "zplane 0 NULL wiggle w 1 1"),
        ("a period of 0", ["wiggle period 0", "positive"], "", "zplane 0 NULL wiggle z 1 0"),
        ("a word too many", ["'contact'", "contacts"], "", "zplane 0 NULL shear x 1 contact")):
    refused(what, words, f"{before}fix w all wall/restitute {rubber} friction 0.3 {wall}")
refused("the energy of a wall without details", ["fix w", "fix_modify energy yes", "'details yes'"],
        LAW + f"fix w all wall/restitute {rubber} friction 0.3 zplane 0 NULL\nfix_modify w energy yes\n" + RUN)
refused("a sphere larger than its bowl", ["atom 1 and wall w at step", "radius 0.005", "curvature of the wall, 0.004"],
        LAW + f"region r sphere 0.001 0 0 0.004 units box\nfix w all wall/restitute {rubber} friction 0.3 region r\n" + RUN)

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

refused("a restart with another resistance", ["restart file", "types 1 1"], LAW + RUN + f"""
    write_restart law.restart
    clear
    read_restart law.restart
    pair_style restitute
    pair_coeff * * {rubber} friction 0.3 rolling sds 1 0 0.1
    {RUN}""")

THIRD = "create_atoms 1 single {} 0 0 units box\nset atom 3 diameter 0.01 density 1000\n"
LEFT = THIRD.format(-0.009999)  # touches atom 1
TOUCH = LEFT + LAW + RUN.replace("100", "1") + "\n"
for line in ("group/group all", "stress/mop x 0.004 total", "stress/cartesian x 0.1 NULL 0"):
    refused("compute " + line, ["compute c " + line.split()[0], "tangential"],
            LAW + f"group g id 1\ncompute c g {line}\n" + RUN, boundary="p p p")
refused("spheres far inside each other", ["atoms 1 and 3 at step 1", "an overlap of 0.003", "effective radius, 0.0025", "at the start"],
        THIRD.format(0.007) + "set atom 2 x 0.1\n" + LAW + RUN)
refused("two spheres in one place", ["atoms 1 and 3", "centers coincide"], THIRD.format(0) + LAW + RUN)
BEGUN = "the contact began under another law"
refused("a type that changes in contact", ["atoms 1 and 3 at step 1:", BEGUN, "pair_style none"],
        LEFT + LAW + f"pair_coeff * 2 {other} friction 0.3\n" + RUN.replace("100", "1") +
        "\nset atom 3 type 2\nrun 1", kinds=2)
refused("friction that ends in contact", ["atoms 1 and 3 at step 1", BEGUN],
        TOUCH + f"pair_coeff * * {rubber} friction 0\nrun 1")
refused("spheres in contact that are displaced", ["atoms 1 and 2 at step 2", "60 degrees in a step"],
        TOUCH + "displace_atoms all rotate 0 0 0 0 1 0 90\nrun 1")
refused("a speed of more than a radius in a step", ["atoms 1 and 3 at step 2", "velocity (", "effective radius 0.0025 in a step of 1e-06"],
        TOUCH + "set atom 3 omega 0 0 1e6\nrun 1")
for words, names in (("rolling", ["'rolling'", "must follow"]), ("rolling marshall", ["'rolling marshall'", "sds"]),
                     ("twisting x", ["'twisting x'", "marshall or sds"]), ("twisting sds 1 2", ["'2'", "must follow"]),
                     ("rolling sds 1 -2 3", ["'-2'", "[0, 1e60]"]), ("speed -1", ["'-1'", "[0, 1e60]"]),
                     ("details maybe", ["'details maybe'", "yes or no"])):
    refused(words, names, f"pair_style restitute\npair_coeff * * {rubber} friction 0.3 {words}")
refused("IDs that reset_atoms has changed", ["atom", "another ID", "reset_atoms id"],
        TOUCH + "reset_atoms id sort yes\nrun 1")
refused("IDs that delete_atoms has changed", ["atom", "another ID", "compress no"],
        TOUCH + "group g id 2\ndelete_atoms group g\nrun 1")
refused("neigh_modify one of less than a sphere touches", ["neigh_modify one 1", "at least 2", "atom 1"],
        TOUCH + "neigh_modify one 1\nrun 1")
refused("a small page of neighbors", ["neigh_modify page 1000", "ten times", "2000"],
        LAW + RUN + "\nneigh_modify page 1000\nrun 1")
refused("a radius that grows beyond the skin", ["atom 3 at step 34", "0.00551", "0.0055,", "type 1"],
        THIRD.format(0.3) + LAW + """
        variable d equal 0.01*(1+0.003*step)
        group g id 3
        fix grow g adapt 1 atom diameter v_d
        """ + RUN, atom_style="sphere 1")


def warnings(name, count, lines, ratio="first overlap over 2 steps'", words="times the overlap", first=0,
             distance=0.01, speed=0.03, **scene_words):
    """Two spheres on the x axis: `count` contacts exceed a ratio, with one warning if any does."""
    scene = Scene(screen="log.txt", **scene_words)
    scene.add((first, 0, 0), (speed, 0, 0))
    scene.add((first + distance, 0, 0), (0, 0, 0))
    scene.run(LAW + lines)
    scene.close()
    with open("log.txt") as log:
        text = log.read()
    check(re.search("restitute: [1-9][0-9]* contacts", text), f"{name}: no contact")
    warned = [line for line in text.splitlines() if "WARNING" in line]
    report = [line for line in text.splitlines() if ratio in line]
    print(f"{name}:", *warned + report, sep="\n  ")
    check(len(warned) == (count > 0) and all(words in line for line in warned), f"{name}: {len(warned)} warnings")
    counts = [int(line.rsplit(" ", 1)[1]) for line in report]
    check(sum(counts) == count, f"{name}: the report counts {counts} contacts, not {count}")


# A step between the law's and the longest one runs, but a warning says what the contact asks for.
warnings("a long time step", 1, RUN.replace("1e-6", "1e-5"), "time step over the law's", "time step")
warnings("an impact", 0, RUN)
warnings("spheres put into each other", 1, RUN, distance=0.00999)
warnings("a sphere put into a wall", 1, f"fix w all wall/restitute {rubber} friction 0.3 xplane -0.00499 NULL\n{RUN}",
         distance=0.1)
warnings("a contact that a new pair style has forgotten", 1, f"{RUN}\npair_style none\n{LAW}run 100")
warnings("a sphere made larger", 1, f"{RUN}\nset atom 1 diameter 0.012\nrun 100", distance=0.0105)
# The box shrinks by 1e-5 of its width of 1 m a step. Its spheres, or their images, follow without
# velocities. LAMMPS looks for new neighbors only if something moves.
SHRINK = "fix d all deform 1 x erate -10 remap {}\n" + RUN.replace("100", "1000")
warnings("spheres of a box that shrinks", 0, SHRINK.format("x"), distance=0.0101, speed=1e-3, boundary="p p p")
warnings("images of spheres of a box that shrinks", 0, SHRINK.format("none"), first=-0.4925, distance=0.985, speed=1e-3,
         boundary="p p p")
# Spheres that have grown by less than half the skin. The second neighbor list of the run is made
# when they are three bins apart that LAMMPS makes for the radii of the start, 1/181 m wide: then it
# looks two bins far.
warnings("spheres that have grown", 0, "variable d equal 0.0109\nfix grow all adapt 1 atom diameter v_d\n"
         + RUN.replace("100", "2500"), first=-0.5 + 90 / 181 - 3e-5 - 5.005e-4, distance=0.01125 + 5.005e-4, speed=0.5,
         atom_style="sphere 1")


def log_of(lines, **scene_words):
    """Of three spheres of two types: the log and its warnings."""
    scene = Scene(screen="log.txt", kinds=2, **scene_words)
    scene.add((0, 0, 0), (0.03, 0, 0))
    scene.add((0.01, 0, 0), (0, 0, 0))
    scene.add((0.3, 0, 0), (0, 0, 0), radius=0.002, kind=2)
    scene.run(lines)
    scene.close()
    with open("log.txt") as log:
        text = log.read()
    return text, [line for line in text.splitlines() if "WARNING" in line]


# The limit of the time step for a speed, of the smallest spheres; and that of a contact.
TELLS = LAW.replace("0.3", "0.3 speed 0.03") + f"pair_coeff 2 2 {glass} friction 0.3\n" + RUN
text, warned = log_of(TELLS.replace("1e-6", "1.9e-6"))
limits = re.findall(r"restitute: types (\d \d), radii (\S+) and (\S+), speed 0.03: time step at most (\S+)", text)
print(*limits, *warned, sep="\n")
check([limit[:3] for limit in limits] == [("1 1", "0.005", "0.005"), ("1 2", "0.005", "0.002")], "not the smallest spheres")
check(len(warned) == 1 and "types 1 2" in warned[0] and "time step 1.9e-06 is longer than" in warned[0], "no warning of a long step")
check("page size: 20000" in text, "pages of neighbors are larger than LAMMPS needs")
limit = float(limits[0][3])
_, warned = log_of(TELLS.replace("1e-6", f"{1.001 * limit}").replace(" speed 0.03", ""))
print(*warned)
check(len(warned) == 1 and "shorter by a factor of 1.01 " in warned[0], "a step that is 1.001 times too long")

# An elastic contact with a wall lasts 2^(1/5) times as long as with an equal sphere.
words = f"{glass} friction 0.3 speed 0.03"
text, _ = log_of(f"pair_style restitute\npair_coeff * * {words}\nfix w all wall/restitute {words} xplane -0.4 NULL\n{RUN}")
pair, wall = (float(re.search(rf"restitute: {what}, .*time step at most (\S+)", text).group(1))
              for what in ("types 1 1", "wall w, type 1"))
check(abs(wall / pair - 2**0.2) <= 1e-3, f"the limit of a wall is {wall}, of a pair {pair}")

# There is no variant for threads.
_, warned = log_of(TELLS.replace(" speed 0.03", ""), switches=["-sf", "omp"])
print(*warned)
check(len(warned) == 1 and "pair_style restitute" in warned[0] and "suffix omp" in warned[0], "no warning of suffix omp")


# A law that misses its material by more than a fifth runs, with a warning.
scene = Scene(screen="log.txt")
scene.add((0, 0, 0), (0.03, 0, 0))
scene.add((0.01, 0, 0), (0, 0, 0))
scene.run(f"pair_style restitute\npair_coeff * * {MATERIALS}/polyisobutylene.json friction 0.3 terms 3 window 1e-5 1e-2\n"
          + RUN)
scene.close()
with open("log.txt") as log:
    warned = [line for line in log if "WARNING" in line and "misses G(t)" in line]
print(*warned, sep="")
check(len(warned) == 1, f"{len(warned)} warnings of a law that misses its material, not 1")
