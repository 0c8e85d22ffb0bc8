/* Procedures of the method `sync` one by one (docs/sync.md): polynomials, arms, normal motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <string.h>

#include "../support/data.h"
#include "../support/random.h"
#include "../support/sync_probe.h"

/* ---- collocation */

/* Radau's points are the zeros of P_6 - P_5, and integrals of x^k are exact up to k = 5, at the end
 * up to k = 10: that is what the order 11 rests on. Rounding: sums of six terms below 1. */
static void radau_integrates_powers(void **state)
{
    (void)state;
    double x[points], a[stages][stages];
    probe_collocation(x, a);
    for (int i = 1; i <= stages; i++) {
        double t = 2 * x[i] - 1, before = 1, now = t;
        for (int n = 1; n < stages; n++) {
            double next = ((2 * n + 1) * t * now - n * before) / (n + 1);
            before = now;
            now = next;
        }
        CHECK_NEAR(now, before, 30 * DBL_EPSILON, "P_6 = P_5 at point %d", i); /* slopes of both are up to 21 */
        for (int k = 0; k < (i == stages ? 2 * stages - 1 : stages); k++) {
            double sum = 0;
            for (int j = 1; j <= stages; j++)
                sum += a[j - 1][i - 1] * pow(x[j], k);
            CHECK_NEAR(sum, pow(x[i], k + 1) / (k + 1), 8 * DBL_EPSILON, "int x^%d to point %d", k, i);
        }
    }
    double sum = 0;
    for (int j = 1; j <= stages; j++)
        sum += a[j - 1][stages - 1] * pow(x[j], 11);
    CHECK(fabs(sum - 1.0 / 12) > 1e-8,
          "x^11 is not integrated exactly: the order is 11"); /* 5!^2 6!^2/(11!^2 12) = 4e-7 */
}

static double power_sum(const double c[points], double x)
{
    double y = 0;
    for (int k = stages; k >= 0; k--)
        y = y * x + c[k];
    return y;
}

/* Through the start and the six points passes one polynomial of degree 6, and all that is asked of
 * it is exact but for rounding: 1e-13 for numbers of the size 1 and weights up to 735. */
static void polynomials_of_degree_six_are_exact(void **state)
{
    (void)state;
    const double c[points] = {0.3, -1, 0.7, 0.2, -0.6, 0.9, -1.1};
    double x[points], a[stages][stages], y[points], five[points], weight[points], last, start, slope[stages], root;
    probe_collocation(x, a);
    for (int i = 0; i < points; i++) {
        y[i] = power_sum(c, x[i]);
        five[i] = y[i] - c[stages] * pow(x[i], stages);
    }
    for (double at = -0.25; at <= 1.25; at += 0.0625) {
        double sum = 0;
        probe_weights(at, weight);
        for (int i = 0; i < points; i++)
            sum += weight[i] * y[i];
        CHECK_NEAR(sum, power_sum(c, at), 1e-13 * (1 + 20 * (at < 0)), "value at %g",
                   at); /* growth outside of the points */
    }
    probe_weights(x[3], weight);
    for (int i = 0; i < points; i++)
        CHECK(weight[i] == (i == 3), "at a point the value there counts alone");
    /* x^6 on [0, 1] is T_6(2x - 1)/2048 and lower ones */
    probe_polynomial(y, 2, &last, &start, slope, &root);
    CHECK_NEAR(last, fabs(c[stages]) / 2048, 1e-14, "last coefficient");
    CHECK(y[1] > 0 && y[2] > 0 && y[3] < 0, "a root is between the points 2 and 3");
    probe_polynomial(y, 3, &last, &start, slope, &root);
    CHECK_NEAR(power_sum(c, root), 0, 1e-14, "root at %g", root);
    probe_polynomial(five, 3, &last, &start, slope, &root);
    CHECK_NEAR(last, 0, 1e-14, "no sixth power");
    CHECK_NEAR(start, five[0], 1e-12, "start of a polynomial of degree 5, by weights up to 1.6, 9.5 beyond the points");
    for (int i = 0; i < points; i++)
        y[i] -= c[0];
    probe_polynomial(y, 3, &last, &start, slope, &root);
    for (int i = 1; i <= stages; i++) {
        double exact = 0;
        for (int k = stages; k > 0; k--)
            exact = exact * x[i] + k * c[k];
        CHECK_NEAR(slope[i - 1], exact, 1e-12, "slope at point %d",
                   i); /* differences of the size eps over 0.04 times weights */
    }
}

