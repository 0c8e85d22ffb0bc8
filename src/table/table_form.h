/* The inside of a table: how it is laid out, and how a place in it is found.
 *
 * Values are kept at nodes. Along the speed (or delta1) and along gamma an octave of the number is divided into 2^k
 * equal cells, each with a cubic through four nodes that are evenly spaced. So cell and place in the cell are the
 * leading and the other bits of the number itself, and no logarithm is taken. Along psi: even cells from 0 to 1, then
 * for y = (psi - 1)/(psi_c - 1) even cells of r(y) up to y = 1/2 and of r(1 - y) beyond, r(y) = sqrt(y + c^2) - c,
 * which are dense at both ends (THEORY 9: there ex has singular curvature; c keeps slopes finite); each has a cubic as
 * well; so have even cells of chi. Cells share the nodes at their seams.
 *
 * A table with axes of delta1 and gamma has a tree of cells for ez and one for ex (tree.h). A cell keeps the
 * coefficients of its polynomial (serendipity.h) side by side, in single precision for ex: a lookup then reads a run
 * of memory.
 *
 * For psi <= 1 ex itself is kept, beyond it what it exceeds the closed form of full slip by (27): 0 at psi_c. In cells
 * of a tree that is psi ex - y ez beyond psi = 1, which is ex at psi = 1 and 0 at psi_c, where ex is ez/psi_c:
 * continuous there whatever the error of ez.
 *
 * A table of two axes, speed and psi, has polynomials besides its nodes, so that a lookup reads one run of memory: in
 * each cell of speed one of 1/(1 + ez), in each cell of speed and psi one of what ex exceeds the closed form by. For
 * psi <= 1 that is the closed form at psi = 1, so that both sides meet there. SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_FORM_H
#define RST_TABLE_FORM_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include <restitute/table.h>

#include "select.h"
#include "serendipity.h"
#include "tree.h"

enum {
    rst_cubic = 3, /* degree along all axes */
    rst_most_chi = 33,
    rst_log_parts = 64
};

/* A number of roots, at most rst_most_roots, is kept as rst_roots_begin and that: the root is then so many of the bits
 * of the fraction, and the others are the place in it. Builds have at most 1193 (family.c limits the ranges). */
enum { rst_bits_of_root = 11, rst_most_roots = 2047 };
static const double rst_roots_begin = 2048;

/* log2 of w = delta1 h(gamma), divided into roots of a tree. */
struct rst_w_axis {
    int64_t first, roots;                              /* the first begins at log2 w = first 2^width */
    int64_t width;                                     /* log2 of the octaves of a root */
    double scale;                                      /* 2^-width */
    double begin, end;                                 /* first - rst_roots_begin; just below rst_roots_begin + roots */
    double series[5];                                  /* of log2(1 + r) times `scale`, from the first power on */
    double inverse[rst_log_parts], log[rst_log_parts]; /* of the middles of parts of [1, 2]; times `scale` */
};

/* An axis by octaves. */
struct rst_octaves {
    double low, high; /* numbers beyond are taken as these; below the last node */
    int64_t first;    /* leading bits of the first node */
    int64_t cells;    /* 0: one node, no axis */
    int shift;        /* how many bits are not leading */
    int64_t mask;     /* those bits */
    double scale;     /* 3/2^shift */
};

/* Of lookups, m/s: times the factors of a contact (ranges.h) it does not overflow. */
static const double rst_largest_speed = 1e100;

/* Speeds that are compared are taken times this, so that nothing overflows that multiplies them. */
static const double rst_small = 0x1p-24;

/* Cells of psi on one side of psi = 1. A place is counted in cells,
 *
 *     u = sqrt(m) - sqrt(soft) + of_psi q,  m = min(soft + square y, soft + square (1 - y)),
 *
 * with q = psi or 1/psi: of_root r(y) or of_root r(1 - y) beyond psi = 1, where of_psi is 0, and of_psi psi below it,
 * where square and soft are 0. begin + sqrt(m) + of_psi q = rst_cells_begin + u is a number whose leading bits are the
 * cell; closed: how much of the closed form of slip to the end is kept aside. What is not foreseen is looked up, not
 * branched for. */
struct rst_psi_cells {
    rst_two square, soft, total; /* each twice; total: soft + square */
    double of_root, of_psi, begin;
    double closed, open; /* open: 1 - closed */
    double small;        /* rst_small or 0 */
};

/* So many bits of the fraction of such a number are the cell. */
enum { rst_bits_of_cell = 8, rst_most_psi_cells = 255 };
static const double rst_cells_begin = 256;

