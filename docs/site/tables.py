# SPDX-License-Identifier: BSD-3-Clause
"""Small tables of the pairs of one material, as JSON for the figure that impact.js draws.

A solid sphere and a wall, one of them rigid: the pair depends on the time scale T of the impact
alone (22), and e_x also on psi, docs/theory.md, section 2. So one table covers all radii,
densities, speeds, angles and frictions:

    T = (R/v) (c rho v^2)^(2/5),  c = (5 pi/8) (1 - nu)/G(0)       psi = kappa tan(angle)/mu

The values along psi are those of docs/table.md, "What is stored?". impact.js interpolates with
cubics through four neighbours; `measured_errors` says how far that is off.
"""
from __future__ import annotations

import warnings

import numpy as np

import restitute

#: Ranges of the sliders: m, m/s, degrees, 1; and kg/m^3 of the balls.
RANGES = {"radius": (5e-4, 0.05), "speed": (1e-3, 10.0), "angle": (0.0, 85.0),
          "friction": (0.05, 1.0)}
DENSITIES = (900.0, 8000.0)
STICK, SLIP, PER_DECADE = 13, 25, 16
CHECKED = 400  # random impacts of `measured_errors`
_C = 2e-4  # of t(y), docs/table.md


def place(y):
    """t(y), where the nodes between psi = 1 and psi_c are equally spaced."""
    y = np.asarray(y, float)
    return 0.5 + (y - 0.5) * (1 + _C**0.25 - (y * (1 - y) + _C) ** 0.25)


def _nodes(count):
    """The y of equally spaced t(y), by bisection."""
    wanted, low, high = np.linspace(0, 1, count), np.zeros(count), np.ones(count)
    for _ in range(60):
        middle = 0.5 * (low + high)
        below = place(middle) < wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.r_[0.0, 0.5 * (low + high)[1:-1], 1.0]


def compliance(material):
    """c of the module's text, 1/Pa."""
    series, nu = material.series, material.poisson_ratio
    stiffest = series.equilibrium_modulus + series.modulus.sum()
    if stiffest <= 0:
        raise ValueError("a mere dashpot has no T")
    return 5 * np.pi / 8 * (1 - nu) / stiffest


def time_scale(c, radius, density, speed):
    """T in s."""
    return radius / speed * (c * density * speed**2) ** 0.4


def numbers(nu):
    """chi of a solid sphere and kappa."""
    return 3.5 * (1 - nu) / (2 - nu), (2 - 2 * nu) / (2 - nu)


def solve(material, time, psi):
    """Pairs at T (s) and psi: at 1 m/s, with unit density; T sets the radius. The wave speed is
    that of the material's density, where it is known."""
    c, (_, kappa) = compliance(material), numbers(material.poisson_ratio)
    radius = np.asarray(time, float) / time_scale(c, 1.0, 1.0, 1.0)
    density = material.density if material.density > 0 else 1.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", restitute.ModelLimitWarning)
        warnings.simplefilter("ignore", restitute.UnitWarning)
        return restitute.pair(material, radius=radius, density=1.0, friction=1.0, normal_speed=1.0,
                              tangential_speed=np.asarray(psi, float) / kappa,
                              wave_density=density, method="sync", tolerance=1e-4, threads=0)


def times(material):
    """Equal steps of log T over what the sliders reach; one T of an elastic solid."""
    series, c = material.series, compliance(material)
    low = time_scale(c, RANGES["radius"][0], DENSITIES[0], RANGES["speed"][1])
    high = time_scale(c, RANGES["radius"][1], DENSITIES[1], RANGES["speed"][0])
    if len(series.modulus) == 0 and series.parallel_viscosity == 0:
        return np.array([low])
    return np.geomspace(low, high, int(np.ceil(PER_DECADE * np.log10(high / low))) + 1)


def _rounded(values, digits):
    """Nested lists with that many digits; null for what is not finite."""
    if isinstance(values, np.ndarray) and values.ndim > 1:
        return [_rounded(row, digits) for row in values]
    return [float(f"{v:.{digits}g}") if np.isfinite(v) else None for v in values]


