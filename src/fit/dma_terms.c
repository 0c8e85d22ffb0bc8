/* The terms of a Prony series from storage and loss moduli,
 *     G'(w) = G_inf + sum g x^2/(1 + x^2),  G''(w) = sum g x/(1 + x^2),  x = w a_T tau.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/dma.h"
#include "fit/least.h"

/* PER_DECADE: terms of the first series; the last has about one a decade. BEYOND: decades on both
 * sides of the window of 1/w in which terms still matter. STEPS: of one refinement. TRIES: shorter
 * series that are refined, those with the smallest misfit first, before a series counts as short
 * enough. */
enum { PER_DECADE = 2, STEPS = 40, TRIES = 3 };
static const double BEYOND = 1;

/* Unknowns: log g, log tau, log G_inf if there is one, shifts but the reference's. */
static size_t unknowns(const struct rst_dma *d)
{
    return 2 * d->terms + (d->equilibrium > 0) + (d->free_shifts ? d->temperature.count - 1 : 0);
}

static void put(struct rst_dma *d, const double *x)
{
    size_t next = 2 * d->terms;
    memcpy(d->g, x, d->terms * sizeof *x);
    memcpy(d->tau, x + d->terms, d->terms * sizeof *x);
    if (d->equilibrium > 0) d->equilibrium = exp(x[next++]);
    for (size_t t = 0; d->free_shifts && t < d->temperature.count; t++)
        if (t != d->temperature.reference) d->shift[t] = x[next++];
}

static void get(const struct rst_dma *d, double *x)
{
    size_t next = 2 * d->terms;
    memcpy(x, d->g, d->terms * sizeof *x);
    memcpy(x + d->terms, d->tau, d->terms * sizeof *x);
    if (d->equilibrium > 0) x[next++] = log(d->equilibrium);
    for (size_t t = 0; d->free_shifts && t < d->temperature.count; t++)
        if (t != d->temperature.reference) x[next++] = d->shift[t];
}

/* Residuals, and their derivatives unless j is NULL. x d/dx of x^2/(1+x^2) is 2 x^2/(1+x^2)^2, of
 * x/(1+x^2) it is x (1-x^2)/(1+x^2)^2; tau and a_T act by x alone. */
static void evaluate(const struct rst_dma *d, double *r, double *j)
{
    const size_t p = unknowns(d), m = d->terms, shifts = 2 * m + (d->equilibrium > 0);
    if (j) memset(j, 0, 2 * d->n * p * sizeof *j);
    for (size_t i = 0; i < d->n; i++) {
        const size_t t = d->group[i], other = d->temperature.reference;
        const size_t shift = d->free_shifts && t != other ? shifts + t - (t > other) : p;
        const double to_storage = 1 / (d->storage[i] * d->noise), to_loss = 1 / (d->loss[i] * d->noise);
        double *a = j ? j + i * p : NULL, *b = j ? a + d->n * p : NULL, storage = d->equilibrium, loss = 0;
        if (j && d->equilibrium > 0) a[2 * m] = d->equilibrium * to_storage;
        for (size_t k = 0; k < m; k++) {
            const double x = d->omega[i] * exp(d->shift[t] + d->tau[k]), y = 1 / (1 + x * x), g = exp(d->g[k]);
            const double of_storage = isinf(x * x) ? g : g * x * x * y, of_loss = isinf(x * x) ? g / x : g * x * y;
            storage += of_storage, loss += of_loss;
            if (!j) continue;
            a[k] = of_storage * to_storage, b[k] = of_loss * to_loss;
            a[m + k] = a[k] * 2 * y, b[m + k] = b[k] * (2 * y - 1);
            if (shift < p) a[shift] += a[m + k], b[shift] += b[m + k];
        }
        r[i] = storage * to_storage - 1 / d->noise;
        r[d->n + i] = loss * to_loss - 1 / d->noise;
    }
}

static int residuals(void *own, const double *x, double *r)
{
    put(own, x);
    evaluate(own, r, NULL);
    return RESTITUTE_OK;
}

static int jacobian(void *own, const double *x, const double *r, double *j)
{
    struct rst_dma *d = own;
    (void)r;
    put(d, x);
    evaluate(d, d->r, j);
    return RESTITUTE_OK;
}

double rst_dma_sum(const struct rst_dma *d)
{
    double sum = 0;
    evaluate(d, d->r, NULL);
    for (size_t i = 0; i < 2 * d->n; i++)
        sum += d->r[i] * d->r[i];
    return sum;
}

