/* Materials from files, <restitute/files.h>: every model, what else a file says, and every refusal.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <restitute/files.h>

#include "../support/comma_locale.h"
#include "../support/data.h"
#include "../support/odd_files.h"
#include "../support/random.h"
#include "../support/sized.h"

/* The files of the tests, all in the current directory; the teardown removes them. */
#define STEM "test_files_material"
#define JSON STEM ".json"
#define CSV STEM ".csv"
#define FOLDER STEM "_folder.json" /* a directory with the extension of a material */
#define FOLDER_JSON FOLDER "/inside.json"
#define FOLDER_CSV FOLDER "/" CSV
#define OTHER STEM ".txt"
#define FIFO STEM "_fifo.csv"
#define FIFO_JSON STEM "_fifo.json"

/* The beginning of a material file, on one line. */
#define HEAD(model) "{\"name\": \"n\", \"poisson_ratio\": 0.25, \"model\": \"" model "\""
#define TERM(tau, modulus) "{\"tau_s\": " tau ", \"modulus_pa\": " modulus "}"

static void write_bytes(const char *path, const char *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL, "cannot write %s", path);
    CHECK(fwrite(bytes, 1, length, file) == length, "cannot write %s", path);
    CHECK(fclose(file) == 0, "cannot close %s", path);
}

static void write_text(const char *path, const char *text)
{
    write_bytes(path, text, strlen(text));
}

static int remove_files(void **state)
{
    (void)state;
    static const char *const paths[] = {JSON, CSV, FOLDER_JSON, FOLDER_CSV, OTHER, FIFO, FIFO_JSON};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        remove(paths[i]);
    rmdir(FOLDER);
    return 0;
}

static restitute_material *read_material(const char *path, restitute_material_info *info)
{
    restitute_material *material = NULL;
    restitute_error error = {-99, "old"};
    if (info) restitute_material_info_init(info);
    const int status = restitute_material_read(path, &material, info, &error);
    CHECK(status == RESTITUTE_OK, "%s: status %d: %s", path, status, error.message);
    CHECK(error.status == RESTITUTE_OK && error.message[0] == '\0', "error keeps %d \"%s\"", error.status,
          error.message);
    return material;
}

static restitute_material *read_json(const char *text, restitute_material_info *info)
{
    write_text(JSON, text);
    return read_material(JSON, info);
}

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

/* ---- the refusals */

static char untouched_place;
#define UNTOUCHED ((restitute_material *)&untouched_place)

/* Reading fails with the status; neither output changes a byte, with and without info and error;
 * the message has all the words. */
static void check_refused(const char *path, int expected, const char *const *words, const char *what)
{
    restitute_material *material = UNTOUCHED;
    restitute_error error = {-99, "old"};
    restitute_material_info info, before;
    memset(&info, 0xa5, sizeof info);
    info.struct_size = sizeof info;
    memcpy(&before, &info, sizeof info);
    const int status = restitute_material_read(path, &material, &info, &error);
    CHECK(status == expected, "%s: status %d (%s), not %d", what, status, error.message, expected);
    CHECK(error.status == status, "%s: error.status = %d", what, error.status);
    CHECK(material == UNTOUCHED, "%s: the material was touched", what);
    CHECK(memcmp(&info, &before, sizeof info) == 0, "%s: the info was touched", what);
    CHECK(memchr(error.message, '\0', sizeof error.message) && error.message[0], "%s: no message", what);
    for (; words && *words; words++)
        CHECK(strstr(error.message, *words) != NULL, "%s: no \"%s\" in \"%s\"", what, *words, error.message);
    CHECK(restitute_material_read(path, &material, NULL, NULL) == expected, "%s: without info and error", what);
    CHECK(material == UNTOUCHED, "%s: the material was touched", what);
}

struct refusal {
    const char *what, *text;
    int status;
    const char *words[5];
};

static void check_refusals(const char *path, const struct refusal *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *words[7] = {path};
        memcpy(words + 1, cases[i].words, sizeof cases[i].words);
        write_text(path, cases[i].text);
        check_refused(path, cases[i].status, words, cases[i].what);
    }
}
#define CHECK_REFUSALS(path, cases) check_refusals(path, cases, sizeof(cases) / sizeof *(cases))

