/* Materials from files with traps on.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include <restitute/files.h>

#include "files/number.h"

static void all_examples_are_read(void **state)
{
    const char *const names[] = {"polyisobutylene.json", "polyisobutylene.csv",  "steel.json",
                                 "bitumen.json",         "soda_lime_glass.json", "rubber.json"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[4096];
        restitute_material *material = NULL;
        restitute_error error;
        int status;
        snprintf(path, sizeof path, "%s/src/materials/%s", RESTITUTE_SOURCE_DIR, names[i]);
        WITHOUT_TRAPS(status, restitute_material_read(path, &material, NULL, &error), "%s", names[i]);
        CHECK(status == RESTITUTE_OK, "%s", error.message);
        restitute_material_destroy(material);
    }
}

static void numbers_are_read(void **state)
{
    const char *const texts[] = {"0", "1e-320", "-1e308", "inf", "1.7976931348623157e308"};
    double value;
    int status;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        WITHOUT_TRAPS(status, rst_number_read(texts[i], &value), "%s", texts[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_examples_are_read), cmocka_unit_test(numbers_are_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
