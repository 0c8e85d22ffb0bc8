/* Procedures of the method `sync` one by one (docs/sync.md): polynomials, arms, normal motion, front, tangential motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <stdlib.h>

#include "../support/data.h"

enum { stages = 6, points = stages + 1, most_arms = 4 };

/* sync_probe.f90 */
void probe_collocation(double x[points], double a[stages][stages]);
void probe_weights(double x, double weight[points]);
void probe_polynomial(const double y[points], int64_t i, double *last, double *start, double slope[stages], double *root);
int64_t probe_respond(double rate, const double span[stages], double kernel[stages][stages], double decay[stages]);
int64_t probe_normal(double eta, int64_t n, const double *g, const double *rate, double depth, int64_t halvings,
                     double roughness, int64_t counts[2]);
void probe_motion(int64_t p, double x, double motion[6]);
int64_t probe_contact(double chi, double psi, double roughness, double *velocity, int64_t *n_pieces);
void probe_piece(int64_t i, double y, int64_t *panel, double range[2], int64_t *rooted, double motion[3]);
void probe_front(int64_t n, const double *g, const double *rate, double eta, double shear, double loaded, double time,
                 const double *m, double slip, double side, double out[4]);

enum { ANGLE, RADIUS, TIME, DEPTH, VELOCITY, FORCE };

/* No panel is halved for its polynomials. */
static const double rough = 1e30;

/* ---- collocation */

/* Radau's points are the zeros of P_6 - P_5, and integrals of x^k are exact up to k = 5, at the end up to k = 10: that is what the
 * order 11 rests on. Rounding: sums of six terms below 1. */
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
    CHECK(fabs(sum - 1.0 / 12) > 1e-8, "x^11 is not integrated exactly: the order is 11"); /* 5!^2 6!^2/(11!^2 12) = 4e-7 */
}

static double power_sum(const double c[points], double x)
{
    double y = 0;
    for (int k = stages; k >= 0; k--)
        y = y * x + c[k];
    return y;
}

/* Through the start and the six points passes one polynomial of degree 6, and all that is asked of it is exact but for rounding:
 * 1e-13 for numbers of the size 1 and weights up to 735. */
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
        CHECK_NEAR(sum, power_sum(c, at), 1e-13 * (1 + 20 * (at < 0)), "value at %g", at); /* growth outside of the points */
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
        CHECK_NEAR(slope[i - 1], exact, 1e-12, "slope at point %d", i); /* differences of the size eps over 0.04 times weights */
    }
}

/* ---- arms */

/* An arm that is released relaxes by exp(-rate t). At the ends of n panels the error is that of an order of 11, at a point between
 * that of 7. */
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
    /* 2^11 and 2^7, as far as panels of 1.5 and 0.75 relaxation times are small: within a factor of 2 */
    CHECK(error[0] / error[1] > 1024 && error[0] / error[1] < 4096, "ratio %g at the end", error[0] / error[1]);
    CHECK(within[0] / within[1] > 64 && within[0] / within[1] < 256, "ratio %g within", within[0] / within[1]);
}

/* A spring integrates; a slow arm is a spring but for rate*time; where the arm relaxes in the panel its stress is that of
 * v(t) = 1 + t/3 in closed form; a fast one is a dashpot, and what it held at the start is gone. */
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
                /* of order 7 at the points: (rate/2)^7/7!/2^6 = 5e-5 (rate = 3), rounding below; terms of rate^2 for rate < 1e-2 */
                double tolerance = 3e-6 * pow(rate, 7) + 1e-15 + (rate < 1e-2 ? rate * rate : 0);
                CHECK_NEAR(sum, expected, tolerance, "rate %g, point %d", rate, i);
                CHECK_NEAR(decay[i - 1], exp(-rate * t), 1e-15 + 3e-6 * pow(rate, 7), "rate %g, point %d", rate, i);
            } else {
                /* v/rate but for 1/rate of it, times the inverse of the integrals, which is below 40 */
                CHECK_NEAR(rate * sum, 1 + t / 3, 100 / rate + 1e-13, "rate %g, point %d", rate, i);
                CHECK(fabs(decay[i - 1]) < 100 / rate, "rate %g: %g left at point %d", rate, decay[i - 1], i);
            }
        }
    }
}

