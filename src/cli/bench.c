/* `restitute bench`: runs what the library restitute_bench measures and writes its tables and figures.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bench.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "figure.h"
#include "figures.h"
#include "gnuplot.h"
#include "places.h"
#include "provenance.h"
#include "tables.h"

static volatile sig_atomic_t interrupted;

static void on_signal(int number)
{
    (void)number;
    interrupted = 1;
}

static void catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM};
    for (int i = 0; i < 2; i++) {
        struct sigaction action, before;
        memset(&action, 0, sizeof action);
        action.sa_handler = on_signal;
        sigemptyset(&action.sa_mask);
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
    }
}

bool bench_interrupted(void)
{
    return interrupted;
}

void bench_progress(const char *text)
{
    static bool shown;
    if (!isatty(STDERR_FILENO)) return;
    if (text)
        fprintf(stderr, "\rrestitute: %-70s", text);
    else if (shown)
        fputc('\n', stderr);
    shown = text != NULL;
    fflush(stderr);
}

/* What the numbers depend on; the scenes belong to the version. */
static json_t *settings_object(const struct bench_settings *settings)
{
    const struct bench_plan *plan = &settings->plan;
    json_t *object = json_object(), *methods = json_array(), *sets = json_array(), *tolerances = json_array();
    for (int i = 0; i < BENCH_METHODS; i++)
        if (plan->methods & 1u << i) json_array_append_new(methods, json_string(bench_methods[i].name));
    for (int i = 0; i < BENCH_SETS; i++)
        if (settings->sets & 1u << i) json_array_append_new(sets, json_string(bench_set_names[i]));
    for (int i = 0; i < plan->n_tolerances; i++)
        json_array_append_new(tolerances, json_real(plan->tolerances[i]));
    json_object_set_new(object, "version", json_string(restitute_version()));
    if (settings->mode == MODE_BEM) {
        const struct bench_campaign *c = &settings->campaign;
        json_object_set_new(object, "sets", json_integer(c->sets));
        json_object_set_new(object, "seed", json_integer(c->seed));
        json_object_set_new(object, "grid", json_integer(c->grid));
        json_decref(methods);
        json_decref(sets);
        json_decref(tolerances);
        return object;
    }
    json_object_set_new(object, "quick", json_boolean(settings->quick));
    json_object_set_new(object, "methods", methods);
    json_object_set_new(object, "budget_s", json_real(plan->budget));
    if (settings->mode == MODE_PRECISION) {
        json_object_set_new(object, "sets", sets);
        json_object_set_new(object, "tolerances", tolerances);
    } else {
        json_decref(sets);
        json_decref(tolerances);
    }
    return object;
}

static json_t *record_of(const struct bench_settings *settings)
{
    const struct settings line = {.argument_count = settings->argument_count, .arguments = settings->arguments};
    return provenance_record(&line, settings_object(settings),
                             json_pack("{s:s, s:s}", "seconds", "s", "all others", "dimensionless, as documented"));
}

bool bench_write_table(const struct bench_settings *settings, const char *name,
                       void (*write)(const void *context, FILE *stream), const void *context, struct reason *why)
{
    struct output output[2];
    char suffix[40];
    if (!settings->output) return true;
    snprintf(suffix, sizeof suffix, "-%s.csv", name);
    char *path = path_with_suffix(settings->output, suffix);
    bool done = output_open(path, &output[0], why);
    if (done) {
        write(context, output[0].stream);
        done = provenance_open_beside(path, record_of(settings), &output[1], why) && outputs_finish(output, 2, why);
    }
    free(path);
    return done;
}

/* All that the tables and the figure of the runs need. */
struct precision {
    const struct bench_settings *settings;
    struct bench_scenes scenes;
    struct bench_runs runs;
};

static void write_runs(const void *context, FILE *stream)
{
    const struct precision *p = context;
    bench_write_runs(&p->scenes, &p->runs, stream);
}

static void write_summary(const void *context, FILE *stream)
{
    const struct precision *p = context;
    bench_write_summary(&p->scenes, &p->runs, p->settings->sets, stream);
}

static void write_speed(const void *context, FILE *stream)
{
    const struct precision *p = context;
    bench_write_speed(&p->scenes, &p->runs, p->settings->plan.methods, stream);
}

/* Every method on every scene; false with a reason, or interrupted. */
static bool run_all(struct precision *p, struct reason *why)
{
    const struct bench_plan *plan = &p->settings->plan;
    const double tolerance = p->settings->quick ? 1e-4 : bench_reference_method()->finest;
    restitute_error error;
    for (size_t i = 0; i < p->scenes.count && !interrupted; i++) {
        struct bench_scene *scene = &p->scenes.scenes[i];
        char text[120];
        snprintf(text, sizeof text, "scene %zu of %zu, %s: reference", i + 1, p->scenes.count, scene->name);
        bench_progress(text);
        if (bench_scene_complete(scene, tolerance, INFINITY, &error) < 0)
            return refuse(why, "scene %s: %.300s", scene->name, error.message);
        for (int m = 0; m < BENCH_METHODS && !interrupted; m++) {
            if (!(plan->methods & 1u << m)) continue;
            snprintf(text, sizeof text, "scene %zu of %zu, %s: %s", i + 1, p->scenes.count, scene->name,
                     bench_methods[m].name);
            bench_progress(text);
            if (bench_run_scene(plan, scene, i, m, &p->runs)) return refuse(why, "out of memory");
        }
    }
    bench_progress(NULL);
    return true;
}

