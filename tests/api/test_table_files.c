/* Table files: what was written is read with the same bits; damaged, cut, foreign and later ones
 * are refused, and silently.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <hdf5.h>

#include <restitute/table_files.h>

#include "../support/bytes.h"
#include "../support/checksum.h"
#include "../support/odd_files.h"
#include "../support/random.h"
#include "../support/table.h"

static const char path[] = "test_table_files.h5", broken[] = "test_table_files_broken.h5";
static restitute_material *material;
static restitute_scene scene;
static restitute_table *table;
static unsigned char *bytes;
static size_t size;

static int set_up(void **state)
{
    (void)state;
    scene = ball_on(0.3, &material);
    table = table_of(&scene, 0.1, 1, 1e-2);
    restitute_error error;
    CHECK(restitute_table_write(table, path, &error) == RESTITUTE_OK, "%s", error.message);
    bytes = malloc(1 << 24);
    size = read_bytes(path, bytes, 1 << 24);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    free(bytes);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    unlink(path);
    unlink(broken);
    return 0;
}

static int alike(const restitute_table *a, const restitute_table *b)
{
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            const double v = 0.05 * pow(30, i / 40.0), u = 0.05 * j * v;
            const struct pair p = look_up(a, v, u), q = look_up(b, v, u);
            if (p.ez != q.ez || p.ex != q.ex) return 0;
        }
    return 1;
}

static void what_is_written_is_read(void **state)
{
    restitute_table *read = NULL;
    restitute_error error;
    restitute_table_info one, other;
    (void)state;
    CHECK(restitute_table_read(path, &read, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(alike(table, read), "the table that was read");
    restitute_table_info_init(&one);
    restitute_table_info_init(&other);
    restitute_table_describe(table, &one, NULL);
    restitute_table_describe(read, &other, NULL);
    CHECK(memcmp(&one, &other, sizeof one) == 0, "what the table says of itself");
    restitute_table_contact contact;
    restitute_table_contact_init(&contact);
    CHECK(restitute_table_contact_set(read, &scene, &contact, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(contact.speed_factor == 1, "%.17g: the material is known again", contact.speed_factor);
    CHECK(restitute_table_write(read, broken, &error) == RESTITUTE_OK, "%s", error.message);
    unsigned char *again = malloc(size + 1);
    CHECK(read_bytes(broken, again, size + 1) == size && memcmp(again, bytes, size) == 0,
          "the same table, the same bytes");
    free(again);
    restitute_table_destroy(read);
}

/* An error, or the same table. */
static void check_broken(size_t place, const char *how)
{
    restitute_table *read = NULL;
    restitute_error error;
    const int status = restitute_table_read(broken, &read, &error);
    if (status >= 0) {
        CHECK(alike(table, read), "byte %zu %s: another table", place, how);
        restitute_table_destroy(read);
        return;
    }
    CHECK(status == RESTITUTE_ERROR_FORMAT && !read && strlen(error.message) > 10, "byte %zu %s: status %d, %s", place,
          how, status, error.message);
}

/* Every byte of the block of text and of the first structures, then every 37th, in all bits in
 * turn. */
static void flips_are_refused(void **state)
{
    int refused = 0, tried = 0;
    (void)state;
    unsigned char *copy = malloc(size);
    memcpy(copy, bytes, size);
    for (size_t i = 0; i < size; i += i < 1500 ? 1 : 37) {
        copy[i] ^= (unsigned char)(1u << (i % 8));
        write_bytes(broken, copy, size);
        check_broken(i, "flipped");
        restitute_table *read = NULL;
        refused += restitute_table_read(broken, &read, NULL) < 0;
        restitute_table_destroy(read);
        tried++;
        copy[i] = bytes[i];
    }
    CHECK(refused == tried, "%d of %d flips refused", refused, tried);
    free(copy);
}

static void cuts_are_refused(void **state)
{
    (void)state;
    for (size_t length = 0; length < size; length += length < 1500 ? 7 : 1009) {
        restitute_table *read = NULL;
        write_bytes(broken, bytes, length);
        check_broken(length, "cut");
        assert_true(restitute_table_read(broken, &read, NULL) < 0);
    }
    unsigned char *longer = malloc(size + 1);
    restitute_table *read = NULL;
    memcpy(longer, bytes, size);
    longer[size] = 0;
    write_bytes(broken, longer, size + 1);
    assert_int_equal(restitute_table_read(broken, &read, NULL), RESTITUTE_ERROR_FORMAT);
    free(longer);
}

