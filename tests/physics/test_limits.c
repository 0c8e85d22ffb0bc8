/* Limits of the normal problem, and limits of friction, that are known exactly.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/thin_slip.h"

/* Contact time of an elastic sphere in T: 2.9432751843. */
static const double elastic_contact_time = 2.9432751843;

/* Bound on the error of a contact time: the end is dated within a step, and so is the exit of the
 * last element but one that it is continued from; the first-order rest is proportional to the step,
 * by less than one. */
static double contact_time_error(const restitute_result *r)
{
    return 3 * r->time_step;
}

static void elastic_contact_lasts_2_9433_T(void **state)
{
    (void)state;
    for (int64_t elements = 32; elements <= 512; elements *= 2) {
        struct restitute_result r = solve_pair(as_told(elements, 0), impact_of(7.0 / 6, 0, 0, INFINITY)).result;
        CHECK_NEAR(r.contact_time, elastic_contact_time, contact_time_error(&r), "%d elements", (int)elements);
        CHECK(contact_time_error(&r) < 0.3 / (double)elements, "the tolerance shrinks with the resolution");
    }
}

/* With steps far finer than elements the end is off by what the last elements leave open: 0.03 to
 * 0.07 dx^2. Where the way of the edge from the innermost element to the middle is continued
 * wrongly, it is off by 1/4 dx^2. */
static void end_of_contact_is_continued_to_the_middle(void **state)
{
    (void)state;
    for (int64_t elements = 4; elements <= 16; elements *= 2) {
        struct restitute_result r = solve_pair(as_told(elements, 1e-5), impact_of(7.0 / 6, 0, 0, INFINITY)).result;
        CHECK_NEAR(r.contact_time, elastic_contact_time, 0.1 * r.element_spacing * r.element_spacing, "%d elements",
                   (int)elements);
    }
}

/* Without damping the default is better than its tolerance by far: the first-order part of the
 * error vanishes and what is left is of the size of the step squared, about 1e-6. */
static void elastic_impact_rebounds_with_ez_1(void **state)
{
    (void)state;
    struct restitute_result r = solve_pair(default_options(), impact_of(7.0 / 6, 2, 0, INFINITY)).result;
    CHECK_NEAR(r.ez, 1, r.time_step * r.time_step, "elastic");
    CHECK_NEAR(r.max_indentation, 1, r.time_step * r.time_step, "d0 is the elastic indentation");
    /* (16/3) G a_el^3/(R (1-nu)) /2 in units m v^2/d0: (15/8) (2/3) = 5/4 */
    CHECK_NEAR(r.max_normal_force, 1.25, 2.5 * r.time_step, "the Hertz force at d0");
}

/* A relaxation time far above the contact time: the dashpot is frozen and both springs act, G1 +
 * G2. Lengths and times scale like (1 + 1/gamma)^(-2/5). The remaining damping is within the bound
 * of merging, 4 D^(5/2) (g/tau) t, with g/tau = 1/(gamma^2 theta). */
static void strongly_damped_standard_solid_is_elastic_with_both_springs(void **state)
{
    (void)state;
    const double gammas[] = {2e-4, 0.05, 0.5, 1, 4};
    for (size_t i = 0; i < sizeof gammas / sizeof *gammas; i++) {
        double gamma = gammas[i], scale = pow(1 + 1 / gamma, -0.4), theta = 1e7;
        struct restitute_result r =
            solve_pair(default_options(), impact_of(7.0 / 6, 2, theta / THETA_OF_DELTA1, gamma)).result;
        double damping = 4 * pow(scale, 2.5) / (gamma * gamma * theta) * elastic_contact_time * scale;
        CHECK(damping < 2e-4, "gamma %g: the limit is near enough, %g", gamma, damping);
        CHECK_NEAR(r.ez, 1, r.error_ez + damping, "gamma %g", gamma);
        CHECK_NEAR(r.max_indentation / scale, 1, r.error_ez + damping + r.time_step * r.time_step / scale / scale,
                   "gamma %g", gamma);
        CHECK_NEAR(r.contact_time, elastic_contact_time * scale, contact_time_error(&r) + damping * scale, "gamma %g",
                   gamma);
    }
}

/* ... and the approach to it: a dashpot a hundred times as strong is a hundred times nearer. */
static void damping_of_a_frozen_dashpot_falls_with_its_viscosity(void **state)
{
    (void)state;
    double lost[2];
    for (int i = 0; i < 2; i++)
        lost[i] = 1 - solve_pair(to_tolerance(1e-5), impact_of(7.0 / 6, 10, i ? 1e4 : 1e2, 1)).result.ez;
    /* the second-order term is the first times itself: at delta1 = 100 below 1 %; the error
     * estimates are 1e-5 */
    CHECK_NEAR(lost[0] / lost[1], 100, 1 + 100 * 1e-5 / lost[1], "lost %g and %g", lost[0], lost[1]);
}

