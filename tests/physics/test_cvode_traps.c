/* The method cvode with traps on; its events.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include "../support/cvode.h"

static void over_the_domain(void **state)
{
    const int counts[] = {40, 40, 75};
    (void)state;
    sweep_known(restitute_method_cvode(), 1e-3, 1);
    sweep_random(restitute_method_cvode(), 11, counts, 1e-2, 0.3);
}

static void both_families(void **state)
{
    const int counts[] = {20, 0, 0};
    (void)state;
    sweep_random(restitute_method_cvode_bdf(), 12, counts, 1e-2, 0.3);
    sweep_random(restitute_method_cvode_adams(), 13, counts, 1e-2, 0.3);
}

static void events(void **state)
{
    static struct logged log;
    const double psis[] = {0, 0.3, 1.5, 6};
    int status;
    (void)state;
    for (int i = 0; i < 4; i++)
        WITHOUT_TRAPS(status, (solve_logged(cvode_to(1e-3), impact_of(7.0 / 6, psis[i], 1, 1), &log), log.status),
                      "psi %g", psis[i]);
}

static void hosts_that_trap(void **state)
{
    (void)state;
    host_that_traps(restitute_method_cvode());
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(over_the_domain), cmocka_unit_test(both_families),
                                       cmocka_unit_test(events), cmocka_unit_test(hosts_that_trap)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
