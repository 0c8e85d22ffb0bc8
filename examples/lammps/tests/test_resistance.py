# SPDX-License-Identifier: GPL-2.0-or-later
"""Rolling and twisting resistance are those of LAMMPS's pair_style granular, and compute pair/local
tells of a contact what it tells there. An elastic sphere with spin falls onto a frozen one, without
gap, and comes to rest under its weight."""
import math

from scenes import Scene, check, material

SHEAR, POISSON, RADIUS, DENSITY, WEIGHT = 1e8, 0.3, 0.005, 2000, 0.5
YOUNG = 2 * SHEAR * (1 + POISSON)
SOLID = material("bead", model="elastic", modulus_pa=SHEAR, poisson_ratio=POISSON)
# Of the sphere at rest, from Hertz.
DEPTH = (0.75 * WEIGHT * 2 * (1 - POISSON ** 2) / YOUNG / math.sqrt(RADIUS / 2)) ** (2 / 3)
CONTACT_RADIUS = math.sqrt(DEPTH * RADIUS / 2)


def granular(friction, words, tangential):
    return (f"pair_style granular\npair_coeff * * hertz/material {YOUNG} 0 {POISSON} "
            f"tangential {tangential} 0 {friction} damping velocity {words}")


def restitute(friction, words):
    return f"pair_style restitute\npair_coeff * * {SOLID} friction {friction} {words}"


def numbers(dump):
    """One list for each step."""
    with open(dump) as lines:
        return [[float(word) for word in text.split("\n", 1)[1].split()] for text in lines.read().split("ITEM: ")
                if text.startswith(("ENTRIES", "ATOMS"))]


def course(law, spin, velocity, settle, turn):
    """Spins of the upper sphere, and the numbers of pair/local of the lower one. `settle`: the
    sphere has come to rest before it is given spin and velocity. `turn` swaps the tags."""
    scene = Scene(half_width=0.05)
    lower, upper = ((0, 0, 0), (0, 0, 0), (0, 0, 0)), ((0, 0, 2 * RADIUS), (0, 0, 0), (0, 0, 0))
    tags = [scene.add(*sphere, RADIUS, DENSITY) for sphere in ((upper, lower) if turn else (lower, upper))]
    scene.run(f"""
        group base id {tags[turn]}
        group top subtract all base
        fix weight top addforce 0 0 -{WEIGHT}
        fix slow top viscous 10
        fix hold base freeze
        fix move all nve/sphere
        timestep 1e-6
        """)
    scene.run(law)
    if settle:
        scene.run("run 4000\nunfix slow")
    scene.run(f"set group top omega {spin[0]} {spin[1]} {spin[2]}\nset group top vx {velocity[0]} vy {velocity[1]}")
    scene.run("""
        compute of all pair/local force fx fy fz p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 p12
        dump of all local 400 of.dump c_of[*]
        dump_modify of format float %.15g
        dump spins top custom 400 spins.dump omegax omegay omegaz
        dump_modify spins format float %.15g
        run 4000
        """)
    scene.close()
    return numbers("spins.dump"), numbers("of.dump")


def as_torque(line):
    """In LAMMPS 5 to 8 are the rolling pseudo-force, which its manual calls a torque."""
    n = [c / math.hypot(*line[13:16]) for c in line[13:16]]
    f, arm = line[8:11], RADIUS / 2
    torque = [arm * (n[(k + 1) % 3] * f[(k + 2) % 3] - n[(k + 2) % 3] * f[(k + 1) % 3]) for k in range(3)]
    return line[:8] + torque + [math.hypot(*torque)] + line[12:]


def largest(found, wanted, columns):
    """Difference, over the largest number."""
    wanted = [[line[k] for k in columns] for line in wanted]
    found = [[line[k] for k in columns] for line in found]
    scale = max(abs(a) for line in wanted for a in line)
    return max(abs(a - b) for one, other in zip(found, wanted) for a, b in zip(one, other)) / (scale or 1)


def compare(name, words, spin, friction=0, velocity=(0, 0), tangential="mindlin NULL", tolerance=1e-12, told=1e-12,
            shear=None):
    """Tolerances: of spins over the first one, and of what pair/local tells over the largest;
    `shear`: of tangential forces there."""
    settle = friction > 0
    wanted, theirs = course(granular(friction, words, tangential), spin, velocity, settle, False)
    theirs = [as_torque(line) for line in theirs if len(line) == 16]
    for turn in False, True:
        found, ours = course(restitute(friction, words), spin, velocity, settle, turn)
        signs = [-1 if turn and k not in (0, 7, 11, 12) else 1 for k in range(16)]
        ours = [[a * sign for a, sign in zip(line, signs)] for line in ours if len(line) == 16]
        columns = {"force": range(4), "tangential": range(4, 8) if friction and velocity[0] else (),
                   "rolling": range(8, 12) if "rolling" in words else (), "twisting": (12,) if "twisting" in words else (),
                   "distance": range(13, 16)}
        error = largest(found, wanted, range(3))
        errors = {what: largest(ours, theirs, those) for what, those in columns.items() if those}
        print(f"{name}, spin {spin} becomes {[float(f'{w:.3g}') for w in found[-1]]}: off by {error:.0e};",
              *(f"{what} {its:.0e}" for what, its in errors.items()))
        check(len(found) == len(wanted) == 11 and len(ours) == len(theirs) >= 10, f"{name}: {len(ours)} looks")
        check(error <= tolerance, f"{name}: {found} instead of {wanted}")
        check(errors.pop("tangential", 0) <= (shear or told), f"{name}: {ours} instead of {theirs}")
        check(max(errors.values()) <= told, f"{name}: {ours} instead of {theirs}")
    change = max(abs(a - b) for a, b in zip(wanted[5], spin))
    check(change > 0.03 * max(map(abs, spin)), f"{name}: hardly any change, no test")


