/* The axes of a table: places of speed and psi, and cubics between them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_AXIS_H
#define RST_TABLE_AXIS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* s(v) = k + p(m - 1) for v = 2^k m, 1 <= m < 2: within 7e-7 of log2(v), and much faster. p is the
 * polynomial of degree 7 with the smallest largest error for which s has two continuous
 * derivatives. A coarser polynomial is not enough: s - log2(v) of every octave appears in the
 * interpolated functions. */
static const double rst_s[8] = {0,
                                1.4426826110991595,
                                -0.7207275153258296,
                                0.4738685537384745,
                                -0.3255206379958932,
                                0.19215686619879618,
                                -0.07702542887920055,
                                0.014565551164493075};

/* s and its derivative by v, for a normal v > 0. */
static inline double rst_axis_place(double v, double *slope)
{
    int64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int64_t fraction = (INT64_C(1) << 52) - 1;
    const int64_t of_mantissa = (bits & fraction) | INT64_C(1023) << 52;
    const int64_t of_power = (INT64_C(2046) << 52) - (bits & ~fraction);
    double m, inverse_power; /* 2^-k */
    memcpy(&m, &of_mantissa, sizeof m);
    memcpy(&inverse_power, &of_power, sizeof inverse_power);
    const double x = m - 1, x2 = x * x, x4 = x2 * x2, *p = rst_s;
    if (slope)
        *slope = ((p[1] + 2 * p[2] * x) + x2 * (3 * p[3] + 4 * p[4] * x) +
                  x4 * ((5 * p[5] + 6 * p[6] * x) + x2 * (7 * p[7]))) *
                 inverse_power;
    const int64_t of_exponent = bits >> 52 | INT64_C(1075) << 52; /* as 2^52 + it, which compilers vectorise */
    double exponent;
    memcpy(&exponent, &of_exponent, sizeof exponent);
    return (exponent - (0x1p52 + 1023)) +
           ((x * p[1] + x2 * (p[2] + p[3] * x)) + x4 * ((p[4] + p[5] * x) + x2 * (p[6] + p[7] * x)));
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

/* t(y) = 1/2 + (y - 1/2) (1 + c^(1/4) - w^(1/4)), w = y (1 - y) + c: cells are narrow at psi = 1
 * and psi_c, where g follows powers such as 5/3 and 3/2 of the distance. With the fourth root
 * cubics need the fewest cells; with a square root twice as many. c keeps slopes finite: 1e-4 and
 * 5e-4 are as good. */
static const double rst_c = 2e-4, rst_a = 1.1189207115002722; /* 1 + c^(1/4) */

static inline double rst_panel_place(double y)
{
    return 0.5 + (y - 0.5) * (rst_a - sqrt(sqrt(y * (1 - y) + rst_c)));
}

static inline double rst_panel_slope(double y)
{
    const double w = y * (1 - y) + rst_c, root = sqrt(sqrt(w)), off = y - 0.5;
    return rst_a - root + 0.5 * off * off * (root / w);
}

/* By Newton's method: from below t(y) and y rise to them, as t bends down in the lower half; the
 * upper one mirrors it. */
static inline double rst_panel_y(double t)
{
    const double lower = t < 0.5 ? t : 1 - t;
    double y = 0, step;
    do {
        step = (lower - rst_panel_place(y)) / rst_panel_slope(y);
        y += step;
    } while (step > 0x1p-54);
    return t < 0.5 ? y : 1 - y;
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

#endif
