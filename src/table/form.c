/* Making a table from its numbers: one block of memory, checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include <stdlib.h>

static const int64_t most_terms = 1000000;

static int check_count(int64_t count, int64_t low, int64_t high, const char *name, restitute_error *error)
{
    if (count >= low && count <= high) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %lld: must be in [%lld, %lld]", name, (long long)count,
                      (long long)low, (long long)high);
}

static int check_counts(const restitute_table_data *d, restitute_error *error)
{
    int status = check_count(d->speeds, 2, rst_most_speeds, "speeds", error);
    if (!status) status = check_count(d->stick_cells, 1, rst_most_cells, "stick_cells", error);
    if (!status) status = check_count(d->slip_cells, 1, rst_most_cells, "slip_cells", error);
    if (!status) status = check_count(d->terms, 0, most_terms, "terms", error);
    return status;
}

/* Ranges of what contacts can have: no lookup overflows or divides by 0, for programs that trap
 * that. */
static int check_numbers(const restitute_table_data *d, restitute_error *error)
{
    const struct {
        const char *name;
        double value, low, high, besides;
    } number[] = {{"chi", d->chi, rst_chi_range[0], rst_chi_range[1], NAN},
                  {"psi_factor", d->psi_factor, 0, 1e31, INFINITY},
                  {"low", d->low, rst_sizes.low, rst_largest_speed, NAN},
                  {"high", d->high, d->low, rst_largest_speed, NAN},
                  {"duration", d->duration, 1e-120, 1e120, NAN},
                  {"friction", d->friction, 0, INFINITY, NAN},
                  {"radius", d->radius, 0.1 * rst_sizes.low, rst_sizes.high, NAN},
                  {"mass", d->mass, 0.1 * rst_sizes.low, rst_sizes.high, NAN},
                  {"density", d->density, 1e-250, 1e250, NAN},
                  {"dundurs_beta", d->dundurs_beta, -0.5, 0.5, NAN},
                  {"shortest", d->shortest, 0, INFINITY, NAN},
                  {"longest", d->longest, 0, INFINITY, NAN},
                  {"poisson_ratio", d->poisson_ratio, 0, 0.5, NAN},
                  {"equilibrium_modulus", d->equilibrium_modulus, 0, rst_moduli.high, NAN},
                  {"parallel_viscosity", d->parallel_viscosity, 0, rst_viscosities.high, NAN},
                  {"speed_limit", d->speed_limit, 0, INFINITY, NAN},
                  {"radius_limit", d->radius_limit, 0, INFINITY, NAN},
                  {"displacement_limit", d->displacement_limit, 0, INFINITY, NAN},
                  {"dundurs_limit", d->dundurs_limit, 0, INFINITY, NAN},
                  {"delta1", isnan(d->delta1) ? 0 : d->delta1, 0, 1e200, NAN}};
    int status = RESTITUTE_OK;
    for (size_t i = 0; i < sizeof number / sizeof *number && !status; i++) {
        const struct rst_range range = {number[i].low, number[i].high};
        status = rst_check_within(number[i].value, range, number[i].besides, number[i].name, error);
    }
    return status;
}

static int check_array(const double *value, int64_t n, double low, double high, const char *name,
                       restitute_error *error)
{
    char place[48];
    for (int64_t i = 0; i < n; i++) {
        if (value[i] >= low && value[i] <= high) continue;
        rst_print(place, sizeof place, "%s[%lld]", name, (long long)i);
        return rst_check_range(value[i], low, high, place, error);
    }
    return RESTITUTE_OK;
}

/* Slopes may be steep, but nothing may overflow or be NaN. */
static int check_values(const restitute_table_data *d, restitute_error *error)
{
    const double steep = 1e6, *speed = d->speed;
    const int64_t n = d->speeds;
    int status = check_array(speed, n, rst_sizes.low, rst_largest_speed, "speed", error);
    for (int64_t i = 1; i < n && !status; i++)
        if (speed[i] < speed[i - 1])
            status =
                rst_report(error, RESTITUTE_ERROR_DOMAIN, "speed[%lld] = %.17g: must be >= %.17g, the one before it",
                           (long long)i, speed[i], speed[i - 1]);
    if (!status && (speed[0] > d->low || speed[n - 1] < d->high || !(speed[0] < speed[n - 1])))
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = %g to %g: must rise, and cover %g to %g",
                            speed[0], speed[n - 1], d->low, d->high);
    if (!status) status = check_array(d->ez, 2 * n, -steep, steep, "ez", error);
    if (!status) status = check_array(d->ex, 4 * n * rst_places(d), -steep, steep, "ex", error);
    for (int64_t i = 0; i < 4 * n && !status; i++) /* finite ones have finite quotients */
        if (d->strain[i] != (double)INFINITY)
            status = rst_check_within(d->strain[i], (struct rst_range){1e-150, 1e150}, 0, "a finite strain", error);
    if (!status) status = check_array(d->modulus, d->terms, rst_moduli.low, rst_moduli.high, "modulus", error);
    if (status) return status;
    return check_array(d->relaxation_time, d->terms, rst_times.low, rst_times.high, "relaxation_time", error);
}

/* Number of bins: one for the narrowest cell, so that few have more than one edge in them. */
static int count_bins(const restitute_table_data *d)
{
    const double all = rst_axis_place(d->speed[d->speeds - 1], NULL) - rst_axis_place(d->speed[0], NULL);
    double narrowest = all;
    for (int64_t i = 0; i + 1 < d->speeds; i++) {
        const double width = rst_axis_place(d->speed[i + 1], NULL) - rst_axis_place(d->speed[i], NULL);
        if (width > 0) narrowest = fmin(narrowest, width);
    }
    return (int)fmin(rst_most_bins, ceil(all / narrowest - 1e-6)); /* a whole number, but for rounding */
}

