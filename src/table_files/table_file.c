/* A table in a file: schema 1 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "container.h"

static const char title[] = "table";

/* Members that are attributes of the root. */
#define NUMBERS(X)                                                                                                     \
    X(tolerance)                                                                                                       \
    X(error_ez)                                                                                                        \
    X(error_ex)                                                                                                        \
    X(psi_factor) X(own_chi) X(own_gamma) X(own_delta1) X(duration) X(friction) X(radius) X(mass) X(modulus_factor)    \
        X(chi_low) X(chi_high) X(poisson_ratio) X(equilibrium_modulus) X(parallel_viscosity)
#define INTEGERS(X) X(of_contact) X(impacts) X(checks) X(terms) X(chi_cells) X(stick_cells) X(slip_cells) X(cells)

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
        const int by_cells = axis < 2 && d->cells > 0; /* [cell][16] */
        const int64_t size[2] = {d->nodes[by_cells ? 0 : axis], by_cells ? d->nodes[1] : 1};
        double *place = malloc((size_t)(size[0] * size[1]) * sizeof *place);
        if (!place) return 1;
        const char *name = axis ? names[axis] : d->of_contact ? "speed" : "delta1";
        failed =
            restitute_table_nodes(table, axis, place) ||
            rst_put_numbers(f, name, 1 + by_cells, size, place, axis == 0 && d->of_contact ? "m/s" : "1", texts[axis]);
        free(place);
    }
    return failed;
}

static const char text_of_ex[] =
    "ex for psi <= 1, then ex - (2 chi (1 + ez)/psi - 1); from psi_c on that closed form alone";

/* A table with cells: numbers of the patches as numbers, ex in single precision as in the table itself. */
static int put_cells(hid_t f, const restitute_table_data *d)
{
    const int64_t octaves[3] = {(int64_t)round(log2(d->high[0] / d->low[0])),
                                (int64_t)round(log2(d->high[1] / d->low[1])), 3};
    const int64_t size[2] = {d->cells, d->nodes[1]}, size_ex[4] = {d->cells, d->nodes[3], d->nodes[2], d->nodes[1]};
    const int64_t count = octaves[0] * octaves[1] * octaves[2];
    double *number = malloc((size_t)count * sizeof *number);
    if (!number) return 1;
    for (int64_t i = 0; i < count; i++)
        number[i] = (double)d->patches[i];
    const int failed = rst_put_numbers(f, "patches", 3, octaves, number, "1",
                                       "[octave of delta1][octave of gamma]: first cell, k, l: 2^k by 2^l cells") ||
                       rst_put_numbers(f, "ez", 2, size, d->ez, "1", "ez at [cell][node]") ||
                       rst_put_singles(f, "ex", 4, size_ex, d->ex_cells, "1", text_of_ex);
    free(number);
    return failed;
}

static int put_dense(hid_t f, const restitute_table_data *d)
{
    const int64_t size[4] = {d->nodes[0], d->nodes[1], d->nodes[3], d->nodes[2]};
    return rst_put_numbers(f, "ez", 2, size, d->ez, "1", "ez at [speed or delta1][gamma]") ||
           rst_put_numbers(f, "ex", 4, size, d->ex, "1", text_of_ex);
}

static int put_table(hid_t f, const restitute_table *table, const restitute_table_data *d)
{
    const int failed = put_attributes(f, d) || put_axes(f, table, d) || (d->cells > 0 ? put_cells : put_dense)(f, d);
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
#undef GET
    failed |= rst_get_integer(f, "parts_first", &d->parts[0]);
    failed |= rst_get_integer(f, "parts_gamma", &d->parts[1]);
    for (int i = 0; i < n_pairs; i++)
        failed |= rst_get_number(f, pairs[i].name, (double *)((char *)d + pairs[i].offset));
    return failed;
}

/* All datasets in one block; their sizes are those that the file says. */
enum { SET_EZ, SET_EX, SET_TIMES, SET_MODULI, SET_PATCHES, SETS };
struct arrays {
    int64_t count[SETS];
    double *start[SETS];
    float *ex_cells;
    int64_t *patches;
};

static const char *const set_names[SETS] = {"ez", "ex", "relaxation_time", "modulus", "patches"};

