/* Random impacts of two corners of the domain where slip is hard to follow.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CORNERS_H
#define TEST_CORNERS_H

#include "random.h"
#include "solve.h"

/* Rotation blocked and relaxation at once: slip passes through all of the contact in a part of the
 * compression, behind an edge at which f rises within a layer that is thinner than a cell. */
static inline restitute_impact blocked_impact(uint64_t *random)
{
    const double chi = random_in(random, 1.0 / 3, 0.5), psi = random_in(random, 0.9, 1);
    const double delta1 = random_log(random, 0.01, 3);
    return impact_of(chi, psi, delta1, random_log(random, 5e-4, 0.1));
}

/* Friction so strong that e_x is that without slip, but for a few tolerances: rings of slip are
 * thinner than a cell. */
static inline restitute_impact thin_impact(uint64_t *random, double tolerance)
{
    const double chi = random_log(random, 0.34, 4), psi = random_log(random, tolerance / 8, tolerance);
    const double delta1 = random_log(random, 1e-3, 1e2);
    return impact_of(chi, psi, delta1, random_log(random, 1e-3, 1e2));
}

#endif
