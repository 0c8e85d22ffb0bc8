/* Nonlinear least squares by GSL, with its error handler off for the time of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_LEAST_H
#define RST_FIT_LEAST_H

#include <stddef.h>

/* Residuals r(x) and their derivatives, row by row; both return a restitute_status. `r` of the Jacobian are those at x. */
struct rst_least {
    size_t rows, unknowns;
    int (*residuals)(void *own, const double *x, double *r);
    int (*jacobian)(void *own, const double *x, const double *r, double *j);
    void *own;
    int most;       /* iterations */
    int rounds;     /* 0: every Jacobian is computed. Else the first of a round is, and updated from step to step */
    double exact;   /* a sum of squares below this is the end */
    double settled; /* so is one that two steps in a row lower by less than this part */
    int full_rank;  /* the Jacobian has it: the fast way will do */
};

/* GSL ends the program at an error; between these two calls, which may nest and meet in several threads, it does not. */
void rst_fit_gsl_begin(void);
void rst_fit_gsl_end(void);

/* From x to a minimum. `converged` is 0 where the iterations were not enough. Returns a restitute_status. */
int rst_fit_minimise(const struct rst_least *least, double *x, double *sum, int *converged);

/* Singular values (descending) and right vectors, v[k * unknowns + j] component j of vector k, of rows x unknowns. */
int rst_fit_singular(size_t rows, size_t unknowns, const double *j, double *values, double *v);

#endif
