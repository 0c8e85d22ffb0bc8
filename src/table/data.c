/* A table in plain numbers and back. What comes from outside is checked so that no lookup can leave the arrays.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>

#include "family.h"

/* Far more than any build makes: a bound on sums and products of sizes. */
static const int64_t most_cells_of_psi = 1 << 20, most_terms = 1 << 20;
static const double most_values = 1e11;

void restitute_table_data_init(restitute_table_data *data)
{
    if (!data) return;
    *data = (restitute_table_data){.struct_size = sizeof *data};
}

static int check_size(const restitute_table_data *data, restitute_error *error)
{
    if (data->struct_size == sizeof *data) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                      "restitute_table_data.struct_size = %zu: must be %zu; prepare the struct with "
                      "restitute_table_data_init of this version",
                      data->struct_size, sizeof *data);
}

static void view_axis(const struct rst_octaves *axis, int i, restitute_table_data *d)
{
    d->low[i] = rst_octaves_node(axis, 0);
    d->high[i] = rst_octaves_node(axis, axis->cells * rst_cubic);
    d->parts[i] = axis->cells > 0 ? INT64_C(1) << (52 - axis->shift) : 0;
}

int restitute_table_to_data(const restitute_table *table, restitute_table_data *data, restitute_error *error)
{
    if (!table || !data) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "data" : "table");
    const int status = check_size(data, error);
    if (status) return status;
    *data = (restitute_table_data){.struct_size = sizeof *data,
                                   .of_contact = table->of_contact,
                                   .tolerance = table->tolerance,
                                   .error_ez = table->error_ez,
                                   .error_ex = table->error_ex,
                                   .impacts = table->impacts,
                                   .checks = table->checks,
                                   .psi_factor = table->own.psi_factor,
                                   .own_chi = table->own.chi,
                                   .own_gamma = table->own.gamma,
                                   .own_delta1 = table->own.delta1,
                                   .duration = table->duration,
                                   .friction = table->friction,
                                   .radius = table->radius,
                                   .mass = table->mass,
                                   .modulus_factor = table->modulus_factor,
                                   .poisson_ratio = table->poisson_ratio,
                                   .equilibrium_modulus = table->equilibrium_modulus,
                                   .parallel_viscosity = table->parallel_viscosity,
                                   .terms = table->terms,
                                   .relaxation_time = table->term,
                                   .modulus = table->term + table->terms,
                                   .chi_low = table->chi_low,
                                   .chi_high = table->chi_high,
                                   .chi_cells = table->chi_cells,
                                   .stick_cells = table->stick_cells,
                                   .slip_cells = table->slip_cells,
                                   .nodes = {table->n_speed, table->n_gamma, table->n_chi, table->n_psi},
                                   .ez = table->ez,
                                   .ex = table->ex,
                                   .cells = table->n_cells,
                                   .patches = table->n_cells > 0 ? &table->patch->first : NULL,
                                   .ex_cells = table->ex_cells};
    memcpy(data->range, table->asked, sizeof data->range);
    memcpy(data->version, table->version, sizeof data->version);
    view_axis(&table->speed, 0, data);
    view_axis(&table->gamma, 1, data);
    return rst_done(error);
}

/* delta1 or gamma at the nodes of all cells. */
static void cell_nodes(const restitute_table *t, int axis, double *place)
{
    const int64_t patches = t->speed.cells * t->gamma.cells;
    for (int64_t p = 0; p < patches; p++) {
        const int64_t octave = axis ? p % t->gamma.cells : p / t->gamma.cells, *k = t->patch[p].k;
        for (int64_t cell = 0; cell < INT64_C(1) << (k[0] + k[1]); cell++) {
            const int64_t first = rst_cubic * (axis ? cell % (INT64_C(1) << k[1]) : cell >> k[1]);
            for (int64_t m = 0; m < rst_cell_nodes; m++)
                *place++ =
                    rst_patch_node(axis ? &t->gamma : &t->speed, octave, k[axis], first + (axis ? m % 4 : m / 4));
        }
    }
}

