/* A table in a file: schema 3 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "container.h"

static const char title[] = "table";

/* Tables of schemas 1 and 2 are the same but for those with cells. */
enum { oldest_schema = 1 };

/* Members that are attributes of the root. */
#define NUMBERS(X)                                                                                                     \
    X(tolerance)                                                                                                       \
    X(error_ez)                                                                                                        \
    X(error_ex)                                                                                                        \
    X(psi_factor) X(own_chi) X(own_gamma) X(own_delta1) X(duration) X(friction) X(radius) X(mass) X(modulus_factor)    \
        X(chi_low) X(chi_high) X(poisson_ratio) X(equilibrium_modulus) X(parallel_viscosity)
#define INTEGERS(X) X(of_contact) X(impacts) X(checks) X(terms) X(chi_cells) X(stick_cells) X(slip_cells) X(cells)
#define CELL_INTEGERS(X) X(rebound_cells) X(w_width) X(w_first) X(w_roots) /* with cells alone */

static const char units_of_attributes[] = "speeds m/s; duration s (of the contact at 1 m/s); radius m; mass kg; "
                                          "equilibrium_modulus Pa; parallel_viscosity Pa s; "
                                          "psi_factor: psi v_n/|v_t|; all others dimensionless";

/* Arrays of two numbers by their parts. */
struct pair_name {
    const char *name;
    size_t offset;
};
#define AT(member) offsetof(restitute_table_data, member)
static const struct pair_name pairs[] = {{"range_first_low", AT(range[0][0])}, {"range_first_high", AT(range[0][1])},
                                         {"range_gamma_low", AT(range[1][0])}, {"range_gamma_high", AT(range[1][1])},
                                         {"range_chi_low", AT(range[2][0])},   {"range_chi_high", AT(range[2][1])},
                                         {"axis_first_low", AT(low[0])},       {"axis_first_high", AT(high[0])},
                                         {"axis_gamma_low", AT(low[1])},       {"axis_gamma_high", AT(high[1])}};
enum { n_pairs = sizeof pairs / sizeof *pairs };

static int put_attributes(hid_t f, const restitute_table_data *d)
{
    int failed = rst_put_text(f, "kind", d->of_contact ? "contact" : "ranges");
    failed |= rst_put_text(f, "restitute_version", d->version);
    failed |= rst_put_integer(f, "schema", rst_schema);
    failed |= rst_put_text(f, "units", units_of_attributes);
#define PUT(member) failed |= rst_put_number(f, #member, d->member);
    NUMBERS(PUT)
#undef PUT
#define PUT(member) failed |= rst_put_integer(f, #member, d->member);
    INTEGERS(PUT)
    if (d->cells > 0) {
        CELL_INTEGERS(PUT)
    }
#undef PUT
    failed |= rst_put_integer(f, "parts_first", d->parts[0]);
    failed |= rst_put_integer(f, "parts_gamma", d->parts[1]);
    for (int i = 0; i < n_pairs; i++)
        failed |= rst_put_number(f, pairs[i].name, *(const double *)((const char *)d + pairs[i].offset));
    return failed;
}

/* Places of nodes. */
static int put_axis(hid_t f, const restitute_table *table, const restitute_table_data *d, int axis)
{
    static const char *const names[] = {"delta1", "gamma", "chi", "psi"};
    static const char *const texts[] = {"nodes of delta1 (23)", "nodes of gamma (23)", "nodes of chi (22)",
                                        "nodes of psi (22) up to 1, then 1 + y, y = (psi - 1)/(psi_c - 1)"};
    const int speed = axis == 0 && d->of_contact;
    double *place = malloc((size_t)d->nodes[axis] * sizeof *place);
    if (!place) return 1;
    const int failed = restitute_table_nodes(table, axis, place) ||
                       rst_put_values(f, speed ? "speed" : names[axis], RST_DOUBLES, 1, &d->nodes[axis], place,
                                      speed ? "m/s" : "1", speed ? "nodes of the speed" : texts[axis]);
    free(place);
    return failed;
}

static const char
    text_of_ex[] = "ex for psi <= 1, then ex - (2 chi (1 + ez)/psi - 1); from psi_c on that closed form alone",
    text_of_cells[] =
        "[cell][coefficient] of ex for psi <= 1, then of psi ex - y ez; from psi_c on 2 chi (1 + ez)/psi - 1",
    text_of_functions[] =
        "places along w, gamma, chi and psi, 0 to 4, of the function that a coefficient of ex belongs to; those with chi "
        "and psi 0 are those of ez: see restitute_table_data",
    text_of_leaves[] =
        "octave of gamma, root of w, sheet of psi, halvings along the chain, their path, level and part of "
        "gamma: see restitute_table_data";

