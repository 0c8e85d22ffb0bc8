# SPDX-License-Identifier: BSD-3-Clause
"""The file tests/data/reference_impacts.csv: its columns, its mechanics, its impacts. A set is a
dictionary of arrays, one for each column."""
import csv
from pathlib import Path

import numpy as np

FILE = Path(__file__).parents[1] / "data" / "reference_impacts.csv"
TERMS = 6

TEXTS = ("solid", "partner", "slip")
BODIES = ("deforming_bodies", "radius1_m", "radius2_m", "density1_kg_m3", "density2_kg_m3",
          "poisson_ratio", "friction", "normal_speed_m_s", "tangential_speed_m_s", "spin1_rad_s",
          "spin2_rad_s")
SERIES = ("G_inf_Pa", "eta_inf_Pa_s", *(f"{name}_{k}_{unit}" for k in range(1, TERMS + 1)
                                       for name, unit in (("tau", "s"), ("G", "Pa"))))
NUMBERS = ("angle_deg", "chi", "psi", "psi_c", "delta1", "gamma", "radius_m", "mass_kg", "G_r_Pa",
           "d0_m", "a_el_m", "T_s")
RESULTS = ("ez", "ex", "contact_time_s", "max_indentation_m", "contact_radius_ratio",
           "kinetic_energy_ratio")
CERTAINTY = ("error_ez", "error_ex", "difference_ez", "difference_ex",
             "difference_contact_time")
COLUMNS = ("impact", *TEXTS, *BODIES, *SERIES, *NUMBERS, *RESULTS, *CERTAINTY)


def read(path=FILE):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([row[name] for row in rows], None if name in TEXTS else float)
            for name in COLUMNS}


def part(set_, chosen):
    return {name: column[chosen] for name, column in set_.items()}


def masses(set_):
    """Of the solid spheres 1 and 2, kg; of a wall infinite."""
    return tuple(4 / 3 * np.pi * set_[f"density{i}_kg_m3"] * set_[f"radius{i}_m"] ** 3
                 for i in (1, 2))


def reduced_mass(set_):
    return 1 / sum(1 / mass for mass in masses(set_))


def mobility(set_):
    """1/m1 + R1^2/J1 + 1/m2 + R2^2/J2, 1/kg."""
    return sum(3.5 / mass for mass in masses(set_))


def turning(set_):
    """Velocity of the surface of the spheres at the contact by their spins, m/s."""
    radius2 = np.where(np.isinf(set_["radius2_m"]), 0, set_["radius2_m"])
    return set_["radius1_m"] * set_["spin1_rad_s"], radius2 * set_["spin2_rad_s"]


def sliding(set_):
    """Velocity of the contact point along x, 1 minus 2, m/s."""
    return set_["tangential_speed_m_s"] + sum(turning(set_))


def energy_in(set_):
    """Kinetic energy before the impact in the frame of the centre of mass, J."""
    square = set_["normal_speed_m_s"] ** 2 + set_["tangential_speed_m_s"] ** 2
    spins = sum(np.where(np.isinf(mass), 0, mass) * turn**2
                for mass, turn in zip(masses(set_), turning(set_)))
    return reduced_mass(set_) * square / 2 + spins / 5


def energy_ratio(set_, ez, ex):
    """Kinetic energy after the impact over that before, in the frame of the centre of mass."""
    normal = reduced_mass(set_) * set_["normal_speed_m_s"] ** 2 * (1 - ez**2) / 2
    tangential = sliding(set_) ** 2 / mobility(set_) * (1 - ex**2) / 2
    return 1 - (normal + tangential) / energy_in(set_)


def materials(set_):
    """The solids, an array of Materials."""
    import restitute  # not needed by scripts that run DEM codes

    made = np.empty(len(set_["impact"]), object)
    for i in range(len(made)):
        terms = [k for k in range(1, TERMS + 1) if not np.isnan(set_[f"tau_{k}_s"][i])]
        tau, modulus = ([set_[name][i] for name in names] for names in (
            [f"tau_{k}_s" for k in terms], [f"G_{k}_Pa" for k in terms]))
        made[i] = restitute.Material.prony(tau, modulus, set_["G_inf_Pa"][i],
                                           set_["eta_inf_Pa_s"][i], set_["poisson_ratio"][i])
    return made


def impacts(set_):
    """The impacts of the package."""
    from restitute import Impacts

    partner = np.where(set_["deforming_bodies"] == 2, "same", "rigid")
    return Impacts(materials(set_), partner=partner.astype(object), radius=set_["radius1_m"],
                   density=set_["density1_kg_m3"], radius2=set_["radius2_m"],
                   density2=set_["density2_kg_m3"], friction=set_["friction"],
                   normal_speed=set_["normal_speed_m_s"],
                   tangential_speed=set_["tangential_speed_m_s"], spin=set_["spin1_rad_s"],
                   spin2=set_["spin2_rad_s"])
