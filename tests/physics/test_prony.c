/* General Prony solids: truth values, a solid that never rebounds, limits of single terms, merging.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/data.h"
#include "../support/random.h"
#include "../support/solve.h"

static const double solid_sphere = 7.0 / 6.0;

/* The promise of the default method. */
static const double default_error = 1e-3;

/* Rows of prony_truth.csv. */
static void maxwell_body_with_tau_3_rebounds(void **state)
{
    (void)state;
    const double tau[] = {3}, g[] = {1};
    restitute_material *solid = solid_of(0, 0, 1, tau, g);
    struct solution s = solve_impact(default_options(), impact_on(solid, solid_sphere, 2));
    CHECK_NEAR(s.result.ez, 0.651750493, default_error, "ez");
    CHECK_NEAR(s.result.ex, 0.442348560, default_error, "ex");
    CHECK(s.status == RESTITUTE_OK, "status %d", s.status);
    restitute_material_destroy(solid);
}

static void two_terms_have_the_true_pair(void **state)
{
    (void)state;
    const double tau[] = {1.5, 0.2}, g[] = {2, 0.5};
    restitute_material *solid = solid_of(1, 0, 2, tau, g);
    struct solution s = solve_impact(default_options(), impact_on(solid, solid_sphere, 1.5));
    CHECK_NEAR(s.result.ez, 0.685603357, default_error, "ez");
    CHECK_NEAR(s.result.ex, 0.413696092, default_error, "ex");
    restitute_material_destroy(solid);
}

static restitute_scene steel_ball(const restitute_material *material, double speed)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = material;
    scene.radius1 = 5e-3;
    scene.mass1 = 7800 * 4.0 / 3.0 * 3.14159265358979323846 * 1.25e-7;
    scene.friction = 0.3;
    scene.normal_speed = speed;
    scene.tangential_speed = 2 * 0.3 * speed * 1.5; /* psi = 2: (2-2nu)/(2-nu) = 2/3 */
    return scene;
}

static void polyisobutylene_at_1_m_s_has_the_true_pair(void **state)
{
    (void)state;
    double tau[pib_terms], g[pib_terms];
    read_pib(tau, g);
    restitute_material *pib = solid_of(0, 0, pib_terms, tau, g);
    restitute_scene scene = steel_ball(pib, 1);
    struct solution s = solve_scene(default_options(), &scene);
    CHECK_NEAR(s.result.ez, 0.280916784, default_error, "ez");
    CHECK_NEAR(s.result.ex, 0.151295099, default_error, "ex");
    CHECK(s.result.terms_merged >= 10, "30 terms over 18 decades, only %d merged", (int)s.result.terms_merged);
    restitute_material_destroy(pib);
}

static void maxwell_body_with_tau_0_2_never_rebounds(void **state)
{
    (void)state;
    const double tau[] = {0.2}, g[] = {1};
    restitute_material *solid = solid_of(0, 0, 1, tau, g);
    const double psi[] = {0, 0.5, 2, 5};
    for (int i = 0; i < 4; i++) {
        struct solution s = solve_impact(default_options(), impact_on(solid, solid_sphere, psi[i]));
        CHECK(s.status == RESTITUTE_NO_REBOUND, "psi %g: status %d", psi[i], s.status);
        CHECK(s.result.ez == 0 && isinf(s.result.contact_time), "ez %g, time %g", s.result.ez, s.result.contact_time);
        /* all tangential motion dies out too unless slip persists: then (27) with ez = 0 */
        double limit = psi[i] > 2 * solid_sphere ? 2 * solid_sphere / psi[i] - 1 : 0;
        CHECK_NEAR(s.result.ex, limit, default_error, "psi %g", psi[i]);
        CHECK(fabs(s.result.ex - limit) <= s.result.error_ex + 1e-9, "estimate %g", s.result.error_ex);
        CHECK(!signbit(s.result.ez) && (s.result.ex != 0 || !signbit(s.result.ex)), "negative zero");
    }
    restitute_material_destroy(solid);
}

