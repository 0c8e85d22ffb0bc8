/* Material files that are refused: every reason, and any bytes at all.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <restitute/files.h>

#define STEM "test_files_refusals"
#include "../support/material_files.h"
#include "../support/odd_files.h"
#include "../support/random.h"
#include "../support/sized.h"

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
    for (; *words; words++)
        CHECK(strstr(error.message, *words) != NULL, "%s: no \"%s\" in \"%s\"", what, *words, error.message);
    CHECK(restitute_material_read(path, &material, NULL, NULL) == expected, "%s: without info and error", what);
    CHECK(material == UNTOUCHED, "%s: the material was touched", what);
}
#define REFUSED(what, path, status, ...) check_refused(path, status, (const char *[]){__VA_ARGS__, NULL}, what)

struct refusal {
    const char *what, *text, *words[5];
};

static void check_refusals(const char *path, int status, const struct refusal *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *words[7] = {path};
        memcpy(words + 1, cases[i].words, sizeof cases[i].words);
        write_text(path, cases[i].text);
        check_refused(path, status, words, cases[i].what);
    }
}
#define CHECK_REFUSALS(path, status, cases) check_refusals(path, status, cases, sizeof(cases) / sizeof *(cases))

enum { FORMAT = RESTITUTE_ERROR_FORMAT, RANGE = RESTITUTE_ERROR_DOMAIN, FAILED = RESTITUTE_ERROR_FILE };

/* Materials that are right but for what is added. */
#define ELASTIC(more) HEAD("elastic") ", \"modulus_pa\": 1" more "}"
#define PRONY(terms, more) HEAD("prony") ", \"terms\": [" terms "]" more "}"

static void unknown_and_repeated_keys(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"unknown key", ELASTIC(",\n\"colour\": 3"), {"line 2", "colour"}},
        {"key in other letters", HEAD("elastic") ",\n\"modulus_PA\": 1}", {"line 2", "modulus_PA"}},
        {"key of another model", ELASTIC(",\n\n\"viscosity_pa_s\": 1"), {"line 3", "viscosity_pa_s", "elastic"}},
        {"terms of an elastic solid", ELASTIC(",\n\"terms\": []"), {"line 2", "terms"}},
        {"modulus_pa of prony", PRONY(TERM("1", "1"), ",\n\"modulus_pa\": 1"), {"line 2", "modulus_pa", "prony"}},
        {"unknown key in a term",
         PRONY("\n" TERM("1", "1") ",\n{\"tau_s\": 2, \"modulus_pa\": 1, \"why\": 0}", ""),
         {"line 3", "why"}},
        {"key in a text with quotes",
         "{\"name\": \"a \\\" \\\"colour\\\": \", \"poisson_ratio\": 0, \"model\": \"elastic\", \"modulus_pa\": "
         "1,\n\"colour\": 3}",
         {"line 2", "colour"}},
        {"repeated key", ELASTIC(",\n\"modulus_pa\": 1"), {"line 2", "modulus_pa"}},
        {"repeated text", ELASTIC(",\n\"name\": \"n\""), {"line 2", "name"}},
        {"repeated key in a term",
         HEAD("prony") ", \"terms\": [\n{\"tau_s\": 2, \"modulus_pa\": 1, \"tau_s\": 2}]}",
         {"line 2", "tau_s"}},
        {"terms and prony_csv",
         HEAD("prony") ", \"terms\": [" TERM("1", "1") "], \"prony_csv\": \"" CSV "\"}",
         {"terms", "prony_csv"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, cases);
}

