/* A table in a file: schema 1 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "container.h"

static const char title[] = "table";

/* Members that are attributes of the root. */
#define NUMBERS(X)                                                                                                     \
    X(tolerance)                                                                                                       \
    X(error_ez) X(error_ex) X(psi_factor) X(own_chi) X(own_gamma) X(own_delta1) X(duration) X(friction) X(radius)      \
        X(mass) X(modulus_factor) X(chi_low) X(chi_high) X(poisson_ratio) X(equilibrium_modulus) X(parallel_viscosity)
#define INTEGERS(X) X(of_contact) X(impacts) X(checks) X(terms) X(chi_cells) X(stick_cells) X(slip_cells)

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
    failed |= rst_put_integer(f, "schema", 1);
    failed |= rst_put_text(f, "units", units_of_attributes);
#define PUT(member) failed |= rst_put_number(f, #member, d->member);
    NUMBERS(PUT)
#undef PUT
#define PUT(member) failed |= rst_put_integer(f, #member, d->member);
    INTEGERS(PUT)
#undef PUT
    failed |= rst_put_integer(f, "parts_first", d->parts[0]);
    failed |= rst_put_integer(f, "parts_gamma", d->parts[1]);
    for (int i = 0; i < n_pairs; i++)
        failed |= rst_put_number(f, pairs[i].name, *(const double *)((const char *)d + pairs[i].offset));
    return failed;
}

static int put_axes(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    static const char *const names[] = {NULL, "gamma", "chi", "psi"};
    static const char *const texts[] = {"nodes of the first axis", "nodes of gamma (23)", "nodes of chi (22)",
                                        "nodes of psi (22) up to 1, then 1 + y, y = (psi - 1)/(psi_c - 1)"};
    int failed = 0;
    for (int axis = 0; axis < 4 && !failed; axis++) {
        double *place = malloc((size_t)d->nodes[axis] * sizeof *place);
        if (!place) return 1;
        const char *name = axis ? names[axis] : d->of_contact ? "speed" : "delta1";
        failed =
            restitute_table_nodes(table, axis, place) ||
            rst_put_numbers(f, name, 1, &d->nodes[axis], place, axis == 0 && d->of_contact ? "m/s" : "1", texts[axis]);
        free(place);
    }
    return failed;
}

static int put_table(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    const int64_t size[4] = {d->nodes[0], d->nodes[1], d->nodes[3], d->nodes[2]};
    int failed = put_attributes(f, d) || put_axes(f, table, d);
    failed = failed || rst_put_numbers(f, "ez", 2, size, d->ez, "1", "ez at [speed or delta1][gamma]");
    failed = failed || rst_put_numbers(f, "ex", 4, size, d->ex, "1",
                                       "at [speed or delta1][gamma][psi][chi]: ex for psi <= 1, then "
                                       "ex - (2 chi (1 + ez)/psi - 1); from psi_c on that closed form alone");
    if (failed || d->terms == 0) return failed;
    return rst_put_numbers(f, "relaxation_time", 1, &d->terms, d->relaxation_time, "s",
                           "of the material's Prony series") ||
           rst_put_numbers(f, "modulus", 1, &d->terms, d->modulus, "Pa", "of the material's Prony series");
}

static int write_table(const restitute_table *table, const restitute_table_data *d, const char *path,
                       restitute_error *error)
{
    struct rst_new_file file;
    const int status = rst_new_file_begin(path, &file, error);
    if (status) return status;
    return rst_new_file_end(&file, !put_table(file.file, table, d), title, path, error);
}

int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error)
{
    restitute_table_data data;
    if (!table || !path) return rst_file_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "path" : "table");
    restitute_table_data_init(&data);
    int status = restitute_table_to_data(table, &data, error);
    if (status) return status;
    const struct rst_quiet quiet = rst_quiet_begin();
    status = write_table(table, &data, path, error);
    rst_quiet_end(quiet);
    return status ? status : rst_file_done(error);
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
#undef GET
    failed |= rst_get_integer(f, "parts_first", &d->parts[0]);
    failed |= rst_get_integer(f, "parts_gamma", &d->parts[1]);
    for (int i = 0; i < n_pairs; i++)
        failed |= rst_get_number(f, pairs[i].name, (double *)((char *)d + pairs[i].offset));
    return failed;
}

/* All datasets in one block; their sizes are those that the file says. */
struct arrays {
    int64_t count[4];
    double *start[4];
};

static const char *const set_names[4] = {"ez", "ex", "relaxation_time", "modulus"};

static int get_arrays(hid_t f, const restitute_table_data *d, struct arrays *a)
{
    int64_t total = 0;
    for (int i = 0; i < 4; i++) {
        a->count[i] = i >= 2 && d->terms == 0 ? 0 : rst_count_numbers(f, set_names[i]);
        if (a->count[i] < 0) return 1;
        total += a->count[i];
    }
    if (d->terms > 0 && (a->count[2] != d->terms || a->count[3] != d->terms)) return 1;
    a->start[0] = malloc((size_t)(total + 1) * sizeof(double));
    if (!a->start[0]) return 1;
    int failed = 0;
    for (int i = 0; i < 4; i++) {
        if (i > 0) a->start[i] = a->start[i - 1] + a->count[i - 1];
        if (a->count[i] > 0) failed |= rst_get_numbers(f, set_names[i], a->count[i], a->start[i]);
    }
    return failed;
}

/* The sizes that follow from the axes must be those of the arrays, before the arrays are believed. */
static int sizes_agree(const restitute_table_data *d, const struct arrays *a)
{
    int64_t nodes[4];
    if (restitute_table_data_nodes(d, nodes, NULL)) return 0;
    return a->count[0] == nodes[0] * nodes[1] && a->count[1] == a->count[0] * nodes[2] * nodes[3];
}

static int read_table(const char *path, hid_t f, restitute_table **table, restitute_error *error)
{
    restitute_table_data d;
    struct arrays a = {{0}, {NULL}};
    int status = RESTITUTE_ERROR_FORMAT;
    restitute_error why = {.message = "parts are missing"};
    restitute_table_data_init(&d);
    if (!get_attributes(f, &d) && d.terms >= 0 && !get_arrays(f, &d, &a)) {
        d.ez = a.start[0];
        d.ex = a.start[1];
        d.relaxation_time = a.start[2];
        d.modulus = a.start[3];
        if (sizes_agree(&d, &a)) status = restitute_table_from_data(&d, table, &why);
    }
    free(a.start[0]);
    if (status == RESTITUTE_ERROR_MEMORY) return rst_file_report(error, status, "%.120s: out of memory", path);
    if (status)
        return rst_file_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: holds no table: %.100s", path, why.message);
    return RESTITUTE_OK;
}

int restitute_table_read(const char *path, restitute_table **table, restitute_error *error)
{
    struct rst_old_file file;
    if (!path || !table) return rst_file_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", path ? "table" : "path");
    const struct rst_quiet quiet = rst_quiet_begin();
    int status = rst_old_file_open(path, title, &file, error);
    if (!status) {
        status = read_table(path, file.file, table, error);
        rst_old_file_close(&file);
    }
    rst_quiet_end(quiet);
    return status ? status : rst_file_done(error);
}
