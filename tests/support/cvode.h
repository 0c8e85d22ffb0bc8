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

/* A solver whose method, one of cvode's, keeps what it saw. */
struct recording {
    restitute_cvode_recorder *recorder;
    restitute_solver *solver;
};

static inline struct recording record_with(restitute_options options)
{
    struct recording r;
    restitute_error error;
    CHECK(restitute_cvode_recorder_create(options.method, &r.recorder, &error) == RESTITUTE_OK, "%s", error.message);
    options.method = restitute_cvode_recorder_method(r.recorder);
    r.solver = make_solver(&options);
    return r;
}

static inline void end_recording(const struct recording *r)
{
    restitute_solver_destroy(r->solver);
    restitute_cvode_recorder_destroy(r->recorder);
}

static inline void solve_logged_with(restitute_options options, restitute_impact impact, restitute_ledger *ledger,
                                     struct logged *log)
{
    const struct recording r = record_with(options);
    restitute_error error;
    restitute_result_init(&log->result);
    restitute_cvode_events_init(&log->events);
    log->events.event = log->event;
    log->events.capacity = most_events;
    log->status = restitute_solve(r.solver, &impact, &log->result, ledger, NULL, &error);
    CHECK(log->status >= 0, "%s", error.message);
    CHECK(restitute_cvode_recorder_events(r.recorder, &log->events, &error) == RESTITUTE_OK, "%s", error.message);
    end_recording(&r);
    CHECK(log->events.count <= most_events, "%zu events", log->events.count);
}

static inline void solve_logged(restitute_options options, restitute_impact impact, struct logged *log)
{
    solve_logged_with(options, impact, NULL, log);
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
