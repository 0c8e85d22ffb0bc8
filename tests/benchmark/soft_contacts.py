#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a contact that is not small changes: exact profile of the sphere, sphere of finite size.

    soft_contacts.py [--elements N] [--rows] [--check PAGE] [--figure FILE] [--many]

The foundation of elements of the paper, impacts side by side in one array, in units of the paper
(docs/theory.md, section 3). The profile X^2 of the parabola becomes X^2 h(X r/A), where r is the
ratio of contact radius to radius, and A the largest contact radius, of the impact with the
parabola:

    exact profile    h(y) = artanh(y)/y, since the foundation's profile of a sphere is
                     g(x) = x int_0^x f'/sqrt(x^2 - r^2) dr = (x/2) ln((R + x)/(R - x))
    finite sphere    the profile whose force at every depth is that of an elastic incompressible
                     sphere on a rigid plane, see `finite_sphere`

Prints the tables of docs/soft_contacts.md, or with --rows every change as CSV; --check compares
with the tables of the page. --many compares 46 solids with the bounds of the page.
"""
from __future__ import annotations

import argparse
import csv
import re
import sys
import warnings
from pathlib import Path

import numpy as np

import restitute
from restitute import Material, errors

RATIOS = (0.05, 0.1, 0.2, 0.3, 0.5)
PSI = (0.2, 0.5, 1.0, 1.5, 2.0, 3.0)
CHI = 7 / 6
BALL = dict(radius=0.005, density=7800, friction=0)
#: Solids under the ball at 1 m/s but for polyisobutylene: name, solid, speed.
SOLIDS = (
    ("elastic", Material.elastic(1e6), 1.0),
    ("standard solid, gamma = 1", Material.standard_solid(1e6, 1e6, 1e3), 1.0),
    ("standard solid, gamma = 0.1", Material.standard_solid(1e6, 1e7, 1e3), 1.0),
    ("Kelvin-Voigt", Material.kelvin_voigt(1e6, 3e2), 1.0),
    ("Kelvin-Voigt, strong", Material.kelvin_voigt(1e6, 1.5e3), 1.0),
    ("Maxwell", Material.maxwell(1e6, 5e3), 1.0),
    ("polyisobutylene", restitute.material("polyisobutylene"), 0.05),
)


def artanh_ratio(y):
    """artanh(y)/y, the profile of a sphere over that of the parabola."""
    y = np.minimum(y, 1 - 1e-12)
    return np.where(y > 1e-4, np.arctanh(y) / np.maximum(y, 1e-4), 1 + y * y / 3)


def finite_sphere_compliance(modes=200000):
    """Where a force on an incompressible elastic sphere, balanced by the inertia of its mass,
    displaces it otherwise than a half-space: c and k of

        normal       depth = (a^2/R)(1 - c a/R)
        tangential   compliance of the half-space times 1 + 4/(3 pi) a/R (k + 3/2 ln(R/a))

    Mode n of the traction deforms the sphere by these multiples of R/G: a pressure radially by
    n (2n+1)/(2 (n-1)(2n^2+4n+3)), a tangential traction without curl by (2n^2+n+3)/(2 (n-1)
    (2n^2+4n+3)), n > 1, and 1/3, n = 1, one with curl by 1/(n-1), n > 1, and 1/7, n = 1. Those of
    the half-space, for large n, are 1/(2n+1), 1/(2n+1) and 2/(2n+1). Modes 0 and 1 of a pressure
    do not deform the sphere.
    """
    n = np.arange(2.0, modes)
    below = 2 * (n - 1) * (2 * n * n + 4 * n + 3)
    normal = np.sum(n * (2 * n + 1) ** 2 / below - 1) - 2  # times F/(4 pi G R)
    # the logarithm is what 3/(n - 1) of the modes with curl adds up to under the square of the
    # transform sin(n a/R)/(n a/R) of the traction of a rigid disc
    tangential = (np.sum((2 * n + 1) * (2 * n * n + n + 3) / below - 1) / 2 + (3 / 7 - 2) / 2
                  + 1.5 * (1.5 - np.log(2)) - 1.5)
    return -4 / (3 * np.pi) * normal, tangential


C_NORMAL, K_TANGENTIAL = finite_sphere_compliance()


def contact_radius(y):
    """a/R of the sphere of finite size where the foundation's is y: the foundation has the right
    force at the right depth if dF/dd is that of the sphere, y = a/(1 - 3/2 c a/R)."""
    return y / (1 + 1.5 * C_NORMAL * y)


def finite_sphere(y):
    """h of the sphere of finite size: Hertz's force at its depth."""
    a = contact_radius(y)
    return np.where(y > 0, (a / np.maximum(y, 1e-300)) ** 2 * (1 - C_NORMAL * a), 1.0)


