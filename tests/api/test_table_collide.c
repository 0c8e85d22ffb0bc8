/* Impacts of two bodies by table: those of restitute_collide within the table's error, momentum
 * conserved, refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/table.h"

static restitute_material *material;
static restitute_scene scene;
static restitute_table *table;
static restitute_solver *solver;
static const double tolerance = 1e-4;

static int set_up(void **state)
{
    restitute_options options = to_tolerance(tolerance / 10);
    (void)state;
    options.method = restitute_method_sync();
    scene = ball_on(1, &material);
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    scene.radius2 = scene.radius1, scene.mass2 = scene.mass1;
    table = table_of(&scene, 1e-3, 100, tolerance);
    return restitute_solver_create(&options, &solver, NULL);
}

static int tear_down(void **state)
{
    (void)state;
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    return 0;
}

static restitute_body sphere(uint64_t *random, double radius, double mass)
{
    restitute_body body;
    restitute_body_init(&body);
    body.radius = radius, body.mass = mass;
    for (int i = 0; i < 3; i++) {
        body.velocity[i] = random_in(random, -1, 1);
        body.spin[i] = random_in(random, -100, 100);
    }
    return body;
}

/* Spheres of any size in any direction; those that part are turned round. */
static void place(uint64_t *random, restitute_body *first, restitute_body *second)
{
    double n[3], length = 0, closing = 0;
    for (int i = 0; i < 3; i++)
        n[i] = random_in(random, -1, 1), length += n[i] * n[i];
    for (int i = 0; i < 3; i++) {
        n[i] /= sqrt(length);
        second->position[i] = first->position[i] + (first->radius + second->radius) * n[i];
        closing += (first->velocity[i] - second->velocity[i]) * n[i];
    }
    for (int i = 0; closing < 0 && i < 3; i++)
        first->velocity[i] *= -1, second->velocity[i] *= -1;
}

/* ez and ex differ by the table's error and the solver's; so do velocities, of some m/s and two
 * parts each. */
static void what_the_solver_does(void **state)
{
    uint64_t random = 21;
    restitute_error error;
    restitute_collision contact;
    (void)state;
    restitute_collision_init(&contact);
    contact.material = material, contact.deformable = scene.deformable, contact.friction = scene.friction;
    for (int i = 0; i < 300; i++) {
        const double size = random_log(&random, 0.5, 2);
        restitute_body a = sphere(&random, 0.005, 0.004), b = sphere(&random, 0.005 * size, 0.004 * pow(size, 3));
        place(&random, &a, &b);
        restitute_body c = a, d = b;
        struct pair pair;
        restitute_result result;
        restitute_result_init(&result);
        CHECK(restitute_table_collide(table, NULL, &a, &b, &pair.ez, &pair.ex, &error) == RESTITUTE_OK, "%s",
              error.message);
        CHECK(restitute_collide(solver, &contact, &c, &d, &result, &error) >= 0, "%s", error.message);
        CHECK_NEAR(pair.ez, result.ez, 1.2 * tolerance, "impact %d", i);
        CHECK_NEAR(pair.ex, result.ex, 1.2 * tolerance, "impact %d", i);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(a.velocity[k], c.velocity[k], 20 * tolerance, "impact %d", i);
            CHECK_NEAR(b.velocity[k], d.velocity[k], 20 * tolerance, "impact %d", i);
            CHECK_NEAR(0.005 * a.spin[k], 0.005 * c.spin[k], 50 * tolerance, "impact %d", i);
        }
    }
}

/* Linear momentum, and angular momentum about the origin, to rounding of some sums. */
static void momentum_is_conserved(void **state)
{
    uint64_t random = 22;
    (void)state;
    for (int i = 0; i < 300; i++) {
        double before[6] = {0}, after[6] = {0};
        restitute_body body[2] = {sphere(&random, 0.005, 0.004), sphere(&random, 0.004, 0.004 * 0.512)};
        place(&random, &body[0], &body[1]);
        for (int turn = 0; turn < 2; turn++) {
            double *sum = turn ? after : before;
            for (int k = 0; k < 2; k++)
                for (int x = 0; x < 3; x++) {
                    const int y = (x + 1) % 3, z = (x + 2) % 3;
                    const restitute_body *b = &body[k];
                    sum[x] += b->mass * b->velocity[x];
                    sum[3 + x] += b->mass * (b->position[y] * b->velocity[z] - b->position[z] * b->velocity[y]) +
                                  0.4 * b->mass * b->radius * b->radius * b->spin[x];
                }
            if (!turn)
                assert_int_equal(restitute_table_collide(table, NULL, &body[0], &body[1], NULL, NULL, NULL),
                                 RESTITUTE_OK);
        }
        for (int k = 0; k < 6; k++)
            CHECK_NEAR(after[k], before[k], k < 3 ? 1e-16 : 1e-18, "impact %d, component %d", i, k);
    }
}