static void missing_keys(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"name", "{\"model\": \"elastic\", \"poisson_ratio\": 0.5, \"modulus_pa\": 1}", {"\"name\""}},
        {"model", "{\"name\": \"n\", \"poisson_ratio\": 0.5, \"modulus_pa\": 1}", {"\"model\""}},
        {"nu", "{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1}", {"\"poisson_ratio\""}},
        {"elastic", HEAD("elastic") "}", {"\"modulus_pa\""}},
        {"standard 1", HEAD("standard_solid") ", \"modulus2_pa\": 1, \"viscosity_pa_s\": 1}", {"modulus1_pa"}},
        {"standard 2", HEAD("standard_solid") ", \"modulus1_pa\": 1, \"viscosity_pa_s\": 1}", {"modulus2_pa"}},
        {"standard 3", HEAD("standard_solid") ", \"modulus1_pa\": 1, \"modulus2_pa\": 1}", {"viscosity_pa_s"}},
        {"Kelvin-Voigt 1", HEAD("kelvin_voigt") ", \"viscosity_pa_s\": 1}", {"modulus1_pa"}},
        {"Kelvin-Voigt 2", HEAD("kelvin_voigt") ", \"modulus1_pa\": 1}", {"viscosity_pa_s"}},
        {"Maxwell 1", HEAD("maxwell") ", \"viscosity_pa_s\": 1}", {"modulus_pa"}},
        {"Maxwell 2", HEAD("maxwell") ", \"modulus_pa\": 1}", {"viscosity_pa_s"}},
        {"prony", HEAD("prony") ", \"equilibrium_modulus_pa\": 1}", {"terms", "prony_csv"}},
        {"tau_s", HEAD("prony") ",\n\"terms\": [{\"modulus_pa\": 1}]}", {"line 2", "tau_s"}},
        {"modulus of a term", HEAD("prony") ",\n\"terms\": [{\"tau_s\": 1}]}", {"line 2", "modulus_pa"}},
        {"no keys", "{}", {"no key"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, cases);
}

static void wrong_types(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"an array", "[]", {"object"}},
        {"a text", "\"elastic\"", {NULL}},
        {"name", "{\"name\": 1, \"model\": \"elastic\", \"poisson_ratio\": 0, \"modulus_pa\": 1}", {"line 1", "name"}},
        {"model", "{\"name\": \"n\",\n\"model\": null, \"poisson_ratio\": 0}", {"line 2", "model"}},
        {"source", ELASTIC(",\n\"source\": [\"s\"]"), {"line 2", "source"}},
        {"nu", "{\"name\": \"n\", \"model\": \"elastic\",\n\"poisson_ratio\": \"0.5\"}", {"line 2", "poisson_ratio"}},
        {"modulus as text", HEAD("elastic") ",\n\"modulus_pa\": \"1\"}", {"line 2", "modulus_pa", "number"}},
        {"modulus true", HEAD("elastic") ",\n\"modulus_pa\": true}", {"line 2", "modulus_pa", "number"}},
        {"modulus null", HEAD("elastic") ",\n\"modulus_pa\": null}", {"line 2", "modulus_pa", "number"}},
        {"density", ELASTIC(",\n\"density_kg_m3\": {}"), {"line 2", "density_kg_m3"}},
        {"terms", HEAD("prony") ",\n\"terms\": " TERM("1", "1") "}", {"line 2", "terms"}},
        {"no terms", HEAD("prony") ",\n\"terms\": []}", {"line 2", "terms"}},
        {"tau as text", HEAD("prony") ",\n\"terms\": [\n" TERM("\"1\"", "1") "]}", {"line 3", "tau_s", "number"}},
        {"prony_csv", HEAD("prony") ",\n\"prony_csv\": 1}", {"line 2", "prony_csv"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, cases);
}

/* The line named is that of the wrong term, also if the wrong term is no object. */
static void line_of_a_term(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"a number", PRONY("\n" TERM("1", "1") ",\n5,\n" TERM("2", "1"), ""), {"line 3"}},
        {"a pair", PRONY("\n" TERM("1", "1") ",\n[2, 1],\n" TERM("3", "1"), ""), {"line 3"}},
        {"the last", PRONY("\n" TERM("1", "1") ",\nnull", ""), {"line 3"}},
        {"the first", HEAD("prony") ", \"terms\": [\n\"x\",\n" TERM("1", "1") "]}", {"line 2"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, cases);
}

