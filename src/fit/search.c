/* The search: a quasi-random scan, local fits, differences.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit/search.h"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/least.h"

/* SCAN sets a constant are solved for the starts, up to MOST_SCAN: 48 suffice to find the minimum
 * of three constants. Shifts are scanned by DECADES up and down: beyond, solids are elastic or
 * relaxed. STEPS of a local fit and ROUNDS of the last one; most need eight and two. USUAL: starts
 * that are fitted, to find other constants that fit as well. With two terms and e alone every
 * second draw has two solids. 4 starts miss one of them in 3 %, 6 in 1.5 %, but twenty points must
 * take less than a second. More starts are fitted only if residuals are far too large. */
enum { SCAN = 16, MOST_SCAN = 64, DECADES = 4, STEPS = 20, ROUNDS = 8, USUAL = 5 };

/* Two fits are separate if a constant differs by more than a factor of exp(APART). The sum of
 * squares of the other one may be larger by LIKELY variances of the noise, which is three standard
 * deviations. (With two, at 3 % noise, 5 of 46 constants of two terms that counted as determined
 * belonged to the wrong minimum.) It may be FAIR times as large before both are fitted
 * precisely. */
static const double APART = 0.5, LIKELY = 9, FAIR = 3;

/* Tolerance of the impacts: of scan and starts, and of the end: below every measurement. A fit ends
 * when its sum changes by less than the last part: 1e-5 of 20 squares is 0.015 standard deviations
 * of a constant. */
static const double COARSE[] = {1e-4, 1e-3}, PRECISE[] = {1e-6, 1e-5};

int rst_fit_search_create(struct rst_fit_data *data, const struct rst_fit_model *model, const double *weight,
                          size_t starts, struct rst_fit_search *s)
{
    const size_t sets = model->free + 1;
    *s = (struct rst_fit_search){.data = data, .model = *model, .weight = weight, .starts = starts, .sum = INFINITY};
    s->other_sum = INFINITY;
    s->start = calloc(starts * model->free + 1, sizeof *s->start);
    s->sets = calloc(sets * model->count, sizeof *s->sets);
    s->values = calloc(sets * data->n, sizeof *s->values);
    s->r = calloc(data->rows, sizeof *s->r);
    if (s->start && s->sets && s->values && s->r) return RESTITUTE_OK;
    rst_fit_search_release(s);
    return RESTITUTE_ERROR_MEMORY;
}

void rst_fit_search_release(struct rst_fit_search *s)
{
    free(s->start);
    free(s->sets);
    free(s->values);
    free(s->r);
    *s = (struct rst_fit_search){0};
}

static double residual(const struct rst_fit_search *s, size_t row, size_t set)
{
    return (s->weight ? sqrt(s->weight[row]) : 1) * rst_fit_residual(s->data, row, s->values + set * s->data->n);
}

static int residuals(void *own, const double *x, double *r)
{
    struct rst_fit_search *s = own;
    rst_fit_constants(&s->model, x, s->sets);
    const int status = rst_fit_solve(s->data, &s->model, 1, s->sets, s->values);
    for (size_t i = 0; i < s->data->rows; i++)
        r[i] = residual(s, i, 0);
    return status;
}

/* Finite differences: with this step the truncation error is as large as that from the error of the
 * impacts. */
static int jacobian(void *own, const double *x, const double *r, double *j)
{
    struct rst_fit_search *s = own;
    const size_t p = s->model.free;
    const double step = sqrt(s->data->solver.tolerance);
    double moved[RESTITUTE_FIT_CONSTANTS];
    for (size_t k = 0; k < p; k++) {
        memcpy(moved, x, p * sizeof *x);
        moved[k] += step;
        rst_fit_constants(&s->model, moved, s->sets + k * s->model.count);
    }
    const int status = rst_fit_solve(s->data, &s->model, p, s->sets, s->values);
    for (size_t i = 0; i < s->data->rows; i++)
        for (size_t k = 0; k < p; k++) {
            const double rise = residual(s, i, k) - r[i];
            j[i * p + k] = fabs(rise) < 100 ? rise / step : 0; /* one of them was not solved */
        }
    return status;
}

static int solve_sum(struct rst_fit_search *s, const double *x, double *sum)
{
    const int status = residuals(s, x, s->r);
    *sum = 0;
    for (size_t i = 0; i < s->data->rows; i++)
        *sum += s->r[i] * s->r[i];
    return status;
}

/* How many of the fitted constants are not shifts: these are the first ones. */
static size_t before_shifts(const struct rst_fit_model *m)
{
    size_t k = 0;
    while (k < m->free && m->index[k] < m->shift)
        k++;
    return k;
}

