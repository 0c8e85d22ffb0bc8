/* What the header promises of a solver: statuses, overrides, extreme scenes, reuse, scaling.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../support/random.h"
#include "../support/solve.h"

static restitute_scene ball(const restitute_material *material, double radius, double density, double speed)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = material;
    scene.radius1 = radius;
    scene.mass1 = density * 4.18879 * radius * radius * radius;
    scene.friction = 0.3;
    scene.normal_speed = speed;
    scene.tangential_speed = speed;
    return scene;
}

/* "the largest stable step: X": X works, a thousandth more is refused. */
static void unstable_step_is_refused_with_the_largest_stable_one(void **state)
{
    (void)state;
    const double delta1[] = {0, 0.5, 50}, gamma[] = {INFINITY, 0.1, 0};
    for (int i = 0; i < 3; i++) {
        restitute_impact impact = impact_of(2, 0.7, delta1[i], gamma[i]);
        restitute_options options = as_told(16, 1e3);
        restitute_result result;
        restitute_solver *solver;
        restitute_error error;
        restitute_result_init(&result);
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        int status = restitute_solve(solver, &impact, &result, NULL, NULL, &error);
        restitute_solver_destroy(solver);
        CHECK(status == RESTITUTE_ERROR_UNSTABLE_STEP, "case %d: status %d", i, status);
        const char *largest = strstr(error.message, "the largest stable step: ");
        CHECK(largest != NULL, "%s", error.message);
        double step = strtod(largest + strlen("the largest stable step: "), NULL);

        options.time_step = 0.999 * step; /* six digits are printed */
        struct solution s = solve_impact(options, impact);
        CHECK(s.result.ez >= 0 && s.result.ez <= 1, "case %d: ez %g at the largest step", i, s.result.ez);
        options.time_step = 1.001 * step;
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        status = restitute_solve(solver, &impact, &result, NULL, NULL, &error);
        restitute_solver_destroy(solver);
        CHECK(status == RESTITUTE_ERROR_UNSTABLE_STEP, "case %d: status %d just above", i, status);
    }
}

/* The printed number itself is accepted, six digits or not. */
static void printed_largest_step_is_accepted(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        restitute_impact impact = impact_of(1 + 0.1 * i, 1, pow(10, -2 + 0.3 * i), 0);
        restitute_options options = as_told(16, 1e6);
        restitute_solver *solver;
        restitute_error error;
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_ERROR_UNSTABLE_STEP, "refused");
        restitute_solver_destroy(solver);
        options.time_step = strtod(strstr(error.message, "stable step: ") + strlen("stable step: "), NULL);
        CHECK(solve_impact(options, impact).status >= 0, "%s", error.message);
    }
}

/* A rebound that no step can show must end in an error, not in a minute of stepping. */
static void hopelessly_damped_impact_is_refused(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 1e10, 0);
    restitute_solver *solver;
    restitute_error error;
    CHECK(restitute_solver_create(NULL, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_ERROR_CONVERGENCE, "status");
    CHECK(strstr(error.message, "rebound too slow"), "%s", error.message);
    restitute_solver_destroy(solver);
    impact.delta1 = 1e6; /* strong, but seen */
    CHECK(solve_pair(default_options(), impact).result.ez > 0, "delta1 = 1e6");
}

/* An estimate from steps near the stable limit must still tell the truth. */
static void rough_overrides_are_not_trusted(void **state)
{
    (void)state;
    uint64_t random = 13;
    int above = 0;
    for (int i = 0; i < 200; i++) {
        const double gamma = random_log(&random, 1e-2, 1e2), delta1 = random_log(&random, 1e-3, 10);
        const double psi = random_log(&random, 0.05, 10), chi = random_in(&random, 0.4, 4);
        restitute_impact impact = impact_of(chi, psi, delta1, gamma);
        struct restitute_result fine = solve_pair(default_options(), impact).result;
        restitute_options options = as_told(0, 1e6);
        restitute_solver *solver;
        restitute_error error;
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        restitute_solve(solver, &impact, NULL, NULL, NULL, &error);
        restitute_solver_destroy(solver);
        double limit = strtod(strstr(error.message, "stable step: ") + strlen("stable step: "), NULL);
        struct restitute_result r = solve_pair(as_told(0, limit * random_in(&random, 0.3, 1)), impact).result;
        above += fabs(r.ez - fine.ez) > r.error_ez + 1e-3 || fabs(r.ex - fine.ex) > r.error_ex + 1e-3;
    }
    CHECK(above <= 10, "%d of 200 errors above their estimate, allowed are one in twenty", above);
}