enum { FORMAT = RESTITUTE_ERROR_FORMAT, RANGE = RESTITUTE_ERROR_DOMAIN };

static void unknown_and_repeated_keys(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"unknown key", HEAD("elastic") ", \"modulus_pa\": 1,\n\"colour\": 3}", FORMAT, {"line 2", "colour"}},
        {"key in other letters", HEAD("elastic") ",\n\"modulus_PA\": 1}", FORMAT, {"line 2", "modulus_PA"}},
        {"key of another model",
         HEAD("elastic") ", \"modulus_pa\": 1,\n\n\"viscosity_pa_s\": 1}",
         FORMAT,
         {"line 3", "viscosity_pa_s", "elastic"}},
        {"terms of an elastic solid",
         HEAD("elastic") ", \"modulus_pa\": 1,\n\"terms\": []}",
         FORMAT,
         {"line 2", "terms"}},
        {"modulus_pa of prony",
         HEAD("prony") ", \"terms\": [" TERM("1", "1") "],\n\"modulus_pa\": 1}",
         FORMAT,
         {"line 2", "modulus_pa", "prony"}},
        {"unknown key in a term",
         HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\n{\"tau_s\": 2, \"modulus_pa\": 1, \"why\": 0}]}",
         FORMAT,
         {"line 3", "why"}},
        {"key in a text with quotes",
         "{\"name\": \"a \\\" \\\"colour\\\": \", \"poisson_ratio\": 0, \"model\": \"elastic\", \"modulus_pa\": "
         "1,\n\"colour\": 3}",
         FORMAT,
         {"line 2", "colour"}},
        {"repeated key", HEAD("elastic") ", \"modulus_pa\": 1,\n\"modulus_pa\": 1}", FORMAT, {"line 2", "modulus_pa"}},
        {"repeated text", HEAD("elastic") ", \"modulus_pa\": 1,\n\"name\": \"n\"}", FORMAT, {"line 2", "name"}},
        {"repeated key in a term",
         HEAD("prony") ", \"terms\": [\n{\"tau_s\": 2, \"modulus_pa\": 1, \"tau_s\": 2}]}",
         FORMAT,
         {"line 2", "tau_s"}},
        {"terms and prony_csv",
         HEAD("prony") ", \"terms\": [" TERM("1", "1") "], \"prony_csv\": \"" CSV "\"}",
         FORMAT,
         {"terms", "prony_csv"}},
    };
    CHECK_REFUSALS(JSON, cases);
}

static void missing_keys(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"name", "{\"model\": \"elastic\", \"poisson_ratio\": 0.5, \"modulus_pa\": 1}", FORMAT, {"\"name\""}},
        {"model", "{\"name\": \"n\", \"poisson_ratio\": 0.5, \"modulus_pa\": 1}", FORMAT, {"\"model\""}},
        {"nu", "{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1}", FORMAT, {"\"poisson_ratio\""}},
        {"elastic", HEAD("elastic") "}", FORMAT, {"\"modulus_pa\""}},
        {"standard 1", HEAD("standard_solid") ", \"modulus2_pa\": 1, \"viscosity_pa_s\": 1}", FORMAT, {"modulus1_pa"}},
        {"standard 2", HEAD("standard_solid") ", \"modulus1_pa\": 1, \"viscosity_pa_s\": 1}", FORMAT, {"modulus2_pa"}},
        {"standard 3", HEAD("standard_solid") ", \"modulus1_pa\": 1, \"modulus2_pa\": 1}", FORMAT, {"viscosity_pa_s"}},
        {"Kelvin-Voigt 1", HEAD("kelvin_voigt") ", \"viscosity_pa_s\": 1}", FORMAT, {"modulus1_pa"}},
        {"Kelvin-Voigt 2", HEAD("kelvin_voigt") ", \"modulus1_pa\": 1}", FORMAT, {"viscosity_pa_s"}},
        {"Maxwell 1", HEAD("maxwell") ", \"viscosity_pa_s\": 1}", FORMAT, {"modulus_pa"}},
        {"Maxwell 2", HEAD("maxwell") ", \"modulus_pa\": 1}", FORMAT, {"viscosity_pa_s"}},
        {"prony", HEAD("prony") ", \"equilibrium_modulus_pa\": 1}", FORMAT, {"terms", "prony_csv"}},
        {"tau_s", HEAD("prony") ",\n\"terms\": [{\"modulus_pa\": 1}]}", FORMAT, {"line 2", "tau_s"}},
        {"modulus of a term", HEAD("prony") ",\n\"terms\": [{\"tau_s\": 1}]}", FORMAT, {"line 2", "modulus_pa"}},
        {"no keys", "{}", FORMAT, {"no key"}},
    };
    CHECK_REFUSALS(JSON, cases);
}

