/* Single Fortran procedures against what they are defined to be.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <string.h>

#include "../support/data.h"
#include "../support/solve.h"
#include "euler/kernels.h"

static const double pi = 3.14159265358979323846;

/* (6): g(x) = |x| int_0^|x| f'(r)/sqrt(x^2 - r^2) dr with f = r^2/(2R); r = x sin t removes the
 * root's singularity, and the integrand x sin t/R is smooth: Simpson on 200 intervals is good to
 * (pi/400)^4/90 = 4e-11. */
static void profile_is_the_transform_of_the_parabola(void **state)
{
    (void)state;
    const double radii[] = {1e-6, 0.3, 40};
    for (int i = 0; i < 3; i++) {
        double radius = radii[i], x = 0.1 * radius, sum = 0;
        const int n = 200;
        for (int k = 0; k <= n; k++) {
            double t = 0.5 * pi * k / n, slope = x * sin(t) / radius;
            sum += slope * (k == 0 || k == n ? 1 : k % 2 ? 4 : 2);
        }
        double transform = x * sum * (0.5 * pi / n) / 3;
        CHECK_NEAR(rst_plane_profile(x, radius), transform, 1e-9 * transform, "R = %g", radius);
    }
}

static void relaxation_modulus_is_the_sum_of_its_terms(void **state)
{
    (void)state;
    const double g[] = {2, 5}, tau[] = {0.5, 3};
    CHECK_NEAR(rst_relaxation_modulus(1.5, 7, 2, g, tau), 7 + 2 * exp(-3) + 5 * exp(-0.5), 1e-14, "G(1.5)");
}

/* decay and gain solve y_new = y + g du - h y_new/tau. */
static void step_coefficients_are_backward_euler(void **state)
{
    (void)state;
    const double g[] = {2, 5, 1e6}, tau[] = {0.5, 3, 1e-9}, h = 0.1, y = 0.7, du = 0.03;
    double decay[3], gain[3];
    rst_step_coefficients(h, 3, g, tau, decay, gain);
    for (int k = 0; k < 3; k++) {
        double after = decay[k] * y + gain[k] * du;
        /* rounding of terms of the size h/tau */
        CHECK_NEAR(after, y + g[k] * du - h * after / tau[k], 4 * DBL_EPSILON * (g[k] * du + h / tau[k]), "term %d", k);
    }
}

/* A mass on the solid, coupled as the sphere is: position first, then the force, then the
 * velocity. */
static double swing(double coupling, double h, double g_inf, double eta, int n, const double *g, const double *tau)
{
    double decay[2], gain[2], y[2] = {0}, u = 0, v = 1, largest = 0;
    rst_step_coefficients(h, n, g, tau, decay, gain);
    for (int i = 0; i < 1500; i++) {
        double move = h * v, force;
        u += move;
        force = g_inf * u + eta * move / h;
        for (int k = 0; k < n; k++)
            force += y[k] = decay[k] * y[k] + gain[k] * move;
        v -= h * coupling * force;
        if (i >= 1400) largest = fmax(largest, fabs(v));
    }
    return largest;
}

static void step_is_stable_just_below_the_limit_and_not_above(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double g_inf, eta;
        int n;
        double g[2], tau[2];
    } solids[] = {{"spring", 1, 0, 0, {0}, {0}},
                  {"Kelvin-Voigt", 1, 30, 0, {0}, {0}},
                  {"Maxwell", 0, 0, 1, {1}, {0.4}},
                  {"standard solid", 1, 0, 1, {20}, {1e-3}},
                  {"two terms and dashpot", 1, 0.3, 2, {20, 3}, {1e-3, 10}}};
    for (int i = 0; i < 5; i++) {
        const double coupling = 2.5;
        double h =
            rst_largest_stable_step(coupling, solids[i].g_inf, solids[i].eta, solids[i].n, solids[i].g, solids[i].tau);
        double below =
            swing(coupling, 0.99 * h, solids[i].g_inf, solids[i].eta, solids[i].n, solids[i].g, solids[i].tau);
        double above =
            swing(coupling, 1.01 * h, solids[i].g_inf, solids[i].eta, solids[i].n, solids[i].g, solids[i].tau);
        /* 1500 steps beyond the limit multiply by at least (1 + 0.01)^1500 = 3e6; below it a swing
         * stays within the factor 1/sqrt(1 - 0.99^2) = 7 of a linear oscillator near its limit */
        CHECK(below < 10, "%s: %g at 0.99 of the limit", solids[i].name, below);
        CHECK(above > 1e5, "%s: %g at 1.01 of the limit", solids[i].name, above);
    }
}

