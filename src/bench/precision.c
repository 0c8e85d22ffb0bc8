/* The runs behind the work-precision tables. A sweep over tolerances goes from coarse to fine and ends before a run
 * that would take longer than the budget, as the growth of the two before it tells. The paper's algorithm is swept over
 * elements and steps, which are both free: what ratio of them is best depends on scene and error.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "precision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "timing.h"
#include "work.h"

/* Work longer than this (s) is timed once. */
static const double long_work = 0.01;

/* Of nominal seconds no method does more in a second; bounds the time of a call from below. */
static const double work_per_second = 5;

/* The bench's own methods update elements as euler does. */
static const double updates_per_second = 1e9;

/* A tenth of the tolerance costs at most this much more by a method of first order; taken where there is no earlier run
 * to tell. */
static const double growth_tolerance = 100;

/* The coarsest run of the paper's algorithm, 8 elements and 128 steps: its median error is 6e-3 (docs/records/bench.md). */
static const int64_t fewest_elements = 8, fewest_steps_per_element = 16;

struct paper_settings bench_paper_settings(const struct bench_scene *scene, enum paper_motion motion, int64_t elements,
                                           int64_t steps)
{
    return (struct paper_settings){.motion = motion,
                                   .elements = elements + elements / 16 + 1, /* a coarse run may go deeper */
                                   .spacing = scene->radius / (double)elements,
                                   .step = scene->contact_time / (double)steps,
                                   .max_steps = 20 * steps};
}

static int append(const struct bench_run *run, struct bench_runs *runs)
{
    if (runs->count == runs->capacity) {
        const size_t capacity = runs->capacity ? 2 * runs->capacity : 256;
        struct bench_run *grown = realloc(runs->runs, capacity * sizeof *grown);
        if (!grown) return 1;
        runs->runs = grown;
        runs->capacity = capacity;
    }
    runs->runs[runs->count++] = *run;
    return 0;
}

void bench_runs_release(struct bench_runs *runs)
{
    free(runs->runs);
    *runs = (struct bench_runs){NULL, 0, 0};
}

double bench_run_error(const struct bench_run *run)
{
    return fmax(run->error_ez, run->error_ex);
}

static void judge(const struct bench_scene *scene, struct bench_run *run)
{
    run->error_ez = fabs(run->ez - scene->ez);
    run->error_ex = fabs(run->ex - scene->ex);
}

/* A run by the library, as bench_time_work() wants it. */
struct library_run {
    restitute_solver *solver;
    restitute_impact impact;
    restitute_result result;
    int status;
};

static void solve_by_library(void *context)
{
    struct library_run *run = context;
    run->status = restitute_solve(run->solver, &run->impact, &run->result, NULL, NULL, NULL);
}

/* Nonzero: no memory for a solver. The status of the solution is in `run`. */
static int run_library(const struct bench_plan *plan, const struct bench_scene *scene, struct bench_run *run)
{
    struct library_run work = {.impact = bench_scene_impact(scene)};
    restitute_options options;
    restitute_options_init(&options);
    restitute_result_init(&work.result);
    options.method = bench_methods[run->method].handle();
    options.tolerance = run->tolerance;
    options.max_work = plan->budget * work_per_second;
    options.time_limit = INFINITY;
    if (restitute_solver_create(&options, &work.solver, NULL)) return 1;
    const struct bench_time time = bench_time_work(solve_by_library, &work, long_work);
    if (work.status >= 0) bench_read_work(&options, &work.impact, run);
    restitute_solver_destroy(work.solver);
    run->seconds = time.seconds;
    run->repeats = time.repeats;
    run->status = work.status;
    if (work.status < 0) return 0;
    run->ez = work.result.ez;
    run->ex = work.result.ex;
    run->estimate = fmax(work.result.error_ez, work.result.error_ex);
    run->elements = work.result.elements;
    run->steps = work.result.steps;
    run->work = work.result.work;
    judge(scene, run);
    return 0;
}

