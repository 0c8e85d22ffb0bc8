/* Two bodies in space: conservation, frame indifference, planes, refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/random.h"
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

static restitute_collision rough(double friction)
{
    restitute_collision collision;
    restitute_collision_init(&collision);
    collision.material = rubber;
    collision.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    collision.friction = friction;
    return collision;
}

static void random_unit(uint64_t *random, double n[3])
{
    double size;
    do {
        for (int i = 0; i < 3; i++)
            n[i] = random_in(random, -1, 1);
        size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    } while (size < 0.1 || size > 1);
    for (int i = 0; i < 3; i++)
        n[i] /= size;
}

/* Two touching spheres that close with about 1 m/s. */
static void draw(uint64_t *random, restitute_body *a, restitute_body *b, double n[3])
{
    random_unit(random, n);
    restitute_body_init(a);
    restitute_body_init(b);
    a->radius = random_log(random, 0.002, 0.02), b->radius = random_log(random, 0.002, 0.02);
    a->mass = random_log(random, 1e-3, 1e-2), b->mass = random_log(random, 1e-3, 1e-2);
    if (random_below(random, 2)) a->inertia = 0.4 * a->mass * a->radius * a->radius * random_in(random, 0.7, 1.6);
    for (int i = 0; i < 3; i++) {
        a->position[i] = random_in(random, -1, 1);
        b->position[i] = a->position[i] + (a->radius + b->radius) * n[i];
        b->velocity[i] = random_in(random, -3, 3);
        const double along = random_in(random, 0.5, 1.5), across = random_in(random, -1, 1);
        a->velocity[i] = b->velocity[i] + along * n[i] + 0.4 * across;
        a->spin[i] = random_in(random, -100, 100);
        b->spin[i] = random_in(random, -100, 100);
    }
}

static double inertia_of(const restitute_body *b)
{
    return b->inertia > 0 ? b->inertia : 0.4 * b->mass * b->radius * b->radius;
}

