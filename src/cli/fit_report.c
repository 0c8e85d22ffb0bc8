/* What `restitute fit` writes: a report, the material file with its record, a figure.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart.h"
#include "fit_settings.h"
#include "provenance.h"

/* What was found, from impacts or from a curve. low = NaN: no interval; low = value: known. */
enum { MOST_CONSTANTS = RESTITUTE_DMA_TERMS + RESTITUTE_DMA_SHIFTS + 3 };
struct report {
    size_t count;
    struct {
        char name[48];
        double value, low, high;
    } constant[MOST_CONSTANTS];
    char quality[200];   /* of the fit, in words */
    json_t *numbers;     /* for the record alone */
    const char *remarks; /* a line each */
    const restitute_material *material;
};

static void add(struct report *r, const char *name, double value, double low, double high)
{
    snprintf(r->constant[r->count].name, sizeof r->constant[0].name, "%s", name);
    r->constant[r->count].value = value, r->constant[r->count].low = low, r->constant[r->count++].high = high;
}

static const char *name_of(const struct fit_settings *s, const struct fit_input *input)
{
    const char *slash = strrchr(input->source, '/');
    return s->text[FIT_NAME] ? s->text[FIT_NAME] : slash ? slash + 1 : input->source;
}

static const char *model_of(const struct fit_settings *s)
{
    return s->text[FIT_DMA] ? "prony" : fit_models[s->options.model - RESTITUTE_FIT_MODEL_ELASTIC];
}

/* A text cut to what a material file takes. */
static json_t *text_of(const char *text, size_t most)
{
    char copy[512];
    snprintf(copy, most + 1 < sizeof copy ? most + 1 : sizeof copy, "%s", text);
    json_t *json = json_string(copy);
    return json ? json : json_string("(not UTF-8)");
}

static void add_terms(json_t *file, const restitute_material *material)
{
    const size_t n = restitute_material_terms(material);
    double *tau = allocate(2 * n, sizeof *tau), *g = tau + n, equilibrium;
    json_t *terms = json_array();
    restitute_material_series(material, &equilibrium, NULL, tau, g, NULL);
    for (size_t k = 0; k < n; k++)
        json_array_append_new(terms, json_pack("{s:f, s:f}", "tau_s", tau[k], "modulus_pa", g[k]));
    free(tau);
    json_object_set_new(file, "terms", terms);
    json_object_set_new(file, "equilibrium_modulus_pa", json_real(equilibrium));
}

/* The file that every other command reads. */
static json_t *material_file(const struct fit_settings *s, const struct fit_input *input, const struct report *r)
{
    const struct values *v = &s->values;
    char source[512];
    snprintf(source, sizeof source, "restitute %s fit of %.200s: %s", restitute_version(), input->source, r->quality);
    json_t *file = json_pack("{s:o, s:o, s:s, s:f}", "name", text_of(name_of(s, input), 127), "source",
                             text_of(source, 511), "model", model_of(s), "poisson_ratio",
                             restitute_material_poisson_ratio(r->material));
    if (v->deformable == RESTITUTE_BOTH_BODIES_DEFORM && v->given[FIELD_DENSITY1])
        json_object_set_new(file, "density_kg_m3", json_real(v->number[FIELD_DENSITY1]));
    if (strcmp(model_of(s), "prony") == 0)
        add_terms(file, r->material);
    else
        for (size_t i = 0; i < r->count; i++)
            if (strstr(r->constant[i].name, "modulus") || strstr(r->constant[i].name, "viscosity"))
                json_object_set_new(file, r->constant[i].name, json_real(r->constant[i].value));
    return file;
}

