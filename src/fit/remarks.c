/* Remarks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "remarks.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Chances below which a difference is called one: to prefer a model with fewer constants, to call a model wrong. */
static const double SIMPLER_FROM = 0.05, WRONG_BELOW = 0.01;

void rst_fit_remark(restitute_fit_result *result, int flag, const char *format, ...)
{
    const size_t used = strlen(result->remarks), room = sizeof result->remarks - used;
    va_list arguments;
    result->flags |= flag;
    va_start(arguments, format);
    const int length = vsnprintf(result->remarks + used, room, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length + 2 > room)
        result->remarks[used] = '\0'; /* whole lines only */
    else
        memcpy(result->remarks + used + length, "\n", 2);
}

/* "modulus1_pa x f, viscosity_pa_s x f^0.6" for the direction v. */
static void direction_text(const struct rst_fit_search *s, const double *v, char *text, size_t size)
{
    char name[RESTITUTE_FIT_NAME];
    size_t largest = 0, named = 0;
    for (size_t i = 1; i < s->model.free; i++)
        if (fabs(v[i]) > fabs(v[largest])) largest = i;
    text[0] = '\0';
    for (size_t i = 0; i < s->model.free; i++) {
        const double power = v[i] / v[largest];
        const size_t used = strlen(text);
        if (fabs(power) < 0.05) continue;
        rst_fit_name(s->data, &s->model, s->model.index[i], name);
        if (power > 0.995)
            snprintf(text + used, size - used, "%s%s x f", named ? ", " : "", name);
        else
            snprintf(text + used, size - used, "%s%s x f^%.2g", named ? ", " : "", name, power);
        named++;
    }
}

/* Constants that lie wholly in the open directions may be anything by themselves: named once, and taken out of these. */
static void remark_constants(const struct rst_fit_search *s, const struct rst_fit_certainty *c, double *open,
                             restitute_fit_result *result)
{
    const size_t p = s->model.free;
    char text[600] = "", name[RESTITUTE_FIT_NAME];
    for (size_t i = 0; i < p; i++) {
        double part = 0;
        for (size_t k = c->rank; k < p; k++)
            part += open[k * p + i] * open[k * p + i];
        if (part < 0.99) continue;
        rst_fit_name(s->data, &s->model, s->model.index[i], name);
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", *text ? ", " : "", name);
        for (size_t k = c->rank; k < p; k++)
            open[k * p + i] = 0;
    }
    if (*text) rst_fit_remark(result, RESTITUTE_FIT_UNDETERMINED, "the data do not determine %s", text);
}

/* w without its part along v; nothing for v = 0. */
static void subtract_part(size_t n, const double *v, double *w)
{
    double square = 0, product = 0;
    for (size_t i = 0; i < n; i++)
        square += v[i] * v[i], product += v[i] * w[i];
    for (size_t i = 0; i < n && square > 0; i++)
        w[i] -= product / square * v[i];
}

void rst_fit_remark_directions(const struct rst_fit_search *s, const struct rst_fit_certainty *c,
                               restitute_fit_result *result)
{
    const size_t p = s->model.free;
    double open[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS];
    char text[600];
    if (isnan(c->noise))
        rst_fit_remark(result, RESTITUTE_FIT_UNDETERMINED,
                       "%zu measured values for %zu constants leave nothing to estimate the noise: no intervals",
                       s->data->rows, p);
    memcpy(open, c->vector, p * p * sizeof *open);
    remark_constants(s, c, open, result);
    for (size_t k = c->rank; k < p; k++) {
        double left = 0;
        for (size_t l = c->rank; l < k; l++) /* what is left of two directions may be one */
            subtract_part(p, open + l * p, open + k * p);
        for (size_t i = 0; i < p; i++)
            left += open[k * p + i] * open[k * p + i];
        if (left < 0.1) {
            memset(open + k * p, 0, p * sizeof *open);
            continue;
        }
        direction_text(s, open + k * p, text, sizeof text);
        rst_fit_remark(result, RESTITUTE_FIT_UNDETERMINED,
                       "the data do not tell these apart: %s for any factor f gives the same", text);
    }
    if (c->rank < p && !s->model.scaled)
        rst_fit_remark(
            result, RESTITUTE_FIT_UNDETERMINED,
            "e has no unit, so it gives no modulus, and about 1 MPa is assumed: measure a contact time or name a known "
            "constant. e_z and e_x of the fitted solid are right all the same; its forces, times and depths are not");
}

static int compare_speeds(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (x[0] > y[0]) - (x[0] < y[0]);
}

/* Wald and Wolfowitz: chance that signs in random order have so few runs. Pairs of speed and residual, sorted. */
static double chance_of_runs(const double *pairs, size_t n)
{
    double up = 0, down = 0, runs = 1;
    for (size_t i = 0; i < n; i++) {
        if (pairs[2 * i + 1] > 0)
            up++;
        else
            down++;
        if (i && (pairs[2 * i + 1] > 0) != (pairs[2 * i - 1] > 0)) runs++;
    }
    if (up < 3 || down < 3) return 1;
    const double mean = 2 * up * down / (up + down) + 1;
    return gsl_cdf_ugaussian_P((runs + 0.5 - mean) / sqrt((mean - 1) * (mean - 2) / (up + down - 1)));
}

