/* Solving with a log of events in the caller's units, and the work of the last call.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/report.h"
#include "cvode/solve.h"
#include "solver/solver.h"

void restitute_cvode_events_init(restitute_cvode_events *events)
{
    if (!events) return;
    *events = (restitute_cvode_events){.struct_size = sizeof *events};
}

void restitute_cvode_work_init(restitute_cvode_work *work)
{
    if (!work) return;
    *work = (restitute_cvode_work){.struct_size = sizeof *work};
}

const char *restitute_cvode_event_text(int kind)
{
    switch (kind) {
#define EVENT_CASE(name, value, word)                                                                                  \
    case value:                                                                                                        \
        return word;
        RESTITUTE_CVODE_EVENT_LIST(EVENT_CASE)
#undef EVENT_CASE
    default:
        return "unknown event";
    }
}

/* The memory of a solver with this method; for another solver NULL and a message. */
static struct cvode_memory *memory_of(restitute_solver *solver, restitute_error *error)
{
    if (!solver) {
        rst_report(error, RESTITUTE_ERROR_NULL, "solver is NULL");
        return NULL;
    }
    const struct restitute_method *method = restitute_private_method(solver);
    if (method != restitute_method_cvode() && method != restitute_method_cvode_bdf() &&
        method != restitute_method_cvode_adams()) {
        rst_report(error, RESTITUTE_ERROR_DOMAIN,
                   "the solver is of the method %s: must be of cvode, cvode-bdf or cvode-adams", method->name);
        return NULL;
    }
    return (struct cvode_memory *)restitute_private_workspace(solver)->own;
}

static int check_events(const restitute_cvode_events *events, restitute_error *error)
{
    if (!events) return RESTITUTE_OK;
    if (events->struct_size != sizeof *events)
        return rst_report(
            error, RESTITUTE_ERROR_STRUCT_SIZE,
            "restitute_cvode_events: struct_size is %zu, this library expects %zu; call its init function",
            events->struct_size, sizeof *events);
    if (events->capacity > 0 && !events->event)
        return rst_report(error, RESTITUTE_ERROR_NULL, "events.event is NULL, but events.capacity is %zu",
                          events->capacity);
    return RESTITUTE_OK;
}

/* Factors from the units of the problem to the caller's. */
struct units {
    double time, depth, radius, normal, tangential;
};

static void hand_out(const struct event_log *log, const struct units *units, restitute_cvode_events *events)
{
    events->count = log->count;
    for (size_t i = 0; i < log->count && i < events->capacity; i++) {
        restitute_cvode_event *event = &events->event[i];
        *event = log->event[i];
        event->time *= units->time;
        event->position *= units->radius;
        event->indentation *= units->depth;
        event->normal_velocity *= units->normal;
        event->tangential_velocity *= units->tangential;
    }
}

int restitute_cvode_solve(restitute_solver *solver, const restitute_impact *impact, restitute_result *result,
                          restitute_ledger *ledger, restitute_history *history, restitute_cvode_events *events,
                          restitute_error *error)
{
    int status = check_events(events, error);
    if (status) return status;
    struct cvode_memory *memory = memory_of(solver, error);
    if (!memory) return solver ? RESTITUTE_ERROR_DOMAIN : RESTITUTE_ERROR_NULL;
    memory->wants_log = events != NULL;
    status = restitute_solve(solver, impact, result, ledger, history, error);
    memory->wants_log = 0;
    if (status < 0 || !events) return status;
    hand_out(&memory->log, &(struct units){1, 1, 1, 1, 1}, events);
    return status;
}

/* U' is in units of the velocity that the friction coefficient gives it; psi of it is the sliding
 * speed. */
static int scene_units(const restitute_scene *scene, struct units *units, restitute_error *error)
{
    restitute_numbers numbers;
    restitute_numbers_init(&numbers);
    const int status = restitute_scene_numbers(scene, &numbers, error);
    if (status < 0) return status;
    const double sliding = fabs(scene->tangential_speed + scene->radius1 * scene->spin1 +
                                (isfinite(scene->radius2) ? scene->radius2 * scene->spin2 : 0));
    const double psi =
        numbers.psi > 1e-12 && isfinite(numbers.psi) ? numbers.psi : 1; /* as the core has it: 1 is a scale */
    *units = (struct units){numbers.time, numbers.length_z, numbers.length_x, scene->normal_speed, sliding / psi};
    return RESTITUTE_OK;
}

int restitute_cvode_solve_scene(restitute_solver *solver, const restitute_scene *scene, restitute_result *result,
                                restitute_ledger *ledger, restitute_history *history, restitute_cvode_events *events,
                                restitute_error *error)
{
    struct units units = {0};
    int status = check_events(events, error);
    if (status) return status;
    struct cvode_memory *memory = memory_of(solver, error);
    if (!memory) return solver ? RESTITUTE_ERROR_DOMAIN : RESTITUTE_ERROR_NULL;
    if (events && scene) status = scene_units(scene, &units, error);
    if (status < 0) return status;
    memory->wants_log = events != NULL;
    status = restitute_solve_scene(solver, scene, result, ledger, history, error);
    memory->wants_log = 0;
    if (status < 0 || !events) return status;
    hand_out(&memory->log, &units, events);
    return status;
}

int restitute_cvode_last_work(const restitute_solver *solver, restitute_cvode_work *work, restitute_error *error)
{
    if (!work) return rst_report(error, RESTITUTE_ERROR_NULL, "work is NULL");
    if (work->struct_size != sizeof *work)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "restitute_cvode_work: struct_size is %zu, this library expects %zu; call its init function",
                          work->struct_size, sizeof *work);
    const struct cvode_memory *memory = memory_of((restitute_solver *)solver, error);
    if (!memory) return solver ? RESTITUTE_ERROR_DOMAIN : RESTITUTE_ERROR_NULL;
    if (memory->work.steps == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "the solver has not solved an impact yet");
    const size_t size = work->struct_size;
    *work = memory->work;
    work->struct_size = size;
    return rst_done(error);
}
