# SPDX-License-Identifier: BSD-3-Clause
"""What the figures show."""
from __future__ import annotations

import functools
from typing import Any

import numpy as np

from restitute import plot, version
from restitute.plot.pairs import QUANTITIES, TITLES, mark_limits
from restitute.plot.sheet import RED, legend

_LIMIT = {"color": RED, "linestyle": "-.", "linewidth": 2.2}


def draw(figure: Any, ax: Any = None) -> Any:
    """Draw a figure whose impacts are solved; see `Figure.draw`."""
    kind = figure.spec.kind
    panels = 2 if kind in ("maxwell", "temperature", "friction") else 1
    if ax is None:
        origin = f"restitute {version()}, method {figure.method}, tolerance {figure.tolerance:g}"
        ax = plot.sheet(panels, figure.spec.title, figure.description(), origin)
    axes = np.ravel(ax)
    of: dict = {"map": _map, "psi_c": _psi_c, "psi_c_error": _psi_c, "maxwell": _two,
                "temperature": _two, "tangent": _tangent, "friction": _friction}
    of.get(kind, _over_delta1)(figure, *axes)
    legend(axes[-1])
    return ax


def _names(figure):
    kind = figure.spec.kind
    pattern = {"psi_c_error": "{:g} elements", "temperature": "{:g} °C", "maxwell": "ψ = {:g}",
               "friction": "δ₁ = {:g}"}.get(kind, "γ = {:g}")
    special = {"γ = {:g}": "Kelvin-Voigt", "δ₁ = {:g}": "elastic"}.get(pattern)
    return [special if special and value == 0 else pattern.format(value) if value == value
            else "Maxwell" for value in figure.spec.curves]


# All but COUPLED: with nu down to 0.13 on a rigid wall two thirds of all impacts have it.
_MARKED = ~8


def _points(figure, ax, quantity, x=None, names=None, **style):
    """The drawn impacts, and which of them pass a limit of the model."""
    x = figure.x if x is None else x
    y = np.array(getattr(figure.pairs, quantity), float)
    if quantity == "ex":
        y[np.isinf(figure.pairs.contact_time)] = np.nan  # still in contact: there is no after
    for curve in range(figure.curves):
        of = figure.curve == curve
        ax.plot(x[of], y[of], label=names and names[curve],
                **plot.look(curve, figure.curves, **style))
    mark_limits(ax, x, y, figure.pairs.flags & _MARKED)


def _curves(figure, ax, quantity):
    """Lines of the dimensionless numbers, and the impacts drawn as points on them."""
    for curve, name in enumerate(_names(figure)):
        ax.plot(figure.lines.x, getattr(figure.lines, quantity)[curve], label=name,
                **plot.look(curve, figure.curves, marker=""))
    _points(figure, ax, quantity, linestyle="")


def _axes(figure, ax, xlabel, ylabel, **more):
    ax.set(xscale="log", xlabel=xlabel, ylabel=ylabel, xlim=(figure.spec.low, figure.spec.high),
           **more)


def _over_delta1(figure, ax):
    quantity = "ez" if figure.spec.kind == "ez" else "ex"
    _curves(figure, ax, quantity)
    _axes(figure, ax, "δ₁", QUANTITIES[quantity])
    if quantity == "ez":
        ax.set_ylim(0, 1.02)


def _map(figure, ax):
    delta1, psi, pairs = figure.aims["delta1"], figure.aims["psi"], figure.pairs
    shown = type("Nodes", (), {"ex": pairs.ex})
    plot.map(delta1, psi, shown, "ex", xlabel="δ₁", ylabel="ψ", log=(True, False), ax=ax)
    ax.plot(figure.lines.x, figure.formula(figure.lines.ez[0]), label=r"$\psi_c$", **_LIMIT)
    ax.axhline(1, color="#440154", label="ψ = 1")
    mark_limits(ax, delta1, psi, pairs.flags & _MARKED)


