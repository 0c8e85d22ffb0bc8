/* `restitute bench --bem-campaign`: set after set into PREFIX-bem.csv.partial, whose first line tells the settings.
 * Rows of finished shards may be joined: what is there already is not solved again.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/bem.h>

#include "bem_campaign.h"
#include "bench.h"
#include "gnuplot.h"
#include "unfinished.h"

/* What the differences should stay below. */
static const double limit = 0.002;

struct campaign {
    const struct bench_settings *settings;
    struct bench_bem_row *rows; /* by index */
    bool *done;
    restitute_solver *sync, *bem;
    struct unfinished partial;
};

static const struct bench_campaign *plan_of(const struct campaign *c)
{
    return &c->settings->campaign;
}

static void settings_line(const struct campaign *c, char *line, size_t size)
{
    snprintf(line, size, "# restitute %s, bem campaign: seed %u, grid %d\n", restitute_version(), plan_of(c)->seed,
             plan_of(c)->grid);
}

/* The rows that are done, in the order of their numbers; those that are kept as struct alone have no gaps. */
static size_t collect(const struct campaign *c, struct bench_bem_row *rows)
{
    size_t count = 0;
    for (long i = 0; i < plan_of(c)->sets; i++)
        if (c->done[i]) rows[count++] = c->rows[i];
    return count;
}

static void write_rows(const void *context, FILE *stream)
{
    const struct campaign *c = context;
    char line[128];
    settings_line(c, line, sizeof line);
    fputs(line, stream);
    bench_write_bem_header(stream);
    for (long i = 0; i < plan_of(c)->sets; i++)
        if (c->done[i]) bench_write_bem_row(&c->rows[i], stream);
}

/* Rows of a file with the same settings. A last line without its end was not written whole and is done again. */
static bool read_rows(struct campaign *c, const char *path, const char *option, struct reason *why)
{
    char expected[128], line[1024];
    struct bench_bem_row row;
    FILE *stream = fopen(path, "r");
    if (!stream) return refuse(why, "%s: %.200s: %s", option, path, strerror(errno));
    settings_line(c, expected, sizeof expected);
    bool good = fgets(line, sizeof line, stream) && strcmp(line, expected) == 0;
    if (!good) refuse(why, "%s: %.200s is of a run with other settings", option, path);
    while (good && fgets(line, sizeof line, stream) && strchr(line, '\n')) {
        if (bench_is_bem_header(line)) continue;
        good = bench_read_bem_row(line, plan_of(c)->seed, &row);
        if (!good) refuse(why, "%s: %.150s: no row of this campaign: %.60s", option, path, line);
        if (!good || row.index >= plan_of(c)->sets) continue;
        c->rows[row.index] = row;
        c->done[row.index] = true;
    }
    fclose(stream);
    return good;
}

static bool join(struct campaign *c, struct reason *why)
{
    bool good = true;
    if (!plan_of(c)->join) return true;
    char *list = copy_of(plan_of(c)->join), *rest = NULL;
    for (char *path = strtok_r(list, ",", &rest); good && path; path = strtok_r(NULL, ",", &rest))
        good = read_rows(c, path, "--join", why);
    free(list);
    return good;
}

/* Line of the settings if the file is empty, and all rows that were joined and are not in it. */
static bool complete_partial(struct campaign *c, const bool *joined, struct reason *why)
{
    struct output lines;
    char text[128];
    if (!output_open(NULL, &lines, why)) return false;
    settings_line(c, text, sizeof text);
    if (c->partial.empty) fputs(text, lines.stream);
    for (long i = 0; i < plan_of(c)->sets; i++) {
        if (joined[i] && !c->done[i]) bench_write_bem_row(&c->rows[i], lines.stream);
        c->done[i] |= joined[i];
    }
    return unfinished_append(&c->partial, &lines, why);
}