/* ---- arms */

/* Solutions of random systems are found again to 1e-11, for matrices that have a zero on the
 * diagonal and whose rows change places more than once; a matrix of rank 5 is refused. Conditions
 * of such matrices are below 1e4, as a rule. */
static void linear_systems_are_solved_with_pivots(void **state)
{
    (void)state;
    uint64_t random = 9;
    for (int trial = 0; trial < 200; trial++) {
        double a[stages][stages], x[stages], b[stages] = {0}, found[stages];
        for (int j = 0; j < stages; j++) {
            x[j] = random_in(&random, -1, 1);
            for (int i = 0; i < stages; i++)
                a[j][i] = i == j && trial % 2 ? 0 : random_in(&random, -1, 1);
        }
        if (trial == 199) memcpy(a[5], a[2], sizeof a[5]); /* columns */
        for (int j = 0; j < stages; j++)
            for (int i = 0; i < stages; i++)
                b[i] += a[j][i] * x[j];
        const int64_t failed = probe_solve(a, b, found);
        if (trial == 199) {
            CHECK(failed || fabs(found[2]) + fabs(found[5]) > 1e12, "rank 5 was not noticed");
            continue;
        }
        CHECK(!failed, "trial %d", trial);
        for (int i = 0; i < stages; i++)
            CHECK_NEAR(found[i], x[i], 1e-11, "trial %d, unknown %d", trial, i);
    }
}

/* An arm that is released relaxes by exp(-rate t). At the ends of panels the error is of order 11,
 * at a point between of order 7. */
static void order_is_eleven_at_the_end_and_seven_within(void **state)
{
    (void)state;
    double error[2], within[2];
    for (int fine = 0; fine < 2; fine++) {
        const int n = 8 << fine;
        double x[points], a[stages][stages], span[stages], kernel[stages][stages], decay[stages], y = 1;
        probe_collocation(x, a);
        for (int i = 0; i < stages; i++)
            span[i] = 12.0 / n;
        assert_int_equal(probe_respond(1, span, kernel, decay), 0);
        within[fine] = decay[2] - exp(-x[3] * 12.0 / n);
        for (int p = 0; p < n; p++)
            y *= decay[stages - 1];
        error[fine] = y - exp(-12);
    }
    /* 2^11 and 2^7, as far as panels of 1.5 and 0.75 relaxation times are small: within a factor of
     * 2 */
    CHECK(error[0] / error[1] > 1024 && error[0] / error[1] < 4096, "ratio %g at the end", error[0] / error[1]);
    CHECK(within[0] / within[1] > 64 && within[0] / within[1] < 256, "ratio %g within", within[0] / within[1]);
}

/* A spring integrates; a slow arm is a spring but for rate*time; where the arm relaxes in the panel
 * its stress is that of v(t) = 1 + t/3 in closed form; a fast one is a dashpot, and what it held at
 * the start is gone. */
static void arms_are_springs_and_dashpots_in_their_limits(void **state)
{
    (void)state;
    const double span[stages] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    double x[points], a[stages][stages], kernel[stages][stages], decay[stages];
    probe_collocation(x, a);
    assert_int_equal(probe_respond(0, span, kernel, decay), 0);
    for (int i = 0; i < stages; i++) {
        CHECK(decay[i] == 1, "a spring keeps its stress");
        for (int j = 0; j < stages; j++)
            CHECK(kernel[j][i] == a[j][i], "a spring integrates the velocity");
    }
    const double rates[] = {1e-9, 1e-3, 1, 3, 1e8, 1e300};
    for (int k = 0; k < 6; k++) {
        const double rate = rates[k];
        assert_int_equal(probe_respond(rate, span, kernel, decay), 0);
        for (int i = 1; i <= stages; i++) {
            double t = x[i] * 0.5, sum = 0, expected;
            for (int j = 1; j <= stages; j++)
                sum += kernel[j - 1][i - 1] * 0.5 * (1 + x[j] * 0.5 / 3);
            if (rate < 1e-2) /* t + t^2/6 - rate (t^2/2 + t^3/18), with no cancellation */
                expected = t + t * t / 6 - rate * (t * t / 2 + t * t * t / 18);
            else
                expected = (1 - exp(-rate * t)) / rate + (t - (1 - exp(-rate * t)) / rate) / (3 * rate);
            if (rate < 1e2) {
                /* of order 7 at the points, rounding below; terms of rate^2 for rate < 1e-2 */
                double tolerance = 1e-9 * pow(rate, 7) + 1e-15 + (rate < 1e-2 ? rate * rate : 0);
                CHECK_NEAR(sum, expected, tolerance, "rate %g, point %d", rate, i);
                CHECK_NEAR(decay[i - 1], exp(-rate * t), 1e-15 + 1e-9 * pow(rate, 7), "rate %g, point %d", rate, i);
            } else {
                /* v/rate but for 1/rate of it, times the inverse of the integrals, which is below
                 * 40 */
                CHECK_NEAR(rate * sum, 1 + t / 3, 100 / rate + 1e-13, "rate %g, point %d", rate, i);
                CHECK(fabs(decay[i - 1]) < 100 / rate, "rate %g: %g left at point %d", rate, decay[i - 1], i);
            }
        }
    }
}

