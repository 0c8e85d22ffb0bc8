/* The bounded solver against closed forms: Hertz, the flat punch, Cattaneo and Mindlin, in units of
 * G and the curvature 1 (profile r^2/2; K is that of nu = 1/2, so E* = 4).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "../support/check.h"
#include "bem/bounded.h"

static const double pi = 3.14159265358979323846;

enum { m = 64, cells = m * m };
static struct bem_transform *transform;
static double low[cells], high[cells], target[cells], x[cells], u[cells], room[5][cells];

static double radius2(int i, double spacing)
{
    const double a = i % m + 0.5, b = i / m + 0.5;
    return spacing * spacing * (a * a + b * b);
}

static void solve(enum bem_kind kind)
{
    struct bem_bounded b = {.transform = transform,
                            .kind = kind,
                            .ld = m,
                            .low = low,
                            .high = high,
                            .rhs = target,
                            .x = x,
                            .u = u,
                            .free = room[0],
                            .r = room[1],
                            .z = room[2],
                            .d = room[3],
                            .kd = room[4],
                            .closeness = 1e-9,
                            .most_iterations = 200};
    CHECK(rst_bem_solve_bounded(&b) == 0, "not settled after %d iterations", (int)b.iterations);
    CHECK(b.iterations < 60, "%d iterations: the preconditioner does nothing", (int)b.iterations);
    for (int i = 0; i < cells; i++) { /* the conditions that make it the solution */
        const double r = target[i] - u[i];
        CHECK(x[i] >= low[i] && x[i] <= high[i], "cell %d out of bounds", i);
        if (x[i] > low[i] && x[i] < high[i])
            CHECK(fabs(r) < 1e-7, "cell %d is free and misses by %g", i, r);
        else if (low[i] < high[i])
            CHECK(x[i] <= low[i] ? r <= 1e-7 : r >= -1e-7, "cell %d is held by no residual", i);
    }
}

static double sum(const double *field)
{
    double total = 0;
    for (int i = 0; i < cells; i++)
        total += field[i];
    return 4 * total;
}

/* Contact radius 1 over 60 cells: depth 1. */
static const double spacing = 1.0 / 60;

static void press(void)
{
    for (int i = 0; i < cells; i++) {
        low[i] = 0;
        high[i] = DBL_MAX;
        target[i] = 1 - radius2(i, spacing) / 2;
        x[i] = 0;
    }
    solve(BEM_NORMAL);
}

static void hertz(void **state)
{
    double worst = 0;
    int contact = 0;
    (void)state;
    press();
    /* P = (4/3) E* a^3 = 16/3; the grid of 60 cells over the radius misses it by some 1e-5 */
    CHECK_NEAR(sum(x) * spacing / (16.0 / 3), 1, 1e-4, "force");
    for (int i = 0; i < cells; i++) {
        const double r = sqrt(radius2(i, spacing));
        contact += x[i] > 0;
        if (r < 0.9) worst = fmax(worst, fabs(x[i] / spacing - 8 / pi * sqrt(1 - r * r)));
        /* the radius, by cells: all cells more than one cell from the edge are on the right side of
         * it */
        if (r < 1 - spacing) CHECK(x[i] > 0, "no contact at r = %g", r);
        if (r > 1 + spacing) CHECK(x[i] <= 0, "contact at r = %g", r);
    }
    CHECK(worst < 0.01, "pressure inside of 0.9 a is off by %g of 8/pi",
          worst); /* 0.4 %, of the piecewise constant traction */
    CHECK_NEAR(sqrt(4 * contact / pi) * spacing, 1, 0.01, "radius from the area"); /* half a cell */
}

/* A circular punch of radius 1 pressed in by 1: P = 2 E* a; its pressure is singular, first order
 * in the spacing. */
static void flat_punch(void **state)
{
    double errors[2];
    (void)state;
    for (int fine = 0; fine < 2; fine++) {
        const double h = fine ? 1.0 / 60 : 1.0 / 30;
        for (int i = 0; i < cells; i++) {
            high[i] = radius2(i, h) < 1 ? DBL_MAX : 0;
            low[i] = -high[i];
            target[i] = 1;
            x[i] = 0;
        }
        solve(BEM_NORMAL);
        errors[fine] = fabs(sum(x) * h / 8 - 1);
    }
    CHECK(errors[1] < 0.01, "force of the punch is off by %g", errors[1]); /* the cells make a circle to half a cell */
    CHECK(errors[1] < 0.8 * errors[0], "no better on the finer grid: %g, %g", errors[0], errors[1]);
}

/* Constant normal force, then a shift that sticks within c: u_x = (3/2)(1 - c^2), Q = P (1 - c^3)
 * for mu = 1. The solution neglects the direction of slip, as the bounds here do. */
static void cattaneo_mindlin(void **state)
{
    (void)state;
    for (double c = 0.3; c < 0.95; c += 0.3) {
        double normal, inside = 0, outside = 1e9, worst = 0;
        press();
        normal = sum(x);
        for (int i = 0; i < cells; i++) {
            high[i] = x[i];
            low[i] = -x[i];
            target[i] = 1.5 * (1 - c * c);
            x[i] = 0;
        }
        solve(BEM_SHEAR);
        /* Off the circle the uniform direction of slip is not exact for K_x, which is not
         * axisymmetric: 1e-3 */
        CHECK_NEAR(sum(x) / normal, 1 - c * c * c, 2e-3, "force for c = %g", c);
        for (int i = 0; i < cells; i++) {
            const double r = sqrt(radius2(i, spacing));
            if (high[i] <= 0) continue;
            if (x[i] < high[i])
                inside = fmax(inside, r);
            else
                outside = fmin(outside, r);
            if (r > 0.9 * c) continue;
            const double exact = 8 / pi * (sqrt(1 - r * r) - sqrt(c * c - r * r));
            worst = fmax(worst, fabs(x[i] / spacing - exact));
        }
        CHECK_NEAR(inside, c, 1.5 * spacing, "outermost cell that sticks"); /* one cell, and its diagonal */
        CHECK_NEAR(outside, c, 1.5 * spacing, "innermost cell that slips");
        CHECK(worst < 0.03, "traction within 0.9 c is off by %g, c = %g", worst,
              c); /* 1 % of 8/pi: the edge is one cell sharp */
    }
}

static int make_transform(void **state)
{
    (void)state;
    transform = rst_bem_transform_create(m);
    return !transform;
}

static int drop_transform(void **state)
{
    (void)state;
    rst_bem_transform_destroy(transform);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(hertz), cmocka_unit_test(flat_punch),
                                       cmocka_unit_test(cattaneo_mindlin)};
    return cmocka_run_group_tests(tests, make_transform, drop_transform);
}
