/* Materials from files, <restitute/files.h>: every model, and what else a file says.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <restitute/files.h>

#define STEM "test_files_material"
#include "../support/comma_locale.h"
#include "../support/data.h"
#include "../support/material_files.h"

static void pair_of(const restitute_material *material, double *ez, double *ex)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = material;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.friction = 0.3;
    scene.normal_speed = 2.0;
    scene.tangential_speed = 1.0;
    restitute_error error;
    CHECK(restitute_scene_pair(&scene, ez, ex, &error) >= 0, "%s", error.message);
}

/* The two solids are equal: G(t), and the pair, which also depends on a parallel dashpot. One
 * library made both from the same doubles, so there is no tolerance. Both are released. */
static void check_same(restitute_material *read, restitute_material *made)
{
    CHECK(restitute_material_terms(read) == restitute_material_terms(made), "%zu terms, not %zu",
          restitute_material_terms(read), restitute_material_terms(made));
    CHECK(restitute_material_poisson_ratio(read) == restitute_material_poisson_ratio(made), "nu = %.17g",
          restitute_material_poisson_ratio(read));
    for (int k = -12; k <= 6; k++) {
        const double time = pow(10, k), found = restitute_material_modulus(read, time);
        CHECK(found == restitute_material_modulus(made, time), "G(%g) = %.17g, not %.17g", time, found,
              restitute_material_modulus(made, time));
    }
    double ez, ex, made_ez, made_ex;
    pair_of(read, &ez, &ex);
    pair_of(made, &made_ez, &made_ex);
    CHECK(ez == made_ez && ex == made_ex, "pair %.17g %.17g, not %.17g %.17g", ez, ex, made_ez, made_ex);
    restitute_material_destroy(read);
    restitute_material_destroy(made);
}

/* ---- the models */

static void elastic(void **state)
{
    (void)state;
    restitute_material *made;
    assert_int_equal(restitute_material_elastic(2.5e6, 0.25, &made, NULL), RESTITUTE_OK);
    check_same(read_json(HEAD("elastic") ", \"modulus_pa\": 2.5e6}", NULL), made);
}

static void standard_solid(void **state)
{
    (void)state;
    restitute_material *made;
    assert_int_equal(restitute_material_standard_solid(1e6, 2e6, 50, 0.25, &made, NULL), RESTITUTE_OK);
    check_same(read_json(HEAD("standard_solid") ",\n\"viscosity_pa_s\": 50, \"modulus1_pa\": 1e6, \"modulus2_pa\": "
                                                "2000000}",
                         NULL),
               made);
}

static void kelvin_voigt(void **state)
{
    (void)state;
    restitute_material *made;
    assert_int_equal(restitute_material_kelvin_voigt(1e6, 50, 0.25, &made, NULL), RESTITUTE_OK);
    check_same(read_json(HEAD("kelvin_voigt") ", \"modulus1_pa\": 1e6, \"viscosity_pa_s\": 50.0}", NULL), made);
}

static void maxwell(void **state)
{
    (void)state;
    restitute_material *made;
    assert_int_equal(restitute_material_maxwell(3e6, 70, 0.25, &made, NULL), RESTITUTE_OK);
    check_same(read_json(HEAD("maxwell") ", \"modulus_pa\": 3e6, \"viscosity_pa_s\": 70}", NULL), made);
}

static const double two_times[] = {1e-4, 1e-2}, two_moduli[] = {5e6, 1e6};

static restitute_material *made_prony(double equilibrium_modulus, double parallel_viscosity, double poisson_ratio)
{
    restitute_material *made;
    assert_int_equal(restitute_material_prony(equilibrium_modulus, parallel_viscosity, 2, two_times, two_moduli,
                                              poisson_ratio, &made, NULL),
                     RESTITUTE_OK);
    return made;
}

static void prony_terms(void **state)
{
    (void)state;
    check_same(read_json(HEAD("prony") ", \"terms\": [" TERM("1e-4", "5e6") ", " TERM("1e-2", "1e6") "]}", NULL),
               made_prony(0, 0, 0.25));
    check_same(read_json(HEAD("prony") ", \"equilibrium_modulus_pa\": 2e6, \"parallel_viscosity_pa_s\": 3, \"terms\": "
                                       "[{\"modulus_pa\": 1e6, \"tau_s\": 0.01}, " TERM("1e-4", "5e6") "]}",
                         NULL),
               made_prony(2e6, 3, 0.25));
    check_same(read_json(HEAD("prony") ", \"equilibrium_modulus_pa\": 0, \"parallel_viscosity_pa_s\": 0, \"terms\": "
                                       "[" TERM("1e-4", "5e6") ", " TERM("1e-2", "1e6") "]}",
                         NULL),
               made_prony(0, 0, 0.25));
}

