/* Impacts in SI units drawn at random that have given dimensionless numbers (22)-(24). The formulas are written out
 * here a second time, from the paper, so that a figure tests those of the library.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_DRAW_H
#define CLI_SWEEP_DRAW_H

#include <stdint.h>

#include "problem.h"

/* What an impact is to have. psi = 0: no slip, infinite friction. */
struct sweep_numbers {
    double chi, psi, delta1, gamma;
    double relaxation; /* > 0: a Maxwell body with this tau/T instead of delta1 and gamma */
};

/* Sizes, densities, moduli, friction, speeds, Poisson's ratio and moments of inertia at random, a wall or a second
 * sphere; viscosity and sliding speed, part of it by spin, follow. */
void sweep_draw(uint64_t *state, const struct sweep_numbers *numbers, struct values *values);

#endif
