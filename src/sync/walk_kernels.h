/* The walk over the elements, fortran/sync/walk/elements.f90, and the twins of its derived types.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_WALK_H
#define RST_WALK_H

#include "base/kernels.h"

/* Twin of walk_type. */
struct walk {
    int64_t n, n_terms, capacity, start, end, no_slip, prescribed;
    double chi, psi, g_inf, eta;
};

/* Twin of walk_level_type. */
struct walk_level {
    double step, radius, depth, velocity, force;
};

/* Twin of walk_shear_type. */
struct walk_shear {
    double velocity, force;
};

/* Twin of walk_term_type. */
struct walk_term {
    double g, decay, from_start, from_end, normal;
};

enum { walk_columns = 6, walk_lanes = 8 };

/* Sizes: level and shear 2 n + 1, memory (2 n + 1) n_terms, term n_terms + 1, body capacity walk_columns,
 * stress 2 capacity (n_terms + 1). */
void rst_follow_elements(const struct walk *walk, const double *g, const double *tau, const struct walk_level *level,
                         const double *memory, struct walk_shear *shear, struct walk_term *term, double *body,
                         double *stress, struct rst_ledger *ledger);

#endif
