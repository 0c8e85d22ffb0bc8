# SPDX-License-Identifier: BSD-3-Clause
"""The tangential restitution of a steel ball on polyisobutylene over speed and angle, as a map.

    python3 map.py [FIGURE]         default: map.svg
"""

import sys

import numpy as np

import restitute

polymer = restitute.material("polyisobutylene")
speed = np.geomspace(1e-5, 0.05, 25)[:, None]  # m/s, a column
angle = np.linspace(2, 88, 44)  # degrees from the normal
ball = {"radius": 0.005, "density": 7800, "friction": 0.3}

# 25 speeds times 44 angles are 1100 impacts: arrays broadcast, threads share them.
pairs = restitute.pair(polymer, **ball, speed=speed, angle=angle, threads=0)
print(f"ez from {pairs.ez.min():.3f} to {pairs.ez.max():.3f}")
print(f"ex from {pairs.ex.min():.3f} to {pairs.ex.max():.3f}")
print(f"estimated errors up to {max(pairs.error_ez.max(), pairs.error_ex.max()):.1e}")

# What lies beyond a limit of the model is shaded.
ax = restitute.plot.map(speed, angle, pairs, "ex")
figure = sys.argv[1] if len(sys.argv) > 1 else "map.svg"
restitute.plot.save(ax, figure)
print("figure:", figure)