static void too_little_work_allowed_is_told(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 0.3, 1);
    restitute_options options = to_tolerance(1e-6);
    options.max_work = 3e-3;
    struct solution s = solve_impact(options, impact);
    CHECK(s.status == RESTITUTE_TOLERANCE_NOT_REACHED, "status %d", s.status);
    CHECK(s.result.error_ez > 1e-6 && s.result.error_ez < 1e-2, "estimate %g is not honest", s.result.error_ez);
    CHECK(s.result.work <= 2 * options.max_work, "%g nominal seconds", s.result.work);

    restitute_solver *solver;
    restitute_error error;
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_TOLERANCE_NOT_REACHED, "status");
    CHECK(strstr(error.message, "; a finer run exceeds max_work = 0.003"), "%s", error.message);
    restitute_solver_destroy(solver);
    restitute_result result, before;
    options.max_work = 1e-7;
    restitute_result_init(&result);
    before = result;
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve(solver, &impact, &result, NULL, NULL, &error) == RESTITUTE_ERROR_TOO_MUCH_WORK,
          "1e-7 nominal seconds");
    CHECK(strstr(error.message, "max_work = 1e-07"), "%s", error.message);
    CHECK(memcmp(&result, &before, sizeof result) == 0, "the result was touched");
    restitute_solver_destroy(solver);
}

/* From a nominal second on; in full slip it takes half of that. */
static void euler_names_sync_where_it_is_slow(void **state)
{
    (void)state;
    const struct {
        double tolerance;
        double max_work;
        int status, named;
    } cases[] = {{1e-3, 10, RESTITUTE_OK, 0},
                 {1e-5, 10, RESTITUTE_OK, 0},
                 {3e-6, 10, RESTITUTE_OK, 1},
                 {1e-5, 0.01, RESTITUTE_TOLERANCE_NOT_REACHED, 1}};
    const restitute_impact impact = impact_of(7.0 / 6, 6, 1, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        restitute_options options = to_tolerance(cases[i].tolerance);
        restitute_solver *solver;
        restitute_result result;
        restitute_error error;
        options.max_work = cases[i].max_work;
        restitute_result_init(&result);
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        const int status = restitute_solve(solver, &impact, &result, NULL, NULL, &error);
        restitute_solver_destroy(solver);
        CHECK(status == cases[i].status && error.status == status, "%zu: %d %s", i, status, error.message);
        CHECK(!strstr(error.message, "the method sync") == !cases[i].named, "%zu: %g nominal seconds: \"%s\"", i,
              result.work, error.message);
    }
}

/* (25): delta2 is formed like delta1, with G2 under the root and the same a_el. */
static void numbers_of_a_standard_solid(void **state)
{
    (void)state;
    restitute_material *rubber;
    restitute_numbers n;
    const double g1 = 1e6, g2 = 3e6, eta = 300;
    CHECK(restitute_material_standard_solid(g1, g2, eta, 0.4, &rubber, NULL) == 0, "rubber");
    const restitute_scene scene = ball(rubber, 0.01, 2000, 2);
    restitute_numbers_init(&n);
    CHECK(restitute_scene_numbers(&scene, &n, NULL) == RESTITUTE_OK, "numbers");
    CHECK_NEAR(n.delta1, eta * sqrt(n.length_x / (g1 * scene.mass1 * 0.6)), 1e-14 * n.delta1, "rounding");
    CHECK_NEAR(n.delta2, eta * sqrt(n.length_x / (g2 * scene.mass1 * 0.6)), 1e-14 * n.delta2, "rounding");
    CHECK_NEAR(n.gamma, g1 / g2, 1e-15, "rounding");
    restitute_material_destroy(rubber);
}