static void wrong_types(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"an array", "[]", FORMAT, {"object"}},
        {"a text", "\"elastic\"", FORMAT, {NULL}},
        {"name",
         "{\"name\": 1, \"model\": \"elastic\", \"poisson_ratio\": 0, \"modulus_pa\": 1}",
         FORMAT,
         {"line 1", "name"}},
        {"model", "{\"name\": \"n\",\n\"model\": null, \"poisson_ratio\": 0}", FORMAT, {"line 2", "model"}},
        {"source", HEAD("elastic") ", \"modulus_pa\": 1,\n\"source\": [\"s\"]}", FORMAT, {"line 2", "source"}},
        {"nu",
         "{\"name\": \"n\", \"model\": \"elastic\",\n\"poisson_ratio\": \"0.5\"}",
         FORMAT,
         {"line 2", "poisson_ratio"}},
        {"modulus as text", HEAD("elastic") ",\n\"modulus_pa\": \"1\"}", FORMAT, {"line 2", "modulus_pa", "number"}},
        {"modulus true", HEAD("elastic") ",\n\"modulus_pa\": true}", FORMAT, {"line 2", "modulus_pa", "number"}},
        {"modulus null", HEAD("elastic") ",\n\"modulus_pa\": null}", FORMAT, {"line 2", "modulus_pa", "number"}},
        {"density",
         HEAD("elastic") ", \"modulus_pa\": 1,\n\"density_kg_m3\": {}}",
         FORMAT,
         {"line 2", "density_kg_m3"}},
        {"terms", HEAD("prony") ",\n\"terms\": " TERM("1", "1") "}", FORMAT, {"line 2", "terms"}},
        {"no terms", HEAD("prony") ",\n\"terms\": []}", FORMAT, {"line 2", "terms"}},
        {"tau as text",
         HEAD("prony") ",\n\"terms\": [\n" TERM("\"1\"", "1") "]}",
         FORMAT,
         {"line 3", "tau_s", "number"}},
        {"prony_csv", HEAD("prony") ",\n\"prony_csv\": 1}", FORMAT, {"line 2", "prony_csv"}},
    };
    CHECK_REFUSALS(JSON, cases);
}

/* The line named is that of the wrong term, also if the wrong term is no object. */
static void line_of_a_term(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"a number", HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\n5,\n" TERM("2", "1") "]}", FORMAT, {"line 3"}},
        {"a pair",
         HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\n[2, 1],\n" TERM("3", "1") "]}",
         FORMAT,
         {"line 3"}},
        {"the last", HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\nnull]}", FORMAT, {"line 3"}},
        {"the first", HEAD("prony") ", \"terms\": [\n\"x\",\n" TERM("1", "1") "]}", FORMAT, {"line 2"}},
    };
    CHECK_REFUSALS(JSON, cases);
}

static void not_json(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"empty file", "", FORMAT, {NULL}},
        {"blanks", "\n \n", FORMAT, {NULL}},
        {"NaN", HEAD("elastic") ",\n\"modulus_pa\": NaN}", FORMAT, {"line 2"}},
        {"nan", HEAD("elastic") ",\n\"modulus_pa\": nan}", FORMAT, {"line 2"}},
        {"infinity", HEAD("elastic") ",\n\"modulus_pa\": Infinity}", FORMAT, {"line 2"}},
        {"hexadecimal", HEAD("elastic") ",\n\"modulus_pa\": 0x10}", FORMAT, {"line 2"}},
        {"decimal comma", HEAD("elastic") ",\n\"modulus_pa\": 1,5}", FORMAT, {"line 2"}},
        {"comma at the end", HEAD("elastic") ",\n\"modulus_pa\": 1,\n}", FORMAT, {"line 3"}},
        {"comment", "// steel\n" HEAD("elastic") ", \"modulus_pa\": 1}", FORMAT, {"line 1"}},
        {"single quotes", "{'name': 'n'}", FORMAT, {"line 1"}},
        {"two objects", HEAD("elastic") ", \"modulus_pa\": 1}\n{}", FORMAT, {"line 2"}},
        {"a CSV table", "tau_s,G_Pa\n1,1\n", FORMAT, {"line 1"}},
        {"wrong UTF-8", "{\"name\": \"\xff\xfe\"}", FORMAT, {"line 1"}},
        {"a zero in the name", "{\"name\": \"a\\u0000b\"}", FORMAT, {"line 1"}},
    };
    CHECK_REFUSALS(JSON, cases);
}

