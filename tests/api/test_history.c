/* The time history: its content, and whether it obeys the equations of motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/solve.h"

enum { samples = 4000 };

static double t[samples], depth[samples], contact[samples], stick[samples], fz[samples], fx[samples], vz[samples],
    vx[samples];

static restitute_history all_of_it(size_t capacity)
{
    restitute_history h;
    restitute_history_init(&h);
    h.capacity = capacity;
    h.time = t, h.indentation = depth, h.contact_radius = contact, h.stick_radius = stick;
    h.normal_force = fz, h.tangential_force = fx, h.normal_velocity = vz, h.tangential_velocity = vx;
    return h;
}

static restitute_result record(restitute_scene *scene, const restitute_impact *impact, restitute_history *history)
{
    restitute_solver *solver;
    restitute_result result;
    restitute_error error;
    restitute_result_init(&result);
    CHECK(restitute_solver_create(NULL, &solver, NULL) == RESTITUTE_OK, "solver");
    int status = scene ? restitute_solve_scene(solver, scene, &result, NULL, history, &error)
                       : restitute_solve(solver, impact, &result, NULL, history, &error);
    CHECK(status >= 0, "%s", error.message);
    restitute_solver_destroy(solver);
    return result;
}

static void first_sample_is_first_touch_and_last_the_end(void **state)
{
    (void)state;
    const double psi[] = {0, 0.5, 1.5, 6};
    for (int i = 0; i < 4; i++) {
        restitute_impact impact = impact_of(7.0 / 6, psi[i], 0.3, 0.2);
        restitute_history h = all_of_it(300);
        restitute_result r = record(NULL, &impact, &h);
        size_t last = h.count - 1;
        CHECK(h.count > 200 && h.count <= 300, "%zu samples", h.count);
        CHECK(t[0] == 0 && depth[0] == 0 && vz[0] == 1 && fz[0] == 0 && contact[0] == 0, "psi %g: first", psi[i]);
        CHECK(vx[0] == (psi[i] > 0 ? psi[i] : 1), "psi %g: U' starts at %g", psi[i], vx[0]);
        CHECK(t[last] == r.contact_time && contact[last] == 0 && fz[last] == 0 && fx[last] == 0, "psi %g: last",
              psi[i]);
        CHECK(-vz[last] == r.ez && fabs(vx[last] + r.ex * vx[0]) < 1e-15 * vx[0] + 1e-16, "psi %g: pair", psi[i]);
        /* the solid is viscoelastic: at the end of contact an indentation remains, smaller than the
         * largest */
        CHECK(depth[last] > 0 && depth[last] < r.max_indentation, "psi %g: ends at %g", psi[i], depth[last]);
        for (size_t k = 1; k <= last; k++) {
            CHECK(t[k] > t[k - 1], "time runs back at %zu", k);
            CHECK(stick[k] >= 0 && stick[k] <= contact[k] && fz[k] >= 0, "sample %zu", k);
            CHECK(contact[k] <= r.max_contact_radius && depth[k] <= r.max_indentation, "sample %zu", k);
            /* fx and fz are each corrected at the edge by one cell: 1e-9 is rounding of what is
             * exactly fz in gross slip */
            if (psi[i] > 0) CHECK(fabs(fx[k]) <= fz[k] * (1 + 1e-9), "friction limit at %zu: %g %g", k, fx[k], fz[k]);
        }
    }
}

/* In SI: int F dt is the change of momentum, of the sphere in z and of the contact point's
 * effective mass in x. Each sample interval is four to five steps; the trapezoid rule on smooth
 * forces and the method's first order leave some 1e-3. */