static void not_json(void **state)
{
    (void)state;
    static const struct refusal cases[] = {
        {"empty file", "", {NULL}},
        {"blanks", "\n \n", {NULL}},
        {"NaN", HEAD("elastic") ",\n\"modulus_pa\": NaN}", {"line 2"}},
        {"nan", HEAD("elastic") ",\n\"modulus_pa\": nan}", {"line 2"}},
        {"infinity", HEAD("elastic") ",\n\"modulus_pa\": Infinity}", {"line 2"}},
        {"hexadecimal", HEAD("elastic") ",\n\"modulus_pa\": 0x10}", {"line 2"}},
        {"decimal comma", HEAD("elastic") ",\n\"modulus_pa\": 1,5}", {"line 2"}},
        {"comma at the end", HEAD("elastic") ",\n\"modulus_pa\": 1,\n}", {"line 3"}},
        {"comment", "// steel\n" ELASTIC(""), {"line 1"}},
        {"single quotes", "{'name': 'n'}", {"line 1"}},
        {"two objects", HEAD("elastic") ", \"modulus_pa\": 1}\n{}", {"line 2"}},
        {"a CSV table", "tau_s,G_Pa\n1,1\n", {"line 1"}},
        {"wrong UTF-8", "{\"name\": \"\xff\xfe\"}", {"line 1"}},
        {"a zero in the name", "{\"name\": \"a\\u0000b\"}", {"line 1"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, cases);
}

static void values_out_of_range(void **state)
{
    (void)state;
#define NU(value) "{\"name\": \"n\", \"model\": \"elastic\", \"modulus_pa\": 1,\n\"poisson_ratio\": " value "}"
    static const struct refusal cases[] = {
        {"nu < 0", NU("-0.01"), {"line 2", "poisson_ratio", "-0.01", "[0, 0.5]"}},
        {"nu > 0.5", NU("0.5000001"), {"line 2", "poisson_ratio", "0.5000001", "[0, 0.5]"}},
        {"nu far out", NU("-1e300"), {"line 2", "poisson_ratio", "-1e+300", "[0, 0.5]"}},
        {"G = 0", HEAD("elastic") ",\n\"modulus_pa\": 0}", {"line 2", "modulus_pa = 0", "> 0"}},
        {"G < 0", HEAD("elastic") ",\n\"modulus_pa\": -2.5}", {"line 2", "modulus_pa = -2.5", "> 0"}},
        {"G tiny", HEAD("elastic") ",\n\"modulus_pa\": 1e-999}", {"line 2", "modulus_pa", "> 0"}},
        {"density 0", ELASTIC(",\n\"density_kg_m3\": 0"), {"line 2", "density_kg_m3 = 0", "> 0"}},
        {"density < 0", ELASTIC(",\n\"density_kg_m3\": -1"), {"line 2", "-1", "> 0"}},
        {"G1 < 0",
         HEAD("standard_solid") ",\n\"modulus1_pa\": -1, \"modulus2_pa\": 1, \"viscosity_pa_s\": 1}",
         {"line 2", "modulus1_pa = -1", "> 0"}},
        {"G2 = 0",
         HEAD("standard_solid") ", \"modulus1_pa\": 1,\n\"modulus2_pa\": 0, \"viscosity_pa_s\": 1}",
         {"line 2", "modulus2_pa = 0", "> 0"}},
        {"eta = 0",
         HEAD("kelvin_voigt") ", \"modulus1_pa\": 1,\n\"viscosity_pa_s\": 0}",
         {"line 2", "viscosity_pa_s = 0", "> 0"}},
        {"eta < 0",
         HEAD("maxwell") ", \"modulus_pa\": 1,\n\"viscosity_pa_s\": -3}",
         {"line 2", "viscosity_pa_s = -3", "> 0"}},
        {"G_inf < 0",
         PRONY(TERM("1", "1"), ",\n\"equilibrium_modulus_pa\": -1"),
         {"line 2", "equilibrium_modulus_pa = -1", ">= 0"}},
        {"eta_inf < 0",
         PRONY(TERM("1", "1"), ",\n\"parallel_viscosity_pa_s\": -1"),
         {"line 2", "parallel_viscosity_pa_s = -1", ">= 0"}},
        {"tau = 0", PRONY("\n" TERM("1", "1") ",\n" TERM("0", "1"), ""), {"line 3", "tau_s = 0", "> 0"}},
        {"G_k < 0", PRONY("\n" TERM("1", "1") ",\n" TERM("2", "-7"), ""), {"line 3", "modulus_pa = -7", "> 0"}},
        {"two equal times",
         PRONY("\n" TERM("0.25", "1") ",\n" TERM("1", "1") ",\n" TERM("25e-2", "2"), ""),
         {"line 4", "line 2", "tau_s = 0.25"}},
        {"empty name",
         "{\"name\": \"\", \"model\": \"elastic\", \"poisson_ratio\": 0, \"modulus_pa\": 1}",
         {"line 1", "name"}},
    };
#undef NU
    CHECK_REFUSALS(JSON, RANGE, cases);
    static const struct refusal models[] = {
        {"unknown model",
         "{\"name\": \"n\",\n\"model\": \"rigid\", \"poisson_ratio\": 0}",
         {"line 2", "rigid", "elastic", "prony"}},
        {"model in capitals", HEAD("Elastic") ", \"modulus_pa\": 1}", {"line 1", "Elastic", "elastic"}},
    };
    CHECK_REFUSALS(JSON, FORMAT, models);
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
        {"empty file", "", {"empty"}},
        {"comments alone", "# tau_s,G_Pa\n", {"empty"}},
        {"no rows", "tau_s,G_Pa\n", {"no rows"}},
        {"no header", "1,2\n3,4\n", {"tau_s", "G_Pa"}},
        {"unknown column", "tau_s,G_Pa,note\n1,1,x\n", {"note"}},
        {"column in other letters", "tau_s,g_pa\n1,1\n", {"g_pa"}},
        {"one column", "tau_s\n1\n", {"G_Pa"}},
        {"the other column", "G_Pa\n1\n", {"tau_s"}},
        {"repeated column", "tau_s,G_Pa,tau_s\n1,1,1\n", {"line 1", "tau_s", "twice"}},
        {"ragged row", "tau_s,G_Pa\n1,1\n2\n", {"line 3", "1 cell", "2 columns"}},
        {"long row", "# c\ntau_s,G_Pa\n1,1,1\n", {"line 3", "3 cells", "2 columns"}},
        {"empty cell", "tau_s,G_Pa\n1,\n", {"line 2", "G_Pa", "> 0"}},
        {"text", "tau_s,G_Pa\n1,1\n#\n2,1.0x\n", {"line 4", "G_Pa", "1.0x", "> 0"}},
        {"nan", "tau_s,G_Pa\nnan,1\n", {"line 2", "tau_s", "nan", "> 0"}},
        {"decimal comma", "tau_s,G_Pa\n\"1,5\",1\n", {"line 2", "tau_s", "1,5"}},
        {"stray quote", "tau_s,G_Pa\n1,1\"\n", {"line 2"}},
        {"a JSON file", ELASTIC(""), {NULL}},
    };
    CHECK_REFUSALS(CSV, FORMAT, cases);
    static const struct refusal values[] = {
        {"time beyond its range", "tau_s,G_Pa\n1e31,1\n", {CSV ": relaxation_time[0]", "[1e-30, 1e+30]"}},
        {"modulus beyond its range", "tau_s,G_Pa\n1,1\n2,1e-31\n", {CSV ": modulus[1]", "[1e-30, 1e+30]"}},
        {"inf", "tau_s,G_Pa\ninf,1\n", {"line 2", "tau_s", "inf", "finite"}},
        {"1e400", "tau_s,G_Pa\n1,1e400\n", {"line 2", "G_Pa", "1e400", "finite"}},
        {"1e-400", "tau_s,G_Pa\n1,1e-400\n", {"line 2", "G_Pa", "1e-400", "> 0"}},
        {"tau = 0", "tau_s,G_Pa\n1,1\n0,1\n", {"line 3", "tau_s = 0", "> 0"}},
        {"tau < 0", "tau_s,G_Pa\n-1.5,1\n", {"line 2", "tau_s = -1.5", "> 0"}},
        {"G = 0", "tau_s,G_Pa\n1,0\n", {"line 2", "G_Pa = 0", "> 0"}},
        {"G < 0", "G_Pa,tau_s\n-2,1\n", {"line 2", "G_Pa = -2", "> 0"}},
        {"two equal times", "tau_s,G_Pa\n0.5,1\n\n2,1\n5e-1,3\n", {"line 5", "line 2", "tau_s = 0.5"}},
    };
    CHECK_REFUSALS(CSV, RANGE, values);
}

/* A fault in the CSV of a JSON file is named by the CSV and its line. */
static void refused_prony_csv(void **state)
{
    (void)state;
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" CSV "\"}");
    REFUSED("missing", JSON, FAILED, CSV);
    write_text(CSV, "");
    REFUSED("empty", JSON, FORMAT, CSV, "empty");
    write_text(CSV, "tau_s,G_Pa\n1,1\n2,-3\n");
    REFUSED("negative", JSON, RANGE, CSV, "line 3", "G_Pa = -3", "> 0");
    write_text(CSV, "tau_s,G_Pa\n1,1\n1,3\n");
    REFUSED("two equal times", JSON, RANGE, CSV, "line 3", "line 2", "tau_s = 1");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \".\"}");
    REFUSED("a directory", JSON, FAILED, NULL);
    write_text(JSON, HEAD("prony") ",\n\"prony_csv\": \"\"}");
    REFUSED("no name", JSON, RANGE, JSON, "line 2", "prony_csv");
}