static void dashpot_alone_lets_the_sphere_sink_to_the_closed_depth(void **state)
{
    (void)state;
    /* D'' = -(15/8) theta sqrt(D) D' gives D' = 1 - (5/4) theta D^(3/2) */
    restitute_material *solid = solid_of(0, 0.7, 0, NULL, NULL);
    struct solution s = solve_impact(default_options(), impact_on(solid, solid_sphere, 0.5));
    CHECK(s.status == RESTITUTE_NO_REBOUND, "status %d", s.status);
    /* position-first Euler keeps this first integral but for the step: one part in a thousand */
    CHECK_NEAR(s.result.max_indentation, pow(0.8 / 0.7, 2.0 / 3.0), 2e-3, "depth");
    restitute_material_destroy(solid);
}

/* Two solids that must give the same pair; equal elements and step, so that only the solids
 * differ. */
static void check_same(const restitute_material *a, const restitute_material *b, double tolerance, const char *what)
{
    const double psi[] = {0.3, 1.5};
    restitute_options options = as_told(48, 2e-3);
    for (int i = 0; i < 2; i++) {
        struct solution x = solve_impact(options, impact_on(a, solid_sphere, psi[i]));
        struct solution y = solve_impact(options, impact_on(b, solid_sphere, psi[i]));
        CHECK_NEAR(x.result.ez, y.result.ez, tolerance, "%s, psi %g", what, psi[i]);
        CHECK_NEAR(x.result.ex, y.result.ex, tolerance, "%s, psi %g", what, psi[i]);
    }
}

/* docs/theory.md, section 7. The tolerances are the size of what is left of the term: g t/tau, g
 * tau^2, g. */
static void limits_of_single_terms_hold(void **state)
{
    (void)state;
    const double slow_tau[] = {0.5, 3e6}, slow_g[] = {0.7, 0.4}, fast_tau[] = {1e-5, 0.5}, fast_g[] = {2e4, 0.7},
                 small_tau[] = {0.5, 1}, small_g[] = {0.7, 1e-7}, tau[] = {0.5}, g[] = {0.7};
    restitute_material *slow = solid_of(1, 0, 2, slow_tau, slow_g), *stiffer = solid_of(1.4, 0, 1, tau, g);
    check_same(slow, stiffer, 0.4 * 3 / 3e6 * 10, "tau -> inf joins G_inf");
    restitute_material *fast = solid_of(1, 0, 2, fast_tau, fast_g), *damped = solid_of(1, 0.2, 1, tau, g);
    check_same(fast, damped, 2e4 * 1e-10 * 10, "tau -> 0 at constant g tau joins eta");
    restitute_material *small = solid_of(1, 0, 2, small_tau, small_g), *without = solid_of(1, 0, 1, tau, g);
    check_same(small, without, 1e-7 * 10, "g -> 0 drops out");
    restitute_material *all[] = {slow, stiffer, fast, damped, small, without};
    for (int i = 0; i < 6; i++)
        restitute_material_destroy(all[i]);
}

static void order_and_splitting_of_terms_do_not_matter(void **state)
{
    (void)state;
    const double tau[] = {0.1, 1, 4}, g[] = {1, 0.5, 2}, shuffled_tau[] = {4, 0.1, 1}, shuffled_g[] = {2, 1, 0.5},
                 split_tau[] = {0.1, 1, 1.0000001, 4}, split_g[] = {1, 0.2, 0.3, 2};
    restitute_material *a = solid_of(1, 0.1, 3, tau, g), *b = solid_of(1, 0.1, 3, shuffled_tau, shuffled_g),
                       *c = solid_of(1, 0.1, 4, split_tau, split_g);
    check_same(a, b, 0, "shuffled: the same bits");
    check_same(a, c, 1e-6, "split: ten times the relative difference of the times");
    restitute_material_destroy(a);
    restitute_material_destroy(b);
    restitute_material_destroy(c);
}

