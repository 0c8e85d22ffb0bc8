/* An outside program that uses the component cvode: the example of its header.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/cvode.h>
#include <stdio.h>

int main(void)
{
    restitute_options options;
    restitute_solver *solver;
    restitute_error error;
    restitute_impact impact;
    restitute_cvode_event list[1000];
    restitute_cvode_events events;
    restitute_options_init(&options);
    options.method = restitute_method_cvode();
    if (restitute_solver_create(&options, &solver, &error)) return 1;
    restitute_impact_init(&impact);
    impact.psi = 0.5;
    restitute_cvode_events_init(&events);
    events.event = list;
    events.capacity = 1000;
    if (restitute_cvode_solve(solver, &impact, NULL, NULL, NULL, &events, &error)) return 1;
    printf("SUNDIALS %s: %zu events, the last: %s\n", restitute_cvode_sundials_version(), events.count,
           restitute_cvode_event_text(list[events.count - 1].kind));
    restitute_solver_destroy(solver);
    return events.count < 10 || list[events.count - 1].kind != RESTITUTE_EVENT_CONTACT_END;
}
