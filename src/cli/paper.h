/* The algorithm of the paper as it was published: the yardstick of the report, not a method of the library.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_PAPER_H
#define BENCH_PAPER_H

#include <stddef.h>
#include <stdint.h>

/* One impact in dimensionless form (docs/theory.md). psi > 0. */
struct paper_problem {
    double chi, psi;
    double g_inf, eta; /* modulus over G_r, viscosity over G_r T */
    size_t n_terms;
    const double *g, *tau; /* over G_r and T */
};

/* How the sphere moves. EULER: positions first, velocities last, as in the paper. VERLET: velocity Verlet, as in its
 * section 4. FORWARD: Euler of the textbook, both from the state before the step; what the order of the first is
 * worth. */
enum paper_motion { PAPER_EULER, PAPER_VERLET, PAPER_FORWARD };

/* Fixed for the whole run. */
struct paper_settings {
    enum paper_motion motion;
    int64_t elements; /* of half the foundation; by symmetry the other half is the same */
    double spacing;   /* a_el */
    double step;      /* T */
    int64_t max_steps;
    int trial_sign; /* nonzero: slip takes the sign of the trial force and not that of the step before, (16) */
};

enum paper_end {
    PAPER_SEPARATED,
    PAPER_UNSTABLE, /* not finite, or still in contact after max_steps */
    PAPER_NO_MEMORY
};

struct paper_result {
    double ez, ex;
    int64_t steps, updates;
    int64_t sticking; /* how often an element stuck, all steps together */
};

/* The result is filled only for PAPER_SEPARATED. */
enum paper_end paper_solve(const struct paper_problem *problem, const struct paper_settings *settings,
                           struct paper_result *result);

#endif
