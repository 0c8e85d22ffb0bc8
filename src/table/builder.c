/* The build of a table, from the first columns to the last check (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

#include "base/window.h"

void restitute_table_options_init_sized(restitute_table_options *options, size_t size)
{
    restitute_options core;
    restitute_options_init(&core);
    const restitute_table_options defaults = {.speed = {1e-4, 100},
                                              .tolerance = 1e-5,
                                              .threads = 1,
                                              .max_impacts = 12000,
                                              .time_limit = 20,
                                              .speed_limit = core.speed_limit,
                                              .radius_limit = core.radius_limit,
                                              .displacement_limit = core.displacement_limit,
                                              .dundurs_limit = core.dundurs_limit};
    rst_init(options, size, &defaults, sizeof defaults);
}

static int check_options(const restitute_table_options *o, restitute_error *error)
{
    const double most_speed = 1e12, most_ratio = 1e15;
    if (!(o->speed[0] >= rst_sizes.low && o->speed[1] <= most_speed && o->speed[0] <= o->speed[1]))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = %g to %g: must rise within %g to %g",
                          o->speed[0], o->speed[1], rst_sizes.low, most_speed);
    if (o->speed[1] / o->speed[0] > most_ratio)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = %g to %g: highest over lowest must be <= %g",
                          o->speed[0], o->speed[1], most_ratio);
    if (o->threads < 0 || o->threads > rst_most_threads)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "threads = %d: must be in [0, %d] (0: all)", o->threads,
                          rst_most_threads);
    if (o->max_impacts <= 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "max_impacts = %lld: must be > 0", (long long)o->max_impacts);
    if (!(o->time_limit > 0))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "time_limit (s) = %g: must be > 0", o->time_limit);
    int status = rst_check_range(o->tolerance, 1e-7, 0.1, "tolerance", error);
    if (!status) status = rst_check_range(o->speed_limit, 0, INFINITY, "speed_limit", error);
    if (!status) status = rst_check_range(o->radius_limit, 0, INFINITY, "radius_limit", error);
    if (!status) status = rst_check_range(o->displacement_limit, 0, INFINITY, "displacement_limit", error);
    return status ? status : rst_check_range(o->dundurs_limit, 0, INFINITY, "dundurs_limit", error);
}

int rst_table_take_options(const restitute_table_options *theirs, restitute_table_options *ours, restitute_error *error)
{
    const int status = RST_TAKE(table_options, ours, theirs, error);
    return status ? status : check_options(ours, error);
}

/* ---- start */

/* Even columns. A solid without relaxation times needs only the first and the last. */
static int start(struct rst_builder *b, restitute_error *error)
{
    enum { fewest = 5, most = 14 }; /* up to 50 octaves */
    const double widest = 4;        /* octaves of a first cell: the fewest columns over six decades */
    const double *speed = b->options.speed, unknown = b->contact.timeless ? 0 : 1;
    const double low = rst_axis_place(speed[0], NULL), narrowest = low + (fewest - 1) * rst_narrowest;
    const double high = fmax(rst_axis_place(speed[1], NULL), narrowest); /* the last columns may lie above the range */
    const int n = b->contact.timeless ? 2 : (int)fmax(fewest, fmin(most, 1 + ceil((high - low) / widest)));
    struct rst_task task[most];
    for (int i = 0; i < n; i++) {
        const double at = low + (high - low) * i / (n - 1);
        task[i] = (struct rst_task){
            .column = {.speed = rst_axis_speed(at), .at = at, .by_speed = unknown, .checked = {-1, -1}}};
    }
    task[0].column.speed = speed[0];
    task[n - 1].column.speed = high > narrowest ? speed[1] : fmax(speed[1], rst_axis_speed(high));
    task[n - 1].column.at = high;
    if (rst_cost(b, n) > b->options.max_impacts)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "max_impacts = %lld: the first columns of a table take %lld; raise it",
                          (long long)b->options.max_impacts, (long long)rst_cost(b, n));
    const int status = rst_solve_tasks(b, n, task, error);
    return status ? status : rst_insert(b, n, task, error);
}

/* ---- seams */

/* Find where rebound begins between two columns, the lower of which sinks. Put two columns there,
 * both with e_z = 0. They also have e_x = 0, since the contact time grows without bound towards
 * this speed. Just above it there are speeds whose rebound the solver does not find. */
static int add_seam(struct rst_builder *b, int64_t i, restitute_error *error)
{
    const double fine = 1e-6; /* of s */
    double low = b->column[i].at, high = b->column[i + 1].at;
    struct rst_column_normal normal = b->column[i + 1].normal, middle;
    while (high - low > fine) {
        const double at = 0.5 * (low + high);
        int status = rst_column_begin(&b->solver[0], rst_axis_speed(at), error);
        if (!status) status = rst_column_normal(&b->solver[0], &middle, error);
        b->impacts++;
        if (status < 0 && !rst_column_is_too_hard(status)) return status;
        *(status >= 0 && middle.sunk ? &low : &high) = at;
    }
    const double at = 0.5 * (low + high);
    struct rst_task task[2];
    int failed = 0;
    for (int k = 0; k < 2; k++) {
        task[k] = (struct rst_task){
            .column = {.speed = rst_axis_speed(at), .at = at, .normal = normal, .by_speed = 1, .checked = {-1, -1}}};
        task[k].column.normal.ez = 0;
        task[k].column.normal.sunk = k == 0;
        failed |= rst_column_create(b, &task[k].column);
    }
    if (!failed) return rst_insert(b, 2, task, error);
    rst_column_destroy(&task[0].column);
    rst_column_destroy(&task[1].column);
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a seam");
}

