/* A table in plain numbers and back. What comes from outside is checked so that no lookup can leave the arrays.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>

#include "family.h"

/* Far more than any build makes: a bound on sums and products of sizes. */
static const int64_t most_cells_of_chi = 1 << 20, most_terms = 1 << 20;
static const double most_values = 1e11;

/* Of tables with cells: parts of gamma in all roots; the highest delta1 and gamma, whose w must be finite; widths of
 * roots and where they begin, far beyond any w. */
static const double most_parts = 1 << 24, most_of_axis = 1 << 30;
static const int64_t narrowest_root = -8, widest_root = 4, farthest_root = 1 << 20;

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

/* Leaves are numbers and no more: the view is of the tree's own. */
static void view_trees(const restitute_table *t, restitute_table_data *d)
{
    d->rebound_cells = t->rebound.leaves;
    d->w_width = t->w.width;
    d->w_first = t->w.first;
    d->w_roots = t->w.roots;
    d->chain_length = t->tangent.chain_length;
    for (int64_t i = 0; i < d->chain_length; i++)
        d->chain[i] = t->tangent.chain[i];
    d->leaves = &t->tangent.leaf->octave;
    d->rebound_leaves = &t->rebound.leaf->octave;
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
                                   .ex_cells = table->ex_cells};
    memcpy(data->range, table->asked, sizeof data->range);
    memcpy(data->version, table->version, sizeof data->version);
    view_axis(&table->speed, 0, data);
    view_axis(&table->gamma, 1, data);
    if (table->n_cells > 0) view_trees(table, data);
    return rst_done(error);
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

/* The order of halvings. */
static int check_chain(const restitute_table_data *d, restitute_error *error)
{
    int halvings[rst_alongs] = {0};
    if (d->chain_length < 0 || d->chain_length > rst_deepest) return refuse(error, "chain");
    for (int64_t i = 0; i < d->chain_length; i++) {
        const int64_t along = d->chain[i];
        const int good = along >= 0 && along < rst_alongs && (along != RST_ALONG_CHI || d->chi_low < d->chi_high);
        if (!good || ++halvings[along] > rst_most_halvings) return refuse(error, "chain");
    }
    return RESTITUTE_OK;
}

/* Axes of delta1 and gamma: roots of the trees of cells, and no other values. */
static int set_cells(const restitute_table_data *d, restitute_table *form, restitute_error *error)
{
    const int both = form->speed.cells > 0 && form->gamma.cells > 0;
    if (!both && d->cells == 0) return RESTITUTE_OK;
    const int64_t most = INT32_MAX - 1;
    if (!both || d->parts[0] != 1 || d->parts[1] != 1 || d->of_contact || d->cells <= 0 || d->cells > most ||
        d->rebound_cells <= 0 || d->rebound_cells > most || d->high[0] > most_of_axis || d->high[1] > most_of_axis)
        return refuse(error, "number of cells");
    const double octaves = (double)form->gamma.cells;
    if (d->w_width < narrowest_root || d->w_width > widest_root || d->w_first < -farthest_root ||
        d->w_first > farthest_root || d->w_roots <= 0 || d->w_roots > rst_most_roots ||
        octaves * (double)d->w_roots * rst_sheets * (1 << rst_finest_part) > most_parts)
        return refuse(error, "roots of w");
    form->w = (struct rst_w_axis){
        .first = d->w_first, .roots = d->w_roots, .width = d->w_width, .scale = ldexp(1, -(int)d->w_width)};
    rst_w_axis_logs(&form->w);
    form->n_cells = d->cells;
    return check_chain(d, error);
}

/* Leaves that are in the roots and do not overlap. Whether they fill the roots is not asked, since a build leaves out
 * what no delta1 of its range reaches: where there is none a lookup takes another, so that it cannot leave the arrays.
 * */
static int plant(const int64_t *leaves, int64_t count, const char *name, struct rst_tree *tree, restitute_error *error)
{
    const struct rst_leaf *leaf = (const struct rst_leaf *)(const void *)leaves;
    for (int64_t i = 0; i < count; i++)
        if (!rst_tree_takes(tree, &leaf[i])) return refuse(error, name);
    const int failed = rst_tree_plant(tree, leaf, count);
    if (failed == 1) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    return failed ? refuse(error, name) : RESTITUTE_OK;
}

static void fell_trees(restitute_table *form)
{
    rst_tree_fell(&form->rebound);
    rst_tree_fell(&form->tangent);
}