/* Linear momentum, and angular momentum about the point of contact of one body. */
static void momentum(const restitute_body *b, const double contact[3], double p[3], double l[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        p[i] += b->mass * b->velocity[i];
        l[i] += inertia_of(b) * b->spin[i] + b->mass * ((b->position[j] - contact[j]) * b->velocity[k] -
                                                        (b->position[k] - contact[k]) * b->velocity[j]);
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Rounding of some ten products of the size of the momenta, 0.03 kg m/s. */
static const double rounding = 1e-16;

static void momentum_is_conserved_and_the_twist_untouched(void **state)
{
    (void)state;
    uint64_t random = 31;
    const double frictions[] = {0, 0.05, 0.5, INFINITY}, origin[3] = {0.3, -0.2, 0.1};
    int done = 0;
    for (int i = 0; i < 200; i++) {
        restitute_body a, b;
        double n[3], before[2][3] = {{0}}, after[2][3] = {{0}};
        draw(&random, &a, &b, n);
        restitute_body a0 = a, b0 = b;
        restitute_collision collision = rough(frictions[i % 4]);
        restitute_result result;
        restitute_error error;
        restitute_result_init(&result);
        momentum(&a, origin, before[0], before[1]);
        momentum(&b, origin, before[0], before[1]);
        int status = restitute_collide(solver, &collision, &a, &b, &result, &error);
        if (status == RESTITUTE_ERROR_DOMAIN && strstr(error.message, "not closing")) continue;
        CHECK(status == RESTITUTE_OK, "pair %d: %s", i, error.message);
        momentum(&a, origin, after[0], after[1]);
        momentum(&b, origin, after[0], after[1]);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(after[0][k], before[0][k], 100 * rounding, "pair %d, momentum", i);
            CHECK_NEAR(after[1][k], before[1][k], 100 * rounding, "pair %d, angular momentum", i);
        }
        CHECK_NEAR(dot(a.spin, n), dot(a0.spin, n), 1e-11, "twist of a, rounding of 100 rad/s times 1e3");
        CHECK_NEAR(dot(b.spin, n), dot(b0.spin, n), 1e-11, "twist of b");
        CHECK(memcmp(a.position, a0.position, sizeof a.position) == 0, "positions stay");
        done++;
    }
    CHECK(done > 150, "only %d pairs close", done);
}

/* (e_z, e_x) belong to the contact point: its relative velocity turns by them. */
static void contact_point_velocity_turns_by_the_pair(void **state)
{
    (void)state;
    uint64_t random = 32;
    for (int i = 0; i < 50; i++) {
        restitute_body a, b;
        double n[3], v[2][3];
        draw(&random, &a, &b, n);
        restitute_collision collision = rough(0.3);
        restitute_result result;
        restitute_result_init(&result);
        for (int when = 0; when < 2; when++) {
            double w[3];
            for (int k = 0; k < 3; k++)
                w[k] = a.radius * a.spin[k] + b.radius * b.spin[k];
            for (int k = 0; k < 3; k++)
                v[when][k] =
                    a.velocity[k] - b.velocity[k] + w[(k + 1) % 3] * n[(k + 2) % 3] - w[(k + 2) % 3] * n[(k + 1) % 3];
            if (when == 0 && restitute_collide(solver, &collision, &a, &b, &result, NULL) != RESTITUTE_OK) break;
            if (when == 0) continue;
            double normal[2] = {dot(v[0], n), dot(v[1], n)};
            CHECK_NEAR(normal[1], -result.ez * normal[0], 1e-13, "pair %d, normal", i); /* rounding of some m/s */
            for (int k = 0; k < 3; k++)
                CHECK_NEAR(v[1][k] - normal[1] * n[k], -result.ex * (v[0][k] - normal[0] * n[k]), 1e-13,
                           "pair %d, tangential", i);
        }
    }
}

static void rotate(const double q[4], double x[3])
{
    double t[3], y[3];
    for (int i = 0; i < 3; i++)
        t[i] = 2 * (q[1 + (i + 1) % 3] * x[(i + 2) % 3] - q[1 + (i + 2) % 3] * x[(i + 1) % 3]);
    for (int i = 0; i < 3; i++)
        y[i] = x[i] + q[0] * t[i] + q[1 + (i + 1) % 3] * t[(i + 2) % 3] - q[1 + (i + 2) % 3] * t[(i + 1) % 3];
    memcpy(x, y, sizeof y);
}

/* Turned and boosted before, or after: the same. psi changes by rounding, and e_x with it:
 * amplified by the steps. */
static void rotations_and_boosts_change_nothing(void **state)
{
    (void)state;
    uint64_t random = 33;
    for (int i = 0; i < 60; i++) {
        restitute_body a, b;
        double n[3], q[4], axis[3], boost[3], angle = random_in(&random, 0, 6);
        draw(&random, &a, &b, n);
        random_unit(&random, axis);
        q[0] = cos(angle / 2);
        for (int k = 0; k < 3; k++)
            q[1 + k] = sin(angle / 2) * axis[k], boost[k] = random_in(&random, -10, 10);
        restitute_body c = a, d = b, *turned[] = {&c, &d}, *kept[] = {&a, &b};
        for (int body = 0; body < 2; body++) {
            rotate(q, turned[body]->position);
            rotate(q, turned[body]->velocity);
            rotate(q, turned[body]->spin);
            for (int k = 0; k < 3; k++)
                turned[body]->velocity[k] += boost[k];
        }
        restitute_collision collision = rough(0.3);
        if (restitute_collide(solver, &collision, &a, &b, NULL, NULL) != RESTITUTE_OK) continue;
        /* the order of the bodies is of no matter either */
        CHECK(restitute_collide(solver, &collision, &d, &c, NULL, NULL) == RESTITUTE_OK, "pair %d", i);
        for (int body = 0; body < 2; body++) {
            rotate(q, kept[body]->velocity);
            rotate(q, kept[body]->spin);
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(turned[body]->velocity[k], kept[body]->velocity[k] + boost[k], 1e-10, "pair %d", i);
                CHECK_NEAR(turned[body]->spin[k], kept[body]->spin[k], 1e-8, "pair %d", i);
            }
        }
    }
}

