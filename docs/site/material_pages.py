# SPDX-License-Identifier: BSD-3-Clause
"""A page for each material that the package knows by name: constants, moduli, the figure to try."""
from __future__ import annotations

import json
import warnings
from pathlib import Path

import numpy as np
import tables

import restitute
from restitute import plot

MODELS = {"prony": "Prony series", "kelvin_voigt": "Kelvin-Voigt", "maxwell": "Maxwell"}
WINDOW = """, or
a contact time at which the material was not measured"""
COUPLED = """ Dundurs' beta
of the two is {beta:.2g}, above the limit of {limit:g}: their normal and tangential problem are coupled,
which the model neglects."""
PAGE = """# {title}

{source}

{constants}
    restitute pair --material {name} --radius 0.005 --density 7800 --friction 0.3 \\
        --speed 0.1 --angle 30

## Try an impact

A solid ball hits a thick wall. One of them is of this material and the other one is rigid.{coupled}

<div class="impact" id="impact"><noscript>This figure needs JavaScript.</noscript></div>
<script type="application/json" id="impact-table">{table}</script>
<script src="../_static/impact.js" defer></script>

Shaded is what lies beyond the [limits of the model](../docs/theory.md#11-when-the-model-holds): a
contact radius above {radius:g} of the ball's radius, a normal speed above {speed:g} of the shear
wave speed, a slide above {displacement:g} of the contact radius{window}. There the numbers are those
of the model and not of the ball. [How far off they are](../docs/soft_contacts.md) depends on which
of the two is soft.

The figure interpolates in a table that the library made. {count} random impacts within the ranges
of the sliders differ by less than {error_ez:.1g} in e_z and {error_ex:.1g} in e_x from what the
library computes.

{moduli}"""


def _coupled(material):
    """A sentence if the flag COUPLED is set with friction, as it is at all speeds then."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", restitute.ModelLimitWarning)
        pair = restitute.pair(material, radius=0.005, density=7800, friction=0.3, speed=1e-3)
    limit = pair.settings.dundurs_limit
    return COUPLED.format(beta=pair.dundurs_beta, limit=limit) if pair.dundurs_beta > limit else ""


def _number(value):
    return f"{value:.4g}"


def _pascal(value):
    for unit, name in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")):
        if value >= unit:
            return f"{value / unit:.3g} {name}"
    return f"{value:.3g} Pa"


def _constants(material):
    series = material.series
    elastic = not len(series.modulus) and not series.parallel_viscosity
    window = tables.window_of(material)
    rows = [("model", MODELS.get(material.model, material.model.replace("_", " "))),
            ("Poisson's ratio", _number(material.poisson_ratio)),
            ("density", _number(material.density) + " kg/m³" if material.density > 0 else "not given"),
            ("shear modulus" if elastic else "shear modulus of fast impacts",
             _pascal(series.equilibrium_modulus + series.modulus.sum()))]
    if len(series.modulus):
        low, high = series.relaxation_time.min(), series.relaxation_time.max()
        rows += [("shear modulus after long times", _pascal(series.equilibrium_modulus)),
                 ("relaxation times", f"{len(series.modulus)}: {low:.3g} s to {high:.3g} s"
                  if len(series.modulus) > 1 else f"{low:.3g} s")]
    if np.isfinite(material.temperature):
        rows.append(("temperature", f"{material.temperature:g} °C"))
    if series.parallel_viscosity > 0:
        rows.append(("viscosity", _number(series.parallel_viscosity) + " Pa s"))
    if window:
        rows.append(("measured for contacts", f"of {window[0]:.2g} s to {window[1]:.2g} s"))
    return "| | |\n|---|---|\n" + "".join(f"| {name} | {value} |\n" for name, value in rows)


def _moduli(material, name, folder):
    """Figures of the moduli; none of an elastic solid, whose modulus is a number."""
    series = material.series
    if not len(series.modulus):
        return ""
    low, high = 0.1 * series.relaxation_time.min(), 10 * series.relaxation_time.max()
    axes = plot.relaxation(material, np.geomspace(low, high, 300), ax=plot.sheet())
    axes.get_legend().remove()  # one curve, whose name is the title of the page
    plot.save(axes, folder / f"{name}-relaxation.svg")
    axes = plot.moduli(material, np.geomspace(1 / high, 1 / low, 300), ax=plot.sheet())
    plot.save(axes, folder / f"{name}-moduli.svg")
    return ("## Moduli\n\n"
            f"![Relaxation modulus G(t)]({name}-relaxation.svg)\n\n"
            f"![Storage and loss modulus]({name}-moduli.svg)\n")


def write_all(stage):
    """The pages, as paths."""
    pages, folder = [], stage.out / "materials"
    folder.mkdir(parents=True)
    for name in restitute.material_names():
        material = restitute.material(name)
        table = tables.table_of(material)
        pages.append(Path("materials") / f"{name}.md")
        stage.write(pages[-1], PAGE.format(
            title=material.name or name, source=material.source or "", name=name,
            constants=_constants(material), moduli=_moduli(material, name, folder),
            table=json.dumps(table, separators=(",", ":"), allow_nan=False), count=tables.CHECKED,
            window=WINDOW if table["window"] else "", coupled=_coupled(material),
            error_ez=table["error"]["ez"], error_ex=table["error"]["ex"], **table["limits"]))
    return pages
