/* Looking up in a table of two axes, speed and psi: one place, or a block of them with the same bits. The polynomials
 * are those of rst_table_set_polynomials: 1/(1 + ez) in each cell of speed, and in each cell of speed and psi what ex
 * exceeds the closed form of slip to the end by (27), which is taken at psi = 1 for psi < 1. With 1/(1 + ez) nothing is
 * divided on the way from the speed to y = (psi - 1)/((2 chi - 1)(1 + ez)), and no branch is taken anywhere: on which
 * side of psi = 1 and of psi_c a place is cannot be foreseen. SPDX-License-Identifier: BSD-3-Clause */
#include "lookup.h"

static const int64_t one = INT64_C(1023) << 52, fraction = (INT64_C(1) << 52) - 1;

/* ---- one place. What is waited for is kept short, and numbers stand in pairs where that spares instructions. */

/* What follows the first `leading` bits of the fractions of two numbers, as numbers in [1, 2). */
static inline rst_two behind(int leading, rst_two number)
{
    const rst_whole_two ones = {one, one}, fractions = {fraction, fraction};
    return (rst_two)(((rst_whole_two)number << leading & fractions) | ones);
}

/* The same of one. */
static inline double behind_one(int leading, double number)
{
    return rst_tree_number((uint64_t)rst_bits_of(number) << 12, leading);
}

/* Bits of u + rst_cells_begin that are the cell of psi, times the bytes of a patch. */
static inline int64_t patch_of(double u)
{
    enum { bits_of_patch = 7, shift = 52 - rst_bits_of_cell - bits_of_patch };
    return rst_bits_of(u) >> shift & ((int64_t)rst_most_psi_cells << bits_of_patch);
}

/* For two powers of psi. */
static inline rst_two sum_along_speed(const double *c, rst_two x, rst_two x2, rst_two x3)
{
    return (rst_two_at(c) + rst_two_at(c + 4) * x) + (rst_two_at(c + 8) * x2 + rst_two_at(c + 12) * x3);
}

static inline rst_two clamp_both(rst_two value, double low, double high)
{
    return rst_two_smaller(rst_two_larger(value, rst_two_of(low)), rst_two_of(high));
}

void rst_two_axes_pair(const restitute_table *t, double speed, double sliding, double v_n, restitute_table_value *pair)
{
    const struct rst_octaves *axis = &t->speed;
    const int slips = sliding > v_n;
    const struct rst_psi_cells *cells = &t->psi_cells[slips];
    /* q, and square y (1 + ez) or 0; nothing is lost by the limit, since 1 + ez <= 2 */
    const double share = t->share * v_n + rst_least;
    const double more = rst_smaller((sliding - v_n) * cells->small, share * t->limit);
    const rst_two divisor = {rst_larger(sliding, v_n) + rst_least, share};
    const rst_two part = (rst_two){rst_smaller(sliding, v_n), more} / divisor;

    const rst_two number = rst_two_smaller(rst_two_larger(rst_two_of(speed), t->low), t->high);
    const int64_t cell = (rst_bits_of(number[0]) >> axis->shift) - axis->first;
    const rst_two x = behind(52 - axis->shift, number), x2 = x * x, x3 = x2 * x;
    const double *power = t->inverse[cell];
    const rst_two sums = rst_two_at(power) + rst_two_at(power + 2) * x;
    const rst_two inverse = clamp_both(rst_two_of(sums[0]) + x2 * rst_two_of(sums[1]), 0.5, 1);

    const rst_two beyond = rst_two_of(part[1]) * inverse;
    const rst_two along = rst_two_smaller(beyond, cells->square);
    const rst_two up = cells->soft + along, down = cells->total - along;
    const rst_two u = rst_two_of(sqrt(rst_two_smaller(up, down)[0]) + (part[0] * cells->of_psi + cells->begin));
    const rst_two y = behind(rst_bits_of_cell, u), first = {1, y[0]}, last = first * (y * y);

    const double q = part[0] * cells->closed + cells->open; /* 1 for psi <= 1 */
    const double full = 1 / inverse[0], aside = full * (2 * t->chi_low * q) - 1;
    const rst_whole_two kept = (rst_whole_two)(beyond <= cells->square); /* up to psi_c */
    double(*patches)[4][4] = t->patch + cell * t->cells_of_psi + t->first_cell[slips + (up[0] > down[0])];
    const double *c = (const double *)(const void *)((const char *)patches + patch_of(u[0]));
    const rst_two terms = first * sum_along_speed(c, x, x2, x3) + last * sum_along_speed(c + 2, x, x2, x3);
    const rst_two ex = (rst_two)((rst_whole_two)(terms + rst_two_turned(terms)) & kept);
    pair->ez = full - 1;
    pair->ex = clamp_both(rst_two_of(aside) + ex, -1, 1)[0];
}

