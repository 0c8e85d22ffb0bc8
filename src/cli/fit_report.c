/* What `restitute fit` writes: a report, the material file with its record, a figure.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "chart.h"
#include "fit_settings.h"
#include "provenance.h"

static const char *source_of(const struct fit_settings *s)
{
    return s->text[FIT_INPUT] ? s->text[FIT_INPUT] : s->text[FIT_DMA];
}

static const char *name_of(const struct fit_settings *s)
{
    const char *path = source_of(s), *slash = strrchr(path, '/');
    return s->text[FIT_NAME] ? s->text[FIT_NAME] : slash ? slash + 1 : path;
}

static const char *model_of(const struct fit_settings *s)
{
    static const char *const names[] = {"", "elastic", "kelvin_voigt", "standard_solid", "maxwell", "prony"};
    return s->text[FIT_DMA] ? "prony" : names[s->options.model];
}

/* A text cut to what a material file takes. */
static json_t *text_of(const char *text, size_t most)
{
    char copy[512];
    snprintf(copy, most + 1 < sizeof copy ? most + 1 : sizeof copy, "%s", text);
    json_t *json = json_string(copy);
    return json ? json : json_string("(not UTF-8)");
}

static json_t *terms_of(const restitute_material *material, double *equilibrium)
{
    const size_t n = restitute_material_terms(material);
    double *tau = allocate(2 * n, sizeof *tau), *g = tau + n;
    json_t *terms = json_array();
    restitute_material_series(material, equilibrium, NULL, tau, g);
    for (size_t k = 0; k < n; k++)
        json_array_append_new(terms, json_pack("{s:f, s:f}", "tau_s", tau[k], "modulus_pa", g[k]));
    free(tau);
    return terms;
}

/* The file that every other command reads; `result` NULL: a series. */
static json_t *material_file(const struct fit_settings *s, const restitute_fit_result *result,
                             const restitute_material *material, const char *source)
{
    json_t *file = json_object();
    double equilibrium;
    const struct values *v = &s->values;
    json_object_set_new(file, "name", text_of(name_of(s), 127));
    json_object_set_new(file, "source", text_of(source, 511));
    json_object_set_new(file, "model", json_string(model_of(s)));
    json_object_set_new(file, "poisson_ratio", json_real(restitute_material_poisson_ratio(material)));
    if (v->deformable == RESTITUTE_BOTH_BODIES_DEFORM && v->given[FIELD_DENSITY1])
        json_object_set_new(file, "density_kg_m3", json_real(v->number[FIELD_DENSITY1]));
    if (strcmp(model_of(s), "prony") == 0) {
        json_object_set_new(file, "terms", terms_of(material, &equilibrium));
        json_object_set_new(file, "equilibrium_modulus_pa", json_real(equilibrium));
    } else
        for (size_t i = 0; i < result->constants; i++)
            if (strstr(result->name[i], "modulus") || strstr(result->name[i], "viscosity"))
                json_object_set_new(file, result->name[i], json_real(result->value[i]));
    return file;
}

static json_t *lines_of(const char *remarks)
{
    json_t *array = json_array();
    for (const char *line = remarks, *end; (end = strchr(line, '\n')); line = end + 1)
        json_array_append_new(array, json_stringn(line, (size_t)(end - line)));
    return array;
}

static json_t *json_result(const struct fit_settings *s, const restitute_fit_result *r)
{
    json_t *constants = json_array(), *correlations = json_array();
    for (size_t i = 0; i < r->constants; i++) {
        json_t *line = json_array();
        for (size_t k = 0; k < r->constants; k++)
            json_array_append_new(line, json_real(r->correlation[i][k]));
        json_array_append_new(correlations, line);
        json_array_append_new(constants, json_pack("{s:s, s:o, s:o, s:o}", "name", r->name[i], "value",
                                                   json_of_number(r->value[i]), "low", json_of_number(r->low[i]),
                                                   "high", json_of_number(r->high[i])));
    }
    return json_pack("{s:s, s:o, s:f, s:o, s:I, s:I, s:f, s:o, s:o, s:i, s:o}", "model", model_of(s), "constants",
                     constants, "confidence", s->options.confidence, "correlation", correlations, "values",
                     (json_int_t)r->values, "rank", (json_int_t)r->rank, "rms", r->rms, "noise",
                     json_of_number(r->noise), "condition", json_of_number(r->condition), "flags", r->flags, "remarks",
                     lines_of(r->remarks));
}

