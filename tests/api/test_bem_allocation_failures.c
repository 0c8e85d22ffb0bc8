/* Every allocation of the component bem fails in turn, those of its arrays for FFTW too:
 * ERROR_MEMORY, outputs untouched, and the same solver gives the right result afterwards, bit by
 * bit, and leaks nothing. Only FFTW's own do not fail: it ends the program then (bem.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/outputs.h"

#include <restitute/bem.h>

#include "../support/solve.h"

#if CAN_FAIL
/* In front of FFTW's, whose calls of the allocator are not ours. */
SEEN_BY_LIBRARIES double *fftw_alloc_real(size_t n)
{
    return aligned_alloc(64, n * sizeof(double));
}

SEEN_BY_LIBRARIES void *fftw_alloc_complex(size_t n)
{
    return fftw_alloc_real(2 * n);
}
#endif

static restitute_bem_recorder *recorder;
static restitute_solver *solver;
static restitute_material *solid;
static restitute_error error;
static int refines;

static void create(void)
{
    restitute_options options = refines ? to_tolerance(2e-4) : as_told(8, 0.2);
    CHECK(restitute_bem_recorder_create(2, &recorder, &error) == RESTITUTE_OK, "%s", error.message);
    options.method = restitute_bem_recorder_method(recorder);
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
}

static void destroy(void)
{
    restitute_solver_destroy(solver);
    restitute_bem_recorder_destroy(recorder);
}

static int solve(struct given *given)
{
    struct outputs o, fresh;
    int status;
    const restitute_impact impact = impact_on(solid, 7.0 / 6, 2);
    prepare(&o, &fresh);
    ARMED(status, restitute_solve(solver, &impact, &o.result, &o.ledger, &o.history, &error));
    if (give_outputs(status, &o, &fresh, given) < 0) return status;
    for (size_t i = 0; i < restitute_bem_recorder_count(recorder); i++) {
        restitute_bem_snapshot s;
        restitute_bem_snapshot_init(&s);
        CHECK(restitute_bem_recorder_get(recorder, i, &s, &error) == RESTITUTE_OK, "%s", error.message);
        give(given, s.pressure[s.cells * s.cells / 2]);
    }
    return status;
}

static int recorder_create(struct given *given)
{
    int status;
    restitute_bem_recorder *made = NULL;
    ARMED(status, restitute_bem_recorder_create(3, &made, &error));
    CHECK((status >= 0) == (made != NULL), "recorder touched");
    restitute_bem_recorder_destroy(made);
    give(given, status);
    return status;
}

static void method_bem(void **state)
{
    const double tau[] = {0.1, 1}, g[] = {1, 1};
    struct given warm = {0};
    (void)state;
    if (!CAN_FAIL) skip();
    allocator.ours_alone = 1;
    solid = solid_of(1, 0, 2, tau, g);
    create(); /* what FFTW keeps for good */
    CHECK(solve(&warm) >= 0, "%s", error.message);
    destroy();
    fail_each_allocation(&(struct subject){"prescribed", create, solve, destroy, 6, 0});
    refines = 1;
    fail_each_allocation(&(struct subject){"refining", create, solve, destroy, 2, 0});
    fail_each_allocation(&(struct subject){"recorder", NULL, recorder_create, NULL, 0, 0});
    restitute_material_destroy(solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(method_bem)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
