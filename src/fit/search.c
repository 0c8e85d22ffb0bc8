/* The search: a quasi-random scan, local fits, differences.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "search.h"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "least.h"

/* SCAN sets are solved for the starts: 64 find the valley of three constants; more cost more than a further start.
 * STEP is that of differences in the logarithm: at 1e-3 truncation and the solver's 1e-6 both stay near 1e-3 of them.
 * ROUGH and FINE: iterations of a fit from a start and of the last one from the best. Most need five. Two starts that end
 * with sums alike within ALIKE have found the same valley: the others are left out. */
enum { SCAN = 64, ROUGH = 8, FINE = 40 };
static const double STEP = 1e-3, ALIKE = 1e-2;

/* Tolerance of the impacts: of scan and starts, and of the end: below every measurement. */
static const double COARSE = 1e-4, PRECISE = 1e-6;

int rst_fit_search_create(struct rst_fit_data *data, const struct rst_fit_model *model, const double *weight,
                          size_t starts, struct rst_fit_search *s)
{
    const size_t sets = model->free + 1;
    *s = (struct rst_fit_search){.data = data, .model = *model, .weight = weight, .starts = starts, .sum = INFINITY};
    s->start = calloc(starts * model->free + 1, sizeof *s->start);
    s->sets = calloc(sets * model->count, sizeof *s->sets);
    s->values = calloc(sets * data->n, sizeof *s->values);
    if (s->start && s->sets && s->values) return RESTITUTE_OK;
    rst_fit_search_release(s);
    return RESTITUTE_ERROR_MEMORY;
}

void rst_fit_search_release(struct rst_fit_search *s)
{
    free(s->start);
    free(s->sets);
    free(s->values);
    *s = (struct rst_fit_search){0};
}

static double weighted(const struct rst_fit_search *s, size_t row, size_t set)
{
    const struct rst_fit_row *r = &s->data->row[row];
    return sqrt(s->weight[row]) * rst_fit_residual(r, &s->values[set * s->data->n + r->point]);
}

static int residuals(void *own, const double *x, double *r)
{
    struct rst_fit_search *s = own;
    rst_fit_constants(&s->model, x, s->sets);
    const int status = rst_fit_solve(s->data, &s->model, 1, s->sets, s->values);
    for (size_t i = 0; i < s->data->rows; i++)
        r[i] = weighted(s, i, 0);
    return status;
}

static int jacobian(void *own, const double *x, double *j)
{
    struct rst_fit_search *s = own;
    const size_t p = s->model.free;
    double moved[RESTITUTE_FIT_CONSTANTS];
    for (size_t k = 0; k <= p; k++) { /* the last set is x itself */
        memcpy(moved, x, p * sizeof *x);
        if (k < p) moved[k] += STEP;
        rst_fit_constants(&s->model, moved, s->sets + k * s->model.count);
    }
    const int status = rst_fit_solve(s->data, &s->model, p + 1, s->sets, s->values);
    for (size_t i = 0; i < s->data->rows; i++)
        for (size_t k = 0; k < p; k++) {
            const double rise = weighted(s, i, k) - weighted(s, i, p);
            j[i * p + k] = fabs(rise) < 100 ? rise / STEP : 0; /* one of them was not solved */
        }
    return status;
}

/* The SCAN points as sums of squares and constants; the sequence is shifted by the seed, modulo 1. */
static int solve_scan(struct rst_fit_search *s, gsl_qrng *sequence, double *sums, double *logs)
{
    const struct rst_fit_model *m = &s->model;
    uint64_t state = s->data->options.seed;
    double at[RESTITUTE_FIT_CONSTANTS], offset[RESTITUTE_FIT_CONSTANTS];
    int status = RESTITUTE_OK;
    for (size_t k = 0; k < m->free; k++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        offset[k] = (double)(state >> 11) * 0x1p-53;
    }
    for (size_t i = 0; i < SCAN && status >= 0; i++) {
        double *x = logs + i * m->free;
        gsl_qrng_get(sequence, at);
        for (size_t k = 0; k < m->free; k++)
            x[k] = m->centre[m->index[k]] + (2 * fmod(at[k] + offset[k], 1) - 1) * m->spread[m->index[k]];
        rst_fit_constants(m, x, s->sets);
        status = rst_fit_solve(s->data, m, 1, s->sets, s->values);
        for (size_t r = 0; r < s->data->rows; r++)
            sums[i] += pow(weighted(s, r, 0), 2);
    }
    return status;
}

int rst_fit_scan(struct rst_fit_search *s)
{
    const size_t p = s->model.free;
    if (p == 0) return RESTITUTE_OK;
    double *sums = calloc(SCAN + SCAN * p, sizeof *sums);
    size_t order[SCAN];
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)p);
    s->data->solver.tolerance = COARSE;
    int status = sums && sequence ? solve_scan(s, sequence, sums, sums + SCAN) : RESTITUTE_ERROR_MEMORY;
    if (status >= 0) {
        gsl_sort_index(order, sums, 1, SCAN);
        for (size_t i = 0; i < s->starts; i++)
            memcpy(s->start + i * p, sums + SCAN + order[i % SCAN] * p, p * sizeof *sums);
    }
    if (sequence) gsl_qrng_free(sequence);
    free(sums);
    return status;
}

/* A fit from x; kept if it is better than what is there. */
static int fit_from(struct rst_fit_search *s, double *x, int most, double tolerance, double settled)
{
    const struct rst_least least = {.rows = s->data->rows,
                                    .unknowns = s->model.free,
                                    .residuals = residuals,
                                    .jacobian = jacobian,
                                    .own = s,
                                    .most = most,
                                    .exact = 0.01 * (double)s->data->rows * tolerance * tolerance,
                                    .settled = settled};
    double sum = INFINITY;
    int converged = 0;
    s->data->solver.tolerance = tolerance;
    const int status = rst_fit_minimise(&least, x, &sum, &converged);
    if (status < 0) return status;
    s->agreed = converged && fabs(sum - s->sum) <= ALIKE * sum + least.exact;
    if (sum < s->sum) {
        s->sum = sum;
        s->converged = converged;
        memcpy(s->logs, x, s->model.free * sizeof *x);
    }
    return RESTITUTE_OK;
}

int rst_fit_local(struct rst_fit_search *s, size_t start)
{
    if (s->agreed || s->model.free == 0) return RESTITUTE_OK;
    return fit_from(s, s->start + start * s->model.free, ROUGH, COARSE, 1e-3);
}

int rst_fit_again(struct rst_fit_search *s)
{
    double x[RESTITUTE_FIT_CONSTANTS], *r;
    memcpy(x, s->logs, sizeof x);
    s->sum = INFINITY;
    if (s->model.free) return fit_from(s, x, FINE, PRECISE, 1e-5);
    int status = RESTITUTE_ERROR_MEMORY; /* nothing to fit: the sum alone */
    if ((r = malloc(s->data->rows * sizeof *r))) status = residuals(s, x, r);
    s->sum = 0, s->converged = 1;
    for (size_t i = 0; r && i < s->data->rows; i++)
        s->sum += r[i] * r[i];
    free(r);
    return status;
}

int rst_fit_residuals(struct rst_fit_search *s, double *r)
{
    return residuals(s, s->logs, r);
}

int rst_fit_jacobian(struct rst_fit_search *s, double *j)
{
    return jacobian(s, s->logs, j);
}