static void values_out_of_range(void **state)
{
    (void)state;
#define NU(value) "{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1,\n\"poisson_ratio\": " value "}"
    static const struct refusal cases[] = {
        {"nu < 0", NU("-0.01"), RANGE, {"line 2", "poisson_ratio", "-0.01", "[0, 0.5]"}},
        {"nu > 0.5", NU("0.5000001"), RANGE, {"line 2", "poisson_ratio", "0.5000001", "[0, 0.5]"}},
        {"nu far out", NU("-1e300"), RANGE, {"line 2", "poisson_ratio", "-1e+300", "[0, 0.5]"}},
        {"G = 0", HEAD("elastic") ",\n\"modulus_pa\": 0}", RANGE, {"line 2", "modulus_pa = 0", "> 0"}},
        {"G < 0", HEAD("elastic") ",\n\"modulus_pa\": -2.5}", RANGE, {"line 2", "modulus_pa = -2.5", "> 0"}},
        {"G tiny", HEAD("elastic") ",\n\"modulus_pa\": 1e-999}", RANGE, {"line 2", "modulus_pa", "> 0"}},
        {"density 0",
         HEAD("elastic") ", \"modulus_pa\": 1,\n\"density_kg_m3\": 0}",
         RANGE,
         {"line 2", "density_kg_m3 = 0", "> 0"}},
        {"density < 0", HEAD("elastic") ", \"modulus_pa\": 1,\n\"density_kg_m3\": -1}", RANGE, {"line 2", "-1", "> 0"}},
        {"G1 < 0",
         HEAD("standard_solid") ",\n\"modulus1_pa\": -1, \"modulus2_pa\": 1, \"viscosity_pa_s\": 1}",
         RANGE,
         {"line 2", "modulus1_pa = -1", "> 0"}},
        {"G2 = 0",
         HEAD("standard_solid") ", \"modulus1_pa\": 1,\n\"modulus2_pa\": 0, \"viscosity_pa_s\": 1}",
         RANGE,
         {"line 2", "modulus2_pa = 0", "> 0"}},
        {"eta = 0",
         HEAD("kelvin_voigt") ", \"modulus1_pa\": 1,\n\"viscosity_pa_s\": 0}",
         RANGE,
         {"line 2", "viscosity_pa_s = 0", "> 0"}},
        {"eta < 0",
         HEAD("maxwell") ", \"modulus_pa\": 1,\n\"viscosity_pa_s\": -3}",
         RANGE,
         {"line 2", "viscosity_pa_s = -3", "> 0"}},
        {"G_inf < 0",
         HEAD("prony") ", \"terms\": [" TERM("1", "1") "],\n\"equilibrium_modulus_pa\": -1}",
         RANGE,
         {"line 2", "equilibrium_modulus_pa = -1", ">= 0"}},
        {"eta_inf < 0",
         HEAD("prony") ", \"terms\": [" TERM("1", "1") "],\n\"parallel_viscosity_pa_s\": -1}",
         RANGE,
         {"line 2", "parallel_viscosity_pa_s = -1", ">= 0"}},
        {"tau = 0",
         HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\n" TERM("0", "1") "]}",
         RANGE,
         {"line 3", "tau_s = 0", "> 0"}},
        {"G_k < 0",
         HEAD("prony") ", \"terms\": [\n" TERM("1", "1") ",\n" TERM("2", "-7") "]}",
         RANGE,
         {"line 3", "modulus_pa = -7", "> 0"}},
        {"two equal times",
         HEAD("prony") ", \"terms\": [\n" TERM("0.25", "1") ",\n" TERM("1", "1") ",\n" TERM("25e-2", "2") "]}",
         RANGE,
         {"line 4", "line 2", "tau_s = 0.25"}},
        {"empty name",
         "{\"name\": \"\", \"model\": \"elastic\", \"poisson_ratio\": 0, \"modulus_pa\": 1}",
         RANGE,
         {"line 1", "name"}},
    };
