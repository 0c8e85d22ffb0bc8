# SPDX-License-Identifier: BSD-3-Clause
"""The viscosity of a golf ball from four drops onto marble, and how it bounces at other speeds.

    python3 fit.py [FIGURE]         default: fit.svg

Needs the component fit (GSL).
"""

import sys
from pathlib import Path

import numpy as np

import restitute

golf = Path(__file__).parents[1] / "fit" / "golf.csv"
drop, rebound = np.loadtxt(golf, delimiter=",", skiprows=3).T  # m

# Rebound heights tell the losses; the stiffness they cannot tell, so it is given.
ball = {"radius": 0.021, "mass": 0.0415}
fit = restitute.fit_drop_test(
    drop_height=drop, rebound_height=rebound, model="kelvin_voigt", known={"modulus1": 1e8}, **ball
)
print(fit)  # with its remarks: here that the ball is pressed deeper than the model likes

impact = restitute.pair(fit.material, friction=0.3, speed=[0.1, 1], angle=30, **ball)
print("ez =", impact.ez.round(3), "at 0.1 and 1 m/s, 30 degrees")

ax = restitute.plot.fit(fit)
figure = sys.argv[1] if len(sys.argv) > 1 else "fit.svg"
restitute.plot.save(ax, figure)
print("figure:", figure)