def finite_sphere_tangential(y):
    """Tangential stiffness of the elements up to y, so that their sum is that of the sphere."""
    a = contact_radius(np.maximum(y, 1e-12))
    softer = 4 / (3 * np.pi) * a * (K_TANGENTIAL - 1.5 * np.log(a))
    return a / (1 + softer)


KINDS = {"exact profile": (artanh_ratio, lambda y: y),
         "finite sphere": (finite_sphere, finite_sphere_tangential)}


def dimensionless(solid, speed):
    """The solid in units of the scales of its modulus at the time of the impact, and the scales:
    T, a_el and the modulus. Terms that are a thousand times faster or slower are a dashpot and a
    spring."""
    radius, mass = BALL["radius"], BALL["density"] * 4 / 3 * np.pi * BALL["radius"] ** 3
    modulus = solid.relaxation_modulus(1e-3)
    nu = solid.poisson_ratio
    length = (15 * mass * speed**2 * radius**2 * (1 - nu) / (32 * modulus)) ** 0.2
    time = length**2 / radius / speed
    series = solid.series
    g, tau = series.modulus / modulus, series.relaxation_time / time
    slow, fast = tau > 1e4, tau < 1e-4
    spring = series.equilibrium_modulus / modulus + g[slow].sum()
    dashpot = series.parallel_viscosity / modulus / time + (g * tau)[fast].sum()
    terms = list(zip(g[~slow & ~fast], tau[~slow & ~fast]))
    return (spring, terms, dashpot), time, length


class Foundation:
    """Impacts side by side, one a row: psi, ratio r and stretch A of the profile, one solid.

    solid: (G_inf, [(g_k, tau_k)], theta) in units of G and T. The solid's forces are integrated
    exactly for a velocity that is constant in the step; positions and velocities leapfrog.
    """

    def __init__(self, solid, chi, psi, profile, stiffness, radius, step, elements):
        self.g_inf, terms, self.theta = solid
        self.chi, self.step = chi, step
        self.g = np.array([g for g, _ in terms])[:, None, None]
        self.tau = np.array([tau for _, tau in terms])[:, None, None]
        self.dx = radius / elements
        x = (np.arange(int(1.6 * elements) + 2) + 0.5) * self.dx
        self.gap = x**2 * profile(x)
        self.weight = np.diff(stiffness(np.append(x - self.dx / 2, x[-1] + self.dx / 2))) / self.dx
        shape = self.gap.shape
        self.d, self.v = np.zeros((shape[0], 1)), np.ones((shape[0], 1))
        self.u, self.w = np.zeros(shape[:1] + (1,)), np.broadcast_to(psi, (shape[0], 1)).copy()
        self.wz, self.wx = np.zeros((len(terms),) + shape), np.zeros((len(terms),) + shape)
        self.q, self.ux = np.zeros(shape), np.zeros(shape)
        self.entered, self.left = np.zeros(shape, bool), np.zeros(shape, bool)
        self.psi = self.w.copy()

    def advance(self):
        """One step; False once no element touches and the sphere recedes."""
        h = self.step
        self.d = self.d + h * self.v
        depth = self.d - self.gap
        new = ~self.entered & (depth > 0)
        self.entered |= new
        active = self.entered & ~self.left
        # what remains of the step after the entry of an element
        part = np.where(new, np.clip(depth / np.where(self.v > 0, self.v * h, 1), 0, 1), 1.0)
        time = part * h
        decay = np.exp(-time / self.tau)
        gain = np.where(time > 0, self.tau * (1 - decay) / np.maximum(time, 1e-300), 1)
        rise = np.where(active, self.v * time, 0)
        self.wz = np.where(active, decay * self.wz + gain * rise, self.wz)
        spring = self.g_inf * depth + (self.g * self.wz).sum(axis=0)
        force = np.where(active, spring + self.theta * self.v, 0)
        self.left |= active & (force <= 0)
        active &= force > 0
        force = np.where(active, force, 0)
        self.slide(active, force, time, decay, gain)
        self.kick(active, np.where(active, spring, 0))
        return bool(np.any(active) or np.any(self.v > 0))

    def slide(self, active, limit, time, decay, gain):
        """Tangential forces: stick, or slip where the trial force passes the limit."""
        rise = np.where(active, self.w * time, 0)
        wx = decay * self.wx + gain * rise
        rate = self.theta / np.maximum(time, 1e-300)
        trial = self.weight * (self.g_inf * (self.ux + rise) + (self.g * wx).sum(axis=0)
                               + rate * rise)
        stiffness = self.weight * (self.g_inf + (self.g * gain).sum(axis=0) + rate)
        self.q = np.where(active, np.clip(trial, -limit, limit), 0)
        slip = np.where(active & (time > 0), (trial - self.q) / stiffness, 0)
        self.ux = np.where(active, self.ux + rise - slip, self.ux)
        self.wx = np.where(active, wx - gain * slip, self.wx)

    def kick(self, active, spring):
        """Velocities; the dashpot's force with the mean of old and new velocity."""
        h, dx = self.step, self.dx
        width = active.sum(axis=1, keepdims=True) * dx * self.theta
        pull = 15 / 8 * h
        push = pull * spring.sum(axis=1, keepdims=True) * dx
        self.v = (self.v * (1 - pull * width / 2) - push) / (1 + pull * width / 2)
        self.w = self.w - 15 / 4 * self.chi * h * self.q.sum(axis=1, keepdims=True) * dx

    def run(self):
        """e_z and e_x of all impacts."""
        while self.advance():
            pass
        return -self.v[:, 0], np.where(self.psi > 0, -self.w / self.psi, np.nan)[:, 0]


