/* The terms of a Prony series from storage and loss moduli,
 *     G'(w) = G_inf + sum g x^2/(1 + x^2),  G''(w) = sum g x/(1 + x^2),  x = w a_T tau.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dma.h"
#include "least.h"

/* PER_DECADE: terms of the first fit; the end has about one a decade. TURNS of that fit, which is only a start. BEYOND:
 * decades before and behind the window of 1/w, where terms still are seen. ITERATIONS of one refinement. TRIES: pairs that
 * are merged on trial, the cheapest first, before a series counts as short enough. */
enum { PER_DECADE = 2, TURNS = 500, ITERATIONS = 40, TRIES = 3 };
static const double BEYOND = 1;

static double at(const struct rst_dma *d, size_t row, double log_tau)
{
    return d->omega[row] * exp(d->shift[d->group[row]] + log_tau);
}

/* Parts of a term of g = 1 in both moduli of a row, in units of the residuals. */
static void part(const struct rst_dma *d, size_t row, double log_tau, double *storage, double *loss)
{
    const double x = at(d, row, log_tau), y = 1 / (1 + x * x);
    *storage = isinf(x * x) ? 1 : x * x * y;
    *loss = isinf(x * x) ? 1 / x : x * y;
    *storage /= d->storage[row] * d->noise;
    *loss /= d->loss[row] * d->noise;
}

void rst_dma_residuals(const struct rst_dma *d, double *r)
{
    for (size_t i = 0; i < d->n; i++) {
        r[i] = (d->equilibrium / d->storage[i] - 1) / d->noise;
        r[d->n + i] = -1 / d->noise;
        for (size_t k = 0; k < d->terms; k++) {
            double storage, loss;
            part(d, i, d->tau[k], &storage, &loss);
            r[i] += exp(d->g[k]) * storage;
            r[d->n + i] += exp(d->g[k]) * loss;
        }
    }
}

/* Unknowns: log g, log tau, log G_inf if there is one, shifts but the reference's. */
static size_t unknowns(const struct rst_dma *d)
{
    return 2 * d->terms + (d->equilibrium > 0) + (d->free_shifts ? d->temperatures - 1 : 0);
}

static void put(struct rst_dma *d, const double *x)
{
    size_t next = 2 * d->terms;
    memcpy(d->g, x, d->terms * sizeof *x);
    memcpy(d->tau, x + d->terms, d->terms * sizeof *x);
    if (d->equilibrium > 0) d->equilibrium = exp(x[next++]);
    for (size_t t = 0; d->free_shifts && t < d->temperatures; t++)
        if (t != d->reference) d->shift[t] = x[next++];
}

static void get(const struct rst_dma *d, double *x)
{
    size_t next = 2 * d->terms;
    memcpy(x, d->g, d->terms * sizeof *x);
    memcpy(x + d->terms, d->tau, d->terms * sizeof *x);
    if (d->equilibrium > 0) x[next++] = log(d->equilibrium);
    for (size_t t = 0; d->free_shifts && t < d->temperatures; t++)
        if (t != d->reference) x[next++] = d->shift[t];
}

static int residuals(void *own, const double *x, double *r)
{
    put(own, x);
    rst_dma_residuals(own, r);
    return RESTITUTE_OK;
}

/* x d/dx of x^2/(1+x^2) is 2 x^2/(1+x^2)^2, of x/(1+x^2) it is x (1-x^2)/(1+x^2)^2; tau and a_T act by x alone. */
static int jacobian(void *own, const double *x, const double *r, double *j)
{
    struct rst_dma *d = own;
    const size_t p = unknowns(d), m = d->terms;
    put(d, x);
    memset(j, 0, 2 * d->n * p * sizeof *j);
    for (size_t i = 0; i < d->n; i++) {
        double *a = j + i * p, *b = j + (d->n + i) * p;
        const size_t t = d->group[i], shifts = 2 * m + (d->equilibrium > 0);
        const size_t own_shift = d->free_shifts && t != d->reference ? shifts + t - (t > d->reference) : p;
        if (d->equilibrium > 0) a[2 * m] = d->equilibrium / (d->storage[i] * d->noise);
        for (size_t k = 0; k < m; k++) {
            const double z = at(d, i, d->tau[k]), y = isinf(z * z) ? 0 : 1 / (1 + z * z), g = exp(d->g[k]);
            part(d, i, d->tau[k], &a[k], &b[k]);
            a[k] *= g, b[k] *= g;
            a[m + k] = a[k] * 2 * y, b[m + k] = b[k] * (2 * y - 1);
            if (own_shift < p) a[own_shift] += a[m + k], b[own_shift] += b[m + k];
        }
    }
    return RESTITUTE_OK;
}