/* The name of the CSV is relative to the JSON file, not to the current directory, where one of that
 * name misleads. */
static void prony_csv(void **state)
{
    (void)state;
    const char json[] = HEAD("prony") ", \"equilibrium_modulus_pa\": 2e6, \"prony_csv\": \"" CSV "\"}";
    CHECK(mkdir(FOLDER, 0777) == 0, "cannot make %s", FOLDER);
    write_text(FOLDER_CSV, "tau_s,G_Pa\n1e-4,5e6\n1e-2,1e6\n");
    write_text(CSV, "tau_s,G_Pa\n1,1\n");
    write_text(FOLDER_JSON, json);
    check_same(read_material(FOLDER_JSON, NULL), made_prony(2e6, 0, 0.25));
    check_same(read_material("./" FOLDER_JSON, NULL), made_prony(2e6, 0, 0.25));
    write_text(CSV, "tau_s,G_Pa\n1e-2,1e6\n1e-4,5e6\n"); /* a JSON file without a folder in its path */
    check_same(read_json(json, NULL), made_prony(2e6, 0, 0.25));
    check_same(read_json(HEAD("prony") ", \"equilibrium_modulus_pa\": 2e6, \"prony_csv\": \"" FOLDER_CSV "\"}", NULL),
               made_prony(2e6, 0, 0.25));
    char here[2048], absolute[4096];
    CHECK(getcwd(here, sizeof here) != NULL, "no current directory");
    snprintf(absolute, sizeof absolute,
             HEAD("prony") ", \"equilibrium_modulus_pa\": 2e6, \"prony_csv\": \"%s/" CSV "\"}", here);
    write_text(FOLDER_JSON, absolute); /* not beside the JSON file */
    check_same(read_material(FOLDER_JSON, NULL), made_prony(2e6, 0, 0.25));
}

static void plain_csv(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "tau_s,G_Pa\n1e-4,5e6\n1e-2,1e6\n",
        "# why\n\"G_Pa\", tau_s\r\n# and so on\r\n1000000 , 0.01\r\n\r\n \"5e6\",1E-4",
    };
    for (int i = 0; i < 2; i++) {
        restitute_material_info info;
        write_text(CSV, texts[i]);
        check_same(read_material(CSV, &info), made_prony(0, 0, 0.5));
        assert_string_equal(info.name, CSV);
        assert_string_equal(info.source, "");
        assert_string_equal(info.model, "prony");
        assert_true(isnan(info.density));
        assert_true(info.struct_size == sizeof info);
    }
}

static void csv_name_without_folder(void **state)
{
    (void)state;
    restitute_material_info info;
    CHECK(mkdir(FOLDER, 0777) == 0, "cannot make %s", FOLDER);
    write_text(FOLDER_CSV, "tau_s,G_Pa\n1,1\n");
    restitute_material_destroy(read_material(FOLDER_CSV, &info));
    assert_string_equal(info.name, CSV);
}

/* The ends of the ranges that the header gives. */
static void ends_of_ranges(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double poisson_ratio;
    } cases[] = {
        {"{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1, \"poisson_ratio\": 0}", 0},
        {"{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1, \"poisson_ratio\": 0.5}", 0.5},
        {"{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1e-30, \"poisson_ratio\": 5e-1}", 0.5},
        {"{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1, \"poisson_ratio\": 0, \"density_kg_m3\": 1e-9}",
         0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        restitute_material *material = read_json(cases[i].text, NULL);
        CHECK(restitute_material_poisson_ratio(material) == cases[i].poisson_ratio, "case %zu", i);
        restitute_material_destroy(material);
    }
}

/* 1e5 terms with the times 1, 2, .. s and moduli 1 Pa: G just after the step is their number. */
static void check_many_terms(const char *path, size_t count)
{
    restitute_material *material = read_material(path, NULL);
    assert_int_equal(restitute_material_terms(material), count);
    /* exp(-t/tau) = 1 in double for t = 1e-30 s, and whole numbers add up without rounding: no
     * tolerance */
    CHECK_NEAR(restitute_material_modulus(material, 1e-30), (double)count, 0, "%s", path);
    restitute_material_destroy(material);
}

static void many_terms_csv(void **state)
{
    (void)state;
    const size_t count = 100000;
    FILE *file = fopen(CSV, "wb");
    CHECK(file != NULL, "cannot write %s", CSV);
    fputs("tau_s,G_Pa\n", file);
    for (size_t i = count; i > 0; i--)
        fprintf(file, "%zu,1\n", i);
    fclose(file);
    check_many_terms(CSV, count);
}

