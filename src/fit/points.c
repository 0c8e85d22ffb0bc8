/* Points and options of a fit: defaults, checks, copies, and the rows of the least squares.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>

#include "model.h"
#include "report.h"

void restitute_fit_point_init(restitute_fit_point *point)
{
    if (!point) return;
    *point = (restitute_fit_point){.struct_size = sizeof *point,
                                   .temperature = NAN,
                                   .ez = NAN,
                                   .ex = NAN,
                                   .contact_time = NAN,
                                   .sigma_ez = NAN,
                                   .sigma_ex = NAN,
                                   .sigma_contact_time = NAN};
    restitute_scene_init(&point->scene);
}

void restitute_fit_options_init(restitute_fit_options *options)
{
    if (!options) return;
    *options = (restitute_fit_options){.struct_size = sizeof *options,
                                       .model = RESTITUTE_FIT_STANDARD_SOLID,
                                       .poisson_ratio = 0.5,
                                       .confidence = 0.95,
                                       .reference_temperature = NAN,
                                       .wlf_c1 = NAN,
                                       .wlf_c2 = NAN,
                                       .starts = 4,
                                       .seed = 1,
                                       .threads = 1};
}

void restitute_fit_result_init(restitute_fit_result *result)
{
    if (result) *result = (restitute_fit_result){.struct_size = sizeof *result};
}

size_t rst_fit_solid_constants(int kind, size_t terms)
{
    return kind == RESTITUTE_FIT_ELASTIC          ? 1
           : kind == RESTITUTE_FIT_STANDARD_SOLID ? 3
           : kind == RESTITUTE_FIT_PRONY          ? 1 + terms
                                                  : 2;
}

double rst_fit_wlf(double c1, double c2, double difference)
{
    const double shift = -c1 * difference / (c2 + difference);
    return c2 + difference > 0 && fabs(shift) <= 30 ? shift : NAN;
}

int rst_fit_outside(const char *name, double value, double low, double high, restitute_error *error)
{
    if (value >= low && value <= high) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be in [%g, %g]", name, value, low, high);
}

static int check_known(const restitute_fit_options *o, restitute_error *error)
{
    char name[64];
    for (size_t i = 0; o->known && i < rst_fit_solid_constants(o->model, o->terms); i++) {
        snprintf(name, sizeof name, "options.known[%zu]", i);
        const int may_be_0 = o->model == RESTITUTE_FIT_PRONY && o->known[i] == 0;
        const int status = isnan(o->known[i]) || may_be_0 ? 0 : rst_fit_outside(name, o->known[i], 1e-30, 1e30, error);
        if (status) return status;
    }
    for (size_t k = 0; o->model == RESTITUTE_FIT_PRONY && k < o->terms; k++) {
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
    if (o->struct_size != sizeof *o)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE, "options.struct_size = %zu: must be %zu", o->struct_size,
                          sizeof *o);
    int status = rst_fit_outside("options.model", o->model, RESTITUTE_FIT_ELASTIC, RESTITUTE_FIT_PRONY, error);
    if (!status) status = rst_fit_outside("options.poisson_ratio", o->poisson_ratio, 0, 0.5, error);
    if (!status) status = rst_fit_outside("options.loss", o->loss, RESTITUTE_FIT_SQUARES, RESTITUTE_FIT_CAUCHY, error);
    if (!status) status = rst_fit_outside("options.confidence", o->confidence, 0.5, 0.999, error);
    if (!status) status = rst_fit_outside("options.starts", o->starts, 1, 100, error);
    if (!status) status = rst_fit_outside("options.threads", o->threads, 0, 1024, error);
    if (!status && isnan(o->wlf_c1) != isnan(o->wlf_c2))
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "options.wlf_c1, wlf_c2: must be both given or both NaN");
    if (!status && o->model == RESTITUTE_FIT_PRONY) {
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

/* The scene itself is checked where its T is found, in plan.c. */
static int check_point(size_t i, const restitute_fit_point *p, int noise_known, restitute_error *error)
{
    static const char *const names[] = {"ez", "ex", "contact_time"};
    static const double low[] = {0, -1, 1e-100}, high[] = {1, 1, 1e100};
    char name[64];
    int values = 0;
    if (p->struct_size != sizeof *p)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE, "points[%zu].struct_size = %zu: must be %zu", i,
                          p->struct_size, sizeof *p);
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
    if (isinf(p->temperature))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "points[%zu].temperature = %g: must be finite", i,
                          p->temperature);
    if (p->scene.material && p->scene.deformable == RESTITUTE_BOTH_BODIES_DEFORM)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "points[%zu]: a partner's material with BOTH_BODIES_DEFORM",
                          i);
    snprintf(name, sizeof name, "points[%zu].scene.normal_speed", i);
    return rst_fit_outside(name, p->scene.normal_speed, 1e-50, 1e50, error);
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