/* It is in chi alone, which then has no bound. */
static void inertia_does_not_matter_without_friction(void **state)
{
    (void)state;
    restitute_material *rubber;
    const restitute_method *methods[] = {restitute_method_euler(), restitute_method_sync()};
    CHECK(restitute_material_standard_solid(1e6, 3e6, 300, 0.4, &rubber, NULL) == 0, "rubber");
    for (int i = 0; i < 2; i++) {
        restitute_options options = to_tolerance(1e-4);
        restitute_scene scene = ball(rubber, 0.01, 2000, 2);
        options.method = methods[i];
        scene.friction = 0;
        const struct solution solid = solve_scene(options, &scene);
        scene.inertia1 = 1e-150;
        const struct solution light = solve_scene(options, &scene);
        CHECK(light.status == solid.status && light.result.ex == -1, "method %d", i);
        CHECK_NEAR(light.result.ez, solid.result.ez, light.result.error_ez + solid.result.error_ez, "method %d", i);
        CHECK(light.result.work <= 100 * solid.result.work, "%g nominal seconds", light.result.work);
    }
    restitute_material_destroy(rubber);
}

static void coarse_override_tells_that_the_tolerance_is_missed(void **state)
{
    (void)state;
    struct solution s = solve_impact(as_told(4, 0), impact_of(7.0 / 6, 0.5, 0.3, 1));
    CHECK(s.status == RESTITUTE_TOLERANCE_NOT_REACHED && s.result.elements == 4, "status %d", s.status);
    CHECK(s.result.error_ez > 1e-3 || s.result.error_ex > 1e-3, "%g %g", s.result.error_ez, s.result.error_ex);
}

/* Whatever the method aims at inside, the estimate decides. An elastic solid with given elements
 * has the same estimate at any tolerance. */
static void status_follows_the_reported_estimate(void **state)
{
    const restitute_method *methods[] = {restitute_method_euler(), restitute_method_sync()};
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int64_t elements = 16; elements <= 64; elements *= 2) {
            const restitute_impact impact = impact_of(7.0 / 6, 0.7, 0, INFINITY);
            restitute_options options = as_told(elements, 0);
            options.method = methods[i];
            const restitute_result r = solve_pair(options, impact).result;
            const double estimate = fmax(r.error_ez, r.error_ex);
            for (double part = 0.725; part < 1.5; part += 0.05) {
                options.tolerance = part * estimate;
                const struct solution s = solve_impact(options, impact);
                CHECK_NEAR(fmax(s.result.error_ez, s.result.error_ex), estimate, 1e-3 * estimate, "as before");
                CHECK(s.status == (part > 1 ? RESTITUTE_OK : RESTITUTE_TOLERANCE_NOT_REACHED),
                      "%s, %d elements: status %d where the estimate is %g of %g", r.method, (int)elements, s.status,
                      estimate, options.tolerance);
            }
        }
}

/* Merged terms are part of the estimate too. */
static void status_follows_the_estimate_with_merged_terms(void **state)
{
    const double tau[] = {1e-3, 1e-2, 0.1, 1, 10, 100}, g[] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
    restitute_material *solid = solid_of(1, 0, 6, tau, g);
    int reached = 0, missed = 0;
    (void)state;
    for (int64_t elements = 8; elements <= 64; elements *= 2)
        for (double tolerance = 1e-5; tolerance < 0.1; tolerance *= 1.1) {
            restitute_options options = as_told(elements, 0);
            options.method = restitute_method_sync();
            options.tolerance = tolerance;
            const struct solution s = solve_impact(options, impact_on(solid, 7.0 / 6, 0.7));
            const int met = s.result.error_ez <= tolerance && s.result.error_ex <= tolerance;
            CHECK(s.status == (met ? RESTITUTE_OK : RESTITUTE_TOLERANCE_NOT_REACHED), "status %d: %g and %g of %g",
                  s.status, s.result.error_ez, s.result.error_ex, tolerance);
            reached += met;
            missed += !met;
        }
    CHECK(reached > 20 && missed > 20, "%d, %d", reached, missed);
    restitute_material_destroy(solid);
}

