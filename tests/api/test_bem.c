/* What bem.h promises.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/bem.h>
#include <string.h>

#include "../support/solve.h"

static restitute_options options_of(int64_t elements, double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = restitute_method_bem();
    options.elements = elements;
    return options;
}

static void names(void **state)
{
    (void)state;
    assert_string_equal(restitute_method_name(restitute_method_bem()), "bem");
    assert_string_equal(restitute_method_name(restitute_method_bem_paper()), "bem-paper");
}

/* Solve a case that must fail; returns the message. */
static restitute_error refused(restitute_options options, restitute_impact impact, int status)
{
    restitute_solver *solver;
    restitute_error error;
    restitute_result result;
    restitute_result_init(&result);
    result.ez = 77;
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(restitute_solve(solver, &impact, &result, NULL, NULL, &error) == status, "%s", error.message);
    assert_true(result.ez == 77);
    assert_int_equal(error.status, status);
    restitute_solver_destroy(solver);
    return error;
}

static void refusals(void **state)
{
    restitute_error error = refused(options_of(0, 1e-3), impact_of(1, 0.5, 1, 0), RESTITUTE_ERROR_DOMAIN);
    (void)state;
    assert_non_null(strstr(error.message, "no instantaneous modulus"));
    error = refused(options_of(2001, 1e-3), impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_DOMAIN);
    assert_non_null(strstr(error.message, "elements = 2001: must be in [4, 2000]"));
    restitute_options options = options_of(0, 1e-3);
    options.time_step = 3;
    error = refused(options, impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_UNSTABLE_STEP);
    assert_non_null(strstr(error.message, "time_step = 3 T: must be below half the time of contact"));
    options.time_step = 1e100;
    error = refused(options, impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_UNSTABLE_STEP);
    assert_non_null(strstr(error.message, "time_step = 1e+100 T: must be below"));
    options.time_step = 1e-100; /* more steps than an integer counts */
    error = refused(options, impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_TOO_MUCH_WORK);
    options.time_step = 1e-12;
    error = refused(options, impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_TOO_MUCH_WORK);
    assert_non_null(strstr(error.message, "max_work = 10: "));
    options = options_of(0, 1e-3);
    options.max_work = 1e-8;
    error = refused(options, impact_of(1, 0.5, 1, 1), RESTITUTE_ERROR_TOO_MUCH_WORK);
    assert_non_null(strstr(error.message, "too little for the two runs of a result"));
    options = options_of(0, 1e-3);
    error = refused(options, impact_of(1, 0.5, 1e3, 1e-40), RESTITUTE_ERROR_CONVERGENCE);
    assert_non_null(strstr(error.message, "no box"));
}

static void an_infinite_psi_is_no_friction(void **state)
{
    const struct solution s = solve_impact(options_of(0, 1e-2), impact_of(7.0 / 6, INFINITY, 1, 1));
    (void)state;
    assert_true(s.result.ex == -1 && s.result.error_ex == 0);
}

static void tolerance_is_met_or_told(void **state)
{
    const struct solution rough = solve_impact(options_of(0, 1e-2), impact_of(1, 0.5, 1, 1));
    const struct solution fine = solve_impact(options_of(0, 1e-3), impact_of(1, 0.5, 1, 1));
    const struct solution told = solve_impact(options_of(16, 1e-8), impact_of(1, 0.5, 1, 1));
    (void)state;
    assert_int_equal(rough.status, RESTITUTE_OK);
    assert_int_equal(fine.status, RESTITUTE_OK);
    assert_true(fine.result.error_ex <= 1e-3 && fine.result.elements >= rough.result.elements);
    assert_int_equal(told.status, RESTITUTE_TOLERANCE_NOT_REACHED);
    assert_int_equal(told.result.elements, 16);
    assert_true(isnan(fine.result.speed_ratio) && fine.result.work > 0 && fine.result.terms_merged == 0);
}