static void plane_is_a_sphere_held_fast_of_infinite_radius(void **state)
{
    (void)state;
    restitute_body ball, floor;
    restitute_collision collision = rough(0.3);
    restitute_result result;
    restitute_result_init(&result);
    restitute_body_init(&ball);
    restitute_body_init(&floor);
    collision.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    ball.radius = 0.01, ball.mass = 0.004, ball.position[2] = 0.01;
    ball.velocity[0] = 1, ball.velocity[1] = -2, ball.velocity[2] = -1.5;
    floor.radius = INFINITY, floor.normal[2] = 5;
    floor.velocity[0] = 1; /* a moving belt */
    floor.spin[1] = NAN;   /* not used for a plane */
    CHECK(restitute_collide(solver, &collision, &floor, &ball, &result, NULL) == RESTITUTE_OK, "collide");
    CHECK_NEAR(ball.velocity[2], 1.5 * result.ez, 1e-15, "rebound");
    CHECK_NEAR(ball.velocity[0], 1, 1e-15, "the belt moves with the ball along x");
    CHECK_NEAR(ball.velocity[1], -2 * (1 - (1 + result.ex) * 2 / 7), 1e-14, "solid sphere: 2/7 of the change");
    CHECK_NEAR(ball.spin[0], (1 + result.ex) * 5.0 / 7 * 2 / 0.01, 1e-10, "it rolls about +x when it moves along -y");
    CHECK(floor.velocity[0] == 1 && floor.velocity[2] == 0, "the plane keeps its motion");
}

static void refuse(restitute_body a, restitute_body b, restitute_collision collision, const char *text)
{
    restitute_body a0 = a, b0 = b;
    restitute_error error;
    int status = restitute_collide(solver, &collision, &a, &b, NULL, &error);
    CHECK(status < 0, "%s: status %d", text, status);
    CHECK(strstr(error.message, text) != NULL, "\"%s\" does not say %s", error.message, text);
    CHECK(memcmp(&a, &a0, sizeof a) == 0 && memcmp(&b, &b0, sizeof b) == 0, "%s: a body was touched", text);
}

static void what_is_no_impact_is_refused(void **state)
{
    (void)state;
    restitute_body a, b, c;
    restitute_collision collision = rough(0.3), wrong;
    restitute_body_init(&a);
    restitute_body_init(&b);
    a.radius = b.radius = 0.01, a.mass = b.mass = 0.004;
    b.position[0] = 0.02, a.velocity[0] = 1;
    c = b, c.position[0] = 0.0201;
    refuse(a, c, collision, "do not touch");
    c.position[0] = 0.015;
    refuse(a, c, collision, "overlap");
    c = b, c.velocity[0] = 2;
    refuse(a, c, collision, "not closing");
    c = b, c.velocity[0] = 1;
    refuse(a, c, collision, "not closing");
    c = b, c.velocity[1] = NAN;
    refuse(a, c, collision, "second.velocity[1]");
    c = b, c.radius = -1;
    refuse(a, c, collision, "second.radius");
    c = b, c.mass = 0;
    refuse(a, c, collision, "second.mass");
    c = b, c.inertia = -1;
    refuse(a, c, collision, "second.inertia");
    c = b, c.struct_size = 3;
    refuse(a, c, collision, "struct_size");
    c = b, c.radius = INFINITY;
    refuse(a, c, collision, "second.normal");
    c.normal[0] = -1;
    c.position[0] = 0.01;
    refuse(c, c, collision, "cannot move");
    wrong = collision, wrong.friction = -1;
    refuse(a, b, wrong, "friction");
    wrong = collision, wrong.material = NULL;
    refuse(a, b, wrong, "collision.material is NULL");
    wrong = collision, wrong.touch_gap = -1;
    refuse(a, b, wrong, "touch_gap");
    CHECK(restitute_collide(solver, &collision, &a, NULL, NULL, NULL) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_collide(solver, &collision, &a, &b, NULL, NULL) == RESTITUTE_OK, "the good one is no refusal");
}