static void forces_are_what_changes_the_velocities(void **state)
{
    (void)state;
    const double tau = 2e-4, g = 3e6;
    restitute_material *rubber = solid_of(1e6, 0, 1, &tau, &g);
    const double frictions[] = {0.3, 0.3, INFINITY}, speeds[] = {0.3, 1.5, 0.3};
    for (int i = 0; i < 3; i++) {
        restitute_scene scene;
        restitute_scene_init(&scene);
        scene.material = rubber;
        scene.radius1 = 0.01, scene.mass1 = 0.005;
        scene.radius2 = 0.02, scene.mass2 = 0.03, scene.inertia2 = 6e-6;
        scene.friction = frictions[i];
        scene.normal_speed = 2, scene.tangential_speed = speeds[i], scene.spin1 = 20;
        restitute_history h = all_of_it(samples);
        restitute_result r = record(&scene, NULL, &h);
        double impulse_z = 0, impulse_x = 0;
        for (size_t k = 1; k < h.count; k++) {
            impulse_z += 0.5 * (fz[k] + fz[k - 1]) * (t[k] - t[k - 1]);
            impulse_x += 0.5 * (fx[k] + fx[k - 1]) * (t[k] - t[k - 1]);
        }
        double m = 1 / (1 / 0.005 + 1 / 0.03);
        double mobility = 1 / 0.005 + 1 / 0.03 + 1e-4 / (0.4 * 0.005 * 1e-4) + 4e-4 / 6e-6;
        double sliding = speeds[i] + 0.01 * 20;
        CHECK_NEAR(impulse_z, m * 2 * (1 + r.ez), 2e-3 * impulse_z, "z, case %d", i);
        CHECK_NEAR(impulse_x, sliding * (1 + r.ex) / mobility, 2e-3 * fabs(impulse_x), "x, case %d", i);
        CHECK_NEAR(vx[0], sliding, 1e-15, "contact point velocity before, case %d", i);
        CHECK_NEAR(vx[h.count - 1], -r.ex * sliding, 1e-12, "after, case %d", i);
    }
    restitute_material_destroy(rubber);
}

/* F = (15/8) ((2/3) D^(3/2) + theta sqrt(D) D') while a Kelvin-Voigt contact grows. Whole cells
 * would make it ripple by up to dx/2 of the edge force, three per cent here; integrated to the true
 * edge it is as good as the step. */
static void reported_force_does_not_ripple_with_the_elements(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 2, 0);
    restitute_history h = all_of_it(600);
    restitute_result r = record(NULL, &impact, &h);
    double theta = 2 * THETA_OF_DELTA1;
    for (size_t k = 1; k < h.count && vz[k] > 0.1; k++) {
        double force = 15.0 / 8.0 * (2.0 / 3.0 * pow(depth[k], 1.5) + theta * sqrt(depth[k]) * vz[k]);
        /* the velocity in the dashpot lags by one step, (dV/dt) h, with dV/dt at most the largest
         * force */
        double tolerance = 15.0 / 8.0 * theta * sqrt(depth[k]) * r.max_normal_force * r.time_step;
        CHECK_NEAR(fz[k], force, tolerance + 2e-3 * force, "at %g T", t[k]);
    }
}

static void elastic_contact_ends_where_it_began(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 1, 0, 1);
    restitute_history h = all_of_it(50);
    restitute_result r = record(NULL, &impact, &h);
    /* the end is where the innermost element's force passes zero, interpolated within a step: its
     * square is left */
    CHECK_NEAR(depth[h.count - 1], 0, 0.5 * r.time_step * r.time_step + r.element_spacing * r.element_spacing, "depth");
}

static void arrays_may_be_missing_and_capacity_may_be_two(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 0.3, 0.2);
    restitute_history h;
    restitute_history_init(&h);
    h.capacity = 2;
    record(NULL, &impact, &h);
    CHECK(h.count == 2, "%zu samples", h.count);
    h.time = t;
    restitute_result r = record(NULL, &impact, &h);
    CHECK(h.count == 2 && t[0] == 0 && t[1] == r.contact_time, "%g %g", t[0], t[1]);
    h = all_of_it(3000); /* more than there are steps */
    r = record(NULL, &impact, &h);
    CHECK(h.count == (size_t)r.steps + 1, "%zu samples of %d steps", h.count, (int)r.steps);
}

static void recording_does_not_change_the_pair(void **state)
{
    (void)state;
    restitute_impact impact = impact_of(7.0 / 6, 1.4, 0.3, 0.2);
    restitute_history h = all_of_it(100);
    restitute_result with = record(NULL, &impact, &h), without = record(NULL, &impact, NULL);
    CHECK(with.ez == without.ez && with.ex == without.ex && with.steps == without.steps, "differ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_sample_is_first_touch_and_last_the_end),
        cmocka_unit_test(forces_are_what_changes_the_velocities),
        cmocka_unit_test(reported_force_does_not_ripple_with_the_elements),
        cmocka_unit_test(elastic_contact_ends_where_it_began),
        cmocka_unit_test(arrays_may_be_missing_and_capacity_may_be_two),
        cmocka_unit_test(recording_does_not_change_the_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
