/* Medians over scenes, honesty of the estimates, and speed at verified error.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "summary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "timing.h"

const double bench_speed_errors[BENCH_SPEED_ERRORS] = {1e-4, 1e-6, 1e-8};

static struct bench_range range_of(double *values, size_t n)
{
    struct bench_range range = {NAN, bench_median(values, n), NAN};
    if (n == 0) return range;
    range.min = values[0]; /* the median has sorted them */
    range.max = values[n - 1];
    return range;
}

static int same_setting(const struct bench_run *run, const struct bench_summary *s)
{
    return run->method == s->method && run->resolution == s->resolution &&
           (run->tolerance == s->tolerance || (isnan(run->tolerance) && isnan(s->tolerance)));
}

/* Fill a summary whose setting is given; `values` has room for three numbers a run. */
static void summarise(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets, double *values,
                      struct bench_summary *s)
{
    double *seconds = values, *errors = values + runs->count, *ratios = errors + runs->count;
    size_t n_ratios = 0, honest = 0, estimated = 0;
    s->worst = NAN;
    for (size_t i = 0; i < runs->count; i++) {
        const struct bench_run *run = &runs->runs[i];
        const struct bench_scene *scene = &scenes->scenes[run->scene];
        if (!same_setting(run, s) || !(scene->set & sets)) continue;
        s->runs++;
        if (run->status < 0) continue;
        const double error = bench_run_error(run), unsure = bench_scene_uncertainty(scene);
        s->met += run->status == RESTITUTE_OK;
        seconds[s->solved] = run->seconds;
        errors[s->solved++] = error;
        if (isnan(run->estimate)) continue;
        estimated++;
        honest += error <= run->estimate + unsure;
        if (error <= unsure) continue; /* how much of it is the reference's error cannot be told */
        ratios[n_ratios++] = run->estimate / error;
        s->worst = fmax(s->worst, (error - unsure) / run->estimate);
    }
    s->seconds = range_of(seconds, s->solved);
    s->error = range_of(errors, s->solved);
    s->estimate_ratio = bench_median(ratios, n_ratios);
    s->honest = estimated ? (double)honest / (double)estimated : NAN;
}

static int before(const struct bench_summary *a, const struct bench_summary *b)
{
    if (a->method != b->method) return a->method < b->method;
    return a->resolution != b->resolution ? a->resolution < b->resolution : a->tolerance > b->tolerance;
}

/* Put a setting into its place in the list if it is not there. */
static size_t insert(const struct bench_run *run, struct bench_summary *list, size_t n, size_t capacity)
{
    const struct bench_summary wanted = {
        .method = run->method, .tolerance = run->tolerance, .resolution = run->resolution};
    size_t place = 0;
    while (place < n && before(&list[place], &wanted))
        place++;
    if ((place < n && same_setting(run, &list[place])) || n == capacity) return n;
    memmove(&list[place + 1], &list[place], (n - place) * sizeof *list);
    list[place] = wanted;
    return n + 1;
}

size_t bench_summarise(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets,
                       struct bench_summary *summaries, size_t capacity)
{
    size_t n = 0;
    double *values = malloc((3 * runs->count + 1) * sizeof *values);
    if (!values) return 0;
    for (size_t i = 0; i < runs->count; i++)
        if (scenes->scenes[runs->runs[i].scene].set & sets) n = insert(&runs->runs[i], summaries, n, capacity);
    for (size_t i = 0; i < n; i++)
        summarise(scenes, runs, sets, values, &summaries[i]);
    free(values);
    return n;
}

/* Whether a run is within `error` as far as the reference can tell: twice its own error is allowed to it. */
static int verified(const struct bench_scene *scene, const struct bench_run *run, double error)
{
    return run->status >= 0 && bench_run_error(run) <= fmax(error, 2 * bench_scene_uncertainty(scene));
}

static double fastest(const struct bench_scenes *scenes, const struct bench_runs *runs, int method, size_t scene,
                      double error)
{
    double best = INFINITY;
    for (size_t i = 0; i < runs->count; i++) {
        const struct bench_run *run = &runs->runs[i];
        if (run->method == method && run->scene == scene && verified(&scenes->scenes[scene], run, error))
            best = fmin(best, run->seconds);
    }
    return best;
}

/* Time of the paper's algorithm at an error, between its runs on a straight line in logarithms. A coarse run that is
 * good by chance does not count: an error is that of the run or of a finer one, whichever is larger. NaN: no runs. */
static double paper_time(const struct bench_runs *runs, int paper, size_t scene, double error, int *extrapolated)
{
    double finer_error = 0, finer_time = NAN;
    *extrapolated = 0;
    for (size_t i = runs->count; i-- > 0;) { /* runs of a sweep go from coarse to fine */
        const struct bench_run *run = &runs->runs[i];
        if (run->method != paper || run->scene != scene || run->status < 0) continue;
        const double this_error = fmax(finer_error, bench_run_error(run));
        if (this_error > error) {
            *extrapolated = isnan(finer_time);
            if (*extrapolated) return run->seconds * (this_error / error) * (this_error / error);
            if (finer_error <= 0 || this_error == finer_error) return finer_time;
            const double part = log(this_error / error) / log(this_error / finer_error);
            return run->seconds * pow(finer_time / run->seconds, part);
        }
        finer_error = this_error;
        finer_time = run->seconds;
    }
    return finer_time; /* the coarsest run is good enough */
}

static int counts_for_speed(const struct bench_scene *scene)
{
    return scene->delta1 > 0 && scene->gamma > 0 && scene->psi > 0 && scene->set == BENCH_TRUTH &&
           scene->psi < restitute_critical_psi(scene->chi, scene->ez);
}

struct bench_speed bench_speed_of(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                                  double error)
{
    struct bench_speed speed = {.method = method, .error = error, .seconds = NAN, .ratio = NAN};
    const int paper = bench_method_index("paper-euler", 11);
    double *times = malloc((2 * scenes->count + 1) * sizeof *times), *ratios = times + scenes->count;
    size_t n_ratios = 0;
    if (!times) return speed;
    for (size_t i = 0; i < scenes->count; i++) {
        int extrapolated;
        if (!counts_for_speed(&scenes->scenes[i])) continue;
        const double time = fastest(scenes, runs, method, i, error);
        const double theirs = paper_time(runs, paper, i, error, &extrapolated);
        times[speed.scenes++] = time;
        if (isinf(time)) continue;
        speed.reached++;
        if (isnan(theirs)) continue;
        ratios[n_ratios++] = theirs / time;
        speed.extrapolated += (size_t)extrapolated;
    }
    const double median = bench_median(times, speed.scenes);
    if (isfinite(median)) {
        speed.seconds = median;
        speed.ratio = bench_median(ratios, n_ratios);
    }
    free(times);
    return speed;
}
