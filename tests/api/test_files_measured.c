/* What material files say of the measurement, materials by name and at another temperature.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/files.h>

#include "../support/check.h"

#define FILE_NAME "test_files_measured.json"
#define MATERIALS RESTITUTE_SOURCE_DIR "/src/materials"

static int read_text(const char *text, restitute_material **material, restitute_material_info *info,
                     restitute_error *error)
{
    FILE *file = fopen(FILE_NAME, "w");
    CHECK(file &&
              fprintf(file,
                      "{\n\"name\": \"n\", \"poisson_ratio\": 0.5, \"model\": \"maxwell\",\n"
                      "\"modulus_pa\": 1e6, \"viscosity_pa_s\": 100%s}",
                      text) > 0 &&
              fclose(file) == 0,
          "cannot write");
    restitute_material_info_init(info);
    return restitute_material_read(FILE_NAME, material, info, error);
}

#define WLF ", \"wlf_c1\": 8.86, \"wlf_c2_k\": 101.6, \"wlf_reference_c\": 50"

static void the_measurement_is_read_and_shifts_with_temperature(void **state)
{
    restitute_material_info info;
    restitute_material *material, *warm;
    restitute_error error;
    double low, high;
    (void)state;
    int status = read_text(", \"temperature_c\": 20, \"window_s\": [1e-3, 10]" WLF, &material, &info, &error);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    CHECK(info.temperature == 20 && info.wlf_c1 == 8.86 && info.wlf_c2 == 101.6 && info.wlf_reference == 50, "%s", "");
    CHECK(info.window[0] == 1e-3 && info.window[1] == 10, "window");
    status = restitute_material_window(material, &low, &high, NULL);
    CHECK(status == RESTITUTE_OK && low == 1e-3 && high == 10, "window of the material");
    status = restitute_material_at_temperature(material, &info, 60, &warm, &error);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    /* log10 a_T of 60 C is -0.79391, of 20 C 3.71229 */
    const double shift = pow(10, -8.86 * 10 / 111.6 - 8.86 * 30 / 71.6);
    restitute_material_window(warm, &low, &high, NULL);
    CHECK_NEAR(low / 1e-3, shift, 1e-12 * shift, "window");
    CHECK_NEAR(high / 10, shift, 1e-12 * shift, "window");
    CHECK_NEAR(restitute_material_modulus(warm, shift * 1e-4), restitute_material_modulus(material, 1e-4), 1e-3,
               "Pa of 4e5: twelve digits of the shift");
    restitute_material_destroy(warm);
    CHECK(restitute_material_at_temperature(material, &info, -51.6, &warm, &error) == RESTITUTE_ERROR_DOMAIN, "cold");
    CHECK(strstr(error.message, "temperature = -51.6: must be above -51.6"), "%s", error.message);
    CHECK(restitute_material_at_temperature(material, NULL, 1, &warm, &error) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_material_at_temperature(NULL, &info, 1, &warm, &error) == RESTITUTE_ERROR_NULL, "NULL");
    restitute_material_destroy(material);
    CHECK(read_text("", &material, &info, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(restitute_material_at_temperature(material, &info, 1, &warm, &error) == RESTITUTE_ERROR_DOMAIN, "none");
    CHECK(strstr(error.message, "temperature = 1: the file of n gives no shift"), "%s", error.message);
    restitute_material_destroy(material);
}

static void a_shift_has_a_range_of_temperatures(void **state)
{
    restitute_material_info info;
    restitute_material *material, *warm = NULL;
    restitute_error error;
    (void)state;
    int status = read_text(", \"temperature_c\": 20, \"wlf_range_c\": [0, 60]" WLF, &material, &info, &error);
    CHECK(status == RESTITUTE_OK && info.wlf_range[0] == 0 && info.wlf_range[1] == 60, "%s", error.message);
    for (int i = 0; i < 2; i++) {
        status = restitute_material_at_temperature(material, &info, i ? 0 : 60, &warm, &error);
        CHECK(status == RESTITUTE_OK, "%s", error.message);
        restitute_material_destroy(warm);
        status = restitute_material_at_temperature(material, &info, i ? -0.1 : 60.1, &warm, &error);
        CHECK(status == RESTITUTE_ERROR_DOMAIN, "beyond the range");
    }
    CHECK(strcmp(error.message, "temperature = -0.1: must be in [0, 60] degrees Celsius, where the shift of n holds") ==
              0,
          "%s", error.message);
    restitute_material_destroy(material);
}

/* With the info of the file the shift of a shifted solid would be counted twice. */
static void a_shifted_solid_is_not_shifted_again(void **state)
{
    restitute_material_info info;
    restitute_material *material, *warm, *again, *untouched = NULL;
    restitute_error error;
    (void)state;
    CHECK(read_text(", \"temperature_c\": 20" WLF, &material, &info, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(info.viscosity == 100, "eta = %g", info.viscosity);
    CHECK(restitute_material_at_temperature(material, &info, 40, &warm, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(restitute_material_at_temperature(warm, &info, 60, &untouched, &error) == RESTITUTE_ERROR_DOMAIN &&
              !untouched && strstr(error.message, "but 100 in info: it was shifted already"),
          "%s", error.message);
    CHECK(restitute_material_at_temperature(material, &info, 60, &again, &error) == RESTITUTE_OK, "%s", error.message);
    restitute_material_destroy(again);
    info.viscosity = NAN; /* an info made by hand, of the warm one */
    info.temperature = 40;
    CHECK(restitute_material_at_temperature(warm, &info, 20, &again, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK_NEAR(restitute_material_modulus(again, 1e-4), restitute_material_modulus(material, 1e-4), 1e-4,
               "Pa of 4e5: ten digits, there and back");
    restitute_material_destroy(again);
    restitute_material_destroy(warm);
    restitute_material_destroy(material);
}

static void wrong_values_are_refused_with_their_line(void **state)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {",\n\"temperature_c\": -273.15", "line 4: temperature_c = -273.15: must be above -273.15"},
        {",\n\"temperature_c\": \"hot\"", "line 4: \"temperature_c\" must be a number"},
        {",\n\"temperature_k\": 300", "line 4: unknown key \"temperature_k\""},
        {",\n\"window_s\": [1, 2, 3]", "line 4: \"window_s\" must be two numbers: [.., ..]"},
        {",\n\"window_s\": 1", "line 4: \"window_s\" must be two numbers: [.., ..]"},
        {",\n\"window_s\": [2, 1]", "line 4: window_s = [2, 1]: must be finite, > 0 and ascending"},
        {",\n\"window_s\": [0, 1]", "line 4: window_s = [0, 1]: must be finite, > 0 and ascending"},
        {",\n\"wlf_c1\": 1, \"wlf_c2_k\": 2, \"wlf_reference_c\": 3", "line 4: wlf_reference_c needs temperature_c"},
        {", \"temperature_c\": 1,\n\"wlf_c1\": 1", "line 4: wlf_c1 needs wlf_reference_c beside it"},
        {", \"temperature_c\": 1,\n\"wlf_c1\": 0, \"wlf_c2_k\": 2, \"wlf_reference_c\": 3", "line 4: wlf_c1 = 0: must"},
        {",\n\"temperature_c\": 1, \"wlf_c1\": 9, \"wlf_c2_k\": 2, \"wlf_reference_c\": 3",
         "line 4: temperature_c = 1: must be above wlf_reference_c - wlf_c2_k = 1"},
        {",\n\"wlf_range_c\": [1, 2]", "line 4: wlf_range_c needs wlf_c1 beside it"},
        {WLF ", \"temperature_c\": 1,\n\"wlf_range_c\": [2, 3]",
         "line 4: wlf_range_c = [2, 3]: must have temperature_c = 1 in it"},
        {WLF ", \"temperature_c\": 1,\n\"wlf_range_c\": [-300, 3]",
         "line 4: wlf_range_c = [-300, 3]: must be finite, > -273.15 and ascending"},
        {WLF ", \"temperature_c\": 1,\n\"wlf_range_c\": 3", "line 4: \"wlf_range_c\" must be two numbers: [.., ..]"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        restitute_material *material = NULL;
        restitute_material_info info;
        restitute_error error;
        CHECK(read_text(cases[i].text, &material, &info, &error) < 0 && !material, "%s", cases[i].text);
        CHECK(strstr(error.message, cases[i].message), "\"%s\" is not in \"%s\"", cases[i].message, error.message);
    }
}

static void every_installed_material_is_known_by_name(void **state)
{
    size_t count = 0;
    (void)state;
    setenv("RESTITUTE_MATERIALS", MATERIALS, 1);
    DIR *folder = opendir(MATERIALS);
    CHECK(folder != NULL, MATERIALS);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        char name[300];
        restitute_material *material;
        restitute_material_info info;
        restitute_error error;
        snprintf(name, sizeof name, "%s", entry->d_name);
        char *dot = strstr(name, ".json");
        if (!dot) continue;
        *dot = '\0';
        restitute_material_info_init(&info);
        CHECK(restitute_material_by_name(name, &material, &info, &error) == RESTITUTE_OK, "%s", error.message);
        CHECK(info.name[0] && info.source[0], "%s", name);
        restitute_material_destroy(material);
        count++;
    }
    closedir(folder);
    CHECK(count >= 12, "%zu materials", count);
}

static void unknown_names_and_folders_are_refused(void **state)
{
    restitute_material *material = NULL;
    restitute_error error;
    (void)state;
    setenv("RESTITUTE_MATERIALS", MATERIALS, 1);
    CHECK(restitute_material_by_name("stel", &material, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "stel");
    CHECK(strstr(error.message, "material = \"stel\": did you mean steel? must be one of agilus30, "), "%s",
          error.message);
    CHECK(restitute_material_by_name("../x", &material, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "no path");
    CHECK(strstr(error.message, "material = \"../x\": must be one of "), "%s", error.message);
    char name[301];
    memset(name, 'x', 300), name[300] = '\0';
    CHECK(restitute_material_by_name(name, &material, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "long");
    CHECK(strcmp(error.message, "material = \"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx..\": must have 1 to 63 bytes, "
                                "none of them a control character") == 0,
          "%s", error.message);
    CHECK(restitute_material_by_name("st\033[2Jeel\n", &material, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "escape");
    CHECK(strstr(error.message, "material = \"st?[2Jeel?\": must have 1 to 63 bytes") != NULL, "%s", error.message);
    CHECK(restitute_material_by_name(NULL, &material, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_material_by_name("steel", NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL");
    setenv("RESTITUTE_MATERIALS", "nowhere", 1);
    CHECK(restitute_material_by_name("steel", &material, NULL, &error) == RESTITUTE_ERROR_FILE && !material, "none");
    CHECK(strstr(error.message, "no folder of materials at nowhere"), "%s", error.message);
}

static int remove_file(void **state)
{
    (void)state;
    remove(FILE_NAME);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_measurement_is_read_and_shifts_with_temperature),
        cmocka_unit_test(a_shift_has_a_range_of_temperatures),
        cmocka_unit_test(a_shifted_solid_is_not_shifted_again),
        cmocka_unit_test(wrong_values_are_refused_with_their_line),
        cmocka_unit_test(every_installed_material_is_known_by_name),
        cmocka_unit_test(unknown_names_and_folders_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
