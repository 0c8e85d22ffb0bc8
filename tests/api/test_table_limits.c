/* Limits of the model and tables: which speeds pass them, in flags of single places, for other
 * contacts, for elastic solids.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/table.h"

/* The speeds from which on limits are passed, and the flags of single places, are those of the
 * impacts. */
static void limits_travel(void **state)
{
    restitute_material *material;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-4);
    restitute_table_options options = options_of(1);
    restitute_error error;
    uint64_t random = 9;
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    options.speed[1] = 100;
    restitute_table *table = built(&scene, &options);
    const restitute_table_info info = describe(table);
    CHECK(info.fast_speed > 0.01 && info.fast_speed < 100, "fast from %g on", info.fast_speed);
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, &error), RESTITUTE_OK);
    for (int i = 0; i < 200; i++) {
        restitute_result r;
        restitute_result_init(&r);
        scene.normal_speed = random_log(&random, 1e-2, 100);
        scene.tangential_speed = scene.normal_speed * random_log(&random, 0.1, 30);
        CHECK(restitute_solve_scene(solver, &scene, &r, NULL, NULL, &error) >= 0, "%s", error.message);
        /* ratios between nodes are powers of the speed: within two hundredths of a limit nothing is
         * checked */
        const double ratio[3] = {r.speed_ratio / 0.1, r.radius_ratio / 0.1, r.displacement_ratio / 0.3};
        if (fabs(ratio[0] - 1) < 0.02 || fabs(ratio[1] - 1) < 0.02 || fabs(ratio[2] - 1) < 0.02) continue;
        int flags;
        CHECK(restitute_table_flags(table, NULL, scene.normal_speed, scene.tangential_speed, &flags, &error) == 0, "%s",
              error.message);
        CHECK(flags == r.flags, "%g m/s, %g m/s", scene.normal_speed, scene.tangential_speed);
        CHECK((scene.normal_speed > info.fast_speed) == (ratio[0] > 1), "%g m/s: fast", scene.normal_speed);
        CHECK((scene.normal_speed > info.large_contact_speed) == (ratio[1] > 1), "%g m/s: large", scene.normal_speed);
    }
    assert_int_equal(restitute_table_flags(table, NULL, 1, 1, NULL, NULL), RESTITUTE_ERROR_NULL);
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

/* The flags of an impact by the solver, and how near its ratios are to their limits. */
static int flags_of(restitute_solver *solver, const restitute_scene *scene, double *nearest)
{
    restitute_result r;
    restitute_error error;
    double ends[2];
    restitute_result_init(&r);
    CHECK(restitute_solve_scene(solver, scene, &r, NULL, NULL, &error) >= 0, "%s", error.message);
    restitute_material_window(scene->material, &ends[0], &ends[1], NULL);
    const double over[] = {r.speed_ratio / 0.1, r.radius_ratio / 0.1, r.displacement_ratio / 0.3,
                           r.contact_time / ends[0], r.contact_time / ends[1]};
    *nearest = INFINITY;
    for (int i = 0; i < 5; i++)
        *nearest = fmin(*nearest, fabs(over[i] - 1));
    return r.flags;
}

/* Of another size, friction, partner and temperature: all that the contact is set from. Impacts
 * within two hundredths of a limit are left out, as above. */
static void limits_travel_to_other_contacts(void **state)
{
    restitute_material *material, *warm, *stiff;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-4);
    restitute_table_options options = options_of(1);
    restitute_error error;
    uint64_t random = 10;
    int seen = 0, compared = 0;
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    restitute_material_destroy(material);
    restitute_material_standard_solid(1e6, 1e6, 300, 0.4, &material, NULL);
    restitute_material_set_window(material, 2e-3, 1e-2, NULL);
    restitute_material_shifted(material, 0.3, &warm, NULL);
    restitute_material_standard_solid(3e6, 3e6, 900, 0.4, &stiff, NULL); /* the same times */
    restitute_material_set_window(stiff, 2e-3, 1e-2, NULL);
    scene.material = material;
    options.speed[1] = 100;
    restitute_table *table = built(&scene, &options);
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, &error), RESTITUTE_OK);
    const restitute_material *const materials[] = {material, warm, stiff};
    for (int i = 0; i < 400; i++) {
        restitute_table_contact contact;
        restitute_scene other = scene;
        double nearest;
        int flags;
        const double size = random_log(&random, 0.4, 2);
        other.material = materials[i % 3];
        other.radius1 *= size, other.mass1 *= size * size * size;
        other.friction = (i / 3) % 3 ? 0.1 : 0;
        if ((i / 9) % 2) other.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
        if ((i / 18) % 2) other.wave_density = 900;
        restitute_table_contact_init(&contact);
        CHECK(restitute_table_contact_set(table, &other, &contact, &error) == RESTITUTE_OK, "%s", error.message);
        other.normal_speed = random_log(&random, 1e-2, 100) / contact.speed_factor;
        other.tangential_speed = other.normal_speed * random_log(&random, 0.1, 30);
        const int expected = flags_of(solver, &other, &nearest);
        if (nearest < 0.02) continue;
        CHECK(restitute_table_flags(table, &contact, other.normal_speed, other.tangential_speed, &flags, &error) == 0,
              "%s", error.message);
        CHECK(flags == expected, "%d: size %g, %g m/s, %g m/s: %d, not %d", i, size, other.normal_speed,
              other.tangential_speed, flags, expected);
        seen |= expected, compared++;
    }
    CHECK(seen == 31 && compared > 300, "flags %d of %d impacts", seen, compared);
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    restitute_material_destroy(warm);
    restitute_material_destroy(stiff);
}

/* A spring alone has the same pair at all speeds, and limits all the same. */
static void limits_of_an_elastic_solid_travel(void **state)
{
    restitute_material *steel;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-4);
    restitute_table_options options = options_of(1);
    restitute_error error;
    uint64_t random = 11;
    (void)state;
    restitute_scene scene = ball_on(1, &steel);
    restitute_material_destroy(steel);
    restitute_material_elastic(1e8, 0.3, &steel, NULL);
    restitute_material_set_window(steel, 2e-4, 1e-3, NULL);
    scene.material = steel;
    restitute_table *table = built(&scene, &options);
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, &error), RESTITUTE_OK);
    for (int i = 0; i < 60; i++) {
        restitute_table_contact contact;
        restitute_scene other = scene;
        double nearest;
        int flags;
        const double size = random_log(&random, 0.2, 5);
        other.radius1 *= size, other.mass1 *= size * size * size;
        restitute_table_contact_init(&contact);
        CHECK(restitute_table_contact_set(table, &other, &contact, &error) == RESTITUTE_OK, "%s", error.message);
        other.normal_speed = random_log(&random, 1e-2, 10);
        other.tangential_speed = other.normal_speed * random_log(&random, 0.1, 30);
        const int expected = flags_of(solver, &other, &nearest);
        if (nearest < 0.02) continue;
        CHECK(restitute_table_flags(table, &contact, other.normal_speed, other.tangential_speed, &flags, &error) == 0,
              "%s", error.message);
        CHECK(flags == expected, "size %g, %g m/s: %d, not %d", size, other.normal_speed, flags, expected);
    }
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(steel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(limits_travel),
                                       cmocka_unit_test(limits_travel_to_other_contacts),
                                       cmocka_unit_test(limits_of_an_elastic_solid_travel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