static void tighter_tolerances_are_met(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(1.4, 1.3, 0.4, 0.3);
    struct restitute_result best = solve_pair(to_tolerance(1e-5), impact).result;
    for (double tolerance = 1e-1; tolerance > 5e-5; tolerance /= 10) {
        struct restitute_result r = solve_pair(to_tolerance(tolerance), impact).result;
        CHECK_NEAR(r.ez, best.ez, tolerance + 1e-5, "tolerance %g", tolerance);
        CHECK_NEAR(r.ex, best.ex, tolerance + 1e-5, "tolerance %g", tolerance);
        CHECK(fmax(r.error_ez, r.error_ex) <= tolerance, "estimate %g at %g", r.error_ez, tolerance);
    }
}

static void extreme_scenes_work(void **state)
{
    (void)state;
    double tau[41], g[41];
    for (int k = 0; k < 41; k++) { /* twenty decades, 1e-12 to 1e8 s */
        tau[k] = pow(10, -12 + 0.5 * k);
        g[k] = 1e6 * pow(10, -0.1 * k);
    }
    restitute_material *decades = solid_of(1e4, 0, 41, tau, g), *hard = solid_of(1e12, 0, 0, NULL, NULL),
                       *soft = solid_of(1e-3, 0, 0, NULL, NULL);
    const restitute_material *materials[] = {decades, hard, soft};
    const double radii[] = {1e-9, 1e-3, 1e3}, speeds[] = {1e-9, 1, 1e4};
    for (int m = 0; m < 3; m++)
        for (int i = 0; i < 9; i++) {
            restitute_scene scene = ball(materials[m], radii[i / 3], 2000, speeds[i % 3]);
            struct solution s = solve_scene(default_options(), &scene);
            CHECK(s.status == RESTITUTE_OK && s.result.ez > 0 && s.result.ez <= 1 && fabs(s.result.ex) <= 1,
                  "material %d, R %g, v %g: status %d, ez %g", m, scene.radius1, scene.normal_speed, s.status,
                  s.result.ez);
            CHECK(s.result.contact_time > 0 && s.result.max_indentation > 0 && s.result.max_normal_force > 0,
                  "material %d, R %g, v %g", m, scene.radius1, scene.normal_speed);
        }
    restitute_material_destroy(decades);
    restitute_material_destroy(hard);
    restitute_material_destroy(soft);
}

static void a_thousand_terms_work(void **state)
{
    (void)state;
    static double tau[1000], g[1000];
    for (int k = 0; k < 1000; k++) {
        tau[k] = pow(10, -10 + 0.02 * k);
        g[k] = 1;
    }
    restitute_material *solid = solid_of(100, 0, 1000, tau, g);
    struct solution s = solve_impact(default_options(), impact_on(solid, 7.0 / 6, 0.5));
    CHECK(s.status == RESTITUTE_OK && s.result.terms_merged > 500, "%d merged", (int)s.result.terms_merged);
    restitute_material_destroy(solid);
}

/* The same impact in other units is the same pair; factors of two are exact, but powers of them are
 * not: rounding of a_el, amplified over some 1e3 steps. */
static void units_do_not_matter(void **state)
{
    (void)state;
    const double tau = 1e-3, g = 2e6, long_tau = tau * 64, scaled_g = g * 1024 / 64 / 64;
    restitute_material *a = solid_of(1e6, 0, 1, &tau, &g),
                       *b = solid_of(1e6 * 1024 / 64 / 64, 0, 1, &long_tau, &scaled_g);
    restitute_scene scene = ball(a, 0.01, 3000, 2), other = scene;
    /* kg -> 1024 kg/... : mass x 1024, time x 64, length x 1: G = mass/(length time^2) */
    other.material = b;
    other.mass1 *= 1024;
    other.normal_speed /= 64;
    other.tangential_speed /= 64;
    struct restitute_result x = solve_scene(default_options(), &scene).result;
    struct restitute_result y = solve_scene(default_options(), &other).result;
    CHECK_NEAR(x.ez, y.ez, 1e-12, "ez");
    CHECK_NEAR(x.ex, y.ex, 1e-12, "ex");
    CHECK_NEAR(y.contact_time, 64 * x.contact_time, 1e-12 * y.contact_time, "time");
    CHECK_NEAR(y.max_normal_force, x.max_normal_force / 4, 1e-12 * x.max_normal_force, "force");
    restitute_material_destroy(a);
    restitute_material_destroy(b);
}