static void set_nodes(restitute_table *t)
{
    const int64_t n = t->d.speeds;
    for (int64_t i = 0; i < n; i++) {
        t->node[i].at = rst_axis_place(t->d.speed[i], NULL);
        t->node[i].ez = t->d.ez[2 * i];
        t->node[i].slope = t->d.ez[2 * i + 1];
    }
    for (int64_t i = 0; i + 1 < n; i++) {
        const double width = t->node[i + 1].at - t->node[i].at;
        t->node[i].inverse_width = width > 0 ? 1 / width : 0;
    }
    t->node[n - 1].inverse_width = 0;
    t->end = nextafter(t->node[n - 1].at, -INFINITY); /* the highest speed belongs to the last cell */
}

/* A bin begins slightly late. Edges of cells are on edges of bins, so few searches need a further
 * step. */
static void set_bins(restitute_table *t, int bins)
{
    const double hair = 1e-9, first = t->node[0].at, width = (t->end - first) / bins;
    const int64_t last = t->d.speeds - 2;
    int64_t cell = 0;
    t->bins_per_s = 1 / width;
    for (int i = 0; i <= bins; i++) {
        while (cell < last && t->node[cell + 1].at <= first + ((double)i + hair) * width)
            cell++;
        t->bin[i] = (uint16_t)cell;
    }
}

static void *place(char **next, const void *from, size_t bytes)
{
    void *here = *next;
    if (from && bytes > 0) memcpy(here, from, bytes);
    *next += (bytes + 15) / 16 * 16;
    return here;
}

/* Nodes of ex lie side by side from a boundary of 16 bytes on. */
static void fill(restitute_table *t, const restitute_table_data *d, int bins)
{
    const size_t n = (size_t)d->speeds, terms = (size_t)d->terms, size = sizeof(double);
    char *next = (char *)t + (sizeof *t + 15) / 16 * 16;
    t->d = *d;
    t->d.ex = place(&next, d->ex, 4 * n * (size_t)rst_places(d) * size);
    t->node = place(&next, NULL, n * sizeof *t->node);
    t->d.speed = place(&next, d->speed, n * size);
    t->d.ez = place(&next, d->ez, 2 * n * size);
    t->d.strain = place(&next, d->strain, 4 * n * size);
    t->d.relaxation_time = place(&next, d->relaxation_time, terms * size);
    t->d.modulus = place(&next, d->modulus, terms * size);
    t->bin = place(&next, NULL, ((size_t)bins + 1) * sizeof *t->bin);
    t->bytes = (size_t)(next - (char *)t);
    t->share = rst_share(d->chi);
    t->of_stick = (double)d->stick_cells;
    t->of_slip = (double)d->slip_cells;
    set_nodes(t);
    set_bins(t, bins);
    restitute_table_contact_init(&t->own);
    t->own.speed_factor = 1;
    t->own.psi_factor = d->psi_factor;
    t->own.radius = d->radius;
    t->own.mass = d->mass;
    t->own.dundurs_beta = d->dundurs_beta;
    for (int i = 0; i < 4; i++)
        t->own.strain_factors[i] = 1;
}

/* speed_factor = 0: not set. */
RST_DEFAULTS(table_contact, .touch_gap = 1e-6)

RST_DEFAULTS(table_data, 0)

int restitute_table_data_get(const restitute_table *table, restitute_table_data *data, restitute_error *error)
{
    if (!table || !data) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "data" : "table");
    const int status = RST_CHECK(table_data, data, error);
    if (status) return status;
    RST_GIVE(&table->d, data);
    return rst_done(error);
}

static int check_data(const restitute_table_data *d, restitute_error *error)
{
    const void *const array[] = {d->speed, d->ez, d->strain, d->ex, d->relaxation_time, d->modulus};
    static const char *const name[] = {"speed", "ez", "strain", "ex", "relaxation_time", "modulus"};
    int status = check_counts(d, error);
    if (!status) status = check_numbers(d, error);
    if (status) return status;
    for (int i = 0; i < (d->terms > 0 ? 6 : 4); i++)
        if (!array[i]) return rst_report(error, RESTITUTE_ERROR_NULL, "data.%s is NULL", name[i]);
    return check_values(d, error);
}

int restitute_table_create(const restitute_table_data *data, restitute_table **table, restitute_error *error)
{
    restitute_table_data d;
    if (!data || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", data ? "table" : "data");
    int status = RST_TAKE(table_data, &d, data, error);
    if (status) return status;
    d.version[sizeof d.version - 1] = '\0';
    status = check_data(&d, error);
    if (status) return status;
    const int bins = count_bins(&d);
    const size_t n = (size_t)d.speeds, places = (size_t)rst_places(&d);
    const size_t bytes = sizeof **table +
                         n * (4 * places * sizeof(double) + 7 * sizeof(double) + sizeof(struct rst_node)) +
                         2 * (size_t)d.terms * sizeof(double) + ((size_t)bins + 1) * sizeof(uint16_t) + 10 * 16;
    restitute_table *made = malloc(bytes);
    if (!made) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    fill(made, &d, bins);
    *table = made;
    return rst_done(error);
}

void restitute_table_destroy(restitute_table *table)
{
    free(table);
}