#undef NU
    CHECK_REFUSALS(JSON, cases);
    static const struct refusal models[] = {
        {"unknown model",
         "{\"name\": \"n\",\n\"model\": \"rigid\", \"poisson_ratio\": 0}",
         FORMAT,
         {"line 2", "rigid", "elastic", "prony"}},
        {"model in capitals", HEAD("Elastic") ", \"modulus_pa\": 1}", FORMAT, {"line 1", "Elastic", "elastic"}},
    };
    CHECK_REFUSALS(JSON, models);
}

/* A value that a double cannot hold, or values whose quotient it cannot hold: still a message that
 * names the file. Which of the two statuses is open: JSON's grammar allows 1e400, its reader does
 * not. */
static void values_beyond_double(void **state)
{
    (void)state;
    static const char *const texts[] = {
        HEAD("elastic") ", \"modulus_pa\": 1e400}",
        HEAD("maxwell") ", \"modulus_pa\": 1e-200, \"viscosity_pa_s\": 1e200}",
        HEAD("maxwell") ", \"modulus_pa\": 1e200, \"viscosity_pa_s\": 1e-200}",
        HEAD("standard_solid") ", \"modulus1_pa\": 1, \"modulus2_pa\": 1e-200, \"viscosity_pa_s\": 1e200}",
        HEAD("elastic") ", \"modulus_pa\": 1e31}",
        HEAD("elastic") ", \"modulus_pa\": 1e305}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        restitute_material *material = UNTOUCHED;
        restitute_error error = {-99, "old"};
        write_text(JSON, texts[i]);
        const int status = restitute_material_read(JSON, &material, NULL, &error);
        CHECK(status == RESTITUTE_ERROR_DOMAIN || status == RESTITUTE_ERROR_FORMAT, "status %d for %s", status,
              texts[i]);
        CHECK(material == UNTOUCHED, "the material was touched: %s", texts[i]);
        CHECK(strstr(error.message, JSON) != NULL, "no \"%s\" in \"%s\"", JSON, error.message);
    }
}

static void refused_csv(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"empty file", "", FORMAT, {"empty"}},
        {"comments alone", "# tau_s,G_Pa\n", FORMAT, {"empty"}},
        {"no rows", "tau_s,G_Pa\n", FORMAT, {"no rows"}},
        {"no header", "1,2\n3,4\n", FORMAT, {"tau_s", "G_Pa"}},
        {"unknown column", "tau_s,G_Pa,note\n1,1,x\n", FORMAT, {"note"}},
        {"column in other letters", "tau_s,g_pa\n1,1\n", FORMAT, {"g_pa"}},
        {"one column", "tau_s\n1\n", FORMAT, {"G_Pa"}},
        {"the other column", "G_Pa\n1\n", FORMAT, {"tau_s"}},
        {"repeated column", "tau_s,G_Pa,tau_s\n1,1,1\n", FORMAT, {"line 1", "tau_s", "twice"}},
        {"ragged row", "tau_s,G_Pa\n1,1\n2\n", FORMAT, {"line 3", "1 cell", "2 columns"}},
        {"long row", "# c\ntau_s,G_Pa\n1,1,1\n", FORMAT, {"line 3", "3 cells", "2 columns"}},
        {"empty cell", "tau_s,G_Pa\n1,\n", FORMAT, {"line 2", "G_Pa", "> 0"}},
        {"text", "tau_s,G_Pa\n1,1\n#\n2,1.0x\n", FORMAT, {"line 4", "G_Pa", "1.0x", "> 0"}},
        {"time beyond its range", "tau_s,G_Pa\n1e31,1\n", RANGE, {CSV ": relaxation_time[0]", "[1e-30, 1e+30]"}},
        {"modulus beyond its range", "tau_s,G_Pa\n1,1\n2,1e-31\n", RANGE, {CSV ": modulus[1]", "[1e-30, 1e+30]"}},
        {"nan", "tau_s,G_Pa\nnan,1\n", FORMAT, {"line 2", "tau_s", "nan", "> 0"}},
        {"decimal comma", "tau_s,G_Pa\n\"1,5\",1\n", FORMAT, {"line 2", "tau_s", "1,5"}},
        {"inf", "tau_s,G_Pa\ninf,1\n", RANGE, {"line 2", "tau_s", "inf", "finite"}},
        {"1e400", "tau_s,G_Pa\n1,1e400\n", RANGE, {"line 2", "G_Pa", "1e400", "finite"}},
        {"1e-400", "tau_s,G_Pa\n1,1e-400\n", RANGE, {"line 2", "G_Pa", "1e-400", "> 0"}},
        {"tau = 0", "tau_s,G_Pa\n1,1\n0,1\n", RANGE, {"line 3", "tau_s = 0", "> 0"}},
        {"tau < 0", "tau_s,G_Pa\n-1.5,1\n", RANGE, {"line 2", "tau_s = -1.5", "> 0"}},
        {"G = 0", "tau_s,G_Pa\n1,0\n", RANGE, {"line 2", "G_Pa = 0", "> 0"}},
        {"G < 0", "G_Pa,tau_s\n-2,1\n", RANGE, {"line 2", "G_Pa = -2", "> 0"}},
        {"two equal times", "tau_s,G_Pa\n0.5,1\n\n2,1\n5e-1,3\n", RANGE, {"line 5", "line 2", "tau_s = 0.5"}},
        {"stray quote", "tau_s,G_Pa\n1,1\"\n", FORMAT, {"line 2"}},
        {"a JSON file", HEAD("elastic") ", \"modulus_pa\": 1}", FORMAT, {NULL}},
    };
    CHECK_REFUSALS(CSV, cases);
}

