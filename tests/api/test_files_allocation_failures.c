/* Every allocation of every call of the component files fails in turn:
 * ERROR_MEMORY, outputs untouched, and the same call gives the right result afterwards and leaks
 * nothing. Those of Jansson do not fail here: Jansson 2.14 writes beyond a text that could not
 * grow.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"

#include <jansson.h>
#include <stdio.h>

#include <restitute/files.h>

#include "files/number.h"

#define STEM "test_files_allocation_failures"
#define JSON STEM ".json"
#define CSV STEM ".csv"

static restitute_error error;
static const char *path; /* of the file to read */
static char place;
#define UNTOUCHED ((void *)&place)

static void write_text(const char *to, const char *text)
{
    FILE *file = fopen(to, "wb");
    CHECK(file && fputs(text, file) >= 0 && fclose(file) == 0, "cannot write %s", to);
}

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

#define HEAD(model) "{\"name\": \"n\", \"poisson_ratio\": 0.25, \"density_kg_m3\": 900, \"model\": \"" model "\""

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
        HEAD("elastic") ", \"modulus_pa\": 1e6}",
        HEAD("standard_solid") ", \"source\": \"s\", \"modulus1_pa\": 1e6, \"modulus2_pa\": 2e6, \"viscosity_pa_s\": "
                               "50}",
        HEAD("prony") ", \"terms\": [{\"tau_s\": 1e-3, \"modulus_pa\": 1e6}, {\"tau_s\": 1e-2, \"modulus_pa\": 2e6}]}",
        HEAD("prony") ", \"equilibrium_modulus_pa\": 1e5, \"prony_csv\": \"" CSV "\"}"};
    const struct subject reading = {"material_read", NULL, material_read, NULL, 0, 0};
    if (!CAN_FAIL) skip();
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
    const struct subject number = {"number_read", NULL, number_read, NULL, 0, 0};
    if (!CAN_FAIL) skip();
    fail_each_allocation(&number);
}

static int remove_files(void **state)
{
    (void)state;
    remove(JSON);
    remove(CSV);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(materials), cmocka_unit_test(numbers)};
    return cmocka_run_group_tests(tests, NULL, remove_files);
}
