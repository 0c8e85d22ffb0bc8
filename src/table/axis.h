/* The axes of a table: places of speed and psi, and cubics between them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_AXIS_H
#define RST_TABLE_AXIS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* s(v) = k + p(m - 1) for v = 2^k m, 1 <= m < 2. p is the polynomial of degree 4 with p(0) = 0 and p(1) = 1 for which
 * s has three continuous derivatives. It differs from log2(v) by less than 2e-3 and takes a tenth of its time. */
static const double rst_s1 = 152.0 / 105, rst_s2 = -72.0 / 105, rst_s3 = 32.0 / 105, rst_s4 = -7.0 / 105;

/* s and its derivative by v, for a normal v > 0. */
static inline double rst_axis_place(double v, double *slope)
{
    int64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int64_t fraction = (INT64_C(1) << 52) - 1, one = INT64_C(1023) << 52;
    const int64_t of_mantissa = (bits & fraction) | one, of_power = (INT64_C(2046) << 52) - (bits & ~fraction);
    double m, inverse_power; /* 2^-k */
    memcpy(&m, &of_mantissa, sizeof m);
    memcpy(&inverse_power, &of_power, sizeof inverse_power);
    const double x = m - 1, square = x * x;
    if (slope) *slope = ((rst_s1 + 2 * rst_s2 * x) + square * (3 * rst_s3 + 4 * rst_s4 * x)) * inverse_power;
    return (double)((bits >> 52) - 1023) + (x * (rst_s1 + rst_s2 * x) + square * x * (rst_s3 + rst_s4 * x));
}

/* v with s(v) = s, by Newton's method. */
static inline double rst_axis_speed(double s)
{
    double v = exp2(s), slope;
    for (int i = 0; i < 4; i++) {
        const double off = rst_axis_place(v, &slope) - s;
        v -= off / slope;
    }
    return v;
}

/* t(y) = 1/2 + (sqrt(y + c^2) - sqrt(1 - y + c^2))/(2 (sqrt(1 + c^2) - c)): cells are narrow where e_x has singular
 * curvature, at psi = 1 and psi_c. With c = 0.02 a panel needs the fewest cells; 0.06 takes twice as many. */
static const double rst_c = 0.02;
static const double rst_c2 = 0.0004, rst_of_t = 0.5100999900019996; /* 1/(2 (sqrt(1 + c^2) - c)) */

static inline double rst_panel_place(double y)
{
    return 0.5 + rst_of_t * (sqrt(rst_c2 + y) - sqrt((1 + rst_c2) - y));
}

static inline double rst_panel_slope(double y)
{
    return 0.5 * rst_of_t * (1 / sqrt(rst_c2 + y) + 1 / sqrt((1 + rst_c2) - y));
}

static inline double rst_panel_y(double t)
{
    const double r = (t - 0.5) / rst_of_t;
    const double y = 0.5 * (1 + r * sqrt(2 * (1 + 2 * rst_c2) - r * r));
    return fmin(1, fmax(0, y));
}

/* Hermite's cubic at u in [0, 1]: weights of value and slope at 0, then at 1. */
static inline void rst_hermite(double u, double w[4])
{
    const double v = 1 - u, uu = u * u, vv = v * v;
    w[0] = vv * (1 + 2 * u);
    w[1] = vv * u;
    w[2] = uu * (3 - 2 * u);
    w[3] = -uu * v;
}

/* The derivatives of these weights by u. */
static inline void rst_hermite_slope(double u, double w[4])
{
    const double v = 1 - u;
    w[0] = -6 * u * v;
    w[1] = v * (v - 2 * u);
    w[2] = 6 * u * v;
    w[3] = u * (u - 2 * v);
}

#endif