/* The best shifts for a solid. Rows of a temperature depend on its own shift alone: all shifts take
 * a value of the grid at once, and each temperature keeps its best value, or the one in x if it is
 * `known`. */
static int scan_shifts(struct rst_fit_search *s, int known, double *x, double *sum)
{
    const struct rst_fit_data *d = s->data;
    const size_t first = before_shifts(&s->model), p = s->model.free;
    double best[RESTITUTE_DMA_SHIFTS], trial[RESTITUTE_FIT_CONSTANTS];
    int status = RESTITUTE_OK;
    if (first == p) return solve_sum(s, x, sum);
    for (size_t t = 0; t < d->temperature.count; t++)
        best[t] = INFINITY;
    memcpy(trial, x, p * sizeof *x);
    for (int decade = -DECADES - known; decade <= DECADES && status >= 0; decade++) {
        double sums[RESTITUTE_DMA_SHIFTS] = {0};
        for (size_t k = first; k < p && decade >= -DECADES; k++)
            trial[k] = decade * log(10);
        status = residuals(s, trial, s->r);
        for (size_t i = 0; i < d->rows; i++)
            sums[d->at[d->row[i].point]] += s->r[i] * s->r[i];
        for (size_t t = 0; t < d->temperature.count; t++) {
            const size_t k = first + t - (t > d->temperature.reference);
            if (sums[t] >= best[t]) continue;
            best[t] = sums[t];
            if (t != d->temperature.reference) x[k] = trial[k];
        }
    }
    *sum = 0;
    for (size_t t = 0; t < d->temperature.count; t++)
        *sum += best[t];
    return status;
}

int rst_fit_choose(struct rst_fit_search *s, size_t sets, double *logs)
{
    const size_t p = s->model.free;
    double sums[MOST_SCAN];
    size_t order[MOST_SCAN];
    int status = RESTITUTE_OK;
    s->data->solver.tolerance = COARSE[0];
    for (size_t i = 0; i < sets && status >= 0; i++)
        status = scan_shifts(s, 0, logs + i * p, &sums[i]);
    if (status < 0) return status;
    gsl_sort_index(order, sums, 1, sets);
    for (size_t i = 0; i < s->starts; i++)
        memcpy(s->start + i * p, logs + order[i % sets] * p, p * sizeof *logs);
    return status;
}

/* The sequence is shifted by the seed, modulo 1. */
int rst_fit_scan(struct rst_fit_search *s)
{
    const struct rst_fit_model *m = &s->model;
    const size_t p = m->free, q = before_shifts(m), all = q ? SCAN * q : 1, sets = all < MOST_SCAN ? all : MOST_SCAN;
    uint64_t state = s->data->options.seed;
    double at[RESTITUTE_FIT_CONSTANTS], offset[RESTITUTE_FIT_CONSTANTS], logs[MOST_SCAN * RESTITUTE_FIT_CONSTANTS];
    if (p == 0) return RESTITUTE_OK;
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)(q ? q : 1));
    if (!sequence) return RESTITUTE_ERROR_MEMORY;
    for (size_t k = 0; k < q; k++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        offset[k] = (double)(state >> 11) * 0x1p-53;
    }
    for (size_t i = 0; i < sets; i++) {
        gsl_qrng_get(sequence, at);
        for (size_t k = 0; k < q; k++)
            logs[i * p + k] = m->centre[m->index[k]] + (2 * fmod(at[k] + offset[k], 1) - 1) * m->spread[m->index[k]];
    }
    gsl_qrng_free(sequence);
    return rst_fit_choose(s, sets, logs);
}

/* More starts are useful if residuals are far too large. */
static int judge(struct rst_fit_search *s)
{
    struct rst_fit_misfit m;
    int status = residuals(s, s->logs, s->r);
    if (status >= 0) status = rst_fit_misfit(s, s->data->rows - s->model.free, &m);
    s->enough = status >= 0 && !m.large && !m.surpassed;
    return status;
}

static int is_apart(const struct rst_fit_search *s, const double *x)
{
    double most = 0;
    for (size_t k = 0; k < s->model.free; k++)
        most = fmax(most, fabs(x[k] - s->logs[k]));
    return most > APART;
}

/* Of two separate fits the worse one becomes `other`, if it may be equally good and is better than
 * the present `other`. */
static void keep_other(struct rst_fit_search *s, double sum, const double *x)
{
    const double larger = fmax(sum, s->sum), smaller = fmin(sum, s->sum);
    const double allowed = s->data->options.noise_known ? FAIR * LIKELY + smaller : FAIR * smaller;
    if (!(larger <= allowed && larger < s->other_sum) || !is_apart(s, x)) return;
    s->other_sum = larger;
    memcpy(s->other, sum < s->sum ? s->logs : x, s->model.free * sizeof *x);
}