/* A table with cells: ex in single precision as in the table itself. */
static int put_cells(hid_t f, const restitute_table_data *d)
{
    const int64_t size_ez[2] = {d->rebound_cells, 17}, leaves[2] = {d->cells, 7}, rebound[2] = {d->rebound_cells, 7};
    const int64_t size_ex[2] = {d->cells, d->nodes[1]};
    return rst_put_values(f, "ez", RST_DOUBLES, 2, size_ez, d->ez, "1", "[cell][coefficient] of ez") ||
           rst_put_values(f, "ex", RST_SINGLES, 2, size_ex, d->ex_cells, "1", text_of_cells) ||
           rst_put_values(f, "leaves", RST_INTEGERS, 2, leaves, d->leaves, "1", text_of_leaves) ||
           rst_put_values(f, "rebound_leaves", RST_INTEGERS, 2, rebound, d->rebound_leaves, "1", text_of_leaves) ||
           rst_put_values(f, "chain", RST_INTEGERS, 1, &d->chain_length, d->chain, "1",
                          "along what a root of ex is halved, time after time: 0 w, 1 chi, 2 psi");
}

/* Which functions the coefficients belong to. */
static int put_functions(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    const int64_t size[2] = {d->nodes[1], 4};
    int64_t(*places)[4] = malloc((size_t)size[0] * sizeof *places);
    const int failed = !places || restitute_table_cell_functions(table, places) ||
                       rst_put_values(f, "functions", RST_INTEGERS, 2, size, places, "1", text_of_functions);
    free(places);
    return failed;
}

static int put_dense(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    const int64_t size[4] = {d->nodes[0], d->nodes[1], d->nodes[3], d->nodes[2]};
    for (int axis = 0; axis < 4; axis++)
        if (put_axis(f, table, d, axis)) return 1;
    return rst_put_values(f, "ez", RST_DOUBLES, 2, size, d->ez, "1", "ez at [speed or delta1][gamma]") ||
           rst_put_values(f, "ex", RST_DOUBLES, 4, size, d->ex, "1", text_of_ex);
}

static int put_table(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    int failed = put_attributes(f, d);
    if (!failed) failed = d->cells > 0 ? put_functions(f, table, d) || put_cells(f, d) : put_dense(f, table, d);
    if (failed || d->terms == 0) return failed;
    return rst_put_values(f, "relaxation_time", RST_DOUBLES, 1, &d->terms, d->relaxation_time, "s",
                          "of the material's Prony series") ||
           rst_put_values(f, "modulus", RST_DOUBLES, 1, &d->terms, d->modulus, "Pa", "of the material's Prony series");
}

static int write_table(const restitute_table *table, const restitute_table_data *d, const char *path,
                       restitute_error *error)
{
    const hid_t file = rst_container_begin();
    return rst_container_end(file, file >= 0 && !put_table(file, table, d), title, path, error);
}

int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error)
{
    restitute_table_data data;
    if (!table || !path) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "path" : "table");
    restitute_table_data_init(&data);
    int status = restitute_table_to_data(table, &data, error);
    if (status) return status;
    const struct rst_quiet quiet = rst_quiet_begin();
    status = write_table(table, &data, path, error);
    rst_quiet_end(quiet);
    return status ? status : rst_done(error);
}

/* ---- reading */

static int get_attributes(hid_t f, restitute_table_data *d)
{
    int failed = rst_get_text(f, "restitute_version", sizeof d->version, d->version);
#define GET(member) failed |= rst_get_number(f, #member, &d->member);
    NUMBERS(GET)
#undef GET
#define GET(member) failed |= rst_get_integer(f, #member, &d->member);
    INTEGERS(GET)
    if (!failed && d->cells > 0) {
        CELL_INTEGERS(GET)
    }
#undef GET
    failed |= rst_get_integer(f, "parts_first", &d->parts[0]);
    failed |= rst_get_integer(f, "parts_gamma", &d->parts[1]);
    for (int i = 0; i < n_pairs; i++)
        failed |= rst_get_number(f, pairs[i].name, (double *)((char *)d + pairs[i].offset));
    return failed;
}

/* The halvings; no more than there is room for. */
static int get_chain(hid_t f, restitute_table_data *d)
{
    if (d->cells == 0) return 0;
    d->chain_length = rst_count_values(f, "chain", RST_INTEGERS);
    if (d->chain_length < 0 || d->chain_length > (int64_t)(sizeof d->chain / sizeof *d->chain)) return 1;
    return rst_get_values(f, "chain", RST_INTEGERS, d->chain_length, d->chain);
}