def study(solid, speed, elements, psi=PSI, ratios=RATIOS, kinds=KINDS):
    """Pairs with the parabola and their changes: e_z, e_x(psi), de_z(kind, ratio) and
    de_x(kind, ratio, psi)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.ModelLimitWarning)
        known = restitute.pair(solid, normal_speed=speed, method="sync", tolerance=1e-6, **BALL)
    units, time, length = dimensionless(solid, speed)
    radius = float(known.max_contact_radius) / length

    def rows(of, x):
        rows = [of(0, np.zeros_like(x), x)]
        rows += [of(k, x * r / radius, x) for k in range(len(kinds)) for r in ratios]
        return np.repeat(rows, len(psi), axis=0)

    shapes = list(kinds.values())

    def profile(x):
        return rows(lambda k, y, x: shapes[k][0](y), x)

    def stiffness(x):
        return rows(lambda k, y, x: np.where(y > 0, shapes[k][1](y) * x / np.where(y > 0, y, 1), x)
                    if np.any(y) else x, x)

    every = np.tile(psi, 1 + len(kinds) * len(ratios))[:, None]
    step = float(known.contact_time) / time / (6 * elements)
    ez, ex = Foundation(units, CHI, every, profile, stiffness, radius, step, elements).run()
    ez, ex = ez.reshape(-1, len(psi))[:, 0], ex.reshape(-1, len(psi))
    shape = (len(kinds), len(ratios))
    return (ez[0], ex[0], float(known.ez), (ez[1:] - ez[0]).reshape(shape),
            (ex[1:] - ex[0]).reshape(*shape, len(psi)))


def bounds(ratio):
    """Those of the page on the changes of e_z and e_x, for a sphere of finite size."""
    return 0.18 * ratio, 1.3 * ratio**0.65


def many_solids():
    """Name, solid, speed: a wide choice."""
    yield "elastic", Material.elastic(1e6), 1.0
    for eta in np.geomspace(20, 5e3, 8):
        yield f"Kelvin-Voigt, {eta:.3g} Pa s", Material.kelvin_voigt(1e6, eta), 1.0
    for gamma in (0.03, 0.1, 0.3, 1, 3):
        for tau in np.geomspace(1e-5, 3e-2, 6):
            g2 = 1e6 / gamma
            yield (f"standard solid, gamma = {gamma}, {tau:.2g} s",
                   Material.standard_solid(1e6, g2, g2 * tau), 1.0)
    for eta in np.geomspace(2.5e3, 5e4, 4):
        yield f"Maxwell, {eta:.2g} Pa s", Material.maxwell(1e6, eta), 1.0
    for speed in (0.001, 0.1, 10):
        yield f"polyisobutylene, {speed} m/s", SOLIDS[-1][1], speed


def check_bounds(elements):
    """The largest changes of many solids, and how many pass the bounds."""
    worst, passed = {}, 0
    for name, solid, speed in many_solids():
        _, _, _, dez, dex = study(solid, speed, elements)
        for k, kind in enumerate(KINDS):
            for i, ratio in enumerate(RATIOS):
                found = abs(dez[k, i]), np.abs(dex[k, i]).max()
                passed += any(f > b for f, b in zip(found, bounds(ratio)))
                for what, value in zip(("ez", "ex"), found):
                    key = kind, what, ratio
                    worst[key] = max(worst.get(key, (0, "")), (round(float(value), 5), name))
    for key, (value, name) in worst.items():
        print(*key, value, name, sep=", ")
    return passed


def table(results, kind):
    """Rows of the page: a/R, then the largest |change of e_x| over psi beside that of e_z."""
    for i, ratio in enumerate(RATIOS):
        cells = [f"{dez[kind, i]:+.4f}, {np.abs(dex[kind, i]).max():.4f}"
                 for _, _, _, dez, dex in results]
        yield "| " + " | ".join([f"{ratio}", *cells]) + " |"


def differences(page, rows):
    """The largest difference between numbers of the page's tables and of rows."""
    recorded = [line for line in Path(page).read_text().splitlines() if re.match(r"\| 0\.\d", line)]
    assert len(recorded) == len(rows), f"{len(recorded)} rows in {page}, {len(rows)} computed"
    number = re.compile(r"[+-]?\d+\.\d+")
    values = [[[float(x) for x in number.findall(line)] for line in lines]
              for lines in (recorded, rows)]
    return np.max(np.abs(np.subtract(*values)))