static json_t *json_report(const struct fit_settings *s, const struct report *r)
{
    json_t *constants = json_array(), *remarks = json_array();
    for (size_t i = 0; i < r->count; i++)
        json_array_append_new(constants, json_pack("{s:s, s:o, s:o, s:o}", "name", r->constant[i].name, "value",
                                                   json_of_number(r->constant[i].value), "low",
                                                   json_of_number(r->constant[i].low), "high",
                                                   json_of_number(r->constant[i].high)));
    for (const char *line = r->remarks, *end; (end = strchr(line, '\n')); line = end + 1)
        json_array_append_new(remarks, json_stringn(line, (size_t)(end - line)));
    json_t *all = json_pack("{s:s, s:o, s:o}", "model", model_of(s), "constants", constants, "remarks", remarks);
    json_object_update(all, r->numbers);
    return all;
}

static void text_report(FILE *stream, const struct fit_settings *s, const struct fit_input *input, const struct report *r)
{
    const json_t *correlation = json_object_get(r->numbers, "correlation");
    fprintf(stream, "%s: %s\n\n", input->source, model_of(s));
    for (size_t i = 0; i < r->count; i++) {
        const double low = r->constant[i].low, high = r->constant[i].high;
        fprintf(stream, "  %-26s %-13.6g", r->constant[i].name, r->constant[i].value);
        if (isinf(high) && low > 0)
            fprintf(stream, " above %.6g", low);
        else if (isinf(high))
            fputs(" not determined", stream);
        else if (low < high && low > 0)
            fprintf(stream, " %.6g to %.6g", low, high);
        else if (low < high)
            fprintf(stream, " below %.6g", high);
        else if (!isnan(low))
            fputs(" known", stream);
        fputc('\n', stream);
    }
    for (size_t i = 1; i < json_array_size(correlation); i++) {
        fprintf(stream, "%s  %-26s", i == 1 ? "\n  correlations of the logarithms\n" : "", r->constant[i].name);
        for (size_t k = 0; k < i; k++)
            fprintf(stream, " %6.3f", json_real_value(json_array_get(json_array_get(correlation, i), k)));
        fputc('\n', stream);
    }
    fprintf(stream, "\n  %s\n", r->quality);
}