/* ---- normal motion */

/* Energy: D'^2 = 1 - D^(5/2); the restitution is the compression mirrored in time. Sixteen panels a
 * phase are good to 1e-9, where iterations end at 1e-12 and between the points of a panel
 * polynomials of degree 6 miss 2e-9. */
static void elastic_impact_keeps_its_energy_and_is_symmetric(void **state)
{
    (void)state;
    int64_t counts[2];
    double turn[6], in[6], out[6];
    assert_int_equal(normal(solid_of(0, 0), 1, 4, counts), 0);
    assert_int_equal(counts[0], 16);
    assert_int_equal(counts[1], 32);
    probe_motion(16, 1, turn);
    CHECK_NEAR(turn[DEPTH], 1, 5e-9, "largest indentation");
    CHECK_NEAR(turn[VELOCITY], 0, 1e-11, "theta = pi/2 is where D' = 0");
    for (int p = 1; p <= 16; p++)
        for (double x = 0; x <= 1; x += 0.125) {
            probe_motion(p, x, in);
            probe_motion(33 - p, 1 - x, out);
            CHECK_NEAR(in[VELOCITY] * in[VELOCITY], 1 - pow(in[DEPTH], 2.5), 1e-8, "panel %d, x = %g", p, x);
            CHECK_NEAR(in[FORCE], 2.0 / 3 * pow(in[RADIUS], 3), 1e-8, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[ANGLE], in[ANGLE], 4 * DBL_EPSILON, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[RADIUS], in[RADIUS], 1e-8, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[VELOCITY], -in[VELOCITY], 1e-8, "panel %d, x = %g", p, x);
            /* a time is known 1/D' as well as a depth: within 1e-4 of the turning point less
             * well */
            CHECK_NEAR(out[TIME] - turn[TIME], turn[TIME] - in[TIME], 1e-7, "panel %d, x = %g", p, x);
        }
    probe_motion(32, 1, out);
    CHECK_NEAR(out[TIME], 2.9432751843, 5e-9, "contact time");
    CHECK_NEAR(out[RADIUS], 0, DBL_EPSILON, "the edge is back at the centre");
}

/* Kelvin-Voigt without the library: the compression in the root sigma of time with the force (2/3)
 * A^3 + theta A D', the restitution D'' = -(5/4)(D + theta D')^(3/2), which ends where D + theta D'
 * = 0. */
static void voigt_rates(int back, double theta, double sigma, const double y[2], double out[2])
{
    if (back) { /* D, D' over time */
        out[0] = y[1];
        out[1] = -1.25 * pow(fmax(0, y[0] + theta * y[1]), 1.5);
        return;
    }
    out[0] = sigma > 0 ? sigma * y[1] / y[0] : 1; /* A, D' over sigma */
    out[1] = -2 * sigma * 15 / 8 * (2.0 / 3 * pow(y[0], 3) + theta * y[0] * y[1]);
}

static void voigt_step(int back, double theta, double t, double h, double y[2])
{
    double k[4][2], z[2];
    for (int s = 0; s < 4; s++) {
        const double part = s == 0 ? 0 : s == 3 ? h : h / 2;
        for (int i = 0; i < 2; i++)
            z[i] = y[i] + (s > 0 ? part * k[s - 1][i] : 0);
        voigt_rates(back, theta, t + part, z, k[s]);
    }
    for (int i = 0; i < 2; i++)
        y[i] += h * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]) / 6;
}

/* What ends the phase: D' = 0, and D + theta D' = 0. */
static double voigt_end(int back, double theta, const double y[2])
{
    return back ? y[0] + theta * y[1] : y[1];
}

