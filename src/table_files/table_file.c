/* A table in a file: schema 6 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../table/table_data.h"
#include "container.h"

static const char title[] = "table";

/* Members that are attributes of the root. */
#define NUMBERS(X)                                                                                                     \
    X(low) X(high) X(tolerance) X(error_ez) X(error_ex) X(chi) X(gamma) X(delta1) X(psi_factor) X(duration)            \
    X(friction) X(radius) X(mass) X(poisson_ratio) X(equilibrium_modulus) X(parallel_viscosity) X(speed_limit)         \
    X(radius_limit) X(displacement_limit)
#define INTEGERS(X) X(impacts) X(checks) X(terms) X(speeds) X(stick_cells) X(slip_cells)

static const char units_of_attributes[] =
    "low, high m/s; duration s (of the contact at 1 m/s); radius m; mass kg; equilibrium_modulus Pa; "
    "parallel_viscosity Pa s; psi_factor: psi v_n/|v_t|; delta1 at 1 m/s; all others dimensionless";

/* The arrays: what they are, and how many values they have. */
enum { SET_SPEED, SET_EZ, SET_STRAIN, SET_EX, SET_TIMES, SET_MODULI, SETS };
struct set {
    const char *name, *units, *description;
    int rank;
    int64_t size[3];
    double **value;
};

static void list_sets(struct rst_table_data *d, struct set set[SETS])
{
    const struct set all[SETS] = {
        {"speed", "m/s", "normal speeds of the nodes; two that are equal are a seam", 1, {d->speeds}, &d->speed},
        {"ez", "1", "ez and d ez/ds, s(v) almost log2(v), see read_table.py", 2, {d->speeds, 2}, &d->ez},
        {"strain", "1", "v/c_s, a_max/R, d_max/a_max", 2, {d->speeds, 3}, &d->strain},
        {"ex",
         "1",
         "g, dg/ds, dg/dp, d2g/ds dp at psi = p/stick_cells, then at y(t), t = p/slip_cells; g = ex for psi <= 1, "
         "beyond it psi ex - y ez",
         3,
         {d->speeds, rst_places(d), 4},
         &d->ex},
        {"relaxation_time", "s", "of the material's Prony series", 1, {d->terms}, &d->relaxation_time},
        {"modulus", "Pa", "of the material's Prony series", 1, {d->terms}, &d->modulus}};
    memcpy(set, all, sizeof all);
}

static int64_t count_of(const struct set *s)
{
    int64_t count = 1;
    for (int i = 0; i < s->rank; i++)
        count *= s->size[i];
    return count;
}

/* ---- writing */

static int put_table(hid_t f, const struct rst_table_data *d)
{
    struct rst_table_data copy = *d;
    struct set set[SETS];
    int failed = rst_put_text(f, "restitute_version", d->version) || rst_put_text(f, "units", units_of_attributes);
#define PUT(member) failed = failed || rst_put_number(f, #member, d->member);
    NUMBERS(PUT)
#undef PUT
#define PUT(member) failed = failed || rst_put_integer(f, #member, d->member);
    INTEGERS(PUT)
#undef PUT
    list_sets(&copy, set);
    for (int i = 0; i < SETS && !failed; i++)
        if (count_of(&set[i]) > 0)
            failed = rst_put_values(f, set[i].name, set[i].rank, set[i].size, *set[i].value, set[i].units,
                                    set[i].description);
    return failed;
}

int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error)
{
    if (!table || !path) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "path" : "table");
    int status;
    H5E_BEGIN_TRY { /* HDF5 does not print errors */
        const hid_t file = rst_container_begin();
        const int good = file >= 0 && !put_table(file, restitute_private_table_data(table));
        status = rst_container_end(file, good, title, path, error);
    }
    H5E_END_TRY
    return status ? status : rst_done(error);
}

/* ---- reading */

static int get_attributes(hid_t f, struct rst_table_data *d)
{
    int failed = rst_get_text(f, "restitute_version", sizeof d->version, d->version);
#define GET(member) failed |= rst_get_number(f, #member, &d->member);
    NUMBERS(GET)
#undef GET
#define GET(member) failed |= rst_get_integer(f, #member, &d->member);
    INTEGERS(GET)
#undef GET
    /* sizes that multiply without overflow; what a table may have is asked later */
    const int64_t most = 1 << 20;
    return failed || d->speeds < 0 || d->speeds > most || d->stick_cells < 0 || d->stick_cells > most ||
           d->slip_cells < 0 || d->slip_cells > most || d->terms < 0;
}

/* A count is compared with that of the file before room is made. */
static int get_set(hid_t f, struct set *set, restitute_error *why)
{
    const int64_t count = count_of(set);
    if (count == 0) return 0;
    if (rst_count_values(f, set->name) != count) return 1;
    *set->value = malloc((size_t)count * sizeof **set->value);
    if (!*set->value) why->status = RESTITUTE_ERROR_MEMORY;
    return !*set->value || rst_get_values(f, set->name, count, *set->value);
}

static int read_table(const char *path, hid_t file, restitute_table **table, restitute_error *error)
{
    struct rst_table_data d = {0};
    struct set set[SETS];
    restitute_error why = {.status = RESTITUTE_ERROR_FORMAT, .message = "parts are missing"};
    int failed = get_attributes(file, &d);
    list_sets(&d, set);
    for (int i = 0; i < SETS && !failed; i++)
        failed = get_set(file, &set[i], &why);
    const int status = failed ? why.status : restitute_private_table_make(&d, table, &why);
    for (int i = 0; i < SETS; i++)
        free(*set[i].value);
    if (status == RESTITUTE_ERROR_MEMORY) return rst_report(error, status, "%.120s: out of memory", path);
    if (status) return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: holds no table: %.100s", path, why.message);
    return RESTITUTE_OK;
}

int restitute_table_read(const char *path, restitute_table **table, restitute_error *error)
{
    struct rst_old_file file;
    if (!path || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", path ? "table" : "path");
    int status;
    H5E_BEGIN_TRY {
        status = rst_old_file_open(path, title, &file, error);
        if (!status) {
            status = read_table(path, file.file, table, error);
            rst_old_file_close(&file);
        }
    }
    H5E_END_TRY
    return status ? status : rst_done(error);
}
