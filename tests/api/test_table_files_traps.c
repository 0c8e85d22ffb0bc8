/* Table files with traps on.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include <restitute/table_files.h>
#include <unistd.h>

#include "../support/table.h"

static void written_and_read(void **state)
{
    const char path[] = "test_table_files_traps.h5";
    restitute_material *material;
    restitute_scene scene = ball_on(1, &material);
    restitute_table *table = table_of(&scene, 1e-2, 1, 1e-2), *again = NULL;
    restitute_error error;
    int status;
    (void)state;
    WITHOUT_TRAPS(status, restitute_table_write(table, path, &error), "%s", path);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    WITHOUT_TRAPS(status, restitute_table_read(path, &again, &error), "%s", path);
    CHECK(status == RESTITUTE_OK && look_up(again, 0.1, 0.1).ex == look_up(table, 0.1, 0.1).ex, "%s", error.message);
    unlink(path);
    restitute_table_destroy(table);
    restitute_table_destroy(again);
    restitute_material_destroy(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(written_and_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
