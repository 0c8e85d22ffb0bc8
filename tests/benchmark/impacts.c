/* Impacts of a file of scenes (bench.h) by several methods: errors and times, as CSV.
 *
 *     impacts SCENES sweep METHODS TOLERANCES BUDGET DOUBLINGS
 *     impacts SCENES map METHODS BUDGET LEVELS
 *     impacts SCENES repeat METHOD TOLERANCE SCENE TIMES      for callgrind to count; prints nothing
 *
 * sweep: each method at each tolerance, from coarse to fine, and the paper's algorithm with 8, 16,
 * ... elements and 16, 32, ... steps an element, DOUBLINGS of each. No run is started that the runs
 * before it predict to take longer than BUDGET (s). map: each scene by sync at 1e-8, the reference;
 * then each method with 10, 100, ... steps in the contact time, LEVELS of them. Lists are separated
 * by commas. Exit status 2: usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

enum { most = 16 };

/* The coarsest run of the paper's algorithm; its median error is 6e-3 (docs/records/bench.md). */
static const int64_t fewest_elements = 8, fewest_steps_per_element = 16;

struct plan {
    const struct bench_method *methods[most];
    double tolerances[most], budget;
    int n_methods, n_tolerances, doublings;
};

static int usage(const char *what)
{
    fprintf(stderr, "usage: impacts SCENES sweep METHODS TOLERANCES BUDGET DOUBLINGS | map METHODS BUDGET LEVELS |\n"
                    "               repeat METHOD TOLERANCE SCENE TIMES%s%s\n", *what ? "\nunknown: " : "", what);
    return 2;
}

/* A tenth of the tolerance takes at most a hundred times as long with a method of first order. */
static void sweep_tolerances(const struct plan *plan, const struct bench_scene *scene,
                             const struct bench_method *method)
{
    double before = 0, last = 0;
    for (int i = 0; i < plan->n_tolerances; i++) {
        const double growth = before > 0 ? fmin(100, fmax(1, last / before)) : 100;
        if (last * growth > plan->budget) return;
        before = last;
        last = bench_run(scene, method, plan->tolerances[i], 0, 0, plan->budget);
    }
}

/* The time goes with the product of elements and steps. */
static void sweep_pairs(const struct plan *plan, const struct bench_scene *scene, const struct bench_method *method)
{
    double seconds = 0, product = 1; /* of the run before */
    for (int i = 0; i < plan->doublings; i++)
        for (int j = 0; j < plan->doublings; j++) {
            const int64_t elements = fewest_elements << i, steps = elements * (fewest_steps_per_element << j);
            const double this_product = (double)elements * (double)steps;
            if (seconds * this_product / product > plan->budget) break;
            seconds = bench_run(scene, method, NAN, elements, steps, plan->budget);
            product = this_product;
        }
}

/* An element for every 32 steps, of sync for every two, at least four. Ten times the steps take up
 * to a hundred times as long. A factor of four is left, since a short run may have met a busy
 * machine. */
static void map(const struct plan *plan, const struct bench_scene *scene, const struct bench_method *method)
{
    double last = 0;
    int64_t steps = 10;
    for (int level = 0; level < plan->doublings && 25 * last <= plan->budget; level++, steps *= 10) {
        const int64_t elements = steps / (method->takes_time_step ? 32 : 2);
        last = bench_run(scene, method, 1e-3, elements < 4 ? 4 : elements, steps, plan->budget);
    }
}

static int repeat(const struct bench_scene *scene, const struct bench_method *method, double tolerance, int times)
{
    restitute_options options;
    restitute_result result;
    restitute_solver *solver;
    int status = RESTITUTE_OK;
    restitute_options_init(&options);
    restitute_result_init(&result);
    options.method = method->handle();
    options.tolerance = tolerance;
    if (restitute_solver_create(&options, &solver, NULL) < 0) return 2;
    for (int i = 0; i < times && status >= 0; i++)
        status = restitute_solve(solver, &scene->impact, &result, NULL, NULL, NULL);
    restitute_solver_destroy(solver);
    return status < 0;
}

static int run(FILE *scenes, char kind, const struct plan *plan, char **words)
{
    struct bench_scene scene;
    if (kind != 'r') bench_print_head();
    while (bench_read_scene(scenes, &scene)) {
        if (kind == 'r' && strcmp(scene.name, words[2]) == 0)
            return repeat(&scene, plan->methods[0], plan->tolerances[0], atoi(words[3]));
        if (kind == 'm') bench_run(&scene, bench_method("sync"), 1e-8, 0, 0, 20);
        for (int i = 0; i < plan->n_methods && kind != 'r'; i++)
            (kind == 'm'                ? map
             : plan->methods[i]->handle ? sweep_tolerances
                                        : sweep_pairs)(plan, &scene, plan->methods[i]);
        restitute_material_destroy(scene.solid);
    }
    return kind == 'r' ? usage(words[2]) : 0;
}

int main(int count, char **words)
{
    const char kind = count > 2 ? *words[2] : '?';
    const int map_kind = kind == 'm', right = map_kind ? count == 6 : (kind == 's' || kind == 'r') && count == 7;
    struct plan plan = {.n_methods = 0};
    if (!right) return usage("");
    FILE *scenes = fopen(words[1], "r");
    if (!scenes) return usage(words[1]);
    for (char *name = strtok(words[3], ","); name && plan.n_methods < most; name = strtok(NULL, ","))
        if (!(plan.methods[plan.n_methods++] = bench_method(name))) return usage(name);
    char *word = map_kind ? NULL : strtok(words[4], ",");
    for (; word && plan.n_tolerances < most; word = strtok(NULL, ","))
        plan.tolerances[plan.n_tolerances++] = atof(word);
    if (kind == 'r' && !plan.methods[0]->handle) return usage(plan.methods[0]->name);
    plan.budget = kind == 'r' ? 0 : atof(words[5 - map_kind]);
    plan.doublings = kind == 'r' ? 0 : atoi(words[6 - map_kind]);
    const int status = run(scenes, kind, &plan, words + 3);
    fclose(scenes);
    return status;
}