/* The look ahead sizes the foundation: it must know the depth to two per cent, and the force of an
 * elastic body. */
static void scout_knows_the_largest_indentation(void **state)
{
    (void)state;
    struct truth rows[truth_rows];
    read_truth(rows);
    for (int i = 0; i < truth_rows; i++) {
        double theta = rst_theta_from_delta1(rows[i].delta1), stress, depth, time, force;
        double g = 1 / rows[i].gamma, tau = rows[i].gamma * theta;
        int64_t n = rows[i].gamma > 0 && theta > 0, sinks;
        rst_scout_compression(1, n ? 0 : theta, n, &g, &tau, 0, 1e-5, &stress, &depth, &time, &force, &sinks);
        CHECK_NEAR(depth, rows[i].max_indentation, 0.02 * rows[i].max_indentation, "row %d", i);
        CHECK(!sinks && time > 0, "row %d", i);
        if (theta == 0) CHECK_NEAR(force, 2.0 / 3, 0.02 * 2 / 3, "row %d", i); /* (2/3) D^(3/2) */
    }
}

/* (22)-(24) by hand: m = 2 kg, R = 0.5 m, v = 3 m/s, G = 1e6 Pa, nu = 1/4. */
static void dimensionless_numbers_are_those_of_the_paper(void **state)
{
    (void)state;
    double a_el = pow(15 * 2.0 * 9 * 0.25 * 0.75 / (32 * 1e6), 0.2);
    CHECK_NEAR(rst_elastic_contact_radius(2, 0.5, 3, 1e6, 0.25), a_el, 1e-15, "a_el"); /* rounding of 0.07 */
    CHECK_NEAR(rst_tangential_mass_ratio(2, 3.5 / 2, 0.5), 7.0 / 6, 1e-15, "chi of a solid incompressible sphere");
    CHECK_NEAR(rst_tangential_mass_ratio(2, 1.0 / 2, 0), 0.5, 1e-15, "chi without rotation, nu = 0");
    CHECK_NEAR(rst_sliding_ratio(-4, 0.5, 2, 0.5), 2.0 / 3 * 4, 1e-15, "psi");
    CHECK(rst_sliding_ratio(4, INFINITY, 2, 0.5) == 0, "psi without slip");
    CHECK_NEAR(rst_theta_from_delta1(2), 2 * THETA_OF_DELTA1, 1e-15, "theta");
    double modulus = rst_damping_modulus(2, 0.5, 3, 40, 0.25);
    double time = pow(rst_elastic_contact_radius(2, 0.5, 3, modulus, 0.25), 2) / (0.5 * 3);
    CHECK_NEAR(40 / (modulus * time), 1, 1e-13, "theta = 1 at the damping modulus"); /* some roundings of powers */
}

