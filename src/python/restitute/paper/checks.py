# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that the figures must meet: limits, identities and landmarks that do not come from the
figure itself."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from restitute.paper.charts import loss_tangent, no_rebound_limit


class Check(NamedTuple):
    """A number, and the range that it must be in."""

    what: str
    value: float
    low: float
    high: float

    @property
    def good(self) -> bool:
        """Whether it is; nan is not."""
        return bool(self.low <= self.value <= self.high)

    def __str__(self):
        return (f"{self.what}: {self.value:.6g}, must be in [{self.low:.6g}, {self.high:.6g}]: "
                f"{'ok' if self.good else 'FAILED'}")


def checks(figure: Any) -> list[Check]:
    """All of a figure whose impacts are solved."""
    kind = figure.spec.kind
    if kind == "temperature":
        return []
    of = {"map": _map, "no_slip": _no_slip, "psi_c": _psi_c, "psi_c_error": _convergence,
          "maxwell": _maxwell, "tangent": _tangent, "friction": _friction}
    own = of.get(kind, _kelvin_voigt if figure.curves == 1 else _minimum)
    return [Check(*check) for check in [*_scatter(figure), *own(figure)]]


def _scatter(figure):
    """How far the impacts in SI units lie from what their dimensionless numbers give."""
    pairs, expected = figure.pairs, figure.expected
    solved, rebound = pairs.status >= 0, np.isfinite(pairs.contact_time)
    ez = np.max(abs(pairs.ez - expected.ez)[solved])
    ex = np.max(abs(pairs.ex - expected.ex)[solved & rebound])
    return [("scatter of e_z about the curves", ez, 0, figure.tolerance),
            ("scatter of e_x about the curves", ex, 0, figure.tolerance)]


def _kelvin_voigt(figure):
    """docs/theory.md, section 12: both ends of the curve, with theta = sqrt(32/15) delta1."""
    small, large = np.sqrt(32 / 15) * 1e-3, np.sqrt(32 / 15) * 100
    ez = figure.in_numbers(0.0, [1e-3, 100]).ez
    return [("largest rise of e_z between neighbours", np.max(np.diff(figure.lines.ez[0])), -1, 0),
            ("(1 - e_z)/theta at delta1 = 0.001, in the limit 1.8917", (1 - ez[0]) / small,
             1.87, 1.8918),
            ("e_z over its asymptote (4/(5 theta))^(2/3)/theta at delta1 = 100",
             ez[1] * large / (0.8 / large) ** (2 / 3), 0.97, 1.03)]


def _minimum(figure):
    """The 241 places let the minimum lie 2 % beside its place and 1e-4 above its depth."""
    line = figure.lines.ez[figure.spec.curves.index(0.0825)]
    at = np.argmin(line)
    return [("gamma = 0.0825: least e_z", line[at], 0.1895, 0.1915),
            ("gamma = 0.0825: delta1 of it", figure.line[at], 1.2, 1.5),
            ("gamma = 0.0825: e_z at delta1 = 100", line[-1], 0.95, 1)]


def _reach(figure, gamma):
    """The largest delta1 up to which e_x at psi = 2 stays above 0.45."""
    above = figure.in_numbers(2.0, figure.line, gamma).ex - 0.45
    i = int(np.argmax(above < 0))  # 0 if it stays above
    return np.interp(0, above[[i, i - 1]], figure.line[[i, i - 1]])


def _map(figure):
    gamma = figure.spec.curves[0]
    if gamma == 0:
        return _elastic(figure)
    before, name, least = {0.0825: (0, "Kelvin-Voigt", 1.001),
                           1: (0.0825, "gamma = 0.0825", 1.1)}[gamma]
    return [(f"e_x > 0.45 at psi = 2 up to delta1, more than {name}",
             _reach(figure, gamma) / _reach(figure, before), least, np.inf)]


def _elastic(figure):
    psi = 1.5 + 0.001 * np.arange(801)
    ex = figure.in_numbers(psi, 0.0, np.inf).ex
    simulated = figure.simulated_psi_c(128, np.zeros(1), np.full(1, np.inf))[0]
    return [("elastic: largest e_x", np.max(ex), 0.5965, 0.5975),
            ("elastic: psi of it", psi[np.argmax(ex)], 1.88, 1.90),
            ("elastic: psi_c by simulation with 128 elements, 11/3", simulated,
             11 / 3 - 1e-4, 11 / 3 + 1e-4)]


def _no_slip(figure):
    """At both ends the solid is elastic, and an elastic sphere without slip has one e_x."""
    elastic, *ends = figure.in_numbers(0.0, [0, 1e-4, 1e4], [np.inf, 1, 1]).ex
    return [(f"gamma = 1: e_x at delta1 = {where} less the elastic one", end - elastic, -1e-3, 1e-3)
            for where, end in zip(("1e-4", "1e4"), ends)]


def _psi_c(figure):
    """64 elements of a scheme of first order: 8e-5 where it is worst."""
    return [("largest difference of simulations with 64 elements from (31)",
             np.max(figure.psi_c_error), 0, 1.5e-4)]


def _convergence(figure):
    """Half the difference with twice the elements, at every delta1: the formula is the limit."""
    ratio = figure.psi_c_error[-1] / figure.psi_c_error[-2]
    return [("difference with 64 elements over that with 32, least", np.min(ratio), 0.42, 0.58),
            ("the same, largest", np.max(ratio), 0.42, 0.58)]


def _maxwell(figure):
    """First a value of tests/data/prony_truth.csv; the limit comes from the compression alone."""
    limit = no_rebound_limit()
    result = figure.in_numbers(2.0, np.nan, np.nan, [3, 0.97 * limit, 1.05 * limit])
    return [("e_z at tau = 3 T, in the reference values 0.651750493", result.ez[0],
             0.651750, 0.651751),
            (f"duration over T at 0.97 of the limit {limit:.4f} T, solved by the library",
             result.contact_time[1], np.inf, np.inf),
            ("the same at 1.05", result.contact_time[2], 0, 100)]


def _tangent(figure):
    """Distance in e_z from Kelvin-Voigt at the same loss tangent; its points come in order."""
    x, ez, of = loss_tangent(figure), figure.pairs.ez, figure.curve
    first, known = (of == 0) & np.isfinite(x), (of > 0) & np.isfinite(x)
    inside = known & (x >= x[first][0]) & (x < x[first][-1])
    distance = abs(ez - np.interp(x, x[first], ez[first]))[inside]
    return [("largest distance from Kelvin-Voigt at equal loss tangent", np.max(distance), 0, 0.13),
            ("the same at loss tangents below 0.3", np.max(distance[x[inside] < 0.3]), 0, 0.09),
            ("points left out, since no Kelvin-Voigt impact has their loss tangent",
             np.count_nonzero(known & ~inside), 0, 80)]


def _friction(figure):
    """In slip to the end, psi = 6, e_x is (27); without a dashpot all loss is to friction."""
    ex, lost = figure.in_numbers(6.0, 0.0, np.inf).ex, figure.ledger
    return [("elastic: part to friction at psi = 6 less 1 - e_x^2",
             lost.friction_x[0, -1] - (1 - ex**2), -1e-4, 1e-4),
            ("elastic: largest part to the material",
             np.max(abs(lost.viscous_x + lost.left_x)[0]), 0, 1e-2)]
