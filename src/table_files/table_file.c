/* A table in a file: schema 7 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "table/table_data.h"
#include "table_files/container.h"

static const char title[] = "table";

/* Members that are fields of the set `numbers`, in this order, before the version; 8 bytes each. */
#define MEMBERS(X)                                                                                                     \
    X(low), X(high), X(tolerance), X(error_ez), X(error_ex), X(chi), X(gamma), X(delta1), X(psi_factor), X(duration),  \
        X(friction), X(radius), X(mass), X(poisson_ratio), X(equilibrium_modulus), X(parallel_viscosity),              \
        X(speed_limit), X(radius_limit), X(displacement_limit), X(impacts), X(checks), X(terms), X(speeds),            \
        X(stick_cells), X(slip_cells)
#define NAME(member) #member
#define AT(member) offsetof(struct rst_table_data, member)
#define IS_INTEGER(member) _Generic(((struct rst_table_data *)0)->member, int64_t : 1, double : 0)
static const char *const field_name[] = {MEMBERS(NAME)};
static const size_t field_at[] = {MEMBERS(AT)};
static const int is_integer[] = {MEMBERS(IS_INTEGER)};
enum { fields = sizeof field_at / sizeof *field_at };
enum { version_size = sizeof((struct rst_table_data *)0)->version, numbers_size = 8 * fields + version_size };

static const char units_of_numbers[] =
    "low, high m/s; duration s (of the contact at 1 m/s); radius m; mass kg; equilibrium_modulus Pa; "
    "parallel_viscosity Pa s; psi_factor: psi v_n/|v_t|; delta1 at 1 m/s; all others dimensionless";

/* The arrays: what they are, and how many values they have. */
enum { SET_SPEED, SET_EZ, SET_STRAIN, SET_EX, SET_TIMES, SET_MODULI, SETS, SET_NUMBERS = SETS };
_Static_assert(SETS + 1 == rst_sets, "the arrays and the numbers have their places in the block");
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

static void put_little(uint64_t value, unsigned char *bytes)
{
    for (int i = 0; i < 8; i++)
        bytes[i] = (unsigned char)(value >> 8 * i);
}

static void pack_numbers(const struct rst_table_data *d, unsigned char *bytes)
{
    for (int i = 0; i < fields; i++) {
        uint64_t bits;
        memcpy(&bits, (const char *)d + field_at[i], 8);
        put_little(bits, bytes + 8 * i);
    }
    memcpy(bytes + 8 * fields, d->version, version_size);
}

/* The type of the set; negative if HDF5 fails. */
static hid_t type_of_numbers(void)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, numbers_size), text = H5Tcopy(H5T_C_S1);
    int good = type >= 0 && text >= 0 && H5Tset_size(text, version_size) >= 0;
    for (int i = 0; i < fields && good; i++)
        good = H5Tinsert(type, field_name[i], 8 * (size_t)i, is_integer[i] ? H5T_STD_I64LE : H5T_IEEE_F64LE) >= 0;
    good = good && H5Tinsert(type, "restitute_version", 8 * fields, text) >= 0;
    if (text >= 0) H5Tclose(text);
    if (good) return type;
    if (type >= 0) H5Tclose(type);
    return -1;
}

static int put_numbers(hid_t f, const struct rst_table_data *d, uint64_t *place)
{
    unsigned char bytes[numbers_size];
    const hid_t type = type_of_numbers();
    if (type < 0) return -1;
    pack_numbers(d, bytes);
    const int failed =
        rst_put_compound(f, "numbers", type, bytes, units_of_numbers, "of the table and its contact", place);
    H5Tclose(type);
    return failed;
}

static int put_table(hid_t f, const struct rst_table_data *d, uint64_t place[rst_sets])
{
    struct rst_table_data copy = *d;
    struct set set[SETS];
    int failed = put_numbers(f, d, &place[SET_NUMBERS]);
    list_sets(&copy, set);
    for (int i = 0; i < SETS && !failed; i++)
        if (count_of(&set[i]) > 0)
            failed = rst_put_values(f, set[i].name, set[i].rank, set[i].size, *set[i].value, set[i].units,
                                    set[i].description, &place[i]);
    return failed;
}

int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error)
{
    if (!table || !path) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "path" : "table");
    int status;
    uint64_t place[rst_sets] = {0};
    H5E_BEGIN_TRY
    { /* HDF5 does not print errors */
        const hid_t file = rst_container_begin();
        const int good = file >= 0 && !put_table(file, restitute_private_table_data(table), place);
        status = rst_container_end(file, good ? place : NULL, title, path, error);
    }
    H5E_END_TRY
    return status ? status : rst_done(error);
}

/* ---- reading, from the bytes of the file */

static uint64_t little(const unsigned char *bytes)
{
    uint64_t value = 0;
    for (int i = 7; i >= 0; i--)
        value = value << 8 | bytes[i];
    return value;
}

/* Where a set is, of that many bytes; NULL: it would not be in the file. */
static const unsigned char *find(const struct rst_old_file *file, int set, uint64_t size)
{
    const uint64_t place = file->place[set];
    return place <= file->size && size <= file->size - place ? file->bytes + place : NULL;
}

static int get_numbers(const struct rst_old_file *file, struct rst_table_data *d)
{
    const unsigned char *bytes = find(file, SET_NUMBERS, numbers_size);
    if (!bytes) return 1;
    for (int i = 0; i < fields; i++) {
        const uint64_t bits = little(bytes + 8 * i);
        memcpy((char *)d + field_at[i], &bits, 8);
    }
    memcpy(d->version, bytes + 8 * fields, version_size);
    d->version[version_size - 1] = '\0';
    /* sizes that multiply without overflow; what a table may have is asked later */
    const int64_t most = 1 << 20;
    return d->speeds < 0 || d->speeds > most || d->stick_cells < 0 || d->stick_cells > most || d->slip_cells < 0 ||
           d->slip_cells > most || d->terms < 0 || d->terms > most;
}

/* Room is made for what the file holds. */
static int get_set(const struct rst_old_file *file, int i, struct set *set, restitute_error *why)
{
    const int64_t count = count_of(set);
    if (count == 0) return 0;
    const unsigned char *bytes = find(file, i, 8 * (uint64_t)count);
    if (!bytes) return 1;
    *set->value = malloc((size_t)count * sizeof **set->value);
    if (!*set->value) why->status = RESTITUTE_ERROR_MEMORY;
    for (int64_t k = 0; k < count && *set->value; k++) {
        const uint64_t bits = little(bytes + 8 * k);
        memcpy(&(*set->value)[k], &bits, 8);
    }
    return !*set->value;
}

static int read_table(const char *path, const struct rst_old_file *file, restitute_table **table,
                      restitute_error *error)
{
    struct rst_table_data d = {0};
    struct set set[SETS];
    restitute_error why = {.status = RESTITUTE_ERROR_FORMAT, .message = "parts are missing"};
    int failed = get_numbers(file, &d);
    if (failed) d = (struct rst_table_data){0}; /* list_sets adds and multiplies the counts */
    list_sets(&d, set);
    for (int i = 0; i < SETS && !failed; i++)
        failed = get_set(file, i, &set[i], &why);
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
    int status = rst_old_file_open(path, title, &file, error);
    if (status) return status;
    status = read_table(path, &file, table, error);
    rst_old_file_close(&file);
    return status ? status : rst_done(error);
}