static void a_wall(void **state)
{
    restitute_body ball, floor, again;
    struct pair pair, other;
    restitute_table_contact contact;
    restitute_scene against_wall = scene;
    restitute_error error;
    (void)state;
    restitute_body_init(&ball);
    restitute_body_init(&floor);
    floor.radius = INFINITY, floor.normal[2] = 1;
    ball.radius = 0.01, ball.mass = 0.03, ball.position[2] = 0.01, ball.velocity[0] = 1, ball.velocity[2] = -2;
    again = ball;
    CHECK(restitute_table_collide(table, NULL, &ball, &floor, &pair.ez, &pair.ex, &error) == RESTITUTE_OK, "%s",
          error.message);
    CHECK_NEAR(ball.velocity[2], 2 * pair.ez, 1e-15, "the normal speed after");
    /* the same by the contact of that size */
    against_wall.radius1 = 0.01, against_wall.mass1 = 0.03, against_wall.radius2 = against_wall.mass2 = INFINITY;
    restitute_table_contact_init(&contact);
    CHECK(restitute_table_contact_set(table, &against_wall, &contact, &error) == RESTITUTE_OK, "%s", error.message);
    const struct pair direct = look_up_for(table, &contact, 2, 1);
    assert_int_equal(restitute_table_collide(table, &contact, &floor, &again, &other.ez, &other.ex, &error),
                     RESTITUTE_OK);
    CHECK_NEAR(direct.ez, pair.ez, 1e-12, "the size by contact_set");
    CHECK_NEAR(direct.ex, pair.ex, 1e-12, "the size by contact_set");
    CHECK_NEAR(other.ex, pair.ex, 1e-12, "the wall first");
}

/* A small sphere is a high speed in the table: where its end is taken, the call says so. */
static void the_end_of_the_table_is_remarked(void **state)
{
    restitute_error error;
    (void)state;
    for (int i = 0; i < 3; i++) {
        const double size = i == 2 ? 2 : i ? 0.1 : 1; /* a tenth: 1e5 times the speed; twice: 1/32 */
        restitute_body ball, floor;
        restitute_body_init(&ball);
        restitute_body_init(&floor);
        floor.radius = INFINITY, floor.normal[2] = 1;
        ball.radius = 0.005 * size, ball.mass = 0.004 * pow(size, 3), ball.position[2] = ball.radius,
        ball.velocity[2] = i == 2 ? -10 : -0.1;
        assert_int_equal(restitute_table_collide(table, NULL, &ball, &floor, NULL, NULL, &error), RESTITUTE_OK);
        CHECK((strstr(error.message, "its end is taken") != NULL) == (i == 1), "size %g: \"%s\"", size, error.message);
    }
}

static void refuse(restitute_body a, restitute_body b, const restitute_table_contact *contact, const char *text)
{
    restitute_error error;
    struct pair pair = {7, 7};
    const restitute_body c = a, d = b;
    CHECK(restitute_table_collide(table, contact, &a, &b, &pair.ez, &pair.ex, &error) < 0, "%s is taken", text);
    CHECK(strstr(error.message, text), "\"%s\" does not say \"%s\"", error.message, text);
    CHECK(memcmp(&a, &c, sizeof a) == 0 && memcmp(&b, &d, sizeof b) == 0 && pair.ez == 7, "%s: touched", text);
}

static void refusals(void **state)
{
    uint64_t random = 23;
    restitute_body a = sphere(&random, 0.005, 0.004), b = sphere(&random, 0.005, 0.004), odd;
    restitute_table_contact contact;
    (void)state;
    place(&random, &a, &b);
    odd = a, odd.velocity[1] = NAN;
    refuse(odd, b, NULL, "first.velocity[1]");
    odd = b, odd.mass = -1;
    refuse(a, odd, NULL, "second.mass (kg)");
    odd = b, odd.position[0] += 1;
    refuse(a, odd, NULL, "do not touch");
    odd = b, odd.inertia = 1e-6;
    refuse(a, odd, NULL, "chi");
    odd = a;
    for (int i = 0; i < 3; i++)
        odd.velocity[i] = 2 * b.velocity[i] - a.velocity[i];
    refuse(odd, b, NULL, "approach speed");
    restitute_table_contact_init(&contact);
    refuse(a, b, &contact, "contact is not set: restitute_table_contact_set fills it");
    assert_int_equal(restitute_table_contact_set(table, &scene, &contact, NULL), RESTITUTE_OK);
    contact.speed_factor = 1e190; /* times the ratio of the masses squared */
    odd = a, odd.mass = 1e-20;
    restitute_body small = b;
    small.mass = 1e-20;
    refuse(odd, small, &contact, "too far from the table's contact");
    contact.touch_gap = NAN;
    refuse(a, b, &contact, "touch_gap");
    contact.struct_size = 3;
    refuse(a, b, &contact, "struct_size");
    assert_int_equal(restitute_table_collide(NULL, NULL, &a, &b, NULL, NULL, NULL), RESTITUTE_ERROR_NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_the_solver_does), cmocka_unit_test(momentum_is_conserved),
                                       cmocka_unit_test(a_wall), cmocka_unit_test(the_end_of_the_table_is_remarked),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