def draw(results, path):
    """|Changes| over a/R: filled for the exact profile, open for the sphere of finite size."""
    import matplotlib
    matplotlib.use("svg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"svg.hashsalt": "restitute", "svg.fonttype": "none", "font.size": 11,
                         "grid.color": "#dddddd"})
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.8), sharex=True)
    figure.subplots_adjust(left=0.08, right=0.98, top=0.97, bottom=0.27, wspace=0.25)
    marks = dict(zip((name for name, *_ in SOLIDS), "os^vD*X"))
    for (name, *_), (_, _, _, dez, dex) in zip(SOLIDS, results):
        for k, (fill, colour) in enumerate(((None, "#1f6f8b"), ("white", "#c4451c"))):
            style = dict(marker=marks[name], color=colour, markerfacecolor=fill or colour,
                         linewidth=1, markersize=5)
            axes[0].plot(RATIOS, np.maximum(np.abs(dez[k]), 1e-9), **style)
            axes[1].plot(RATIOS, np.abs(dex[k]).max(axis=-1), **style)
    for name, mark in marks.items():
        axes[1].plot([], [], marker=mark, color="#555555", linestyle="", label=name)
    for axis, bound, words in zip(axes, bounds(np.array(RATIOS)), ("z", "x")):
        axis.loglog(RATIOS, bound, "k--", linewidth=1.5)
        axis.set(xlabel="a/R", ylabel=f"|change of e_{words}|", ylim=(1e-5, 3), xticks=RATIOS,
                 xticklabels=[str(r) for r in RATIOS])
        axis.minorticks_off()
        axis.grid()
    for text, x, y, colour in (("soft sphere", 0.04, 0.92, "#c4451c"),
                               ("hard sphere, soft plane", 0.42, 0.06, "#1f6f8b")):
        axes[0].text(x, y, text, color=colour, transform=axes[0].transAxes)
    figure.legend(loc="lower center", ncol=3, fontsize=10, frameon=False)
    figure.savefig(path, metadata={"Date": None})


def write_rows(results):
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("solid psi ez ex kind ratio change_ez change_ex".split())
    for (name, *_), (ez, ex, _, dez, dex) in zip(SOLIDS, results):
        for k, kind in enumerate(KINDS):
            for i, ratio in enumerate(RATIOS):
                for j, psi in enumerate(PSI):
                    out.writerow([name, psi, f"{ez:.5f}", f"{ex[j]:.5f}", kind, ratio,
                                  f"{dez[k, i]:.5f}", f"{dex[k, i, j]:.5f}"])


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--elements", type=int, default=100, metavar="N")
    words.add_argument("--rows", action="store_true")
    words.add_argument("--many", action="store_true")
    words.add_argument("--check", metavar="PAGE")
    words.add_argument("--figure", metavar="FILE")
    asked = words.parse_args()
    if asked.many:
        return check_bounds(asked.elements)
    results = [study(solid, speed, asked.elements) for _, solid, speed in SOLIDS]
    apart = max(abs(ez - known) for ez, _, known, *_ in results)
    rows = [row for kind in range(len(KINDS)) for row in table(results, kind)]
    print(f"# e_z with the parabola is within {apart:.2g} of sync", file=sys.stderr)
    if asked.figure:
        draw(results, asked.figure)
    if asked.rows:
        write_rows(results)
    elif not asked.check:
        print(*rows, sep="\n")
    if not asked.check:
        return 0
    most = differences(asked.check, rows)
    print(f"the page is within {most:.2g}")
    # with 50 elements: first order for e_x of Kelvin-Voigt, 0.0027; e_z of the strong one is off
    # by 1.3e-4. Half the elements double the one and quadruple the other
    return int(apart > 3e-4 or most > 4e-3)


if __name__ == "__main__":
    sys.exit(main())
