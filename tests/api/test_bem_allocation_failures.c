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
static restitute_impact impact;
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

SOLVES(solve_once, restitute_solve(solver, &impact, &o.result, WANTED(ledger), WANTED(history), &error))

static int solve(struct given *given)
{
    const int status = solve_once(given);
    for (size_t i = 0; status >= 0 && i < restitute_bem_recorder_count(recorder); i++) {
        PREPARED(bem_snapshot, s);
        CHECK(restitute_bem_recorder_get(recorder, i, &s, &error) == RESTITUTE_OK, "%s", error.message);
        give(given, s.pressure[s.cells * s.cells / 2]);
    }
    return status;
}

MAKES(bem_recorder, recorder_create, restitute_bem_recorder_create(3, &made, &error),
      restitute_bem_recorder_destroy(made))

static void method_bem(void **state)
{
    const double tau[] = {0.1, 1}, g[] = {1, 1};
    struct given warm = {0};
    (void)state;
    allocator.ours_alone = 1;
    restitute_material *solid = solid_of(1, 0, 2, tau, g);
    impact = impact_on(solid, 7.0 / 6, 2);
    all_outputs = 1;
    create(); /* what FFTW keeps for good */
    CHECK(solve(&warm) >= 0, "%s", error.message);
    destroy();
    FAIL_EACH({"prescribed", solve, create, destroy, .stride = 6});
    refines = 1;
    FAIL_EACH({"refining", solve, create, destroy, .stride = 2}, {"recorder", .call = recorder_create});
    restitute_material_destroy(solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(method_bem)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, NULL));
}