static void refused(const char *text, int status)
{
    restitute_table *read = NULL;
    restitute_error error;
    assert_int_equal(restitute_table_read(broken, &read, &error), status);
    CHECK(strstr(error.message, text), "\"%s\" does not say \"%s\"", error.message, text);
}

static void endless_files_are_refused(void **state)
{
    (void)state;
    restitute_table *read = NULL;
    restitute_error error;
    const char fifo[] = "test_table_files_fifo.h5";
    make_fifo(fifo);
    assert_int_equal(restitute_table_read(fifo, &read, &error), RESTITUTE_ERROR_FILE);
    CHECK(strstr(error.message, "fifo.h5: is not a regular file"), "%s", error.message);
    unlink(fifo);
    assert_int_equal(restitute_table_read("/dev/zero", &read, &error), RESTITUTE_ERROR_FILE);
    CHECK(strstr(error.message, "/dev/zero: is not a regular file"), "%s", error.message);
    if (sizeof(off_t) > 4 && make_sparse(broken, (off_t)4294967297))
        refused("has 4294967297 bytes: must be at most 4294967296", RESTITUTE_ERROR_FILE);
    unlink(broken);
}

static void foreign_and_later_files_are_refused(void **state)
{
    (void)state;
    write_bytes(broken, "tau_s,G_Pa\n1,2\n", 15);
    refused("is not a table file", RESTITUTE_ERROR_FORMAT);
    write_bytes(broken, bytes + 512, size - 512); /* plain HDF5 */
    refused("is not a table file", RESTITUTE_ERROR_FORMAT);
    unsigned char *later = malloc(size);
    memcpy(later, bytes, size);
    char *schema = strstr((char *)later, "schema 8");
    assert_non_null(schema);
    schema[7] = '9';
    write_bytes(broken, later, size);
    refused("schema 9: this library reads schema 8", RESTITUTE_ERROR_FORMAT);
    schema[7] = '7';
    write_bytes(broken, later, size);
    refused("schema 7, of an earlier library; this one reads schema 8: build the table again", RESTITUTE_ERROR_FORMAT);
    free(later);
    restitute_table *read = NULL;
    unlink(broken);
    refused("cannot be read", RESTITUTE_ERROR_FILE);
    assert_int_equal(restitute_table_read(".", &read, NULL), RESTITUTE_ERROR_FILE);
    assert_int_equal(restitute_table_read(NULL, &read, NULL), RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_table_write(table, "no/such/folder/t.h5", NULL), RESTITUTE_ERROR_FILE);
}

static void put_with_checksum(unsigned char *content, size_t length)
{
    set_checksum(content, length);
    write_bytes(broken, content, length);
}

/* The place and the bytes of a set, as the file states them; `member`: of the set `numbers`. */
static size_t place_of(const char *set, const char *member, size_t *length)
{
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT), data = H5Dopen2(file, set, H5P_DEFAULT);
    const hid_t type = H5Dget_type(data);
    size_t place = (size_t)H5Dget_offset(data);
    *length = (size_t)H5Dget_storage_size(data);
    if (member) {
        place += H5Tget_member_offset(type, (unsigned)H5Tget_member_index(type, member));
        *length = 8;
    }
    assert_true(H5Tclose(type) >= 0 && H5Dclose(data) >= 0 && H5Fclose(file) >= 0);
    return place;
}

/* HDF5 reads beyond its buffers in damaged files, so it does not read them: the table is read for
 * any bytes beside the values. */
