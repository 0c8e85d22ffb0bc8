/* Conjugate gradients with bounds and a spectral preconditioner. After Polonsky & Keer (1999):
 * cells that would pass a bound are fixed there. Cells whose residual points away from the bound
 * become free. The search directions restart when the set of free cells changes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/bounded.h"

#include <math.h>
#include <string.h>

static void convolve(struct bem_bounded *b, const double *x, double *u)
{
    rst_bem_convolve(b->transform, b->kind, b->ld, x, u);
    b->convolutions++;
}

int rst_bem_solve_bounded(struct bem_bounded *b)
{
    const int64_t ld = b->ld, m = b->transform->m;
    double rz = 0;
    rst_bem_clamp(ld, m, b->low, b->high, b->x);
    convolve(b, b->x, b->u);
    for (int64_t i = 0;; i++) {
        double squares, count, changed, alpha, stopped;
        rst_bem_free_residual(ld, m, b->low, b->high, b->rhs, b->x, b->u, b->free, b->r, &squares, &count, &changed);
        if (squares <= b->closeness * b->closeness * count) return 0;
        if (i == b->most_iterations) return 1;
        b->iterations++;
        rst_bem_precondition(b->transform, b->kind, ld, b->r, b->z);
        if (changed > 0) rz = 0;
        rst_bem_new_direction(ld, m, b->free, b->r, b->z, &rz, b->d);
        convolve(b, b->d, b->kd);
        rst_bem_take_step(ld, m, b->low, b->high, b->r, b->kd, b->d, b->x, &alpha, &stopped);
        if (!(alpha > 0)) return 1;
        if (stopped > 0) convolve(b, b->d, b->kd);
        rst_bem_add_scaled(ld, m, alpha, b->kd, b->u);
    }
}
