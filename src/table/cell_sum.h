/* The polynomials of cells (serendipity.h), summed two or four terms at once.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_CELL_SUM_H
#define RST_TABLE_CELL_SUM_H

#include <stdint.h>

#include "select.h"
#include "serendipity.h"

/* Four numbers that are added at once, and four as they stand in a cell. */
typedef float rst_four __attribute__((__vector_size__(16)));
typedef float rst_kept_four __attribute__((__vector_size__(16), __aligned__(4), __may_alias__));

static inline rst_four rst_four_at(const float *c)
{
    return *(const rst_kept_four *)(const void *)c;
}

static inline rst_four rst_four_of(float x)
{
    return (rst_four){x, x, x, x};
}

/* ez at places w and gamma in its cell. The functions of both go side by side, and so do coefficients that differ in
 * an end of gamma, or of w. */
static inline double rst_sum_rebound(const double *c, double w, double gamma)
{
    const rst_two u = {w, gamma}, other = 1 - u, fourfold = 4 * u, parabola = fourfold * other;
    const rst_two part = ((8.0 / 3) * u - 4.0 / 3) * parabola;
    const rst_two first = part * (fourfold - 3), third = part * (fourfold - 1);
    const rst_two at_ends = rst_two_of(other[0]) * rst_two_at(c) + rst_two_of(u[0]) * rst_two_at(c + 2);
    const rst_two between = rst_two_of(parabola[0]) * rst_two_at(c + 4) +
                            (rst_two_of(first[0]) * rst_two_at(c + 8) + rst_two_of(third[0]) * rst_two_at(c + 10));
    const rst_two by_gamma = rst_two_of(parabola[1]) * rst_two_at(c + 6) +
                             (rst_two_of(first[1]) * rst_two_at(c + 12) + rst_two_of(third[1]) * rst_two_at(c + 14));
    const rst_two sum = (rst_two){other[1], u[1]} * (at_ends + between) + (rst_two){other[0], u[0]} * by_gamma;
    return (sum[0] + sum[1]) + parabola[0] * parabola[1] * c[16];
}

/* The 17 functions of a pair of axes, in their order. */
struct rst_pair_functions {
    rst_four ends, middles, quarters[2];
    float cross;
};

#define RST_CHOOSE __builtin_shufflevector

/* f: functions of four axes by place; of which x and y are two. */
#define RST_PAIR_OF(f, x, y)                                                                                           \
    {                                                                                                                  \
        .ends = RST_CHOOSE((f)[0], (f)[4], x, x, 4 + x, 4 + x) * RST_CHOOSE((f)[0], (f)[4], y, 4 + y, y, 4 + y),       \
        .middles = RST_CHOOSE((f)[2], (f)[2], x, x, y, y) * RST_CHOOSE((f)[0], (f)[4], y, 4 + y, x, 4 + x),            \
        .quarters = {RST_CHOOSE((f)[1], (f)[3], x, x, 4 + x, 4 + x) * RST_CHOOSE((f)[0], (f)[4], y, 4 + y, y, 4 + y),  \
                     RST_CHOOSE((f)[1], (f)[3], y, y, 4 + y, 4 + y) * RST_CHOOSE((f)[0], (f)[4], x, 4 + x, x, 4 + x)}, \
        .cross = (f)[2][x] * (f)[2][y]                                                                                 \
    }

/* rst_serendipity_functions of four axes. */
static inline void rst_four_functions(rst_four u, rst_four f[rst_places])
{
    const rst_four twice = 2 * u, parabola = 2 * twice * (1 - u), part = parabola * (twice - 1) * (4.0F / 3);
    f[0] = 1 - u;
    f[1] = part * (2 * twice - 3);
    f[2] = parabola;
    f[3] = part * (2 * twice - 1);
    f[4] = u;
}

/* Four rows, `stride` apart, each times one of four values. Sums are kept short, since additions wait for each other.
 * */
static inline rst_four rst_sum_rows(const float *c, int64_t stride, rst_four value)
{
    const rst_four low = rst_four_of(value[0]) * rst_four_at(c) + rst_four_of(value[1]) * rst_four_at(c + stride);
    const rst_four high =
        rst_four_of(value[2]) * rst_four_at(c + 2 * stride) + rst_four_of(value[3]) * rst_four_at(c + 3 * stride);
    return low + high;
}

/* What w and gamma make of sums over psi and chi. */
static inline double rst_sum_pair(const struct rst_pair_functions *first, rst_four ends, rst_four middles,
                                  rst_four quarters_0, rst_four quarters_1, rst_four cross)
{
    const rst_four total = ((first->quarters[0] * quarters_0 + first->quarters[1] * quarters_1) +
                            (first->middles * middles + rst_four_of(first->cross) * cross)) +
                           first->ends * ends;
    return (double)((total[0] + total[1]) + (total[2] + total[3]));
}

/* ex in a cell whose table has an axis of chi; u: psi, chi, w, gamma. The rows of coefficients: 16 for each function
 * of the ends of psi and chi, and then the last of each of these; 8 for each of their middles; 4 for each of the
 * others. */
static inline double rst_sum_cell(const float *c, rst_four u)
{
    rst_four f[rst_places];
    rst_four_functions(u, f);
    const struct rst_pair_functions first = RST_PAIR_OF(f, 2, 3), second = RST_PAIR_OF(f, 0, 1);
    const float *last = c + 64, *middle = last + 4, *quarter = middle + 32;
    const rst_four quarters =
        rst_sum_rows(quarter, 4, second.quarters[0]) + rst_sum_rows(quarter + 16, 4, second.quarters[1]);
    const rst_four others = quarters + rst_four_of(second.cross) * rst_four_at(quarter + 32);
    const rst_four ends = (rst_sum_rows(c, 16, second.ends) + rst_sum_rows(middle, 8, second.middles)) + others;
    const rst_four middles = rst_sum_rows(c + 4, 16, second.ends) + rst_sum_rows(middle + 4, 8, second.middles);
    return rst_sum_pair(&first, ends, middles, rst_sum_rows(c + 8, 16, second.ends),
                        rst_sum_rows(c + 12, 16, second.ends), second.ends * rst_four_at(last));
}

/* The same without an axis of chi: 16 for each end of psi, and the last of both; 8 for the middle; 4 for each quarter.
 * */
static inline double rst_sum_without_chi(const float *c, rst_four u)
{
    rst_four f[rst_places];
    rst_four_functions(u, f);
    const struct rst_pair_functions first = RST_PAIR_OF(f, 2, 3);
    const rst_four low = rst_four_of(f[0][0]), high = rst_four_of(f[4][0]), middle = rst_four_of(f[2][0]);
    const rst_four others = rst_four_of(f[1][0]) * rst_four_at(c + 42) + rst_four_of(f[3][0]) * rst_four_at(c + 46);
    const rst_four ends = (low * rst_four_at(c) + high * rst_four_at(c + 16)) + (middle * rst_four_at(c + 34) + others);
    const rst_four middles = (low * rst_four_at(c + 4) + high * rst_four_at(c + 20)) + middle * rst_four_at(c + 38);
    const rst_four cross = {low[0] * c[32], high[0] * c[33], 0, 0};
    return rst_sum_pair(&first, ends, middles, low * rst_four_at(c + 8) + high * rst_four_at(c + 24),
                        low * rst_four_at(c + 12) + high * rst_four_at(c + 28), cross);
}

#endif
