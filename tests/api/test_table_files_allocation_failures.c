/* Every allocation that the component table_files asks for itself fails in turn: ERROR_MEMORY or,
 * of files that are written, ERROR_FILE, outputs untouched, and the same call works afterwards.
 * What HDF5 does without memory is its own matter.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"

#include <hdf5.h>
#include <unistd.h>

#include <restitute/table_files.h>

#include "../support/table.h"

static const char path[] = "test_table_files_allocation_failures.h5";
static restitute_table *table;
static restitute_error error;

static void give_table(restitute_table *read, struct given *given)
{
    const restitute_table_info info = describe(read);
    give(given, info.error_ex);
    give(given, (double)info.speeds);
    restitute_table_destroy(read);
}

MAKES(table, table_read, restitute_table_read(path, &made, &error), give_table(made, given))

/* No memory for the name of the new file: the file cannot be written. */
static int written(int status)
{
    CHECK(status >= 0 || access(path, F_OK) != 0, "a file in spite of status %d", status);
    return status == RESTITUTE_ERROR_FILE ? RESTITUTE_ERROR_MEMORY : status;
}

static int table_write(struct given *given)
{
    int status;
    unlink(path);
    ARMED(status, restitute_table_write(table, path, &error));
    give(given, 1);
    return written(status);
}

static void tables(void **state)
{
    (void)state;
    FAIL_EACH({"table_write", .call = table_write}, {"table_read", .call = table_read});
}

static restitute_material *material;
static restitute_scene scene;

static int set_up(void **state)
{
    (void)state;
    H5set_free_list_limits(0, 0, 0, 0, 0, 0); /* so that what HDF5 keeps for later is no loss */
    allocator.ours_alone = 1;
    scene = ball_on(0.3, &material);
    table = table_of(&scene, 0.1, 1, 1e-2);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    unlink(path);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, set_up, tear_down));
}
