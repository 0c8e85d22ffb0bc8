#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Viscoelastic impacts beside published formulae: tables of docs/records/viscoelastic_checks.md.

    viscoelastic_checks.py [--check PAGE] [--figure FILE]

Kelvin-Voigt spheres: the force of Kuwabara and Kono, integrated; the Padé approximant of Müller
and Pöschel for its e_z; the library. A rubber ball: three drops of published constants.
"""
from __future__ import annotations

import argparse
import re
import sys
import warnings
from pathlib import Path

import numpy as np

import restitute
from restitute import Material, errors

DELTA1 = np.array([0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1.0])
#: beta v^(1/5) of Müller and Pöschel over delta1: (3/2) A (5/4)^(2/5), A = sqrt(32/15) delta1.
BETA = 1.5 * 1.25**0.4 * np.sqrt(32 / 15)
#: Drop height (m) and speed at first touch (m/s) of the rubber ball, as published.
DROPS = ((0.2, 1.8254), (0.4, 2.6935), (0.8, 3.8859))
#: G_inf = 2 (C10 + C01) of Mooney and Rivlin; a term of 10 MPa that decays at 920/s.
RUBBER = Material.prony([1 / 920], [10e6], 2 * (0.598e6 + 0.1495e6), poisson_ratio=0.49)
BALL = dict(radius=0.03, density=1150, friction=0)


def pade(beta):
    """e_z of Kuwabara and Kono: Müller and Pöschel, arXiv:1102.5247, with v* the root of beta."""
    v = np.sqrt(beta)
    return (1 + 0.501086 * v) / (1 + v * (0.501086 + v * (1.15345 + v * (0.577977 + v * 0.532178))))


def kuwabara_kono(delta1, step=2e-4):
    """The same by integration: d'' = -(5/4)(d^(3/2) + (3/2) A d^(1/2) d'), until the force would
    become attractive; midpoint rule, all delta1 at once."""
    def force(d, v):
        d = np.maximum(d, 0)
        return 1.25 * (d**1.5 + 1.5 * a * np.sqrt(d) * v)

    a = np.sqrt(32 / 15) * delta1
    d, v, after = np.zeros_like(a), np.ones_like(a), np.full_like(a, np.nan)
    while np.any(np.isnan(after)):
        half_v = v - step / 2 * force(d, v)
        d, v = d + step * half_v, v - step * force(d + step / 2 * v, half_v)
        over = np.isnan(after) & (v < 0) & (force(d, v) <= 0)
        after = np.where(over, -v, after)
    return after


def library(delta1):
    return restitute.pair(psi=0, delta1=delta1, gamma=0.0, method="sync", tolerance=1e-6).ez


def rubber(speed, material=RUBBER):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.ModelLimitWarning)
        return restitute.pair(material, normal_speed=speed, method="sync", tolerance=1e-6, **BALL)


def rows():
    """Lines of the page's tables."""
    formula, ode, solid = pade(BETA * DELTA1), kuwabara_kono(DELTA1), library(DELTA1)
    for delta1, *numbers in zip(DELTA1, formula, ode, solid):
        yield f"| {delta1:g} | " + " | ".join(f"{number:.4f}" for number in numbers) + " |"
    for height, speed in DROPS:
        ball = rubber(speed)
        known = restitute.impact.SOFT_CONTACT_ERROR * ball.radius_ratio
        yield (f"| {height:g} | {speed:.4f} | {ball.ez:.3f} +- {known:.2f} | "
               f"{1e3 * ball.contact_time:.2f} | {ball.radius_ratio:.2f} |")


def draw(path):
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 11,
                         "grid.color": "#dddddd"})
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    delta1 = np.geomspace(0.005, 2, 60)
    axes[0].semilogx(delta1, pade(BETA * delta1), "--", color="#c4451c", linewidth=2,
                     label="Müller and Pöschel, formula")
    axes[0].semilogx(DELTA1, kuwabara_kono(DELTA1), "o", color="#c4451c", markerfacecolor="white",
                     label="Kuwabara and Kono, integrated")
    axes[0].semilogx(delta1, library(delta1), color="#1f6f8b", linewidth=2,
                     label="Kelvin-Voigt solid, restitute")
    axes[0].set(xlabel="delta1", ylabel="e_z", ylim=(0, 1.02))
    axes[0].legend(loc="lower left", fontsize=10)
    speed = np.geomspace(0.01, 5, 40)
    ball = rubber(speed)
    known = restitute.impact.SOFT_CONTACT_ERROR * ball.radius_ratio
    axes[1].fill_between(speed, ball.ez - known, ball.ez + known, color="#1f6f8b", alpha=0.2,
                         linewidth=0, label="known to (soft sphere)")
    axes[1].semilogx(speed, ball.ez, color="#1f6f8b", linewidth=2, label="rubber ball, restitute")
    axes[1].semilogx([v for _, v in DROPS], rubber(np.array([v for _, v in DROPS])).ez, "s",
                     color="#c4451c", label="the three drops, predicted")
    axes[1].set(xlabel="speed, m/s", ylabel="e_z", ylim=(0, 1.02))
    axes[1].legend(loc="lower left", fontsize=10)
    for axis in axes:
        axis.grid()
    figure.savefig(path, metadata={"Date": None})


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--check", metavar="PAGE")
    words.add_argument("--figure", metavar="FILE")
    asked = words.parse_args()
    computed = list(rows())
    if asked.figure:
        draw(asked.figure)
    if not asked.check:
        print(*computed, sep="\n")
        return 0
    page = Path(asked.check).read_text()
    recorded = [line for line in page.splitlines() if re.match(r"\| \d", line)]
    return int(recorded != computed)


if __name__ == "__main__":
    sys.exit(main())