/* The change of the pair by merging is below its bound. The reference has the same terms at a
 * tolerance so small that none is merged, with the elements and the step of the merged run, so that
 * only merging differs. */
static void merging_changes_the_pair_by_less_than_its_bound(void **state)
{
    (void)state;
    uint64_t random = 30;
    int merged = 0;
    for (int i = 0; i < 60; i++) {
        double tau[12], g[12];
        for (int k = 0; k < 12; k++) {
            tau[k] = pow(10, -7 + k + random_in(&random, 0, 0.9));
            g[k] = random_log(&random, 1e-2, 1) * (tau[k] < 0.1 ? fmin(1e3, 0.1 / tau[k]) : 1);
        }
        restitute_material *solid = solid_of(random_below(&random, 4) ? 1 : 0, 0, 12, tau, g);
        /* psi > 0: without slip elements leave with a force, and the instant of leaving shows at 32
         * elements */
        const double psi = random_log(&random, 0.1, 5), chi = random_in(&random, 0.4, 3);
        restitute_impact impact = impact_on(solid, chi, psi);
        restitute_options options = to_tolerance(1e-2);
        options.elements = 32;
        struct restitute_result r = solve_pair(options, impact).result;
        options = as_told(32, r.time_step);
        options.tolerance = 1e-8;
        struct restitute_result all = solve_pair(options, impact).result;
        CHECK(all.merging_bound <= 1e-9, "reference merged with a bound of %g", all.merging_bound);
        CHECK_NEAR(r.ez, all.ez, r.merging_bound + 1e-9, "solid %d, %d merged", i, (int)r.terms_merged);
        CHECK_NEAR(r.ex, all.ex, r.merging_bound + 1e-9, "solid %d, %d merged", i, (int)r.terms_merged);
        CHECK(r.merging_bound <= 2e-3, "bound %g above its share of the tolerance, 1e-3 and 1e-3", r.merging_bound);
        merged += (int)r.terms_merged;
        restitute_material_destroy(solid);
    }
    CHECK(merged >= 300, "only %d of 720 terms merged: nothing tested", merged);
}

/* If the contact lasts longer than the time for which slow terms were merged, it is solved again
 * with these terms: with a strong dashpot the sphere leaves so slowly that they relax. The bound
 * holds for the computed contact time. */
static void slow_terms_count_in_long_contacts(void **state)
{
    (void)state;
    const double tau = 2;
    int merged = 0;
    for (double eta = 20; eta < 300; eta *= 2)
        for (double g = 1e-3; g < 5; g *= 1.3) {
            restitute_material *solid = solid_of(1, eta, 1, &tau, &g);
            struct restitute_result r = solve_pair(default_options(), impact_on(solid, solid_sphere, 1)).result;
            CHECK(r.merging_bound <= 2e-4, "eta %g, g %g: bound %g above its shares of the tolerance, 1e-4 and 1e-4",
                  eta, g, r.merging_bound);
            merged += (int)r.terms_merged;
            restitute_material_destroy(solid);
        }
    CHECK(merged >= 5, "%d merged: nothing tested", merged);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maxwell_body_with_tau_3_rebounds),
        cmocka_unit_test(two_terms_have_the_true_pair),
        cmocka_unit_test(polyisobutylene_at_1_m_s_has_the_true_pair),
        cmocka_unit_test(maxwell_body_with_tau_0_2_never_rebounds),
        cmocka_unit_test(dashpot_alone_lets_the_sphere_sink_to_the_closed_depth),
        cmocka_unit_test(limits_of_single_terms_hold),
        cmocka_unit_test(order_and_splitting_of_terms_do_not_matter),
        cmocka_unit_test(merging_changes_the_pair_by_less_than_its_bound),
        cmocka_unit_test(slow_terms_count_in_long_contacts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
