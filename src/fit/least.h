/* Nonlinear least squares by GSL, with its error handler off for the time of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_LEAST_H
#define RST_FIT_LEAST_H

#include <stddef.h>

/* Residuals r(x) and their derivatives, row by row; both return a restitute_status. `r` of the
 * Jacobian are those at x. */
struct rst_least {
    size_t rows, unknowns;
    int (*residuals)(void *own, const double *x, double *r);
    int (*jacobian)(void *own, const double *x, const double *r, double *j);
    void *own;
    int most;       /* iterations */
    int rounds;     /* 0: every Jacobian is computed. Else the first of a round is, and updated from step to step */
    double exact;   /* a sum of squares below this is the end */
    double settled; /* it is also the end if two steps in a row reduce the sum by less than this share */
    int full_rank;  /* accuracy of the Jacobian: the fast algorithm is good enough */
};

/* GSL ends the program at an error. Between these two calls it does not. They may be nested and may
 * overlap in several threads. */
void rst_fit_gsl_begin(void);
void rst_fit_gsl_end(void);

/* Minimise from x. `converged` is 0 if the iterations did not suffice. Returns a
 * restitute_status. */
int rst_fit_minimise(const struct rst_least *least, double *x, double *sum, int *converged);

/* Singular values (descending) and right vectors, v[k * unknowns + j] component j of vector k, of
 * rows x unknowns. */
int rst_fit_singular(size_t rows, size_t unknowns, const double *j, double *values, double *v);

#endif
