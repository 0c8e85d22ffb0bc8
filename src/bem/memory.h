/* What a solver keeps for the method: transforms of the sizes used so far, and the fields of the
 * largest grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_MEMORY_H
#define BEM_MEMORY_H

#include <stddef.h>

#include "base/workspace.h"
#include "bem/transform.h"

enum { BEM_SIZES = 256 }; /* more than a solver comes to use */

/* Fields of m x m cells, all of one block. */
struct bem_fields {
    int64_t m, n_terms;
    double *p, *p_before, *p_new;          /* pressure at the last step, the one before, the one sought */
    double *tau, *tau_before, *tau_new;    /* traction along x */
    double *f_z, *f_x, *f_new;             /* K p, K tau */
    double *b_z, *b_x, *drift_z, *drift_x; /* memory of the solid; b: n_terms fields */
    double *h, *target, *low, *high;
    double *gap, *gap_before, *s, *s_before, *anchor;
    double *touched; /* > 0: has been in contact; kept for the ledger only */
    double *free, *r, *z, *d, *kd;
};

struct bem_memory {
    struct rst_own_memory base;
    struct bem_transform *transforms[BEM_SIZES];
    double *block;
    size_t block_size;
    double *terms;
    size_t terms_size;
};

/* The memory in the workspace, allocated at first use; NULL: out of memory. */
struct bem_memory *rst_bem_memory_of(struct rst_workspace *workspace);

/* Fields set to zero; nonzero: out of memory. */
int rst_bem_memory_fields(struct bem_memory *memory, int64_t m, int64_t n_terms, struct bem_fields *fields);

/* Transform of a size, made at first use; NULL: out of memory. */
struct bem_transform *rst_bem_memory_transform(struct bem_memory *memory, int64_t m);

/* Room for `count` doubles, for terms; NULL: out of memory. */
double *rst_bem_memory_terms(struct bem_memory *memory, size_t count);

#endif