/* "-" is a file's name here: the standard input belongs to the program. */
static void prony_csv_is_a_file(void **state)
{
    (void)state;
    write_text(CSV, "tau_s,G_Pa\n1,1\n");
    CHECK(freopen(CSV, "rb", stdin) != NULL, "cannot redirect the standard input");
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"-\"}");
    REFUSED("prony_csv \"-\"", JSON, FAILED, NULL);
}

static void unreadable_files(void **state)
{
    (void)state;
    REFUSED("missing", STEM "_nowhere.json", FAILED, STEM "_nowhere.json");
    REFUSED("missing", STEM "_nowhere.csv", FAILED, STEM "_nowhere.csv");
    CHECK(mkdir(FOLDER, 0777) == 0, "cannot make %s", FOLDER);
    REFUSED("a directory", FOLDER, FAILED, FOLDER);
    REFUSED("missing in it", FOLDER "/none.json", FAILED, "none.json");
    write_text(JSON, ELASTIC(""));
    CHECK(chmod(JSON, 0) == 0, "cannot change the mode of %s", JSON);
    FILE *open = fopen(JSON, "rb");
    if (open) /* the superuser may read anything */
        fclose(open);
    else
        REFUSED("not permitted", JSON, FAILED, JSON);
    char path[5000];
    memset(path, 'x', sizeof path);
    strcpy(path + sizeof path - 10, "/end.json");
    REFUSED("endless path", path, FAILED, "end.json");
    REFUSED("path like a format", "%s%n.json", FAILED, "%s%n.json");
}

