/* The search for the constants of one model, their certainty, and remarks about both.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_SEARCH_H
#define RST_FIT_SEARCH_H

#include "fit/model.h"

/* A model, its best constants so far, and room for the impacts of a step. */
struct rst_fit_search {
    struct rst_fit_data *data;
    struct rst_fit_model model;
    const double *weight; /* of the rows, for the robust losses; NULL: 1 */
    size_t starts;
    double *start; /* starts x free, the best of the scan */
    double *sets;  /* constants of the sets that are solved together */
    struct rst_fit_values *values;
    double *r;                            /* residuals at the best, without the weights */
    double logs[RESTITUTE_FIT_CONSTANTS]; /* the best */
    double sum;                           /* of its weighted squared residuals; infinite before the first start */
    double other[RESTITUTE_FIT_CONSTANTS], other_sum; /* the best fit with other constants; infinite: none */
    int converged;
    int automatic; /* starts end when there were enough: the usual number, or one came to the impacts' precision */
    int enough;
};

int rst_fit_search_create(struct rst_fit_data *data, const struct rst_fit_model *model, const double *weight,
                          size_t starts, struct rst_fit_search *search);
void rst_fit_search_release(struct rst_fit_search *search);

/* Solve sets of logarithms with the best shifts for each, and keep the best sets as starts; the
 * quasi-random ones; then a local fit from a start. */
int rst_fit_choose(struct rst_fit_search *search, size_t sets, double *logs);
int rst_fit_scan(struct rst_fit_search *search);
int rst_fit_local(struct rst_fit_search *search, size_t start);

/* At the end: the other fit precisely, with all points and weights. It becomes the best if it is
 * better. It is dropped if the noise does not explain its larger sum. */
int rst_fit_judge_other(struct rst_fit_search *search);

/* Again from the best, precisely: at the end, and after the weights changed. */
int rst_fit_again(struct rst_fit_search *search);

/* Without a scale: take contact times of an elastic solid of 1 MPa, which changes no e. */
int rst_fit_rescale(struct rst_fit_search *search);

/* Residuals at the best; and their derivatives by the logarithms, rows x free, unless j is NULL. No
 * weights. */
int rst_fit_linearise(struct rst_fit_search *search, double *j);

/* What the linearised problem says. Directions are those of the logarithms of fitted constants. */
struct rst_fit_intervals {
    double noise;  /* standard deviation of a weighted residual; NaN: no degree of freedom is left */
    double judged; /* the same, but not below the noise of a measurement: decides what is determined */
    size_t rank, dof;
    double values[RESTITUTE_FIT_CONSTANTS];                             /* singular values */
    double vector[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS];   /* directions, as of rst_fit_singular */
    double variance[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS]; /* covariance of the logarithms */
    double below[RESTITUTE_FIT_CONSTANTS],
        above[RESTITUTE_FIT_CONSTANTS]; /* the interval's ends, from the best logarithm */
    int determined[RESTITUTE_FIT_CONSTANTS];
    int otherwise[RESTITUTE_FIT_CONSTANTS]; /* not determined, since another value fits as well */
};

int rst_fit_intervals(struct rst_fit_search *search, struct rst_fit_intervals *intervals);

/* profile.c: ends of the intervals, `quantile` standard deviations away, or infinitely far. */
int rst_fit_profile(struct rst_fit_search *search, double quantile, struct rst_fit_intervals *intervals);

/* misfit.c: what the residuals in search->r say against the model: */
struct rst_fit_misfit {
    double chance;                   /* probability of so similar neighbours along speed, angle, temperature */
    double noise_e, noise_time;      /* of e and of relative contact times */
    int patterned, large, surpassed; /* similar neighbours; too much noise; more than the given standard deviations */
};

int rst_fit_misfit(const struct rst_fit_search *search, size_t dof, struct rst_fit_misfit *misfit);

/* Weights of a robust loss from residuals at the best, and the largest change of a weight. */
int rst_fit_reweigh(struct rst_fit_search *search, double *weight, double *change);

/* Remarks: what the data leave open, a pattern in the residuals, limits of the contact model. */
int rst_fit_remarks(struct rst_fit_search *search, const struct rst_fit_intervals *intervals,
                    restitute_fit_result *result);

/* The model beside a rival: as good with fewer constants, or worse than one with more. */
void rst_fit_remark_rival(const struct rst_fit_search *search, const struct rst_fit_intervals *intervals,
                          const struct rst_fit_search *rival, restitute_fit_result *result);

#endif
