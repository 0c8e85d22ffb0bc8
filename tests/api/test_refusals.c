/* Bad input: refused by name, value and allowed range, with all outputs untouched.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/comma_locale.h"
#include "../support/solve.h"

static restitute_material *rubber;
static restitute_solver *solver;

static int set_up(void **state)
{
    (void)state;
    const double tau[] = {1e-3}, g[] = {2e6};
    rubber = solid_of(1e6, 0, 1, tau, g);
    return restitute_solver_create(NULL, &solver, NULL);
}

static int tear_down(void **state)
{
    (void)state;
    restitute_material_destroy(rubber);
    restitute_solver_destroy(solver);
    return 0;
}

static restitute_scene good_scene(void)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 0.004;
    scene.friction = 0.3;
    scene.normal_speed = 2;
    scene.tangential_speed = 1;
    return scene;
}

struct outputs {
    restitute_result result;
    restitute_ledger ledger;
    restitute_history history;
    double time[16];
};

static void prepare(struct outputs *o)
{
    memset(o, 0x5a, sizeof *o); /* a pattern, not zeros: an output set to zero would show */
    o->result.struct_size = sizeof o->result;
    o->ledger.struct_size = sizeof o->ledger;
    restitute_history_init(&o->history);
    o->history.capacity = 16;
    o->history.time = o->time;
}

/* The scene fails with `status`; its message holds `name` and every output keeps its bytes. */
static void refuse_scene(const restitute_scene *scene, int status, const char *name)
{
    struct outputs found, before;
    restitute_error error = {0};
    prepare(&found);
    memcpy(&before, &found, sizeof found);
    before.history.time = found.history.time;
    int got = restitute_solve_scene(solver, scene, &found.result, &found.ledger, &found.history, &error);
    CHECK(got == status && error.status == status, "%s: status %d, expected %d", name, got, status);
    CHECK(strstr(error.message, name) != NULL, "message \"%s\" does not name %s", error.message, name);
    CHECK(memcmp(&found, &before, sizeof found) == 0, "%s: an output was touched", name);
    double ez = 7, ex = 8;
    got = restitute_scene_pair(scene, &ez, &ex, NULL);
    CHECK(got == status && ez == 7 && ex == 8, "%s: one call gave %d, %g, %g", name, got, ez, ex);
}

static void every_field_of_a_scene_is_checked(void **state)
{
    (void)state;
    const struct {
        const char *name;
        size_t offset;
        double bad[6];
        int count;
    } fields[] = {
        {"radius1", offsetof(restitute_scene, radius1), {0, -1, NAN, INFINITY, 9e-51, 2e50}, 6},
        {"mass1", offsetof(restitute_scene, mass1), {0, -1, NAN, INFINITY, 9e-51, 2e50}, 6},
        {"radius2", offsetof(restitute_scene, radius2), {0, -1, NAN, -INFINITY, 9e-51, 2e50}, 6},
        {"mass2", offsetof(restitute_scene, mass2), {0, -1, NAN, -INFINITY, 9e-51, 2e50}, 6},
        {"inertia1", offsetof(restitute_scene, inertia1), {-1, NAN, INFINITY, 9e-151, 2e150}, 5},
        {"inertia2", offsetof(restitute_scene, inertia2), {-1, NAN, INFINITY, 9e-151, 2e150}, 5},
        {"friction", offsetof(restitute_scene, friction), {-0.1, NAN, -INFINITY, 9e-31}, 4},
        {"normal_speed", offsetof(restitute_scene, normal_speed), {0, -1, NAN, INFINITY, 9e-51, 2e50}, 6},
        {"tangential_speed", offsetof(restitute_scene, tangential_speed), {NAN, INFINITY, -INFINITY, -2e50, 2e50}, 5},
        {"spin1", offsetof(restitute_scene, spin1), {NAN, INFINITY, -INFINITY, -1e60, 2e100}, 5},
        {"spin2", offsetof(restitute_scene, spin2), {1, NAN, INFINITY}, 3},
        {"wave_density", offsetof(restitute_scene, wave_density), {-1, NAN, INFINITY, 9e-101, 2e100}, 5},
    };
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        for (int k = 0; k < fields[i].count; k++) {
            restitute_scene scene = good_scene();
            memcpy((char *)&scene + fields[i].offset, &fields[i].bad[k], sizeof(double));
            refuse_scene(&scene, RESTITUTE_ERROR_DOMAIN, fields[i].name);
        }
}

