/* A table in a file: schema 8 of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "table_files/container.h"

static const char title[] = "table";

/* Members that are fields of the set `numbers`, in this order, before the version; 8 bytes each. */
#define MEMBERS(X)                                                                                                     \
    X(low), X(high), X(tolerance), X(error_ez), X(error_ex), X(chi), X(gamma), X(delta1), X(psi_factor), X(duration),  \
        X(friction), X(radius), X(mass), X(density), X(dundurs_beta), X(poisson_ratio), X(equilibrium_modulus),        \
        X(parallel_viscosity), X(shortest), X(longest), X(speed_limit), X(radius_limit), X(displacement_limit),        \
        X(dundurs_limit), X(impacts), X(checks), X(terms), X(speeds), X(stick_cells), X(slip_cells)
#define NAME(member) #member
#define AT(member) offsetof(restitute_table_data, member)
#define IS_INTEGER(member) _Generic(((restitute_table_data *)0)->member, int64_t : 1, double : 0)
static const char *const field_name[] = {MEMBERS(NAME)};
static const size_t field_at[] = {MEMBERS(AT)};
static const int is_integer[] = {MEMBERS(IS_INTEGER)};
enum { fields = sizeof field_at / sizeof *field_at };
enum { version_size = sizeof((restitute_table_data *)0)->version, numbers_size = 8 * fields + version_size };

static const char units_of_numbers[] =
    "low, high m/s; duration s (of the contact at 1 m/s); radius m; mass kg; density kg/m^3; "
    "equilibrium_modulus Pa; parallel_viscosity Pa s; shortest, longest s (the material's window); psi_factor: psi "
    "v_n/|v_t|; delta1 at 1 m/s; all others dimensionless";

/* The arrays: what they are, and how many values they have. */
enum { SET_SPEED, SET_EZ, SET_STRAIN, SET_EX, SET_TIMES, SET_MODULI, SETS, SET_NUMBERS = SETS };
_Static_assert(SETS + 1 == rst_sets, "the arrays and the numbers have their places in the block");
struct set {
    const char *name, *units, *description;
    int rank;
    int64_t size[3];
    const double **value;
};

static void list_sets(restitute_table_data *d, struct set set[SETS])
{
    const struct set all[SETS] = {
        {"speed", "m/s", "normal speeds of the nodes; two that are equal are a seam", 1, {d->speeds}, &d->speed},
        {"ez", "1", "ez and d ez/ds, s(v) almost log2(v), see read_table.py", 2, {d->speeds, 2}, &d->ez},
        {"strain", "1; s for the last", "v/c_s, a_max/R, d_max/a_max, contact time", 2, {d->speeds, 4}, &d->strain},
        {"ex",
         "1",
         "g, dg/ds, dg/dp, d2g/ds dp at psi = p/stick_cells, then at y(t), t = p/slip_cells; g = ex for psi <= 1, "
         "beyond it psi ex - y ez",
         3,
         {d->speeds, d->stick_cells + d->slip_cells + 2, 4},
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

static void pack_numbers(const restitute_table_data *d, unsigned char *bytes)
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

static int put_numbers(hid_t f, const restitute_table_data *d, uint64_t *place)
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

static int put_table(hid_t f, restitute_table_data *d, uint64_t place[rst_sets])
{
    struct set set[SETS];
    int failed = put_numbers(f, d, &place[SET_NUMBERS]);
    list_sets(d, set);
    for (int i = 0; i < SETS && !failed; i++)
        if (count_of(&set[i]) > 0)
            failed = rst_put_values(f, set[i].name, set[i].rank, set[i].size, *set[i].value, set[i].units,
                                    set[i].description, &place[i]);
    return failed;
}

int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error)
{
    if (!table || !path) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "path" : "table");
    restitute_table_data d;
    restitute_table_data_init(&d);
    int status = restitute_table_data_get(table, &d, error);
    if (status) return status;
    uint64_t place[rst_sets] = {0};
    H5E_BEGIN_TRY
    { /* HDF5 does not print errors */
        const hid_t file = rst_container_begin();
        const int good = file >= 0 && !put_table(file, &d, place);
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

static int get_numbers(const struct rst_old_file *file, restitute_table_data *d)
{
    const unsigned char *bytes = find(file, SET_NUMBERS, numbers_size);
    if (!bytes) return RESTITUTE_ERROR_FORMAT;
    for (int i = 0; i < fields; i++) {
        const uint64_t bits = little(bytes + 8 * i);
        memcpy((char *)d + field_at[i], &bits, 8);
    }
    memcpy(d->version, bytes + 8 * fields, version_size);
    d->version[version_size - 1] = '\0';
    /* sizes that multiply without overflow; what a table may have is asked later */
    const int64_t most = 1 << 20;
    const int64_t count[] = {d->speeds, d->stick_cells, d->slip_cells, d->terms};
    for (int i = 0; i < 4; i++)
        if (count[i] < 0 || count[i] > most) return RESTITUTE_ERROR_FORMAT;
    return RESTITUTE_OK;
}

/* Room is made for what the file holds; the arrays lie in it. */
static int get_sets(const struct rst_old_file *file, struct set set[SETS], double **room)
{
    const unsigned char *bytes[SETS];
    int64_t all = 0;
    for (int i = 0; i < SETS; i++) {
        bytes[i] = find(file, i, 8 * (uint64_t)count_of(&set[i]));
        if (!bytes[i]) return RESTITUTE_ERROR_FORMAT;
        all += count_of(&set[i]);
    }
    double *next = *room = malloc((size_t)all * sizeof **room + 1);
    if (!next) return RESTITUTE_ERROR_MEMORY;
    for (int i = 0; i < SETS; i++) {
        const int64_t count = count_of(&set[i]);
        *set[i].value = next;
        for (int64_t k = 0; k < count; k++, next++) {
            const uint64_t bits = little(bytes[i] + 8 * k);
            memcpy(next, &bits, 8);
        }
    }
    return RESTITUTE_OK;
}

static int read_table(const char *path, const struct rst_old_file *file, restitute_table **table,
                      restitute_error *error)
{
    restitute_table_data d;
    struct set set[SETS];
    double *room = NULL;
    restitute_error why = {.message = "parts are missing"};
    restitute_table_data_init(&d);
    int status = get_numbers(file, &d);
    if (!status) {
        list_sets(&d, set);
        status = get_sets(file, set, &room);
    }
    if (!status) status = restitute_table_create(&d, table, &why);
    free(room);
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