int rst_fit_judge_other(struct rst_fit_search *s)
{
    const double left = (double)s->data->rows - (double)s->model.free;
    struct rst_fit_search again;
    if (!(s->other_sum < INFINITY) || left <= 0) return RESTITUTE_OK;
    int status = rst_fit_search_create(s->data, &s->model, s->weight, 1, &again);
    if (status) return status;
    memcpy(again.logs, s->other, sizeof again.logs);
    status = rst_fit_again(&again);
    s->other_sum = INFINITY;
    if (status >= 0 && again.converged) keep_other(s, again.sum, again.logs);
    if (status >= 0 && again.sum < s->sum) {
        s->sum = again.sum, s->converged = again.converged;
        memcpy(s->logs, again.logs, sizeof s->logs);
    }
    rst_fit_search_release(&again);
    const double noise = s->data->options.noise_known ? 1 : s->sum / left;
    if (!(s->other_sum - s->sum <= LIKELY * noise)) s->other_sum = INFINITY;
    return status;
}

/* A fit from x; kept if it is better than the present one. */
static int fit_from(struct rst_fit_search *s, double *x, int rounds, const double level[2])
{
    const struct rst_least least = {.rows = s->data->rows,
                                    .unknowns = s->model.free,
                                    .residuals = residuals,
                                    .jacobian = jacobian,
                                    .own = s,
                                    .most = STEPS,
                                    .rounds = rounds,
                                    .exact = 0.01 * (double)s->data->rows * level[0] * level[0],
                                    .settled = level[1]};
    double sum = INFINITY;
    int converged = 0;
    s->data->solver.tolerance = level[0];
    const int status = rst_fit_minimise(&least, x, &sum, &converged);
    if (status < 0) return status;
    if (converged) keep_other(s, sum, x);
    if (sum < s->sum) {
        s->sum = sum;
        s->converged = converged;
        memcpy(s->logs, x, s->model.free * sizeof *x);
    }
    s->enough = s->automatic && sum < (double)s->data->rows * level[0] * level[0]; /* as small as the impacts' errors */
    return RESTITUTE_OK;
}

int rst_fit_local(struct rst_fit_search *s, size_t start)
{
    if (s->enough || s->model.free == 0) return RESTITUTE_OK;
    if (s->automatic && start == USUAL) {
        const int status = judge(s);
        if (status < 0 || s->enough) return status;
    }
    const int shifts = before_shifts(&s->model) < s->model.free; /* updates of the Jacobian are inaccurate among them */
    return fit_from(s, s->start + start * s->model.free, shifts ? 0 : 1, COARSE);
}

int rst_fit_again(struct rst_fit_search *s)
{
    double x[RESTITUTE_FIT_CONSTANTS];
    s->data->solver.tolerance = PRECISE[0];
    memcpy(x, s->logs, sizeof x);
    const int status = scan_shifts(s, 1, x, &s->sum); /* a shift may have moved to where nothing depends on it */
    if (status < 0) return status;
    s->sum = INFINITY, s->converged = 1;
    return s->model.free ? fit_from(s, x, ROUNDS, PRECISE) : solve_sum(s, x, &s->sum);
}

int rst_fit_linearise(struct rst_fit_search *s, double *j)
{
    const double *weight = s->weight;
    s->weight = NULL;
    int status = residuals(s, s->logs, s->r);
    if (status >= 0 && j && s->model.free) status = jacobian(s, s->logs, s->r, j);
    s->weight = weight;
    return status;
}

int rst_fit_rescale(struct rst_fit_search *s)
{
    const struct rst_fit_model *m = &s->model;
    double logs = 0, n = 0;
    for (size_t i = 0; i < s->data->n; i++)
        if (s->data->scene[i].material) return RESTITUTE_OK; /* a partner's moduli are a scale */
    if (m->scaled || m->kind == RESTITUTE_FIT_MODEL_PRONY) return RESTITUTE_OK;
    const int status = residuals(s, s->logs, s->r);
    for (size_t i = 0; i < s->data->n && status >= 0; i++) {
        const double modulus = rst_fit_elastic_modulus(s->data, i, s->values[i].of[RST_FIT_TIME]);
        if (isfinite(modulus) && modulus > 0) logs += log(1e6 / modulus), n++;
    }
    for (size_t k = 0; k < m->free && n > 0; k++) /* docs/fit.md: f for moduli, f^(3/5) for viscosities */
        if (m->index[k] < m->solid)
            s->logs[k] += logs / n * (m->index[k] + 1 == m->solid && m->kind != RESTITUTE_FIT_MODEL_ELASTIC ? 0.6 : 1);
    return status;
}