static void text_result(FILE *stream, const struct fit_settings *s, const restitute_fit_result *r)
{
    size_t wanted = 0;
    for (size_t i = 0; i < r->constants; i++)
        wanted += r->low[i] < r->high[i];
    fprintf(stream, "%s: %s, %zu measured values\n\n  %-26s %-13s %g %% interval\n", source_of(s), model_of(s),
            r->values, "", "", 100 * s->options.confidence);
    for (size_t i = 0; i < r->constants; i++) {
        fprintf(stream, "  %-26s %-13.6g ", r->name[i], r->value[i]);
        if (isinf(r->high[i]))
            fputs("not determined\n", stream);
        else if (r->low[i] == r->high[i])
            fputs("known\n", stream);
        else
            fprintf(stream, "%.6g to %.6g\n", r->low[i], r->high[i]);
    }
    fputs("\n  correlations of the logarithms\n", stream);
    for (size_t i = 1; i < r->constants; i++) {
        fprintf(stream, "  %-26s", r->name[i]);
        for (size_t k = 0; k < i; k++)
            fprintf(stream, " %6.3f", r->correlation[i][k]);
        fputc('\n', stream);
    }
    fprintf(stream,
            "\n  rms of the residuals %.3g, noise %.3g; %zu of %zu constants or combinations of them determined; %lld "
            "impacts solved\n",
            r->rms, r->noise, r->rank, wanted, (long long)r->impacts);
}

