# SPDX-License-Identifier: BSD-3-Clause
"""What the figures show."""
from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from restitute import plot, version
from restitute.paper.figures import LINE, formula
from restitute.plot.pairs import mark_limits
from restitute.plot.sheet import RED, legend

_QUANTITIES = {"ez": "$e_z$", "ex": "$e_x$"}


def draw(figure, ax=None):
    """Draw a figure whose impacts are solved; see `Figure.draw`."""
    kind = figure.spec.kind
    panels = 2 if kind in ("maxwell", "temperature", "friction") else 1
    if ax is None:
        origin = f"restitute {version()}, method {figure.method}, tolerance {figure.tolerance:g}"
        ax = plot.sheet(panels, figure.spec.title, figure.description(), origin)
    axes = np.ravel(ax)
    {"ez": _over_delta1, "no_slip": _over_delta1, "map": _map, "psi_c": _psi_c, "psi_c_error": _psi_c,
     "maxwell": _maxwell, "temperature": _temperature, "tangent": _tangent,
     "friction": _friction}[kind](figure, *axes)
    legend(axes[-1])
    return ax


def _names(figure):
    kind = figure.spec.kind
    pattern = {"psi_c_error": "{:g} elements", "temperature": "{:g} °C", "maxwell": "ψ = {:g}",
               "friction": "δ₁ = {:g}"}.get(kind, "γ = {:g}")
    special = {"friction": {0: "elastic"}}.get(kind, {0: "Kelvin-Voigt"} if pattern[0] == "γ" else {})
    return [special.get(value, pattern.format(value) if value == value else "Maxwell")
            for value in figure.spec.curves]


def _style(figure, curve, **more):
    return {**plot.look(curve, figure.curves), **more}


def _points(figure, ax, quantity, x=None, names=None, **style):
    """The drawn impacts, and which of them pass a limit of the model."""
    x = figure.x if x is None else x
    y = np.array(getattr(figure.pairs, quantity), float)
    if quantity == "ex":
        y[np.isinf(figure.pairs.contact_time)] = np.nan  # it stays in contact, and there is no after
    for curve in range(figure.curves):
        of = figure.curve == curve
        ax.plot(x[of], y[of], label=names[curve] if names else None, **_style(figure, curve, **style))
    mark_limits(ax, x, y, figure.pairs.flags)


def _curves(figure, ax, quantity):
    """Lines of the dimensionless numbers, and the impacts drawn as points on them."""
    for curve, name in enumerate(_names(figure)):
        ax.plot(figure.lines.x, getattr(figure.lines, quantity)[curve], label=name,
                **_style(figure, curve, marker=""))
    _points(figure, ax, quantity, linestyle="")


def _axis(figure, ax, label, ylabel, title=""):
    ax.set(xscale="log", xlabel=label, ylabel=ylabel, title=title, xlim=(figure.spec.low, figure.spec.high))


def _over_delta1(figure, ax):
    quantity = "ez" if figure.spec.kind == "ez" else "ex"
    _curves(figure, ax, quantity)
    _axis(figure, ax, "δ₁", _QUANTITIES[quantity])
    if quantity == "ez":
        ax.set_ylim(0, 1.02)


def _map(figure, ax):
    shape = figure.curves, -1
    psi = figure.aims["psi"].reshape(shape)[:, 0]
    whole = SimpleNamespace(ex=np.where(figure.pairs.status < 0, np.nan, figure.pairs.ex).reshape(shape).T)
    plot.map(figure.aims["delta1"][:figure.spec.points], psi, whole, "ex", xlabel="δ₁", ylabel="ψ",
             log=(True, False), ax=ax)
    flags = figure.pairs.flags
    ax.plot(figure.lines.x, formula(figure.lines.ez[0]), color=RED, linestyle="-.", linewidth=2.2,
            label=r"$\psi_c$")
    ax.axhline(1, color="#440154", label="ψ = 1")
    mark_limits(ax, figure.aims["delta1"], figure.aims["psi"], flags)


def _psi_c(figure, ax):
    error = figure.spec.kind == "psi_c_error"
    delta1 = figure.aims["delta1"].reshape(figure.curves, -1)
    for curve, name in enumerate(_names(figure)):
        if error:
            ez = figure.expected.ez.reshape(delta1.shape)[curve]
            ax.plot(delta1[curve], abs(figure.psi_c[curve] / formula(ez) - 1), label=name,
                    **_style(figure, curve))
            continue
        ax.plot(figure.lines.x, formula(figure.lines.ez[curve]), label=name, **_style(figure, curve, marker=""))
        ax.plot(delta1[curve], figure.psi_c[curve], **_style(figure, curve, linestyle=""))
    _axis(figure, ax, "δ₁", r"|simulated ψ over ψ of (31), − 1|" if error else r"$\psi_c$")
    if error:
        ax.set_yscale("log")


def _maxwell(figure, first, second):
    limit = no_rebound_limit()
    for ax, quantity, title in ((first, "ez", "Normal restitution"), (second, "ex", "Tangential restitution")):
        _curves(figure, ax, quantity)
        _axis(figure, ax, "τ / T", _QUANTITIES[quantity], title)
        ax.axvline(limit, color=RED, linestyle="-.", linewidth=2.2, label="limit of rebound")
    first.set_ylim(bottom=0)


def _temperature(figure, first, second):
    for ax, quantity, title in ((first, "ez", "Normal restitution"), (second, "ex", "Tangential restitution")):
        _points(figure, ax, quantity, names=_names(figure), marker="")
        _axis(figure, ax, "normal speed (m/s)", _QUANTITIES[quantity], title)
    first.set_ylim(bottom=0)


def _tangent(figure, ax):
    _points(figure, ax, "ez", loss_tangent(figure), _names(figure), linestyle="")
    _axis(figure, ax, "loss tangent at the frequency  1 / (2 contact time)", "$e_z$")
    ax.set(xlim=(figure.spec.low, 20), ylim=(0, 1.02))


def _friction(figure, first, second):
    x = figure.along(np.arange(LINE) / (LINE - 1))
    parts = (figure.ledger.friction_x, figure.ledger.viscous_x + figure.ledger.left_x)
    for ax, part, title in zip((first, second), parts, ("To friction", "To the material")):
        for curve, name in enumerate(_names(figure)):
            ax.plot(x, part[curve], label=name, **_style(figure, curve, marker=""))
        ax.set(xlabel="ψ", ylabel="part of the tangential energy", title=title, ylim=(0, 1))


def loss_tangent(figure):
    """G''/G' at half a period per contact time, of the solid of G1 = 1 or the Maxwell body of G = 1;
    nan without rebound. Shape (n,)."""
    delta1, gamma, tau = (figure.aims[name] for name in ("delta1", "gamma", "tau"))
    time = np.where(np.isfinite(figure.expected.contact_time), figure.expected.contact_time, np.nan)
    omega, theta = np.pi / time, np.sqrt(32 / 15) * delta1
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
        depth, v, force = depth + step * w, v - step * 15 / 8 * f, force + step * (d**0.5 * w - f / tau)
    return v > 0 and 7.5 * tau**2 * depth**0.5 < 1


def no_rebound_limit():
    """Least tau/T with which a sphere leaves a Maxwell body."""
    low, high = 0.1, 3.0
    while high - low > 1e-5:
        tau = 0.5 * (low + high)
        low, high = (tau, high) if _sinks_in(tau) else (low, tau)
    return high
