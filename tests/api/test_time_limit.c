/* The limit of time: options.time_limit.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/sync.h"
#include "../support/time_limit.h"

/* Without a limit: some 20 s. */
static void euler_keeps_it(void **state)
{
    (void)state;
    check_time_limit(to_tolerance(1e-6), impact_of(7.0 / 6, 0.5, 1, 1), 0.2, 0.2239108);
}

/* Without a limit elements would be doubled to 16384, which take some 2 s. */
static void sync_keeps_the_default(void **state)
{
    (void)state;
    check_time_limit(sync_to(1e-8), impact_of(900, 0.5, 0.1, 1), 0, 0.187390);
}

static void no_time_at_all_is_refused(void **state)
{
    const restitute_method *methods[] = {restitute_method_euler(), restitute_method_sync()};
    (void)state;
    for (int i = 0; i < 2; i++) {
        restitute_options options = default_options();
        restitute_impact impact = impact_of(7.0 / 6, 0.5, 1, 1);
        restitute_solver *solver;
        restitute_result r;
        restitute_error error;
        options.method = methods[i];
        options.time_limit = 1e-12;
        restitute_result_init(&r);
        r.ez = 42;
        CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
        CHECK(restitute_solve(solver, &impact, &r, NULL, NULL, &error) == RESTITUTE_ERROR_TOO_MUCH_WORK, "%d", i);
        CHECK(strstr(error.message, "time_limit = 1e-12 s") != NULL && r.ez == 42, "%s", error.message);
        restitute_solver_destroy(solver);
    }
}

/* Who gives elements gets them, however long they take; not with a limit of his own. */
static void given_elements_have_no_limit_by_default(void **state)
{
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 1, 1);
    restitute_options options = as_told(3000, 0);
    restitute_solver *solver;
    restitute_error error;
    (void)state;
    options.time_limit = 0;
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) >= 0, "%s", error.message);
    restitute_solver_destroy(solver);
    options.time_limit = 0.01;
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_ERROR_TOO_MUCH_WORK, "0.01 s");
    CHECK(strstr(error.message, "time_limit = 0.01 s") != NULL, "%s", error.message);
    restitute_solver_destroy(solver);
}

static void wrong_limits_are_refused(void **state)
{
    const double wrong[] = {-1, NAN, -INFINITY};
    (void)state;
    for (int i = 0; i < 3; i++) {
        restitute_options options = default_options();
        restitute_solver *solver = NULL;
        restitute_error error;
        options.time_limit = wrong[i];
        CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_ERROR_DOMAIN && !solver, "%g", wrong[i]);
        CHECK(strstr(error.message, "time_limit (s)") != NULL, "%s", error.message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(euler_keeps_it),
        cmocka_unit_test(sync_keeps_the_default),
        cmocka_unit_test(no_time_at_all_is_refused),
        cmocka_unit_test(given_elements_have_no_limit_by_default),
        cmocka_unit_test(wrong_limits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
