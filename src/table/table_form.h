/* The inside of a table: how it is laid out, and how a place in it is found.
 *
 * Values are kept at nodes. Along the speed (or delta1) and along gamma an octave of the number is divided into 2^k equal cells,
 * each with a cubic through four nodes that are evenly spaced. So cell and place in the cell are the leading and the other bits of
 * the number itself, and no logarithm is taken. Along psi: even cells from 0 to 1, then for
 * y = (psi - 1)/(psi_c - 1) even cells of r(y) up to y = 1/2 and of r(1 - y) beyond, r(y) = sqrt(y + c^2) - c, which are dense at both
 * ends (THEORY 9: there ex has singular curvature; c keeps slopes finite); each has a cubic as well; so have even cells of chi. Cells share the nodes at their seams.
 *
 * A table with axes of delta1 and of gamma is divided further where it needs it: ex has lines across which a higher derivative jumps,
 * oblique in (delta1, gamma) and elsewhere for every psi and chi. A patch is one octave of each; it has 2^k cells along delta1 and
 * 2^l along gamma, with k and l of its own. A cell keeps all of its 4 x 4 nodes side by side, in single precision for ex: a lookup then
 * reads runs of memory. Where a patch meets one of fewer cells, its nodes are put on the polynomials of that one.
 *
 * For psi <= 1 ex itself is kept, beyond it what it exceeds the closed form of full slip by (27): 0 at psi_c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_FORM_H
#define RST_TABLE_FORM_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include <restitute/table.h>

enum {
    rst_cubic = 3, /* degree along all axes */
    rst_most_chi = 33,
    rst_cell_nodes = 16,
    rst_finest_patch = 5 /* largest k and l of a patch */
};

/* One octave of delta1 and of gamma. */
struct rst_patch {
    int64_t first; /* its first cell; along gamma they follow each other */
    int64_t k[2];
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
    int two_axes;        /* speed and psi, and no more */
    int64_t start[3];    /* first node of psi in [0, 1], of y in [0, 1/2], of 1 - y in [0, 1/2] */
    double psi_cells[2]; /* cells over the length of psi in [0, 1], of r in [0, r(1/2)]; next below that */
    double *ez;          /* [speed][gamma] */
    double *ex;          /* [speed][gamma][psi][chi] */

    int64_t
        n_cells; /* > 0: patches; then speed and gamma have octaves, n_speed is n_cells, n_gamma the nodes of a cell */
    struct rst_patch *patch; /* [octave of delta1][octave of gamma] */
    float *ex_cells;         /* [cell][psi][chi][node]; ez is [cell][node] */
    size_t block_size;       /* doubles in `block` */
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

/* Number the cells of the patches, one after the other; how many there are. */
int64_t rst_patches_number(struct rst_patch *patch, int64_t count);

/* Number at a node of a patch whose octave along the axis is `octave`; 0 <= i <= 3 2^k. */
double rst_patch_node(const struct rst_octaves *axis, int64_t octave, int64_t k, int64_t i);

/* Counts and starts of nodes from the cells. */
void rst_table_count(restitute_table *form);

/* The pair at numbers; `speed` is delta1 in a table of ranges. Outside: the ends. psi in [0, infinity]. */
void rst_table_evaluate(const restitute_table *table, double speed, double gamma, double chi, double psi,
                        restitute_table_value *pair);

/* ez alone. */
double rst_table_rebound(const restitute_table *table, double speed, double gamma);

/* Cell and place in it, in [0, 3). */
static inline double rst_octaves_find(const struct rst_octaves *axis, double number, int64_t *cell)
{
    number = !(number > axis->low) ? axis->low : number; /* NaN as well: the bits of the number are an index */
    number = number > axis->high ? axis->high : number;
    int64_t bits;
    memcpy(&bits, &number, sizeof bits);
    *cell = (bits >> axis->shift) - axis->first;
    return (double)(bits & axis->mask) * axis->scale;
}

/* Cell of a table of patches, and places in [0, 3] in it. */
static inline int64_t rst_cell_find(const restitute_table *t, double speed, double gamma, double s[2])
{
    int64_t i, j;
    const double x = rst_octaves_find(&t->speed, speed, &i), y = rst_octaves_find(&t->gamma, gamma, &j);
    const struct rst_patch *p = &t->patch[i * t->gamma.cells + j];
    const double u = x * (double)(INT64_C(1) << p->k[0]), v = y * (double)(INT64_C(1) << p->k[1]);
    const int64_t a = (int64_t)(u * (1.0 / rst_cubic)), b = (int64_t)(v * (1.0 / rst_cubic));
    s[0] = u - (double)(a * rst_cubic);
    s[1] = v - (double)(b * rst_cubic);
    return p->first + (a << p->k[1]) + b;
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

/* First node of the cell, and place s in [0, 3] in it, for psi = sliding/v_n up to psi_c = 1 + width. Both sides go the same way
 * without a branch, since which one it is cannot be foreseen. `quotient`: psi, or 1/psi for psi > 1. */
static inline int64_t rst_psi_find(const restitute_table *t, double sliding, double v_n, double width, double *s,
                                   double *quotient)
{
    const int slips = sliding > v_n;
    const double beyond = sliding - v_n, most = width * v_n;
    const double ratio = (beyond > 0 ? beyond : 0) / (most > rst_least ? most : rst_least);
    const double y = ratio < 1 ? ratio : 1, other = 1 - y;
    const double root = sqrt((other < y ? other : y) + rst_soft * rst_soft) - rst_soft;
    const double larger = slips ? sliding : v_n, smaller = slips ? v_n : sliding;
    *quotient = smaller / (larger > rst_least ? larger : rst_least);
    /* below the number of cells even at their end */
    const double u = root * (slips * t->psi_cells[1]) + *quotient * ((1 - slips) * t->psi_cells[0]);
    const int64_t cell = (int64_t)u;
    *s = (u - (double)cell) * rst_cubic;
    return t->start[slips + (slips & (other < y))] + cell * rst_cubic;
}

#endif