struct paper_run {
    struct paper_problem problem;
    struct paper_settings settings;
    struct paper_result result;
    enum paper_end end;
};

static void solve_by_paper(void *context)
{
    struct paper_run *run = context;
    run->end = paper_solve(&run->problem, &run->settings, &run->result);
}

static int run_paper(const struct bench_scene *scene, struct bench_run *run)
{
    const enum paper_motion motion = bench_methods[run->method].motion;
    struct paper_run work = {.problem = bench_scene_paper(scene),
                             .settings = bench_paper_settings(scene, motion, run->elements_asked, run->steps_asked)};
    const struct bench_time time = bench_time_work(solve_by_paper, &work, long_work);
    if (work.end == PAPER_NO_MEMORY) return 1;
    run->seconds = time.seconds;
    run->repeats = time.repeats;
    run->elements = run->elements_asked;
    run->status = work.end == PAPER_SEPARATED ? RESTITUTE_OK : RESTITUTE_ERROR_UNSTABLE_STEP;
    if (run->status) return 0;
    run->ez = work.result.ez;
    run->ex = work.result.ex;
    run->steps = work.result.steps;
    run->work = (double)work.result.updates / updates_per_second;
    judge(scene, run);
    return 0;
}

/* How long the next run may be expected to take. */
static double expected(const double *seconds, int done)
{
    if (done == 0) return 0;
    if (done == 1) return seconds[0] * growth_tolerance;
    return seconds[done - 1] * fmin(growth_tolerance, fmax(1, seconds[done - 1] / seconds[done - 2]));
}

/* Whether a run would be compared with itself, or with a coarser one of the same method. */
static int proves_nothing(const struct bench_scene *scene, const struct bench_run *run)
{
    return scene->reference_method && bench_methods[run->method].handle &&
           strcmp(scene->reference_method, bench_methods[run->method].name) == 0 &&
           run->tolerance <= scene->reference_tolerance;
}

/* A run to be made: its setting is still to be filled in. */
static struct bench_run new_run(size_t scene, int method)
{
    return (struct bench_run){.scene = scene,
                              .method = method,
                              .tolerance = NAN,
                              .ez = NAN,
                              .ex = NAN,
                              .error_ez = NAN,
                              .error_ex = NAN,
                              .estimate = NAN,
                              .work = NAN};
}

static int sweep_tolerances(const struct bench_plan *plan, const struct bench_scene *scene, size_t number, int method,
                            struct bench_runs *runs)
{
    double seconds[BENCH_SETTINGS];
    for (int i = 0; i < plan->n_tolerances; i++) {
        struct bench_run run = new_run(number, method);
        run.tolerance = plan->tolerances[i];
        if (proves_nothing(scene, &run) || expected(seconds, i) > plan->budget) break;
        if (run_library(plan, scene, &run) || append(&run, runs)) return 1;
        seconds[i] = run.seconds;
    }
    return 0;
}

/* Every pair of elements and steps within the budget; the time goes with their product. */
static int sweep_pairs(const struct bench_plan *plan, const struct bench_scene *scene, size_t number, int method,
                       struct bench_runs *runs)
{
    double seconds = 0, product = 1; /* of the run before */
    for (int i = 0; i < plan->doublings; i++)
        for (int j = 0; j < plan->doublings; j++) {
            struct bench_run run = new_run(number, method);
            run.elements_asked = fewest_elements << i;
            run.steps_asked = run.elements_asked * (fewest_steps_per_element << j);
            const double this_product = (double)run.elements_asked * (double)run.steps_asked;
            if (seconds * this_product / product > plan->budget) break;
            if (run_paper(scene, &run) || append(&run, runs)) return 1;
            seconds = run.seconds;
            product = this_product;
        }
    return 0;
}

int bench_run_scene(const struct bench_plan *plan, const struct bench_scene *scene, size_t number, int method,
                    struct bench_runs *runs)
{
    return (bench_methods[method].handle ? sweep_tolerances : sweep_pairs)(plan, scene, number, method, runs);
}