/* The closed form has 2 chi (1 + ez): an error of 1/(1 + ez) between nodes is felt by ex so many times. Spheres of any
 * kind have chi below 7/4; beyond, ex itself is interpolated. */
static const double rst_most_chi_of_two_axes = 2;

struct restitute_table {
    int of_contact;
    struct restitute_table_contact own; /* its own contact; of a table of ranges: not used */
    double duration;                    /* T at 1 m/s of the contact, s (22) */
    double poisson_ratio;
    double radius, mass, friction, modulus_factor;
    double equilibrium_modulus, parallel_viscosity;
    int64_t terms;
    double *term; /* times, then moduli; in `block` */

    double tolerance, error_ez, error_ex;
    int64_t impacts, checks;
    double asked[3][2]; /* ranges: speed or delta1, gamma, chi */
    char version[32];

    struct rst_octaves speed, gamma;
    int64_t n_chi;
    double chi_low, chi_high;
    int64_t chi_cells;   /* 0: one node, no axis */
    int64_t stick_cells; /* 0: one node, psi = 0 or no friction */
    int64_t slip_cells;  /* in each half of the slip side; 0: none */
    int64_t n_speed, n_gamma, n_psi;
    int two_axes;        /* speed and psi, which may slip, and no more */
    int64_t start[3];    /* first node of psi in [0, 1], of y in [0, 1/2], of 1 - y in [0, 1/2] */
    struct rst_psi_cells psi_cells[2]; /* stick and slip side */
    double *ez;          /* [speed][gamma] */
    double *ex;          /* [speed][gamma][psi][chi] */

    /* two axes; by powers of the place in [1, 2) of a cell: */
    double (*inverse)[4];  /* [cell of speed]: 1/(1 + ez); powers 0, 2, 1, 3 */
    double (*patch)[4][4]; /* [cell of speed][cell of psi][power for speed][power for psi]: ex less the closed form */
    rst_two low, high;     /* ends of speed, each twice */
    double share, limit;   /* rst_small (2 chi - 1)/square and 4 square of psi_cells[1] */
    int64_t first_cell[3]; /* of psi in [0, 1], of y in [0, 1/2], of 1 - y in [0, 1/2] */
    int64_t cells_of_psi;  /* of all three */

    int64_t
        n_cells; /* > 0: trees; leaves of `tangent`, and n_speed too, while n_gamma are the coefficients of a leaf */
    struct rst_w_axis w;
    struct rst_tree rebound, tangent;
    double (*h)[4];  /* [octave of gamma]: h by powers of the place in it; ez is [leaf of rebound][coefficient] */
    float *ex_cells; /* [leaf of tangent][coefficient] */
    struct rst_serendipity of_ez, of_ex; /* which they are */
    size_t block_size;                   /* doubles in `block` */
    double block[];
};

/* Set up an axis whose cells are the octaves' parts of `low` to `high`, both on seams of 2^-k of an octave. */
void rst_octaves_set(double low, double high, int k, struct rst_octaves *axis);

/* Take numbers beyond `low` and `high`, which lie on the axis, as these. */
void rst_octaves_limit(double low, double high, struct rst_octaves *axis);

/* Node of an axis; 0 <= i <= 3 cells. */
double rst_octaves_node(const struct rst_octaves *axis, int64_t i);

/* r(y) at a node of the lower half of the slip side, and r(1 - y) of the upper one; y from it. */
double rst_slip_node(int64_t cells, int64_t i);
double rst_slip_y(double r);

/* Node of chi; 0 <= i < n_chi. */
double rst_chi_node(const restitute_table *form, int64_t i);

/* Make room for a table whose sizes are set in `form`; NULL: out of memory. */
restitute_table *rst_table_allocate(const restitute_table *form);

/* Set the polynomials of two axes from the values at the nodes. */
void rst_table_set_polynomials(restitute_table *table);

/* h: delta1 h(gamma) = 1/3 is about where ex turns sharply; a power of gamma for small gamma, gamma itself for large.
 * */
double rst_table_h(double gamma);

/* Set the roots so that they hold delta1 in [low, high] for all gamma of the axis. width: log2 of their octaves. */
void rst_w_axis_set(double low, double high, const struct rst_octaves *gamma, int64_t width, struct rst_w_axis *w);

/* What rst_w_place needs of an axis whose roots are set. */
void rst_w_axis_logs(struct rst_w_axis *w);

/* Counts and starts of nodes from the cells. */
void rst_table_count(restitute_table *form);

/* The pair at numbers; `speed` is delta1 in a table of ranges. Outside: the ends. psi in [0, infinity]. */
void rst_table_evaluate(const restitute_table *table, double speed, double gamma, double chi, double psi,
                        restitute_table_value *pair);