/* ---- normal motion */

/* G1 = 1, and delta1, gamma of the paper as arms. */
struct solid {
    double eta, g[2], rate[2];
    int64_t n;
};

static struct solid solid_of(double delta1, double gamma)
{
    const double theta = sqrt(32.0 / 15) * delta1;
    if (theta > 0 && gamma > 0) return (struct solid){0, {1, 1 / gamma}, {0, 1 / (gamma * theta)}, 2};
    return (struct solid){theta, {1}, {0}, 1};
}

static int64_t normal(struct solid s, double depth, int halvings, int64_t counts[2])
{
    return probe_normal(s.eta, s.n, s.g, s.rate, depth, halvings, rough, counts);
}

/* Energy: D'^2 = 1 - D^(5/2); the restitution is the compression mirrored in time. Eight panels a phase miss 1e-10 at
 * their ends and 2e-9 between their points. */
static void elastic_impact_keeps_its_energy_and_is_symmetric(void **state)
{
    (void)state;
    int64_t counts[2];
    double turn[6], in[6], out[6];
    assert_int_equal(normal(solid_of(0, 0), 1, 3, counts), 0);
    assert_int_equal(counts[0], 8);
    assert_int_equal(counts[1], 16);
    probe_motion(8, 1, turn);
    CHECK_NEAR(turn[DEPTH], 1, 5e-9, "largest indentation");
    CHECK_NEAR(turn[VELOCITY], 0, 1e-11, "theta = pi/2 is where D' = 0");
    for (int p = 1; p <= 8; p++)
        for (double x = 0; x <= 1; x += 0.125) {
            probe_motion(p, x, in);
            probe_motion(17 - p, 1 - x, out);
            CHECK_NEAR(in[VELOCITY] * in[VELOCITY], 1 - pow(in[DEPTH], 2.5), 5e-9, "panel %d, x = %g", p, x);
            CHECK_NEAR(in[FORCE], 2.0 / 3 * pow(in[RADIUS], 3), 5e-9, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[ANGLE], in[ANGLE], 4 * DBL_EPSILON, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[RADIUS], in[RADIUS], 5e-9, "panel %d, x = %g", p, x);
            CHECK_NEAR(out[VELOCITY], -in[VELOCITY], 1e-8, "panel %d, x = %g", p, x);
            /* a time is known 1/D' as well as a depth: within 1e-4 of the turning point less well */
            CHECK_NEAR(out[TIME] - turn[TIME], turn[TIME] - in[TIME], 1e-7, "panel %d, x = %g", p, x);
        }
    probe_motion(16, 1, out);
    CHECK_NEAR(out[TIME], 2.9432751843, 5e-9, "contact time");
    CHECK_NEAR(out[RADIUS], 0, DBL_EPSILON, "the edge is back at the centre");
}

/* Kelvin-Voigt by itself: the compression in the root sigma of time, A' and D'' of docs/theory.md section 5, the restitution
 * D'' = -(5/4)(D + theta D')^(3/2), which ends where D + theta D' = 0. */
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

/* From y to the end of the phase in steps of h, the last one shortened by secants; the t of the end. */
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
        /* 32 panels a phase: where the dashpot is weak the turn of the velocity at the edge, of the width theta, wants them */
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

/* All rows of the recorded impacts, which another method computed: e_z, largest indentation and contact time; and what is left
 * falls with the panels. Rows that need panels of unlike width have none here, so that the bound is that of the hardest row. */
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
            const int64_t found = probe_normal(s.eta, s.n, s.g, s.rate, rows[i].max_indentation, 3 + fine,
                                               fine ? 1e-10 : 1e-6, counts);
            CHECK(found == 0, "row %d: %d", i, (int)found);
            probe_motion(counts[0], 1, turn);
            probe_motion(counts[1], 1, end);
            worst[fine] = fmax(worst[fine], fabs(-end[VELOCITY] - rows[i].ez));
            if (!fine) continue;
            CHECK_NEAR(turn[DEPTH], rows[i].max_indentation, 1e-9, "row %d", i);
            CHECK_NEAR(end[TIME], rows[i].contact_time, 1e-8, "row %d", i);
        }
    }
    /* polynomials that miss 1e-10 of D', A and s on some panel; ten times that, since several panels may */
    CHECK(worst[1] < 1e-9, "worst e_z %g", worst[1]);
    CHECK(worst[0] < 1e-5 && worst[1] < worst[0] / 100, "worst e_z %g, then %g", worst[0], worst[1]);
}

