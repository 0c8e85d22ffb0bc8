# SPDX-License-Identifier: BSD-3-Clause
"""Boundary elements beside `sync` on random impacts: bem_campaign.py DOCS [IMPACTS [GRID ...]]

Fills the table of the page records/bem.md in DOCS and draws figures/bem.svg there. A grid of
128 x 128 cells is 128; 256 gets a fifth of the impacts. Needs the package restitute.
"""
import sys
import textwrap
import warnings
from pathlib import Path

import figures
import numpy as np
from report import Report, power, short, table

import restitute

SEED, LIMIT, NO_REBOUND = 2017, 0.002, 1
KINDS = ("elastic", "standard solid", "Prony series")


def draw(count):
    """Solids over G_r = 1 Pa and T = 1 s, kinds, chi and psi: all uniform in the logarithm, a fifth
    of the series without equilibrium modulus."""
    rng = np.random.default_rng(SEED)

    def between(low, high, size=None):
        return np.exp(rng.uniform(np.log(low), np.log(high), size))

    kinds = rng.choice(3, count, p=[1 / 6, 1 / 2, 1 / 3])
    chi, psi = between(1 / 3, 4, count), between(0.05, 10, count)
    solids = np.empty(count, object)
    for i, kind in enumerate(kinds):
        terms = rng.integers(2, 7)
        delta1, gamma = between(1e-3, 100), between(1e-3, 200)
        tau, g = between(1e-3, 100, terms), between(0.05, 5, terms)
        rigid = float(rng.uniform() >= 0.2)
        solids[i] = (restitute.Material.elastic(1) if kind == 0 else
                     restitute.Material.standard_solid(1, 1 / gamma, np.sqrt(32 / 15) * delta1)
                     if kind == 1 else
                     restitute.Material.prony(tau, g, rigid))
    return solids, kinds, chi, psi


def solve(solids, chi, psi, **options):
    """A sphere of 1 m at 1 m/s with T = 1 s and G_r = 1 Pa: m = 64/15 (24) at nu = 1/2. chi by its
    inertia, psi = U/(1.5 friction v)."""
    mass = 64 / 15
    return restitute.pair(solids, radius=1, mass=mass, friction=0.3, normal_speed=1,
                          inertia=mass / np.maximum(3 * chi - 1, 1e-300),
                          tangential_speed=0.45 * psi, threads=2, on_error="nan", **options)


def rows_of(grid, kinds, sync, bem):
    """Lines of the table: absolute differences by solid."""
    failed = (sync.status < 0) | (bem.status < 0)
    for kind, name in enumerate((*KINDS, "all")):
        if kind < 3 and grid != 128:
            continue
        chosen = (kinds == kind) | (kind == 3)
        cells = [f"{grid} x {grid}", name, np.sum(chosen), np.sum(chosen & failed)]
        for value in ("ez", "ex"):
            difference = abs(getattr(bem, value) - getattr(sync, value))[chosen & ~failed]
            cells += [power(v) for v in np.quantile(difference, (0.5, 0.95, 1))]
        yield cells


def remark(grid, sync, bem):
    """Estimates, ends that differ, and the aim."""
    differences = np.abs([bem.ez - sync.ez, bem.ex - sync.ex])
    ratios = np.nanmax(differences / (np.array([bem.error_ez, bem.error_ex]) + 1e-12), axis=1)
    different = np.sum((sync.status == NO_REBOUND) != (bem.status == NO_REBOUND))
    aim = "all differences are" if np.nanmax(differences) <= LIMIT else "NOT all differences are"
    return (f"- {grid} x {grid}: up to {short(ratios[0])} of the estimate in e_z, "
            f"{short(ratios[1])} in e_x; {different} with a rebound in one only; "
            f"{aim} below {LIMIT}")


def main(docs, count, grids):
    warnings.simplefilter("ignore")  # limits of the model: such a sphere would be too soft
    solids, kinds, chi, psi = draw(count)
    lines, remarks = [], []
    for grid in grids:
        n = count // 5 if grid == 256 else count
        some = solids[:n], chi[:n], psi[:n]
        sync = solve(*some, method="sync", tolerance=1e-6)
        bem = solve(*some, method="bem", elements=int((grid / 2 - 1.5) / 1.03))
        lines += rows_of(grid, kinds[:n], sync, bem)
        remarks += textwrap.wrap(remark(grid, sync, bem), 100, subsequent_indent="  ")
        if grid == 128:
            figures.differences(psi, kinds, bem.ez - sync.ez, bem.ex - sync.ex, KINDS, LIMIT,
                                docs / "figures/bem.svg")
    head = ["grid", "solid", "impacts", "failed", "e_z median", "95 %", "largest", "e_x median",
            "95 %", "largest"]
    report = Report(None, Path("."), docs)
    report.put("records/bem.md", "campaign", [*table(head, lines), "", *remarks])


if __name__ == "__main__":
    docs, count, *grids = [*sys.argv[1:], "200"][:2] + sys.argv[3:]
    main(Path(docs), int(count), [int(grid) for grid in grids] or (64, 128, 256))
