/* The method `sync` where slip is hard to follow (corners.h), compared with itself at its smallest
 * tolerance; test_cvode_corners.c compares that with the method `cvode`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/corners.h"
#include "../support/sync.h"

enum { impacts = 120, tolerances = 4 };

static const double tolerance_of[tolerances] = {1e-3, 1e-4, 1e-5, 1e-6};

/* Of impacts that end with OK: beyond the tolerance, beyond three of them, beyond the estimate,
 * beyond ten of it. */
struct count {
    int missed, far, low, far_too_low;
};

/* One impact, against the same at 1e-8, whose estimate is taken as its error. That is 2 psi
 * where slip had to be left out. */
static void judge(restitute_impact impact, double tolerance, struct count *count)
{
    const restitute_result fine = solve_pair(sync_to(1e-8), impact).result;
    const struct solution s = solve_impact(sync_to(tolerance), impact);
    const double z = certain_error(s.result.ez, fine.ez, fine.error_ez);
    const double x = certain_error(s.result.ex, fine.ex, fine.error_ex);
    const double error = s.status == RESTITUTE_OK ? fmax(z, x) : 0;
    const double low = fmax(z / s.result.error_ez, x / s.result.error_ex);
    CHECK(estimate_keeps_tolerance(&s, tolerance) && isfinite(s.result.ez) && isfinite(s.result.ex), "status %d",
          s.status);
    CHECK(fine.error_ez < 1e-7 && fine.error_ex < fmax(3e-7, 2.1 * impact.psi), "reference: %g, %g", fine.error_ez,
          fine.error_ex);
    count->missed += error > tolerance;
    count->far += error > 3 * tolerance;
    count->low += low > 1;
    count->far_too_low += low > 10;
    if (error > 3 * tolerance || low > 10)
        print_error("at %g: chi %.17g psi %.17g delta1 %.17g gamma %.17g: errors %g, %g; estimates %g, %g\n", tolerance,
                    impact.chi, impact.psi, impact.delta1, impact.gamma, z, x, s.result.error_ez, s.result.error_ex);
}

/* As for all impacts an estimate may be too low in one of twenty, give or take twice the scatter of
 * so few, and few of these lie near the tolerance. */
static void check_count(struct count c)
{
    CHECK(c.far == 0, "%d of %d beyond three tolerances", c.far, impacts);
    CHECK(c.missed <= impacts / 50, "%d of %d beyond the tolerance", c.missed, impacts);
    CHECK(c.far_too_low == 0, "%d of %d estimates ten times too low", c.far_too_low, impacts);
    CHECK(c.low <= impacts / 20 + 2 * sqrt(impacts / 20), "%d of %d estimates too low", c.low, impacts);
}

static void slip_passes_through_a_contact_that_relaxes_at_once(void **state)
{
    uint64_t random = 1;
    struct count count = {0};
    (void)state;
    for (int i = 0; i < impacts; i++)
        judge(blocked_impact(&random), tolerance_of[i % tolerances], &count);
    check_count(count);
}

static void strong_friction_leaves_thin_rings_of_slip(void **state)
{
    uint64_t random = 2;
    struct count count = {0};
    (void)state;
    for (int i = 0; i < impacts; i++) {
        const double tolerance = tolerance_of[i % tolerances];
        judge(thin_impact(&random, tolerance), tolerance, &count);
    }
    check_count(count);
    /* a tolerance is to be met in 99.5 % */
    CHECK(count.missed <= impacts / 200, "%d of %d beyond the tolerance", count.missed, impacts);
}

/* On both sides of the psi below which slip is left out: slip changes e_x by less than 2 psi. Slip
 * at the edge that began in the last step before the turning point once weighed as much there as in
 * a ring as wide as a cell. */
static void leaving_slip_out_changes_little(void **state)
{
    (void)state;
    const double below = solve_pair(sync_to(1e-3), impact_of(1.106, 1.2e-4, 0.124, 0.2997)).result.ex;
    const double above = solve_pair(sync_to(1e-3), impact_of(1.106, 1.3e-4, 0.124, 0.2997)).result.ex;
    CHECK_NEAR(below, 0.2312, 1e-3, "without slip");
    CHECK_NEAR(above, 0.2312, 1e-3, "with slip");
}

/* U' swings many times. Two coarse runs, or two walks, were alike by chance, or the walk was taken
 * though finer runs had found the front. References: runs of sync at 1e-8, and the method cvode at
 * 1e-6, which agree to the error given. */
