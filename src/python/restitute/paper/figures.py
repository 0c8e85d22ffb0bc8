# SPDX-License-Identifier: BSD-3-Clause
"""The figures: which impacts each one has, and what its lines are."""
from __future__ import annotations

import math
import warnings
from functools import cached_property
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from restitute import errors
from restitute.paper import impacts
from restitute.paper.slip import critical_psi

PSIS = 76  # curves of a map: psi from 0 to 5 by 1/15, with the kinks at 1, 7/3 and 11/3


class Spec(NamedTuple):
    """A figure: so many points a curve, and what the curves differ in, along an axis."""

    title: str
    kind: str
    curves: tuple
    points: int
    low: float
    high: float


GAMMAS = (0, 0.01, 0.0825, 0.3, 1, 3)
SPECS = {
    "fig4": Spec("Normal restitution, Kelvin-Voigt", "ez", (0,), 120, 0.01, 100),
    "fig5": Spec("Tangential restitution, Kelvin-Voigt", "map", (0,), 61, 0.01, 100),
    "fig6": Spec("Normal restitution, standard solid", "ez", GAMMAS, 48, 0.01, 100),
    "fig7": Spec("Tangential restitution without slip", "no_slip", GAMMAS[:5], 48, 0.01, 100),
    "fig8": Spec("Tangential restitution, γ = 0.0825", "map", (0.0825,), 61, 0.01, 100),
    "fig9": Spec("Tangential restitution, γ = 1", "map", (1,), 61, 0.01, 100),
    "fig10": Spec("From which ψ on the contact slips to the end", "psi_c", (0, 0.0825, 0.3, 1), 16,
                  0.01, 30),
    "fig11": Spec("The formula (31) beside simulations of growing resolution", "psi_c_error",
                  (8, 16, 32, 64), 16, 0.01, 10),
    "maxwell": Spec("Maxwell body", "maxwell", (0.5, 1, 2, 3), 48, 0.1, 100),
    "temperature": Spec("Restitution at six temperatures", "temperature", (-40, -20, 0, 25, 50, 80),
                        41, 1e-3, 100),
    "tangent": Spec("Normal restitution over the loss tangent", "tangent",
                    (0, 0.01, 0.1, 0.3, 1, 10, math.nan), 40, 0.01, 100),
    "friction": Spec("What friction does to the tangential energy", "friction", (0, 0.1, 0.3, 1, 3),
                     48, 0.05, 6),
}


def time_shift(temperature):
    """a_T of polyisobutylene at a temperature in degrees Celsius, 1 at 25.

    By the equation of Williams, Landel and Ferry, with the constants for 298 K of Ferry,
    Viscoelastic Properties of Polymers, table 11-II.
    """
    difference = np.asarray(temperature) - 25.0
    return 10 ** (-8.61 * difference / (200.4 + difference))