def _psi_c(figure, ax):
    error, curves = figure.spec.kind == "psi_c_error", figure.curves
    delta1 = figure.aims["delta1"].reshape(curves, -1)
    for curve, name in enumerate(_names(figure)):
        if error:
            ax.plot(delta1[curve], figure.psi_c_error[curve], label=name,
                    **plot.look(curve, curves))
            continue
        ax.plot(figure.lines.x, figure.formula(figure.lines.ez[curve]), label=name,
                **plot.look(curve, curves, marker=""))
        ax.plot(delta1[curve], figure.psi_c[curve], **plot.look(curve, curves, linestyle=""))
    _axes(figure, ax, "δ₁", "|simulated ψ / ψ by (31) − 1|" if error else r"$\psi_c$",
          yscale="log" if error else "linear")


def _two(figure, *axes):
    """Over tau/T or the normal speed, e_z and e_x."""
    maxwell = figure.spec.kind == "maxwell"
    for ax, quantity in zip(axes, QUANTITIES):
        if maxwell:
            _curves(figure, ax, quantity)
            ax.axvline(no_rebound_limit(), label="limit of rebound", **_LIMIT)
        else:
            _points(figure, ax, quantity, names=_names(figure), marker="")
        _axes(figure, ax, "τ / T" if maxwell else "normal speed (m/s)", QUANTITIES[quantity],
              title=TITLES[quantity])
    axes[0].set_ylim(bottom=0)


def _tangent(figure, ax):
    _points(figure, ax, "ez", loss_tangent(figure), _names(figure), linestyle="")
    _axes(figure, ax, "loss tangent at the frequency 1 / (2 contact time)", "$e_z$")
    ax.set(xlim=(figure.spec.low, 20), ylim=(0, 1.02))


def _friction(figure, *axes):
    lost = figure.ledger
    for ax, part, title in zip(axes, (lost.friction_x, lost.viscous_x + lost.left_x),
                               ("To friction", "To the material")):
        for curve, name in enumerate(_names(figure)):
            ax.plot(figure.line, part[curve], label=name,
                    **plot.look(curve, figure.curves, marker=""))
        ax.set(xlabel="ψ", ylabel="part of the tangential energy", title=title, ylim=(0, 1))


def loss_tangent(figure: Any) -> np.ndarray:
    """G''/G' at half a period per contact time of each impact, shape (n,); nan without rebound."""
    delta1, gamma, tau = (figure.aims[name] for name in ("delta1", "gamma", "tau"))
    time = figure.expected.contact_time
    omega, theta = np.pi / np.where(np.isfinite(time), time, np.nan), np.sqrt(32 / 15) * delta1
    with np.errstate(divide="ignore", invalid="ignore"):
        wt = omega * gamma * theta
        arm = wt / gamma / (1 + wt**2)
        standard = np.where(gamma == 0, omega * theta, arm / (1 + arm * wt))
    return np.where(np.isnan(tau), standard, 1 / (omega * tau))


def _sinks_in(tau):
    """Whether a Maxwell body lets the sphere sink in: compression alone, docs/theory.md.

    D'' = -(15/8) P and P' = sqrt(D) D' - P/tau by the midpoint rule. At last D' obeys
    tau v'' + v' + (15/8) tau sqrt(D) v = 0, which crosses zero if it is not overdamped.
    """
    step, depth, v, force = 1e-3, 0.0, 1.0, 0.0
    while v > 1e-8:
        d, w = depth + 0.5 * step * v, v - 0.5 * step * 15 / 8 * force
        f = force + 0.5 * step * (depth**0.5 * v - force / tau)
        depth, v = depth + step * w, v - step * 15 / 8 * f
        force += step * (d**0.5 * w - f / tau)
    return v > 0 and 7.5 * tau**2 * depth**0.5 < 1


@functools.lru_cache(None)
def no_rebound_limit() -> float:
    """Least tau/T with which a sphere leaves a Maxwell body."""
    low, high = 0.1, 3.0
    while high - low > 1e-5:
        tau = 0.5 * (low + high)
        low, high = (tau, high) if _sinks_in(tau) else (low, tau)
    return high
