/* Short ways to the method `cvode` and its events.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CVODE_H
#define TEST_CVODE_H

#include <restitute/cvode.h>

#include "solve.h"

enum { most_events = 4000 };

struct logged {
    int status;
    restitute_result result;
    restitute_cvode_events events;
    restitute_cvode_event event[most_events];
};

static inline restitute_options cvode_to(double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = restitute_method_cvode();
    return options;
}

static inline void solve_logged(restitute_options options, restitute_impact impact, struct logged *log)
{
    restitute_solver *solver;
    restitute_error error;
    restitute_result_init(&log->result);
    restitute_cvode_events_init(&log->events);
    log->events.event = log->event;
    log->events.capacity = most_events;
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    log->status = restitute_cvode_solve(solver, &impact, &log->result, NULL, NULL, &log->events, &error);
    restitute_solver_destroy(solver);
    CHECK(log->status >= 0, "%s", error.message);
    CHECK(log->events.count <= most_events, "%zu events", log->events.count);
}

static inline int count_events(const struct logged *log, int kind)
{
    int n = 0;
    for (size_t i = 0; i < log->events.count; i++)
        n += log->event[i].kind == kind;
    return n;
}

/* The first event of a kind; NULL if there is none. */
static inline const restitute_cvode_event *first_event(const struct logged *log, int kind)
{
    for (size_t i = 0; i < log->events.count; i++)
        if (log->event[i].kind == kind) return &log->event[i];
    return NULL;
}

#endif
