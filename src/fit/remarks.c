/* Remarks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit/search.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"

/* Probabilities below which a difference is significant: to prefer a model with fewer constants; to
 * reject a model. */
static const double SIMPLER_FROM = 0.05, WRONG_BELOW = 0.01;

/* Add a line if there is room, and set the flag. */
static void remark(restitute_fit_result *result, int flag, const char *format, ...)
{
    const size_t used = strlen(result->remarks), room = sizeof result->remarks - used;
    va_list arguments;
    result->flags |= flag;
    va_start(arguments, format);
    const int length = rst_vprint(result->remarks + used, room, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length + 2 > room)
        result->remarks[used] = '\0'; /* whole lines only */
    else
        memcpy(result->remarks + used + length, "\n", 2);
}

/* Rows of `open` by Gauss and Jordan: each row gets one constant with power 1 that no other row
 * has. A constant that is undetermined by itself then has a row of its own. */
static void separate(size_t rows, size_t p, double *open)
{
    for (size_t k = 0; k < rows; k++) {
        size_t row = k, column = 0;
        for (size_t i = k * p; i < rows * p; i++)
            if (fabs(open[i]) > fabs(open[row * p + column])) row = i / p, column = i % p;
        const double pivot = open[row * p + column];
        for (size_t i = 0; i < p; i++) {
            const double swapped = open[row * p + i];
            open[row * p + i] = open[k * p + i];
            open[k * p + i] = swapped / pivot;
        }
        for (size_t l = 0; l < rows; l++) {
            const double part = l == k ? 0 : open[l * p + column];
            for (size_t i = 0; i < p; i++)
                open[l * p + i] -= part * open[k * p + i];
        }
    }
}

/* "modulus1_pa x f, viscosity_pa_s x f^0.6" for the direction v. Returns how many constants it
 * has. */
static size_t direction_text(const struct rst_fit_search *s, const double *v, char *text, size_t size)
{
    char name[RESTITUTE_FIT_NAME];
    size_t named = 0;
    text[0] = '\0';
    for (size_t i = 0; i < s->model.free; i++) {
        const size_t used = strlen(text);
        if (fabs(v[i]) < 0.05) continue;
        rst_fit_name(s->data, &s->model, s->model.index[i], name);
        if (fabs(v[i] - 1) < 0.005)
            rst_print(text + used, size - used, "%s%s x f", named ? ", " : "", name);
        else
            rst_print(text + used, size - used, "%s%s x f^%.2g", named ? ", " : "", name, v[i]);
        named++;
    }
    return named;
}

/* Constants and combinations that may be anything. */
static void remark_directions(const struct rst_fit_search *s, const struct rst_fit_intervals *c,
                              restitute_fit_result *result)
{
    const size_t p = s->model.free;
    double open[RESTITUTE_FIT_CONSTANTS * RESTITUTE_FIT_CONSTANTS];
    char text[600];
    if (isnan(c->noise))
        remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED,
               "%zu measured values for %zu constants leave nothing to estimate the noise: no intervals", s->data->rows,
               p);
    memcpy(open, c->vector + c->rank * p, (p - c->rank) * p * sizeof *open);
    separate(p - c->rank, p, open);
    for (size_t k = 0; k < p - c->rank; k++)
        if (direction_text(s, open + k * p, text, sizeof text) == 1)
            remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED, "the data do not determine %.*s%s", (int)strcspn(text, " "),
                   text,
                   s->model.kind == RESTITUTE_FIT_MODEL_PRONY
                       ? "; the intervals of the others hold for this value of it"
                       : "");
        else
            remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED,
                   "the data do not tell these apart: %s for any factor f gives the same", text);
    if (c->rank < p && !s->model.scaled)
        remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED,
               "e has no unit, so it gives no modulus, and contact times as of 1 MPa are assumed: measure a contact "
               "time or name a "
               "known constant. e_z and e_x of the fitted solid are right all the same; its forces, times and depths "
               "are not");
}

/* Constants that have other values in another fit that is as good. */
static void remark_other(const struct rst_fit_search *s, const struct rst_fit_intervals *c,
                         restitute_fit_result *result)
{
    char name[RESTITUTE_FIT_NAME], text[600] = "";
    for (size_t i = 0; i < s->model.free; i++) {
        const size_t used = strlen(text);
        if (!c->otherwise[i]) continue;
        rst_fit_name(s->data, &s->model, s->model.index[i], name);
        rst_print(text + used, sizeof text - used, "%s%s = %.3g", used ? ", " : "", name, exp(s->other[i]));
    }
    if (text[0]) remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED, "other constants fit as well: %s", text);
}

/* Constants that may be as large or as small as you like, with the others fitted to them. */
static void remark_bounds(const struct rst_fit_search *s, const struct rst_fit_intervals *c,
                          restitute_fit_result *result)
{
    char name[RESTITUTE_FIT_NAME];
    for (size_t i = 0; i < s->model.free; i++) {
        if (!c->determined[i] || (c->below[i] < INFINITY && c->above[i] < INFINITY)) continue;
        if (c->below[i] == c->above[i]) result->rank--; /* both are infinite */
        rst_fit_name(s->data, &s->model, s->model.index[i], name);
        remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED, "the data give no %s of %s",
               c->above[i] < INFINITY   ? "lower bound"
               : c->below[i] < INFINITY ? "upper bound"
                                        : "bounds",
               name);
    }
}

