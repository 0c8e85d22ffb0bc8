# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that run DEM codes share: rows of reference_impacts.csv as two bodies in a DEM
code, and dampings that give a row's e_z. Without NumPy, which the Python of LAMMPS may lack."""
import copy
import csv
import math
from pathlib import Path

FILE = Path(__file__).parents[1] / "data" / "reference_impacts.csv"
ELASTIC_TIME = 2.9432751843  # contact time of the elastic impact over T
STEPS = 1000  # in that time


class Impact:
    """One row: x along the sliding, z from sphere 1 into its partner at z = 0."""

    def __init__(self, row):
        self.row = row
        self.wall = math.isinf(row["radius2_m"])
        self.number = int(row["impact"])
        self.radii = [row["radius1_m"]] + [row["radius2_m"]] * (not self.wall)
        self.densities = [row["density1_kg_m3"]] + [row["density2_kg_m3"]] * (not self.wall)
        self.spins = [row["spin1_rad_s"]] + [row["spin2_rad_s"]] * (not self.wall)
        self.velocities = [(row["tangential_speed_m_s"], row["normal_speed_m_s"]), (0.0, 0.0)]
        gap = 1e-3 * row["d0_m"]
        self.places = [-self.radii[0] - gap] + ([] if self.wall else [self.radii[1]])
        self.dt = ELASTIC_TIME * row["T_s"] / STEPS
        self.nu, self.friction, self.ez = row["poisson_ratio"], row["friction"], row["ez"]
        # E of each of two deformable bodies with the pair's modulus G_r, 1/E' = 2 (1 - nu^2)/E
        self.youngs = 4 * row["G_r_Pa"] * (1 + self.nu)

    def scaled(self, factor):
        """The same impact with another unit of length; stiffnesses in N/m stay."""
        same = copy.copy(self)
        same.radii = [factor * radius for radius in self.radii]
        same.places = [factor * place for place in self.places]
        same.densities = [density / factor**3 for density in self.densities]
        same.velocities = [(factor * x, factor * z) for x, z in self.velocities]
        return same

    def separated(self, places):
        """Whether the bodies have parted, from their z."""
        return places[0] + self.radii[0] < (0 if self.wall else places[1] - self.radii[1])

    def pair(self, velocities, spins):
        """e_z and e_x of velocities (x, z) and spins after the impact."""
        def relative(v, w):
            second = (0.0, 0.0) if self.wall else v[1]
            turn = sum(r * s for r, s in zip(self.radii, w))
            return v[0][0] - second[0] + turn, v[0][1] - second[1]
        before, after = relative(self.velocities, self.spins), relative(velocities, spins)
        return -after[1] / before[1], -after[0] / before[0] if before[0] else math.nan


def impacts(path=FILE):
    with open(path, newline="") as file:
        return [Impact({name: value if name in ("solid", "partner", "slip") else float(value)
                        for name, value in row.items()}) for row in csv.DictReader(file)]


def kuwabara_kono(beta):
    """e_z of D'' = -(5/4) D^(3/2) - beta sqrt(D) D' up to D = 0, in units of d0 and T."""
    def rates(depth, velocity):
        root = math.sqrt(max(depth, 0))
        return velocity, -1.25 * root**3 - beta * root * velocity
    depth, velocity, h = 0.0, 1.0, 2e-3
    while depth > 0 or velocity > 0:
        last = velocity
        k1 = rates(depth, velocity)
        k2 = rates(depth + h / 2 * k1[0], velocity + h / 2 * k1[1])
        k3 = rates(depth + h / 2 * k2[0], velocity + h / 2 * k2[1])
        k4 = rates(depth + h * k3[0], velocity + h * k3[1])
        before = depth
        depth += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        velocity += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
    return -(last + (velocity - last) * before / (before - depth))


def damping_of():
    """A function: the beta of `kuwabara_kono` for e_z, by interpolation in a table."""
    betas = [0.0] + [0.003 * 1.12**k for k in range(66)]
    table = [(kuwabara_kono(beta), beta) for beta in betas]

    def beta(ez):
        for (high, low_beta), (low, high_beta) in zip(table, table[1:]):
            if low <= ez <= high:
                return low_beta + (high_beta - low_beta) * (high - ez) / (high - low)
        return math.nan if ez < table[-1][0] else 0.0
    return beta
