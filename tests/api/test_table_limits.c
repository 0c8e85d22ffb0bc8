/* Limits of the model and tables: which speeds pass them, in flags of single places, for other
 * contacts, for elastic solids.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/table.h"

/* A table of a ball on a solid, a solver of its impacts, to 1e-4 both, and what was compared. */
struct limits {
    restitute_scene scene;
    double fastest; /* m/s */
    restitute_table *table;
    restitute_solver *solver;
    uint64_t random;
    int seen, compared; /* flags, impacts */
};

/* The solid stays the caller's. */
static struct limits limits_of(const restitute_material *material, double fastest, uint64_t seed)
{
    restitute_material *rubber;
    struct limits l = {ball_on(1, &rubber), fastest, .random = seed};
    restitute_options precise = to_tolerance(1e-4);
    restitute_table_options options = options_of(1);
    options.speed[1] = fastest;
    precise.method = restitute_method_sync();
    l.scene.material = material;
    l.table = built(&l.scene, &options);
    l.solver = make_solver(&precise);
    restitute_material_destroy(rubber);
    return l;
}

static void end_limits(const struct limits *l)
{
    restitute_solver_destroy(l->solver);
    restitute_table_destroy(l->table);
}

/* An impact of the scene, with any speeds: the flags of the table for a contact are those by the
 * solver, whose result is kept. 0: not compared, as a ratio is within two hundredths of its limit.
 * Ratios between nodes are powers of the speed. */
static int compare_flags(struct limits *l, restitute_scene *scene, const restitute_table_contact *contact,
                         restitute_result *r)
{
    restitute_error error;
    double ends[2];
    int flags;
    scene->normal_speed = random_log(&l->random, 1e-2, l->fastest) / (contact ? contact->speed_factor : 1);
    scene->tangential_speed = scene->normal_speed * random_log(&l->random, 0.1, 30);
    restitute_result_init(r);
    CHECK(restitute_solve_scene(l->solver, scene, r, NULL, NULL, &error) >= 0, "%s", error.message);
    restitute_material_window(scene->material, &ends[0], &ends[1], NULL);
    const double over[] = {r->speed_ratio / 0.1, r->radius_ratio / 0.1, r->displacement_ratio / 0.3,
                           r->contact_time / ends[0], r->contact_time / ends[1]};
    for (int i = 0; i < 5; i++)
        if (fabs(over[i] - 1) < 0.02) return 0;
    CHECK(restitute_table_flags(l->table, contact, scene->normal_speed, scene->tangential_speed, &flags, &error) == 0,
          "%s", error.message);
    CHECK(flags == r->flags, "R %g, %g m/s, %g m/s: %d, not %d", scene->radius1, scene->normal_speed,
          scene->tangential_speed, flags, r->flags);
    l->seen |= flags, l->compared++;
    return 1;
}

/* Of another size, friction, partner and solid: all that the contact is set from. */
static void compare_others(struct limits *l, const restitute_material *const materials[3], int n, double extent)
{
    for (int i = 0; i < n; i++) {
        PREPARED(table_contact, contact);
        restitute_error error;
        restitute_result r;
        restitute_scene other = l->scene;
        const double size = random_log(&l->random, 1 / extent, extent);
        other.material = materials[i % 3];
        other.radius1 *= size, other.mass1 *= size * size * size;
        other.friction = (i / 3) % 3 ? 0.1 : 0;
        if ((i / 9) % 2) other.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
        if ((i / 18) % 2) other.wave_density = 900;
        CHECK(restitute_table_contact_set(l->table, &other, &contact, &error) == RESTITUTE_OK, "%s", error.message);
        compare_flags(l, &other, &contact, &r);
    }
}

/* The speeds from which on limits are passed, and the flags of single places, are those of the
 * impacts. */
static void limits_travel(void **state)
{
    restitute_material *rubber = NULL;
    (void)state;
    restitute_material_standard_solid(1e6, 1e6, 300, 0.5, &rubber, NULL);
    struct limits l = limits_of(rubber, 100, 9);
    const restitute_table_info info = describe(l.table);
    CHECK(info.fast_speed > 0.01 && info.fast_speed < 100, "fast from %g on", info.fast_speed);
    for (int i = 0; i < 200; i++) {
        restitute_result r;
        if (!compare_flags(&l, &l.scene, NULL, &r)) continue;
        const double v = l.scene.normal_speed;
        CHECK((v > info.fast_speed) == (r.speed_ratio > 0.1), "%g m/s: fast", v);
        CHECK((v > info.large_contact_speed) == (r.radius_ratio > 0.1), "%g m/s: large", v);
    }
    assert_int_equal(restitute_table_flags(l.table, NULL, 1, 1, NULL, NULL), RESTITUTE_ERROR_NULL);
    end_limits(&l);
    restitute_material_destroy(rubber);
}

static void limits_travel_to_other_contacts(void **state)
{
    restitute_material *solid, *warm, *stiff;
    (void)state;
    restitute_material_standard_solid(1e6, 1e6, 300, 0.4, &solid, NULL);
    restitute_material_set_window(solid, 2e-3, 1e-2, NULL);
    restitute_material_shifted(solid, 0.3, &warm, NULL);
    restitute_material_standard_solid(3e6, 3e6, 900, 0.4, &stiff, NULL); /* the same times */
    restitute_material_set_window(stiff, 2e-3, 1e-2, NULL);
    struct limits l = limits_of(solid, 100, 10);
    compare_others(&l, (const restitute_material *[]){solid, warm, stiff}, 400, 2.5);
    CHECK(l.seen == 31 && l.compared > 300, "flags %d of %d impacts", l.seen, l.compared);
    end_limits(&l);
    restitute_material_destroy(solid);
    restitute_material_destroy(warm);
    restitute_material_destroy(stiff);
}

/* A spring alone has the same pair at all speeds, and limits all the same. */
static void limits_of_an_elastic_solid_travel(void **state)
{
    restitute_material *steel;
    (void)state;
    restitute_material_elastic(1e8, 0.3, &steel, NULL);
    restitute_material_set_window(steel, 2e-4, 1e-3, NULL);
    struct limits l = limits_of(steel, 10, 11);
    compare_others(&l, (const restitute_material *[]){steel, steel, steel}, 60, 5);
    end_limits(&l);
    restitute_material_destroy(steel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(limits_travel),
                                       cmocka_unit_test(limits_travel_to_other_contacts),
                                       cmocka_unit_test(limits_of_an_elastic_solid_travel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