/* Distinct temperatures, the reference first; points of one temperature and partner share a solid. */
static int make_groups(struct rst_fit_data *d, restitute_error *error)
{
    double *t = d->temperature;
    t[0] = isnan(d->options.reference_temperature) ? d->points[0].temperature : d->options.reference_temperature;
    d->temperatures = 1;
    for (size_t i = 0; i < d->n; i++) {
        size_t k = 0, g = 0;
        restitute_fit_point *p = &d->points[i];
        if (isnan(p->temperature)) p->temperature = t[0];
        if (isnan(t[0]) && !isnan(p->temperature))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                              "points[%zu].temperature = %g: the first point or options.reference_temperature must "
                              "have one too",
                              i, p->temperature);
        while (k < d->temperatures && t[k] != p->temperature && !isnan(p->temperature))
            k++;
        if (k == RESTITUTE_DMA_SHIFTS)
            return rst_report(error, RESTITUTE_ERROR_DOMAIN, "points[%zu]: more than %d temperatures", i,
                              RESTITUTE_DMA_SHIFTS);
        if (k == d->temperatures) t[d->temperatures++] = p->temperature;
        if (!isnan(d->options.wlf_c1) && !isnan(t[k]) &&
            isnan(rst_fit_wlf(d->options.wlf_c1, d->options.wlf_c2, t[k] - t[0])))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                              "points[%zu].temperature = %g: must be above the pole of WLF, %g, with a_T in [1e-30, 1e30]",
                              i, t[k], t[0] - d->options.wlf_c2);
        while (g < d->groups && (d->points[d->first[g]].scene.material != p->scene.material ||
                                 (d->points[d->first[g]].temperature != p->temperature && !isnan(p->temperature))))
            g++;
        if (g == d->groups) d->first[d->groups++] = i;
        d->group[i] = g;
    }
    return RESTITUTE_OK;
}

static int copy(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                struct rst_fit_data *d)
{
    const size_t terms = options->model == RESTITUTE_FIT_PRONY ? options->terms : 0;
    const size_t known = options->known ? rst_fit_solid_constants(options->model, terms) : 0;
    d->n = n;
    d->options = *options;
    d->points = malloc(n * sizeof *d->points);
    d->row = malloc(RST_FIT_KINDS * n * sizeof *d->row);
    d->group = malloc(2 * n * sizeof *d->group);
    d->memory = malloc((terms + known + 1) * sizeof *d->memory);
    if (!d->points || !d->row || !d->group || !d->memory) return RESTITUTE_ERROR_MEMORY;
    d->first = d->group + n;
    memcpy(d->points, points, n * sizeof *points);
    if (terms) memcpy(d->memory, options->relaxation_time, terms * sizeof *d->memory);
    if (known) memcpy(d->memory + terms, options->known, known * sizeof *d->memory);
    d->options.relaxation_time = d->memory;
    d->options.known = known ? d->memory + terms : NULL;
    return RESTITUTE_OK;
}

/* A usual impact takes one to three thousand updates. Those of solids far from the data may take without end: they get
 * no more than a hundred thousand, and count as they then are. */
static void set_solver(struct rst_fit_data *d)
{
    restitute_options_init(&d->solver);
    d->solver.method = restitute_method_sync();
    d->solver.max_updates = 100000;
}

int rst_fit_data_create(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                        struct rst_fit_data *data, restitute_error *error)
{
    *data = (struct rst_fit_data){0};
    if (!points) return rst_report(error, RESTITUTE_ERROR_NULL, "points is NULL");
    if (n == 0 || n > 1000000) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "n = %zu: must be in [1, 1000000]", n);
    int status = check_options(options, error);
    for (size_t i = 0; !status && i < n; i++)
        status = check_point(i, &points[i], options->noise_known, error);
    if (!status && (status = copy(n, points, options, data)))
        rst_report(error, status, "out of memory for %zu points", n);
    if (!status) {
        set_solver(data);
        make_rows(data);
        status = make_groups(data, error);
    }
    if (!status) status = rst_fit_plan(data, error);
    if (status) rst_fit_data_release(data);
    return status;
}

void rst_fit_data_release(struct rst_fit_data *data)
{
    free(data->points);
    free(data->row);
    free(data->group);
    free(data->memory);
    free(data->impact);
    free(data->place);
    *data = (struct rst_fit_data){0};
}
