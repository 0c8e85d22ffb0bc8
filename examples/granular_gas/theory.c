/* SPDX-License-Identifier: BSD-3-Clause
 * Cooling of smooth spheres, see theory.h. Impacts: omega = <|g|> = 4 sqrt(T/pi) a sphere and time.
 * An impact takes (1 - ez^2) v_n^2/4, where v_n = 2 sqrt(T) y has the density 2 y exp(-y^2) among
 * impacts, so that <v_n^2>/4 = T. With (3/2) dT/dt = -(omega/2) <(1 - ez^2) v_n^2/4> follows dT/dt
 * = -(omega/3) A T. */
#include "theory.h"

#include <math.h>

static double pi(void)
{
    return acos(-1.0);
}

double theory_haff(double ez, double start, double time)
{
    const double e2 = ez * ez;
    const double a2 = 16 * (1 - ez) * (1 - 2 * e2) / (81 - 17 * ez + 30 * e2 * (1 - ez));
    const double rate = 4 * sqrt(start / pi()) * (1 - e2) / 6 * (1 + 3 * a2 / 16);
    return start / ((1 + rate * time) * (1 + rate * time));
}

/* A(T), weighted by energy: integral of (1 - ez^2) 2 y^3 exp(-y^2) by Simpson's rule; beyond y = 6
 * lie 1e-14 of it. */
static double loss(const struct gas_law *law, double temperature)
{
    enum { CELLS = 120 };
    const double step = 6.0 / CELLS;
    double sum = 0;
    for (int i = 1; i < CELLS; ++i) {
        const double y = i * step, ez = gas_pair(law, 2 * sqrt(temperature) * y, 0).ez;
        sum += (i % 2 ? 4 : 2) * (1 - ez * ez) * 2 * y * y * y * exp(-y * y);
    }
    return sum * step / 3;
}

/* d ln T/dt */
static double slope(const struct gas_law *law, double logarithm)
{
    const double temperature = exp(logarithm);
    return -4.0 / 3 * sqrt(temperature / pi()) * loss(law, temperature);
}

/* Runge and Kutta, fourth order, in steps of a twentieth of the time in which T falls by e: its
 * error is below 1e-6. */
double theory_frictionless(const struct gas_law *law, double start, double time)
{
    double logarithm = log(start);
    while (time > 0) {
        const double k1 = slope(law, logarithm), h = fmin(time, -0.05 / k1);
        const double k2 = slope(law, logarithm + 0.5 * h * k1), k3 = slope(law, logarithm + 0.5 * h * k2);
        const double k4 = slope(law, logarithm + h * k3);
        logarithm += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        time -= h;
    }
    return exp(logarithm);
}
