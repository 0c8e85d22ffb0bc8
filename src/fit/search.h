/* Searching the constants of one model, and what the residuals say about them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_SEARCH_H
#define RST_FIT_SEARCH_H

#include "model.h"

/* A model, its best constants so far, and room for the impacts of a step. */
struct rst_fit_search {
    struct rst_fit_data *data;
    struct rst_fit_model model;
    const double *weight; /* of the rows, for the robust losses */
    size_t starts;
    double *start; /* starts x free, the best of the scan */
    double *sets;  /* constants of the sets that are solved together */
    struct rst_fit_values *values;
    double logs[RESTITUTE_FIT_CONSTANTS]; /* the best */
    double sum;                           /* of its squared residuals; infinite before the first start */
    int converged;
    int agreed; /* two starts came to the same sum */
};

int rst_fit_search_create(struct rst_fit_data *data, const struct rst_fit_model *model, const double *weight,
                          size_t starts, struct rst_fit_search *search);
void rst_fit_search_release(struct rst_fit_search *search);

/* Solve quasi-random sets of constants and keep the best as starts; then a local fit from one of them. */
int rst_fit_scan(struct rst_fit_search *search);
int rst_fit_local(struct rst_fit_search *search, size_t start);

/* Again from the best, precisely: at the end, and after the weights changed. */
int rst_fit_again(struct rst_fit_search *search);

/* Weighted residuals at the best, and their derivatives by the logarithms: rows x free. */
int rst_fit_residuals(struct rst_fit_search *search, double *r);
int rst_fit_jacobian(struct rst_fit_search *search, double *j);

/* What the linearised problem says. Directions are those of the logarithms of the fitted constants. */
struct rst_fit_certainty {
    double noise;  /* standard deviation of a weighted residual; NaN: no degree of freedom is left */
    double judged; /* the same, not below what any measurement has: decides what is determined */
    size_t rank, dof;
    double values[RESTITUTE_FIT_CONSTANTS];                             /* singular values */
    double vector[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS];   /* directions, as of rst_fit_singular */
    double variance[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS]; /* covariance of the logarithms */
    int determined[RESTITUTE_FIT_CONSTANTS];
};

int rst_fit_certainty(struct rst_fit_search *search, struct rst_fit_certainty *certainty);

/* Weights of a robust loss from residuals at the best, and the largest change of a weight. */
int rst_fit_reweigh(struct rst_fit_search *search, double *weight, double *change);

#endif