/* A file named in a JSON file is read like the JSON file itself: neither may block the reader or
 * fill its memory. */
static void endless_files(void **state)
{
    (void)state;
    const char *const regular = "not a regular file", *const most = "67108864";
    make_fifo(FIFO);
    REFUSED("a FIFO", FIFO, FAILED, FIFO, regular);
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" FIFO "\"}");
    REFUSED("names a FIFO", JSON, FAILED, FIFO, regular);
    write_text(JSON, HEAD("prony") ", \"prony_csv\": \"/dev/zero\"}");
    REFUSED("names a device", JSON, FAILED, "/dev/zero", regular);
    if (make_sparse(CSV, (1 << 26) + 1)) {
        REFUSED("too large", CSV, FAILED, CSV, "67108865", most);
        write_text(JSON, HEAD("prony") ", \"prony_csv\": \"" CSV "\"}");
        REFUSED("names a large file", JSON, FAILED, CSV, "67108865", most);
    }
    if (make_sparse(CSV, 1 << 26)) REFUSED("the largest size", CSV, FORMAT, CSV, "NUL");
    make_fifo(FIFO_JSON);
    REFUSED("a JSON file that is one", FIFO_JSON, FAILED, FIFO_JSON, regular);
}

static void other_extensions(void **state)
{
    (void)state;
    write_text(OTHER, "tau_s,G_Pa\n1,1\n");
    REFUSED(".txt", OTHER, FORMAT, OTHER, ".json", ".csv");
    REFUSED("empty path", "", FORMAT, NULL);
    REFUSED("standard input", "-", FORMAT, NULL);
    REFUSED("no extension", "json", FORMAT, NULL);
}

static void null_arguments(void **state)
{
    (void)state;
    restitute_error error = {-99, "old"};
    restitute_material *material = UNTOUCHED;
    write_text(JSON, ELASTIC(""));
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
    write_text(JSON, ELASTIC(""));
    CHECK_SIZES(material_info, viscosity, place, &error,
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
    REFUSED("200000 brackets", JSON, FORMAT, JSON);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
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
    };
    return cmocka_run_group_tests_name("files: refusals", tests, NULL, NULL);
}