/* Nothing is left over from a solver's other impacts, and a fresh solver gives the same bits. */
static void repeats_its_bits(void **state)
{
    const restitute_options options = options_of(16, 0.1);
    restitute_solver *solver;
    restitute_result first, again;
    const restitute_impact impact = impact_of(1, 0.5, 1, 1), other = impact_of(2, 2, 0, INFINITY);
    (void)state;
    assert_int_equal(restitute_solver_create(&options, &solver, NULL), RESTITUTE_OK);
    restitute_result_init(&first);
    restitute_result_init(&again);
    assert_int_equal(restitute_solve(solver, &impact, &first, NULL, NULL, NULL), RESTITUTE_OK);
    assert_int_equal(restitute_solve(solver, &other, &again, NULL, NULL, NULL), RESTITUTE_OK);
    assert_int_equal(restitute_solve(solver, &impact, &again, NULL, NULL, NULL), RESTITUTE_OK);
    assert_memory_equal(&first, &again, sizeof first);
    restitute_solver_destroy(solver);
    restitute_impact impacts[4] = {impact, other, impact, other};
    restitute_result results[4];
    for (int i = 0; i < 4; i++)
        restitute_result_init(&results[i]);
    restitute_options threaded = options;
    threaded.threads = 2;
    assert_int_equal(restitute_solve_many(4, impacts, &threaded, results, NULL, NULL), RESTITUTE_OK);
    assert_memory_equal(&first, &results[2], sizeof first);
}

/* A ledger, which looks at what is left in the solid, changes no bit of the result, nor what it
 * cost. */
static void a_ledger_changes_nothing(void **state)
{
    const restitute_options options = options_of(29, 0.1);
    const restitute_impact impacts[] = {impact_of(7.0 / 6, 0.7, 1, 1), impact_of(2, 0.3, 3, 0.3),
                                        impact_of(1, 0.5, 0, INFINITY)};
    (void)state;
    for (int i = 0; i < 3; i++) {
        restitute_solver *solver;
        restitute_result with, without;
        restitute_ledger ledger;
        restitute_result_init(&with);
        restitute_result_init(&without);
        restitute_ledger_init(&ledger);
        assert_int_equal(restitute_solver_create(&options, &solver, NULL), RESTITUTE_OK);
        assert_int_equal(restitute_solve(solver, &impacts[i], &with, &ledger, NULL, NULL), RESTITUTE_OK);
        assert_int_equal(restitute_solve(solver, &impacts[i], &without, NULL, NULL, NULL), RESTITUTE_OK);
        assert_memory_equal(&with, &without, sizeof with);
        restitute_solver_destroy(solver);
    }
}

/* A scene in SI units is the same impact as its numbers. */
static void scene(void **state)
{
    restitute_material *rubber;
    restitute_scene s;
    restitute_numbers numbers;
    (void)state;
    assert_int_equal(restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, NULL), RESTITUTE_OK);
    restitute_scene_init(&s);
    restitute_numbers_init(&numbers);
    s.material = rubber, s.radius1 = 0.005, s.mass1 = 0.004, s.friction = 0.3, s.normal_speed = 1.0,
    s.tangential_speed = 0.8;
    assert_int_equal(restitute_scene_numbers(&s, &numbers, NULL), RESTITUTE_OK);
    const struct solution si = solve_scene(options_of(16, 0.1), &s);
    const struct solution own =
        solve_impact(options_of(16, 0.1), impact_of(numbers.chi, numbers.psi, numbers.delta1, numbers.gamma));
    CHECK_NEAR(si.result.ex, own.result.ex, 1e-8, "ex"); /* the inputs differ by rounding, the sets of cells do not */
    CHECK_NEAR(si.result.contact_time / numbers.time, own.result.contact_time, 1e-8, "contact time");
    restitute_material_destroy(rubber);
}

enum { samples = 11 };

