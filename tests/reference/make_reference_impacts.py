#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes tests/data/reference_impacts.csv (docs/reference_impacts.md):

    PYTHONPATH=build/release/python python3 make_reference_impacts.py [--count 2000] [--output FILE]

Impacts are drawn from a fixed seed and solved by the method sync with 768 points. Those that the
method cvode confirms within 1e-8 are kept. What was refused, and why, is printed. Needs the
component cvode; 15 minutes of one processor.
"""
import argparse
import csv
import warnings
from collections import Counter
from types import SimpleNamespace

import numpy as np
import reference_set
from reference_set import TERMS, part

from restitute import impact

SEED = 40
AGREE = 1e-8
# Of cvode, whose error is below AGREE in nine of ten impacts with the first, at a fifth of the time
# of the last, which chooses the number of elements itself. Adams' formulas are the more precise
# ones where the solid lets them be stable.
CVODE = ({"method": "cvode", "elements": 1024}, {"method": "cvode-adams", "elements": 1024},
         {"method": "cvode", "time_limit": 10})
UNLIMITED = {"time_limit": np.inf, "max_work": np.inf, "dundurs_limit": 0.5}
KINDS = {"elastic": 0.1, "standard solid": 0.25, "Kelvin-Voigt": 0.15, "Maxwell": 0.1,
         "Prony": 0.4}
PARTNERS = {"rigid wall": 0.25, "wall": 0.15, "equal sphere": 0.3, "unlike sphere": 0.3}
# Of sync; solids with terms of very different times need too many panels with more.
SYNC_POINTS = (768, 384)
HEAD_ON, SIGNIFICANT, BATCH = 0.04, 6, 50
PAIRS = ("ez", "ex", "error_ez", "error_ex", "contact_time", "max_indentation", "radius_ratio",
         "flags", "status")
NO_REBOUND = 1  # RESTITUTE_NO_REBOUND
SLIP = ("none", "stick first", "gross slip then stick", "gross slip")


def rounded(value):
    """To six significant digits, so that the file has short numbers and all of each."""
    return float(f"{value:.{SIGNIFICANT - 1}e}")


def log_uniform(random, low, high):
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def draw_solid(random, kind):
    """G_inf, eta_inf, [(tau, G), ...] in units of G_r and T; G_r is G_inf or, if 0, sum G."""
    if kind == "elastic":
        return 1.0, 0.0, []
    if kind == "standard solid":
        delta1, gamma = log_uniform(random, 1e-3, 30), log_uniform(random, 1e-2, 1e2)
        return 1.0, 0.0, [(gamma * np.sqrt(32 / 15) * delta1, 1 / gamma)]
    if kind == "Kelvin-Voigt":
        return 1.0, np.sqrt(32 / 15) * log_uniform(random, 1e-3, 10), []
    if kind == "Maxwell":
        return 0.0, 0.0, [(log_uniform(random, 0.5, 100), 1.0)]
    number, fluid = int(random.integers(2, TERMS + 1)), random.random() < 1 / 3
    tau = sorted(log_uniform(random, 1e-3, 1e2) for _ in range(number))
    moduli = np.array([log_uniform(random, 0.1, 1) for _ in range(number)])
    moduli *= (1 if fluid else log_uniform(random, 0.1, 30)) / moduli.sum()
    eta = log_uniform(random, 1e-3, 1) if random.random() < 0.2 else 0.0
    return (0.0 if fluid else 1.0), eta, list(zip(tau, moduli))


def draw_bodies(random, partner):
    row = {"deforming_bodies": 1 if partner == "rigid wall" else 2,
           "radius1_m": rounded(log_uniform(random, 1e-4, 1e-1)),
           "density1_kg_m3": rounded(log_uniform(random, 500, 8000)),
           "radius2_m": np.inf, "density2_kg_m3": np.inf}
    if partner.endswith("sphere"):
        ratio, heavier = ((1, 1) if partner == "equal sphere" else
                          (log_uniform(random, 0.2, 5), log_uniform(random, 0.5, 2)))
        row["radius2_m"] = rounded(ratio * row["radius1_m"])
        row["density2_kg_m3"] = rounded(heavier * row["density1_kg_m3"])
    row["poisson_ratio"] = 0.5 if random.random() < 0.3 else round(random.uniform(0.2, 0.5), 3)
    row["friction"] = round(random.uniform(0.05, 1), 3)
    return row


def draw(random):
    """One row with its bodies, its solid and its motion."""
    kind, partner = (str(random.choice(list(shares), p=list(shares.values())))
                     for shares in (KINDS, PARTNERS))
    row = {"solid": kind, "partner": partner} | draw_bodies(random, partner)
    angle = 0.0 if random.random() < HEAD_ON else np.radians(random.uniform(0, 85))
    # The sliding distance, about tan(angle) d0, must stay below 0.3 of the contact radius
    contact = log_uniform(random, 3e-3, 0.1 / max(1, np.tan(angle)))
    modulus = log_uniform(random, 1e5, 1e11)
    radius = 1 / (1 / row["radius1_m"] + 1 / row["radius2_m"])
    speed = np.sqrt(contact**5 * 32 * modulus / row["deforming_bodies"] * radius**3
                    / (15 * reference_set.reduced_mass(row) * (1 - row["poisson_ratio"])))  # (24)
    time = (contact * radius) ** 2 / radius / speed
    row["normal_speed_m_s"] = rounded(speed)
    row["tangential_speed_m_s"] = rounded(speed * np.tan(angle))
    spins = random.random(2) < (0.4, 0.5)
    whole = speed / np.cos(angle)
    spins[1] &= spins[0] and partner.endswith("sphere")
    turns = random.uniform(-2, 2, 2) * whole * spins
    row["spin1_rad_s"] = rounded(turns[0] / row["radius1_m"]) + 0.0
    row["spin2_rad_s"] = rounded(turns[1] / row["radius2_m"]) + 0.0
    g_inf, eta, terms = draw_solid(random, kind)
    row["G_inf_Pa"], row["eta_inf_Pa_s"] = rounded(g_inf * modulus), rounded(eta * modulus * time)
    for k in range(TERMS):
        tau, g = terms[k] if k < len(terms) else (np.nan, np.nan)
        row[f"tau_{k + 1}_s"], row[f"G_{k + 1}_Pa"] = rounded(tau * time), rounded(g * modulus)
    return row


def columns_of(rows):
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}



def solve(set_, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what strains the model is refused
        return impact.solve(reference_set.impacts(set_), on_error="nan", **settings)


def differences(pairs, ez, ex):
    return np.abs(pairs.ez - ez), np.abs(pairs.ex - ex)


def confirm(set_, first):
    """e_z, e_x and contact time by cvode, with the next settings where the pairs differ."""
    ez, ex, time = np.full((3, len(set_["impact"])), np.nan)
    again = np.arange(len(ez))
    for settings in CVODE:
        second = solve(part(set_, again), tolerance=1e-8, **UNLIMITED | settings)
        ez[again], ex[again], time[again] = second.ez, second.ex, second.contact_time
        again = np.flatnonzero(~(np.maximum(*differences(first, ez, ex)) <= AGREE))
        if len(again) == 0:
            break
    return ez, ex, time


def precise(set_):
    """What sync finds, with the number of points with which it is best known."""
    found = None
    for points in SYNC_POINTS:
        pairs = solve(set_, method="sync", elements=points, tolerance=1e-8, **UNLIMITED)
        now = SimpleNamespace(**{name: getattr(pairs, name) for name in PAIRS})
        if found:
            worse = ~(worst_error(now) < worst_error(found))
            now = SimpleNamespace(**{name: np.where(worse, getattr(found, name), getattr(now, name))
                                     for name in PAIRS})
        found = now
    return found


def worst_error(pairs):
    return np.maximum(pairs.error_ez, pairs.error_ex)


def reasons(pairs):
    """Of each impact why it is refused, or an empty text."""
    why = np.full(len(pairs.ez), "", object)
    why[worst_error(pairs) > AGREE / 10] = "error estimate"
    why[pairs.flags != 0] = "limit of the model"
    why[pairs.status == NO_REBOUND] = "never rebounds"
    why[pairs.status < 0] = "not solved"
    return why


def results(set_, pairs, second):
    """All other columns of impacts that are kept."""
    numbers = reference_set.impacts(set_).numbers()
    psi_c = 2 * numbers.chi * (1 + pairs.ez) - pairs.ez
    still = reference_set.sliding(set_) == 0
    slip = np.select([still, numbers.psi <= 1, numbers.psi < psi_c], SLIP[:3], SLIP[3])
    ez, ex = pairs.ez, np.where(still, np.nan, pairs.ex)
    differs = differences(pairs, *second[:2])
    return {"slip": slip, "angle_deg": np.degrees(np.arctan2(set_["tangential_speed_m_s"],
                                                             set_["normal_speed_m_s"])),
            "chi": numbers.chi, "psi": numbers.psi, "psi_c": psi_c, "delta1": numbers.delta1,
            "gamma": numbers.gamma, "radius_m": numbers.radius, "mass_kg": numbers.mass,
            "G_r_Pa": numbers.modulus, "d0_m": numbers.length_z, "a_el_m": numbers.length_x,
            "T_s": numbers.time, "ez": ez, "ex": ex, "contact_time_s": pairs.contact_time,
            "max_indentation_m": pairs.max_indentation,
            "contact_radius_ratio": pairs.radius_ratio,
            "kinetic_energy_ratio": reference_set.energy_ratio(set_, ez, np.where(still, 1, ex)),
            "error_ez": pairs.error_ez, "error_ex": np.where(still, np.nan, pairs.error_ex),
            "difference_ez": differs[0], "difference_ex": np.where(still, np.nan, differs[1]),
            "difference_contact_time": np.abs(second[2] / pairs.contact_time - 1)}


def examine(set_):
    """The impacts that are kept, with all columns; and of each why it is refused."""
    pairs = precise(set_)
    why = reasons(pairs)
    kept = np.flatnonzero(why == "")
    some, pairs = part(set_, kept), SimpleNamespace(**part(vars(pairs), kept))
    second = confirm(some, pairs)
    agrees = np.maximum(*differences(pairs, *second[:2])) <= AGREE
    why[kept[~agrees]] = np.where(np.isnan(second[0][~agrees]), "cvode refuses", "cvode differs")
    return part(some | results(some, pairs, second), agrees), why


def text(name, value):
    if name == "impact":
        return f"{value:.0f}"
    if name in reference_set.CERTAINTY:
        return f"{value:.1e}"
    if name in ("ez", "ex", "kinetic_energy_ratio"):
        return f"{value:.12f}"
    drawn = name in reference_set.BODIES + reference_set.SERIES + reference_set.TEXTS
    return str(value) if isinstance(value, str) else f"{value:.{SIGNIFICANT if drawn else 12}g}"


def write(path, sets, count):
    with open(path, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(reference_set.COLUMNS)
        number = 0
        for set_ in sets:
            for i in range(len(set_["ez"])):
                number += 1
                if number <= count:
                    set_["impact"][i] = number
                    out.writerow(text(name, set_[name][i]) for name in reference_set.COLUMNS)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--output", default=reference_set.FILE)
    asked = parser.parse_args()
    random = np.random.default_rng(SEED)
    kept, counts, found = [], Counter(), 0
    while found < asked.count:
        set_ = columns_of([draw(random) | {"impact": 0} for _ in range(BATCH)])
        good, why = examine(set_)
        kept.append(good)
        found += len(good["ez"])
        counts.update(zip(set_["solid"], why))
        print(f"{found} impacts", flush=True)
    for (solid, why), number in sorted(counts.items()):
        print(f"{solid:15} {why or 'kept':20} {number}")
    write(asked.output, kept, asked.count)


if __name__ == "__main__":
    main()