static void hdf5_reads_nothing_of_a_file(void **state)
{
    static const char *const sets[] = {"numbers", "speed", "ez", "strain", "ex", "relaxation_time", "modulus"};
    unsigned char *damaged = malloc(size);
    (void)state;
    memset(damaged, 0xff, size);
    memcpy(damaged, bytes, 512);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        size_t length;
        const size_t place = place_of(sets[i], NULL, &length);
        memcpy(damaged + place, bytes + place, length);
    }
    put_with_checksum(damaged, size);
    free(damaged);
    restitute_table *read = NULL;
    restitute_error error;
    CHECK(restitute_table_read(broken, &read, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(alike(table, read), "another table");
    restitute_table_destroy(read);
}

/* Places in the block that are not in the file, or are no places. */
static void places_beyond_the_file_are_refused(void **state)
{
    char after[512];
    unsigned char *damaged = malloc(size);
    (void)state;
    for (int i = 0; i < 4; i++) {
        static const char *const places[] = {"18446744073709551615", "14000000000000000000000", "-1", ""};
        memcpy(damaged, bytes, size);
        char *place = strstr((char *)damaged, "values at ");
        assert_non_null(place);
        place += strlen("values at ");
        strcpy(after, strchr(place, ' '));
        strcpy(place, places[i]);
        strcat(place, after);
        memset(place + strlen(place), 0, (size_t)((char *)damaged + 512 - place - strlen(place)));
        put_with_checksum(damaged, size);
        refused(i == 0 ? "parts are missing" : "checksum is wrong", RESTITUTE_ERROR_FORMAT);
    }
    free(damaged);
}

/* Numbers that no table has, and counts of more values than there are, behind a right checksum. */
static void odd_numbers_are_refused(void **state)
{
    const double wild = -1;
    const int64_t none = 0, many = 1 << 20, more = INT64_C(1) << 61, most = INT64_MAX;
    const struct {
        const char *member;
        const void *value;
    } odd[] = {{"chi", &wild},         {"stick_cells", &none}, {"speeds", &none},
               {"speeds", &many},      {"speeds", &more},      {"terms", &many},
               {"stick_cells", &more}, {"slip_cells", &many},  {"stick_cells", &most}};
    unsigned char *damaged = malloc(size);
    (void)state;
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        size_t length;
        memcpy(damaged, bytes, size);
        memcpy(damaged + place_of("numbers", odd[i].member, &length), odd[i].value, 8);
        put_with_checksum(damaged, size);
        refused("holds no table", RESTITUTE_ERROR_FORMAT);
    }
    free(damaged);
}

/* What looks up in a table of any numbers: it is refused, or answers in the range of a pair. */
static void damage_behind_a_right_checksum_is_bounded(void **state)
{
    uint64_t random = 11;
    unsigned char *damaged = malloc(size);
    int accepted = 0;
    (void)state;
    for (int n = 0; n < 500; n++) {
        restitute_table *read = NULL;
        memcpy(damaged, bytes, size);
        for (int k = random_below(&random, 4); k >= 0; k--)
            damaged[512 + random_below(&random, (int)size - 512)] ^= (unsigned char)(1 << random_below(&random, 8));
        put_with_checksum(damaged, size);
        if (restitute_table_read(broken, &read, NULL) < 0) continue;
        accepted++;
        for (double v = 0.05; v < 2; v *= 1.5) {
            const struct pair p = look_up(read, v, 0.7 * v);
            CHECK(p.ez >= 0 && p.ez <= 1 && p.ex >= -1 && p.ex <= 1, "case %d: %g, %g", n, p.ez, p.ex);
        }
        restitute_table_info info;
        restitute_table_contact contact;
        restitute_table_info_init(&info);
        restitute_table_contact_init(&contact);
        restitute_table_describe(read, &info, NULL);
        restitute_table_contact_set(read, &scene, &contact, NULL);
        restitute_table_destroy(read);
    }
    CHECK(accepted > 50 && accepted < 500, "%d of 500 were accepted", accepted);
    free(damaged);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_written_is_read),
                                       cmocka_unit_test(flips_are_refused),
                                       cmocka_unit_test(cuts_are_refused),
                                       cmocka_unit_test(endless_files_are_refused),
                                       cmocka_unit_test(foreign_and_later_files_are_refused),
                                       cmocka_unit_test(hdf5_reads_nothing_of_a_file),
                                       cmocka_unit_test(places_beyond_the_file_are_refused),
                                       cmocka_unit_test(odd_numbers_are_refused),
                                       cmocka_unit_test(damage_behind_a_right_checksum_is_bounded)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
