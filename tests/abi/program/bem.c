/* The calls of bem.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/bem.h>

#include "caller.h"

enum { SNAPSHOTS = 3, SAMPLES = 5 };

static double middle(const double *field, size_t cells)
{
    return field[(cells / 2) * cells + cells / 2];
}

void call_bem(void)
{
    double force[SAMPLES];
    restitute_material *material = rubber();
    restitute_bem_recorder *recorder;
    restitute_solver *solver;
    ONE(scene, scene);
    ONE(options, options);
    ONE(result, result);
    ONE(history, history);
    ONE(bem_snapshot, snapshot);
    ball(scene, material);
    TEXT(restitute_method_name(restitute_method_bem()));
    TEXT(restitute_method_name(restitute_method_bem_paper()));
    DONE(restitute_bem_recorder_create(SNAPSHOTS, &recorder, &error));
    options->method = restitute_bem_recorder_method(recorder), options->elements = 8;
    history->capacity = SAMPLES, history->normal_force = force;
    DONE(restitute_solver_create(options, &solver, &error));
    DONE(restitute_solve_scene(solver, scene, result, NULL, history, &error));
    SHOW(result->ez, result->ex, result->contact_time, force[2]);
    SHOW((double)restitute_bem_recorder_count(recorder));
    DONE(restitute_bem_recorder_get(recorder, 1, snapshot, &error));
    SHOW(snapshot->time, snapshot->spacing, middle(snapshot->pressure, snapshot->cells),
         middle(snapshot->traction, snapshot->cells), middle(snapshot->stick, snapshot->cells));
    restitute_solver_destroy(solver);
    restitute_bem_recorder_destroy(recorder);
    restitute_material_destroy(material);
}