static void write_json(struct output *output, json_t *json)
{
    json_dumpf(json, output->stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    fputc('\n', output->stream);
}

/* Material and record, both or none; the report, begun as the third, last, when all else has found room. Takes over the
 * objects. */
static bool write_files(const struct fit_settings *s, struct output outputs[3], json_t *file, json_t *result,
                        struct reason *why)
{
    const struct settings line = {.argument_count = s->argument_count, .arguments = s->arguments};
    const char *path = s->text[FIT_OUTPUT];
    bool good = true;
    if (s->json) write_json(&outputs[2], result);
    if (path && (good = output_open(path, &outputs[0], why))) {
        write_json(&outputs[0], file);
        json_t *settings = json_pack("{s:s, s:s}", "version", restitute_version(), "input", source_of(s));
        json_t *record = provenance_record(&line, settings, json_object());
        json_object_set(record, "fit", result);
        good = provenance_open_beside(path, record, &outputs[1], why);
    }
    json_decref(file);
    json_decref(result);
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

static struct chart *new_chart(const struct fit_settings *s, const char *x, const char *y, const char *rest)
{
    struct settings settings = {.argument_count = s->argument_count, .arguments = s->arguments};
    restitute_options_init(&settings.solver);
    struct chart *chart = chart_new(&settings, 2);
    snprintf(chart->title, sizeof chart->title, "%.100s: %s", name_of(s), model_of(s));
    snprintf(chart->origin, sizeof chart->origin, "restitute %s fit", restitute_version());
    for (int i = 0; i < 2; i++) {
        snprintf(chart->panel[i].xlabel, sizeof chart->panel[i].xlabel, "%s", x);
        snprintf(chart->panel[i].ylabel, sizeof chart->panel[i].ylabel, "%s", i ? rest : y);
        snprintf(chart->panel[i].title, sizeof chart->panel[i].title, "%s",
                 i ? "residuals" : "data (points) and fit (lines)");
        chart->panel[i].xlog = true;
    }
    return chart;
}

static bool figure(const struct fit_settings *s, const struct fit_input *input, const restitute_fitter *fitter,
                   const restitute_fit_result *r, struct reason *why)
{
    static const char *const names[] = {"ez", "ex", "time (rel.)"};
    const size_t n = input->n;
    double *fitted = allocate(3 * n, sizeof *fitted);
    struct pairs *pairs = allocate(n, sizeof *pairs);
    struct chart *chart = new_chart(s, "normal speed  (m/s)", "ez, ex", "measured - fitted");
    restitute_fitter_values(fitter, fitted, fitted + n, fitted + 2 * n, NULL);
    for (size_t i = 0; i < r->constants; i++)
        snprintf(chart->description + strlen(chart->description),
                 sizeof chart->description - strlen(chart->description), "%s%s = %.4g", i ? ",  " : "", r->name[i],
                 r->value[i]);
    for (size_t kind = 0; kind < 3; kind++) {
        size_t used = 0;
        for (size_t i = 0; i < n; i++) {
            const restitute_fit_point *p = &input->points[i];
            const double value = kind == 0 ? p->ez : kind == 1 ? p->ex : p->contact_time;
            if (!isnan(value)) pairs[used++] = (struct pairs){p->scene.normal_speed, value, fitted[kind * n + i]};
        }
        plot(chart, pairs, used, kind, names[kind], kind < 2, kind == 2);
    }
    const bool good = chart_draw(chart, s->text[FIT_FIGURE], why);
    chart_release(chart);
    free(fitted);
    free(pairs);
    return good;
}

bool fit_write(const struct fit_settings *s, const struct fit_input *input, const restitute_fitter *fitter,
               const restitute_fit_result *r, struct reason *why)
{
    struct output outputs[3] = {{0}};
    char source[512];
    if (s->text[FIT_FIGURE] && !figure(s, input, fitter, r, why)) return false;
    if (!output_open(NULL, &outputs[2], why)) return false;
    if (!s->json) text_result(outputs[2].stream, s, r);
    snprintf(source, sizeof source, "restitute %s fit of %.200s: rms %.3g, %s", restitute_version(), source_of(s),
             r->rms, r->flags ? "with remarks, see the record beside this file" : "no remarks");
    return write_files(s, outputs, material_file(s, r, r->material, source), json_result(s, r), why);
}

static json_t *json_dma(const restitute_dma_result *r)
{
    json_t *shifts = json_array();
    double equilibrium;
    for (size_t t = 0; t < r->temperatures; t++)
        json_array_append_new(shifts, json_pack("{s:f, s:f}", "temperature_C", r->temperature[t], "a_T", r->shift[t]));
    return json_pack("{s:s, s:o, s:f, s:o, s:o, s:o, s:f, s:f, s:i, s:o}", "model", "prony", "terms",
                     terms_of(r->material, &equilibrium), "equilibrium_modulus_pa", r->equilibrium_modulus, "shifts",
                     shifts, "wlf_c1", json_of_number(r->wlf_c1), "wlf_c2", json_of_number(r->wlf_c2), "rms", r->rms,
                     "worst", r->worst, "flags", r->flags, "remarks", lines_of(r->remarks));
}

static void text_dma(FILE *stream, const struct fit_settings *s, const restitute_dma_result *r)
{
    fprintf(stream, "%s: Prony series of %zu terms\n\n  equilibrium modulus %.6g Pa\n", source_of(s), r->terms,
            r->equilibrium_modulus);
    for (size_t k = 0; k < r->terms; k++)
        fprintf(stream, "  tau %-12.6g s   G %-12.6g Pa\n", r->relaxation_time[k], r->modulus[k]);
    for (size_t t = 0; t < r->temperatures; t++)
        fprintf(stream, "  %g C: a_T = %.6g\n", r->temperature[t], r->shift[t]);
    if (!isnan(r->wlf_c1)) fprintf(stream, "  WLF: C1 = %.5g, C2 = %.5g C\n", r->wlf_c1, r->wlf_c2);
    fprintf(stream, "\n  relative residuals: rms %.3g, largest %.3g\n", r->rms, r->worst);
}

/* Moduli of the series at the reduced frequency of a row. */
static double modulus_at(const restitute_dma_result *r, double x, bool loss)
{
    double sum = loss ? 0 : r->equilibrium_modulus;
    for (size_t k = 0; k < r->terms; k++) {
        const double z = x * r->relaxation_time[k];
        sum += r->modulus[k] * (loss ? z : z * z) / (1 + z * z);
    }
    return sum;
}

static bool figure_dma(const struct fit_settings *s, const struct fit_input *input, const restitute_dma_result *r,
                       struct reason *why)
{
    struct pairs *pairs = allocate(input->n, sizeof *pairs);
    struct chart *chart = new_chart(s, "frequency times a_T  (Hz)", "shear moduli  (Pa)", "measured/fitted - 1");
    const double factor = s->tension ? 1 / (2 * (1 + s->dma.poisson_ratio)) : 1;
    chart->panel[0].ylog = true;
    snprintf(chart->description, sizeof chart->description, "%zu terms, rms %.3g", r->terms, r->rms);
    for (size_t loss = 0; loss < 2; loss++) {
        for (size_t i = 0; i < input->n; i++) {
            size_t t = 0;
            while (input->temperature && r->temperature[t] != input->temperature[i])
                t++;
            const double f = input->frequency[i] * (input->temperature ? r->shift[t] : 1);
            const double measured = factor * (loss ? input->loss[i] : input->storage[i]);
            pairs[i] = (struct pairs){f, measured, modulus_at(r, 2 * 3.14159265358979323846 * f, loss)};
        }
        plot(chart, pairs, input->n, loss, loss ? "loss" : "storage", true, true);
    }
    const bool good = chart_draw(chart, s->text[FIT_FIGURE], why);
    chart_release(chart);
    free(pairs);
    return good;
}

bool fit_write_dma(const struct fit_settings *s, const struct fit_input *input, const restitute_dma_result *r,
                   struct reason *why)
{
    struct output outputs[3] = {{0}};
    char source[512];
    if (s->text[FIT_FIGURE] && !figure_dma(s, input, r, why)) return false;
    if (!output_open(NULL, &outputs[2], why)) return false;
    if (!s->json) text_dma(outputs[2].stream, s, r);
    snprintf(source, sizeof source, "restitute %s fit of %.200s: %zu terms, relative rms %.3g", restitute_version(),
             source_of(s), r->terms, r->rms);
    return write_files(s, outputs, material_file(s, NULL, r->material, source), json_dma(r), why);
}