int restitute_table_nodes(const restitute_table *table, int axis, double *places)
{
    if (!table || !places) return RESTITUTE_ERROR_NULL;
    if (axis < 0 || axis > 3) return RESTITUTE_ERROR_DOMAIN;
    if (axis < 2 && table->n_cells > 0) {
        cell_nodes(table, axis, places);
        return RESTITUTE_OK;
    }
    for (int64_t i = 0; axis < 2 && i < (axis ? table->n_gamma : table->n_speed); i++)
        places[i] = rst_octaves_node(axis ? &table->gamma : &table->speed, i);
    for (int64_t i = 0; axis == 2 && i < table->n_chi; i++)
        places[i] = rst_chi_node(table, i);
    for (int64_t i = 0; axis == 3 && i < table->n_psi; i++) {
        const double root = i >= table->start[2]   ? rst_slip_node(table->slip_cells, i - table->start[2])
                            : i >= table->start[1] ? rst_slip_node(table->slip_cells, i - table->start[1])
                                                   : 0;
        const double stick = table->stick_cells ? (double)i / (double)(table->stick_cells * rst_cubic) : 0;
        places[i] = i >= table->start[2] ? 2 - rst_slip_y(root) : i >= table->start[1] ? 1 + rst_slip_y(root) : stick;
    }
    return RESTITUTE_OK;
}

/* ---- from outside */

static int refuse(restitute_error *error, const char *name)
{
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s: a value that no table has", name);
}

static int is_seam(double value, int shift)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits & ((INT64_C(1) << shift) - 1)) == 0;
}

static int set_axis(const restitute_table_data *d, int i, const char *name, struct rst_octaves *axis,
                    restitute_error *error)
{
    const double low = d->low[i], high = d->high[i];
    int k = 0;
    if (d->parts[i] == 0) {
        rst_octaves_set(low, low, 1, axis);
        return RESTITUTE_OK;
    }
    while (k < 10 && (INT64_C(1) << k) < d->parts[i])
        k++;
    if ((INT64_C(1) << k) != d->parts[i] || !(low >= DBL_MIN) || !(high <= DBL_MAX) || !(low < high) ||
        !is_seam(low, 52 - k) || !is_seam(high, 52 - k))
        return refuse(error, name);
    rst_octaves_set(low, high, k, axis);
    if (!(d->range[i][0] >= low && d->range[i][1] <= high && d->range[i][0] < d->range[i][1]))
        return refuse(error, name);
    rst_octaves_limit(d->range[i][0], d->range[i][1], axis);
    return RESTITUTE_OK;
}

static int check_singles(const float *value, size_t n, float low, float high, const char *name, restitute_error *error)
{
    for (size_t i = 0; i < n; i++)
        if (!(value[i] >= low && value[i] <= high)) return refuse(error, name);
    return RESTITUTE_OK;
}

static int check_values(const double *value, size_t n, double low, double high, const char *name,
                        restitute_error *error)
{
    for (size_t i = 0; i < n; i++)
        if (!(value[i] >= low && value[i] <= high)) return refuse(error, name);
    return RESTITUTE_OK;
}

/* Both axes of octaves: patches, and all of their values in cells. */
static int set_cells(const restitute_table_data *d, restitute_table *form, restitute_error *error)
{
    const int64_t patches = form->speed.cells * form->gamma.cells;
    if (patches == 0 && d->cells == 0) return RESTITUTE_OK;
    const int octaves = patches > 0 && d->parts[0] == 1 && d->parts[1] == 1;
    if (!octaves || d->of_contact || d->stick_cells == 0 || d->cells < patches ||
        d->cells > patches << (2 * rst_finest_patch))
        return refuse(error, "number of cells");
    form->n_cells = d->cells;
    return RESTITUTE_OK;
}

/* Numbered and divided as a table's are. */
static int check_patches(const restitute_table_data *d, int64_t patches, restitute_error *error)
{
    int64_t cells = 0;
    for (int64_t p = 0; p < patches; p++) {
        const int64_t first = d->patches[3 * p], k = d->patches[3 * p + 1], l = d->patches[3 * p + 2];
        if (first != cells || k < 0 || k > rst_finest_patch || l < 0 || l > rst_finest_patch)
            return refuse(error, "patches");
        cells += INT64_C(1) << (k + l);
    }
    return cells == d->cells ? RESTITUTE_OK : refuse(error, "patches");
}

