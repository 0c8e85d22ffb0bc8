/* The methods `cvode` and `sync` where slip is hard to follow (corners.h): the former has no
 * panels, no front and no rings of slip but element by element.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/corners.h"
#include "../support/cvode.h"
#include "../support/sync.h"

enum { impacts = 25 };

/* Both to 1e-5, to which `sync` also comes from 1e-8. An estimate may be too low in one of twenty:
 * three times. */
static void compare(restitute_impact impact)
{
    const struct solution c = solve_pair(cvode_to(1e-5), impact);
    const restitute_result s = solve_pair(sync_to(1e-5), impact).result;
    const restitute_result fine = solve_pair(sync_to(1e-8), impact).result;
    CHECK(c.status == RESTITUTE_OK && c.result.error_ez <= 1e-5 && c.result.error_ex <= 1e-5, "status %d", c.status);
    CHECK_NEAR(fine.ez, c.result.ez, 3 * c.result.error_ez, "chi %.17g psi %.17g delta1 %.17g gamma %.17g", impact.chi,
               impact.psi, impact.delta1, impact.gamma);
    CHECK_NEAR(fine.ex, c.result.ex, 3 * c.result.error_ex, "chi %.17g psi %.17g delta1 %.17g gamma %.17g", impact.chi,
               impact.psi, impact.delta1, impact.gamma);
    CHECK_NEAR(s.ex, c.result.ex, 1e-5 + 3 * c.result.error_ex, "chi %.17g psi %.17g delta1 %.17g gamma %.17g",
               impact.chi, impact.psi, impact.delta1, impact.gamma);
}

static void slip_passes_through_a_contact_that_relaxes_at_once(void **state)
{
    uint64_t random = 3;
    (void)state;
    for (int i = 0; i < impacts; i++)
        compare(blocked_impact(&random));
}

static void strong_friction_leaves_thin_rings_of_slip(void **state)
{
    uint64_t random = 4;
    (void)state;
    for (int i = 0; i < impacts; i++)
        compare(thin_impact(&random, 1e-3));
    compare(impact_of(1.106, 2.4e-5, 0.124, 0.2997));
    compare(impact_of(1.106, 2.6e-5, 0.124, 0.2997));
}

/* psi = 2 chi, and next to it: both are one event of the integrator, or two that it cannot tell
 * apart. */
static void gross_slip_may_end_at_the_turning_point(void **state)
{
    (void)state;
    const double off[] = {-1e-9, -1e-15, 0, 1e-15, 1e-9};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) {
        compare(impact_of(7.0 / 6, 7.0 / 3 * (1 + off[i]), 0, 1));
        compare(impact_of(7.0 / 6, 7.0 / 3 * (1 + off[i]), 0.3, 1));
    }
}

/* Just above psi = 1 gross slip ends at first touch: D' = 1 - (psi - 1)/(2 chi - 1) is next to 1,
 * or by rounding 1. If that end is missed, e_x is off by up to 2: 1e-2 is enough. */
static void gross_slip_may_end_at_first_touch(void **state)
{
    const double chi[] = {0.51, 7.0 / 6, 14.5, 1000}, eps = 2.220446049250313e-16;
    const double above[] = {eps, 6 * eps, 20 * eps, 1e-13, 1.1e-12, 1e-9};
    (void)state;
    for (size_t i = 0; i < sizeof above / sizeof *above; i++)
        for (int k = 0; k < 8; k++) {
            const restitute_impact impact = impact_of(chi[k / 2], 1 + above[i], 0.3, k % 2 ? 0.1 : 0);
            const double ex = solve_pair(sync_to(1e-3), impact).result.ex;
            CHECK_NEAR(solve_pair(cvode_to(1e-2), impact).result.ex, ex, 1.1e-2, "chi %g, psi - 1 = %g, gamma %g",
                       impact.chi, above[i], impact.gamma);
        }
}

/* Just below psi_c it ends where the contact does: D' hardly changes any more. */
static void gross_slip_may_end_with_the_contact(void **state)
{
    (void)state;
    for (double off = 1e-15; off < 1e-3; off *= 10)
        for (int i = 0; i < 3; i++) {
            restitute_impact impact = impact_of(1.743 + i, 1e9, 0.5 * i, 1);
            const double ez = solve_pair(cvode_to(1e-5), impact).result.ez;
            impact.psi = restitute_critical_psi(impact.chi, ez) * (1 - off);
            compare(impact);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slip_passes_through_a_contact_that_relaxes_at_once),
        cmocka_unit_test(strong_friction_leaves_thin_rings_of_slip),
        cmocka_unit_test(gross_slip_may_end_at_the_turning_point),
        cmocka_unit_test(gross_slip_may_end_at_first_touch),
        cmocka_unit_test(gross_slip_may_end_with_the_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
