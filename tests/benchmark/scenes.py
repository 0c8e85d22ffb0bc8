# SPDX-License-Identifier: BSD-3-Clause
"""The impacts of the report on run time, and what became of them."""
import csv
import math
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np


class Scene(NamedTuple):
    """An impact in the numbers of the paper; without delta1 and gamma, a series "g:tau g:tau ..."
    over G_r and T. ez, ex: known to `error`; nan: the reference is made in the run."""

    set: str
    name: str
    chi: float
    psi: float
    delta1: float = math.nan
    gamma: float = math.nan
    g_inf: float = 1
    terms: str = ""
    ez: float = math.nan
    ex: float = math.nan
    error: float = 0

    @property
    def partly_slips(self):
        """A standard solid of the truth table with 0 < psi < psi_c (31)."""
        psi_c = max(1, 2 * self.chi * (1 + self.ez) - self.ez)
        return self.set == "truth" and min(self.delta1, self.gamma) > 0 and 0 < self.psi < psi_c


def rows_of(path):
    """The rows of a CSV file as dictionaries; lines with # are comments."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def numbers(row, *names):
    return [float(row[name]) for name in names]


def steel_ball(data):
    """Polyisobutylene under a sphere of 5 mm, 7800 kg/m^3 and 1 m/s, over G_r and T (24)."""
    terms = [numbers(row, "G_Pa", "tau_s") for row in rows_of(data / "pib_prony.csv")]
    modulus, radius = sum(g for g, _ in terms), 5e-3
    mass = 7800 * 4 / 3 * math.pi * radius**3
    time = (15 * mass * 0.5 / (32 * modulus * math.sqrt(radius))) ** 0.4  # T = d0/v
    return " ".join(f"{g / modulus:.17g}:{tau / time:.17g}" for g, tau in terms)


def standard_scenes(data, quick=False):
    """The sets truth, prony and stiff of docs/records/bench.md."""
    truth = [Scene("truth", f"truth-{i}", *numbers(row, "chi", "psi", "delta1", "gamma"), 1, "",
                   *numbers(row, "ez", "ex"), max(numbers(row, "err_ez", "err_ex")))
             for i, row in enumerate(rows_of(data / "impact_truth.csv"), 1)]
    prony = []
    for row in rows_of(data / "prony_truth.csv"):
        ball = row["g_inf"] == "pib"
        terms = steel_ball(data) if ball else row["terms"].replace(";", " ")
        prony.append(Scene("prony", row["name"].replace(" ", "-"), *numbers(row, "chi", "psi"),
                           g_inf=0 if ball else float(row["g_inf"]), terms=terms,
                           ez=float(row["ez"]), ex=float(row["ex"]), error=float(row["err"])))
    stiff = [Scene("stiff", f"stiff-{delta1:g}-{psi:g}", 7 / 6, psi, delta1, 1e-6)
             for delta1 in (1e-6, 1e-3, 1, 1e3) for psi in (0.5, 1.5)]
    if quick:
        return [truth[i] for i in (0, 1, 2, 3, 9)] + prony[:1] + stiff[4:6]
    return truth + prony + stiff


def map_scenes(quick=False):
    """The places of the stability map."""
    powers = range(-6, 7, 4 if quick else 1)
    return [Scene("map", f"map-{i}-{k}", 7 / 6, 1.5, 10.0**i, 10.0**k)
            for i in powers for k in powers]


def write_scenes(path, scenes):
    """As the program impacts reads them."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("name,chi,psi,delta1,gamma,g_inf,terms\n")
        for s in scenes:
            values = ",".join(f"{v:.17g}" for v in (s.chi, s.psi, s.delta1, s.gamma, s.g_inf))
            file.write(f"{s.name},{values},{s.terms}\n")


def runs_of(path, scenes):
    """The columns of what impacts printed, and of each run: place (of its scene), solved, setting,
    error (the larger of the two), unsure (what the reference is off by), estimate.

    Where a scene has no reference, it is the finest run of sync, which is then no run of a method.
    """
    table = np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")
    runs = SimpleNamespace(**{name: np.copy(table[name]) for name in table.dtype.names})
    places = {s.name: place for place, s in enumerate(scenes)}
    runs.place = np.array([places[name] for name in runs.scene])
    runs.solved = np.isin(runs.outcome, ("solved", "not reached"))
    runs.setting = np.array([f"{e} x {s}" if math.isnan(t) else f"{t:g}" for t, e, s in
                             zip(runs.tolerance, runs.elements_asked, runs.steps_asked)])
    runs.estimate = np.fmax(runs.error_ez, runs.error_ex)
    runs.method = runs.method.astype(object)
    truth = np.array([(s.ez, s.ex, s.error) for s in scenes])
    for place in np.flatnonzero(np.isnan(truth[:, 0])):
        of_sync = np.flatnonzero((runs.place == place) & (runs.method == "sync") & runs.solved)
        if not of_sync.size:
            raise SystemExit(f"{path}: no run of sync is a reference for {scenes[place].name}")
        fine = of_sync[np.argmin(runs.tolerance[of_sync])]
        truth[place] = runs.ez[fine], runs.ex[fine], runs.estimate[fine]
        runs.method[fine] = "reference"
    ez, ex, runs.unsure = truth[runs.place].T
    runs.error = np.where(runs.solved, np.maximum(abs(runs.ez - ez), abs(runs.ex - ex)), np.inf)
    return runs
