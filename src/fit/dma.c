/* From a DMA curve to a solid: checks, first shifts of the temperatures, and the result.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit/dma.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "base/sized.h"
#include "fit/least.h"
#include "fit/model.h"

RST_DEFAULTS(dma_options, .poisson_ratio = 0.5, .noise = 0.01, .reference_temperature = NAN, .wlf_c1 = NAN,
             .wlf_c2 = NAN)
RST_DEFAULTS(dma_result, 0)

static int check_rows(size_t n, const double *frequency, const double *storage, const double *loss,
                      const double *temperature, restitute_error *error)
{
    const double *const arrays[] = {frequency, storage, loss};
    static const char *const names[] = {"frequency", "storage", "loss"};
    char name[40];
    for (int k = 0; k < 3; k++)
        if (!arrays[k]) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", names[k]);
    if (n < 3 || n > 100000) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%zu rows: must be in [3, 100000]", n);
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++) {
            snprintf(name, sizeof name, "row[%zu]: %s", i, names[k]);
            const int status = rst_fit_outside(name, arrays[k][i], 1e-30, 1e30, error);
            if (status) return status;
        }
        if (temperature && isnan(temperature[i]))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN, "row[%zu]: temperature is missing", i);
    }
    return RESTITUTE_OK;
}

static int check_options(const restitute_dma_options *o, restitute_error *error)
{
    const int status = rst_fit_outside("options.poisson_ratio", o->poisson_ratio, 0, 0.5, error);
    return status ? status : rst_fit_outside("options.noise", o->noise, 1e-4, 0.5, error);
}

/* First shifts between neighbouring temperatures, from the reference outwards. Each row of t is
 * paired with the row of s that has the most similar moduli. The shift is the mean distance,
 * weighted by similarity. Refinement starts from it. */
static void overlay(struct rst_dma *d, size_t s, size_t t)
{
    double sum = 0, weights = 0;
    for (size_t i = 0; i < d->n; i++) {
        double least = INFINITY, move = 0;
        for (size_t j = 0; j < d->n && d->group[i] == t; j++) {
            const double a = log(d->storage[i] / d->storage[j]), b = log(d->loss[i] / d->loss[j]), unlike = a * a + b * b;
            if (d->group[j] == s && unlike < least) least = unlike, move = log(d->omega[j] / d->omega[i]);
        }
        const double weight = 1 / (least + d->noise * d->noise);
        sum += weight * move, weights += weight;
    }
    d->shift[t] = d->shift[s] + sum / weights;
}

static double reduced(const struct rst_dma *d, size_t row)
{
    return d->omega[row] * exp(d->shift[d->group[row]]);
}

static void first_shifts(struct rst_dma *d)
{
    const struct rst_temperatures *all = &d->temperature;
    d->free_shifts = all->count > 1 && isnan(all->c1);
    for (size_t t = 0; all->count > 1 && !isnan(all->c1) && t < all->count; t++)
        d->shift[t] = log(10) * rst_temperatures_wlf(all, t);
    for (size_t t = all->reference + 1; d->free_shifts && t < all->count; t++)
        overlay(d, t - 1, t);
    for (size_t t = all->reference; d->free_shifts && t-- > 0;)
        overlay(d, t + 1, t);
}

/* Remarks on what these rows do not determine. The loss peak of a term is 1.14 decades wide at half
 * height, so rows within one decade do not determine its time. */
static void remark_range(const struct rst_dma *d, restitute_dma_result *r)
{
    double low = INFINITY, high = 0, first[RESTITUTE_DMA_SHIFTS], last[RESTITUTE_DMA_SHIFTS];
    int laid = 1;
    for (size_t t = 0; t < d->temperature.count; t++) {
        first[t] = INFINITY, last[t] = 0;
        for (size_t i = 0; i < d->n; i++)
            if (d->group[i] == t) first[t] = fmin(first[t], reduced(d, i)), last[t] = fmax(last[t], reduced(d, i));
        low = fmin(low, first[t]), high = fmax(high, last[t]);
        laid &= t == 0 || !d->free_shifts || fmax(first[t - 1], first[t]) <= fmin(last[t - 1], last[t]);
    }
    if (!laid || high < 10 * low) r->flags |= RESTITUTE_FIT_FLAG_UNDETERMINED;
    if (!laid) strcat(r->remarks, "curves of neighbouring temperatures do not overlap: their shifts are not determined\n");
    const size_t used = strlen(r->remarks);
    if (high < 10 * low)
        rst_print(
            r->remarks + used, sizeof r->remarks - used,
            "rows within a factor of %.3g in frequency do not determine relaxation times: measure over a decade or "
            "more\n",
            high / low);
}

/* log10 a (c2 + dT) = -c1 dT is the line dT/log10 a = -c2/c1 - dT/c1, weighted for equal errors of
 * log10 a. */