static bool open_partial(struct campaign *c, struct reason *why)
{
    if (!c->settings->output) return true;
    char *path = path_with_suffix(c->settings->output, "-bem.csv");
    bool good = unfinished_open(path, c->settings->resume, &c->partial, why);
    free(path);
    if (!good) return false;
    bool *joined = c->done;
    c->done = allocate((size_t)plan_of(c)->sets, sizeof *c->done);
    if (!c->partial.empty) good = read_rows(c, c->partial.path, "--resume", why) && unfinished_cut(&c->partial, why);
    good = good && complete_partial(c, joined, why);
    free(joined);
    return good;
}

static bool append(struct campaign *c, long index, struct reason *why)
{
    struct output line;
    if (!c->partial.path) return true;
    if (!output_open(NULL, &line, why)) return false;
    bench_write_bem_row(&c->rows[index], line.stream);
    return unfinished_append(&c->partial, &line, why);
}

static bool make_solvers(struct campaign *c, struct reason *why)
{
    restitute_options options;
    restitute_error error;
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    options.tolerance = 1e-6; /* as good as exact beside 0.002 */
    if (restitute_solver_create(&options, &c->sync, &error) < 0) return refuse(why, "%s", error.message);
    restitute_options_init(&options);
    options.method = restitute_method_bem();
    options.elements = bench_bem_elements(plan_of(c)->grid);
    if (restitute_solver_create(&options, &c->bem, &error) < 0) return refuse(why, "%s", error.message);
    return true;
}

static bool run_all(struct campaign *c, struct reason *why)
{
    const struct bench_campaign *plan = plan_of(c);
    for (long i = plan->shard - 1; i < plan->sets && !bench_interrupted(); i += plan->shards) {
        struct bench_draw draw;
        char text[80];
        if (c->done[i]) continue;
        snprintf(text, sizeof text, "set %ld of %ld on %d x %d cells", i + 1, plan->sets, plan->grid, plan->grid);
        bench_progress(text);
        bench_draw_impact(plan->seed, i, &draw);
        if (bench_bem_run(c->sync, c->bem, i, &draw, &c->rows[i]))
            return refuse(why, "set %ld: its solid cannot be made", i);
        c->done[i] = true;
        if (!append(c, i, why)) return false;
    }
    bench_progress(NULL);
    return true;
}

static bool draw(const struct campaign *c, const struct bench_bem_row *rows, size_t count, struct reason *why)
{
    struct gnuplot gnuplot;
    if (!c->settings->figure) return true;
    if (!gnuplot_open(c->settings->figure, 900, 420, &gnuplot, why)) return false;
    bench_draw_bem(rows, count, gnuplot.commands);
    return gnuplot_close(&gnuplot, why);
}

static bool report(struct campaign *c, struct reason *why)
{
    struct bench_bem_row *rows = allocate((size_t)plan_of(c)->sets, sizeof *rows);
    const size_t count = collect(c, rows);
    const bool good = bench_write_table(c->settings, "bem", write_rows, c, why) && draw(c, rows, count, why);
    if (good) unfinished_remove(&c->partial);
    if (good) bench_print_bem(rows, count, limit, stdout);
    free(rows);
    return good;
}

int bench_bem_campaign(const struct bench_settings *settings)
{
    struct campaign c = {.settings = settings};
    struct reason why;
    c.rows = allocate((size_t)settings->campaign.sets, sizeof *c.rows);
    c.done = allocate((size_t)settings->campaign.sets, sizeof *c.done);
    const bool good = make_solvers(&c, &why) && join(&c, &why) && open_partial(&c, &why) && run_all(&c, &why) &&
                      (bench_interrupted() || report(&c, &why));
    restitute_solver_destroy(c.sync);
    restitute_solver_destroy(c.bem);
    unfinished_leave(&c.partial);
    free(c.rows);
    free(c.done);
    if (!good) return complain("%s", why.text);
    if (!bench_interrupted()) return EXIT_DONE;
    complain("interrupted%s", settings->output ? ": continue with --resume" : "");
    return EXIT_INTERRUPTED;
}