/* Only what costs little is merged, cheapest first, and what is kept stays in order. */
static void far_terms_are_merged_and_near_ones_kept(void **state)
{
    (void)state;
    double g[] = {10, 1, 2, 0.5}, tau[] = {1e-8, 0.3, 5, 1e9}, g_inf = 1, eta = 0.1, slow_rate, fast_bound;
    int64_t n = 4;
    rst_merge_terms(1, 6, 1, 1e-4, &g_inf, &eta, &n, g, tau, &slow_rate, &fast_bound);
    CHECK(n == 2 && g[0] == 1 && tau[0] == 0.3 && g[1] == 2 && tau[1] == 5, "%d kept", (int)n);
    CHECK(g_inf == 1.5 && fabs(eta - (0.1 + 1e-7)) < 1e-16, "G_inf %g, eta %.10g", g_inf, eta);
    CHECK(slow_rate * 6 + fast_bound <= 1e-4 && slow_rate > 0 && fast_bound > 0, "%g %g", slow_rate, fast_bound);
    n = 0;
    rst_merge_terms(1, 6, 1, 1e-4, &g_inf, &eta, &n, g, tau, &slow_rate, &fast_bound);
    CHECK(n == 0 && slow_rate == 0 && fast_bound == 0, "no terms");
}

/* Fortran fills exactly what C declares: a pattern behind the struct survives, and the last member
 * is reached. */
static void struct_twins_have_the_same_layout(void **state)
{
    (void)state;
    struct {
        struct euler_state state;
        unsigned char canary[64];
    } guarded;
    struct euler_scene scene = {.chi = 1,
                                .shear_speed = 0.25,
                                .g_inf = 1,
                                .step = 0.01,
                                .spacing = 0.1,
                                .capacity = 4,
                                .keep_ledger = 1,
                                .mode = RST_NO_SLIP};
    double x2[4];
    memset(&guarded, 0xa5, sizeof guarded);
    rst_start_impact(&scene, &guarded.state, x2);
    for (int i = 0; i < 64; i++)
        CHECK(guarded.canary[i] == 0xa5, "byte %d behind the state was written", i);
    CHECK(guarded.state.velocity == 1 && guarded.state.shear_velocity == 0.25, "psi reached U'");
    CHECK(guarded.state.mode == RST_NO_SLIP, "the last member of the scene was read");
    CHECK(guarded.state.ledger.left_x == 0 && guarded.state.ledger.viscous_z == 0, "the last member was written");
    CHECK_NEAR(x2[3], 0.35 * 0.35, 1e-16, "elements stand at the middle of their cells");
}

/* Some steps that do not change the rounded indentation are the turning point, ten thousand are a
 * sphere that stands still. */
static void a_sphere_that_stands_still_has_stalled(void **state)
{
    (void)state;
    struct euler_state sphere;
    const struct euler_scene scene = {
        .g_inf = 1e-200, .step = 0.01, .spacing = 0.1, .capacity = 9, .mode = RST_NO_SLIP};
    double x2[9], f[9], u[9], q[9], slip[9];
    rst_start_impact(&scene, &sphere, x2);
    sphere.depth = 0.5, sphere.velocity = 1e-30; /* the force, 1e-200, is too small to change it */
    for (int i = 0; i < 2; i++) {
        rst_advance_impact(&scene, NULL, NULL, NULL, NULL, x2, f, NULL, u, NULL, q, slip, NULL, NULL, i ? 10 : 9995,
                           &sphere);
        CHECK(sphere.phase == (i ? RST_STALLED : RST_COMPRESSION), "after %d steps", (int)sphere.n_steps);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profile_is_the_transform_of_the_parabola),
        cmocka_unit_test(relaxation_modulus_is_the_sum_of_its_terms),
        cmocka_unit_test(step_coefficients_are_backward_euler),
        cmocka_unit_test(step_is_stable_just_below_the_limit_and_not_above),
        cmocka_unit_test(scout_knows_the_largest_indentation),
        cmocka_unit_test(dimensionless_numbers_are_those_of_the_paper),
        cmocka_unit_test(far_terms_are_merged_and_near_ones_kept),
        cmocka_unit_test(a_sphere_that_stands_still_has_stalled),
        cmocka_unit_test(struct_twins_have_the_same_layout),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
