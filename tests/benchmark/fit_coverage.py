# SPDX-License-Identifier: BSD-3-Clause
"""Do 95 % intervals of fitted constants hold the true ones in 95 % of the cases?

    fit_coverage.py [DRAWS [SEED]]            default 200, 2017

Synthetic drop tests of random solids, 20 speeds over three decades, Gaussian noise on e_z
(absolute) and on the contact time (relative). Prints a row of CSV a model, noise, kind of data and
constant, for docs/records/fit.md.
"""
import sys
import warnings

import numpy as np

import restitute
from restitute import Material, errors

SPEED = np.geomspace(0.01, 10, 20)
BALL = dict(radius=0.005, mass=0.004)
PRONY_TIMES = (3e-5, 3e-3)


def draw(model, rng):
    """A solid near 1 MPa whose times are near the contact's, some milliseconds; its constants in
    the order of the fit."""
    def between(low, high):
        return low * (high / low) ** rng.uniform()

    g1, tau = between(3e5, 3e6), between(1e-4, 1e-3)
    if model == "kelvin_voigt":
        constants = [g1, g1 * tau]
        return Material.kelvin_voigt(*constants), constants
    if model == "maxwell":
        constants = [g1, 30 * g1 * tau]  # below, it hardly rebounds
        return Material.maxwell(*constants), constants
    if model == "prony":
        constants = [g1, g1 * between(0.1, 3), g1 * between(0.1, 3)]
        return Material.prony(PRONY_TIMES, constants[1:], g1), constants
    g2 = g1 * between(0.3, 10)
    return Material.standard_solid(g1, g2, g2 * tau), [g1, g2, g2 * tau]


def measure(model, noise, rng):
    """Constants, e_z and contact time of a solid. Those whose e_z comes within three standard
    deviations of 0 or 1 are drawn again: the noise would be cut off there."""
    while True:
        solid, truth = draw(model, rng)
        true = restitute.pair(solid, normal_speed=SPEED, method="sync", tolerance=1e-7,
                              friction=0, **BALL)
        if np.all((true.ez > 3 * noise) & (true.ez < 1 - 3 * noise)):
            ez = np.clip(true.ez + noise * rng.normal(size=SPEED.size), 0, 1)
            return truth, ez, true.contact_time * (1 + noise * rng.normal(size=SPEED.size))


def campaign(model, noise, with_time, draws, rng):
    held, open_ended, failed, names = 0, 0, 0, []
    for _ in range(draws):
        truth, ez, contact_time = measure(model, noise, rng)
        words = dict(contact_time=contact_time) if with_time else {}
        if not with_time:
            first = restitute.fitting.MODELS[model][0]
            words["known"] = {first: truth[0]}
        try:
            fit = restitute.fit_drop_test(ez=ez, speed=SPEED, model=model, **BALL, **words,
                                          terms=PRONY_TIMES if model == "prony" else ())
        except errors.SolverError:
            failed += 1
            continue
        names = fit.names
        held = held + ((fit.low <= truth) & (truth <= fit.high))
        open_ended = open_ended + (np.isinf(fit.high) & (fit.low <= 0))
    for i in range(0 if with_time else 1, len(names)):
        determined = (held[i] - open_ended[i]) / max(1, draws - failed - open_ended[i])
        data = "ez and contact time" if with_time else f"ez; {names[0]} known"
        print(f"{model},{noise},{data},{names[i]},{held[i] / draws:.3f},{determined:.3f},"
              f"{open_ended[i]},{failed}", flush=True)


def main(draws="200", seed="2017"):
    warnings.simplefilter("ignore")
    rng = np.random.default_rng(int(seed))
    print("model,noise,data,constant,coverage,of_determined,not_determined,failed")
    for model in ("kelvin_voigt", "standard_solid", "maxwell", "prony"):
        for with_time in (True, False):
            for noise in (0, 0.01, 0.03, 0.05):
                campaign(model, noise, with_time, int(draws), rng)


if __name__ == "__main__":
    main(*sys.argv[1:])