static int set_form(const restitute_table_data *d, restitute_table *form, restitute_error *error)
{
    memset(form, 0, sizeof *form);
    if (d->chi_cells < 0 || d->chi_cells > most_cells_of_psi || !(d->chi_low >= 1e-3 && d->chi_high <= 1e6) ||
        (d->chi_cells > 0 ? !(d->chi_low < d->chi_high) : !(d->chi_low <= d->chi_high)))
        return refuse(error, "chi");
    if (d->terms < 0 || d->terms > most_terms) return refuse(error, "terms");
    if (d->stick_cells < 0 || d->stick_cells > most_cells_of_psi || d->slip_cells < 0 ||
        d->slip_cells > most_cells_of_psi || (d->stick_cells == 0 && d->slip_cells > 0))
        return refuse(error, "cells of psi");
    int status = set_axis(d, 0, "axis of speed or delta1", &form->speed, error);
    if (!status) status = set_axis(d, 1, "axis of gamma", &form->gamma, error);
    if (status) return status;
    form->chi_low = d->chi_low;
    form->chi_high = d->chi_high;
    form->chi_cells = d->chi_cells;
    form->stick_cells = d->stick_cells;
    form->slip_cells = d->slip_cells;
    form->terms = d->terms;
    status = set_cells(d, form, error);
    if (status) return status;
    rst_table_count(form);
    /* without a slip side psi_c must be 1 for all chi */
    if (form->stick_cells > 0 && form->slip_cells == 0 && 2 * form->chi_high > 1) return refuse(error, "cells of psi");
    if ((double)form->n_speed * (double)form->n_gamma * (double)form->n_psi * (double)form->n_chi > most_values)
        return refuse(error, "number of nodes");
    return RESTITUTE_OK;
}

static void set_numbers(const restitute_table_data *d, restitute_table *form)
{
    form->of_contact = d->of_contact != 0;
    restitute_table_contact_init(&form->own);
    form->own.psi_factor = d->psi_factor;
    form->own.chi = d->own_chi;
    form->own.gamma = d->own_gamma;
    form->own.delta1 = d->own_delta1;
    form->duration = d->duration;
    form->friction = d->friction;
    form->radius = d->radius;
    form->mass = d->mass;
    form->modulus_factor = d->modulus_factor;
    form->poisson_ratio = d->poisson_ratio;
    form->equilibrium_modulus = d->equilibrium_modulus;
    form->parallel_viscosity = d->parallel_viscosity;
    form->tolerance = d->tolerance;
    form->error_ez = d->error_ez;
    form->error_ex = d->error_ex;
    form->impacts = d->impacts;
    form->checks = d->checks;
    memcpy(form->asked, d->range, sizeof form->asked);
    snprintf(form->version, sizeof form->version, "%.31s", d->version);
}

int restitute_table_data_nodes(const restitute_table_data *data, int64_t nodes[4], restitute_error *error)
{
    restitute_table form;
    if (!data || !nodes) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", data ? "nodes" : "data");
    int status = check_size(data, error);
    if (!status) status = set_form(data, &form, error);
    if (status) return status;
    const int64_t found[4] = {form.n_speed, form.n_gamma, form.n_chi, form.n_psi};
    memcpy(nodes, found, sizeof found);
    return rst_done(error);
}

int restitute_table_from_data(const restitute_table_data *data, restitute_table **table, restitute_error *error)
{
    restitute_table form;
    if (!data || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", data ? "table" : "data");
    int status = check_size(data, error);
    if (!status) status = set_form(data, &form, error);
    if (status) return status;
    const int cells = form.n_cells > 0;
    if (!data->ez || (cells ? !data->ex_cells || !data->patches : !data->ex) ||
        (data->terms > 0 && (!data->relaxation_time || !data->modulus)))
        return rst_report(error, RESTITUTE_ERROR_NULL, "an array of restitute_table_data is NULL");
    const size_t n_ez = (size_t)form.n_speed * (size_t)form.n_gamma;
    const size_t n_ex = n_ez * (size_t)form.n_psi * (size_t)form.n_chi;
    if (data->of_contact && !(data->psi_factor >= 0)) return refuse(error, "psi_factor");
    /* interpolation may overshoot by the error; beyond psi = 1 the difference of two ex is kept */
    status = check_values(data->ez, n_ez, -0.5, 1.5, "ez", error);
    const int64_t patches = form.speed.cells * form.gamma.cells;
    if (!status && cells) status = check_patches(data, patches, error);
    if (!status)
        status = cells ? check_singles(data->ex_cells, n_ex, -1e4F, 1e4F, "ex_cells", error)
                       : check_values(data->ex, n_ex, -1e4, 1e4, "ex", error);
    if (status) return status;
    set_numbers(data, &form);
    restitute_table *made = rst_table_allocate(&form);
    if (!made) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    memcpy(made->ez, data->ez, n_ez * sizeof *made->ez);
    if (cells) {
        memcpy(made->patch, data->patches, (size_t)patches * sizeof *made->patch);
        memcpy(made->ex_cells, data->ex_cells, n_ex * sizeof *made->ex_cells);
    } else {
        memcpy(made->ex, data->ex, n_ex * sizeof *made->ex);
    }
    if (form.terms > 0) {
        memcpy(made->term, data->relaxation_time, (size_t)form.terms * sizeof *made->term);
        memcpy(made->term + form.terms, data->modulus, (size_t)form.terms * sizeof *made->term);
    }
    *table = made;
    return rst_done(error);
}