double rst_two_axes_rebound(const restitute_table *t, double speed)
{
    const double number = rst_clamp(speed, t->speed.low, t->speed.high), x = behind_one(52 - t->speed.shift, number);
    const double *power = t->inverse[(rst_bits_of(number) >> t->speed.shift) - t->speed.first];
    return 1 / rst_clamp((power[0] + power[2] * x) + x * x * (power[1] + power[3] * x), 0.5, 1) - 1;
}

/* ---- a block of places, step by step for all of it, so that no place waits for another one and that compilers may
 * take vectors */

struct seats {
    double speed[3][rst_block]; /* powers of the place in a cell of speed, from the first on */
    double psi[rst_block];      /* place in a cell of psi */
    int64_t row[rst_block];     /* cell of speed */
    int64_t patch[rst_block];
    double full[rst_block], inverse[rst_block]; /* 1 + ez and 1 over it */
    double closed[rst_block], kept[rst_block];  /* (27); 0 beyond psi_c, where nothing else is added */
};

/* a < b ? a : b and a > b ? a : b, which compilers know how to do for many at once. */
static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static void find_speeds(const restitute_table *t, int n, const double *restrict speed, struct seats *restrict at)
{
    const int shift = t->speed.shift;
    for (int i = 0; i < n; i++) {
        const double number = smaller(larger(speed[i], t->speed.low), t->speed.high);
        const double x = behind_one(52 - shift, number);
        at->row[i] = (rst_bits_of(number) >> shift) - t->speed.first;
        at->speed[0][i] = x;
        at->speed[1][i] = x * x;
        at->speed[2][i] = x * x * x;
    }
    for (int i = 0; i < n; i++) {
        const double *power = t->inverse[at->row[i]], x = at->speed[0][i], x2 = at->speed[1][i];
        at->inverse[i] = (power[0] + power[2] * x) + x2 * (power[1] + power[3] * x);
    }
    for (int i = 0; i < n; i++) {
        at->inverse[i] = smaller(larger(at->inverse[i], 0.5), 1);
        at->full[i] = 1 / at->inverse[i];
    }
}

static void find_psi(const restitute_table *t, int n, const double *restrict sliding, const double *restrict v_n,
                     struct seats *restrict at)
{
    double u[rst_block], part[rst_block];
    const struct rst_psi_cells stick = t->psi_cells[0], slip = t->psi_cells[1];
    const double square = slip.square[0], soft = slip.soft[0], total = slip.total[0], twice_chi = 2 * t->chi_low;
    for (int i = 0; i < n; i++) {
        const double slips = sliding[i] > v_n[i] ? 1 : 0, share = t->share * v_n[i] + rst_least;
        const double q = smaller(sliding[i], v_n[i]) / (larger(sliding[i], v_n[i]) + rst_least);
        const double more = smaller((sliding[i] - v_n[i]) * (slips * rst_small), share * t->limit);
        const double beyond = more / share * at->inverse[i];
        const double along = smaller(beyond, square), up = soft + along, down = total - along;
        u[i] = slips * (sqrt(smaller(up, down)) + slip.begin) + (1 - slips) * (q * stick.of_psi + stick.begin);
        part[i] = slips + slips * (up > down ? 1 : 0);
        at->kept[i] = beyond <= square ? 1 : 0;
        at->closed[i] = at->full[i] * (twice_chi * (q * slips + (1 - slips))) - 1;
    }
    for (int i = 0; i < n; i++) {
        at->psi[i] = behind_one(rst_bits_of_cell, u[i]);
        at->patch[i] = at->row[i] * t->cells_of_psi + t->first_cell[(int)part[i]] + rst_psi_cell(u[i]);
    }
}

static void sum_up(const restitute_table *t, int n, const struct seats *restrict at, double *restrict ex)
{
    for (int i = 0; i < n; i++) {
        const double *c = t->patch[at->patch[i]][0], y = at->psi[i], y2 = y * y;
        const double x = at->speed[0][i], x2 = at->speed[1][i], x3 = at->speed[2][i];
        double sum[4];
        for (int j = 0; j < 4; j++)
            sum[j] = (c[j] + c[4 + j] * x) + (c[8 + j] * x2 + c[12 + j] * x3);
        ex[i] = (sum[0] + y2 * sum[2]) + (y * sum[1] + (y * y2) * sum[3]);
    }
    for (int i = 0; i < n; i++)
        ex[i] = smaller(larger(at->closed[i] + at->kept[i] * ex[i], -1), 1);
}

void rst_two_axes_pairs(const restitute_table *t, int n, const double *speed, const double *sliding, const double *v_n,
                        double *ez, double *ex)
{
    struct seats at;
    find_speeds(t, n, speed, &at);
    find_psi(t, n, sliding, v_n, &at);
    sum_up(t, n, &at, ex);
    for (int i = 0; i < n; i++)
        ez[i] = at.full[i] - 1;
}
