# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere that slides over a mesh feels no edge: neither within a plane nor on a ridge."""
import math

from scenes import STYLE, WALL, box, check, dump, law, liggghts, material, mesh, motions, sphere

RADIUS, WEIGHT = 0.005, 0.3  # m, N: presses the sphere onto the mesh
soft = material("soft", model="standard_solid", modulus1_pa=1e7, modulus2_pa=3e7, viscosity_pa_s=3e3)


def slide(name, wall, speed, slope=0.0, start=-0.004, steps=4000, every=10):
    """Motions of a sphere that settles for 2 ms, slides along x, and is pressed down by its
    weight."""
    down, along = (-math.sin(slope), -math.cos(slope)), (math.cos(slope), -math.sin(slope))
    x, z = start * along[0] - RADIUS * down[0], start * along[1] - RADIUS * down[1]
    mass = 1000 * 4 / 3 * math.pi * RADIUS ** 3
    text = liggghts(box() + law(f"{soft} friction 0.4") +
                    sphere(1, (x, 1e-4, z), (speed * along[0], 0, speed * along[1]), radius=RADIUS) + STYLE + f"""
        {wall}
        fix down all gravity {WEIGHT / mass!r} vector {down[0]!r} 0 {down[1]!r}
        timestep 5e-6
        fix move all nve/sphere
        run 400
        {dump(name, every)}
        run {steps}
        """)
    return [step[1] for step in motions(name)], text


def triangles(height_of, xs, y=0.02):
    """Strips along y between xs, each of two triangles."""
    for a, b in zip(xs, xs[1:]):
        p, q, r, s = ((a, -y, height_of(a)), (b, -y, height_of(b)), (b, y, height_of(b)), (a, y, height_of(a)))
        yield from ((p, q, r), (p, r, s))


def on_mesh(name, corners, more=""):
    return (f"fix ground all mesh/surface file {mesh(name, corners)} type 2 {more}\n"
            f"fix table all {WALL} mesh n_meshes 1 meshes ground")


def difference(one, two):
    return max(abs(a[name] - b[name]) / max(abs(c[name]) for c in two) for a, b in zip(one, two)
               for name in ("vx", "vz", "omegay", "fz"))


# One plane: strips whose diagonals and edges the sphere crosses.
flat = list(triangles(lambda x: 0.0, [-0.02 + 0.002 * k for k in range(21)]))
wall, _ = slide("wall", f"fix table all {WALL} primitive type 2 zplane 0", 0.5)
plane, text = slide("plane", on_mesh("plane", flat), 0.5)
print(f"a mesh of one plane: motion as on the wall within {difference(plane, wall):.1e}, to x = {plane[-1]['x']:.4f}")
check(plane[-1]["x"] - plane[0]["x"] > 0.004, "the sphere crosses no edges")
# Rounding of the points of contact, grown in 4000 steps; a lost memory changes it by 1e-1.
check(difference(plane, wall) <= 1e-8, "the sphere feels the edges of a mesh of one plane")
check("restitute: 0 contacts" in text, "an edge begins a new contact")  # in the second run
slow, _ = slide("slow", on_mesh("plane", flat), 1e-4, start=-1e-7)
wall, _ = slide("wall", f"fix table all {WALL} primitive type 2 zplane 0", 1e-4, start=-1e-7)
print(f"slowly over an edge, which both triangles claim: within {difference(slow, wall):.1e}")
check(difference(slow, wall) <= 1e-9, "the sphere feels an edge that two triangles claim")

# A roof: the contact turns about the ridge and goes on on the other side. The force falls by a
# tenth on the ridge, in the time of some 100 steps; a second contact with the edge, or a memory
# lost there, changes it by half in one step.
slope = math.radians(4)
roof = list(triangles(lambda x: -abs(x) * math.tan(slope), [-0.02, 0.0, 0.02]))
steps, text = slide("roof", on_mesh("roof", roof), 0.5, -slope, start=-0.002, steps=1600, every=1)
force = [math.hypot(step["fx"] + WEIGHT * math.sin(-slope), step["fz"] + WEIGHT * math.cos(slope)) for step in steps]
jump = max(abs(b - a) for a, b in zip(force, force[1:])) / WEIGHT
print(f"over a roof, to x = {steps[-1]['x']:.4f}: the contact force changes by at most {jump:.1e} of the weight a step")
check(steps[0]["x"] < -0.001 and steps[-1]["x"] > 0.001, "the sphere does not slide over the ridge")
check(jump <= 0.01, "the sphere feels a jump on the ridge")
check("restitute: 0 contacts" in text, "the ridge begins a new contact")