/* A fault in the CSV of a JSON file is named by the CSV and its line. */
static void refused_prony_csv(void **state)
{
    (void)state;
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" CSV "\"}");
    check_refused(JSON, RESTITUTE_ERROR_FILE, (const char *[]){CSV, NULL}, "missing");
    write_text(CSV, "");
    check_refused(JSON, FORMAT, (const char *[]){CSV, "empty", NULL}, "empty");
    write_text(CSV, "tau_s,G_Pa\n1,1\n2,-3\n");
    check_refused(JSON, RANGE, (const char *[]){CSV, "line 3", "G_Pa = -3", "> 0", NULL}, "negative");
    write_text(CSV, "tau_s,G_Pa\n1,1\n1,3\n");
    check_refused(JSON, RANGE, (const char *[]){CSV, "line 3", "line 2", "tau_s = 1", NULL}, "two equal times");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \".\"}");
    check_refused(JSON, RESTITUTE_ERROR_FILE, NULL, "a directory");
    write_text(JSON, HEAD("prony") ",\n\"prony_csv\": \"\"}");
    check_refused(JSON, RANGE, (const char *[]){JSON, "line 2", "prony_csv", NULL}, "no name");
}

/* "-" is a file's name here: the standard input belongs to the program. */
static void prony_csv_is_a_file(void **state)
{
    (void)state;
    write_text(CSV, "tau_s,G_Pa\n1,1\n");
    CHECK(freopen(CSV, "rb", stdin) != NULL, "cannot redirect the standard input");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"-\"}");
    check_refused(JSON, RESTITUTE_ERROR_FILE, NULL, "prony_csv \"-\"");
}

static void unreadable_files(void **state)
{
    (void)state;
    check_refused(STEM "_nowhere.json", RESTITUTE_ERROR_FILE, (const char *[]){STEM "_nowhere.json", NULL}, "missing");
    check_refused(STEM "_nowhere.csv", RESTITUTE_ERROR_FILE, (const char *[]){STEM "_nowhere.csv", NULL}, "missing");
    CHECK(mkdir(FOLDER, 0777) == 0, "cannot make %s", FOLDER);
    check_refused(FOLDER, RESTITUTE_ERROR_FILE, (const char *[]){FOLDER, NULL}, "a directory");
    check_refused(FOLDER "/none.json", RESTITUTE_ERROR_FILE, (const char *[]){"none.json", NULL}, "missing in it");
    write_text(JSON, HEAD("elastic") ", \"modulus_pa\": 1}");
    CHECK(chmod(JSON, 0) == 0, "cannot change the mode of %s", JSON);
    FILE *open = fopen(JSON, "rb");
    if (open) /* the superuser may read anything */
        fclose(open);
    else
        check_refused(JSON, RESTITUTE_ERROR_FILE, (const char *[]){JSON, NULL}, "not permitted");
    char path[5000];
    memset(path, 'x', sizeof path);
    strcpy(path + sizeof path - 10, "/end.json");
    check_refused(path, RESTITUTE_ERROR_FILE, (const char *[]){"end.json", NULL}, "endless path");
    check_refused("%s%n.json", RESTITUTE_ERROR_FILE, (const char *[]){"%s%n.json", NULL}, "path like a format");
}

