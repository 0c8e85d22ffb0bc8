/* One scene of the report solved again and again by a warm solver, for instructions.sh to count
 * what that takes.
 *
 *     instructions METHOD TOLERANCE SCENE SOLVES
 *     instructions methods                        the methods of the library, one a line
 *
 * Exit status 0 solved, 1 refused, 2 usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "methods.h"
#include "scenes.h"

static int list_methods(void)
{
    for (int i = 0; i < BENCH_METHODS; i++)
        if (bench_methods[i].handle) puts(bench_methods[i].name);
    return 0;
}

static const struct bench_scene *find(const struct bench_scenes *scenes, const char *name)
{
    for (size_t i = 0; i < scenes->count; i++)
        if (strcmp(scenes->scenes[i].name, name) == 0) return &scenes->scenes[i];
    return NULL;
}

static int solve_often(const struct bench_scene *scene, const struct bench_method *method, double tolerance, int solves)
{
    restitute_options options;
    restitute_solver *solver;
    restitute_result result;
    restitute_error error;
    int status = RESTITUTE_OK;
    const restitute_impact impact = bench_scene_impact(scene);
    restitute_options_init(&options);
    restitute_result_init(&result);
    options.method = method->handle();
    options.tolerance = tolerance;
    if (restitute_solver_create(&options, &solver, &error) < 0) {
        fprintf(stderr, "instructions: %s\n", error.message);
        return 2;
    }
    for (int i = 0; i < solves && status >= 0; i++)
        status = restitute_solve(solver, &impact, &result, NULL, NULL, &error);
    restitute_solver_destroy(solver);
    if (status < 0) fprintf(stderr, "instructions: %s\n", error.message);
    return status < 0;
}

int main(int count, char **arguments)
{
    struct bench_scenes scenes;
    restitute_error error;
    if (count == 2 && strcmp(arguments[1], "methods") == 0) return list_methods();
    const int method = count == 5 ? bench_method_index(arguments[1], strlen(arguments[1])) : -1;
    if (method < 0 || !bench_methods[method].handle) {
        fputs("usage: instructions METHOD TOLERANCE SCENE SOLVES, or instructions methods\n", stderr);
        return 2;
    }
    if (bench_scenes_create(BENCH_TRUTH | BENCH_STIFF | BENCH_PRONY, 0, &scenes, &error) < 0) return 2;
    const struct bench_scene *scene = find(&scenes, arguments[3]);
    int status = 2;
    if (scene)
        status = solve_often(scene, &bench_methods[method], atof(arguments[2]), atoi(arguments[4]));
    else
        fprintf(stderr, "instructions: no scene %s\n", arguments[3]);
    bench_scenes_destroy(&scenes);
    return status;
}
