/* What energy allows and the default method promises, on random impacts over its whole domain and
 * on its corners.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/random.h"
#include "../support/solve.h"

/* Largest difference of the default run to a finer one, over all impacts tried. */
static double worst_ez, worst_ex;

static void check_impact(restitute_impact impact, const char *what, int number)
{
    struct solution s = solve_impact(default_options(), impact);
    struct restitute_result r = s.result;
    CHECK(s.status == RESTITUTE_OK, "%s %d: status %d", what, number, s.status);
    CHECK(r.ez >= 0 && r.ez <= 1, "%s %d: ez %.17g", what, number, r.ez);
    CHECK(fabs(r.ex) <= 1, "%s %d: ex %.17g", what, number, r.ex);
    /* the pair is cut off to these bounds; what the method had may be beyond by its error only */
    CHECK(s.ledger.rebound_z <= 1 + 3 * r.error_ez, "%s %d: rebound energy z %.17g", what, number, s.ledger.rebound_z);
    CHECK(s.ledger.rebound_x <= 1 + 3 * r.error_ex, "%s %d: rebound energy x %.17g", what, number, s.ledger.rebound_x);
    CHECK(s.ledger.friction_x >= 0 && s.ledger.viscous_x >= 0 && s.ledger.viscous_z >= 0 && s.ledger.left_x >= 0 &&
              s.ledger.left_z >= 0,
          "%s %d: friction work %g, viscous work %g, %g", what, number, s.ledger.friction_x, s.ledger.viscous_x,
          s.ledger.viscous_z);
    CHECK(r.error_ez <= 1e-3 && r.error_ex <= 1e-3, "%s %d: estimates %g, %g", what, number, r.error_ez, r.error_ex);
    CHECK(r.contact_time > 0 && isfinite(r.contact_time) && r.max_indentation > 0 && r.max_normal_force > 0,
          "%s %d: contact time %g", what, number, r.contact_time);

    /* First order: three quarters of the error go with four times the resolution, so the difference
     * is 3/4 of it. */
    struct restitute_result f = solve_pair(finer(&r, 4), impact).result;
    CHECK_NEAR(r.ez, f.ez, 0.75e-3, "%s %d: chi %.17g psi %.17g delta1 %.17g gamma %.17g", what, number, impact.chi,
               impact.psi, impact.delta1, impact.gamma);
    CHECK_NEAR(r.ex, f.ex, 0.75e-3, "%s %d: chi %.17g psi %.17g delta1 %.17g gamma %.17g", what, number, impact.chi,
               impact.psi, impact.delta1, impact.gamma);
    worst_ez = fmax(worst_ez, fabs(r.ez - f.ez));
    worst_ex = fmax(worst_ex, fabs(r.ex - f.ex));
}

static void random_impacts_keep_the_bounds(void **state)
{
    uint64_t seed = 20170815;
    (void)state;
    worst_ez = worst_ex = 0;
    for (int i = 0; i < 300; i++) {
        double chi = random_in(&seed, 1.0 / 3, 4), psi = random_log(&seed, 0.05, 10);
        double delta1 = random_log(&seed, 1e-3, 100), gamma = random_log(&seed, 1e-3, 1e3);
        int kind = random_below(&seed, 8);
        if (kind == 0) delta1 = 0;
        if (kind == 1) gamma = 0;
        check_impact(impact_of(chi, psi, delta1, gamma), "impact", i);
    }
    print_message("largest change with four times the resolution: ez %.1e, ex %.1e\n", worst_ez, worst_ex);
}

static void corners_of_the_domain_keep_the_bounds(void **state)
{
    const double chis[] = {1.0 / 3, 4}, psis[] = {0.05, 1, 10}, deltas[] = {0, 1e-3, 100},
                 gammas[] = {0, 1e-3, 1e3, INFINITY};
    (void)state;
    int number = 0;
    worst_ez = worst_ex = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 4; l++)
                    check_impact(impact_of(chis[i], psis[j], deltas[k], gammas[l]), "corner", number++);
    print_message("largest change with four times the resolution: ez %.1e, ex %.1e\n", worst_ez, worst_ex);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_impacts_keep_the_bounds),
        cmocka_unit_test(corners_of_the_domain_keep_the_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