/* A file named in a JSON file is read like the JSON file itself: neither may block the reader or
 * fill its memory. */
static void endless_files(void **state)
{
    (void)state;
    const char *const regular = "not a regular file", *const most = "67108864";
    make_fifo(FIFO);
    check_refused(FIFO, RESTITUTE_ERROR_FILE, (const char *[]){FIFO, regular, NULL}, "a FIFO");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" FIFO "\"}");
    check_refused(JSON, RESTITUTE_ERROR_FILE, (const char *[]){FIFO, regular, NULL}, "names a FIFO");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"/dev/zero\"}");
    check_refused(JSON, RESTITUTE_ERROR_FILE, (const char *[]){"/dev/zero", regular, NULL}, "names a device");
    if (make_sparse(CSV, (1 << 26) + 1)) {
        check_refused(CSV, RESTITUTE_ERROR_FILE, (const char *[]){CSV, "67108865", most, NULL}, "too large");
        write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" CSV "\"}");
        check_refused(JSON, RESTITUTE_ERROR_FILE, (const char *[]){CSV, "67108865", most, NULL}, "names a large file");
    }
    if (make_sparse(CSV, 1 << 26)) check_refused(CSV, FORMAT, (const char *[]){CSV, "NUL", NULL}, "the largest size");
    make_fifo(FIFO_JSON);
    check_refused(FIFO_JSON, RESTITUTE_ERROR_FILE, (const char *[]){FIFO_JSON, regular, NULL},
                  "a JSON file that is one");
}

static void other_extensions(void **state)
{
    (void)state;
    write_text(OTHER, "tau_s,G_Pa\n1,1\n");
    check_refused(OTHER, FORMAT, (const char *[]){OTHER, ".json", ".csv", NULL}, ".txt");
    check_refused("", FORMAT, NULL, "empty path");
    check_refused("-", FORMAT, NULL, "standard input");
    check_refused("json", FORMAT, NULL, "no extension");
}

static void null_arguments(void **state)
{
    (void)state;
    restitute_error error = {-99, "old"};
    restitute_material *material = UNTOUCHED;
    write_text(JSON, HEAD("elastic") ", \"modulus_pa\": 1}");
    assert_int_equal(restitute_material_read(NULL, &material, NULL, &error), RESTITUTE_ERROR_NULL);
    assert_non_null(strstr(error.message, "path"));
    assert_int_equal(error.status, RESTITUTE_ERROR_NULL);
    assert_ptr_equal(material, UNTOUCHED);
    assert_int_equal(restitute_material_read(JSON, NULL, NULL, &error), RESTITUTE_ERROR_NULL);
    assert_non_null(strstr(error.message, "material"));
    assert_int_equal(restitute_material_read(NULL, NULL, NULL, NULL), RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_material_read(JSON, &material, NULL, NULL), RESTITUTE_OK);
    restitute_material_destroy(material);
    restitute_material_info_init(NULL);
}

static void an_info_of_another_size_is_refused_and_not_touched(void **state)
{
    static _Alignas(double) unsigned char place[guarded_bytes];
    restitute_material *material = UNTOUCHED;
    restitute_error error;
    (void)state;
    write_text(JSON, HEAD("elastic") ", \"modulus_pa\": 1}");
    CHECK_SIZES(material_info, window, place, &error,
                restitute_material_read(JSON, &material, (void *)place, &error));
    assert_ptr_equal(material, UNTOUCHED);
}

/* ---- any bytes at all */

