/* Medians over scenes, honesty of the estimates, and times for an error asked for and got.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "summary.h"

#include <math.h>
#include <stdlib.h>

#include "timing.h"

const double bench_speed_errors[BENCH_SPEED_ERRORS] = {1e-3, 1e-4, 1e-5, 1e-6, 1e-8};

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
    return run->method == s->method && run->elements_asked == s->elements && run->steps_asked == s->steps &&
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

/* Append the setting of a run if it is not in the list. */
static size_t insert(const struct bench_run *run, struct bench_summary *list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (same_setting(run, &list[i])) return n;
    if (n == BENCH_SUMMARIES) return n;
    list[n] = (struct bench_summary){.method = run->method,
                                     .tolerance = run->tolerance,
                                     .elements = run->elements_asked,
                                     .steps = run->steps_asked};
    return n + 1;
}

int bench_summary_complete(const struct bench_summary *summary)
{
    return summary->solved > 0 && 5 * summary->solved >= 4 * summary->scenes;
}

/* Whether a pair is on the front: complete, and no other complete one is faster and as exact. */
static int on_front(const struct bench_summary *s, const struct bench_summary *list, size_t n)
{
    if (!bench_summary_complete(s)) return 0;
    for (size_t i = 0; i < n; i++)
        if (list[i].method == s->method && bench_summary_complete(&list[i]) &&
            list[i].seconds.median < s->seconds.median && list[i].error.median <= s->error.median)
            return 0;
    return 1;
}

/* By method, then from coarse to fine: falling tolerance, or along the front. */
static int by_setting(const void *left, const void *right)
{
    const struct bench_summary *a = left, *b = right;
    if (a->method != b->method) return a->method < b->method ? -1 : 1;
    if (!isnan(a->tolerance)) return (a->tolerance < b->tolerance) - (a->tolerance > b->tolerance);
    return (a->seconds.median > b->seconds.median) - (a->seconds.median < b->seconds.median);
}

size_t bench_summarise(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets,
                       struct bench_summary *summaries)
{
    size_t n = 0, n_scenes = 0, left = 0;
    double *values = malloc((3 * runs->count + 1) * sizeof *values);
    struct bench_summary *all = malloc(BENCH_SUMMARIES * sizeof *all);
    for (size_t i = 0; i < scenes->count; i++)
        n_scenes += (scenes->scenes[i].set & sets) != 0;
    for (size_t i = 0; i < runs->count && values && all; i++)
        if (scenes->scenes[runs->runs[i].scene].set & sets) n = insert(&runs->runs[i], all, n);
    for (size_t i = 0; i < n; i++) {
        all[i].scenes = n_scenes;
        summarise(scenes, runs, sets, values, &all[i]);
    }
    for (size_t i = 0; i < n; i++)
        if (bench_methods[all[i].method].handle || on_front(&all[i], all, n)) summaries[left++] = all[i];
    qsort(summaries, left, sizeof *summaries, by_setting);
    free(values);
    free(all);
    return left;
}

/* Whether a run is within `error` as far as the reference can tell: twice its own error is allowed to it. */
static int verified(const struct bench_scene *scene, const struct bench_run *run, double error)
{
    return run->status >= 0 && bench_run_error(run) <= fmax(error, 2 * bench_scene_uncertainty(scene));
}

static int counts_for_speed(const struct bench_scene *scene)
{
    return scene->delta1 > 0 && scene->gamma > 0 && scene->psi > 0 && scene->set == BENCH_TRUTH &&
           scene->psi < restitute_critical_psi(scene->chi, scene->ez);
}

/* Median over the scenes that count of the time of the fastest run with a setting (NULL: any of the method) and, if
 * `error` is finite, a true error that small; NaN: not in more than half of them. `count`: scenes with such a run. */
static double median_time(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                          const struct bench_summary *setting, double error, size_t *count)
{
    size_t n = 0;
    double *times = malloc((scenes->count + 1) * sizeof *times);
    *count = 0;
    if (!times) return NAN;
    for (size_t i = 0; i < scenes->count; i++)
        times[i] = INFINITY;
    for (size_t i = 0; i < runs->count; i++) {
        const struct bench_run *run = &runs->runs[i];
        if (run->method == method && (!setting || same_setting(run, setting)) &&
            verified(&scenes->scenes[run->scene], run, error))
            times[run->scene] = fmin(times[run->scene], run->seconds);
    }
    for (size_t i = 0; i < scenes->count; i++) {
        if (!counts_for_speed(&scenes->scenes[i])) continue;
        *count += isfinite(times[i]) != 0;
        times[n++] = times[i];
    }
    const double median = bench_median(times, n);
    free(times);
    return isfinite(median) ? median : NAN;
}

/* The part "asked for" of a method with tolerances. */
static void ask(const struct bench_scenes *scenes, const struct bench_runs *runs, struct bench_speed *speed)
{
    const struct bench_summary setting = {.method = speed->method, .tolerance = speed->error};
    size_t solved;
    speed->seconds_asked = median_time(scenes, runs, speed->method, &setting, INFINITY, &solved);
    median_time(scenes, runs, speed->method, &setting, speed->error, &speed->within);
}

/* The same of the paper's algorithm, from all its pairs. */
static void ask_paper(const struct bench_scenes *scenes, const struct bench_runs *runs, struct bench_speed *speed)
{
    struct bench_summary *pairs = malloc(BENCH_SUMMARIES * sizeof *pairs);
    size_t n = 0, solved, within;
    for (size_t i = 0; i < runs->count && pairs; i++)
        if (runs->runs[i].method == speed->method) n = insert(&runs->runs[i], pairs, n);
    for (size_t i = 0; i < n; i++) {
        const double seconds = median_time(scenes, runs, speed->method, &pairs[i], INFINITY, &solved);
        if (isnan(seconds) || seconds >= speed->seconds_asked) continue;
        median_time(scenes, runs, speed->method, &pairs[i], speed->error, &within);
        if (2 * within < speed->scenes) continue;
        speed->seconds_asked = seconds;
        speed->within = within;
        speed->elements = pairs[i].elements;
        speed->steps = pairs[i].steps;
    }
    free(pairs);
}

static struct bench_speed times_of(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                                   double error)
{
    struct bench_speed speed = {.method = method, .error = error, .seconds_asked = NAN};
    for (size_t i = 0; i < scenes->count; i++)
        speed.scenes += counts_for_speed(&scenes->scenes[i]) != 0;
    (bench_methods[method].handle ? ask : ask_paper)(scenes, runs, &speed);
    speed.seconds_got = median_time(scenes, runs, method, NULL, error, &speed.reached);
    return speed;
}

struct bench_speed bench_speed_of(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                                  double error)
{
    struct bench_speed speed = times_of(scenes, runs, method, error);
    const struct bench_speed paper = times_of(scenes, runs, bench_method_index("paper-euler", 11), error);
    speed.ratio_asked = paper.seconds_asked / speed.seconds_asked;
    speed.ratio_got = paper.seconds_got / speed.seconds_got;
    return speed;
}