static void two_results_at_large_chi_do_not_agree_by_chance(void **state)
{
    static const struct {
        double chi, psi, delta1, gamma, tolerance, ex, error;
    } cases[] = {
        {276.631, 2.52717e-4, 1.05664e-3, 4.89744e-3, 1e-4, 0.467167, 2e-6},
        {479.4427046, 7.75402043e-4, 0.047306994441, 0.010417789566, 1e-4, 0.114701, 2e-6},
        {107.8142235, 6.27493601e-5, 0.121106517478, 0.742910649650, 1e-4, 0.172645, 2e-6},
        {133.1546101, 2.02311842e-4, 0.108974534583, 0.056555144687, 1e-6, 0.093466, 2e-6},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct solution s = solve_impact(sync_to(cases[i].tolerance),
                                               impact_of(cases[i].chi, cases[i].psi, cases[i].delta1, cases[i].gamma));
        CHECK(estimate_keeps_tolerance(&s, cases[i].tolerance), "chi = %g: status %d", cases[i].chi, s.status);
        CHECK_NEAR(s.result.ex, cases[i].ex, s.result.error_ex + cases[i].error, "chi = %g", cases[i].chi);
    }
}

/* With 1536 points panels are so short against the fast term that the iterations are lost. The
 * finest number that works is taken, and not 24, whose estimate is 1e-4. */
static void given_points_fall_back_to_the_finest_that_work(void **state)
{
    const double tau[] = {1e-6, 0.3}, g[] = {100, 1};
    restitute_material *solid = solid_of(1, 0, 2, tau, g);
    restitute_options options = sync_to(1e-3);
    (void)state;
    options.elements = 1536;
    const struct solution s = solve_impact(options, impact_on(solid, 7.0 / 6, 1.5));
    CHECK(s.status == RESTITUTE_OK, "status %d", s.status);
    CHECK(s.result.elements >= 384, "%d points", (int)s.result.elements);
    CHECK(s.result.error_ex < 1e-7, "estimate %g", s.result.error_ex);
    restitute_material_destroy(solid);
}

/* The sphere vibrates faster than so few elements can follow: coarser runs agree by chance. The
 * true values are those of both methods at 1e-6. */
static void estimates_of_given_elements_cover_the_error(void **state)
{
    restitute_options sync = sync_to(0.00712), euler = to_tolerance(1e-2);
    (void)state;
    sync.elements = 4;
    euler.elements = 16;
    const struct restitute_result s = solve_pair(sync, impact_of(74.3258, 0.128238, 0.0126552, 0.0101833)).result,
                                  e = solve_pair(euler, impact_of(79.5495, 0.184036, 6.57322, 157.327)).result;
    CHECK_NEAR(s.ex, 0.33221, s.error_ex, "sync");
    CHECK_NEAR(e.ex, 0.25737, e.error_ex, "euler");
    CHECK(s.error_ex < 0.3 && e.error_ex < 0.3, "estimates %g, %g", s.error_ex, e.error_ex);
    euler.max_work = 2e-3; /* none is left to compare with */
    const struct solution alone = solve_impact(euler, impact_of(79.5495, 0.184036, 6.57322, 157.327));
    CHECK(alone.status == RESTITUTE_TOLERANCE_NOT_REACHED && alone.result.ex == e.ex, "%d: %g", alone.status,
          alone.result.ex);
    CHECK(alone.result.error_ex == 2, "estimate %g", alone.result.error_ex);
}

/* The pieces that are kept here take 0.012 nominal seconds, those that are tried thirty times as
 * long. */
static void trials_of_pieces_have_a_limit(void **state)
{
    const restitute_impact impact = impact_of(573.493037683, 0.00283016226202, 193934.234368, 134075.355751);
    restitute_options options = sync_to(0.01);
    (void)state;
    for (int i = 0; i < 2; i++) {
        restitute_result r;
        restitute_result_init(&r);
        options.max_work = i == 0 ? 0.03 : 1;
        const int status = restitute_solve_many(1, &impact, &options, &r, NULL, NULL);
        CHECK(status == (i == 0 ? RESTITUTE_ERROR_TOO_MUCH_WORK : RESTITUTE_OK), "%g: %d", options.max_work, status);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slip_passes_through_a_contact_that_relaxes_at_once),
        cmocka_unit_test(strong_friction_leaves_thin_rings_of_slip),
        cmocka_unit_test(leaving_slip_out_changes_little),
        cmocka_unit_test(two_results_at_large_chi_do_not_agree_by_chance),
        cmocka_unit_test(given_points_fall_back_to_the_finest_that_work),
        cmocka_unit_test(estimates_of_given_elements_cover_the_error),
        cmocka_unit_test(trials_of_pieces_have_a_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
