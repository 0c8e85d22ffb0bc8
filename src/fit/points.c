/* Points and options of a fit: defaults, checks, copies, and the rows of the least squares.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/sized.h"
#include "base/status.h"
#include "fit/model.h"

RST_DEFAULTS(fit_point, .temperature = NAN, .ez = NAN, .ex = NAN, .contact_time = NAN, .sigma_ez = NAN, .sigma_ex = NAN,
             .sigma_contact_time = NAN)
RST_DEFAULTS(fit_options, .model = RESTITUTE_FIT_MODEL_STANDARD_SOLID, .poisson_ratio = 0.5, .confidence = 0.95,
             .reference_temperature = NAN, .wlf_c1 = NAN, .wlf_c2 = NAN, .seed = 1, .threads = 1)
RST_DEFAULTS(fit_result, 0)

size_t rst_fit_solid_constants(int kind, size_t terms)
{
    static const size_t counts[] = {[RESTITUTE_FIT_MODEL_ELASTIC] = 1,
                                    [RESTITUTE_FIT_MODEL_KELVIN_VOIGT] = 2,
                                    [RESTITUTE_FIT_MODEL_STANDARD_SOLID] = 3,
                                    [RESTITUTE_FIT_MODEL_MAXWELL] = 2};
    return kind == RESTITUTE_FIT_MODEL_PRONY ? 1 + terms : counts[kind];
}

int rst_fit_outside(const char *name, double value, double low, double high, restitute_error *error)
{
    if (value >= low && value <= high) return RESTITUTE_OK;
    if (isnan(value))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s is missing: must be in [%g, %g]", name, low, high);
    if (low > 0 && low <= 1e-30 && !(value > 0)) /* the rest of the range only prevents overflow */
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be > 0", name, value);
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be in [%g, %g]", name, value, low, high);
}

static int check_known(const restitute_fit_options *o, restitute_error *error)
{
    char name[64];
    for (size_t i = 0; o->known && i < rst_fit_solid_constants(o->model, o->terms); i++) {
        snprintf(name, sizeof name, "options.known[%zu]", i);
        const int may_be_0 = o->model == RESTITUTE_FIT_MODEL_PRONY && o->known[i] == 0;
        const int status = isnan(o->known[i]) || may_be_0 ? 0 : rst_fit_outside(name, o->known[i], 1e-30, 1e30, error);
        if (status) return status;
    }
    for (size_t k = 0; o->model == RESTITUTE_FIT_MODEL_PRONY && k < o->terms; k++) {
        snprintf(name, sizeof name, "options.relaxation_time[%zu]", k);
        const int status = rst_fit_outside(name, o->relaxation_time[k], 1e-30, 1e30, error);
        if (status) return status;
        for (size_t l = 0; l < k; l++)
            if (o->relaxation_time[l] == o->relaxation_time[k])
                return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %g: is there twice", name,
                                  o->relaxation_time[k]);
    }
    return RESTITUTE_OK;
}

static int check_options(const restitute_fit_options *o, restitute_error *error)
{
    int status =
        rst_fit_outside("options.model", o->model, RESTITUTE_FIT_MODEL_ELASTIC, RESTITUTE_FIT_MODEL_PRONY, error);
    if (!status) status = rst_fit_outside("options.poisson_ratio", o->poisson_ratio, 0, 0.5, error);
    if (!status)
        status = rst_fit_outside("options.loss", o->loss, RESTITUTE_FIT_LOSS_SQUARES, RESTITUTE_FIT_LOSS_CAUCHY, error);
    if (!status) status = rst_fit_outside("options.confidence", o->confidence, 0.5, 0.999, error);
    if (!status) status = rst_fit_outside("options.starts", o->starts, 0, 100, error);
    if (!status) status = rst_fit_outside("options.threads", o->threads, 0, rst_most_threads, error);
    if (!status && o->model == RESTITUTE_FIT_MODEL_PRONY) {
        status = rst_fit_outside("options.terms", (double)o->terms, 1, 20, error);
        if (!status && !o->relaxation_time)
            status = rst_report(error, RESTITUTE_ERROR_NULL, "options.relaxation_time is NULL");
    }
    return status ? status : check_known(o, error);
}

/* Value and standard deviation of one kind. */
static double measured(const restitute_fit_point *p, enum rst_fit_kind kind, double *sigma)
{
    *sigma = kind == RST_FIT_EZ ? p->sigma_ez : kind == RST_FIT_EX ? p->sigma_ex : p->sigma_contact_time;
    return kind == RST_FIT_EZ ? p->ez : kind == RST_FIT_EX ? p->ex : p->contact_time;
}

/* The scene itself is checked where its T is found, in impacts.c. */
static int check_point(size_t i, const restitute_fit_point *p, int noise_known, restitute_error *error)
{
    static const char *const names[] = {"ez", "ex", "contact_time"};
    static const double low[] = {0, -1, 1e-100}, high[] = {1, 1, 1e100};
    char name[64];
    int values = 0;
    for (enum rst_fit_kind kind = 0; kind < RST_FIT_KINDS; kind++) {
        double sigma;
        const double value = measured(p, kind, &sigma);
        if (isnan(value)) continue;
        values++;
        snprintf(name, sizeof name, "points[%zu].%s", i, names[kind]);
        int status = rst_fit_outside(name, value, low[kind], high[kind], error);
        snprintf(name, sizeof name, "points[%zu].sigma_%s", i, names[kind]);
        if (!status && (!isnan(sigma) || noise_known)) status = rst_fit_outside(name, sigma, 1e-100, 1e100, error);
        if (status) return status;
    }
    if (values == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "points[%zu]: ez, ex or contact_time must be measured", i);
    if (p->scene->material && p->scene->deformable == RESTITUTE_BOTH_BODIES_DEFORM)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "points[%zu]: a partner's material with BOTH_BODIES_DEFORM",
                          i);
    snprintf(name, sizeof name, "points[%zu].scene.normal_speed", i);
    return rst_fit_outside(name, p->scene->normal_speed, 1e-50, 1e50, error);
}

