/* The error that a table promises, at ten thousand random places a table (fewer with sanitizers), against impacts solved by themselves.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/table.h"

/* Sanitizers make an impact some ten times as dear, and look at the code, not at the numbers. */
#ifdef RESTITUTE_SANITIZED
enum { places = 300 };
#else
enum { places = 10000 };
#endif

struct extremes {
    double ez, ex;
};

/* Two of five with psi < 1, the others up to well beyond psi_c. */
static struct extremes compare(const restitute_table *table, restitute_scene scene, double tolerance)
{
    restitute_options options = to_tolerance(tolerance / 4); /* the impact may be off by a part of what the table may */
    restitute_solver *solver;
    restitute_error error;
    struct extremes worst = {0, 0};
    uint64_t state = 6;
    options.method = restitute_method_sync();
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    for (int i = 0; i < places; i++) {
        restitute_result result;
        restitute_result_init(&result);
        scene.normal_speed = random_log(&state, 1e-4, 100);
        const double psi = random_in(&state, 0, random_below(&state, 5) < 2 ? 1 : 4);
        scene.tangential_speed = psi * scene.normal_speed / PSI_FACTOR;
        CHECK(restitute_solve_scene(solver, &scene, &result, NULL, NULL, &error) == RESTITUTE_OK, "%s", error.message);
        const restitute_table_value pair = look_up(table, scene.normal_speed, scene.tangential_speed);
        const double ez = fabs(pair.ez - result.ez), ex = fabs(pair.ex - result.ex);
        CHECK(ez <= tolerance && ex <= tolerance, "v_n = %g, psi = %g: off by %g and %g, tolerance %g",
              scene.normal_speed, psi, ez, ex, tolerance);
        worst.ez = fmax(worst.ez, ez);
        worst.ex = fmax(worst.ex, ex);
    }
    restitute_solver_destroy(solver);
    return worst;
}

static void check_table(double gamma, double tolerance)
{
    restitute_material *material;
    restitute_table_info info;
    const restitute_scene scene = ball_on(gamma, &material);
    restitute_table *table = table_of(&scene, 1e-4, 100, tolerance);
    restitute_table_info_init(&info);
    assert_int_equal(restitute_table_describe(table, &info, NULL), RESTITUTE_OK);
    CHECK(info.error_ez <= tolerance && info.error_ex <= tolerance && info.checks > 50, "%g, %g at %lld checks",
          info.error_ez, info.error_ex, (long long)info.checks);
    const struct extremes worst = compare(table, scene, tolerance);
    print_message("gamma = %g, %g: verified %.1e %.1e, at %d random places %.1e %.1e\n", gamma, tolerance,
                  info.error_ez, info.error_ex, places, worst.ez, worst.ex);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

static void kelvin_voigt(void **state)
{
    (void)state;
    check_table(0, 1e-5);
}

static void standard_solid(void **state)
{
    (void)state;
    check_table(1, 1e-5);
    check_table(0.1, 1e-4);
}

static restitute_table *table_of_ranges(const restitute_table_family *family, double tolerance)
{
    restitute_table_options options;
    restitute_table *table = NULL;
    restitute_error error;
    restitute_table_options_init(&options);
    options.tolerance = tolerance;
    options.threads = 2;
    CHECK(restitute_table_build(family, &options, &table, &error) == RESTITUTE_OK, "%s", error.message);
    return table;
}

/* chi of what is solid or hollow and rolls, at random places of such a table. */
static void check_ranges(double delta1_low, double delta1_high, double gamma_low, double gamma_high, double tolerance)
{
    restitute_table_family family;
    restitute_error error;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(tolerance / 10);
    struct extremes worst = {0, 0};
    uint64_t random = 8;
    restitute_table_family_init(&family);
    family.chi[0] = 2.0 / 3, family.chi[1] = 7.0 / 4;
    family.delta1[0] = delta1_low, family.delta1[1] = delta1_high;
    family.gamma[0] = gamma_low, family.gamma[1] = gamma_high;
    restitute_table *table = table_of_ranges(&family, tolerance);
    precise.method = restitute_method_sync();
    CHECK(restitute_solver_create(&precise, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    for (int i = 0; i < places; i++) {
        restitute_table_value pair;
        restitute_result result;
        restitute_result_init(&result);
        const double gamma = random_log(&random, gamma_low, gamma_high);
        const double delta1 = random_log(&random, delta1_low, delta1_high);
        const double psi = random_in(&random, 0, 4), chi = random_in(&random, 2.0 / 3, 7.0 / 4);
        const restitute_impact impact = impact_of(chi, psi, delta1, gamma);
        CHECK(restitute_solve(solver, &impact, &result, NULL, NULL, &error) == RESTITUTE_OK, "%s", error.message);
        assert_int_equal(
            restitute_table_numbers_pair(table, impact.chi, impact.psi, impact.delta1, impact.gamma, &pair),
            RESTITUTE_OK);
        worst.ez = fmax(worst.ez, fabs(pair.ez - result.ez));
        worst.ex = fmax(worst.ex, fabs(pair.ex - result.ex));
        /* a tenth: what the impact itself may be off */
        CHECK_NEAR(pair.ez, result.ez, 1.1 * tolerance, "impact %d", i);
        CHECK_NEAR(pair.ex, result.ex, 1.1 * tolerance, "impact %d: chi %g psi %g delta1 %g gamma %g", i, impact.chi,
                   impact.psi, impact.delta1, impact.gamma);
    }
    print_message("four axes, %g: at %d random places %.1e %.1e\n", tolerance, places, worst.ez, worst.ex);
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
}

/* Where ex is smooth, and across the layer where it turns (docs/table.md). */
static void ranges(void **state)
{
    (void)state;
#ifdef RESTITUTE_SANITIZED
    check_ranges(0.1, 1, 0.5, 2, 1e-2);
#else
    check_ranges(0.01, 0.1, 0.5, 2, 1e-4);
    check_ranges(0.5, 3.5, 0.07, 0.4, 1e-3);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(kelvin_voigt), cmocka_unit_test(standard_solid),
                                       cmocka_unit_test(ranges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