static int add_seams(struct rst_builder *b, restitute_error *error)
{
    int status = RESTITUTE_OK;
    for (int64_t i = 0; i + 1 < b->columns && !status; i++) {
        if (!b->column[i].normal.sunk || b->column[i + 1].normal.sunk) continue;
        status = add_seam(b, i, error);
        i += 2;
    }
    return status;
}

/* ---- all of it */

static int run(struct rst_builder *b, restitute_table **table, restitute_error *error)
{
    int status = start(b, error), missed = 1;
    if (!status) status = add_seams(b, error);
    for (int round = 0; round < rst_rounds && missed && !status; round++) {
        const int64_t before = b->impacts;
        restitute_table *draft = NULL;
        status = rst_refine(b, error);
        if (round > 0 && before == b->impacts && !status) break; /* nothing more can be done */
        if (!status) status = rst_make_table(b, &draft, error);
        if (!status) status = rst_verify(b, draft, round, &missed, error);
        restitute_table_destroy(draft);
    }
    return status ? status : rst_make_table(b, table, error);
}

static int create(const restitute_scene *scene, const restitute_table_options *options, int threads,
                  struct rst_builder *b, restitute_error *error)
{
    const double finer = pow(1e-5 / options->tolerance, 0.25);
    *b = (struct rst_builder){
        .options = *options,
        .began = rst_table_clock(),
        .first = {(int64_t)fmax(8, ceil(rst_first_stick * finer)), (int64_t)fmax(16, ceil(rst_first_slip * finer))}};
    int status = rst_contact_set(scene, &b->contact, error);
    const double chi = b->contact.numbers.chi;
    if (!status && !(chi >= rst_chi_range[0] && chi <= rst_chi_range[1]))
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %.17g of the scene: a table takes [%g, %g]", chi,
                            rst_chi_range[0], rst_chi_range[1]);
    if (status) return status;
    if (!rst_has_psi(&b->contact)) b->first[0] = b->first[1] = 1;
    if (rst_share(chi) <= 0) b->first[1] = 1;
    memcpy(b->cells, b->first, sizeof b->cells);
    b->threads = rst_threads(threads, rst_most_speeds);
    b->solver = calloc((size_t)b->threads, sizeof *b->solver);
    if (!b->solver) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for solvers");
    for (int i = 0; i < b->threads; i++)
        rst_column_solver_init(&b->contact, &b->options, rst_part_for_nodes * options->tolerance, &b->solver[i]);
    return RESTITUTE_OK;
}

static void destroy(struct rst_builder *b)
{
    for (int64_t i = 0; i < b->columns; i++)
        rst_column_destroy(&b->column[i]);
    for (int i = 0; b->solver && i < b->threads; i++)
        restitute_plan_destroy(b->solver[i].plan);
    free(b->column);
    free(b->solver);
}

/* Shortest and longest contact time between the lowest and the highest speed; 0 and 0 if the sphere
 * sinks everywhere. */
static void contact_times(const struct rst_builder *b, double times[2])
{
    times[0] = times[1] = 0;
    for (int64_t i = 0; i < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        if (c->normal.sunk || c->speed < b->options.speed[0] || c->speed > b->options.speed[1]) continue;
        times[0] = times[1] > 0 ? fmin(times[0], c->normal.strain[3]) : c->normal.strain[3];
        times[1] = fmax(times[1], c->normal.strain[3]);
    }
}

static void remark_window(const restitute_material *material, const double times[2], restitute_error *error)
{
    char text[80];
    double shortest, longest;
    restitute_material_window(material, &shortest, &longest, NULL);
    if (!(times[1] > 0) || (times[0] >= shortest && times[1] <= longest)) return;
    rst_print(text, sizeof text, "contact times from %.3g to %.3g s leave", times[0], times[1]);
    rst_remark_window(text, material, error);
}

static int judge(const restitute_table_data *d, double taken, double time_limit, restitute_error *error)
{
    if (fmax(d->error_ez, d->error_ex) <= d->tolerance) return rst_done(error);
    return rst_report(
        error, RESTITUTE_TOLERANCE_NOT_REACHED,
        "tolerance = %g: verified errors %.2g (ez), %.2g (ex) after %lld impacts and %.2g s; time_limit = %g s",
        d->tolerance, d->error_ez, d->error_ex, (long long)d->impacts, taken, time_limit);
}

int rst_build(const restitute_scene *scene, const restitute_table_options *options, int threads,
              restitute_table **table, restitute_error *error)
{
    struct rst_builder b;
    restitute_table *made = NULL;
    int status = create(scene, options, threads, &b, error);
    if (!status) status = run(&b, &made, error);
    const double taken = rst_table_clock() - b.began;
    double times[2];
    contact_times(&b, times);
    destroy(&b);
    if (status) return status;
    *table = made;
    status = judge(&made->d, taken, options->time_limit, error);
    remark_window(scene->material, times, error);
    return status;
}

int restitute_table_build(const restitute_scene *scene, const restitute_table_options *options, restitute_table **table,
                          restitute_error *error)
{
    restitute_table_options own;
    if (!scene || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", scene ? "table" : "scene");
    const int status = rst_table_take_options(options, &own, error);
    return status ? status : rst_build(scene, &own, own.threads, table, error);
}