static bool draw_precision(const struct precision *p, struct reason *why)
{
    struct gnuplot gnuplot;
    if (!p->settings->figure) return true;
    if (!gnuplot_open(p->settings->figure, 900, 560, &gnuplot, why)) return false;
    bench_draw_precision(&p->scenes, &p->runs, gnuplot.commands);
    return gnuplot_close(&gnuplot, why);
}

static bool report_precision(const struct precision *p, struct reason *why)
{
    if (!bench_write_table(p->settings, "runs", write_runs, p, why) ||
        !bench_write_table(p->settings, "summary", write_summary, p, why) ||
        !bench_write_table(p->settings, "speed", write_speed, p, why) || !draw_precision(p, why))
        return false;
    bench_print_precision(&p->scenes, &p->runs, p->settings->plan.methods, stdout);
    return true;
}

static int precision_run(const struct bench_settings *settings)
{
    struct precision p = {.settings = settings};
    struct reason why;
    restitute_error error;
    if (bench_scenes_create(settings->sets, settings->quick, &p.scenes, &error) < 0)
        return complain("%s", error.message);
    const bool good = run_all(&p, &why) && (interrupted || report_precision(&p, &why));
    bench_runs_release(&p.runs);
    bench_scenes_destroy(&p.scenes);
    if (!good) return complain("%s", why.text);
    if (!interrupted) return EXIT_DONE;
    complain("interrupted: nothing was written");
    return EXIT_INTERRUPTED;
}

struct omissions {
    struct bench_omission rows[BENCH_METHODS * BENCH_OMISSIONS];
    size_t count;
};

static void write_omissions(const void *context, FILE *stream)
{
    const struct omissions *o = context;
    bench_write_omissions(o->rows, o->count, stream);
}

static bool draw_omissions(const struct bench_settings *settings, const struct omissions *o, struct reason *why)
{
    struct gnuplot gnuplot;
    if (!settings->figure) return true;
    if (!gnuplot_open(settings->figure, 900, 100 + 26 * (int)o->count, &gnuplot, why)) return false;
    bench_draw_omissions(o->rows, o->count, gnuplot.commands);
    return gnuplot_close(&gnuplot, why);
}

/* The paper's algorithm leaves nothing out, so it has no rows here. */
static int omissions_run(const struct bench_settings *settings)
{
    struct omissions o = {.count = 0};
    struct reason why;
    restitute_error error;
    for (int m = 0; m < BENCH_METHODS; m++) {
        if (!(settings->plan.methods & 1u << m) || !bench_methods[m].handle) continue;
        if (bench_measure_omissions(m, settings->quick ? 5 : 51, o.rows + o.count, &error) < 0)
            return complain("%s", error.message);
        o.count += BENCH_OMISSIONS;
    }
    if (o.count == 0) return complain("--methods: the paper's algorithm leaves nothing out; name another one");
    if (!bench_write_table(settings, "omissions", write_omissions, &o, &why) || !draw_omissions(settings, &o, &why))
        return complain("%s", why.text);
    bench_print_omissions(o.rows, o.count, stdout);
    return EXIT_DONE;
}

/* The files that begin with --output. */
static bool check_outputs(const struct bench_settings *settings, struct places *places, struct reason *why)
{
    static const char *const suffixes[][4] = {[MODE_PRECISION] = {"-runs.csv", "-summary.csv", "-speed.csv"},
                                              [MODE_OMISSIONS] = {"-omissions.csv"},
                                              [MODE_STABILITY] = {"-stability.csv"},
                                              [MODE_BEM] = {"-bem.csv"}};
    if (!*settings->output || strcmp(settings->output, "-") == 0)
        return refuse(why, "--output = \"%.20s\": must be the beginning of file names", settings->output);
    bool good = true;
    for (const char *const *suffix = suffixes[settings->mode]; *suffix && good; suffix++) {
        char *path = path_with_suffix(settings->output, *suffix);
        places_write(places, "--output", path);
        places_write_beside(places, "--output", path, ".meta.json");
        if (settings->mode == MODE_STABILITY || settings->mode == MODE_BEM)
            places_write_beside(places, "--output", path, ".partial");
        good = output_check(path, "--output", why);
        free(path);
    }
    return good;
}

/* Refuse what cannot be written before minutes of work. */
static bool check_places(const struct bench_settings *settings, struct reason *why)
{
    struct places places = {0};
    struct reason clash;
    char *list = settings->campaign.join ? copy_of(settings->campaign.join) : NULL, *rest = NULL;
    for (char *path = list ? strtok_r(list, ",", &rest) : NULL; path; path = strtok_r(NULL, ",", &rest))
        places_read(&places, "--join", path);
    free(list);
    bool good = !settings->output || check_outputs(settings, &places, why);
    if (settings->figure) places_write(&places, "--figure", settings->figure);
    const bool apart = places_check(&places, &clash);
    if (good && !apart) good = refuse(why, "%s", clash.text);
    return good && (!settings->figure || figure_check(settings->figure, why));
}

int bench_main(int count, char **arguments)
{
    struct bench_settings settings;
    struct reason why;
    int status = EXIT_DONE;
    const enum reading reading = bench_options_read(count, arguments, &settings);
    if (reading == READING_FAILED) {
        status = EXIT_USAGE;
    } else if (reading == READING_GO_ON && !check_places(&settings, &why)) {
        status = complain("%s", why.text);
    } else if (reading == READING_GO_ON) {
        catch_signals();
        status = settings.mode == MODE_OMISSIONS   ? omissions_run(&settings)
                 : settings.mode == MODE_STABILITY ? bench_map_run(&settings)
#ifdef RESTITUTE_WITH_BEM
                 : settings.mode == MODE_BEM ? bench_bem_campaign(&settings)
#endif
                                             : precision_run(&settings);
    }
    bench_options_release(&settings);
    return status;
}