/* Material and record, both or none; the report, begun as the third, last, when all else has found room. */
static bool write_all(const struct fit_settings *s, const struct fit_input *input, const struct report *r,
                      struct reason *why)
{
    const struct settings line = {.argument_count = s->argument_count, .arguments = s->arguments};
    const char *path = s->text[FIT_OUTPUT];
    struct output outputs[3] = {{0}};
    bool good = output_open(NULL, &outputs[2], why);
    if (good) text_report(outputs[2].stream, s, input, r);
    if (good && path && (good = output_open(path, &outputs[0], why))) {
        json_t *file = material_file(s, input, r);
        json_dumpf(file, outputs[0].stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        fputc('\n', outputs[0].stream);
        json_decref(file);
        json_t *settings = json_pack("{s:s, s:s}", "version", restitute_version(), "input", input->source);
        json_t *record = provenance_record(&line, settings, json_object());
        json_object_set_new(record, "fit", json_report(s, r));
        good = provenance_open_beside(path, record, &outputs[1], why);
    }
    json_decref(r->numbers);
    if (!good) outputs_abandon(outputs, 3);
    return good && outputs_finish(outputs, 3, why);
}

struct pairs {
    double x, measured, fitted;
};

static int by_x(const void *a, const void *b)
{
    const struct pairs *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* Data as points, the fit as a line, in the first panel (unless they have another unit); what is left in the second. */
static void plot(struct chart *chart, struct pairs *pairs, size_t n, size_t style, const char *what, bool both, bool relative)
{
    struct panel *panel = chart->panel;
    if (n == 0) return;
    qsort(pairs, n, sizeof *pairs, by_x);
    struct series *data = both ? chart_series(&panel[0], MARK_POINTS, style, n, "") : NULL;
    struct series *fit = both ? chart_series(&panel[0], MARK_LINE, style, n, "") : NULL;
    struct series *rest = chart_series(&panel[1], MARK_POINTS, style, n, what);
    for (size_t i = 0; i < n; i++) {
        if (both) series_add(data, pairs[i].x, pairs[i].measured);
        if (both) series_add(fit, pairs[i].x, pairs[i].fitted);
        series_add(rest, pairs[i].x, (pairs[i].measured - pairs[i].fitted) / (relative ? pairs[i].fitted : 1));
    }
}

static struct chart *new_chart(const struct fit_settings *s, const struct fit_input *input, const char *const labels[3])
{
    struct settings settings = {.argument_count = s->argument_count, .arguments = s->arguments};
    restitute_options_init(&settings.solver);
    struct chart *chart = chart_new(&settings, 2);
    snprintf(chart->title, sizeof chart->title, "%.100s: %s", name_of(s, input), model_of(s));
    snprintf(chart->origin, sizeof chart->origin, "restitute %s fit", restitute_version());
    for (int i = 0; i < 2; i++) {
        struct panel *panel = &chart->panel[i];
        snprintf(panel->xlabel, sizeof panel->xlabel, "%s", labels[0]);
        snprintf(panel->ylabel, sizeof panel->ylabel, "%s", labels[1 + i]);
        snprintf(panel->title, sizeof panel->title, "%s", i ? "residuals" : "data (points) and fit (lines)");
        panel->xlog = true;
    }
    return chart;
}

static bool draw(const struct fit_settings *s, struct chart *chart, struct pairs *pairs, struct reason *why)
{
    const bool good = chart_draw(chart, s->text[FIT_FIGURE], why);
    chart_release(chart);
    free(pairs);
    return good;
}

static bool figure(const struct fit_settings *s, const struct fit_input *input, const restitute_fitter *fitter,
                   const struct report *r, struct reason *why)
{
    static const char *const names[] = {"ez", "ex", "time (rel.)"},
                      *const labels[] = {"normal speed  (m/s)", "ez, ex", "measured - fitted"};
    const size_t n = input->n;
    restitute_error error;
    double *fitted = allocate(3 * n, sizeof *fitted);
    const int status = restitute_fitter_values(fitter, fitted, fitted + n, fitted + 2 * n, &error);
    if (status) {
        free(fitted);
        return status != RESTITUTE_ERROR_INTERRUPTED && refuse(why, "%s", error.message);
    }
    struct pairs *pairs = allocate(n, sizeof *pairs);
    struct chart *chart = new_chart(s, input, labels);
    for (size_t i = 0, used = 0; i < r->count && used < sizeof chart->description; i++)
        used += (size_t)snprintf(chart->description + used, sizeof chart->description - used, "%s%s = %.4g",
                                 i ? ",  " : "", r->constant[i].name, r->constant[i].value);
    for (size_t kind = 0; kind < 3; kind++) {
        size_t used = 0;
        for (size_t i = 0; i < n; i++) {
            const restitute_fit_point *p = &input->points[i];
            const double value = kind == 0 ? p->ez : kind == 1 ? p->ex : p->contact_time;
            if (!isnan(value)) pairs[used++] = (struct pairs){p->scene->normal_speed, value, fitted[kind * n + i]};
        }
        plot(chart, pairs, used, kind, names[kind], kind < 2, kind == 2);
    }
    free(fitted);
    return draw(s, chart, pairs, why);
}

bool fit_write(const struct fit_settings *s, const struct fit_input *input, const restitute_fitter *fitter,
               const restitute_fit_result *f, struct reason *why)
{
    struct report r = {.remarks = f->remarks, .material = f->material};
    json_t *correlations = json_array();
    for (size_t i = 0; i < f->constants; i++) {
        add(&r, f->name[i], f->value[i], f->low[i], f->high[i]);
        json_t *line = json_array();
        for (size_t k = 0; k < f->constants; k++)
            json_array_append_new(line, json_real(f->correlation[i][k]));
        json_array_append_new(correlations, line);
    }
    snprintf(r.quality, sizeof r.quality,
             "rms of the residuals of %zu values %.3g, noise %.3g; %zu constants or combinations of them determined, "
             "intervals of %g %%; %lld impacts solved",
             f->values, f->rms, f->noise, f->rank, 100 * s->options.confidence, (long long)f->impacts);
    r.numbers = json_pack("{s:f, s:o, s:I, s:I, s:f, s:o, s:o, s:i}", "confidence", s->options.confidence, "correlation",
                          correlations, "values", (json_int_t)f->values, "rank", (json_int_t)f->rank, "rms", f->rms,
                          "noise", json_of_number(f->noise), "condition", json_of_number(f->condition), "flags", f->flags);
    if (s->text[FIT_FIGURE] && !figure(s, input, fitter, &r, why)) return json_decref(r.numbers), false;
    return write_all(s, input, &r, why);
}

/* Moduli of the series at the reduced frequency of a row. */
static double modulus_at(const restitute_dma_result *d, double x, bool loss)
{
    double sum = loss ? 0 : d->equilibrium_modulus;
    for (size_t k = 0; k < d->terms; k++) {
        const double z = x * d->relaxation_time[k];
        sum += d->modulus[k] * (loss ? z : z * z) / (1 + z * z);
    }
    return sum;
}

static bool figure_dma(const struct fit_settings *s, const struct fit_input *input, const restitute_dma_result *d,
                       struct reason *why)
{
    static const char *const labels[] = {"frequency times a_T  (Hz)", "shear moduli  (Pa)", "measured/fitted - 1"};
    struct pairs *pairs = allocate(input->n, sizeof *pairs);
    struct chart *chart = new_chart(s, input, labels);
    const double factor = s->tension ? 1 / (2 * (1 + s->dma.poisson_ratio)) : 1;
    chart->panel[0].ylog = true;
    snprintf(chart->description, sizeof chart->description, "%zu terms, rms %.3g", d->terms, d->rms);
    for (size_t loss = 0; loss < 2; loss++) {
        for (size_t i = 0; i < input->n; i++) {
            size_t t = 0;
            while (input->temperature && d->temperature[t] != input->temperature[i])
                t++;
            const double f = input->frequency[i] * (input->temperature ? d->shift[t] : 1);
            const double measured = factor * (loss ? input->loss[i] : input->storage[i]);
            pairs[i] = (struct pairs){f, measured, modulus_at(d, 2 * 3.14159265358979323846 * f, loss)};
        }
        plot(chart, pairs, input->n, loss, loss ? "loss" : "storage", true, true);
    }
    return draw(s, chart, pairs, why);
}

bool fit_write_dma(const struct fit_settings *s, const struct fit_input *input, const restitute_dma_result *d,
                   struct reason *why)
{
    struct report r = {.remarks = d->remarks, .material = d->material};
    char name[48];
    if (s->text[FIT_FIGURE] && !figure_dma(s, input, d, why)) return false;
    add(&r, "equilibrium_modulus_pa", d->equilibrium_modulus, NAN, NAN);
    for (size_t k = 0; k < d->terms; k++) {
        snprintf(name, sizeof name, "modulus_pa[tau=%.6g]", d->relaxation_time[k]);
        add(&r, name, d->modulus[k], NAN, NAN);
    }
    for (size_t t = 0; t < d->temperatures; t++) {
        snprintf(name, sizeof name, "shift_%g", d->temperature[t]);
        add(&r, name, d->shift[t], NAN, NAN);
    }
    if (!isnan(d->wlf_c1)) add(&r, "wlf_c1", d->wlf_c1, NAN, NAN), add(&r, "wlf_c2", d->wlf_c2, NAN, NAN);
    snprintf(r.quality, sizeof r.quality, "Prony series of %zu terms, relative residuals: rms %.3g, largest %.3g", d->terms,
             d->rms, d->worst);
    r.numbers = json_pack("{s:f, s:f, s:i}", "rms", d->rms, "worst", d->worst, "flags", d->flags);
    return write_all(s, input, &r, why);
}