/* ---- front */

/* Cattaneo and Mindlin, loaded at an angle: D' = 1 and U' = beta < 1 to D1, where all sticks; then D stays and U goes on to U1. In the
 * units of docs/theory.md, with q = U1 - beta X^2 in stick: c^2 = (D1 - U1)/(1 - beta), H = (2/3)(1 - beta) c^3. */
static void front_of_cattaneo_and_mindlin(void **state)
{
    (void)state;
    const double g = 1, rate = 0, d1 = 0.7;
    for (double beta = -0.4; beta < 0.9; beta += 0.4)
        for (int side = -1; side <= 1; side += 2)
            for (double load = 0.05; load < 1; load += 0.2) {
                /* d U1 goes from d beta d1, where all sticks, to d1, where all slips */
                const double b = side * beta, u1 = side * (b * d1 + load * (d1 - b * d1)), m[2] = {d1, u1};
                double out[4], c = sqrt((d1 - side * u1) / (1 - b));
                probe_front(1, &g, &rate, 0, beta, d1, d1, m, -1, side, out);
                /* rounding of y, which is about 0.1 or more, by its slope 2c */
                CHECK_NEAR(out[0], c, 1e-14, "c, beta = %g, side %d, load %g", beta, side, load);
                CHECK_NEAR(out[1], 2.0 / 3 * (1 - b) * c * c * c, 1e-14, "H, beta = %g, side %d, load %g", beta, side, load);
                CHECK_NEAR(out[2], d1 - side * u1, 1e-15, "slack at the centre");
                CHECK(out[3] < 0, "no slack at the edge");
            }
    const double slack[2] = {d1, 0.1 * d1}, none[2] = {d1, 1.01 * d1};
    double out[4];
    probe_front(1, &g, &rate, 0, 0.3, d1, d1, slack, -1, 1, out); /* (y = D1 - U1 - (1 - beta) X^2 > 0 up to the edge) */
    CHECK_NEAR(out[0], sqrt(d1), 1e-15, "slack everywhere: the front is at the edge");
    CHECK_NEAR(out[1], 2.0 / 3 * 0.7 * pow(d1, 1.5) + sqrt(d1) * 0.2 * d1, 1e-14, "slack force of all of the contact");
    probe_front(1, &g, &rate, 0, 0.3, d1, d1, none, -1, 1, out);
    CHECK(out[0] == 0 && out[1] == 0, "slack nowhere");
}

/* int_0^dt exp(-rate (dt - t)) dt */
static double faded(double rate, double dt)
{
    return rate > 0 ? -expm1(-rate * dt) / rate : dt;
}

/* A solid with a spring, two arms and a dashpot, loaded at D' = 1 and U' = beta, then held in z and driven in x with U' = w: the front
 * against the slack of 20000 elements, each with its own history. */
