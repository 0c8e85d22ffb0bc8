# SPDX-License-Identifier: BSD-3-Clause
"""Figures by matplotlib: every function takes and returns axes, and makes them without `ax`.

What lies beyond a limit of the model (`flags`) is crossed out in lines and shaded in maps.

    >>> import io, numpy as np, restitute
    >>> speed, angle = np.geomspace(0.01, 0.1, 9)[:, None], [10, 30, 50]
    >>> rubber = restitute.Material.standard_solid(1e6, 3e6, 300.0)
    >>> pairs = restitute.pair(rubber, radius=0.001, density=1200, friction=0.3, speed=speed,
    ...                        angle=angle)
    >>> ax = restitute.plot.lines(speed, pairs, "ex", curves=angle, key="angle (degrees)")
    >>> restitute.plot.save(ax, "ex.svg")
"""
from restitute.plot.contact import fit, history, moduli, relaxation, table, work
from restitute.plot.pairs import grid, grid_axes, label, lines, map
from restitute.plot.sheet import look, save, sheet

__all__ = ["fit", "grid", "grid_axes", "history", "label", "lines", "look", "map", "moduli",
           "relaxation", "save", "sheet", "table", "work"]