/* No friction: the tangential motion does not change. */
static void without_friction_ex_is_minus_1(void **state)
{
    (void)state;
    restitute_material *rubber;
    restitute_scene scene;
    assert_int_equal(restitute_material_standard_solid(1e6, 2e6, 50, 0.5, &rubber, NULL), RESTITUTE_OK);
    restitute_scene_init(&scene);
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.normal_speed = 2;
    scene.tangential_speed = 1;
    struct solution s = solve_scene(default_options(), &scene);
    CHECK(s.result.ex == -1 && s.result.error_ex == 0, "ex %.17g +- %g", s.result.ex, s.result.error_ex);
    CHECK(s.ledger.rebound_x == 1 && s.ledger.friction_x == 0 && s.ledger.viscous_x == 0 && s.ledger.left_x == 0,
          "friction work %g", s.ledger.friction_x);
    restitute_material_destroy(rubber);
}

/* Elastic similarity decouples the normal problem: the same bits for any tangential motion. */
static void normal_problem_does_not_feel_the_tangential_one(void **state)
{
    (void)state;
    const double chis[] = {1.0 / 3, 0.5, 7.0 / 6, 4}, psis[] = {0, 0.05, 0.7, 1, 1.3, 3, 10};
    const double solids[][2] = {{0, 1}, {1, 1}, {0.3, 0}, {30, 0.02}}; /* delta1, gamma */
    for (size_t k = 0; k < 4; k++) {
        struct solution first =
            solve_impact(as_told(40, 2e-4), impact_of(chis[0], psis[0], solids[k][0], solids[k][1]));
        for (size_t i = 0; i < 4; i++)
            for (size_t j = 0; j < sizeof psis / sizeof *psis; j++) {
                struct solution s =
                    solve_impact(as_told(40, 2e-4), impact_of(chis[i], psis[j], solids[k][0], solids[k][1]));
                CHECK(s.result.ez == first.result.ez && s.result.contact_time == first.result.contact_time &&
                          s.result.max_indentation == first.result.max_indentation &&
                          s.result.max_normal_force == first.result.max_normal_force &&
                          s.ledger.viscous_z == first.ledger.viscous_z && s.ledger.left_z == first.ledger.left_z,
                      "solid %d, chi %g, psi %g", (int)k, chis[i], psis[j]);
            }
    }
}

/* Values of the elastic no-slip impact with five decimals: half of the last digit, and the method's
 * estimate. */
static void elastic_impact_without_slip_has_the_known_ex(void **state)
{
    (void)state;
    const double chis[] = {1, 7.0 / 6, 1.2558, 1.4375, 1.5226};
    const double known[] = {0.37507, 0.10397, -0.02333, -0.22836, -0.29620};
    for (int i = 0; i < 5; i++) {
        struct restitute_result r = solve_pair(to_tolerance(1e-5), impact_of(chis[i], 0, 0, INFINITY)).result;
        CHECK_NEAR(r.ex, known[i], 5e-6 + r.error_ex, "chi %g", chis[i]);
        double ez, ex; /* and as a user meets it */
        assert_int_equal(restitute_pair(chis[i], 0, 0, INFINITY, &ez, &ex, NULL), RESTITUTE_OK);
        CHECK_NEAR(ex, known[i], 1e-3, "chi %g by default", chis[i]);
    }
}

/* Large friction approaches no friction limit. Only the edge slips then, where the force is below q
 * ~ psi: e_x changes in proportion to psi. The slope was measured to be below 1/2 (64 to 512
 * elements, psi down to 1e-4); when only the outermost cell slips it is uncertain by as much again,
 * which 2 psi covers with a factor of two. */
static void strong_friction_approaches_no_slip(void **state)
{
    (void)state;
    const double chis[] = {0.5, 7.0 / 6, 3};
    for (int i = 0; i < 3; i++)
        for (int viscous = 0; viscous < 2; viscous++) {
            double limit = solve_pair(as_told(128, 0), impact_of(chis[i], 0, viscous, 1)).result.ex;
            double before = INFINITY;
            for (double psi = 0.1; psi > 1e-7; psi /= 10) {
                double distance =
                    fabs(solve_pair(as_told(128, 0), impact_of(chis[i], psi, viscous, 1)).result.ex - limit);
                CHECK(distance <= 2 * psi, "chi %g, psi %g: %g from the limit", chis[i], psi, distance);
                CHECK(distance <= before + 1e-12, /* rounding of some 4000 steps */
                      "chi %g, psi %g: %g after %g", chis[i], psi, distance, before);
                before = distance;
            }
        }
}

static void slip_that_is_left_out_changes_less_than_the_estimate(void **state)
{
    (void)state;
    check_thin_slip(to_tolerance(1e-3), 0.02);
    check_thin_slip(sync_to(1e-3), 0.02);
    check_thin_slip(sync_to(1e-4), 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_contact_lasts_2_9433_T),
        cmocka_unit_test(end_of_contact_is_continued_to_the_middle),
        cmocka_unit_test(elastic_impact_rebounds_with_ez_1),
        cmocka_unit_test(strongly_damped_standard_solid_is_elastic_with_both_springs),
        cmocka_unit_test(damping_of_a_frozen_dashpot_falls_with_its_viscosity),
        cmocka_unit_test(without_friction_ex_is_minus_1),
        cmocka_unit_test(normal_problem_does_not_feel_the_tangential_one),
        cmocka_unit_test(elastic_impact_without_slip_has_the_known_ex),
        cmocka_unit_test(strong_friction_approaches_no_slip),
        cmocka_unit_test(slip_that_is_left_out_changes_less_than_the_estimate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
