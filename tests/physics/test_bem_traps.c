/* The method bem with traps on.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include <restitute/bem.h>

static void over_the_domain(void **state)
{
    const int counts[] = {8, 6, 6};
    (void)state;
    sweep_known(restitute_method_bem(), 1e-2, 19);
    sweep_random(restitute_method_bem(), 14, counts, 1e-2, 0.7);
}

static void hosts_that_trap(void **state)
{
    (void)state;
    host_that_traps(restitute_method_bem());
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(over_the_domain), cmocka_unit_test(hosts_that_trap)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
