/* Every allocation of every call of the component table fails in turn: ERROR_MEMORY, outputs
 * untouched, and the same objects give the right result afterwards, bit by bit, and leak nothing.
 * Lookups allocate no memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"
#include "../support/table.h"

static restitute_material *material, *other;
static restitute_scene scene;
static restitute_table *table; /* of the scene */
static restitute_table_options options;
static restitute_error error;

/* Sums of what a table holds, with weights that tell its places apart, and what it says of
 * itself. */
static void give_table(restitute_table *of, struct given *given)
{
    const restitute_table_data data = data_of(of), *d = &data;
    const int64_t n_ex = 4 * d->speeds * places_of(d);
    double sum = 0;
    for (int64_t i = 0; i < 2 * d->speeds; i++)
        sum += d->ez[i] * (double)(i % 89 + 1);
    for (int64_t i = 0; i < n_ex; i++)
        sum += d->ex[i] * (double)(i % 97 + 1);
    give(given, sum);
    give(given, (double)n_ex);
    give(given, d->error_ez);
    give(given, d->error_ex);
    give(given, (double)d->impacts);
    give(given, (double)d->checks);
    restitute_table_destroy(of);
}

/* ---- builds */

MAKES(table, build, restitute_table_build(&scene, &options, &made, &error), give_table(made, given))

static int build_many(struct given *given)
{
    int status;
    const restitute_material *materials[2] = {material, other};
    restitute_table *made[3] = {UNTOUCHED, UNTOUCHED, UNTOUCHED};
    ARMED(status, restitute_table_build_many(2, materials, &scene, &options, NULL, NULL, made, &error));
    for (int i = 0; i < 3; i++) {
        CHECK(status >= 0 || made[i] == UNTOUCHED, "table %d touched", i);
        if (status >= 0) give_table(made[i], given);
    }
    return status;
}

static void builds(void **state)
{
    (void)state;
    restitute_table_options_init(&options);
    options.speed[0] = 0.5, options.speed[1] = 1;
    options.tolerance = 0.1;
    FAIL_EACH({"build", .call = build, .stride = 24}, {"build_many", .call = build_many, .stride = 7});
}

/* ---- all other calls */

static restitute_table_data data; /* of the table */
MAKES(table, from_data, restitute_table_create(&data, &made, &error), give_table(made, given))

static int contact_of(struct given *given)
{
    int status;
    PREPARED(table_contact, contact);
    const restitute_table_contact fresh = contact;
    ARMED(status, restitute_table_contact_set(table, &scene, &contact, &error));
    CHECK(status >= 0 || memcmp(&contact, &fresh, sizeof fresh) == 0, "contact touched");
    give(given, contact.speed_factor);
    give(given, contact.psi_factor);
    return status;
}

static void data_and_contacts(void **state)
{
    (void)state;
    data = data_of(table);
    FAIL_EACH({"data", .call = from_data}, {"contact_of", .call = contact_of});
}

static void lookups_take_no_memory(void **state)
{
    (void)state;
    double normal[50], tangential[50], ez[50], ex[50];
    PREPARED(body, ball);
    PREPARED(body, floor);
    int status;
    floor.radius = INFINITY, floor.normal[2] = 1;
    ball.radius = ball.position[2] = 0.005, ball.mass = 0.004, ball.velocity[2] = -1;
    for (int i = 0; i < 50; i++) {
        normal[i] = 0.02 * (i + 1);
        tangential[i] = 0.05 * i;
    }
    allocator.count = 0;
    ARMED(status, restitute_table_pair_many(table, NULL, 50, normal, tangential, ez, ex, NULL));
    assert_int_equal(status, RESTITUTE_OK);
    ARMED(status, restitute_table_collide(table, NULL, &ball, &floor, NULL, NULL, NULL));
    assert_int_equal(status, RESTITUTE_OK);
    for (int i = 0; i < 50; i++) {
        struct pair pair;
        ARMED(status, restitute_table_pair(table, NULL, normal[i], tangential[i], &pair.ez, &pair.ex, NULL));
        assert_int_equal(status, RESTITUTE_OK);
    }
    CHECK(allocator.count == 0, "%ld allocations", allocator.count);
}

static int set_up(void **state)
{
    (void)state;
    ball_on(0, &other);
    scene = ball_on(0.3, &material);
    table = table_of(&scene, 0.1, 1, 1e-2);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    restitute_material_destroy(other);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(builds), cmocka_unit_test(data_and_contacts),
                                       cmocka_unit_test(lookups_take_no_memory)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, set_up, tear_down));
}