static int plant_trees(const restitute_table_data *d, restitute_table *form, restitute_error *error)
{
    int8_t chain[rst_deepest], by_w[rst_most_halvings];
    for (int64_t i = 0; i < d->chain_length; i++)
        chain[i] = (int8_t)d->chain[i];
    memset(by_w, RST_ALONG_W, sizeof by_w);
    const struct rst_roots roots = {form->gamma.cells, form->w.roots, rst_sheets},
                           flat = {roots.octaves, roots.roots, 1};
    rst_tree_begin(roots, chain, d->chain_length, &form->tangent);
    rst_tree_begin(flat, by_w, rst_most_halvings, &form->rebound);
    int status = plant(d->leaves, d->cells, "leaves", &form->tangent, error);
    if (!status) status = plant(d->rebound_leaves, d->rebound_cells, "rebound_leaves", &form->rebound, error);
    if (status) fell_trees(form);
    return status;
}

static int set_form(const restitute_table_data *d, restitute_table *form, restitute_error *error)
{
    memset(form, 0, sizeof *form);
    if (d->chi_cells < 0 || d->chi_cells > most_cells_of_chi || !(d->chi_low >= 1e-3 && d->chi_high <= 1e6) ||
        (d->chi_cells > 0 ? !(d->chi_low < d->chi_high) : !(d->chi_low <= d->chi_high)))
        return refuse(error, "chi");
    if (d->terms < 0 || d->terms > most_terms) return refuse(error, "terms");
    if (d->stick_cells < 0 || d->stick_cells > rst_most_psi_cells || d->slip_cells < 0 ||
        d->slip_cells > rst_most_psi_cells || (d->stick_cells == 0 && d->slip_cells > 0))
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

/* How many values there are. */
static size_t count_ez(const restitute_table_data *d, const restitute_table *form)
{
    return form->n_cells > 0 ? (size_t)d->rebound_cells * rst_pair_functions
                             : (size_t)form->n_speed * (size_t)form->n_gamma;
}

static size_t count_ex(const restitute_table *form)
{
    if (form->n_cells > 0) return (size_t)form->n_cells * (size_t)form->n_gamma;
    return (size_t)form->n_speed * (size_t)form->n_gamma * (size_t)form->n_psi * (size_t)form->n_chi;
}

/* Interpolation may overshoot by the error; beyond psi = 1 the difference of two ex is kept. */
static int check_arrays(const restitute_table_data *d, const restitute_table *form, restitute_error *error)
{
    const int cells = form->n_cells > 0;
    if (!d->ez || (cells ? !d->ex_cells || !d->leaves || !d->rebound_leaves : !d->ex) ||
        (d->terms > 0 && (!d->relaxation_time || !d->modulus)))
        return rst_report(error, RESTITUTE_ERROR_NULL, "an array of restitute_table_data is NULL");
    if (d->of_contact && !(d->psi_factor >= 0)) return refuse(error, "psi_factor");
    const int status = check_values(d->ez, count_ez(d, form), -0.5, 1.5, "ez", error);
    if (status) return status;
    return cells ? check_singles(d->ex_cells, count_ex(form), -1e4F, 1e4F, "ex_cells", error)
                 : check_values(d->ex, count_ex(form), -1e4, 1e4, "ex", error);
}

static void copy_values(const restitute_table_data *d, restitute_table *made)
{
    const size_t terms = (size_t)made->terms * sizeof *made->term;
    memcpy(made->ez, d->ez, count_ez(d, made) * sizeof *made->ez);
    if (made->n_cells > 0)
        memcpy(made->ex_cells, d->ex_cells, count_ex(made) * sizeof *made->ex_cells);
    else
        memcpy(made->ex, d->ex, count_ex(made) * sizeof *made->ex);
    if (terms == 0) return;
    memcpy(made->term, d->relaxation_time, terms);
    memcpy(made->term + made->terms, d->modulus, terms);
}

int restitute_table_from_data(const restitute_table_data *data, restitute_table **table, restitute_error *error)
{
    restitute_table form;
    if (!data || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", data ? "table" : "data");
    int status = check_size(data, error);
    if (!status) status = set_form(data, &form, error);
    if (!status) status = check_arrays(data, &form, error);
    if (!status && form.n_cells > 0) status = plant_trees(data, &form, error);
    if (status) return status;
    set_numbers(data, &form);
    restitute_table *made = rst_table_allocate(&form);
    if (!made) {
        fell_trees(&form);
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    }
    copy_values(data, made);
    rst_table_set_polynomials(made);
    *table = made;
    return rst_done(error);
}