static void many_terms_json(void **state)
{
    (void)state;
    const size_t count = 100000;
    FILE *file = fopen(JSON, "wb");
    CHECK(file != NULL, "cannot write %s", JSON);
    fputs(HEAD("prony") ", \"terms\": [\n", file);
    for (size_t i = count; i > 0; i--)
        fprintf(file, "{\"tau_s\": %zu, \"modulus_pa\": 1}%s\n", i, i > 1 ? "," : "]}");
    fclose(file);
    check_many_terms(JSON, count);
}

/* ---- shipped materials */

static void shipped_elastic(void **state)
{
    (void)state;
    /* E, nu and density as the files' sources give them */
    static const struct {
        const char *file;
        double young, poisson_ratio, density;
    } shipped[] = {{"aluminium", 70e9, 0.3, 2700},
                   {"aluminium_oxide", 380e9, 0.23, 4000},
                   {"soda_lime_glass", 70e9, 0.2, 2500},
                   {"steel", 210e9, 0.3, 7850}};
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++) {
        char path[4096];
        restitute_material_info info;
        snprintf(path, sizeof path, "%s/src/materials/%s.json", RESTITUTE_SOURCE_DIR, shipped[i].file);
        restitute_material *material = read_material(path, &info);
        const double modulus = shipped[i].young / (2 * (1 + shipped[i].poisson_ratio));
        /* the files round G to seven digits: at most half a unit of the seventh, 5e-7 of G */
        CHECK_NEAR(restitute_material_modulus(material, 1), modulus, 5e-7 * modulus, "%s", path);
        CHECK(restitute_material_poisson_ratio(material) == shipped[i].poisson_ratio, "%s", path);
        CHECK(restitute_material_terms(material) == 0, "%s", path);
        CHECK(info.density == shipped[i].density && info.name[0] && info.source[0], "%s", path);
        assert_string_equal(info.model, "elastic");
        restitute_material_destroy(material);
    }
}

static void shipped_polyisobutylene(void **state)
{
    (void)state;
    static const char *const extensions[] = {"csv", "json"};
    double tau[pib_terms], g[pib_terms];
    read_pib(tau, g);
    uint64_t fingerprints[2];
    for (int i = 0; i < 2; i++) {
        char path[4096];
        restitute_material_info info;
        restitute_material *made;
        snprintf(path, sizeof path, "%s/src/materials/polyisobutylene.%s", RESTITUTE_SOURCE_DIR, extensions[i]);
        restitute_material *material = read_material(path, &info);
        assert_int_equal(restitute_material_prony(0, 0, pib_terms, tau, g, 0.5, &made, NULL), RESTITUTE_OK);
        check_same(material, made);
        assert_string_equal(info.model, "prony");
        CHECK(i == 0 ? isnan(info.density) : info.density == 920, "density %g", info.density);
        CHECK((info.source[0] == '\0') == (i == 0), "source \"%s\"", info.source);
        fingerprints[i] = info.fingerprint;
    }
    CHECK(fingerprints[0] != fingerprints[1], "two contents, one fingerprint");
}

/* ---- what else it says */

static void info_init(void **state)
{
    (void)state;
    restitute_material_info info;
    memset(&info, 0x5a, sizeof info);
    restitute_material_info_init(&info);
    assert_true(info.struct_size == sizeof info);
    assert_true(isnan(info.density));
    assert_string_equal(info.name, "");
    assert_string_equal(info.source, "");
    assert_string_equal(info.model, "");
    assert_true(info.fingerprint == 0);
    assert_true(isnan(info.temperature) && isnan(info.wlf_c1) && isnan(info.wlf_c2) && isnan(info.wlf_reference));
    assert_true(info.window[0] == 0 && isinf(info.window[1]));
}

static void info_of_json(void **state)
{
    (void)state;
    restitute_material_info info;
    restitute_material_destroy(
        read_json("{\"name\": \"Gummi \\u00e4 \\\"q\\\"\", \"source\": \"a book\", \"density_kg_m3\": 920.5,\n"
                  "\"poisson_ratio\": 0.5, \"model\": \"maxwell\", \"modulus_pa\": 1, \"viscosity_pa_s\": 1}",
                  &info));
    assert_string_equal(info.name, "Gummi \xC3\xA4 \"q\"");
    assert_string_equal(info.source, "a book");
    assert_string_equal(info.model, "maxwell");
    assert_true(info.density == 920.5);
    assert_true(info.struct_size == sizeof info);
}

/* What an earlier file said does not shine through. */
static void info_used_again(void **state)
{
    (void)state;
    restitute_material_info info;
    restitute_material *material;
    restitute_material_destroy(
        read_json(HEAD("elastic") ", \"source\": \"s\", \"density_kg_m3\": 9, \"modulus_pa\": 1}", &info));
    write_text(JSON, HEAD("elastic") ", \"modulus_pa\": 1}");
    assert_int_equal(restitute_material_read(JSON, &material, &info, NULL), RESTITUTE_OK);
    restitute_material_destroy(material);
    assert_string_equal(info.source, "");
    assert_true(isnan(info.density));
}

