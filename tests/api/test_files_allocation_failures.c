/* Every allocation of every call of the component files fails in turn:
 * ERROR_MEMORY, outputs untouched, and the same call gives the right result afterwards and leaks
 * nothing. Those of Jansson do not fail here: Jansson 2.14 writes beyond a text that could not
 * grow.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"

#include <jansson.h>
#include <stdio.h>

#include "files/number.h"

#define STEM "test_files_allocation_failures"
#include "../support/material_files.h"

static restitute_error error;
static const char *path; /* of the file to read */

static int material_read(struct given *given)
{
    int status;
    restitute_material *material = UNTOUCHED;
    restitute_material_info info;
    memset(&info, 0, sizeof info);
    restitute_material_info_init(&info);
    info.density = 7;
    const restitute_material_info fresh = info;
    ARMED(status, restitute_material_read(path, &material, &info, &error));
    CHECK(status >= 0 || (material == UNTOUCHED && memcmp(&info, &fresh, sizeof fresh) == 0), "output touched");
    CHECK(status >= 0 || strlen(error.message) > 5, "no message");
    if (status < 0) return status;
    give(given, restitute_material_modulus(material, 1e-3));
    give(given, (double)(info.fingerprint % 1000003));
    restitute_material_destroy(material);
    return status;
}

static int number_read(struct given *given)
{
    int status;
    double number = 7;
    ARMED(status, rst_number_read("0.1234567890123456789012345678901234567890e-3", &number));
    CHECK(status >= 0 || number == 7, "output touched");
    give(given, number);
    return status;
}

#define DENSITY ", \"density_kg_m3\": 900"

/* None for Jansson either. */
static void *no_memory(size_t size)
{
    (void)size;
    errno = ENOMEM;
    return NULL;
}

static void materials(void **state)
{
    (void)state;
    static const char *const texts[] = {
        HEAD("elastic") DENSITY ", \"modulus_pa\": 1e6}",
        HEAD("standard_solid") DENSITY ", \"source\": \"s\", \"modulus1_pa\": 1e6, "
                                       "\"modulus2_pa\": 2e6, \"viscosity_pa_s\": 50}",
        HEAD("prony") DENSITY ", \"terms\": [" TERM("1e-3", "1e6") ", " TERM("1e-2", "2e6") "]}",
        HEAD("prony") DENSITY ", \"equilibrium_modulus_pa\": 1e5, \"prony_csv\": \"" CSV "\"}"};
    const struct subject reading = {"material_read", .call = material_read};
    write_text(CSV, "tau_s,G_Pa\n1e-3,1e6\n1e-2,2e6\n\"1e-1\",3e6\n");
    path = CSV;
    fail_each_allocation(&reading);
    path = JSON;
    allocator.ours_alone = 1;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct given given;
        write_text(JSON, texts[i]);
        fail_each_allocation(&reading);
        json_set_alloc_funcs(no_memory, free);
        CHECK(subject_call(&reading, 0, &given) == RESTITUTE_ERROR_MEMORY, "no memory for Jansson: %s", error.message);
        json_set_alloc_funcs(malloc, free);
    }
    allocator.ours_alone = 0;
}

static void numbers(void **state)
{
    (void)state;
    FAIL_EACH({"number_read", .call = number_read});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(materials), cmocka_unit_test(numbers)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, remove_files));
}