/* Swapping the spheres, or giving the motion to spins instead of translation, is the same
 * impact. */
static void partners_and_kinds_of_motion_can_be_swapped(void **state)
{
    (void)state;
    restitute_material *rubber = solid_of(1e6, 200, 0, NULL, NULL);
    restitute_scene a = ball(rubber, 0.01, 1200, 1.5);
    a.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    a.radius2 = 0.02;
    a.mass2 = 0.07;
    a.inertia2 = 2e-5;
    a.spin2 = -11;
    restitute_scene b = a;
    b.radius1 = a.radius2, b.radius2 = a.radius1;
    b.mass1 = a.mass2, b.mass2 = a.mass1;
    b.inertia1 = a.inertia2, b.inertia2 = 0;
    b.spin1 = a.spin2, b.spin2 = 0;
    restitute_scene c = a;
    c.tangential_speed = 0;
    c.spin1 = (a.tangential_speed + a.radius2 * a.spin2) / a.radius1;
    c.spin2 = 0;
    struct restitute_result x = solve_scene(default_options(), &a).result;
    struct restitute_result y = solve_scene(default_options(), &b).result;
    struct restitute_result z = solve_scene(default_options(), &c).result;
    CHECK_NEAR(x.ez, y.ez, 1e-12, "swapped"); /* rounding of the effective mass and radius */
    CHECK_NEAR(x.ex, y.ex, 1e-12, "swapped");
    CHECK_NEAR(x.ex, z.ex, 1e-12, "spin for translation");
    restitute_material_destroy(rubber);
}

static void a_used_solver_gives_the_bits_of_a_fresh_one(void **state)
{
    (void)state;
    const double tau[] = {0.1, 1, 10}, g[] = {1, 2, 1};
    restitute_material *solid = solid_of(1, 0.1, 3, tau, g);
    restitute_solver *used;
    uint64_t random = 5;
    CHECK(restitute_solver_create(NULL, &used, NULL) == RESTITUTE_OK, "solver");
    for (int i = 0; i < 40; i++) {
        const double gamma = random_log(&random, 1e-3, 1e3), delta1 = random_log(&random, 1e-3, 100);
        const double psi = random_log(&random, 0.05, 10), chi = random_in(&random, 0.4, 4);
        restitute_impact impact = impact_of(chi, psi, delta1, gamma);
        if (i % 3 == 0) impact.material = solid;
        restitute_result again;
        restitute_result_init(&again);
        CHECK(restitute_solve(used, &impact, &again, NULL, NULL, NULL) == RESTITUTE_OK, "impact %d", i);
        struct restitute_result fresh = solve_pair(default_options(), impact).result;
        CHECK(memcmp(&again.ez, &fresh.ez, sizeof again.ez) == 0 &&
                  memcmp(&again.ex, &fresh.ex, sizeof again.ex) == 0 && again.steps == fresh.steps &&
                  again.contact_time == fresh.contact_time,
              "impact %d differs", i);
    }
    restitute_solver_destroy(used);
    restitute_material_destroy(solid);
}

static void versions_and_texts_are_there(void **state)
{
    (void)state;
    CHECK(strchr(restitute_version(), '.') != NULL, "version %s", restitute_version());
    for (int status = -9; status <= 2; status++)
        CHECK(strcmp(restitute_status_text(status), "unknown status") != 0, "status %d has no text", status);
    CHECK(strcmp(restitute_status_text(12345), "unknown status") == 0, "12345");
    CHECK(strcmp(restitute_method_name(restitute_method_euler()), "euler") == 0, "euler");
}

