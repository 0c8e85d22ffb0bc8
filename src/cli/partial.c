/* Interrupted runs: begin, resume, commit.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include "partial.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "provenance.h"

/* Settings and header of a file in which nothing is done. */
static bool begin_new(struct partial *partial, const struct cases *cases, const json_t *settings_object,
                      struct reason *why)
{
    struct output header;
    if (!provenance_write(partial->settings_path, json_deep_copy(settings_object), why) ||
        !output_open(NULL, &header, why))
        return false;
    row_write_header(header.stream, cases);
    return unfinished_append(&partial->rows, &header, why);
}

/* The settings of the interrupted run are those of this one. */
static bool same_settings(const struct partial *partial, const json_t *settings_object, struct reason *why)
{
    json_error_t error;
    json_t *before = json_load_file(partial->settings_path, 0, &error), *now = json_deep_copy(settings_object);
    const char *key;
    json_t *value;
    bool same = before != NULL;
    if (!same) refuse(why, "%.200s: cannot be read: %.150s", partial->settings_path, error.text);
    json_object_foreach(now, key, value)
    {
        if (!same) break;
        /* Compared as text: a real such as 1.0 and the integer 1 are the same number here. */
        const json_t *old = json_object_get(before, key);
        char *texts[2] = {json_dumps(value, JSON_ENCODE_ANY | JSON_SORT_KEYS | JSON_REAL_PRECISION(17)),
                          old ? json_dumps(old, JSON_ENCODE_ANY | JSON_SORT_KEYS | JSON_REAL_PRECISION(17)) : NULL};
        if (!texts[0] || !texts[1] || strcmp(texts[0], texts[1]) != 0)
            same = refuse(why, "--resume: %s of this run differs from that of %.200s", key, partial->settings_path);
        free(texts[0]);
        free(texts[1]);
    }
    json_decref(before);
    json_decref(now);
    return same;
}

/* The rows done are the first rows of these cases. */
static bool read_done(const char *path, const struct cases *cases, const struct settings *settings, struct row *rows,
                      size_t *done, struct reason *why)
{
    restitute_csv *csv;
    restitute_error error;
    if (restitute_csv_read(path, &csv, &error) < 0) return refuse(why, "%s", error.message);
    const size_t count = restitute_csv_rows(csv);
    bool good = count <= cases->rows && restitute_csv_columns(csv) == cases->columns + ROW_NUMBERS + 2;
    for (size_t i = 0; i < count && good; i++) {
        for (size_t k = 0; k < cases->columns && good; k++)
            good = strcmp(restitute_csv_cell(csv, i, k), cases_cell(cases, i, k)) == 0;
        if (good && (good = row_read(csv, i, cases->columns, settings->solver.method, &rows[i]))) *done = i + 1;
    }
    restitute_csv_destroy(csv);
    return good ? true
                : refuse(why, "%.200s line %zu: does not belong to these cases; remove it to start anew", path,
                         *done + 2);
}

bool partial_begin(const char *path, const struct cases *cases, const struct settings *settings,
                   const json_t *settings_object, struct partial *partial, struct row *rows, size_t *done,
                   struct reason *why)
{
    if (!unfinished_open(path, settings->resume, &partial->rows, why)) return false;
    partial->settings_path = path_beside(path, ".partial.json");
    const bool fresh = partial->rows.empty;
    const bool good = fresh
                          ? begin_new(partial, cases, settings_object, why)
                          : same_settings(partial, settings_object, why) && unfinished_cut(&partial->rows, why) &&
                                (partial->rows.empty ? begin_new(partial, cases, settings_object, why)
                                                     : read_done(partial->rows.path, cases, settings, rows, done, why));
    if (!good && fresh) partial_remove(partial);
    if (!good) partial_leave(partial);
    return good;
}

bool partial_commit(struct partial *partial, const char *path, size_t rows, struct reason *why)
{
    if (!unfinished_commit(&partial->rows, path, rows + 1, why)) return false;
    unlink(partial->settings_path);
    partial_leave(partial);
    return true;
}

void partial_remove(struct partial *partial)
{
    if (partial->settings_path) unlink(partial->settings_path);
    unfinished_remove(&partial->rows);
    partial_leave(partial);
}

void partial_leave(struct partial *partial)
{
    unfinished_leave(&partial->rows);
    free(partial->settings_path);
    partial->settings_path = NULL;
}
