/* The normal impact of a Kelvin-Voigt solid against its closed ODE, and the ODE's two asymptotes.
 *
 * With f = u + theta u' (2) the foundation needs no elements. Compression, every |X| < sqrt(D) in
 * contact:
 *     D'' = -(15/8) [(2/3) D^(3/2) + theta sqrt(D) D']
 * Restitution, contact where D + theta D' > X^2:  D'' = -(5/4) (D + theta D')^(3/2), until D +
 * theta D' = 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/solve.h"

/* Position and velocity. */
struct motion {
    double depth, velocity;
};

typedef struct motion rate(double variable, struct motion m, double theta);

/* D grows like s at first and sqrt(D) is not smooth there; in sigma = sqrt(s) it is. */
static struct motion compression(double sigma, struct motion m, double theta)
{
    double root = sqrt(fmax(0, m.depth));
    double force = 2.0 / 3 * m.depth * root + theta * root * m.velocity;
    return (struct motion){2 * sigma * m.velocity, -2 * sigma * 15.0 / 8 * force};
}

static struct motion restitution(double s, struct motion m, double theta)
{
    double edge = fmax(0, m.depth + theta * m.velocity);
    (void)s;
    return (struct motion){m.velocity, -1.25 * edge * sqrt(edge)};
}

static struct motion along(struct motion m, double h, struct motion slope)
{
    return (struct motion){m.depth + h * slope.depth, m.velocity + h * slope.velocity};
}

/* One classical Runge-Kutta step. */
static struct motion step(rate *f, double t, struct motion m, double h, double theta)
{
    struct motion a = f(t, m, theta);
    struct motion b = f(t + h / 2, along(m, h / 2, a), theta);
    struct motion c = f(t + h / 2, along(m, h / 2, b), theta);
    struct motion d = f(t + h, along(m, h, c), theta);
    return (struct motion){m.depth + h / 6 * (a.depth + 2 * b.depth + 2 * c.depth + d.depth),
                           m.velocity + h / 6 * (a.velocity + 2 * b.velocity + 2 * c.velocity + d.velocity)};
}

/* What ends a phase when it falls to zero: the velocity, or the force at the centre. */
static double until(rate *f, struct motion m, double theta)
{
    return f == compression ? m.velocity : m.depth + theta * m.velocity;
}

/* Steps of `fineness` times the fastest time scale; the last one is shortened by bisection to end
 * where the phase does. */
static struct motion phase(rate *f, struct motion m, double theta, double fineness)
{
    double t = 0;
    for (;;) {
        double viscous = 15.0 / 8 * theta;
        double h = fineness / (f == compression ? 1 + cbrt(viscous) : 1 + viscous * sqrt(until(f, m, theta)));
        struct motion next = step(f, t, m, h, theta);
        if (until(f, next, theta) > 0) {
            m = next;
            t += h;
            continue;
        }
        double low = 0, high = h;
        for (int i = 0; i < 60; i++) {
            double middle = 0.5 * (low + high);
            if (until(f, step(f, t, m, middle, theta), theta) > 0)
                low = middle;
            else
                high = middle;
        }
        return step(f, t, m, low, theta);
    }
}

static double ez_with(double theta, double fineness)
{
    struct motion m = phase(compression, (struct motion){0, 1}, theta, fineness);
    return -phase(restitution, m, theta, fineness).velocity;
}

/* e_z by the ODE; halving the step must not change it by more than 1e-9 of its value. (The last
 * step ends where the force, a power 3/2, leaves zero: there the order is 2.5 instead of 4.) */
static double ez_of(double delta1)
{
    double theta = THETA_OF_DELTA1 * delta1, ez = ez_with(theta, 0.001);
    CHECK_NEAR(ez_with(theta, 0.002), ez, 1e-9 * ez, "delta1 %g: the step of the reference", delta1);
    return ez;
}

