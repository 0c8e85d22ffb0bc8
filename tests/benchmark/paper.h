/* The algorithm of the paper as it was published: the yardstick of the records, not a method of the
 * library.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCHMARK_PAPER_H
#define BENCHMARK_PAPER_H

#include <stddef.h>
#include <stdint.h>

enum { PAPER_TERMS = 32 };

/* One impact in dimensionless form (docs/theory.md). psi > 0. Moduli over G_r, times over T. */
struct paper_problem {
    double chi, psi, g_inf, eta;
    size_t n_terms;
    double g[PAPER_TERMS], tau[PAPER_TERMS];
};

/* How the sphere moves. EULER: positions first, velocities last, as in the paper. VERLET: velocity
 * Verlet, as in its section 4. FORWARD: Euler of the textbook, both from the state before the
 * step. */
enum paper_motion { PAPER_EULER, PAPER_VERLET, PAPER_FORWARD };

/* Fixed for the whole run. */
struct paper_settings {
    enum paper_motion motion;
    int64_t elements; /* of half the foundation; by symmetry the other half is the same */
    double spacing;   /* a_el */
    double step;      /* T */
    int64_t max_steps;
};

enum paper_end {
    PAPER_SEPARATED,
    PAPER_UNSTABLE, /* not finite, or still in contact after max_steps */
    PAPER_NO_MEMORY
};

/* The pair and the number of steps are set only for PAPER_SEPARATED. */
enum paper_end paper_solve(const struct paper_problem *problem, const struct paper_settings *settings, double *ez,
                           double *ex, int64_t *steps);

#endif
