/* Material files that the tests write and read.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_MATERIAL_FILES_H
#define TEST_MATERIAL_FILES_H

#include <string.h>
#include <unistd.h>

#include <restitute/files.h>

#include "bytes.h"

/* The files of the tests, all in the current directory; the teardown removes them. Their names
 * begin with STEM, which a test defines. */
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

static inline void write_text(const char *path, const char *text)
{
    write_bytes(path, text, strlen(text));
}

static inline int remove_files(void **state)
{
    (void)state;
    static const char *const paths[] = {JSON, CSV, FOLDER_JSON, FOLDER_CSV, OTHER, FIFO, FIFO_JSON};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        remove(paths[i]);
    rmdir(FOLDER);
    return 0;
}

static inline restitute_material *read_material(const char *path, restitute_material_info *info)
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

static inline restitute_material *read_json(const char *text, restitute_material_info *info)
{
    write_text(JSON, text);
    return read_material(JSON, info);
}

#define TEST(function) cmocka_unit_test_teardown(function, remove_files)

#endif