# Without friction the forces are the same to rounding. In pair/local LAMMPS damps with the
# velocities at the end of a step, the contact with those in its middle.
compare("rolling", "rolling sds 2e4 0 0.2", (40, -30, 0))
compare("twisting", "twisting sds 0.02 0 2e-4", (0, 0, 50))
compare("both, damped", "rolling sds 2e4 5 0.2 twisting sds 0.02 1e-6 2e-4", (40, -30, 50), told=2e-3)
# Both are given the stiffness at rest. After settling the overlap is that to 1e-9.
compare("Marshall", "twisting marshall", (0, 0, 10), 0.3, tolerance=1e-8, told=1e-7,
        tangential=f"linear_history {4 * SHEAR / (2 - POISSON) * CONTACT_RADIUS}")
# Until it slides all over, partial slip makes the contact softer than Mindlin's spring.
compare("a sliding sphere", "rolling sds 2e4 0 0.1", (0, 10, 0), 0.05, (0.6, 0), tolerance=1e-3, told=1e-5)
# Partial slip damps the swings of the tangential force, which are the spring's.
for words in "rolling sds 2e4 0 0.1", "rolling sds 50 0 10":
    compare("a rolling sphere", words, (0, 40, 0), 0.5, (0.2, 0), tolerance=0.01, told=1e-3, shear=0.3)

# LAMMPS divides by a stiffness of 0. The sphere stops.
spins, _ = course(restitute(0, "rolling sds 0 5 0.2 twisting sds 0 1e-6 2e-3"), (40, -30, 50), (0, 0), False, False)
print("dashpots with sliders:", *([float(f"{w:.3g}") for w in spin] for spin in spins))
for before, after in zip(spins, spins[1:]):
    check(all(0 < a / b < 0.99 for a, b in zip(after, before)), f"dashpots do not slow the sphere: {before}, {after}")

# A twisted contact turns back, and then its normal force falls: the torque keeps its sign. That of
# LAMMPS jumps.
WORDS = "twisting sds 0.02 0 2e-4"


def relieved(law):
    scene = Scene(half_width=0.05)
    for height in 0, 2 * RADIUS:
        scene.add((0, 0, height), (0, 0, 0), radius=RADIUS, density=DENSITY)
    scene.run(law)
    scene.run(f"""
        group base id 1
        fix weight all addforce 0 0 -{WEIGHT}
        fix slow all viscous 10
        fix hold base freeze
        fix move all nve/sphere
        timestep 1e-6
        run 4000
        set atom 2 omega 0 0 6
        run 1400
        fix weight all addforce 0 0 -{0.05 * WEIGHT}
        fix hold base freeze
        compute of all pair/local force p9
        dump of all local 20 of.dump c_of[*]
        run 600
        """)
    scene.close()
    return [torque for _, torque in numbers("of.dump")]


ours, theirs = relieved(restitute(0.3, WORDS)), relieved(granular(0.3, WORDS, "mindlin NULL"))
print("a twisted contact that is relieved:", *(f"{torque:.1e}" for torque in ours[5:9]), "N m; LAMMPS's own:",
      *(f"{torque:.1e}" for torque in theirs[5:9]))
check(max(ours) < 0 and ours[:7] == theirs[:7], f"the torque jumps: {ours}")
check(max(theirs) > 5e-5, "LAMMPS's own twisting no longer jumps: the page on contacts says so")

# The radii and energies of a contact that begins to slip: Cattaneo's and Hertz's, with 8 elements.
scene = Scene(half_width=0.05)
scene.add((0, 0, 0), (0, 0, 0), radius=RADIUS, density=DENSITY)
scene.add((0, 0, 2 * RADIUS), (0, 0, 0), radius=RADIUS, density=DENSITY)
scene.run(restitute(0.3, "details yes"))
scene.run(f"""
    group base id 1
    fix weight all addforce 0 0 -{WEIGHT}
    fix slow all viscous 10
    fix hold base freeze
    fix move all nve/sphere
    timestep 1e-6
    run 4000
    compute of all pair/local force p4 p13 p14 p15 p16 p17
    compute shape all fabric radius force/normal
    dump of all local 5 of.dump c_of[*]
    set atom 2 vx 0.1
    thermo_style custom step c_shape c_shape[3]
    """)
scene.run("run 30")
scene.close()
looks = numbers("of.dump")
for force, shear, radius, stick, stored, friction, viscous in looks:
    share = (1 - shear / (0.3 * force)) ** (1 / 3)
    print(f"tangential force {shear:.4f} N: contact radius {radius:.4g} m, stick radius {stick / radius:.3f} of it "
          f"({share:.3f}), stored {stored:.4e} J, lost {friction:.1e} J to friction, {viscous:.1e} J in dashpots")
    check(abs(radius / CONTACT_RADIUS - 1) <= 1e-4, f"a contact radius of {radius}, not {CONTACT_RADIUS} m")
    check(abs(stick / radius - share) <= 0.08, "the stick radius is off by more than two thirds of an element")
    check(viscous == 0, f"an elastic contact has lost {viscous} J in dashpots")
check(len(looks) == 7 and looks[-1][1] > 0.09, f"{len(looks)} looks, tangential force {looks[-1][1]}")
check(abs(looks[0][4] / (0.4 * WEIGHT * DEPTH) - 1) <= 1e-3, f"a stored energy of {looks[0][4]} J")
check(looks[0][5] == 0 < looks[1][5] < looks[-1][5], "no rising loss to friction")
