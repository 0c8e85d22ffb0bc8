/* Files of tables with axes of delta1 and gamma: what was written is read; damaged ones are refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/table_files.h>

#include <unistd.h>

#include "../support/cells.h"
#include "../support/checksum.h"

static const char path[] = "test_table_files_cells.h5", broken[] = "test_table_files_cells_broken.h5";
static struct cells cells;
static restitute_table *table;
static unsigned char *bytes, *copy;
static size_t size;

enum { most_bytes = 1 << 24 };

static size_t get(const char *name, unsigned char *content)
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t length = fread(content, 1, most_bytes, file);
    fclose(file);
    return length;
}

static void put(size_t length)
{
    FILE *file = fopen(broken, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(copy, 1, length, file), length);
    fclose(file);
}

static int set_up(void **state)
{
    restitute_error error;
    (void)state;
    cells_make(1.6, 7, &cells);
    table = cells_table(&cells);
    CHECK(restitute_table_write(table, path, &error) == RESTITUTE_OK, "%s", error.message);
    bytes = malloc(most_bytes);
    copy = malloc(most_bytes);
    size = get(path, bytes);
    memcpy(copy, bytes, size);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    free(bytes);
    free(copy);
    restitute_table_destroy(table);
    cells_free(&cells);
    unlink(path);
    unlink(broken);
    return 0;
}

static int alike(const restitute_table *a, const restitute_table *b)
{
    uint64_t seed = 4;
    int same = 1;
    for (int n = 0; n < 2000; n++) {
        restitute_table_value p, q;
        const double chi = random_in(&seed, 0.9, 1.7), psi = random_in(&seed, 0, 3);
        const double delta1 = random_log(&seed, 0.5, 4), gamma = random_log(&seed, 0.2, 1.5);
        restitute_table_numbers_pair(a, chi, psi, delta1, gamma, &p);
        restitute_table_numbers_pair(b, chi, psi, delta1, gamma, &q);
        same &= p.ez == q.ez && p.ex == q.ex;
    }
    return same;
}

static void what_is_written_is_read(void **state)
{
    restitute_table *read = NULL;
    restitute_error error;
    (void)state;
    CHECK(restitute_table_read(path, &read, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(alike(table, read), "the table that was read");
    CHECK(restitute_table_write(read, broken, &error) == RESTITUTE_OK, "%s", error.message);
    unsigned char *again = malloc(most_bytes);
    CHECK(get(broken, again) == size && memcmp(again, bytes, size) == 0, "the same table, the same bytes");
    free(again);
    restitute_table_destroy(read);
}

/* An error of the format, and no table. */
static void check_refused(const char *what, size_t place, const char *text)
{
    restitute_table *read = NULL;
    restitute_error error;
    const int status = restitute_table_read(broken, &read, &error);
    CHECK(status == RESTITUTE_ERROR_FORMAT && !read && strstr(error.message, text), "%s at %zu: status %d, %s", what,
          place, status, error.message);
}

static void flips_and_cuts_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < size; i += 1 + size / 150) {
        copy[i] ^= (unsigned char)(1u << (i % 8));
        put(size);
        check_refused("flip", i, "test_table");
        copy[i] = bytes[i];
        put(i);
        check_refused("cut", i, "test_table");
    }
}

/* Where numbers are in the file. */
static size_t place_of(const void *numbers, size_t length)
{
    for (size_t i = 512; i + length <= size; i++)
        if (memcmp(bytes + i, numbers, length) == 0) return i;
    fail_msg("%zu bytes are not in the file", length);
    return 0;
}

/* With a right checksum, flips in the numbers of the leaves and of the chain: refused, or a table that can be asked. */
static void nothing_leads_out_of_the_table(void **state)
{
    const restitute_table_data *d = &cells.data;
    const size_t leaf = 7 * sizeof(int64_t), chain = (size_t)d->chain_length * sizeof(int64_t);
    const size_t start[3] = {place_of(d->leaves, leaf), place_of(d->rebound_leaves, leaf), place_of(d->chain, chain)};
    const size_t length[3] = {(size_t)d->cells * leaf, (size_t)d->rebound_cells * leaf, chain};
    uint64_t seed = 6;
    int taken = 0;
    (void)state;
    for (int try = 0; try < 240; try++) {
        restitute_table *read = NULL;
        const size_t i = start[try % 3] + random_bits(&seed) % length[try % 3];
        copy[i] ^= (unsigned char)(1u << random_below(&seed, 8));
        set_checksum(copy, size);
        put(size);
        copy[i] = bytes[i];
        const int status = restitute_table_read(broken, &read, NULL);
        CHECK(status == RESTITUTE_ERROR_FORMAT || (status == RESTITUTE_OK && read), "byte %zu: status %d", i, status);
        for (int n = 0; read && n < 50; n++) {
            restitute_table_value pair = {NAN, NAN};
            const double gamma = random_log(&seed, 0.1, 2), delta1 = random_log(&seed, 0.1, 10);
            const double psi = random_in(&seed, 0, 3), chi = random_in(&seed, 0.9, 1.7);
            restitute_table_numbers_pair(read, chi, psi, delta1, gamma, &pair);
            CHECK(pair.ez >= 0 && pair.ez <= 1 && fabs(pair.ex) <= 1, "byte %zu: %g, %g", i, pair.ez, pair.ex);
        }
        taken += read != NULL;
        restitute_table_destroy(read);
    }
    CHECK(taken > 0 && taken < 240, "%d of 240 flips taken", taken);
}

static void wrong_numbers_are_refused(void **state)
{
    const restitute_table_data *d = &cells.data;
    const struct {
        const void *numbers;
        size_t count;
        const char *text;
        int64_t value;
    } wrong[] = {{d->leaves, 7, "leaves", 5},
                 {d->rebound_leaves, 7, "rebound_leaves", 5},
                 {d->chain, (size_t)d->chain_length, "chain", 3},
                 {d->ex_cells, 16, "ex_cells", -1 /* two NaN */}};
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const size_t place = place_of(wrong[i].numbers, wrong[i].count * (i == 3 ? sizeof(float) : sizeof(int64_t)));
        memcpy(copy + place, &wrong[i].value, sizeof wrong[i].value);
        set_checksum(copy, size);
        put(size);
        check_refused(wrong[i].text, place, wrong[i].text);
        memcpy(copy + place, bytes + place, sizeof wrong[i].value);
    }
    memcpy(copy, bytes, size);
    char *schema = strstr((char *)copy, "schema 3");
    assert_non_null(schema);
    schema[7] = '2';
    put(size);
    check_refused("schema 2", 0, "build it again");
    schema[7] = '3';
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read), cmocka_unit_test(flips_and_cuts_are_refused),
        cmocka_unit_test(wrong_numbers_are_refused), cmocka_unit_test(nothing_leads_out_of_the_table)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
