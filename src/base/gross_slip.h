/* While all slips, q = f and U' follows from D' (docs/theory.md, section 4).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_GROSS_SLIP_H
#define RST_GROSS_SLIP_H

#include "base/problem.h"

/* Whether no element ever sticks: psi >= psi_c (31), or no friction. */
static inline int rst_never_sticks(const struct rst_problem *problem, double rebound)
{
    return problem->psi >= rst_critical_psi(problem->chi, rebound);
}

/* U' where nothing has stuck (27); without friction it does not change. */
static inline double rst_slipping_velocity(const struct rst_problem *problem, double velocity)
{
    const double slows = problem->mode == RST_FRICTIONLESS ? 0 : 2 * problem->chi * (1 - velocity);
    return problem->shear_speed - slows;
}

/* D' at which gross slip ends, with psi < psi_c: D' = U'. */
static inline double rst_end_of_gross_slip(const struct rst_problem *problem)
{
    return (2 * problem->chi - problem->psi) / (2 * problem->chi - 1);
}

/* Friction does the work int f (U' - D'), and f is minus the acceleration: D' = 1 to `velocity`. */
static inline double rst_gross_slip_work(const struct rst_problem *problem, double velocity)
{
    const double chi = problem->chi;
    return 4 * chi * ((problem->psi - 2 * chi) * (1 - velocity) + (2 * chi - 1) * (1 - velocity * velocity) / 2);
}

/* Of a sphere that has sunk in nothing is left at the end of time, neither in it nor in springs,
 * which all relax: what friction did not take is viscous work. Friction is that of gross slip, to
 * its end if it ends; slip at the edge after that is counted as viscous. */
static inline struct rst_ledger rst_sunk_ledger(const struct rst_problem *problem, double shear_velocity)
{
    double friction = 0;
    if (problem->mode == RST_GROSS_SLIP)
        friction = rst_gross_slip_work(problem, rst_never_sticks(problem, 0) ? 0 : rst_end_of_gross_slip(problem));
    const double lost = problem->shear_speed * problem->shear_speed - shear_velocity * shear_velocity;
    if (problem->mode == RST_FRICTIONLESS) return (struct rst_ledger){.viscous_z = 1};
    return (struct rst_ledger){.viscous_z = 1, .friction_x = friction, .viscous_x = lost - friction};
}

#endif