/* An init function asks for nothing that was not wanted. */
static void defaults_add_nothing(void **state)
{
    restitute_impact impact;
    restitute_scene scene;
    restitute_collision collision;
    restitute_options options;
    (void)state;
    restitute_impact_init(&impact);
    restitute_scene_init(&scene);
    restitute_collision_init(&collision);
    restitute_options_init(&options);
    CHECK(impact.chi == 7.0 / 6 && isinf(impact.psi) && impact.delta1 == 0 && isinf(impact.gamma) && !impact.material,
          "impact");
    CHECK(scene.deformable == RESTITUTE_ONE_BODY_DEFORMS && scene.friction == 0 && isinf(scene.radius2) &&
              isinf(scene.mass2) && scene.spin1 == 0 && scene.spin2 == 0,
          "scene");
    CHECK(collision.deformable == RESTITUTE_ONE_BODY_DEFORMS && collision.friction == 0, "collision");
    CHECK(options.method == restitute_method_euler() && options.threads == 1 && options.max_work == 10, "options");
}

/* As a scene without friction: the sphere slides on as it came, and there is no tangential
 * force. */
static void an_infinite_psi_is_no_friction(void **state)
{
    const restitute_method *methods[] = {restitute_method_euler(), restitute_method_sync()};
    (void)state;
    for (int i = 0; i < 2; i++) {
        restitute_options options = default_options();
        restitute_impact impact = impact_of(7.0 / 6, INFINITY, 1, 1);
        restitute_result result;
        restitute_history h;
        restitute_solver *solver;
        restitute_error error;
        double force[5], velocity[5];
        options.method = methods[i];
        restitute_result_init(&result);
        restitute_history_init(&h);
        h.capacity = 5, h.tangential_force = force, h.tangential_velocity = velocity;
        CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
        CHECK(restitute_solve(solver, &impact, &result, NULL, &h, &error) == RESTITUTE_OK, "%s", error.message);
        restitute_solver_destroy(solver);
        CHECK(result.ex == -1 && result.error_ex == 0, "%s: ex = %g +- %g", result.method, result.ex, result.error_ex);
        for (int k = 0; k < 5; k++)
            CHECK(force[k] == 0 && velocity[k] == 1, "%s, sample %d: %g, %g", result.method, k, force[k], velocity[k]);
        /* e_z does not know of friction: rounding, of other runs */
        impact.psi = 1e12;
        CHECK_NEAR(solve_pair(options, impact).result.ez, result.ez, result.error_ez, "%s", result.method);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unstable_step_is_refused_with_the_largest_stable_one),
        cmocka_unit_test(printed_largest_step_is_accepted),
        cmocka_unit_test(hopelessly_damped_impact_is_refused),
        cmocka_unit_test(rough_overrides_are_not_trusted),
        cmocka_unit_test(too_little_work_allowed_is_told),
        cmocka_unit_test(euler_names_sync_where_it_is_slow),
        cmocka_unit_test(numbers_of_a_standard_solid),
        cmocka_unit_test(inertia_does_not_matter_without_friction),
        cmocka_unit_test(coarse_override_tells_that_the_tolerance_is_missed),
        cmocka_unit_test(status_follows_the_reported_estimate),
        cmocka_unit_test(status_follows_the_estimate_with_merged_terms),
        cmocka_unit_test(tighter_tolerances_are_met),
        cmocka_unit_test(extreme_scenes_work),
        cmocka_unit_test(a_thousand_terms_work),
        cmocka_unit_test(units_do_not_matter),
        cmocka_unit_test(partners_and_kinds_of_motion_can_be_swapped),
        cmocka_unit_test(a_used_solver_gives_the_bits_of_a_fresh_one),
        cmocka_unit_test(versions_and_texts_are_there),
        cmocka_unit_test(defaults_add_nothing),
        cmocka_unit_test(an_infinite_psi_is_no_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
