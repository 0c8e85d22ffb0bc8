/* Interrupted runs: begin, resume, commit.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "partial.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output.h"
#include "provenance.h"

static void release(struct partial *partial)
{
    free(partial->rows_path);
    free(partial->settings_path);
    memset(partial, 0, sizeof *partial);
}

/* O_EXCL: two runs into one place, or a forgotten --resume, must not destroy what is there. */
static bool begin_new(struct partial *partial, const struct cases *cases, const json_t *settings_object,
                      struct reason *why)
{
    const int file = open(partial->rows_path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (file < 0 && errno == EEXIST)
        return refuse(why, "%.200s is left from an interrupted run: continue it with --resume, or remove it",
                      partial->rows_path);
    partial->stream = file < 0 ? NULL : fdopen(file, "w");
    if (!partial->stream) return refuse(why, "%.200s: cannot be written: %s", partial->rows_path, strerror(errno));
    if (!provenance_write(partial->settings_path, json_deep_copy(settings_object), why)) {
        fclose(partial->stream);
        unlink(partial->rows_path);
        return false;
    }
    row_write_header(partial->stream, cases);
    return true;
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

/* Cut off a last line that was not written to its end. Returns the length left, -1 if that fails. */
static long cut_last_line(const char *path)
{
    FILE *stream = fopen(path, "rb");
    long length = 0, position = 0;
    if (!stream) return -1;
    for (int c = getc(stream); c != EOF; c = getc(stream)) {
        position++;
        if (c == '\n') length = position;
    }
    fclose(stream);
    return truncate(path, length) == 0 ? length : -1;
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

static bool resume(struct partial *partial, const struct cases *cases, const struct settings *settings,
                   const json_t *settings_object, struct row *rows, size_t *done, struct reason *why)
{
    if (!same_settings(partial, settings_object, why)) return false;
    const long length = cut_last_line(partial->rows_path);
    if (length < 0) return refuse(why, "%.200s: cannot be continued: %s", partial->rows_path, strerror(errno));
    if (length > 0 && !read_done(partial->rows_path, cases, settings, rows, done, why)) return false;
    partial->stream = fopen(partial->rows_path, "a");
    if (!partial->stream) return refuse(why, "%.200s: cannot be continued: %s", partial->rows_path, strerror(errno));
    if (length == 0) row_write_header(partial->stream, cases);
    return true;
}

bool partial_begin(const char *path, const struct cases *cases, const struct settings *settings,
                   const json_t *settings_object, struct partial *partial, struct row *rows, size_t *done,
                   struct reason *why)
{
    struct stat status;
    partial->rows_path = path_with_suffix(path, ".partial");
    partial->settings_path = path_with_suffix(path, ".partial.json");
    const bool go_on = settings->resume && stat(partial->rows_path, &status) == 0;
    const bool good = go_on ? resume(partial, cases, settings, settings_object, rows, done, why)
                            : begin_new(partial, cases, settings_object, why);
    if (!good) release(partial);
    return good;
}

bool partial_commit(struct partial *partial, const char *path, struct reason *why)
{
    const bool done = output_rename(partial->stream, partial->rows_path, path, why);
    if (done) unlink(partial->settings_path);
    release(partial);
    return done;
}

void partial_remove(struct partial *partial)
{
    fclose(partial->stream);
    unlink(partial->rows_path);
    unlink(partial->settings_path);
    release(partial);
}

void partial_leave(struct partial *partial)
{
    fclose(partial->stream);
    release(partial);
}
