/* An outside program that uses the component cvode: the example of its header.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/cvode.h>
#include <stdio.h>

int main(void)
{
    restitute_options options;
    restitute_cvode_recorder *recorder;
    restitute_solver *solver;
    restitute_error error;
    restitute_impact impact;
    restitute_cvode_event list[1000];
    restitute_cvode_events events;
    restitute_options_init(&options);
    if (restitute_cvode_recorder_create(NULL, &recorder, &error)) return 1;
    options.method = restitute_cvode_recorder_method(recorder);
    if (restitute_solver_create(&options, &solver, &error)) return 1;
    restitute_impact_init(&impact);
    impact.psi = 0.5;
    restitute_cvode_events_init(&events);
    events.event = list;
    events.capacity = 1000;
    if (restitute_solve(solver, &impact, NULL, NULL, NULL, &error)) return 1;
    if (restitute_cvode_recorder_events(recorder, &events, &error)) return 1;
    printf("SUNDIALS %s: %zu events, the last: %s\n", restitute_cvode_sundials_version(), events.count,
           restitute_cvode_event_text(list[events.count - 1].kind));
    restitute_solver_destroy(solver);
    restitute_cvode_recorder_destroy(recorder);
    return events.count < 10 || list[events.count - 1].kind != RESTITUTE_CVODE_EVENT_CONTACT_END;
}