static int refine(struct rst_dma *d)
{
    const struct rst_least least = {.rows = 2 * d->n,
                                    .unknowns = unknowns(d),
                                    .residuals = residuals,
                                    .jacobian = jacobian,
                                    .own = d,
                                    .most = STEPS,
                                    .exact = 1e-12,
                                    .settled = 1e-4,
                                    .full_rank = 1};
    double x[2 * RESTITUTE_DMA_TERMS + RESTITUTE_DMA_SHIFTS + 1];
    int converged;
    if (least.unknowns == 0 || least.unknowns > least.rows) return RESTITUTE_OK;
    get(d, x);
    const int status = rst_fit_minimise(&least, x, &d->sum, &converged);
    put(d, x);
    return status;
}

/* The spectrum is about 2/pi of the loss modulus at 1/tau: that, at evenly spaced times, is the
 * first series. */
int rst_dma_begin(struct rst_dma *d)
{
    double low = INFINITY, high = -INFINITY;
    d->equilibrium = INFINITY;
    for (size_t i = 0; i < d->n; i++) {
        const double time = -log(d->omega[i]) - d->shift[d->group[i]];
        low = fmin(low, time), high = fmax(high, time);
        d->equilibrium = fmin(d->equilibrium, 0.5 * d->storage[i]);
    }
    const double range = high - low + 2 * BEYOND * log(10);
    d->terms = (size_t)fmin(2 + range / log(10) * PER_DECADE, RESTITUTE_DMA_TERMS);
    const double step = range / (double)(d->terms - 1);
    for (size_t k = 0; k < d->terms; k++) {
        double nearest = INFINITY;
        d->tau[k] = low - BEYOND * log(10) + step * (double)k;
        for (size_t i = 0; i < d->n; i++) {
            const double distance = fabs(log(d->omega[i]) + d->shift[d->group[i]] + d->tau[k]);
            if (distance < nearest) nearest = distance, d->g[k] = log(M_2_PI * step * d->loss[i]);
        }
    }
    return refine(d);
}

static void sort_terms(struct rst_dma *d)
{
    for (size_t i = 1; i < d->terms; i++)
        for (size_t k = i; k > 0 && d->tau[k] < d->tau[k - 1]; k--) {
            const double tau = d->tau[k], g = d->g[k];
            d->tau[k] = d->tau[k - 1], d->g[k] = d->g[k - 1];
            d->tau[k - 1] = tau, d->g[k - 1] = g;
        }
}

static void remove_term(struct rst_dma *d, size_t i)
{
    d->terms--;
    memmove(d->tau + i, d->tau + i + 1, (d->terms - i) * sizeof *d->tau);
    memmove(d->g + i, d->g + i + 1, (d->terms - i) * sizeof *d->g);
}

/* Without term i, or with it merged into the next, of their sum at their mean time; the last
 * without equilibrium modulus. */
static void make_candidate(const struct rst_dma *d, size_t which, struct rst_dma *candidate)
{
    const size_t i = which / 2;
    *candidate = *d;
    if (i == d->terms)
        candidate->equilibrium = 0;
    else {
        if (which % 2 == 0 && i + 1 < d->terms) {
            const double a = exp(d->g[i]), b = exp(d->g[i + 1]);
            candidate->tau[i + 1] = (a * d->tau[i] + b * d->tau[i + 1]) / (a + b);
            candidate->g[i + 1] = log(a + b);
        }
        remove_term(candidate, i);
    }
}

/* The best shorter series, refined, if it is better by the Bayesian information criterion: fewer
 * unknowns against a larger chi^2. */
static int shorten_once(struct rst_dma *d, int *shorter)
{
    struct rst_dma candidate;
    double cost[2 * RESTITUTE_DMA_TERMS + 1];
    const size_t count = 2 * d->terms + (d->equilibrium > 0);
    *shorter = 0;
    for (size_t w = 0; w < count; w++) {
        make_candidate(d, w, &candidate);
        cost[w] = candidate.terms ? rst_dma_sum(&candidate) : INFINITY;
    }
    for (int t = 0; t < TRIES && !*shorter; t++) {
        size_t best = 0;
        for (size_t w = 1; w < count; w++)
            if (cost[w] < cost[best]) best = w;
        if (isinf(cost[best])) return RESTITUTE_OK; /* no other is left */
        cost[best] = INFINITY;
        make_candidate(d, best, &candidate);
        const int status = refine(&candidate);
        if (status < 0) return status;
        *shorter = unknowns(d) > 2 * d->n || /* more terms than any data determine, and not refined */
                   candidate.sum - d->sum < (double)(unknowns(d) - unknowns(&candidate)) * log(2 * (double)d->n);
    }
    if (*shorter) *d = candidate;
    return RESTITUTE_OK;
}

int rst_dma_shorten(struct rst_dma *d)
{
    int status = RESTITUTE_OK;
    for (int shorter = 1; shorter && (d->terms > 1 || d->equilibrium > 0) && status >= 0;) {
        sort_terms(d);
        status = shorten_once(d, &shorter);
    }
    sort_terms(d);
    return status;
}
