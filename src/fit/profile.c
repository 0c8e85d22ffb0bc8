/* Intervals that are too wide for the linearised problem, by the profile likelihood. At their ends
 * the sum of squares, with the other constants fitted again, has increased by the amount that
 * belongs to the quantile. Where that is not followed, as for friction, a linearised interval of
 * more than a factor of 10 (WIDE) either way has no ends.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "fit/search.h"

/* LINEAR: half an interval, in the logarithm, up to which the linearised problem is used.
 * UNBOUNDED: beyond it, a factor of 1000, there is no bound. Both are chosen, not derived. NEAR:
 * relative accuracy of the increase at an end. TRIALS: enough to get from LINEAR to UNBOUNDED by
 * factors of two. */
static const double LINEAR = 0.2, UNBOUNDED = 6.9, NEAR = 0.9, WIDE = 2.302585;
enum { TRIALS = 8 };

/* Sum of squares with fitted constant k a factor of exp(away) from its best value. */
static int sum_with(struct rst_fit_search *s, const struct rst_fit_intervals *c, size_t k, double away, double *sum)
{
    const struct rst_fit_model *m = &s->model;
    const size_t p = m->free;
    double known[RESTITUTE_FIT_CONSTANTS];
    struct rst_fit_model model;
    struct rst_fit_search with;
    memcpy(known, m->known, sizeof known);
    known[m->index[k]] = exp(s->logs[k] + away);
    rst_fit_model_make(s->data, m->kind, known, &model);
    int status = rst_fit_search_create(s->data, &model, s->weight, 1, &with);
    if (status < 0) return status;
    for (size_t i = 0, next = 0; i < p; i++) /* at the end of the linearised problem */
        if (i != k) with.logs[next++] = s->logs[i] + away * c->variance[i * p + k] / c->variance[k * p + k];
    status = rst_fit_again(&with);
    *sum = with.sum;
    rst_fit_search_release(&with);
    return status;
}

/* From the linearised end outwards. */
static int find_end(struct rst_fit_search *s, const struct rst_fit_intervals *c, size_t k, double quantile, double sign,
                    double *end)
{
    const double asked = pow(quantile * c->noise, 2);
    int status = RESTITUTE_OK;
    for (int trial = 0; trial < TRIALS && status >= 0; trial++) {
        double sum = 0;
        status = sum_with(s, c, k, sign * *end, &sum);
        const double part = sqrt(fmax(sum - s->sum, 0) / asked);
        if (part >= NEAR) return status;
        *end *= fmin(2, 1 / fmax(part, 0.5));
        if (*end > UNBOUNDED) break;
    }
    *end = INFINITY;
    return status;
}

int rst_fit_profile(struct rst_fit_search *s, double quantile, struct rst_fit_intervals *c)
{
    const size_t p = s->model.free;
    int status = RESTITUTE_OK;
    for (size_t k = 0; k < p && status >= 0; k++) {
        const double linear = c->determined[k] ? quantile * sqrt(c->variance[k * p + k]) : INFINITY;
        c->below[k] = c->above[k] = linear;
        if (s->data->options.loss || s->model.index[k] >= s->model.solid || !(linear > LINEAR && linear < INFINITY)) {
            if (linear > WIDE) c->below[k] = c->above[k] = INFINITY;
            continue;
        }
        status = find_end(s, c, k, quantile, -1, &c->below[k]);
        if (status >= 0) status = find_end(s, c, k, quantile, 1, &c->above[k]);
    }
    return status;
}