static int count_arrays(hid_t f, const restitute_table_data *d, struct arrays *a)
{
    for (int i = 0; i < SETS; i++) {
        const int absent = (i == SET_TIMES || i == SET_MODULI) ? d->terms == 0 : i == SET_PATCHES && d->cells == 0;
        a->count[i] = absent ? 0 : rst_count_numbers(f, set_names[i]);
        if (a->count[i] < 0) return 1;
    }
    return d->terms > 0 && (a->count[SET_TIMES] != d->terms || a->count[SET_MODULI] != d->terms);
}

static int get_arrays(hid_t f, struct arrays *a)
{
    int64_t total = 0; /* of few counts, each bounded by the bytes of the file */
    for (int i = 0; i < SETS; i++)
        total += a->count[i];
    a->start[0] = malloc((size_t)(total + 1) * sizeof(double));
    if (!a->start[0]) return 1;
    int failed = 0;
    for (int i = 0; i < SETS; i++) {
        if (i > 0) a->start[i] = a->start[i - 1] + a->count[i - 1];
        if (a->count[i] > 0) failed |= rst_get_numbers(f, set_names[i], a->count[i], a->start[i]);
    }
    return failed;
}

/* The sizes that follow from the axes must be those of the arrays, before room is made for the arrays. */
static int sizes_agree(const restitute_table_data *d, const struct arrays *a)
{
    int64_t nodes[4];
    if (restitute_table_data_nodes(d, nodes, NULL)) return 0;
    if (d->cells > 0 &&
        (double)a->count[SET_PATCHES] != 3 * round(log2(d->high[0] / d->low[0])) * round(log2(d->high[1] / d->low[1])))
        return 0;
    return a->count[SET_EZ] == nodes[0] * nodes[1] && a->count[SET_EX] == a->count[SET_EZ] * nodes[2] * nodes[3];
}

/* What is not kept in double precision. Nonzero: out of memory, or what is no whole number. */
static int convert_cells(struct arrays *a)
{
    a->ex_cells = malloc((size_t)a->count[SET_EX] * sizeof *a->ex_cells);
    a->patches = malloc((size_t)a->count[SET_PATCHES] * sizeof *a->patches);
    if (!a->ex_cells || !a->patches) return 1;
    for (int64_t i = 0; i < a->count[SET_EX]; i++)
        a->ex_cells[i] = (float)a->start[SET_EX][i];
    for (int64_t i = 0; i < a->count[SET_PATCHES]; i++) {
        if (!(fabs(a->start[SET_PATCHES][i]) < 1e15)) return 1;
        a->patches[i] = (int64_t)a->start[SET_PATCHES][i];
    }
    return 0;
}

static int read_table(const char *path, hid_t f, restitute_table **table, restitute_error *error)
{
    restitute_table_data d;
    struct arrays a = {.count = {0}};
    int status = RESTITUTE_ERROR_FORMAT;
    restitute_error why = {.message = "parts are missing"};
    restitute_table_data_init(&d);
    if (!get_attributes(f, &d) && d.terms >= 0 && !count_arrays(f, &d, &a) && sizes_agree(&d, &a) &&
        !get_arrays(f, &a) && (d.cells == 0 || !convert_cells(&a))) {
        d.ez = a.start[SET_EZ];
        d.ex = a.start[SET_EX];
        d.ex_cells = a.ex_cells;
        d.patches = a.patches;
        d.relaxation_time = a.start[SET_TIMES];
        d.modulus = a.start[SET_MODULI];
        status = restitute_table_from_data(&d, table, &why);
    }
    free(a.start[0]);
    free(a.ex_cells);
    free(a.patches);
    if (status == RESTITUTE_ERROR_MEMORY) return rst_report(error, status, "%.120s: out of memory", path);
    if (status) return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: holds no table: %.100s", path, why.message);
    return RESTITUTE_OK;
}

int restitute_table_read(const char *path, restitute_table **table, restitute_error *error)
{
    struct rst_old_file file;
    if (!path || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", path ? "table" : "path");
    const struct rst_quiet quiet = rst_quiet_begin();
    int status = rst_old_file_open(path, title, &file, error);
    if (!status) {
        status = read_table(path, file.file, table, error);
        rst_old_file_close(&file);
    }
    rst_quiet_end(quiet);
    return status ? status : rst_done(error);
}
