/* The table of methods. A new method of the library is one more line, and one more in BENCH_METHODS.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "methods.h"

#include <string.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

const struct bench_method bench_methods[BENCH_METHODS] = {
    {.name = "euler", .handle = restitute_method_euler, .takes_time_step = 1, .finest = 1e-5, .fine = 1e-4},
    {.name = "sync", .handle = restitute_method_sync, .remembers = 1, .finest = 1e-8, .fine = 1e-8},
    {.name = "paper-euler", .motion = PAPER_EULER, .takes_time_step = 1},
    {.name = "paper-verlet", .motion = PAPER_VERLET, .takes_time_step = 1},
    {.name = "paper-forward", .motion = PAPER_FORWARD, .takes_time_step = 1},
#ifdef RESTITUTE_WITH_CVODE
    {.name = "cvode", .handle = restitute_method_cvode},
#endif
};

const struct bench_method *bench_reference_method(void)
{
    const struct bench_method *best = NULL;
    for (int i = 0; i < BENCH_METHODS; i++) {
        const struct bench_method *m = &bench_methods[i];
        if (m->finest > 0 && (!best || m->finest < best->finest)) best = m;
    }
    return best;
}

int bench_method_index(const char *name, size_t length)
{
    for (int i = 0; i < BENCH_METHODS; i++)
        if (strlen(bench_methods[i].name) == length && memcmp(bench_methods[i].name, name, length) == 0) return i;
    return -1;
}

void bench_forget(restitute_solver *solver)
{
    restitute_material *solid;
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.radius1 = 1, scene.mass1 = 1, scene.friction = 0, scene.normal_speed = 1;
    if (restitute_material_standard_solid(1, 2.34, 0.123, 0.5, &solid, NULL) < 0) return;
    scene.material = solid;
    restitute_solve_scene(solver, &scene, NULL, NULL, NULL, NULL);
    restitute_material_destroy(solid);
}
