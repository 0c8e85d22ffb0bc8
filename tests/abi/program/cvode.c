/* The calls of cvode.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/cvode.h>

#include "caller.h"

enum { EVENTS = 500 };

static void recorded(const restitute_cvode_recorder *recorder)
{
    static restitute_cvode_event list[EVENTS];
    ONE(cvode_events, events);
    ONE(cvode_work, work);
    events->capacity = EVENTS, events->event = list;
    DONE(restitute_cvode_recorder_events(recorder, events, &error));
    SHOW((double)events->count, list[0].time, list[0].kind, list[events->count - 1].time);
    TEXT(restitute_cvode_event_text(list[events->count - 1].kind));
    DONE(restitute_cvode_recorder_work(recorder, work, &error));
    SHOW(work->steps > 0, work->restarts > 0, work->rates > 0, work->events > 0, (double)work->stiff);
}

void call_cvode(void)
{
    restitute_material *material = rubber();
    restitute_cvode_recorder *recorder;
    restitute_solver *solver;
    ONE(scene, scene);
    ONE(options, options);
    ONE(result, result);
    ball(scene, material);
    TEXT(restitute_cvode_sundials_version());
    TEXT(restitute_method_name(restitute_method_cvode_bdf()));
    TEXT(restitute_method_name(restitute_method_cvode_adams()));
    DONE(restitute_cvode_recorder_create(restitute_method_cvode(), &recorder, &error));
    options->method = restitute_cvode_recorder_method(recorder), options->time_limit = INFINITY;
    options->elements = 16;
    DONE(restitute_solver_create(options, &solver, &error));
    DONE(restitute_solve_scene(solver, scene, result, NULL, NULL, &error));
    SHOW(result->ez, result->ex, result->contact_time);
    recorded(recorder);
    restitute_solver_destroy(solver);
    restitute_cvode_recorder_destroy(recorder);
    restitute_material_destroy(material);
}