/* From y to the end of the phase in steps of h, the last one shortened by secants; the t of the
 * end. */
static double voigt_phase(int back, double theta, double h, double y[2])
{
    for (int64_t n = 0;; n++) {
        double from[2] = {y[0], y[1]}, part = 1, here = voigt_end(back, theta, y), there;
        voigt_step(back, theta, (double)n * h, h, y);
        there = voigt_end(back, theta, y);
        if (there > 0) continue;
        for (int i = 0; i < 60; i++) { /* part of the last step: false position */
            part *= here / (here - there);
            y[0] = from[0];
            y[1] = from[1];
            voigt_step(back, theta, (double)n * h, part * h, y);
            there = voigt_end(back, theta, y);
            if (there > -1e-14) break;
        }
        return ((double)n + part) * h;
    }
}

static void kelvin_voigt_follows_its_own_equations(void **state)
{
    (void)state;
    const double delta1[] = {0.05, 0.335, 2};
    for (int i = 0; i < 3; i++) {
        const struct solid s = solid_of(delta1[i], 0);
        int64_t counts[2];
        double y[2] = {0, 1}, turn[6], end[6], time;
        time = voigt_phase(0, s.eta, 1e-4, y);
        double depth = y[0] * y[0];
        time *= time;
        /* 32 panels a phase: a weak dashpot holds the edge back within an angle of about theta
         * after the turn */
        assert_int_equal(normal(s, depth, 5, counts), 0);
        probe_motion(counts[0], 1, turn);
        probe_motion(counts[1], 1, end);
        CHECK_NEAR(turn[DEPTH], depth, 2e-9, "delta1 = %g", delta1[i]);
        CHECK_NEAR(turn[TIME], time, 2e-9, "delta1 = %g", delta1[i]);
        y[0] = depth;
        y[1] = 0;
        time += voigt_phase(1, s.eta, 1e-4, y);
        /* the 3/2-th power at the end costs RK4 part of its order: h^(5/2) = 1e-10 */
        CHECK_NEAR(end[VELOCITY], y[1], 5e-8, "delta1 = %g", delta1[i]);
        CHECK_NEAR(end[TIME], time, 5e-8, "delta1 = %g", delta1[i]);
        CHECK_NEAR(end[DEPTH], y[0], 5e-8, "delta1 = %g", delta1[i]);
    }
}

/* All rows of the recorded impacts, which another method computed: e_z, largest indentation and
 * contact time. */
static void recorded_normal_motions_are_met(void **state)
{
    (void)state;
    struct truth rows[truth_rows];
    double worst[2] = {0, 0};
    read_truth(rows);
    for (int i = 0; i < truth_rows; i++) {
        const struct solid s = solid_of(rows[i].delta1, rows[i].gamma);
        for (int fine = 0; fine < 2; fine++) {
            int64_t counts[2];
            double end[6], turn[6];
            const int64_t found =
                probe_normal(s.eta, s.n, s.g, s.rate, rows[i].max_indentation, 2 + fine, fine ? 1e-6 : 1e-3, counts);
            CHECK(found == 0, "row %d: %d", i, (int)found);
            probe_motion(counts[0], 1, turn);
            probe_motion(counts[1], 1, end);
            worst[fine] = fmax(worst[fine], fabs(-end[VELOCITY] - rows[i].ez));
            if (!fine) continue;
            CHECK_NEAR(turn[DEPTH], rows[i].max_indentation, 1e-7, "row %d", i);
            CHECK_NEAR(end[TIME], rows[i].contact_time, 1e-6, "row %d", i);
        }
    }
    /* the second run has polynomials that miss 1e-6 between the points on some panel, and less at
     * its end */
    CHECK(worst[1] < 5e-8, "worst e_z %g", worst[1]);
    CHECK(worst[1] < worst[0] / 100, "worst e_z %g, then %g", worst[0], worst[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radau_integrates_powers),
        cmocka_unit_test(polynomials_of_degree_six_are_exact),
        cmocka_unit_test(linear_systems_are_solved_with_pivots),
        cmocka_unit_test(order_is_eleven_at_the_end_and_seven_within),
        cmocka_unit_test(arms_are_springs_and_dashpots_in_their_limits),
        cmocka_unit_test(elastic_impact_keeps_its_energy_and_is_symmetric),
        cmocka_unit_test(kelvin_voigt_follows_its_own_equations),
        cmocka_unit_test(recorded_normal_motions_are_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
