/* The core with traps on: methods euler and sync, two bodies, materials, batches.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

static void euler_over_the_domain(void **state)
{
    const int counts[] = {100, 100, 200};
    (void)state;
    sweep_known(restitute_method_euler(), 1e-2, 1);
    sweep_random(restitute_method_euler(), 7, counts, 1e-2, 3e-3);
}

static void sync_over_the_domain(void **state)
{
    const int counts[] = {300, 300, 300};
    (void)state;
    sweep_known(restitute_method_sync(), 1e-3, 1);
    sweep_known(restitute_method_sync(), 1e-6, 1);
    sweep_random(restitute_method_sync(), 8, counts, 1e-3, 0.1);
    sweep_random(restitute_method_sync(), 9, counts, 1e-5, 0.1);
}

/* From the least number that there is to the largest: the limits, Kelvin-Voigt and elastic. */
static void ends_of_the_dimensionless_numbers(void **state)
{
    const double small[] = {5e-324, 1e-310, 1e-51, 1e-49}, large[] = {1e49, 1e51, 1e308};
    const restitute_method *methods[] = {restitute_method_euler(), restitute_method_sync()};
    double voigt_ez, ez;
    int status;
    (void)state;
    CHECK(restitute_pair(7.0 / 6, 0.5, 0.5, 0, &voigt_ez, NULL, NULL) == RESTITUTE_OK, "Kelvin-Voigt");
    for (int k = 0; k < 22; k++) {
        const int i = k / 2, limit = i < 4 ? 0 : i < 7 ? 1 : 2; /* of gamma to 0, to infinity, of delta1 to 0 */
        struct drawn d = {.impact = impact_of(7.0 / 6, 0.5, 0.5, 1)};
        restitute_solver *solver = solver_of(methods[k % 2], 1e-3, 0.1);
        restitute_result r;
        if (limit == 0) d.impact.gamma = small[i];
        if (limit == 1) d.impact.gamma = large[i - 4];
        if (limit == 2) d.impact.delta1 = small[i - 7];
        snprintf(d.text, sizeof d.text, "delta1 %g, gamma %g", d.impact.delta1, d.impact.gamma);
        sweep_case(solver, &d);
        restitute_result_init(&r);
        WITHOUT_TRAPS(status, solve_case(solver, &d, &r, NULL, NULL, NULL), "%s", d.text);
        ez = limit == 0 ? voigt_ez : 1;
        CHECK_NEAR(r.ez, ez, 2e-3, "%s", d.text); /* two tolerances */
        restitute_solver_destroy(solver);
    }
}

static void hosts_that_trap(void **state)
{
    (void)state;
    host_that_traps(restitute_method_euler());
    host_that_traps(restitute_method_sync());
}

/* Numbers of a scene, moduli at any time, pairs of materials, critical psi. */
static void what_is_no_impact(void **state)
{
    uint64_t seed = 10;
    (void)state;
    for (int n = 0; n < 900; n++) {
        struct drawn d = draw_case(&seed, (enum reach)(n % REACHES), n),
                     e = draw_case(&seed, (enum reach)(n % REACHES), n);
        restitute_material *pair = NULL;
        restitute_numbers numbers;
        restitute_error error;
        int status = RESTITUTE_OK;
        restitute_numbers_init(&numbers);
        if (d.is_scene) WITHOUT_TRAPS(status, restitute_scene_numbers(&d.scene, &numbers, &error), "%s", d.text);
        if (d.material && e.material)
            WITHOUT_TRAPS(status, restitute_material_effective(d.material, e.material, &pair, &error), "%d", n);
        const double times[] = {5e-324, 1e-300, 1e-30, 1, 1e300, INFINITY};
        for (int i = 0; i < 6 && d.material; i++)
            WITHOUT_TRAPS(status, isnan(restitute_material_modulus(d.material, times[i])), "at %g", times[i]);
        restitute_material_destroy(d.material);
        restitute_material_destroy(e.material);
        restitute_material_destroy(pair);
    }
}

/* Two spheres, or a sphere and a wall, straight and aslant. */
static void two_bodies(void **state)
{
    const double tau = 1e-3, g = 2e6;
    restitute_material *rubber = solid_of(1e6, 0, 1, &tau, &g);
    restitute_solver *solver = solver_of(restitute_method_sync(), 1e-3, 0.1);
    const double frictions[] = {0, 0.3, INFINITY}, aslant[] = {0, 0.1, 3};
    (void)state;
    for (int k = 0; k < 18; k++) {
        restitute_body a, b;
        restitute_collision collision;
        restitute_result result;
        int status;
        restitute_body_init(&a);
        restitute_body_init(&b);
        restitute_collision_init(&collision);
        restitute_result_init(&result);
        collision.material = rubber, collision.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
        collision.friction = frictions[k % 3];
        a.radius = 0.01, a.mass = 0.004, a.velocity[0] = 1, a.velocity[1] = aslant[k / 3 % 3], a.spin[2] = k % 2;
        b.radius = k < 9 ? INFINITY : 0.01, b.mass = 0.004, b.normal[0] = -1, b.position[0] = k < 9 ? 0.01 : 0.02;
        WITHOUT_TRAPS(status, restitute_collide(solver, &collision, &a, &b, &result, NULL), "case %d", k);
        CHECK(status == RESTITUTE_OK, "case %d: %d", k, status);
    }
    restitute_material_destroy(rubber);
    restitute_solver_destroy(solver);
}

/* Workers take the caller's traps: where the host traps, so would they. */
static void batches_in_a_host_that_traps(void **state)
{
    enum { n = 64 };
    restitute_impact impacts[n];
    restitute_options options;
    int statuses[n];
    uint64_t seed = 4;
    (void)state;
    for (int i = 0; i < n; i++) {
        draw_impact(&seed, USUAL, &impacts[i]);
        impacts[i].chi = 7.0 / 6;
    }
    restitute_options_init(&options);
    options.threads = 4;
#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
    feenableexcept(TRAPPED);
#endif
    const int status = restitute_solve_many(n, impacts, &options, NULL, statuses, NULL);
#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
    fedisableexcept(TRAPPED);
#endif
    CHECK(status >= 0, "%d", status);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(euler_over_the_domain),
                                       cmocka_unit_test(sync_over_the_domain),
                                       cmocka_unit_test(ends_of_the_dimensionless_numbers),
                                       cmocka_unit_test(hosts_that_trap),
                                       cmocka_unit_test(what_is_no_impact),
                                       cmocka_unit_test(two_bodies),
                                       cmocka_unit_test(batches_in_a_host_that_traps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
