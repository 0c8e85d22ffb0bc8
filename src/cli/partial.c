/* Interrupted runs: begin, resume, commit.
 * SPDX-License-Identifier: BSD-3-Clause */
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

/* The settings in that file are those of this run; in a record they are the member "settings". */
static bool same_settings(const char *path, const char *option, const json_t *settings_object, struct reason *why)
{
    json_error_t error;
    json_t *file = json_load_file(path, 0, &error), *now = json_deep_copy(settings_object);
    json_t *inner = json_object_get(file, "settings"), *before = inner ? inner : file;
    const char *key;
    json_t *value;
    bool same = before != NULL;
    if (!same) refuse(why, "%.200s: cannot be read: %.150s", path, error.text);
    json_object_foreach(now, key, value)
    {
        if (!same) break;
        /* Compared as text: a real such as 1.0 and the integer 1 are the same number here. */
        const json_t *old = json_object_get(before, key);
        char *texts[2] = {json_dumps(value, JSON_ENCODE_ANY | JSON_SORT_KEYS | JSON_REAL_PRECISION(17)),
                          old ? json_dumps(old, JSON_ENCODE_ANY | JSON_SORT_KEYS | JSON_REAL_PRECISION(17)) : NULL};
        if (!texts[0] || !texts[1] || strcmp(texts[0], texts[1]) != 0)
            same = refuse(why, "%s: %s of this run differs from that of %.200s", option, key, path);
        free(texts[0]);
        free(texts[1]);
    }
    json_decref(file);
    json_decref(now);
    return same;
}

/* The columns are those that this run writes. */
static bool same_columns(const struct rst_csv *csv, const char *path, const struct cases *cases, struct reason *why)
{
    const size_t wanted = cases->columns + ROW_NUMBERS + 2, found = rst_csv_columns(csv);
    if (found != wanted) return refuse(why, "%.200s: has %zu columns: must be %zu", path, found, wanted);
    for (size_t k = 0; k < wanted; k++)
        if (strcmp(rst_csv_name(csv, k), row_column_name(cases, k)) != 0)
            return refuse(why, "%.200s: column %zu is \"%.64s\": must be %.64s", path, k + 1, rst_csv_name(csv, k),
                          row_column_name(cases, k));
    return true;
}

/* The cells of a row are those of the case. */
static bool same_case(const struct rst_csv *csv, size_t row, const struct cases *cases, size_t number)
{
    bool same = number < cases->rows;
    for (size_t k = 0; k < cases->columns && same; k++)
        same = strcmp(rst_csv_cell(csv, row, k), cases_cell(cases, number, k)) == 0;
    return same;
}

/* The rows done are these cases from number `first` on; `count` counts them. */
static bool read_done(const char *path, const struct cases *cases, const struct settings *settings, struct row *rows,
                      size_t first, size_t *count, struct reason *why)
{
    struct rst_csv *csv;
    restitute_error error;
    struct reason inner;
    if (rst_csv_read(path, RST_BYTES_OF_TABLE, &csv, &error) < 0) return refuse(why, "%s", error.message);
    bool good = same_columns(csv, path, cases, why);
    for (size_t i = 0; i < rst_csv_rows(csv) && good; i++) {
        if (!same_case(csv, i, cases, first + i))
            good = refuse(&inner, "%s",
                          settings->text[TEXT_JOIN] ? "is not the next shard: give all, in their order"
                                                    : "does not belong to these cases; remove it to start anew");
        else
            good = row_read(csv, i, cases->columns, settings->solver.method, &rows[first + i], &inner);
        if (good)
            *count = i + 1;
        else
            refuse(why, "%.200s line %zu (row %zu): %s", path, rst_csv_line(csv, i), i + 1, inner.text);
    }
    rst_csv_destroy(csv);
    return good;
}

bool partial_join(const char *path, const struct cases *cases, const struct settings *settings,
                  const json_t *settings_object, struct row *rows, size_t first, size_t *count, struct reason *why)
{
    char *record = path_beside(path, ".meta.json");
    const bool good = same_settings(record, "--join", settings_object, why) &&
                      read_done(path, cases, settings, rows, first, count, why);
    free(record);
    return good;
}

bool partial_begin(const char *path, const struct cases *cases, const struct settings *settings,
                   const json_t *settings_object, struct partial *partial, struct row *rows, size_t *done,
                   struct reason *why)
{
    if (!unfinished_open(path, settings->resume, &partial->rows, why)) return false;
    partial->settings_path = path_beside(path, ".partial.json");
    const bool fresh = partial->rows.empty;
    const bool good =
        fresh ? begin_new(partial, cases, settings_object, why)
              : same_settings(partial->settings_path, "--resume", settings_object, why) &&
                    unfinished_cut(&partial->rows, why) &&
                    (partial->rows.empty ? begin_new(partial, cases, settings_object, why)
                                         : read_done(partial->rows.path, cases, settings, rows, 0, done, why));
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
