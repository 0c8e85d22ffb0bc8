/* Many impacts: row after row, into OUT.partial, which becomes OUT at the end.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "batch.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "figure.h"
#include "output.h"
#include "partial.h"
#include "places.h"
#include "provenance.h"

/* Set by a signal, looked at between chunks of rows. */
static volatile sig_atomic_t interrupted;

static void on_signal(int number)
{
    (void)number;
    interrupted = 1;
}

bool batch_interrupted(void)
{
    return interrupted;
}

/* A signal that whoever started us chose to ignore, as nohup and a shell's background jobs do, stays ignored. */
static void catch_signal(int number)
{
    struct sigaction action, before;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    if (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(number, &action, NULL);
}

struct batch {
    const struct settings *settings;
    const struct batch_maker *maker; /* of the cases; NULL: from the settings */
    const char *path;                /* of the result; NULL: a stream */
    int stream;                      /* where rows go at once if it is a stream; -1: JSON waits for all of them */
    struct cases cases;
    struct materials materials;
    restitute_solver *solver;
    json_t *settings_object;
    struct row *rows;
    size_t done, failed;
    struct partial partial;
    double begin, last_tick;
    size_t resumed;            /* rows done before this run */
    size_t chunk, least_chunk; /* rows to be solved at once */
};

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A few times a second: progress to a terminal. */
static void tick(struct batch *batch, bool last)
{
    const double interval = 0.25, now = seconds_now();
    if (!last && now - batch->last_tick < interval) return;
    const bool first = batch->last_tick == 0;
    batch->last_tick = now;
    if (isatty(STDERR_FILENO) && !(first && last)) {
        const double left = (double)(batch->cases.rows - batch->done) * (now - batch->begin) /
                            (double)(batch->done > batch->resumed ? batch->done - batch->resumed : 1);
        fprintf(stderr, "\rrestitute: %zu of %zu rows, about %.0f s left %s", batch->done, batch->cases.rows, left,
                last ? "\n" : "");
        fflush(stderr);
    }
}

/* The first few rows that fail are named at once; the rest is in the column status. */
static void count_failure(struct batch *batch, size_t index)
{
    const size_t named = 5;
    if (batch->rows[index].solved) return;
    if (batch->failed++ < named && batch->cases.source)
        complain("%s line %zu (row %zu): %s", batch->cases.source, cases_line(&batch->cases, index), index + 1,
                 batch->rows[index].status);
    else if (batch->failed <= named)
        complain("grid row %zu: %s", index + 1, batch->rows[index].status);
}

static bool check_options(const struct settings *settings, struct reason *why)
{
    const char *const *text = (const char *const *)settings->text;
    if (text[TEXT_INPUT] && text[TEXT_GRID]) return refuse(why, "--input and --grid are both given: use one");
    if (settings->format == FORMAT_TEXT)
        return refuse(why, "--format = \"text\": must be csv or json with --input and --grid");
    if (text[TEXT_SEED] && !settings->sweep) return refuse(why, "--seed: needs the name of a figure");
    if (settings->contours && !text[TEXT_FIGURE]) return refuse(why, "--contours: needs --figure");
    if (text[TEXT_FIGURE] && text[TEXT_SHARD])
        return refuse(why, "--figure = %.200s: not with --shard; --join draws it", text[TEXT_FIGURE]);
    if (text[TEXT_JOIN] && (text[TEXT_SHARD] || output_is_stream(text[TEXT_OUTPUT])))
        return refuse(why, "--join: needs --output FILE, and no --shard");
    if (text[TEXT_JOIN] && settings->resume)
        return refuse(why, "--join: not with --resume; joined rows are in FILE.partial already");
    if (settings->resume && output_is_stream(text[TEXT_OUTPUT])) return refuse(why, "--resume: needs --output FILE");
    if (text[TEXT_FIGURE] && !figure_check(text[TEXT_FIGURE], why)) return false;
    return output_check(text[TEXT_OUTPUT], "--output", why);
}

/* Where rows go that need not wait for the others. */
static bool open_rows(struct batch *batch, struct reason *why)
{
    const struct settings *settings = batch->settings;
    struct output header;
    if (batch->path)
        return partial_begin(batch->path, &batch->cases, settings, batch->settings_object, &batch->partial, batch->rows,
                             &batch->done, why);
    if (settings->format == FORMAT_JSON) return true;
    batch->stream = output_open_stream(settings->text[TEXT_OUTPUT], why);
    if (batch->stream < 0 || !output_open(NULL, &header, why)) return false;
    row_write_header(header.stream, &batch->cases);
    return output_send(&header, batch->stream, settings->text[TEXT_OUTPUT], why);
}

/* Everything that can be refused is, before anything is written. */
static bool prepare(struct batch *batch, struct reason *why)
{
    const struct settings *settings = batch->settings;
    restitute_error error;
    if (!check_options(settings, why)) return false;
    if (batch->maker ? !batch->maker->make(batch->maker->context, &batch->cases, why)
                     : !cases_open(settings, &batch->cases, why))
        return false;
    if (!cases_check(&batch->cases, settings, why)) return false;
    if (settings->text[TEXT_FIGURE] && !batch->maker && !figure_check_cases(&batch->cases, settings->contours, why))
        return false;
    if (settings->values.material && !materials_get(&batch->materials, settings->values.material, why)) return false;
    if (restitute_solver_create(&settings->solver, &batch->solver, &error) < 0) return refuse(why, "%s", error.message);
    batch->settings_object = provenance_settings(settings, &batch->cases, &batch->materials);
    cases_shard(&batch->cases, settings->shard, settings->shards);
    if (batch->cases.rows == 0) return refuse(why, "--shard = %.60s: has no rows", settings->text[TEXT_SHARD]);
    batch->rows = allocate(batch->cases.rows, sizeof *batch->rows);
    return places_check_settings(settings, &batch->materials, why) && open_rows(batch, why);
}

/* A chunk has a row for every thread, and as many more as take about a tenth of a second: whoever looks on or
 * interrupts sees rows, not chunks. */
static void adapt_chunk(struct batch *batch, double seconds)
{
    const double wanted = 0.1;
    const size_t most = 16384;
    if (seconds < wanted / 2 && batch->chunk < most) batch->chunk *= 2;
    if (seconds > wanted * 2) batch->chunk /= 2;
    if (batch->chunk < batch->least_chunk) batch->chunk = batch->least_chunk;
}

static size_t threads_of(const struct settings *settings)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    if (settings->solver.threads > 0) return (size_t)settings->solver.threads;
    return processors > 0 ? (size_t)processors : 1;
}