class Figure:
    """A figure of the paper or beyond: impacts drawn at random, lines of their numbers, checks.

    Parameters
    ----------
    name : str
        One of `SPECS`.
    seed : int
        Of the impacts; the same seed gives the same ones on every machine.
    material : Material, name or path
        Of the figure "temperature": polyisobutylene.
    method, tolerance
        How impacts are solved. Lines are solved by sync with a hundredth of the tolerance.

    Attributes
    ----------
    curve : ndarray of int, shape (n,)
        To which curve an impact belongs.
    aims : dict of str to ndarray, shape (n,)
        psi, delta1, gamma, tau/T (nan: no Maxwell body) of each impact; without "temperature".
    columns : dict of str to ndarray, shape (n,)
        The impacts in SI units, by keywords of `restitute.pair` and `restitute.solids`.
    pairs
        What came out, once `solve` was called.

    >>> from restitute.paper import Figure
    >>> figure = Figure("fig4").solve()
    >>> all(check.good for check in figure.checks())
    True
    """

    def __init__(self, name: str, *, seed: int = 2017, material: Any = None, method: str = "sync",
                 tolerance: float = 1e-5):
        if name not in SPECS:
            raise errors.DomainError(f"figure = {name!r}: must be one of {', '.join(SPECS)}")
        if tolerance < 1e-6:
            raise errors.DomainError(f"tolerance = {tolerance:g}: must be at least 1e-6 in a "
                                     "figure, whose lines are solved with a hundredth")
        self.name, self.spec, self.seed, self.material = name, SPECS[name], seed, material
        self.method, self.tolerance = method, tolerance
        self.pairs: Any = None
        self._draw()

    @property
    def curves(self) -> int:
        """How many curves there are; of a map, how many psi."""
        return PSIS if self.spec.kind == "map" else len(self.spec.curves)

    def along(self, part: Any) -> Any:
        """A place on the axis, part of the way from its low to its high end."""
        low, high = self.spec.low, self.spec.high
        if self.spec.kind == "friction":
            return low + (high - low) * part
        return low * (high / low) ** part

    def numbers_at(self, curve: int, x: Any, psi: Any = 1.0) -> tuple:
        """psi, delta1, gamma, tau of a curve at x along the axis."""
        kind, none = self.spec.kind, math.nan
        value = self.spec.curves[0 if kind == "map" else curve]
        of = {"no_slip": (0.0, x, value, none), "map": (curve / 15, x, value, none),
              "psi_c_error": (psi, x, 0.3, none), "maxwell": (value, none, none, x),
              "friction": (x, value, 0.3, none)}
        return of.get(kind, (psi, x, value, none) if value == value else (psi, none, none, x))

    def _draw(self):
        """Along the axis points lie at random, one in each of equal parts; those of maps, and those
        that are compared with each other, are regular."""
        spec, aims, rows = self.spec, [], []
        random = impacts.Random(self.seed * 1000 + list(SPECS).index(self.name))
        regular = spec.kind in ("map", "temperature", "psi_c_error")
        self.curve = np.repeat(np.arange(self.curves), spec.points)
        for curve, point in np.ndindex(self.curves, spec.points):
            psi, where = random.even(0.2, 5), random.even(0, 1)
            x = self.along(point / (spec.points - 1) if regular else (point + where) / spec.points)
            psi, delta1, gamma, tau = self.numbers_at(curve, x, psi)
            if 0.3 < tau < 0.4:  # close to the limit of rebound, 0.312, contacts last for very long
                tau *= 4 / 3
            aims.append((psi, delta1, gamma, tau))
            if spec.kind != "temperature":
                rows.append(impacts.draw(random, *aims[-1]))
        self.aims = dict(zip(("psi", "delta1", "gamma", "tau"), np.array(aims).T))
        if rows:
            self.columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
            return
        self.normal_speed, self.aims = self.aims["delta1"], {}
        ball = {"radius": 0.005, "density": 7800.0, "friction": 0.3, "angle": 30.0}
        self.columns = {name: np.full(len(aims), value) for name, value in ball.items()}
        self.columns["speed"] = self.normal_speed / np.cos(np.radians(30))
        self.columns["time_shift"] = time_shift(np.array(spec.curves))[self.curve]

    @property
    def x(self) -> np.ndarray:
        """Where the impacts are along the axis, shape (n,)."""
        name = {"maxwell": "tau", "friction": "psi"}.get(self.spec.kind, "delta1")
        return self.aims[name] if self.aims else self.normal_speed

    @property
    def line(self) -> np.ndarray:
        """Where the lines are solved along the axis, shape (241,)."""
        return self.along(np.arange(241) / 240)

    def in_numbers(self, psi: Any, delta1: Any, gamma: Any = 0.0, tau: Any = np.nan,
                   **more: Any) -> Any:
        """Impacts of dimensionless numbers alone, broadcast, at a hundredth of the tolerance.

        Those that fail are nan. Without rebound the contact time is inf.
        """
        psi, delta1, gamma, tau = np.broadcast_arrays(psi, delta1, gamma, tau)
        more = {"tolerance": max(1e-8, 0.01 * self.tolerance), **more}
        maxwell = np.isfinite(tau)
        if maxwell.all() or not maxwell.any():
            return impacts.in_numbers(psi, delta1, gamma, tau, **more)
        whole = {name: np.full(tau.shape, np.nan) for name in ("ez", "ex", "contact_time")}
        for part in (maxwell, ~maxwell):
            some = impacts.in_numbers(psi[part], delta1[part], gamma[part], tau[part], **more)
            for name, values in whole.items():
                values[part] = getattr(some, name)
        return SimpleNamespace(**whole)

    @cached_property
    def expected(self) -> Any:
        """What the numbers of the impacts alone give: ez, ex, contact_time, ..., shape (n,)."""
        return self.in_numbers(**self.aims)

    @cached_property
    def lines(self) -> Any:
        """Lines of the numbers: ez, ex of shape (curves, 241), x. Without rebound e_x is nan."""
        curves = range(1 if self.spec.kind == "map" else self.curves)
        numbers = [np.broadcast_arrays(*self.numbers_at(curve, self.line)) for curve in curves]
        found = self.in_numbers(*np.moveaxis(np.array(numbers, float), 1, 0))
        ex = np.where(np.isinf(found.contact_time), np.nan, found.ex)
        return SimpleNamespace(x=self.line, ez=found.ez, ex=ex)

    @cached_property
    def ledger(self) -> Any:
        """Energies along the lines, each of shape (curves, 241); of the figure "friction"."""
        delta1 = np.array(self.spec.curves)[:, None]
        return self.in_numbers(self.line, delta1, 0.3, energies=True).ledger

    @staticmethod
    def formula(ez: Any) -> Any:
        """psi_c = 2 chi (1 + e_z) - e_z (31)."""
        return 2 * impacts.CHI * (1 + ez) - ez

    def simulated_psi_c(self, elements: int, delta1: np.ndarray, gamma: np.ndarray) -> np.ndarray:
        """psi_c by simulation, shape (n,)."""
        result = self.in_numbers(1.0, delta1, gamma)
        return critical_psi(impacts.CHI, delta1, gamma, result.max_contact_radius,
                            result.contact_time, elements)

    @cached_property
    def psi_c(self) -> np.ndarray:
        """psi_c by simulation of the impacts of the figures 10 and 11, shape (curves, points)."""
        delta1, gamma = (self.aims[name].reshape(self.curves, -1) for name in ("delta1", "gamma"))
        elements = self.spec.curves if self.spec.kind == "psi_c_error" else [64] * self.curves
        return np.array([self.simulated_psi_c(int(elements[k]), delta1[k], gamma[k])
                         for k in range(self.curves)])

    @property
    def psi_c_error(self) -> np.ndarray:
        """|psi_c/(31) - 1|, likewise."""
        return abs(self.psi_c / self.formula(self.expected.ez).reshape(self.curves, -1) - 1)

    def solve(self, **how: Any) -> Figure:
        """Solve the impacts; keywords of `restitute.pair`, e.g. threads, executor, progress."""
        import restitute

        given = impacts.keywords(self.columns) if self.aims else self.columns
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", errors.ModelLimitWarning)  # the figure marks them
            self.pairs = restitute.pair(
                **{"material": self.material, **given}, method=self.method,
                tolerance=self.tolerance, on_error="nan", **how)
        return self

    def draw(self, ax: Any = None) -> Any:
        """Draw it; one or two axes. Impacts beyond a limit of the model are marked."""
        from restitute.paper.charts import draw

        return draw(self, ax)

    def checks(self) -> list:
        """The numbers that the figure must meet, see `restitute.paper.checks`."""
        from restitute.paper.checks import checks

        return checks(self)

    def description(self) -> str:
        """Given what."""
        if self.aims:
            return f"χ = 7/6; {len(self.curve)} impacts drawn in SI units, seed {self.seed}"
        return ("steel ball of radius 5 mm, friction 0.3, 30 degrees; times shifted as "
                "polyisobutylene's (Williams, Landel and Ferry)")