/* The error is below the requested tolerance, and near the estimate. The estimate is 1.25 times the
 * last change c between resolutions. With an error a h - b h^2 that change is a h - 3 b h^2: as
 * long as the second-order part is below a fifth of the first-order one, the error is below 2 c,
 * that is 1.6 times the estimate. */
static void ez_follows_the_closed_ode(void **state)
{
    (void)state;
    for (int i = 0; i <= 20; i++) {
        double delta1 = pow(10, -3 + 0.25 * i), ez = ez_of(delta1);
        for (double tolerance = 1e-2; tolerance > 5e-6; tolerance /= 10) {
            struct restitute_result r = solve_pair(to_tolerance(tolerance), impact_of(7.0 / 6, 3, delta1, 0)).result;
            CHECK_NEAR(r.ez, ez, fmin(tolerance, 1.6 * r.error_ez), "delta1 %g, tolerance %g", delta1, tolerance);
        }
    }
}

/* The reference itself: two rows of the truth table. */
static void the_ode_gives_known_values(void **state)
{
    (void)state;
    CHECK_NEAR(ez_of(7.12413), 0.015102848360, 2e-11, "to 1e-9 of its value");
    CHECK_NEAR(ez_of(1), 0.2008, 5e-5, "printed to 4 digits");
}

/* 1 - e_z = 1.891706 theta - c theta^2: the remainder quarters when theta halves. The next term, of
 * third order, is theta times as large: 2 % of the remainder at delta1 = 0.01 for a coefficient of
 * 1; 10 % allows for one of 5. */
static void little_damping_has_the_first_order_coefficient_1_891706(void **state)
{
    (void)state;
    double remainder[2];
    for (int i = 0; i < 2; i++) {
        double delta1 = 0.01 / (1 << i), theta = THETA_OF_DELTA1 * delta1;
        struct restitute_result r = solve_pair(to_tolerance(1e-6), impact_of(7.0 / 6, 10, delta1, 0)).result;
        remainder[i] = 1 - r.ez - 1.891706 * theta;
        CHECK(fabs(remainder[i]) > 20 * r.error_ez, "delta1 %g: remainder %g hides in the error %g", delta1,
              remainder[i], r.error_ez);
    }
    CHECK_NEAR(remainder[0] / remainder[1], 4, 0.4, "remainders %g, %g", remainder[0], remainder[1]);
}

static double ratio_to_asymptote(double delta1, double ez)
{
    double theta = THETA_OF_DELTA1 * delta1;
    return ez * theta / pow(4 / (5 * theta), 2.0 / 3);
}

/* e_z -> (4/(5 theta))^(2/3)/theta: the ratio goes to 1. The next term is of the relative order
 * theta^(-4/3) or lower, so ten times the damping takes at least away half of the distance. */
static void strong_damping_has_the_asymptote(void **state)
{
    (void)state;
    double last = INFINITY;
    for (double delta1 = 1; delta1 < 2e4; delta1 *= 10) {
        double distance = fabs(ratio_to_asymptote(delta1, ez_of(delta1)) - 1);
        CHECK(distance < 0.5 * last, "delta1 %g: distance %g after %g", delta1, distance, last);
        last = distance;
    }
    /* and the library with it, to its own estimate, made relative */
    struct restitute_result r = solve_pair(to_tolerance(1e-7), impact_of(7.0 / 6, 10, 100, 0)).result;
    double estimate = r.error_ez / r.ez, left = fabs(ratio_to_asymptote(100, ez_of(100)) - 1);
    CHECK_NEAR(ratio_to_asymptote(100, r.ez), 1, left + 1.01 * estimate, "ez %g", r.ez);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ode_gives_known_values),
        cmocka_unit_test(ez_follows_the_closed_ode),
        cmocka_unit_test(little_damping_has_the_first_order_coefficient_1_891706),
        cmocka_unit_test(strong_damping_has_the_asymptote),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