/* Solved rows to where they belong. */
static bool write_rows(struct batch *batch, size_t count, struct reason *why)
{
    struct output lines;
    if (!batch->path && batch->stream < 0) return true;
    if (!output_open(NULL, &lines, why)) return false;
    for (size_t i = batch->done; i < batch->done + count; i++)
        row_write(lines.stream, &batch->cases, i, &batch->rows[i]);
    return batch->path ? unfinished_append(&batch->partial.rows, &lines, why)
                       : output_send(&lines, batch->stream, batch->settings->text[TEXT_OUTPUT], why);
}

/* The next rows, from the cases to the file. */
static bool solve_chunk(struct batch *batch, struct reason *why)
{
    const size_t left = batch->cases.rows - batch->done, count = batch->chunk < left ? batch->chunk : left;
    const double begin = seconds_now();
    rows_solve(&batch->cases, batch->settings, &batch->materials, batch->solver, batch->done, count, batch->rows);
    for (size_t i = batch->done; i < batch->done + count; i++)
        count_failure(batch, i);
    if (!write_rows(batch, count, why)) return false;
    batch->done += count;
    adapt_chunk(batch, seconds_now() - begin);
    return true;
}

/* The rows of --join, behind those that are done. */
static bool take_shards(struct batch *batch, struct reason *why)
{
    char *list = batch->settings->text[TEXT_JOIN] ? copy_of(batch->settings->text[TEXT_JOIN]) : NULL, *rest = NULL;
    bool good = true;
    for (char *path = list ? strtok_r(list, ",", &rest) : NULL; path && good; path = strtok_r(NULL, ",", &rest)) {
        size_t count = 0;
        good = partial_join(path, &batch->cases, batch->settings, batch->settings_object, batch->rows, batch->done,
                            &count, why) &&
               write_rows(batch, count, why);
        batch->done += good ? count : 0;
    }
    free(list);
    if (!good) partial_remove(&batch->partial);
    return good;
}