/* Residuals that do not look like noise. A pattern below what can be measured is none. */
static int remark_misfit(const struct rst_fit_search *s, const struct rst_fit_intervals *c,
                         restitute_fit_result *result)
{
    struct rst_fit_misfit m;
    const int status = rst_fit_misfit(s, c->dof, &m);
    if (status < 0) return status;
    if (m.patterned && c->noise >= c->judged)
        remark(result, RESTITUTE_FIT_FLAG_MISFIT,
               "the data do not follow the model: neighbours along speed, angle or temperature have like residuals "
               "(chance %.1g), their standard deviation is %.2g",
               m.chance, c->noise);
    if (m.large)
        remark(result, RESTITUTE_FIT_FLAG_MISFIT,
               "the data do not follow the model: residuals of %.2g in e and %.2g in relative contact times (0: none "
               "measured) are larger than usual noise; or try more starts",
               m.noise_e, m.noise_time);
    if (m.surpassed)
        remark(result, RESTITUTE_FIT_FLAG_MISFIT,
               "the data do not follow the model: residuals are %.3g times the given standard deviations",
               sqrt(s->sum / (double)c->dof));
    return RESTITUTE_OK;
}

/* Impacts beyond the limits of the contact model; both ratios need the modulus. */
static int remark_limits(struct rst_fit_search *s, restitute_fit_result *result)
{
    static const int bits[] = {RESTITUTE_FLAG_FAST, RESTITUTE_FLAG_LARGE_CONTACT};
    static const char *const ratios[] = {"v/c_s", "a/R"};
    if (!s->model.scaled) return RESTITUTE_OK;
    restitute_result *results = calloc(s->data->n, sizeof *results);
    if (!results) return RESTITUTE_ERROR_MEMORY;
    rst_fit_constants(&s->model, s->logs, s->sets);
    const int status = rst_fit_solve_points(s->data, &s->model, s->sets, results);
    for (int b = 0; b < 2 && status >= 0; b++) {
        size_t count = 0;
        double worst = 0;
        for (size_t i = 0; i < s->data->n; i++)
            if (results[i].flags & bits[b])
                count++, worst = fmax(worst, b ? results[i].radius_ratio : results[i].speed_ratio);
        if (count)
            remark(result, RESTITUTE_FIT_FLAG_LIMITS,
                   "%zu of %zu impacts are beyond the contact model, %s up to %.2g: %s", count, s->data->n, ratios[b],
                   worst, worst > 1 ? "are moduli in Pa, lengths in m, speeds in m/s?" : restitute_flag_text(bits[b]));
    }
    free(results);
    return status;
}

int rst_fit_remarks(struct rst_fit_search *s, const struct rst_fit_intervals *c, restitute_fit_result *result)
{
    if (!s->converged) remark(result, RESTITUTE_FIT_FLAG_UNFINISHED, "the iteration did not converge; try more starts");
    remark_directions(s, c, result);
    remark_other(s, c, result);
    remark_bounds(s, c, result);
    const int status = remark_misfit(s, c, result);
    return status < 0 ? status : remark_limits(s, result);
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

void rst_fit_remark_rival(const struct rst_fit_search *s, const struct rst_fit_intervals *c,
                          const struct rst_fit_search *rival, restitute_fit_result *result)
{
    const int simpler = rival->model.free <= s->model.free, like = rival->model.free == s->model.free;
    const double more = like ? 1 : fabs((double)s->model.free - (double)rival->model.free), rows = (double)s->data->rows;
    const double worse = simpler ? rival->sum : s->sum, better = simpler ? s->sum : rival->sum;
    const double left = simpler ? (double)c->dof : rows - (double)rival->model.free;
    if (left < 1) return;
    /* F of the decrease over the noise, which is not taken below that of a measurement */
    const double floor = s->data->options.noise_known
                             ? 1
                             : fmax(better / left, isnan(c->noise) || c->judged > c->noise ? c->judged * c->judged : 0);
    const double f = fmax(0, worse - better) / more / floor;
    const double chance =
        s->data->options.noise_known ? gsl_cdf_chisq_Q(f * more, more) : gsl_cdf_fdist_Q(f, more, left);
    if (like && chance > SIMPLER_FROM)
        remark(result, RESTITUTE_FIT_FLAG_UNDETERMINED,
               "the data do not tell this model from %s, which has as many constants (rms %.3g, here %.3g)",
               kind_text(&rival->model, s->model.kind), sqrt(worse / rows), sqrt(better / rows));
    else if (simpler && chance > SIMPLER_FROM)
        remark(result, RESTITUTE_FIT_FLAG_SIMPLER,
               "the data do not need this model: %s fits as well (rms %.3g, here %.3g)",
               kind_text(&rival->model, s->model.kind), sqrt(worse / rows), sqrt(better / rows));
    if (!simpler && chance < WRONG_BELOW)
        remark(result, RESTITUTE_FIT_FLAG_MISFIT,
               "the data do not follow the model: %s fits better (rms %.3g, here %.3g)",
               kind_text(&rival->model, s->model.kind), sqrt(better / rows), sqrt(worse / rows));
}