/* ez alone. */
double rst_table_rebound(const restitute_table *table, double speed, double gamma);

static inline int64_t rst_bits_of(double number)
{
    int64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

/* Cell and place in it, in [0, 3). */
static inline double rst_octaves_find(const struct rst_octaves *axis, double number, int64_t *cell)
{
    number = rst_clamp(number, axis->low, axis->high); /* NaN as well: the bits of the number are an index */
    const int64_t bits = rst_bits_of(number);
    *cell = (bits >> axis->shift) - axis->first;
    return (double)(bits & axis->mask) * axis->scale;
}

/* Weights of the four nodes s = 0, 1, 2, 3. */
static inline void rst_cubic_weights(double s, double w[4])
{
    const double a = s - 1, b = s - 2, c = s - 3;
    const double ab = s * a, bc = b * c;
    w[0] = a * bc * (-1.0 / 6);
    w[1] = s * bc * 0.5;
    w[2] = ab * c * -0.5;
    w[3] = ab * b * (1.0 / 6);
}

/* rst_roots_begin and the place along the axis, in roots, to the rounding of such a number, 4.5e-13: log2 of a normal
 * number, inline: half as dear as that of libm. The logarithm of the middle of one of 64 parts of [1, 2], and the
 * series of log2(1 + r), |r| <= 1/128, up to r^5. */
static inline double rst_w_place(const struct rst_w_axis *w, double number)
{
    const double *series = w->series;
    const int64_t bits = rst_bits_of(number), fraction = (INT64_C(1) << 52) - 1, part = (bits & fraction) >> 46;
    const double m = rst_tree_number((uint64_t)bits << 12, 0);
    const double r = m * w->inverse[part] - 1, square = r * r;
    const double octaves = (double)(int32_t)((bits >> 52) - 1023) * w->scale - w->begin;
    const double high = (square * r) * ((series[2] + series[3] * r) + series[4] * square);
    return (octaves + w->log[part]) + (r * (series[0] + series[1] * r) + high);
}

/* Places in [0, 1) of an octave of gamma and of a root of w, as rst_tree_bits. */
struct rst_spot {
    int64_t octave, root;
    uint64_t gamma, w;
};

/* h at a place in an octave. */
static inline double rst_h(const double h[4], double x)
{
    return (h[0] + h[1] * x) + (x * x) * (h[2] + h[3] * x);
}

static inline void rst_spot_find(const restitute_table *t, double delta1, double gamma, struct rst_spot *spot)
{
    const int64_t bits = rst_bits_of(rst_clamp(gamma, t->gamma.low, t->gamma.high)); /* NaN as well */
    spot->octave = (bits >> 52) - t->gamma.first;
    spot->gamma = (uint64_t)bits << 12;
    const double h = rst_h(t->h[spot->octave], rst_tree_place(spot->gamma, 0));
    const double u = rst_w_place(&t->w, rst_clamp(delta1, t->speed.low, t->speed.high) * h);
    const uint64_t along = (uint64_t)rst_bits_of(rst_clamp(u, rst_roots_begin, t->w.end)) << 12;
    spot->root = (int64_t)(along >> (64 - rst_bits_of_root));
    spot->w = along << rst_bits_of_root;
}

/* First node of the cell of chi, which is in the table's range, and place s in [0, 3] in it. */
static inline int64_t rst_chi_find(const restitute_table *t, double chi, double *s)
{
    const double u = (chi - t->chi_low) / (t->chi_high - t->chi_low) * (double)t->chi_cells;
    int64_t cell = (int64_t)u;
    cell = cell < t->chi_cells ? cell : t->chi_cells - 1;
    *s = (u - (double)cell) * rst_cubic;
    return cell * rst_cubic;
}

/* c in r(y) */
static const double rst_soft = 1.0 / 64;

/* Smallest divisor: nothing is divided by 0, for programs that trap that. */
static const double rst_least = 0x1p-1000;

/* Cell of psi in begin + u. */
static inline int64_t rst_psi_cell(double u)
{
    return rst_bits_of(u) >> (52 - rst_bits_of_cell) & rst_most_psi_cells;
}

/* First node of the cell, and place s in [0, 3) in it, for psi = sliding/v_n up to psi_c = 1 + width/v_n; quotient:
 * psi, or 1/psi beyond psi = 1; closed: 1 from psi = 1 on, 0 below. Both sides go the same way without a branch, since
 * which one it is cannot be foreseen. */
static inline int64_t rst_psi_find(const restitute_table *t, double sliding, double v_n, double width, double *s,
                                   double *quotient, double *closed)
{
    const int slips = sliding > v_n;
    const struct rst_psi_cells *cells = &t->psi_cells[slips];
    const double y = rst_clamp(sliding - v_n, 0, width) / (width + rst_least);
    const double along = rst_smaller(y, 1) * cells->square[0];
    const double up = cells->soft[0] + along, down = cells->total[0] - along;
    *quotient = rst_smaller(sliding, v_n) / (rst_larger(sliding, v_n) + rst_least);
    const double u = sqrt(rst_smaller(up, down)) + (*quotient * cells->of_psi + cells->begin);
    const int64_t cell = rst_psi_cell(u);
    *s = (u - (rst_cells_begin + (double)cell)) * rst_cubic;
    *closed = cells->closed;
    return t->start[slips + (up > down)] + cell * rst_cubic;
}

/* r(1/2) */
static const double rst_largest_r = 0.6916543936097672;

/* What psi = sliding/v_n exceeds 1 by over what psi_c does without rebound: y (1 + ez), but 4 for all that is more,
 * which is beyond any 1 + ez. All of it can be found while ez is not known yet. */
static inline double rst_slip_beyond(double chi, double sliding, double v_n)
{
    const double share = rst_larger(rst_larger(2 * chi - 1, 0) * rst_small * v_n, rst_least);
    return rst_clamp((sliding - v_n) * rst_small, 0, 4 * share) / share;
}

/* A place on the sheets one after the other is kept as rst_sheets_begin and that: the sheet is then so many of the
 * bits of the fraction. The end is below the number of sheets. */
enum { rst_bits_of_sheet = 3 };
static const double rst_sheets_begin = 8, rst_sheets_end = 5 - 0x1p-48, rst_below_sheet = 1 - 0x1p-48;

/* rst_sheets_begin and 1 to 5: the sheets of the slip side are quarters of r(y), and of r(1 - y) beyond y = 1/2.
 * Little is left to do behind the square root. */
static inline double rst_slip_place(double y)
{
    const double half = 0.5 * rst_slip_sheets, scale = half / rst_largest_r, from_middle = 0.5 - y;
    const double root = sqrt((0.5 + rst_soft * rst_soft) - fabs(from_middle));
    const double start = (rst_sheets_begin + 1 + half) - copysign(half + rst_soft * scale, from_middle);
    const double place = start + copysign(scale, from_middle) * root;
    return rst_clamp(place, rst_sheets_begin + 1, rst_sheets_begin + rst_sheets_end);
}

/* Sheet of a tree and place in [0, 1) on it, as rst_tree_bits; y, and what the kept value is times: 1, and 1/psi beyond
 * psi = 1. */
struct rst_sheet {
    int64_t number;
    uint64_t place;
    double y, quotient;
};

static inline struct rst_sheet rst_sheet_of(double u, double y, double quotient)
{
    const uint64_t bits = (uint64_t)rst_bits_of(u) << 12;
    return (struct rst_sheet){.number = (int64_t)(bits >> (64 - rst_bits_of_sheet)),
                              .place = bits << rst_bits_of_sheet,
                              .y = y,
                              .quotient = quotient};
}

/* For psi = sliding/v_n up to psi_c; beyond: rst_slip_beyond, at most 1 + ez. What follows waits for the place, so a
 * guess of the side is faster than both sides, even if every other one is wrong. */
static inline struct rst_sheet rst_sheet_find(double sliding, double v_n, double beyond, double ez)
{
    if (!(sliding > v_n)) {
        const double psi = sliding / rst_larger(v_n, rst_least);
        return rst_sheet_of(rst_sheets_begin + psi * rst_below_sheet, 0, 1);
    }
    const double y = rst_smaller(beyond / (1 + ez), 1);
    return rst_sheet_of(rst_slip_place(y), y, v_n / sliding);
}

/* The same, to the bit, by both sides and a selection: where many are found one after the other nothing waits, and a
 * wrong guess costs more. */
static inline struct rst_sheet rst_sheet_select(double sliding, double v_n, double beyond, double ez)
{
    const double larger = rst_larger(sliding, rst_larger(v_n, rst_least));
    const double part = rst_if_larger(sliding, v_n, v_n, sliding) / larger; /* 1/psi or psi */
    const double y = rst_smaller(beyond / (1 + ez), 1);
    const double stick = rst_sheets_begin + part * rst_below_sheet;
    return rst_sheet_of(rst_if_larger(sliding, v_n, rst_slip_place(y), stick), y,
                        rst_if_larger(sliding, v_n, part, 1));
}

#endif
