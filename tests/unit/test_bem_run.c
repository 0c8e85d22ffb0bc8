/* Single runs: the loading of a standard solid after Lee and Radok, and the orders of convergence
 * in step and grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/check.h"
#include "bem/run.h"

static double g = 2, tau = 0.5, room[8];

static struct rst_problem problem_of(double psi, int standard_solid)
{
    struct rst_problem p = {.chi = 7.0 / 6,
                            .psi = psi,
                            .shear_speed = psi,
                            .shear_scale = 1,
                            .mode = psi > 1 ? RST_GROSS_SLIP : RST_PARTIAL_SLIP,
                            .tolerance = 1e-3};
    p.solid = (struct rst_solid){.g_inf = 1, .n_terms = standard_solid, .g = &g, .tau = &tau};
    return p;
}

static struct bem_run run_of(const struct rst_problem *problem, struct bem_variant variant, int64_t m, double radius,
                             double step, struct bem_observer *observer)
{
    struct bem_solid solid = {.compliance = room, .lambda = room + 2, .decay = room + 4, .gain = room + 6};
    struct rst_workspace workspace = {0};
    struct bem_memory *memory = rst_bem_memory_of(&workspace);
    struct bem_run run;
    const struct bem_setup setup = {.problem = problem,
                                    .solid = &solid,
                                    .variant = variant,
                                    .m = m,
                                    .spacing = 1.1 * radius / (double)m,
                                    .step = step,
                                    .rest_speed = 1e-5,
                                    .most_steps = 100000};
    assert_non_null(memory);
    rst_bem_solid_creep(&problem->solid, &solid);
    rst_bem_solid_step(step, variant.explicit_euler, &solid);
    rst_bem_run(&setup, memory, observer, &run);
    workspace.own->release(workspace.own);
    assert_int_equal(run.end, BEM_REBOUND);
    return run;
}

enum { most_samples = 400 };

struct loading {
    struct bem_observer observer;
    int n;
    double time[most_samples], depth[most_samples], force[most_samples], area[most_samples], velocity[most_samples];
};

static void see(struct bem_observer *observer, const struct bem_setup *setup, const struct bem_run *run,
                const struct bem_motion *q, const struct bem_fields *fields)
{
    struct loading *l = (struct loading *)observer;
    (void)setup, (void)run, (void)fields;
    if (l->n == most_samples) return;
    l->time[l->n] = q->time, l->depth[l->n] = q->depth, l->force[l->n] = q->force;
    l->velocity[l->n] = q->velocity, l->area[l->n++] = q->contact;
}

/* While the contact grows: a^2 = D, P = int G(t - s) d(16/3 D^(3/2)). */
static void lee_radok_loading(void **state)
{
    struct loading l = {.observer = {.see = see}};
    const struct rst_problem problem = problem_of(0.5, 1);
    double memory = 0, before = 0, time = 0;
    int checked = 0;
    (void)state;
    run_of(&problem, (struct bem_variant){0}, 64, 0.95, 0.01, &l.observer);
    for (int i = 0; i < l.n && l.velocity[i] > 0; i++) {
        const double h = l.time[i] - time, hertz = 16.0 / 3 * pow(l.depth[i], 1.5);
        /* D^(3/2) taken linear in the step: the relaxing part decays over the step and gets the
         * mean of exp(-(h-s)/tau) */
        memory = memory * exp(-h / tau) + (hertz - before) * tau / h * -expm1(-h / tau);
        before = hertz;
        time = l.time[i];
        if (l.depth[i] < 0.1) continue; /* few cells */
        const double expected = hertz + g * memory;
        CHECK_NEAR(l.force[i] / expected, 1, 1e-3, "P at t = %g", l.time[i]); /* 18 to 58 cells over the radius */
        CHECK_NEAR(l.area[i] / (3.14159265358979 * l.depth[i]), 1, 0.05, "area at t = %g",
                   l.time[i]); /* of whole cells */
        checked++;
    }
    CHECK(checked > 30, "%d steps were looked at", checked);
}