/* Whether two spheres, or a sphere and a plane, that are `gap` apart are taken to touch. */
static int touch(double radius1, double radius2, double gap)
{
    restitute_body a, b;
    restitute_collision collision = rough(0.3);
    restitute_error error;
    restitute_body_init(&a);
    restitute_body_init(&b);
    collision.touch_gap = 1e-3;
    a.radius = radius1, b.radius = radius2, a.mass = b.mass = 0.004, a.velocity[0] = 1, b.normal[0] = -1;
    b.position[0] = radius1 + (isinf(radius2) ? 0 : radius2) + gap;
    const int status = restitute_collide(solver, &collision, &a, &b, NULL, &error);
    CHECK(status == RESTITUTE_OK || (status == RESTITUTE_ERROR_DOMAIN &&
                                     (strstr(error.message, "do not touch") || strstr(error.message, "overlap"))),
          "%d %s", status, error.message);
    return status == RESTITUTE_OK;
}

/* By the sum of the radii, or the one radius: a gap of 1e-3 and an overlap of a tenth of that. */
static void gaps_and_overlaps_are_measured_by_the_radii(void **state)
{
    (void)state;
    const double radii[][3] = {{0.01, 0.03, 0.04}, {0.03, 0.01, 0.04}, {0.02, INFINITY, 0.02}};
    for (int i = 0; i < 3; i++) {
        const double *r = radii[i];
        CHECK(touch(r[0], r[1], 0.99e-3 * r[2]) && !touch(r[0], r[1], 1.01e-3 * r[2]), "gap %d", i);
        CHECK(touch(r[0], r[1], -0.099 * r[2]) && !touch(r[0], r[1], -0.101 * r[2]), "overlap %d", i);
    }
}

/* At the ends of all ranges: bodies come out with finite velocities, or are refused. */
static void ends_of_the_ranges_stay_finite(void **state)
{
    (void)state;
    uint64_t random = 71;
    int done = 0, refused = 0;
    for (int n = 0; n < 2000; n++) {
        const double ends[] = {1e-50, 1, 1e50}, spins[] = {-1e100, -1, 0, 1, 1e100}, inertias[] = {0, 1e-150, 1, 1e150};
        restitute_body a, b;
        restitute_collision collision = rough(random_below(&random, 2) ? 0.3 : 0);
        restitute_error error;
        restitute_body_init(&a);
        restitute_body_init(&b);
        a.radius = ends[random_below(&random, 3)], b.radius = ends[random_below(&random, 3)];
        a.mass = ends[random_below(&random, 3)], b.mass = ends[random_below(&random, 3)];
        a.inertia = inertias[random_below(&random, 4)], b.inertia = inertias[random_below(&random, 4)];
        a.velocity[0] = ends[random_below(&random, 3)], b.velocity[1] = -ends[random_below(&random, 3)];
        a.spin[2] = spins[random_below(&random, 5)], b.spin[1] = spins[random_below(&random, 5)];
        b.position[0] = a.radius + b.radius;
        const int status = restitute_collide(solver, &collision, &a, &b, NULL, &error);
        done += status >= 0;
        refused += status == RESTITUTE_ERROR_DOMAIN;
        for (int i = 0; i < 3; i++)
            CHECK(isfinite(a.velocity[i]) && isfinite(b.velocity[i]) && isfinite(a.spin[i]) && isfinite(b.spin[i]),
                  "case %d, status %d", n, status);
    }
    CHECK(done > 100 && refused > 100, "%d done, %d refused", done, refused);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_is_conserved_and_the_twist_untouched),
        cmocka_unit_test(contact_point_velocity_turns_by_the_pair),
        cmocka_unit_test(rotations_and_boosts_change_nothing),
        cmocka_unit_test(plane_is_a_sphere_held_fast_of_infinite_radius),
        cmocka_unit_test(what_is_no_impact_is_refused),
        cmocka_unit_test(gaps_and_overlaps_are_measured_by_the_radii),
        cmocka_unit_test(ends_of_the_ranges_stay_finite),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