def table_of(material):
    """What impact.js needs of a material, with the errors against the library."""
    chi, kappa = numbers(material.poisson_ratio)
    t = times(material)
    stick = solve(material, t[:, None], np.linspace(0, 1, STICK))
    head_on = solve(material, t, 0.0)
    ez = head_on.ez
    most = 2 * chi * (1 + ez) - ez if 2 * chi > 1 else np.ones_like(ez)
    y = _nodes(SLIP)
    psi = 1 + (most - 1)[:, None] * y
    slip = psi * solve(material, t[:, None], psi).ex - y * ez[:, None]
    slip[:, 0], slip[:, -1] = stick.ex[:, -1], 0.0
    length = compliance(material) ** 0.2  # a_el/R at 1 m/s and unit density
    depth = solve(material, t, kappa).displacement_ratio / length
    with np.errstate(all="ignore"):
        table = {
            "density": float(material.density) if material.density > 0 else None,
            "chi": chi, "kappa": kappa, "compliance": compliance(material),
            "log_time": [float(np.log(t[0])), float(np.log(t[-1])), len(t)],
            "ez": _rounded(ez, 5), "stick": _rounded(stick.ex, 5), "slip": _rounded(slip, 5),
            "contact": _rounded(np.log(head_on.contact_time / t), 6),
            "radius": _rounded(np.log(head_on.radius_ratio / length), 6),
            "depth": _rounded(np.log(depth), 6),
            "wave": _rounded(np.log(1.0 / head_on.speed_ratio), 6),
            "ranges": RANGES,
            "limits": {key: getattr(head_on.settings, f"{key}_limit")
                       for key in ("speed", "radius", "displacement")},
            "window": window_of(material),
        }
    table["error"] = measured_errors(material, table)
    return table


def window_of(material):
    """The contact times in which the material was measured; None if they are not known."""
    low, high = getattr(material, "window", (0.0, np.inf))
    return [low, high] if low > 0 and np.isfinite(high) else None


def _row(values, last, u):
    """Cubic through the four nodes around u, of node numbers 0 to last, along the first axis."""
    values = np.array(values, float)
    if last < 3:
        return values[np.zeros(np.shape(u), int)]
    i = np.clip(np.floor(u).astype(int), 1, last - 2)
    x = (u - i).reshape(np.shape(u) + (1,) * (values.ndim - 1))
    return (-x * (x - 1) * (x - 2) / 6 * values[i - 1] + (x * x - 1) * (x - 2) / 2 * values[i]
            - x * (x + 1) * (x - 2) / 2 * values[i + 1] + x * (x * x - 1) / 6 * values[i + 2])


def look_up(table, radius, density, speed, angle, friction):
    """e_z and e_x of arrays of impacts, as impact.js finds them."""
    normal = speed * np.cos(np.radians(angle))
    low, high, count = table["log_time"]
    time = np.log(time_scale(table["compliance"], radius, density, normal))
    u = np.clip((time - low) / max(high - low, 1e-300), 0, 1) * (count - 1)
    ez = _row(table["ez"], count - 1, u)
    psi = table["kappa"] * np.tan(np.radians(angle)) / friction
    most = 2 * table["chi"] * (1 + ez) - ez
    ex = 2 * table["chi"] * (1 + ez) / np.maximum(psi, most) - 1
    y = np.clip((psi - 1) / (most - 1), 0, 1)
    for panel, at, inside in (("stick", psi, psi <= 1), ("slip", place(y), (psi > 1) & (psi < most))):
        columns = _row(table[panel], count - 1, u)
        nodes = columns.shape[1] - 1
        found = np.array([_row(c, nodes, np.array(min(p, 1.0) * nodes)) for c, p in zip(columns, at)])
        ex = np.where(inside, found if panel == "stick" else (found + y * ez) / psi, ex)
    return ez, ex


def random_impacts(count, seed, density):
    """Impacts within the ranges of the sliders: keywords of `look_up` and `restitute.pair`."""
    draw, (_, high) = np.random.default_rng(seed), RANGES["angle"]
    impacts = {name: np.exp(draw.uniform(*np.log(RANGES[name]), count))
               for name in ("radius", "speed", "friction")}
    return {**impacts, "angle": draw.uniform(0, high, count),
            "density": draw.choice([density, *DENSITIES] if density else DENSITIES, count)}


def measured_errors(material, table, count=CHECKED):
    """Largest differences from the library of random impacts, times 1.5 for those not drawn."""
    impacts = random_impacts(count, 7, table["density"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", restitute.ModelLimitWarning)
        exact = restitute.pair(material, method="sync", tolerance=1e-4, threads=0, **impacts)
    ez, ex = look_up(table, **impacts)
    return {"ez": _up(1.5 * np.max(np.abs(ez - exact.ez)) + exact.settings.tolerance),
            "ex": _up(1.5 * np.max(np.abs(ex - exact.ex)) + exact.settings.tolerance)}


def _up(value):
    """The next number of one digit."""
    unit = 10.0 ** np.floor(np.log10(value))
    return float(f"{np.ceil(value / unit) * unit:.1g}")
