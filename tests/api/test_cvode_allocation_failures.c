/* Every allocation of the method cvode fails in turn, those of CVODE too: ERROR_MEMORY, outputs
 * untouched, and the same solver gives the right result afterwards, bit by bit, and leaks nothing.
 * Only those of SUNContext_Create do not fail: SUNDIALS 6.4 crashes there (cvode.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/outputs.h"

#include "../support/cvode.h"

enum { events = 30 };

static struct recording recording;
static restitute_impact impact;
static restitute_error error;

static void create(void)
{
    recording = record_with(cvode_to(0.1));
}

static void destroy(void)
{
    end_recording(&recording);
}

SOLVES(solve_once, restitute_solve(recording.solver, &impact, &o.result, WANTED(ledger), &o.history, &error))

static int solve(struct given *given)
{
    restitute_cvode_event event[events] = {{0}};
    PREPARED(cvode_events, seen);
    const int status = solve_once(given);
    if (status < 0) return status;
    seen.capacity = events;
    seen.event = event;
    CHECK(restitute_cvode_recorder_events(recording.recorder, &seen, &error) == RESTITUTE_OK, "%s", error.message);
    give(given, (double)seen.count);
    for (int i = 0; i < events; i++)
        give(given, event[i].time);
    return status;
}

static void method_cvode(void **state)
{
    (void)state;
    spare("SUNContext_Create");
    impact = impact_of(7.0 / 6, 1.5, 0.3, 1e-3); /* gross slip, and backward differentiation */
    FAIL_EACH({"without a ledger", solve, create, destroy, .stride = 32});
    impact = impact_of(7.0 / 6, 0.5, 1, 1); /* stick, and Adams' formulas */
    all_outputs = 1;
    FAIL_EACH({"with a ledger", solve, create, destroy, .stride = 12});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(method_cvode)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, NULL));
}
