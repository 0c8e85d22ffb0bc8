/* Table files: what was written is read with the same bits; damaged, cut, foreign and later ones are refused, and silently.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <hdf5.h>

#include <restitute/table_files.h>

#include "../support/checksum.h"
#include "../support/odd_files.h"
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
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    bytes = malloc(1 << 24);
    size = fread(bytes, 1, 1 << 24, file);
    fclose(file);
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

static void put(const unsigned char *content, size_t length)
{
    FILE *file = fopen(broken, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, length, file), length);
    fclose(file);
}

static int alike(const restitute_table *a, const restitute_table *b)
{
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            const double v = 0.05 * pow(30, i / 40.0), u = 0.05 * j * v;
            const restitute_table_value p = look_up(a, v, u), q = look_up(b, v, u);
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
    CHECK(restitute_table_contact_of(read, &scene, &contact, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(contact.speed_factor == 1, "%.17g: the material is known again", contact.speed_factor);
    CHECK(restitute_table_write(read, broken, &error) == RESTITUTE_OK, "%s", error.message);
    FILE *file = fopen(broken, "rb");
    unsigned char *again = malloc(size + 1);
    CHECK(fread(again, 1, size + 1, file) == size && memcmp(again, bytes, size) == 0, "the same table, the same bytes");
    fclose(file);
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

/* Every byte of the block of text and of the first structures, then every 37th, in all bits in turn. */
static void flips_are_refused(void **state)
{
    int refused = 0, tried = 0;
    (void)state;
    unsigned char *copy = malloc(size);
    memcpy(copy, bytes, size);
    for (size_t i = 0; i < size; i += i < 1500 ? 1 : 37) {
        copy[i] ^= (unsigned char)(1u << (i % 8));
        put(copy, size);
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
        put(bytes, length);
        check_broken(length, "cut");
        assert_true(restitute_table_read(broken, &read, NULL) < 0);
    }
    unsigned char *longer = malloc(size + 1);
    restitute_table *read = NULL;
    memcpy(longer, bytes, size);
    longer[size] = 0;
    put(longer, size + 1);
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
    put((const unsigned char *)"tau_s,G_Pa\n1,2\n", 15);
    refused("is not a table file", RESTITUTE_ERROR_FORMAT);
    put(bytes + 512, size - 512); /* plain HDF5 */
    refused("is not a table file", RESTITUTE_ERROR_FORMAT);
    unsigned char *later = malloc(size);
    memcpy(later, bytes, size);
    char *schema = strstr((char *)later, "schema 6");
    assert_non_null(schema);
    schema[7] = '7';
    put(later, size);
    refused("schema 7: this library reads schema 6", RESTITUTE_ERROR_FORMAT);
    schema[7] = '3';
    put(later, size);
    refused("schema 3, of tables that this library has no more; it reads schema 6: build the table again",
            RESTITUTE_ERROR_FORMAT);
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
    put(content, length);
}

/* Files whose checksum is right but whose sizes are not: 2^61 values, whose bytes overflow to none, and 2^40. */
static void sizes_beyond_the_file_are_refused(void **state)
{
    restitute_table_info info;
    size_t found = 0;
    (void)state;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    unsigned char *damaged = malloc(size);
    for (int power = 40; power <= 61; power += 21) {
        const int64_t is[2] = {info.speeds, 2}, claimed = INT64_C(1) << (power - 1);
        memcpy(damaged, bytes, size);
        for (size_t i = 512; i + sizeof is <= size; i++) /* the size of ez, and the largest one */
            if (memcmp(damaged + i, is, sizeof is) == 0) memcpy(damaged + i, &claimed, sizeof claimed), found++;
        put_with_checksum(damaged, size);
        refused("parts are missing", RESTITUTE_ERROR_FORMAT);
    }
    CHECK(found > 0, "the size is in the file");
    free(damaged);
}

/* Numbers that no table has, behind a right checksum. */
static void odd_numbers_are_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        static const char *const name[3] = {"chi", "stick_cells", "speeds"};
        const double wild = -1;
        const int64_t none = 0;
        assert_int_equal(restitute_table_write(table, broken, NULL), RESTITUTE_OK);
        const hid_t file = H5Fopen(broken, H5F_ACC_RDWR, H5P_DEFAULT), a = H5Aopen(file, name[i], H5P_DEFAULT);
        assert_true(H5Awrite(a, i ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, i ? (const void *)&none : &wild) >= 0);
        assert_true(H5Aclose(a) >= 0 && H5Fclose(file) >= 0);
        unsigned char *content = malloc(1 << 24);
        FILE *stream = fopen(broken, "rb");
        const size_t length = fread(content, 1, 1 << 24, stream);
        fclose(stream);
        put_with_checksum(content, length);
        free(content);
        refused("holds no table", RESTITUTE_ERROR_FORMAT);
    }
}

/* A dataset put down once more in one chunk, as HDF5 does it with compression. */
static void put_in_chunks(hid_t file, const char *name)
{
    hsize_t length[2];
    double values[1000];
    const hid_t old = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(old), how = H5Pcreate(H5P_DATASET_CREATE);
    assert_true(H5Sget_simple_extent_npoints(space) <= 1000 && H5Sget_simple_extent_ndims(space) == 2);
    H5Sget_simple_extent_dims(space, length, NULL);
    assert_true(H5Dread(old, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    assert_true(H5Dclose(old) >= 0 && H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    assert_true(H5Pset_chunk(how, 2, length) >= 0);
    const hid_t set = H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    assert_true(H5Dclose(set) >= 0 && H5Sclose(space) >= 0 && H5Pclose(how) >= 0);
}

/* A chunk that takes no room in the file may take any in memory: values are read only as they are written. */
static void chunks_are_refused(void **state)
{
    (void)state;
    assert_int_equal(restitute_table_write(table, broken, NULL), RESTITUTE_OK);
    const hid_t file = H5Fopen(broken, H5F_ACC_RDWR, H5P_DEFAULT);
    put_in_chunks(file, "ez");
    assert_true(H5Fclose(file) >= 0);
    unsigned char *content = calloc(1, 1 << 24);
    FILE *stream = fopen(broken, "rb");
    const size_t length = fread(content, 1, 1 << 24, stream);
    fclose(stream);
    char *count = strstr((char *)content, "bytes "), rest[512] = "";
    assert_non_null(count);
    strcpy(rest, strchr(count, '\n'));
    memset(count, 0, (size_t)((char *)content + 512 - count));
    sprintf(count, "bytes %zu%s", length - 512, rest);
    put_with_checksum(content, length);
    free(content);
    refused("parts are missing", RESTITUTE_ERROR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_written_is_read),
                                       cmocka_unit_test(flips_are_refused),
                                       cmocka_unit_test(cuts_are_refused),
                                       cmocka_unit_test(endless_files_are_refused),
                                       cmocka_unit_test(foreign_and_later_files_are_refused),
                                       cmocka_unit_test(odd_numbers_are_refused),
                                       cmocka_unit_test(chunks_are_refused),
                                       cmocka_unit_test(sizes_beyond_the_file_are_refused)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