static void history_and_snapshots(void **state)
{
    restitute_bem_recorder *recorder = NULL;
    restitute_bem_snapshot shot;
    restitute_error error;
    restitute_solver *solver;
    restitute_result result;
    restitute_history history;
    double time[samples], force[samples], velocity[samples], stick[samples], radius[samples];
    const restitute_impact impact = impact_of(7.0 / 6, 0.7, 1, 1);
    (void)state;
    assert_int_equal(restitute_bem_recorder_create(3, &recorder, &error), RESTITUTE_OK);
    assert_true(restitute_bem_recorder_count(recorder) == 0);
    restitute_bem_snapshot_init(&shot);
    assert_int_equal(restitute_bem_recorder_get(recorder, 0, &shot, &error), RESTITUTE_ERROR_DOMAIN);
    assert_non_null(strstr(error.message, "no snapshots"));
    restitute_options options = options_of(20, 0.1);
    options.method = restitute_bem_recorder_method(recorder);
    assert_string_equal(restitute_method_name(options.method), "bem");
    assert_int_equal(restitute_solver_create(&options, &solver, &error), RESTITUTE_OK);
    restitute_result_init(&result);
    restitute_history_init(&history);
    history.capacity = samples;
    history.time = time, history.normal_force = force, history.normal_velocity = velocity;
    history.stick_radius = stick, history.contact_radius = radius;
    assert_int_equal(restitute_solve(solver, &impact, &result, NULL, &history, &error), RESTITUTE_OK);
    assert_true(history.count == samples && time[0] == 0 && force[samples - 1] == 0 && force[4] > 0);
    CHECK_NEAR(time[samples - 1], result.contact_time, 0, "last sample");
    CHECK_NEAR(velocity[samples - 1], -result.ez, 1e-3, "rebound; the result is extrapolated, the history is not");
    for (int i = 0; i < samples; i++)
        CHECK(stick[i] <= radius[i] && (i == 0 || time[i] > time[i - 1]), "sample %d", i);
    assert_int_equal(restitute_bem_recorder_count(recorder), 3);
    assert_int_equal(restitute_bem_recorder_get(recorder, 1, &shot, &error), RESTITUTE_OK);
    CHECK_NEAR(shot.time, result.contact_time / 2, 2 * result.time_step, "the middle one");
    double sum = 0;
    size_t sticking = 0, broken = 0;
    for (size_t i = 0; i < shot.cells * shot.cells; i++) {
        sum += shot.pressure[i];
        sticking += shot.stick[i] > 0;
        broken += fabs(shot.traction[i]) > shot.pressure[i] * (1 + 1e-12);
    }
    assert_true(sticking > 0 && broken == 0);
    assert_true(shot.pressure[0] == 0 && shot.pressure[shot.cells / 2 * (shot.cells + 1)] > 0);
    CHECK_NEAR(15.0 / 64 * sum * shot.spacing * shot.spacing, force[5], 0.02,
               "its sum is the force"); /* samples differ by half a step */
    assert_int_equal(restitute_bem_recorder_get(recorder, 3, &shot, &error), RESTITUTE_ERROR_DOMAIN);
    assert_int_equal(restitute_bem_recorder_get(NULL, 0, &shot, &error), RESTITUTE_ERROR_NULL);
    shot.struct_size = 1;
    assert_int_equal(restitute_bem_recorder_get(recorder, 0, &shot, &error), RESTITUTE_ERROR_STRUCT_SIZE);
    assert_int_equal(restitute_bem_recorder_create(0, &recorder, &error), RESTITUTE_ERROR_DOMAIN);
    assert_int_equal(restitute_bem_recorder_create(1, NULL, &error), RESTITUTE_ERROR_NULL);
    restitute_solver_destroy(solver);
    restitute_bem_recorder_destroy(recorder);
    restitute_bem_recorder_destroy(NULL);
    assert_null(restitute_bem_recorder_method(NULL));
}

/* At the contact time an elastic sphere is where it touched first and flies as the result says: the
 * three columns of the last row are of one instant, though the last step ends later. */
static void history_ends_with_the_contact(void **state)
{
    enum { rows = 21 };
    double time[rows], depth[rows], velocity[rows];
    restitute_solver *solver;
    restitute_result result;
    restitute_history history;
    const restitute_options options = options_of(60, 0.1);
    const restitute_impact impact = impact_of(7.0 / 6, 0.5, 0, INFINITY);
    (void)state;
    assert_int_equal(restitute_solver_create(&options, &solver, NULL), RESTITUTE_OK);
    restitute_result_init(&result);
    restitute_history_init(&history);
    history.capacity = rows, history.time = time, history.indentation = depth, history.normal_velocity = velocity;
    assert_int_equal(restitute_solve(solver, &impact, &result, NULL, &history, NULL), RESTITUTE_OK);
    assert_int_equal(history.count, rows);
    CHECK_NEAR(time[rows - 1], result.contact_time, 0, "time of the last row");
    /* a step is 0.0147: a depth of the step's end would be off by up to that */
    CHECK_NEAR(depth[rows - 1], 0, 1e-3, "indentation of the last row");
    CHECK_NEAR(velocity[rows - 1], -1, 1e-5, "velocity of the last row"); /* elastic: exact to the iterations */
    restitute_solver_destroy(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(names),
                                       cmocka_unit_test(refusals),
                                       cmocka_unit_test(an_infinite_psi_is_no_friction),
                                       cmocka_unit_test(tolerance_is_met_or_told),
                                       cmocka_unit_test(repeats_its_bits),
                                       cmocka_unit_test(a_ledger_changes_nothing),
                                       cmocka_unit_test(scene),
                                       cmocka_unit_test(history_and_snapshots),
                                       cmocka_unit_test(history_ends_with_the_contact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