int rst_fit_remark_pattern(struct rst_fit_search *s, const struct rst_fit_certainty *c, restitute_fit_result *result)
{
    const struct rst_fit_data *d = s->data;
    double *memory = malloc(3 * d->rows * sizeof *memory), *pairs = memory + d->rows;
    size_t n = 0;
    if (!memory) return RESTITUTE_ERROR_MEMORY;
    const int status = rst_fit_residuals(s, memory);
    for (size_t i = 0; i < d->rows; i++)
        if (d->row[i].kind == RST_FIT_EZ)
            pairs[2 * n] = d->points[d->row[i].point].scene.normal_speed, pairs[2 * n++ + 1] = memory[i];
    qsort(pairs, n, 2 * sizeof *pairs, compare_speeds);
    const double chance = status < 0 || n == 0 ? 1 : chance_of_runs(pairs, n);
    if (chance < WRONG_BELOW && c->noise >= c->judged)
        rst_fit_remark(result, RESTITUTE_FIT_MISFIT,
                       "the data do not follow the model: residuals of ez keep their sign over ranges of speed (chance "
                       "%.1g), their standard deviation is %.2g",
                       chance, c->noise);
    if (d->options.noise_known && c->dof && gsl_cdf_chisq_Q(s->sum, (double)c->dof) < WRONG_BELOW)
        rst_fit_remark(result, RESTITUTE_FIT_MISFIT,
                       "the data do not follow the model: residuals are %.3g times the given standard deviations",
                       sqrt(s->sum / (double)c->dof));
    free(memory);
    return status;
}

int rst_fit_remark_limits(struct rst_fit_search *s, restitute_fit_result *result)
{
    static const int bits[] = {RESTITUTE_FLAG_FAST, RESTITUTE_FLAG_LARGE_CONTACT};
    static const char *const ratios[] = {"v/c_s", "a/R"};
    if (!s->model.scaled) return RESTITUTE_OK; /* both ratios need the modulus */
    restitute_result *results = calloc(s->data->n, sizeof *results);
    if (!results) return RESTITUTE_ERROR_MEMORY;
    rst_fit_constants(&s->model, s->logs, s->sets);
    const int status = rst_fit_solve_points(s->data, &s->model, s->sets, results);
    for (int b = 0; b < 2 && status >= 0; b++) {
        size_t count = 0;
        double worst = 0;
        for (size_t i = 0; i < s->data->n; i++) {
            const restitute_result *r = &results[i];
            if (!(r->flags & bits[b])) continue;
            count++;
            worst = fmax(worst, b ? r->radius_ratio : r->speed_ratio);
        }
        if (count)
            rst_fit_remark(result, RESTITUTE_FIT_LIMITS,
                           "%zu of %zu impacts are beyond the contact model, %s up to %.2g: %s", count, s->data->n,
                           ratios[b], worst, restitute_flag_text(bits[b]));
    }
    free(results);
    return status;
}

static const char *kind_text(const struct rst_fit_model *m, int ours)
{
    if (m->kind == ours && m->free == m->count) return "the same model with other constants";
    static const char *const texts[] = {"",
                                        "an elastic solid",
                                        "a Kelvin-Voigt solid",
                                        "a standard solid",
                                        "a Maxwell body",
                                        "a series without its weakest term"};
    return texts[m->kind];
}

void rst_fit_remark_rival(const struct rst_fit_search *s, const struct rst_fit_certainty *c,
                          const struct rst_fit_search *rival, restitute_fit_result *result)
{
    const int simpler = rival->model.free < s->model.free;
    const double more = fabs((double)s->model.free - (double)rival->model.free), rows = (double)s->data->rows;
    const double worse = simpler ? rival->sum : s->sum, better = simpler ? s->sum : rival->sum;
    const double left = simpler ? (double)c->dof : rows - (double)rival->model.free;
    if (left < 1 || more < 1) return;
    /* F of the drop against the noise, which is not below what a measurement has */
    const double floor = s->data->options.noise_known
                             ? 1
                             : fmax(better / left, isnan(c->noise) || c->judged > c->noise ? c->judged * c->judged : 0);
    const double f = fmax(0, worse - better) / more / floor;
    const double chance =
        s->data->options.noise_known ? gsl_cdf_chisq_Q(f * more, more) : gsl_cdf_fdist_Q(f, more, left);
    if (simpler && chance > SIMPLER_FROM)
        rst_fit_remark(result, RESTITUTE_FIT_SIMPLER,
                       "the data do not need this model: %s fits as well (rms %.3g, here %.3g)",
                       kind_text(&rival->model, s->model.kind), sqrt(worse / rows), sqrt(better / rows));
    if (!simpler && chance < WRONG_BELOW)
        rst_fit_remark(result, RESTITUTE_FIT_MISFIT,
                       "the data do not follow the model: %s fits better (rms %.3g, here %.3g)",
                       kind_text(&rival->model, s->model.kind), sqrt(better / rows), sqrt(worse / rows));
}
