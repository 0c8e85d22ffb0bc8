/* Tables with traps on: builds of every kind, and lookups from no speed to the largest.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include "../support/table.h"

static const double speeds[] = {0, 5e-324, 1e-300, 1e-101, 1e-9, 1e-3, 0.5, 1, 10, 1e9, 1e99, 1e100};
enum { n_speeds = sizeof speeds / sizeof *speeds };

static void look_up_speeds(const restitute_table *table, const restitute_table_contact *contact, const char *name)
{
    int status, flags;
    for (int i = 0; i < n_speeds; i++)
        for (int j = 0; j < n_speeds; j++) {
            const double v_n[3] = {speeds[i], 1, speeds[i]}, v_t[3] = {speeds[j], -speeds[j], -1};
            double ez[3], ex[3];
            WITHOUT_TRAPS(status, restitute_table_pair(table, contact, v_n[0], v_t[0], ez, ex, NULL), "%s: %g, %g",
                          name, v_n[0], v_t[0]);
            WITHOUT_TRAPS(status, restitute_table_pair_many(table, contact, 3, v_n, v_t, ez, ex, NULL), "%s: %g, %g",
                          name, v_n[0], v_t[0]);
            WITHOUT_TRAPS(status, restitute_table_flags(table, contact, v_n[0], v_t[0], &flags, NULL), "%s: %g, %g",
                          name, v_n[0], v_t[0]);
        }
}

/* The contact of the table, and larger spheres. */
static void tables_of_contacts(void **state)
{
    const double tau[] = {1e-5, 1e-3, 1e-1}, g[] = {1e7, 1e6, 1e6}, frictions[] = {0, 0.3, INFINITY};
    restitute_material *materials[5];
    int status;
    (void)state;
    restitute_scene ball = ball_on(1, &materials[0]);
    ball_on(0, &materials[1]);
    CHECK(restitute_material_elastic(1e6, 0.3, &materials[2], NULL) == 0, "elastic");
    CHECK(restitute_material_maxwell(1e6, 300, 0.5, &materials[3], NULL) == 0, "Maxwell");
    CHECK(restitute_material_prony(1e5, 0, 3, tau, g, 0.4, &materials[4], NULL) == 0, "Prony");
    for (int k = 0; k < 15; k++) {
        restitute_table_options options;
        restitute_table_contact contact;
        restitute_table *table = NULL;
        restitute_error error;
        char name[40];
        snprintf(name, sizeof name, "material %d, friction %g", k / 3, frictions[k % 3]);
        ball.material = materials[k / 3], ball.friction = frictions[k % 3];
        restitute_table_options_init(&options);
        restitute_table_contact_init(&contact);
        options.speed[0] = 1e-3, options.speed[1] = 10;
        options.tolerance = 1e-2;
        WITHOUT_TRAPS(status, restitute_table_build(&ball, &options, &table, &error), "%s", name);
        CHECK(status >= 0 && table, "%s: %s", name, error.message);
        look_up_speeds(table, NULL, name);
        restitute_scene larger = ball;
        larger.radius1 = 0.1, larger.mass1 = 3;
        WITHOUT_TRAPS(status, restitute_table_contact_set(table, &larger, &contact, &error), "%s", name);
        CHECK(status == RESTITUTE_OK, "%s: %s", name, error.message);
        look_up_speeds(table, &contact, name);
        restitute_table_contact_init(&contact);
        larger.radius1 = 1e-6, larger.mass1 = 1e-15, larger.wave_density = 1e-100; /* another size, by far */
        WITHOUT_TRAPS(status, restitute_table_contact_set(table, &larger, &contact, &error), "%s", name);
        CHECK(status == RESTITUTE_OK, "%s: %s", name, error.message);
        look_up_speeds(table, &contact, name);
        restitute_table_destroy(table);
    }
    for (int k = 0; k < 5; k++)
        restitute_material_destroy(materials[k]);
}

/* As in a program that has traps on for all that it does. */
static void build_in_a_host_that_traps(void **state)
{
    restitute_material *material;
    restitute_scene scene = ball_on(1.0 / 3, &material);
    (void)state;
#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
    feenableexcept(TRAPPED);
#endif
    restitute_table *table = table_of(&scene, 1e-3, 10, 1e-4);
    look_up(table, 0, 0);
    look_up(table, 0, 1);
    look_up(table, 1, 1);
#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
    fedisableexcept(TRAPPED);
#endif
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables_of_contacts),
                                       cmocka_unit_test(build_in_a_host_that_traps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