static const char rich_json[] = "{\n  \"name\": \"n\", \"source\": \"s\\\"\\u00e4\",\n  \"poisson_ratio\": 0.25,\n"
                                "  \"density_kg_m3\": 9e2, \"model\": \"prony\",\n  \"terms\": [\n    " TERM(
                                    "1e-3", "1e6") ",\n    " TERM("1", "2.5") "\n  ],\n"
                                                                              "  \"equilibrium_modulus_pa\": 1\n}";

/* Whatever the bytes: a material, or a refusal that names the file and touches nothing. */
static int check_any_bytes(const char *path, const char *bytes, size_t length, int number)
{
    restitute_error error = {-99, "old"};
    restitute_material *material = UNTOUCHED;
    write_bytes(path, bytes, length);
    const int status = restitute_material_read(path, &material, NULL, &error);
    CHECK(status == error.status, "case %d", number);
    if (status == RESTITUTE_OK) {
        CHECK(restitute_material_modulus(material, 1e-9) >= 0, "case %d", number);
        restitute_material_destroy(material);
    } else {
        CHECK(status == RESTITUTE_ERROR_FORMAT || status == RESTITUTE_ERROR_DOMAIN || status == RESTITUTE_ERROR_FILE,
              "case %d: status %d (%s)", number, status, error.message);
        CHECK(material == UNTOUCHED, "case %d: touched", number);
        CHECK(strstr(error.message, path), "case %d: %s", number, error.message);
    }
    return status;
}

static void binary_garbage(void **state)
{
    (void)state;
    uint64_t seed = 30;
    char bytes[600];
    for (int number = 0; number < 500; number++) {
        const size_t length = 1 + (size_t)random_below(&seed, sizeof bytes - 1);
        for (size_t i = 0; i < length; i++)
            bytes[i] = (char)random_bits(&seed);
        const char *path = number % 2 ? JSON : CSV;
        CHECK(check_any_bytes(path, bytes, length, number) == RESTITUTE_ERROR_FORMAT, "case %d", number);
    }
}

/* An object is complete only with its last brace. */
static void truncated_json(void **state)
{
    (void)state;
    const size_t whole = sizeof rich_json - 1;
    for (size_t length = 0; length < whole; length++)
        CHECK(check_any_bytes(JSON, rich_json, length, (int)length) == RESTITUTE_ERROR_FORMAT, "%zu bytes", length);
    assert_int_equal(check_any_bytes(JSON, rich_json, whole, 0), RESTITUTE_OK);
}

static void changed_bytes(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (int number = 0; number < 2000; number++) {
        char bytes[sizeof rich_json];
        memcpy(bytes, rich_json, sizeof bytes);
        for (int i = 0; i < 1 + number % 3; i++) {
            const int place = random_below(&seed, sizeof bytes - 1);
            bytes[place] = number % 2 ? (char)random_bits(&seed) : rich_json[random_below(&seed, sizeof bytes - 1)];
        }
        check_any_bytes(JSON, bytes, sizeof bytes - 1, number);
    }
}

static void deep_nesting(void **state)
{
    (void)state;
    const size_t depth = 200000;
    char *text = malloc(depth + 1);
    CHECK(text != NULL, "no memory");
    memset(text, '[', depth);
    text[depth] = '\0';
    write_text(JSON, text);
    free(text);
    check_refused(JSON, FORMAT, (const char *[]){JSON, NULL}, "200000 brackets");
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

#define TEST(function) cmocka_unit_test_teardown(function, remove_files)

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
        TEST(unknown_and_repeated_keys),
        TEST(missing_keys),
        TEST(wrong_types),
        TEST(line_of_a_term),
        TEST(not_json),
        TEST(values_out_of_range),
        TEST(values_beyond_double),
        TEST(refused_csv),
        TEST(refused_prony_csv),
        TEST(prony_csv_is_a_file),
        TEST(unreadable_files),
        TEST(endless_files),
        TEST(other_extensions),
        TEST(null_arguments),
        TEST(an_info_of_another_size_is_refused_and_not_touched),
        TEST(binary_garbage),
        TEST(truncated_json),
        TEST(changed_bytes),
        TEST(deep_nesting),
        TEST(comma_locale),
    };
    return cmocka_run_group_tests_name("files: materials", tests, NULL, NULL);
}