static void scenes_without_material_or_init_are_refused(void **state)
{
    (void)state;
    restitute_scene scene = good_scene();
    scene.material = NULL;
    refuse_scene(&scene, RESTITUTE_ERROR_NULL, "material");
    scene = good_scene();
    scene.struct_size = 8;
    refuse_scene(&scene, RESTITUTE_ERROR_STRUCT_SIZE, "restitute_scene_init");
    scene = good_scene();
    scene.deformable = 3;
    refuse_scene(&scene, RESTITUTE_ERROR_DOMAIN, "deformable = 3");
    scene = good_scene();
    scene.inertia1 = 1e-30; /* chi = 1e20 */
    refuse_scene(&scene, RESTITUTE_ERROR_DOMAIN, "chi");
    scene = good_scene();
    scene.inertia2 = 1; /* of a wall */
    refuse_scene(&scene, RESTITUTE_ERROR_DOMAIN, "inertia2");
}

static void every_field_of_an_impact_is_checked(void **state)
{
    (void)state;
    const struct {
        const char *name;
        size_t offset;
        double bad[5];
    } fields[] = {
        {"chi", offsetof(restitute_impact, chi), {0.33, 1001, NAN, INFINITY, -1}},
        {"psi", offsetof(restitute_impact, psi), {-1, -1e-300, NAN, -INFINITY, 1e13}},
        {"delta1", offsetof(restitute_impact, delta1), {-1, -1e-300, NAN, -INFINITY, 1e13}},
        {"gamma", offsetof(restitute_impact, gamma), {-1, -1e-300, NAN, -INFINITY, -2}},
    };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 5; k++) {
            restitute_impact impact = impact_of(1, 1, 1, 1);
            struct outputs found, before;
            restitute_error error;
            memcpy((char *)&impact + fields[i].offset, &fields[i].bad[k], sizeof(double));
            prepare(&found);
            memcpy(&before, &found, sizeof found);
            int got = restitute_solve(solver, &impact, &found.result, &found.ledger, &found.history, &error);
            CHECK(got == RESTITUTE_ERROR_DOMAIN, "%s = %g: status %d", fields[i].name, fields[i].bad[k], got);
            CHECK(strncmp(error.message, fields[i].name, strlen(fields[i].name)) == 0, "\"%s\"", error.message);
            CHECK(memcmp(&found, &before, sizeof found) == 0, "%s: an output was touched", fields[i].name);
        }
}

/* A dashpot of a scene is not stronger than delta1 may be. */
static void damping_is_checked(void **state)
{
    (void)state;
    restitute_material *strong, *weak;
    restitute_error error;
    CHECK(restitute_material_kelvin_voigt(1, 2e12, 0.5, &strong, NULL) == 0, "strong");
    CHECK(restitute_material_kelvin_voigt(1, 1, 0.5, &weak, NULL) == 0, "weak");
    restitute_impact impact = impact_on(strong, 1, 1);
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "%s", error.message);
    CHECK(strncmp(error.message, "delta1 = 1.369", 14) == 0, "%s", error.message);
    impact.material = weak;
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_OK, "%s", error.message);
    restitute_scene scene = good_scene();
    scene.material = strong;
    refuse_scene(&scene, RESTITUTE_ERROR_DOMAIN, "delta1");
    restitute_material_destroy(strong);
    restitute_material_destroy(weak);
}