static void front_of_a_viscoelastic_solid_is_that_of_its_elements(void **state)
{
    (void)state;
    const double g[3] = {1, 0.8, 2}, rate[3] = {0, 1.5, 0.4}, eta = 0.03, beta = 0.2, loaded = 0.9;
    for (int side = -1; side <= 1; side += 2)
        for (double later = 0.1; later < 0.5; later += 0.1) {
            const double w = side * 1.2, r = -side * w, time = loaded + later;
            double m[6], out[4], sum = 0, c = 0;
            for (int k = 0; k < 3; k++) {
                double left = rate[k] > 0 ? exp(-rate[k] * later) : 1;
                m[k] = g[k] * left * faded(rate[k], loaded);
                m[3 + k] = beta * m[k] + g[k] * w * faded(rate[k], later);
            }
            probe_front(3, g, rate, eta, beta, loaded, time, m, r, side, out);
            const int n = 20000;
            const double dx = sqrt(loaded) / n;
            for (int i = 0; i < n; i++) {
                double x = (i + 0.5) * dx, y = eta * r;
                for (int k = 0; k < 3; k++) {
                    double left = rate[k] > 0 ? exp(-rate[k] * later) : 1;
                    y += g[k] * ((1 - side * beta) * left * faded(rate[k], loaded - x * x) - side * w * faded(rate[k], later));
                }
                if (y <= 0) break;
                sum += y * dx;
                c = x + 0.5 * dx;
            }
            CHECK(c > 0.1 && c < 0.9, "partial slip: c = %g", c);
            /* elements are dx = 5e-5 wide: c to that, H to slope dx^2 = 1e-8, and the polynomials of a record miss 1e-9 */
            CHECK_NEAR(out[0], c, dx, "stick radius, side %d, %g later", side, later);
            CHECK_NEAR(out[1], sum, 2e-8, "slack force, side %d, %g later", side, later);
        }
}

/* ---- tangential motion */

/* e_x of the recorded impacts that do not slip to the end; rows where elements stick again are not for the front. */
static void recorded_tangential_motions_are_met(void **state)
{
    (void)state;
    struct truth rows[truth_rows];
    int solved = 0;
    read_truth(rows);
    for (int i = 0; i < truth_rows; i++) {
        const struct solid s = solid_of(rows[i].delta1, rows[i].gamma);
        const double critical = 2 * rows[i].chi > 1 ? 2 * rows[i].chi * (1 + rows[i].ez) - rows[i].ez : 1;
        int64_t counts[2], n_pieces;
        double velocity;
        if (rows[i].psi >= critical) continue;
        assert_int_equal(
            probe_normal(s.eta, s.n, s.g, s.rate, rows[i].max_indentation, 4, 1e-8, counts), 0);
        if (probe_contact(rows[i].chi, rows[i].psi, 1e-7 * fmin(1, rows[i].psi), &velocity, &n_pieces) != 0) continue;
        solved++;
        /* polynomials that miss 1e-7 of U' on some piece, and what the row itself may be wrong by */
        CHECK_NEAR(-velocity / rows[i].psi, rows[i].ex, 1e-6 + rows[i].err_ex, "row %d", i);
    }
    CHECK(solved >= 40, "%d rows solved by a front", solved);
}

/* A foundation of elements, driven by velocities that are known, with one arm beside the spring. */
enum { elements = 600, substeps = 40 };

struct foundation {
    double g[2], rate[2], y[2][2][elements]; /* stress of arm k in z and x */
    double x2[elements], dx;
};

/* One step of the length h with velocities that are linear in it; the sphere is at the depths d0 and d1. The force in x, and in *stuck
 * the length of what sticks. */
static double drive(struct foundation *f, double h, double d0, double d1, const double v0[2], const double v1[2],
                    double *stuck)
{
    double total = 0;
    *stuck = 0;
    for (int j = 0; j < elements; j++) {
        if (f->x2[j] >= fmax(d0, d1) && d1 >= d0) break;
        /* an element that is reached within the step has moved since then */
        const double part = f->x2[j] > d0 && d1 > d0 ? (d1 - f->x2[j]) / (d1 - d0) : 1, t = part * h;
        double force[2] = {0, 0}, gain = 0;
        for (int k = 0; k < 2; k++) {
            const double fade = exp(-f->rate[k] * t), a = faded(f->rate[k], t) / t;
            gain += f->g[k] * a;
            for (int i = 0; i < 2; i++) {
                const double mean = v1[i] - 0.5 * part * (v1[i] - v0[i]);
                f->y[k][i][j] = fade * f->y[k][i][j] + f->g[k] * a * t * mean;
                force[i] += f->y[k][i][j];
            }
        }
        if (force[0] <= 0 && d1 < d0) { /* left: it would have to pull; the arms behind it do not matter any more */
            for (int k = 0; k < 2; k++)
                f->y[k][0][j] = f->y[k][1][j] = -1e30 * (k == 0);
            continue;
        }
        const double excess = force[1] - fmax(-force[0], fmin(force[0], force[1]));
        for (int k = 0; k < 2; k++) /* slip takes the excess off, arm by arm as the step answers */
            f->y[k][1][j] -= excess * f->g[k] * (faded(f->rate[k], t) / t) / gain;
        total += (force[1] - excess) * f->dx;
        if (!(fabs(excess) > 0)) *stuck += f->dx;
    }
    return total;
}