static void make_rows(struct rst_fit_data *d)
{
    for (size_t i = 0; i < d->n; i++)
        for (enum rst_fit_kind kind = 0; kind < RST_FIT_KINDS; kind++) {
            double sigma;
            const double value = measured(&d->points[i], kind, &sigma);
            if (isnan(value)) continue;
            if (isnan(sigma)) sigma = kind == RST_FIT_TIME ? value : 1;
            d->row[d->rows++] = (struct rst_fit_row){i, kind, value, sigma};
        }
}

/* Points of one temperature and partner share a solid. */
static int make_groups(struct rst_fit_data *d, restitute_error *error)
{
    const restitute_fit_options *o = &d->options;
    double *temperature = malloc(d->n * sizeof *temperature);
    if (!temperature) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu points", d->n);
    for (size_t i = 0; i < d->n; i++)
        temperature[i] = d->points[i].temperature;
    d->temperature = (struct rst_temperatures){.reference_value = o->reference_temperature, o->wlf_c1, o->wlf_c2};
    const int status = rst_temperatures_sort(d->n, temperature, "points", &d->temperature, d->at, error);
    free(temperature);
    for (size_t i = 0; i < d->n && !status; i++) {
        size_t g = 0;
        while (g < d->groups &&
               (d->scene[d->first[g]].material != d->scene[i].material || d->at[d->first[g]] != d->at[i]))
            g++;
        if (g == d->groups) d->first[d->groups++] = i;
        d->group[i] = g;
    }
    return status;
}

/* A point and its scene, as far as the caller has them. */
static int copy_point(const restitute_fit_point *points, size_t i, struct rst_fit_data *d, restitute_error *error)
{
    const restitute_fit_point *theirs = rst_at(points, i);
    restitute_error inner;
    int status = RST_TAKE(fit_point, &d->points[i], theirs, error);
    if (status) return status;
    if (!theirs->scene) return rst_report(error, RESTITUTE_ERROR_NULL, "points[%zu].scene is NULL", i);
    status = RST_TAKE(scene, &d->scene[i], theirs->scene, &inner);
    if (status) return rst_report(error, status, "points[%zu]: %s", i, inner.message);
    d->points[i].scene = &d->scene[i];
    return check_point(i, &d->points[i], d->options.noise_known, error);
}

static int copy(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                struct rst_fit_data *d, restitute_error *error)
{
    const size_t terms = options->model == RESTITUTE_FIT_MODEL_PRONY ? options->terms : 0;
    const size_t known = options->known ? rst_fit_solid_constants(options->model, terms) : 0;
    int status = RESTITUTE_OK;
    d->n = n;
    d->options = *options;
    d->points = malloc(n * sizeof *d->points);
    d->scene = malloc(n * sizeof *d->scene);
    d->row = malloc(RST_FIT_KINDS * n * sizeof *d->row);
    d->group = calloc(3 * n, sizeof *d->group);
    d->memory = malloc((terms + known + 1) * sizeof *d->memory);
    if (!d->points || !d->scene || !d->row || !d->group || !d->memory)
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu points", n);
    d->first = d->group + n, d->at = d->first + n;
    if (terms) memcpy(d->memory, options->relaxation_time, terms * sizeof *d->memory);
    if (known) memcpy(d->memory + terms, options->known, known * sizeof *d->memory);
    d->options.relaxation_time = d->memory;
    d->options.known = known ? d->memory + terms : NULL;
    for (size_t i = 0; !status && i < n; i++)
        status = copy_point(points, i, d, error);
    return status;
}

/* A usual impact takes one to three thousand updates. Those of solids far from the data may take
 * very many: they get at most a hundred thousand, and their result is used as it is. */
static void set_solver(struct rst_fit_data *d)
{
    restitute_options_init(&d->solver);
    d->solver.method = restitute_method_sync();
    d->solver.threads = d->options.threads;
    d->solver.max_work = 0.01;
    d->solver.time_limit = INFINITY; /* a clock would make fits differ */
}

int rst_fit_data_create(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                        struct rst_fit_data *data, restitute_error *error)
{
    *data = (struct rst_fit_data){0};
    if (!points) return rst_report(error, RESTITUTE_ERROR_NULL, "points is NULL");
    if (n == 0 || n > 1000000) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "n = %zu: must be in [1, 1000000]", n);
    int status = check_options(options, error);
    if (!status) status = RST_CHECK_ARRAY(fit_point, points, n, "points", error);
    if (!status) status = copy(n, points, options, data, error);
    if (!status) {
        set_solver(data);
        make_rows(data);
        status = make_groups(data, error);
    }
    if (!status) status = rst_fit_impacts(data, error);
    if (status) rst_fit_data_release(data);
    return status;
}

void rst_fit_data_release(struct rst_fit_data *data)
{
    free(data->points);
    free(data->scene);
    free(data->row);
    free(data->group);
    free(data->memory);
    free(data->impact);
    free(data->place);
    *data = (struct rst_fit_data){0};
}
