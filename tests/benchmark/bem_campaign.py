# SPDX-License-Identifier: BSD-3-Clause
"""Boundary elements beside `sync` on random impacts: bem_campaign.py DOCS [IMPACTS [GRID ...]]

Fills the table of DOCS/records/bem.md and draws DOCS/figures/bem.svg. A grid of 128 x 128 cells is
128; 256 gets a fifth of the impacts. Needs the package restitute.
"""
import sys
import warnings
from pathlib import Path

import numpy as np

import figures
import restitute
from report import Report, power, short, table

SEED, LIMIT = 2017, 0.002
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
                     restitute.Material.standard_solid(1, 1 / gamma, np.sqrt(32 / 15) * delta1) if kind == 1 else
                     restitute.Material.prony(tau, g, rigid))
    return solids, kinds, chi, psi


def solve(solids, chi, psi, **options):
    """A sphere of 1 m at 1 m/s with T = 1 s and G_r = 1 Pa: m = 64/15 (24) at nu = 1/2. chi by its
    inertia, psi = U/(1.5 friction v)."""
    mass = 64 / 15
    return restitute.pair(solids, radius=1, mass=mass, inertia=mass / np.maximum(3 * chi - 1, 1e-300), friction=0.3,
                          normal_speed=1, tangential_speed=0.45 * psi, threads=2, on_error="nan", **options)


def rows_of(grid, kinds, sync, bem):
    """Lines of the table: absolute differences by solid."""
    failed = (sync.status < 0) | (bem.status < 0)
    for kind in [*range(3), 3] if grid == 128 else [3]:
        chosen = (kinds == kind) | (kind == 3)
        cells = [f"{grid} x {grid}", (*KINDS, "all")[kind], str(np.sum(chosen)), str(np.sum(chosen & failed))]
        for name in ("ez", "ex"):
            difference = np.abs(getattr(bem, name) - getattr(sync, name))[chosen & ~failed]
            cells += [power(v) if v else "0" for v in np.quantile(difference, (0.5, 0.95, 1))]
        yield cells


def main(docs, count=200, grids=(64, 128, 256)):
    warnings.simplefilter("ignore")  # limits of the model: such a sphere would be too soft
    solids, kinds, chi, psi = draw(count)
    sync, lines, said, drawn = None, [], [], None
    for grid in grids:
        n = count // 5 if grid == 256 else count
        sync = solve(solids[:n], chi[:n], psi[:n], method="sync", tolerance=1e-6)
        bem = solve(solids[:n], chi[:n], psi[:n], method="bem", elements=int((grid / 2 - 1.5) / 1.03))
        lines += rows_of(grid, kinds[:n], sync, bem)
        ratios = [np.nanmax(np.abs(getattr(bem, e) - getattr(sync, e)) / (getattr(bem, f"error_{e}") + 1e-12)) for e in ("ez", "ex")]
        different = np.sum((sync.status == 1) != (bem.status == 1))
        largest = np.nanmax([np.abs(bem.ez - sync.ez), np.abs(bem.ex - sync.ex)])
        said.append(f"- {grid} x {grid}: differences over estimates up to {short(ratios[0])} in e_z and {short(ratios[1])} "
                    f"in e_x; {different} with a rebound in one method only; {'all' if largest <= LIMIT else 'NOT all'} "
                    f"differences below {LIMIT}.")
        if drawn is None or grid == 128:
            drawn = (psi[:n], kinds[:n], bem.ez - sync.ez, bem.ex - sync.ex)
    report = Report(None, Path("."), docs, False, False)
    report.put("records/bem.md", "campaign", table(["grid", "solid", "impacts", "failed", "e_z median", "95 %", "largest",
                                                    "e_x median", "95 %", "largest"], lines) + ["", *said])
    figures.differences(*drawn, KINDS, LIMIT, docs / "figures/bem.svg")


if __name__ == "__main__":
    docs, count, *grids = [*sys.argv[1:], "200"][:2] + sys.argv[3:]
    main(Path(docs), int(count), [int(grid) for grid in grids] or (64, 128, 256))
