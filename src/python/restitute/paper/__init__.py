# SPDX-License-Identifier: BSD-3-Clause
"""The figures 4 to 11 of Willert, Kusche and Popov (2017) and four that go beyond, with checks.

    >>> from restitute import paper, plot
    >>> figure = paper.Figure("fig6").solve()
    >>> ax = figure.draw()
    >>> [str(check) for check in figure.checks() if not check.good]
    []
"""
from restitute.paper.checks import Check
from restitute.paper.figures import SPECS, Figure

__all__ = ["SPECS", "Check", "Figure"]