/* Texts of the greatest length fit; one byte more is refused and the number of bytes allowed is
 * named. */
static void longest_texts(void **state)
{
    (void)state;
    static const struct {
        const char *key, *format, *most;
        int longest;
    } cases[] = {
        {"name", "{\"name\": \"%s\", \"model\": \"elastic\", \"poisson_ratio\": 0, \"modulus_pa\": 1}", "127", 127},
        {"source", HEAD("elastic") ", \"modulus_pa\": 1, \"source\": \"%s\"}", "511", 511},
    };
    for (int i = 0; i < 2; i++) {
        char text[1024], json[2048];
        restitute_material_info info;
        memset(text, 'x', sizeof text);
        text[cases[i].longest] = '\0';
        snprintf(json, sizeof json, cases[i].format, text);
        restitute_material_destroy(read_json(json, &info));
        assert_string_equal(i == 0 ? info.name : info.source, text);

        text[cases[i].longest] = 'x';
        text[cases[i].longest + 1] = '\0';
        snprintf(json, sizeof json, cases[i].format, text);
        write_text(JSON, json);
        restitute_material *material = NULL;
        restitute_error error;
        assert_int_equal(restitute_material_read(JSON, &material, NULL, &error), RESTITUTE_ERROR_DOMAIN);
        assert_null(material);
        CHECK(strstr(error.message, cases[i].key) && strstr(error.message, cases[i].most), "%s", error.message);
    }
}

/* Published FNV-1a arithmetic, written again: offset basis, then xor and multiply a byte at a
 * time. */
static uint64_t fnv1a(const char *text)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t fingerprint_of(const char *path)
{
    restitute_material_info info;
    restitute_material_destroy(read_material(path, &info));
    return info.fingerprint;
}

static void fingerprints(void **state)
{
    (void)state;
    const char json[] = HEAD("elastic") ", \"modulus_pa\": 1}", csv[] = "tau_s,G_Pa\n1,1\n";
    write_text(JSON, json);
    write_text(CSV, csv);
    assert_true(fingerprint_of(JSON) == fnv1a(json));
    assert_true(fingerprint_of(CSV) == fnv1a(csv));
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" CSV "\"}"); /* both files count */
    const uint64_t first = fingerprint_of(JSON);
    write_text(CSV, "tau_s,G_Pa\n1,2\n");
    const uint64_t second = fingerprint_of(JSON);
    write_text(JSON, HEAD("prony") ",  \"prony_csv\": \"" CSV "\"}");
    const uint64_t third = fingerprint_of(JSON);
    CHECK(first != second && second != third && first != third, "another content, the same fingerprint");
}

/* ---- locale */

static void comma_locale(void **state)
{
    (void)state;
    write_text(JSON, HEAD("elastic") ", \"modulus_pa\": 1.5, \"density_kg_m3\": 2.5}");
    write_text(CSV, "tau_s,G_Pa\n1e9,1.5\n");
    set_comma_locale();
    restitute_material *json = NULL, *csv = NULL;
    restitute_material_info info;
    restitute_material_info_init(&info);
    const int status_json = restitute_material_read(JSON, &json, &info, NULL);
    const int status_csv = restitute_material_read(CSV, &csv, NULL, NULL);
    setlocale(LC_ALL, "C"); /* before anything can fail */
    CHECK(status_json == RESTITUTE_OK && status_csv == RESTITUTE_OK, "status %d, %d", status_json, status_csv);
    /* read exactly; exp(-1e-30/1e9) is 1 in double: no tolerance */
    CHECK_NEAR(restitute_material_modulus(json, 1), 1.5, 0, "JSON");
    CHECK_NEAR(info.density, 2.5, 0, "JSON");
    CHECK_NEAR(restitute_material_modulus(csv, 1e-30), 1.5, 0, "CSV");
    restitute_material_destroy(json);
    restitute_material_destroy(csv);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(elastic),
        TEST(standard_solid),
        TEST(kelvin_voigt),
        TEST(maxwell),
        TEST(prony_terms),
        TEST(prony_csv),
        TEST(plain_csv),
        TEST(csv_name_without_folder),
        TEST(ends_of_ranges),
        TEST(many_terms_csv),
        TEST(many_terms_json),
        TEST(shipped_elastic),
        TEST(shipped_polyisobutylene),
        TEST(info_init),
        TEST(info_of_json),
        TEST(info_used_again),
        TEST(longest_texts),
        TEST(fingerprints),
        TEST(comma_locale),
    };
    return cmocka_run_group_tests_name("files: materials", tests, NULL, NULL);
}