static void find_wlf(const struct rst_temperatures *all, restitute_dma_result *r)
{
    double x[RESTITUTE_DMA_SHIFTS], y[RESTITUTE_DMA_SHIFTS], w[RESTITUTE_DMA_SHIFTS], c0, c1, ignored;
    size_t n = 0;
    r->wlf_c1 = r->wlf_c2 = NAN;
    for (size_t t = 0; t < r->temperatures; t++) {
        const double a = log10(r->shift[t]);
        if (t == all->reference || !(fabs(a) > 0)) continue;
        x[n] = all->value[t] - all->reference_value, y[n] = x[n] / a, w[n] = pow(a, 4) / (x[n] * x[n]), n++;
    }
    if (n < 2) return;
    gsl_fit_wlinear(x, 1, w, 1, y, 1, n, &c0, &c1, &ignored, &ignored, &ignored, &ignored);
    if (c1 < 0 && c0 / c1 + all->value[0] - all->reference_value > 0) r->wlf_c1 = -1 / c1, r->wlf_c2 = c0 / c1;
}

static int write_result(const struct rst_dma *d, const restitute_dma_options *o, restitute_dma_result *r, restitute_error *error)
{
    r->terms = d->terms;
    r->equilibrium_modulus = d->equilibrium;
    for (size_t k = 0; k < d->terms; k++)
        r->relaxation_time[k] = exp(d->tau[k]), r->modulus[k] = exp(d->g[k]);
    for (size_t t = 0; t < r->temperatures; t++)
        r->shift[t] = exp(d->shift[t]), r->temperature[t] = d->temperature.value[t];
    r->rms = d->noise * sqrt(rst_dma_sum(d) / (2 * (double)d->n));
    for (size_t i = 0; i < 2 * d->n; i++)
        r->worst = fmax(r->worst, d->noise * fabs(d->r[i]));
    r->wlf_c1 = o->wlf_c1, r->wlf_c2 = o->wlf_c2;
    if (isnan(o->wlf_c1)) find_wlf(&d->temperature, r);
    remark_range(d, r);
    if (r->rms > 3 * d->noise) {
        const size_t used = strlen(r->remarks);
        r->flags |= RESTITUTE_FIT_FLAG_MISFIT;
        rst_print(
            r->remarks + used, sizeof r->remarks - used,
            "the data do not follow a series with positive terms within %.2g: rms %.2g, worst %.2g (temperatures that "
            "no shift of time explains, or moduli that are not linear)\n",
            d->noise, r->rms, r->worst);
    }
    return restitute_material_prony(d->equilibrium, 0, d->terms, r->relaxation_time, r->modulus, o->poisson_ratio,
                                    &r->material, error);
}

static int fit(struct rst_dma *d, const double *temperature, const restitute_dma_options *o, restitute_dma_result *r,
               restitute_error *error)
{
    int status = RESTITUTE_OK;
    d->temperature = (struct rst_temperatures){.reference_value = o->reference_temperature, o->wlf_c1, o->wlf_c2, 0, 1, {0}};
    if (temperature) {
        status = rst_temperatures_sort(d->n, temperature, "row", &d->temperature, d->group, error);
        r->temperatures = d->temperature.count;
    }
    size_t i = 0;
    while (temperature && !status && i < d->n && d->group[i] != d->temperature.reference)
        i++;
    if (!status && i == d->n)
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "options.reference_temperature = %g: no row has it",
                            o->reference_temperature);
    if (status) return status;
    first_shifts(d);
    rst_fit_gsl_begin();
    status = rst_dma_begin(d);
    if (status >= 0) status = rst_dma_shorten(d);
    rst_fit_gsl_end();
    if (status < 0) return rst_report(error, status, "the fit failed: %s", restitute_status_text(status));
    return write_result(d, o, r, error);
}

int restitute_dma_fit(size_t n, const double *frequency, const double *storage, const double *loss,
                      const double *temperature, const restitute_dma_options *options, restitute_dma_result *result,
                      restitute_error *error)
{
    restitute_dma_options o;
    restitute_dma_result r;
    restitute_dma_result_init(&r);
    if (!result) return rst_report(error, RESTITUTE_ERROR_NULL, "result is NULL");
    int status = RST_CHECK(dma_result, result, error);
    if (!status) status = RST_TAKE(dma_options, &o, options, error);
    if (!status) status = check_options(&o, error);
    if (!status) status = check_rows(n, frequency, storage, loss, temperature, error);
    if (status) return status;
    struct rst_dma *d = calloc(1, sizeof *d);
    double *memory = calloc(5 * n, sizeof *memory), *omega = memory;
    size_t *group = calloc(n, sizeof *group);
    status = d && memory && group ? RESTITUTE_OK : rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (!status) {
        const double factor = o.tension ? 1 / (2 * (1 + o.poisson_ratio)) : 1;
        d->n = n, d->noise = o.noise;
        d->omega = omega, d->storage = memory + n, d->loss = memory + 2 * n, d->r = memory + 3 * n, d->group = group;
        for (size_t i = 0; i < n; i++)
            omega[i] = 2 * M_PI * frequency[i], d->storage[i] = factor * storage[i], d->loss[i] = factor * loss[i];
        status = fit(d, temperature, &o, &r, error);
    }
    free(d);
    free(memory);
    free(group);
    if (status < 0) return status;
    RST_GIVE(&r, result);
    return rst_done(error);
}
