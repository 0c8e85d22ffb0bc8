/* Conjugate gradients with bounds.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_BOUNDED_H
#define BEM_BOUNDED_H

#include "bem/transform.h"

/* K x = rhs where low < x < high, with residuals that hold x at its bounds elsewhere. Fields of m x
 * m in lines of ld. */
struct bem_bounded {
    struct bem_transform *transform;
    enum bem_kind kind;
    int64_t ld;
    const double *low, *high, *rhs;
    double *x;                     /* in: where to start; out: the solution */
    double *u;                     /* out: K x */
    double *free, *r, *z, *d, *kd; /* room */
    double closeness;              /* root mean square of the residual on free cells */
    int64_t most_iterations;
    int64_t iterations, convolutions; /* out; iterations added to what they were */
};

/* Nonzero: no convergence within most_iterations. */
int rst_bem_solve_bounded(struct bem_bounded *b);

#endif
