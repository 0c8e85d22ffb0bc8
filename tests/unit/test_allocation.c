/* Once a solver has solved an impact of a kind, `sync` takes no more memory: calls of the allocator
 * are counted.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"
#include "../support/random.h"
#include "../support/sync.h"

static void the_counter_counts(void **state)
{
    (void)state;
    const long before = allocator.count;
    void *volatile block = malloc(100); /* volatile: or the compiler leaves both out */
    free(block);
    CHECK(allocator.count == before + 1, "%ld calls counted", allocator.count - before);
}

/* From the second call on; the first one at each tolerance makes room, for the largest number of
 * panels too. With ledger and history on a solid of some terms as well. */
static void use_twice(double tolerance, const restitute_material *solid, restitute_ledger *ledger,
                      restitute_history *history)
{
    const restitute_options options = sync_to(tolerance);
    restitute_solver *solver = make_solver(&options);
    PREPARED(result, result);
    for (int round = 0; round < 2; round++) {
        uint64_t random = 11;
        const long before = allocator.count;
        for (int i = 0; i < 30; i++) {
            const double gamma = random_log(&random, 1e-1, 10), delta1 = random_log(&random, 1e-2, 10);
            const double psi = random_in(&random, 0.05, 3), chi = random_in(&random, 0.4, 2);
            restitute_impact impact = impact_of(chi, psi, delta1, gamma);
            impact.material = solid;
            CHECK(restitute_solve(solver, &impact, &result, ledger, history, NULL) == RESTITUTE_OK, "impact %d", i);
        }
        CHECK(round == 0 || allocator.count == before, "tolerance %g: %ld calls of the allocator", tolerance,
              allocator.count - before);
    }
    restitute_solver_destroy(solver);
}

static void solver_in_use_takes_no_memory(void **state)
{
    const double tau[] = {0.01, 0.1, 1, 10}, g[] = {2, 1, 0.5, 0.2};
    double time[20];
    PREPARED(ledger, ledger);
    PREPARED(history, history);
    (void)state;
    history.capacity = 20;
    history.time = time;
    restitute_material *solid = solid_of(1, 0, 4, tau, g);
    for (double tolerance = 1e-4; tolerance > 5e-9; tolerance /= 10)
        use_twice(tolerance, NULL, NULL, NULL);
    for (double tolerance = 1e-3; tolerance > 5e-6; tolerance /= 10) {
        use_twice(tolerance, NULL, &ledger, &history);
        use_twice(tolerance, solid, &ledger, &history);
    }
    restitute_material_destroy(solid);
}

/* A usual impact finds its room made when the solver was created. */
static void first_call_takes_no_memory(void **state)
{
    (void)state;
    for (double tolerance = 1e-4; tolerance > 5e-9; tolerance /= 10) {
        const restitute_options options = sync_to(tolerance);
        const restitute_impact impact = impact_of(7.0 / 6, 0.7, 1, 1);
        restitute_solver *solver = make_solver(&options);
        const long before = allocator.count;
        CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, NULL) == RESTITUTE_OK, "first call");
        CHECK(allocator.count == before, "tolerance %g: %ld calls of the allocator", tolerance,
              allocator.count - before);
        restitute_solver_destroy(solver);
    }
}

int main(void)
{
    allocator.armed = 1; /* none fails */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_counter_counts),
        cmocka_unit_test(solver_in_use_takes_no_memory),
        cmocka_unit_test(first_call_takes_no_memory),
    };
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, NULL));
}