/* A dataset, and how many values it must have. */
enum { SET_EZ, SET_EX, SET_TIMES, SET_MODULI, SET_LEAVES, SET_REBOUND_LEAVES, SETS };
struct set {
    const char *name;
    enum rst_kind kind;
    int64_t count;
    void *value;
};

static void expect_sets(const restitute_table_data *d, const int64_t n[4], struct set set[SETS])
{
    const int cells = d->cells > 0;
    const struct set all[SETS] = {{"ez", RST_DOUBLES, cells ? 17 * d->rebound_cells : n[0] * n[1], NULL},
                                  {"ex", cells ? RST_SINGLES : RST_DOUBLES, n[0] * n[1] * (cells ? 1 : n[2] * n[3]), NULL},
                                  {"relaxation_time", RST_DOUBLES, d->terms, NULL},
                                  {"modulus", RST_DOUBLES, d->terms, NULL},
                                  {"leaves", RST_INTEGERS, cells ? 7 * d->cells : 0, NULL},
                                  {"rebound_leaves", RST_INTEGERS, cells ? 7 * d->rebound_cells : 0, NULL}};
    memcpy(set, all, sizeof all);
}

/* A count is compared with that of the file before room is made. */
static int get_set(hid_t f, struct set *set, restitute_error *why)
{
    const size_t bytes = set->kind == RST_SINGLES ? sizeof(float) : 8;
    if (set->count == 0) return 0;
    if (rst_count_values(f, set->name, set->kind) != set->count) return 1;
    set->value = malloc((size_t)set->count * bytes);
    if (!set->value) why->status = RESTITUTE_ERROR_MEMORY;
    return !set->value || rst_get_values(f, set->name, set->kind, set->count, set->value);
}

static int make_table(restitute_table_data *d, const struct set set[SETS], restitute_table **table,
                      restitute_error *why)
{
    d->ez = set[SET_EZ].value;
    if (d->cells > 0)
        d->ex_cells = set[SET_EX].value;
    else
        d->ex = set[SET_EX].value;
    d->relaxation_time = set[SET_TIMES].value;
    d->modulus = set[SET_MODULI].value;
    d->leaves = set[SET_LEAVES].value;
    d->rebound_leaves = set[SET_REBOUND_LEAVES].value;
    return restitute_table_from_data(d, table, why);
}

/* Everything of the file, in `d` and `set`; else why not. */
static int get_table(hid_t f, restitute_table_data *d, struct set set[SETS], restitute_error *why)
{
    const restitute_error missing = {.status = RESTITUTE_ERROR_FORMAT, .message = "parts are missing"};
    int64_t nodes[4];
    *why = missing;
    if (get_attributes(f, d) || get_chain(f, d) || restitute_table_data_nodes(d, nodes, why)) return 1;
    *why = missing;
    expect_sets(d, nodes, set);
    int failed = 0;
    for (int i = 0; i < SETS && !failed; i++)
        failed = get_set(f, &set[i], why);
    return failed;
}

static int read_table(const char *path, const struct rst_old_file *file, restitute_table **table,
                      restitute_error *error)
{
    restitute_table_data d;
    struct set set[SETS] = {{0}};
    restitute_error why;
    int64_t cells = 0;
    if (file->schema < rst_schema && !rst_get_integer(file->file, "cells", &cells) && cells > 0)
        return rst_report(
            error, RESTITUTE_ERROR_FORMAT,
            "%.120s: schema %d: tables with axes of delta1 and gamma are read from schema %d on; build it "
            "again",
            path, file->schema, rst_schema);
    restitute_table_data_init(&d);
    const int failed = get_table(file->file, &d, set, &why);
    const int status = failed ? why.status : make_table(&d, set, table, &why);
    for (int i = 0; i < SETS; i++)
        free(set[i].value);
    if (status == RESTITUTE_ERROR_MEMORY) return rst_report(error, status, "%.120s: out of memory", path);
    if (status) return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: holds no table: %.100s", path, why.message);
    return RESTITUTE_OK;
}

int restitute_table_read(const char *path, restitute_table **table, restitute_error *error)
{
    struct rst_old_file file;
    if (!path || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", path ? "table" : "path");
    const struct rst_quiet quiet = rst_quiet_begin();
    int status = rst_old_file_open(path, title, oldest_schema, &file, error);
    if (!status) {
        status = read_table(path, &file, table, error);
        rst_old_file_close(&file);
    }
    rst_quiet_end(quiet);
    return status ? status : rst_done(error);
}