/* S and the stick radius behind the front against elements that know of no front: they are driven by the D' and U' that were found,
 * and each slips by itself when its trial force exceeds its friction limit. chi, psi: stick from first touch, then slip from the edge. */
static void front_is_that_of_a_foundation(void **state)
{
    (void)state;
    const struct solid s = solid_of(0.8, 1.5);
    static struct foundation f;
    int64_t counts[2], n_pieces, panel, rooted;
    double velocity, range[2], before[6], now[6], old[3], new[3], stuck = 0, worst_s = 0, worst_c = 0, force = 0;
    int compared = 0;
    assert_int_equal(normal(s, 0.84, 4, counts), 0);
    assert_int_equal(probe_contact(7.0 / 6, 0.6, rough, &velocity, &n_pieces), 0);
    f = (struct foundation){.g = {s.g[0], s.g[1]}, .rate = {s.rate[0], s.rate[1]}};
    probe_motion(counts[0], 1, now);
    f.dx = now[RADIUS] / elements;
    for (int j = 0; j < elements; j++)
        f.x2[j] = pow((j + 0.5) * f.dx, 2);
    probe_motion(1, 0, before);
    for (int64_t i = 1; i <= n_pieces; i++) {
        probe_piece(i, 0, &panel, range, &rooted, old);
        for (int n = 1; n <= substeps; n++) {
            const double y = (double)n / substeps, left = rooted ? (1 - y) * (1 - y) : 1 - y;
            probe_piece(i, y, &panel, range, &rooted, new);
            probe_motion(panel, range[1] - (range[1] - range[0]) * left, now);
            force = drive(&f, now[TIME] - before[TIME], before[DEPTH], now[DEPTH], (double[]){before[VELOCITY], old[0]},
                          (double[]){now[VELOCITY], new[0]}, &stuck);
            memcpy(before, now, sizeof now);
            memcpy(old, new, sizeof new);
        }
        worst_s = fmax(worst_s, fabs(force - new[1]));
        worst_c = fmax(worst_c, fabs(stuck - new[2]));
        compared += new[2] > 0.05 && new[2] < 0.95 * now[RADIUS];
    }
    CHECK(compared > 5, "%d pieces end with a front within the contact", compared);
    /* forces are up to 0.8; elements are 1.5e-3 wide, so that the rim, where f falls to 0, counts for slope*dx^2 = 5e-6, and the
     * elements that change from stick to slip for that and for a step */
    CHECK(worst_s < 3e-5, "S off by %g", worst_s);
    CHECK(worst_c < 2 * f.dx, "stick radius off by %g, elements are %g wide", worst_c, f.dx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radau_integrates_powers),
        cmocka_unit_test(polynomials_of_degree_six_are_exact),
        cmocka_unit_test(order_is_eleven_at_the_end_and_seven_within),
        cmocka_unit_test(arms_are_springs_and_dashpots_in_their_limits),
        cmocka_unit_test(elastic_impact_keeps_its_energy_and_is_symmetric),
        cmocka_unit_test(kelvin_voigt_follows_its_own_equations),
        cmocka_unit_test(recorded_normal_motions_are_met),
        cmocka_unit_test(front_of_cattaneo_and_mindlin),
        cmocka_unit_test(front_of_a_viscoelastic_solid_is_that_of_its_elements),
        cmocka_unit_test(recorded_tangential_motions_are_met),
        cmocka_unit_test(front_is_that_of_a_foundation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