/* All rows, or as many as there is time and room for. */
static bool solve_rows(struct batch *batch, struct reason *why)
{
    bool good = true;
    batch->begin = seconds_now();
    batch->resumed = batch->done;
    for (size_t i = 0; i < batch->done; i++)
        count_failure(batch, i);
    batch->chunk = batch->least_chunk = threads_of(batch->settings);
    while (batch->done < batch->cases.rows && !interrupted && good) {
        good = solve_chunk(batch, why);
        tick(batch, false);
    }
    tick(batch, true);
    return good;
}

/* What belongs beside or into the result. */
static json_t *make_record(struct batch *batch)
{
    struct values values = batch->settings->values;
    bool physical = values_physical(&values);
    for (size_t i = batch->cases.notes; i < batch->cases.columns; i++)
        physical |= field_of_column(cases_name(&batch->cases, i)) > FIELD_LAST_DIMENSIONLESS;
    json_t *record =
        provenance_record(batch->settings, json_incref(batch->settings_object), row_units(&batch->cases, physical));
    json_object_set_new(record, "rows", json_integer((json_int_t)batch->cases.rows));
    json_object_set_new(record, "failed", json_integer((json_int_t)batch->failed));
    return record;
}

static bool write_json(struct batch *batch, struct reason *why)
{
    json_t *rows = json_array();
    for (size_t i = 0; i < batch->cases.rows; i++)
        json_array_append_new(rows, row_json(&batch->cases, i, &batch->rows[i]));
    return provenance_write(batch->settings->text[TEXT_OUTPUT],
                            json_pack("{s:o, s:o}", "meta", make_record(batch), "results", rows), why);
}

/* Rows that are there already get their name when the record is sure to get its own. */
static bool write_result(struct batch *batch, struct reason *why)
{
    struct output record;
    if (batch->settings->format == FORMAT_JSON) {
        if (!write_json(batch, why)) return false;
        if (batch->path) partial_remove(&batch->partial);
        return true;
    }
    if (!batch->path) return true;
    if (!provenance_open_beside(batch->path, make_record(batch), &record, why) || !outputs_write(&record, 1, why))
        return false;
    if (partial_commit(&batch->partial, batch->path, batch->cases.rows, why)) return outputs_commit(&record, 1, why);
    outputs_abandon(&record, 1);
    return false;
}

/* What is written stays, be it a part of the first rows. */
static int stop(const struct batch *batch, const struct reason *why)
{
    return complain("%s%s", why->text, batch->path ? "; continue with --resume when that is mended" : "");
}

static int finish(struct batch *batch)
{
    const struct settings *settings = batch->settings;
    struct reason why;
    if (interrupted) {
        complain("interrupted after %zu of %zu rows%s", batch->done, batch->cases.rows,
                 batch->path ? "; continue with --resume" : "");
        return EXIT_INTERRUPTED;
    }
    if (!write_result(batch, &why)) return stop(batch, &why);
    if (batch->maker && !settings->text[TEXT_SHARD]) {
        const int status = batch->maker->finish(batch->maker->context, &batch->cases, batch->rows, make_record(batch));
        if (status != EXIT_DONE) return status;
    } else if (settings->text[TEXT_FIGURE] && !figure_of_cases(settings->text[TEXT_FIGURE], settings, &batch->cases,
                                                               &batch->materials, batch->rows, &why))
        return complain("%s", why.text);
    if (batch->failed == 0) return EXIT_DONE;
    complain("%zu of %zu rows failed; the column status says why", batch->failed, batch->cases.rows);
    return EXIT_SOME_FAILED;
}

int batch_run(const struct settings *settings, const struct batch_maker *maker)
{
    struct batch batch = {.settings = settings, .maker = maker, .stream = -1};
    struct reason why;
    int status;
    batch.path = output_is_stream(settings->text[TEXT_OUTPUT]) ? NULL : settings->text[TEXT_OUTPUT];
    if (!prepare(&batch, &why) || !take_shards(&batch, &why)) {
        status = complain("%s", why.text);
    } else {
        catch_signal(SIGINT);
        catch_signal(SIGTERM);
        status = solve_rows(&batch, &why) ? finish(&batch) : stop(&batch, &why);
    }
    if (batch.stream > STDERR_FILENO) close(batch.stream);
    partial_leave(&batch.partial);
    if (batch.rows) rows_release(batch.rows, batch.cases.rows);
    json_decref(batch.settings_object);
    restitute_solver_destroy(batch.solver);
    materials_release(&batch.materials);
    cases_release(&batch.cases);
    return status;
}
