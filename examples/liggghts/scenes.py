# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes in LIGGGHTS, each a run of the program. From the environment: PLUGIN
(librestitute_liggghts.so)."""
import os
import subprocess

from answers import MATERIALS, check, library_pairs, material  # noqa: F401

PLUGIN = os.environ["PLUGIN"]
MOTION = "id x y z vx vy vz omegax omegay omegaz fx fy fz"


def liggghts(lines, ranks=1, plugin=PLUGIN, fails=False):
    """What LIGGGHTS prints for an input script."""
    command = ["liggghts", "-log", "none", "-in", "scene.in"]
    if ranks > 1:  # tests are no place to look for more cores
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] + command
    with open("scene.in", "w") as out:
        out.write(lines)
    environment = os.environ | {"LD_PRELOAD": f"{os.environ.get('LD_PRELOAD', '')}:{plugin}", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, encoding="latin-1", timeout=300)
    check((done.returncode != 0) == fails, f"exit status {done.returncode}: {done.stdout[-3000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr


def box(types=2, half_width=0.5):
    """A box of 1 m, with neighbor lists for few large histories."""
    w = half_width
    return f"""
        units si
        atom_style granular
        atom_modify map array sort 0 0
        boundary f f f
        newton off
        communicate single vel yes
        region box block {-w} {w} {-w} {w} {-w} {w} units box
        create_box {types} box
        neighbor 0.001 bin
        neigh_modify delay 0 page 80000 one 100
        """


def law(words, types=""):
    return f'variable restitute{types} string "{words}"\n'


STYLE = """
    pair_style gran model restitute tangential restitute
    pair_coeff * *
    """
WALL = "wall/gran model restitute tangential restitute"


def sphere(tag, x, v, omega=(0, 0, 0), radius=0.005, density=1000, kind=1):
    return f"""
        create_atoms {kind} single {x[0]!r} {x[1]!r} {x[2]!r} units box
        set atom {tag} diameter {2 * radius!r} density {density!r}
        set atom {tag} vx {v[0]!r} vy {v[1]!r} vz {v[2]!r}
        set atom {tag} omegax {omega[0]!r} omegay {omega[1]!r} omegaz {omega[2]!r}
        """


def mesh(name, triangles):
    """Writes NAME.stl in the current directory."""
    with open(name + ".stl", "w") as out:
        out.write(f"solid {name}\n")
        for triangle in triangles:
            corners = "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in triangle)
            out.write(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        out.write(f"endsolid {name}\n")
    return name + ".stl"


def dump(name, every, what=MOTION):
    numbers = " ".join(["%d"] + ["%.17g"] * (len(what.split()) - 1))
    return f'dump {name} all custom {every} {name}.txt {what}\ndump_modify {name} sort id format "{numbers}"\n'


def motions(name, what=MOTION):
    """Of each step in a dump a dictionary: of each tag the numbers by name."""
    steps, columns = [], what.split()
    with open(name + ".txt") as file:
        for line in file:
            if line.startswith("ITEM: TIMESTEP"):
                steps.append({})
            words = line.split()
            if len(words) == len(columns) and not line.startswith("ITEM"):
                numbers = dict(zip(columns, map(float, words)))
                steps[-1][int(numbers["id"])] = numbers
    return steps