static int refine(struct rst_dma *d)
{
    const struct rst_least least = {.rows = 2 * d->n,
                                    .unknowns = unknowns(d),
                                    .residuals = residuals,
                                    .jacobian = jacobian,
                                    .own = d,
                                    .most = ITERATIONS,
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

/* Terms i and i + 1 as one, of their sum, at the mean of their logarithms by weight. */
static void merge(struct rst_dma *d, size_t i)
{
    const double a = exp(d->g[i]), b = exp(d->g[i + 1]);
    d->tau[i] = (a * d->tau[i] + b * d->tau[i + 1]) / (a + b);
    d->g[i] = log(a + b);
    d->terms--;
    memmove(d->tau + i + 1, d->tau + i + 2, (d->terms - i - 1) * sizeof *d->tau);
    memmove(d->g + i + 1, d->g + i + 2, (d->terms - i - 1) * sizeof *d->g);
}

static void take_grid(struct rst_dma *d, const double *x, size_t grid, double first, double step)
{
    d->terms = 0;
    for (size_t k = 0; k < grid; k++) {
        if (!(x[k] > 0)) continue;
        if (d->terms == RESTITUTE_DMA_TERMS) merge(d, d->terms - 2);
        d->g[d->terms] = log(x[k]), d->tau[d->terms++] = first + step * (double)k;
    }
}

/* A^T A and A^T b of the moduli on the grid, equilibrium last; both halves of a row. `work`: 2 x columns. */
static void normal_equations(const struct rst_dma *d, size_t columns, double first, double step, double *aa, double *ab,
                             double *work)
{
    double *storage = work, *loss = work + columns;
    for (size_t i = 0; i < d->n; i++) {
        for (size_t k = 0; k < columns; k++)
            part(d, i, first + step * (double)k, &storage[k], &loss[k]);
        storage[columns - 1] = 1 / (d->storage[i] * d->noise), loss[columns - 1] = 0;
        for (size_t k = 0; k < columns; k++) {
            ab[k] += (storage[k] + loss[k]) / d->noise;
            for (size_t l = 0; l < columns; l++)
                aa[k * columns + l] += storage[k] * storage[l] + loss[k] * loss[l];
        }
    }
}

/* Moduli on a grid of times by x_k (A^T b)_k/(A^T A x)_k, as Lee and Seung do: A and b are positive, so x stays so, and the
 * sum of squares never rises. */
int rst_dma_begin(struct rst_dma *d)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < d->n; i++) {
        const double time = -log(at(d, i, 0));
        low = fmin(low, time), high = fmax(high, time);
    }
    low -= BEYOND * log(10), high += BEYOND * log(10);
    const double step = log(10) / PER_DECADE;
    const size_t grid = (size_t)((high - low) / step) + 2, columns = grid + 1;
    double *aa = calloc(columns * columns + 4 * columns, sizeof *aa), *ab = aa + columns * columns, *x = ab + columns;
    if (!aa) return RESTITUTE_ERROR_MEMORY;
    normal_equations(d, columns, low, step, aa, ab, x + columns);
    for (size_t k = 0; k < columns; k++)
        x[k] = ab[k] / aa[k * columns + k];
    for (int turn = 0; turn < TURNS; turn++)
        for (size_t k = 0; k < columns; k++) {
            double sum = 0;
            for (size_t l = 0; l < columns; l++)
                sum += aa[k * columns + l] * x[l];
            x[k] *= sum > 0 ? ab[k] / sum : 0;
        }
    d->equilibrium = x[grid];
    take_grid(d, x, grid, low, step);
    free(aa);
    return refine(d);
}

static double square(const struct rst_dma *d, double *r)
{
    double sum = 0;
    rst_dma_residuals(d, r);
    for (size_t i = 0; i < 2 * d->n; i++)
        sum += r[i] * r[i];
    return sum;
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

/* Without term i, or with it merged into the next; the last one without the equilibrium modulus. */
static void make_candidate(const struct rst_dma *d, size_t which, struct rst_dma *candidate)
{
    const size_t i = which / 2;
    *candidate = *d;
    if (i == d->terms)
        candidate->equilibrium = 0;
    else if (which % 2 == 0 && i + 1 < d->terms)
        merge(candidate, i);
    else if (d->terms > 1) {
        candidate->terms--;
        memmove(candidate->g + i, d->g + i + 1, (candidate->terms - i) * sizeof *d->g);
        memmove(candidate->tau + i, d->tau + i + 1, (candidate->terms - i) * sizeof *d->tau);
    }
}

/* The cheapest shorter series, refined, if it is worth it: unknowns less against chi^2 (Bayesian information). */
static int shorten_once(struct rst_dma *d, double *r, int *shorter)
{
    struct rst_dma candidate;
    double cost[2 * RESTITUTE_DMA_TERMS + 1];
    const size_t count = 2 * d->terms + (d->equilibrium > 0);
    *shorter = 0;
    for (size_t w = 0; w < count; w++) {
        make_candidate(d, w, &candidate);
        cost[w] = square(&candidate, r);
    }
    for (int t = 0; t < TRIES && !*shorter; t++) {
        size_t best = 0;
        for (size_t w = 1; w < count; w++)
            if (cost[w] < cost[best]) best = w;
        cost[best] = INFINITY;
        make_candidate(d, best, &candidate);
        const int status = refine(&candidate);
        if (status < 0) return status;
        *shorter = unknowns(d) > 2 * d->n || /* more than any data determine, and not refined */
                   candidate.sum - d->sum < (double)(unknowns(d) - unknowns(&candidate)) * log(2 * (double)d->n);
    }
    if (*shorter) *d = candidate;
    return RESTITUTE_OK;
}

int rst_dma_shorten(struct rst_dma *d)
{
    double *r = malloc(2 * d->n * sizeof *r);
    int status = r ? RESTITUTE_OK : RESTITUTE_ERROR_MEMORY;
    for (int shorter = 1; shorter && (d->terms > 1 || d->equilibrium > 0) && status >= 0;) {
        sort_terms(d);
        status = shorten_once(d, r, &shorter);
    }
    sort_terms(d);
    free(r);
    return status;
}