/* The slope of log y over log x. */
static double slope(int n, const double *x, const double *y)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int i = 0; i < n; i++) {
        const double u = log(x[i]), v = log(y[i]);
        sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct orders {
    double z, x;
};

/* Squared errors of the velocities after with 26 to 210 steps, against a reference with 1680, are
 * added up over grids of several widths: cells come and go one at a time, which makes those of a
 * single grid noisy. */
static struct orders orders_in_the_step(struct bem_variant variant, int standard_solid, double psi)
{
    enum { steps = 4, finest = 64 };
    const struct rst_problem problem = problem_of(psi, standard_solid);
    const double radius = standard_solid ? 0.95 : 1;
    double h[steps], squares_z[steps] = {0}, squares_x[steps] = {0};
    for (int m = 16; m <= 28; m += 4) {
        const struct bem_run best = run_of(&problem, variant, m, radius, 0.08 / finest, NULL);
        for (int i = 0; i < steps; i++) {
            h[i] = 0.08 / (1 << i);
            const struct bem_run run = run_of(&problem, variant, m, radius, h[i], NULL);
            squares_z[i] += pow(run.last.velocity - best.last.velocity, 2);
            squares_x[i] += pow(run.last.shear_velocity - best.last.shear_velocity, 2);
        }
    }
    return (struct orders){0.5 * slope(steps, h, squares_z), 0.5 * slope(steps, h, squares_x)};
}

/* Measured 2.06 over seven grids (an elastic sphere keeps its energy, and there is no error to
 * speak of). Single steps between neighbours differ by 0.3, four grids average that out to 0.1. */
static void normal_velocity_is_of_second_order_in_the_step(void **state)
{
    const struct orders damped = orders_in_the_step((struct bem_variant){0}, 1, 0.5);
    (void)state;
    CHECK(damped.z > 1.8 && damped.z < 2.3, "%g", damped.z);
}

/* Cells enter and begin to slip one at a time, which is not smooth: less than second order with
 * this many steps, more than the first of the paper's. Measured 1.33 elastic and 1.35 damped. */
static void shear_velocity_is_between_the_orders(void **state)
{
    const struct orders elastic = orders_in_the_step((struct bem_variant){0}, 0, 0.5);
    const struct orders damped = orders_in_the_step((struct bem_variant){0}, 1, 0.5);
    (void)state;
    CHECK(elastic.x > 1.15 && elastic.x < 1.6, "elastic: %g", elastic.x);
    CHECK(damped.x > 1.15 && damped.x < 1.6, "standard solid: %g", damped.x);
}

/* Measured 1.06 to 1.07: 1, and 0.06 because the reference has an eighth of the smallest step and
 * so an eighth of its error. */
static void the_papers_steps_are_of_first_order(void **state)
{
    const struct bem_variant paper = {.explicit_euler = 1, .stick_sets = 1};
    const struct orders sticks = orders_in_the_step(paper, 1, 0.5), slips = orders_in_the_step(paper, 1, 3);
    (void)state;
    CHECK(sticks.z > 0.95 && sticks.z < 1.15, "normal: %g", sticks.z);
    CHECK(sticks.x > 0.95 && sticks.x < 1.15, "shear, partial slip: %g", sticks.x);
    CHECK(slips.x > 0.95 && slips.x < 1.15, "shear, gross slip: %g", slips.x);
}

/* Shrinking stick sets and bounds are two ways to one traction. */
static void stick_sets_agree_with_bounds(void **state)
{
    const struct rst_problem problem = problem_of(0.5, 1);
    const struct bem_run a = run_of(&problem, (struct bem_variant){0}, 24, 0.95, 0.02, NULL);
    const struct bem_run b = run_of(&problem, (struct bem_variant){.stick_sets = 1}, 24, 0.95, 0.02, NULL);
    (void)state;
    CHECK_NEAR(a.last.shear_velocity, b.last.shear_velocity, 1e-3,
               "U' after"); /* the sets do not let a cell stick again */
}

/* The order in the cells, from 8 to 64 over the side of the box, against 128. The largest depth is
 * the smoothest of what a run gives: measured 1.98; whole cells at the edge cost 3/2 in single
 * steps of it, two on the average. Velocities stay within the estimates of the method. */
static void converges_with_the_grid(void **state)
{
    enum { grids = 4 };
    const struct rst_problem problem = problem_of(0.5, 1);
    double error[grids], spacing[grids + 1], depth[grids + 1], v[grids + 1], w[grids + 1];
    (void)state;
    for (int i = 0; i <= grids; i++) {
        const int64_t m = 8 << i;
        const struct bem_run run = run_of(&problem, (struct bem_variant){0}, m, 0.95, 0.02, NULL);
        spacing[i] = 1.0 / (double)m;
        depth[i] = run.max_depth, v[i] = run.last.velocity, w[i] = run.last.shear_velocity / problem.psi;
    }
    for (int i = 0; i < grids; i++)
        error[i] = fabs(depth[i] - depth[grids]);
    const double order = slope(grids, spacing, error);
    CHECK(order > 1.5 && order < 2.4, "%g", order);
    for (int i = 0; i < grids; i++) { /* grid_error_ez and _ex of bem.c, with its factor for chi = 7/6, psi = 0.5 */
        const double grid = pow(spacing[i], 1.5);
        CHECK_NEAR(v[i], v[grids], 0.002 * 8 * grid, "normal velocity on grid %d", i);
        CHECK_NEAR(w[i], w[grids], 0.04 * 7 / 6 * (1 + 0.1 / 0.6) * grid, "shear velocity on grid %d", i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lee_radok_loading),
                                       cmocka_unit_test(normal_velocity_is_of_second_order_in_the_step),
                                       cmocka_unit_test(shear_velocity_is_between_the_orders),
                                       cmocka_unit_test(the_papers_steps_are_of_first_order),
                                       cmocka_unit_test(stick_sets_agree_with_bounds),
                                       cmocka_unit_test(converges_with_the_grid)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
