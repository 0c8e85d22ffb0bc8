/* One cell of the stability map at a time, so that a map can be interrupted anywhere.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "stability.h"

#include <math.h>
#include <stdio.h>

#include "precision.h"
#include "timing.h"

#define BENCH_VERDICT_NAME(name, text) text,
const char *const bench_verdict_names[BENCH_VERDICTS] = {BENCH_VERDICT_LIST(BENCH_VERDICT_NAME)};
#undef BENCH_VERDICT_NAME

/* Asked of the methods of the library; elements and steps are given, so it decides about `wrong` only. */
static const double tolerance = 1e-3;

/* Of nominal seconds no method does more in a second; bounds the time of a call from below. */
static const double work_per_second = 5;

/* How far outside of 0 <= ez <= 1 and |ex| <= 1 is still an error and no instability. */
static const double margin = 0.01;

static const int64_t steps_per_element = 32, fewest_elements = 4; /* sync has two steps an element by itself */

int64_t bench_map_steps(int level)
{
    int64_t steps = 10;
    for (int i = 0; i < level; i++)
        steps *= 10;
    return steps;
}

void bench_map_scene(int place, int quick, struct bench_scene *scene)
{
    const double delta1 = pow(10, place / MAP_DECADES - 6), gamma = pow(10, place % MAP_DECADES - 6);
    const double fine = quick ? tolerance : bench_reference_method()->fine;
    char name[48];
    snprintf(name, sizeof name, "map-%g-%g", delta1, gamma);
    bench_scene_make(name, BENCH_STIFF, 7.0 / 6.0, 1.5, delta1, gamma, scene);
    bench_scene_complete(scene, fine, 100, NULL);
}

static enum bench_verdict judge(const struct bench_scene *scene, struct bench_cell *cell)
{
    if (!(fabs(cell->ez) <= 1 + margin && cell->ez >= -margin && fabs(cell->ex) <= 1 + margin)) return BENCH_UNSTABLE;
    cell->uncertainty = bench_scene_uncertainty(scene);
    cell->error_ez = fabs(cell->ez - scene->ez);
    cell->error_ex = fabs(cell->ex - scene->ex);
    const double error = fmax(cell->error_ez, cell->error_ex) - cell->uncertainty;
    return !isnan(cell->estimate) && error > 10 * cell->estimate && error > 10 * tolerance ? BENCH_WRONG : BENCH_ERROR;
}

static int run_library(const struct bench_scene *scene, const struct bench_method *method, int64_t elements,
                       double budget, struct bench_cell *cell)
{
    const restitute_impact impact = bench_scene_impact(scene);
    restitute_options options;
    restitute_result result;
    restitute_solver *solver;
    restitute_options_init(&options);
    restitute_result_init(&result);
    options.method = method->handle();
    options.tolerance = tolerance;
    options.elements = elements;
    if (method->takes_time_step) options.time_step = scene->contact_time / (double)cell->steps;
    options.max_work = budget * work_per_second;
    options.time_limit = INFINITY;
    if (restitute_solver_create(&options, &solver, NULL)) return 1;
    const int status = restitute_solve(solver, &impact, &result, NULL, NULL, NULL);
    restitute_solver_destroy(solver);
    const int slow = status == RESTITUTE_ERROR_TOO_MUCH_WORK || status == RESTITUTE_ERROR_CONVERGENCE;
    cell->verdict = slow ? BENCH_TOO_SLOW : BENCH_REFUSED;
    if (status < 0) return status == RESTITUTE_ERROR_MEMORY;
    cell->ez = result.ez;
    cell->ex = result.ex;
    cell->estimate = fmax(result.error_ez, result.error_ex);
    cell->verdict = judge(scene, cell);
    return 0;
}

static int run_paper(const struct bench_scene *scene, const struct bench_method *method, int64_t elements,
                     struct bench_cell *cell)
{
    const struct paper_problem problem = bench_scene_paper(scene);
    const struct paper_settings settings = bench_paper_settings(scene, method->motion, elements, cell->steps);
    struct paper_result result;
    const enum paper_end end = paper_solve(&problem, &settings, &result);
    cell->verdict = BENCH_UNSTABLE;
    if (end != PAPER_SEPARATED) return end == PAPER_NO_MEMORY;
    cell->ez = result.ez;
    cell->ex = result.ex;
    cell->verdict = judge(scene, cell);
    return 0;
}

/* Ten times the steps, and from some elements on ten times these: a hundred times the work. A factor of four is left,
 * since a short run may have met a busy machine. */
static int foreseeably_slow(const struct bench_cell *coarser, double budget)
{
    return coarser && (coarser->verdict == BENCH_TOO_SLOW || coarser->seconds * 100 > 4 * budget);
}

int bench_map_cell(const struct bench_scene *scene, int method, int level, double budget,
                   const struct bench_cell *coarser, struct bench_cell *cell)
{
    const struct bench_method *m = &bench_methods[method];
    const int64_t steps = bench_map_steps(level),
                  wanted = steps / (m->takes_time_step || !m->handle ? steps_per_element : 2);
    const int64_t elements = wanted < fewest_elements ? fewest_elements : wanted;
    *cell = (struct bench_cell){.method = method,
                                .steps = steps,
                                .delta1 = scene->delta1,
                                .gamma = scene->gamma,
                                .verdict = BENCH_NO_REFERENCE,
                                .ez = NAN,
                                .ex = NAN,
                                .error_ez = NAN,
                                .error_ex = NAN,
                                .estimate = NAN,
                                .uncertainty = NAN};
    if (!scene->has_reference) return 0; /* without a contact time there is no step to give */
    if (foreseeably_slow(coarser, budget)) {
        cell->verdict = BENCH_TOO_SLOW;
        return 0;
    }
    const double start = bench_clock();
    const int failed = m->handle ? run_library(scene, m, elements, budget, cell) : run_paper(scene, m, elements, cell);
    cell->seconds = bench_clock() - start;
    if (cell->seconds > budget) cell->verdict = BENCH_TOO_SLOW;
    /* what gives up at once was not slow: too few elements, too strong damping */
    if (cell->verdict == BENCH_TOO_SLOW && cell->seconds < budget / 20) cell->verdict = BENCH_REFUSED;
    return failed;
}