static void material_constants_are_checked(void **state)
{
    (void)state;
    restitute_material *untouched = rubber, *material = untouched;
    restitute_error error;
    const double bad[] = {0, -1, NAN, INFINITY, -INFINITY, 9e-61, 2e60}, one = 1, twice[] = {2, 2}, ones[] = {1, 1};
    for (int i = 0; i < 7; i++) {
        double b = bad[i];
        CHECK(restitute_material_elastic(b, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "G %g", b);
        CHECK(strstr(error.message, "shear_modulus"), "%s", error.message);
        CHECK(restitute_material_standard_solid(b, 1, 1, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "G1 %g", b);
        CHECK(restitute_material_standard_solid(1, b, 1, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "G2 %g", b);
        CHECK(restitute_material_standard_solid(1, 1, b, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "eta %g", b);
        CHECK(restitute_material_kelvin_voigt(b, 1, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "G1 %g", b);
        CHECK(restitute_material_kelvin_voigt(1, b, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "eta %g", b);
        CHECK(restitute_material_maxwell(b, 1, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "G %g", b);
        CHECK(restitute_material_maxwell(1, b, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "eta %g", b);
        CHECK(restitute_material_prony(1, 0, 1, &b, &one, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "tau %g",
              b);
        CHECK(strstr(error.message, "relaxation_time[0]"), "%s", error.message);
        CHECK(restitute_material_prony(1, 0, 1, &one, &b, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "g %g", b);
        CHECK(strstr(error.message, "modulus[0]"), "%s", error.message);
    }
    const double beyond[] = {9e-31, 2e30};
    for (int i = 0; i < 2; i++) {
        const double b = beyond[i];
        CHECK(restitute_material_prony(b, 0, 0, NULL, NULL, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g", b);
        CHECK(strstr(error.message, "equilibrium_modulus (Pa)") && strstr(error.message, "[1e-30, 1e+30] or 0"), "%s",
              error.message);
        CHECK(restitute_material_prony(1, b * b, 0, NULL, NULL, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g",
              b);
        CHECK(strstr(error.message, "parallel_viscosity") && strstr(error.message, "[1e-60, 1e+60] or 0"), "%s",
              error.message);
        CHECK(restitute_material_prony(1, 0, 1, &b, &one, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g", b);
        CHECK(strstr(error.message, "relaxation_time[0] (s)"), "%s", error.message);
        CHECK(restitute_material_prony(1, 0, 1, &one, &b, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g", b);
        CHECK(strstr(error.message, "modulus[0] (Pa)"), "%s", error.message);
        /* times that follow from values in their ranges */
        CHECK(restitute_material_maxwell(1, b, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g", b);
        CHECK(restitute_material_standard_solid(1, 1, b, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN, "%g", b);
    }
    const double ratios[] = {-0.01, 0.51, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        CHECK(restitute_material_elastic(1, ratios[i], &material, &error) == RESTITUTE_ERROR_DOMAIN, "nu %g",
              ratios[i]);
        CHECK(strstr(error.message, "poisson_ratio") && strstr(error.message, "[0, 0.5]"), "%s", error.message);
    }
    CHECK(restitute_material_prony(1, 0, 2, twice, ones, 0.5, &material, &error) == RESTITUTE_ERROR_DOMAIN,
          "two alike");
    CHECK(strstr(error.message, "relaxation_time = 2 s appears twice"), "%s", error.message);
    CHECK(restitute_material_prony(0, 0, 0, NULL, NULL, 0.5, &material, NULL) == RESTITUTE_ERROR_DOMAIN, "nothing");
    CHECK(restitute_material_prony(1, 0, 1, NULL, &one, 0.5, &material, NULL) == RESTITUTE_ERROR_NULL, "no times");
    CHECK(restitute_material_prony(1, 0, 0, NULL, NULL, 0.5, NULL, NULL) == RESTITUTE_ERROR_NULL, "no output");
    CHECK(material == untouched, "a failed call wrote its output");
}

static void options_are_checked(void **state)
{
    (void)state;
    restitute_solver *made = solver;
    restitute_error error;
    const double tolerances[] = {0, -1, NAN, 1e-9, 0.2, INFINITY}, steps[] = {-1, NAN, 9e-101, 2e100};
    const int64_t counts[] = {-1, 1, 3, 1000001};
    for (int i = 0; i < 6; i++) {
        restitute_options options = to_tolerance(tolerances[i]);
        CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_DOMAIN, "%g", tolerances[i]);
        CHECK(strstr(error.message, "tolerance"), "%s", error.message);
    }
    for (int i = 0; i < 4; i++) {
        restitute_options options = as_told(0, steps[i]);
        CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_DOMAIN, "%g", steps[i]);
        CHECK(strstr(error.message, "time_step"), "%s", error.message);
    }
    for (int i = 0; i < 4; i++) {
        restitute_options options = as_told(counts[i], 0);
        CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_DOMAIN, "%d", (int)counts[i]);
        CHECK(strstr(error.message, "elements"), "%s", error.message);
    }
    restitute_options options = default_options();
    const double works[] = {0, -1, NAN};
    for (int i = 0; i < 3; i++) {
        options.max_work = works[i];
        CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_DOMAIN, "max_work");
        CHECK(strstr(error.message, "max_work"), "%s", error.message);
    }
    options = default_options();
    options.threads = -1;
    CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_DOMAIN, "threads");
    CHECK(strstr(error.message, "threads = -1: must be in [0, 1024]"), "%s", error.message);
    options = default_options();
    options.method = NULL;
    CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_NULL, "method");
    options = default_options();
    options.struct_size = 0;
    CHECK(restitute_solver_create(&options, &made, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "size");
    CHECK(made == solver, "a failed call wrote its output");
}

static void null_and_unprepared_outputs_are_refused(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(1, 1, 1, 1);
    restitute_result result;
    restitute_history history;
    restitute_error error;
    restitute_result_init(&result);
    restitute_history_init(&history);
    CHECK(restitute_solve(NULL, &impact, &result, NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "solver");
    CHECK(restitute_solve(solver, NULL, &result, NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "impact");
    CHECK(restitute_solve_scene(solver, NULL, &result, NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "scene");
    CHECK(restitute_solve(solver, &impact, &result, NULL, &history, &error) == RESTITUTE_ERROR_DOMAIN, "capacity 0");
    CHECK(strstr(error.message, "capacity"), "%s", error.message);
    result.struct_size = 1;
    CHECK(restitute_solve(solver, &impact, &result, NULL, NULL, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "result");
    CHECK(restitute_solver_create(NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "no output");
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_OK, "nothing wanted is no error");
    CHECK(error.status == RESTITUTE_OK && error.message[0] == '\0', "message left: %s", error.message);
    restitute_impact_init(NULL);
    restitute_scene_init(NULL);
    restitute_options_init(NULL);
    restitute_result_init(NULL);
    restitute_ledger_init(NULL);
    restitute_history_init(NULL);
    restitute_numbers_init(NULL);
    restitute_material_destroy(NULL);
    restitute_solver_destroy(NULL);
    CHECK(isnan(restitute_critical_psi(NAN, 0.5)) && isnan(restitute_critical_psi(1, 2)), "psi_c");
    CHECK(isnan(restitute_material_modulus(NULL, 1)) && isnan(restitute_material_modulus(rubber, 0)), "modulus");
    CHECK(restitute_material_terms(NULL) == 0 && isnan(restitute_material_poisson_ratio(NULL)), "NULL material");
    CHECK(restitute_method_name(NULL)[0] == '\0', "NULL method");
    CHECK(restitute_material_series(NULL, NULL, NULL, NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL material");
    CHECK(strcmp(error.message, "material is NULL") == 0, "%s", error.message);
}

/* A comma would be read as the end of a number: "in [0,333, 200]". */
static void messages_have_a_point_in_every_locale(void **state)
{
    restitute_impact impact;
    restitute_error error;
    (void)state;
    restitute_impact_init(&impact);
    impact.chi = 0.25;
    set_comma_locale();
    const int status = restitute_solve(solver, &impact, NULL, NULL, NULL, &error);
    const char kept = localeconv()->decimal_point[0];
    setlocale(LC_ALL, "C"); /* before anything can fail */
    assert_int_equal(status, RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "chi = 0.25: must be in [0.333"), "%s", error.message);
    CHECK(kept == ',', "the program's locale was changed");
    for (int i = 0; i < 2; i++) {
        restitute_options options = to_tolerance(1e-8);
        restitute_solver *limited;
        options.method = i ? restitute_method_sync() : restitute_method_euler();
        options.max_work = 1.5e-6;
        CHECK(restitute_solver_create(&options, &limited, NULL) == RESTITUTE_OK, "solver");
        impact.chi = 1, impact.psi = 0.5;
        set_comma_locale();
        restitute_solve(limited, &impact, NULL, NULL, NULL, &error);
        setlocale(LC_ALL, "C");
        CHECK(strstr(error.message, "max_work = 1.5e-06: "), "%s", error.message);
        restitute_solver_destroy(limited);
    }
}

/* Slip that is left out takes 2 psi of it. */
static void messages_name_the_callers_tolerance(void **state)
{
    restitute_options options = to_tolerance(1e-8);
    restitute_impact impact;
    restitute_solver *limited;
    restitute_error error;
    (void)state;
    restitute_impact_init(&impact);
    impact.psi = 1e-9, impact.delta1 = impact.gamma = 1;
    options.max_work = 1e-2;
    CHECK(restitute_solver_create(&options, &limited, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(limited, &impact, NULL, NULL, NULL, &error) == RESTITUTE_TOLERANCE_NOT_REACHED, "euler");
    CHECK(strncmp(error.message, "tolerance = 1e-08: ", 19) == 0, "%s", error.message);
    restitute_solver_destroy(limited);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_of_a_scene_is_checked),
        cmocka_unit_test(scenes_without_material_or_init_are_refused),
        cmocka_unit_test(every_field_of_an_impact_is_checked),
        cmocka_unit_test(damping_is_checked),
        cmocka_unit_test(material_constants_are_checked),
        cmocka_unit_test(options_are_checked),
        cmocka_unit_test(null_and_unprepared_outputs_are_refused),
        cmocka_unit_test(messages_have_a_point_in_every_locale),
        cmocka_unit_test(messages_name_the_callers_tolerance),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
