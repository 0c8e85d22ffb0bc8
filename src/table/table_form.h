/* The inside of a table: how it is laid out, and how a place in it is found.
 *
 * Values are kept at nodes. Along the speed (or delta1) and along gamma an octave of the number is divided into 2^k equal cells,
 * each with a cubic through four nodes that are evenly spaced. So cell and place in the cell are the leading and the other bits of
 * the number itself, and no logarithm is taken. Along chi there is one polynomial. Along psi: even cells from 0 to 1, then for
 * y = (psi - 1)/(psi_c - 1) cells that get narrower by halves towards both ends (THEORY 9: there ex has singular curvature);
 * each has a polynomial of fifth degree. Cells share the nodes at their seams.
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
    rst_cubic = 3,  /* degree along speed and gamma */
    rst_quintic = 5, /* degree along psi */
    rst_most_chi = 33
};

/* An axis by octaves. */
struct rst_octaves {
    double low, high; /* numbers beyond are taken as these: the first node, and the number next below the last node */
    int64_t first;    /* leading bits of `low` */
    int64_t cells;    /* 0: one node, no axis */
    int shift;        /* how many bits are not leading */
    double scale;     /* 2^-shift */
};

/* The slip side of psi: cells between 2^-octaves and 1/2, for y and for 1 - y. */
struct rst_slip_cells {
    int64_t octaves;   /* 0: none */
    double end, stretch; /* 2^-octaves, 1 - 2 end */
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
    double chi[rst_most_chi], chi_weight[rst_most_chi]; /* nodes, barycentric weights */
    int64_t stick_cells;                                /* 0: one node, psi = 0 or no friction */
    struct rst_slip_cells slip;
    int64_t n_speed, n_gamma, n_psi;
    int64_t slip_start, turned_start; /* first node of y in [0, 1/2], of 1 - y */
    double *ez;                       /* [speed][gamma] */
    double *ex;                       /* [speed][gamma][psi][chi] */
    size_t block_size;                /* doubles in `block` */
    double block[];
};

/* Set up an axis whose cells are the octaves' parts of `low` to `high`, both on seams of 2^-k of an octave. */
void rst_octaves_set(double low, double high, int k, struct rst_octaves *axis);

/* Node of an axis; 0 <= i <= 3 cells. */
double rst_octaves_node(const struct rst_octaves *axis, int64_t i);

/* y at a node of the slip side, counted from its first. */
double rst_slip_node(const struct rst_slip_cells *cells, int64_t i);

/* Barycentric weights 1/prod(chi_j - chi_i) of the nodes in `form`. */
void rst_table_chi_weights(restitute_table *form);

/* Make room for a table whose sizes are set in `form`; NULL: out of memory. */
restitute_table *rst_table_allocate(const restitute_table *form);

/* Counts and starts of nodes from the cells. */
void rst_table_count(restitute_table *form);

/* The pair at numbers; `speed` is delta1 in a table of ranges. Outside: the ends. psi in [0, infinity]. */
void rst_table_evaluate(const restitute_table *table, double speed, double gamma, double chi, double psi,
                        restitute_table_value *pair);

/* ez alone. */
double rst_table_rebound(const restitute_table *table, double speed, double gamma);

/* Cell and place in it, in [0, 1). */
static inline double rst_octaves_find(const struct rst_octaves *axis, double number, int64_t *cell)
{
    number = number < axis->low ? axis->low : number;
    number = number > axis->high ? axis->high : number;
    int64_t bits;
    memcpy(&bits, &number, sizeof bits);
    *cell = (bits >> axis->shift) - axis->first;
    return (double)(bits & ((INT64_C(1) << axis->shift) - 1)) * axis->scale;
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

/* Weights of the six nodes s = 0..5. */
static inline void rst_quintic_weights(double s, double w[6])
{
    const double a = s - 1, b = s - 2, c = s - 3, d = s - 4, e = s - 5;
    const double sa = s * a, bc = b * c, de = d * e, sab = sa * b, cde = c * de;
    w[0] = a * bc * de * (-1.0 / 120);
    w[1] = s * bc * de * (1.0 / 24);
    w[2] = sa * cde * (-1.0 / 12);
    w[3] = sab * de * (1.0 / 12);
    w[4] = sab * c * e * (-1.0 / 24);
    w[5] = sab * c * d * (1.0 / 120);
}

/* Cell of psi on the stick side, or of y on the slip side: its first node, and the place s in [0, 5]. */
static inline int64_t rst_stick_find(const restitute_table *t, double psi, double *s)
{
    const double u = psi * (double)t->stick_cells;
    int64_t cell = (int64_t)u;
    if (cell >= t->stick_cells) cell = t->stick_cells - 1;
    *s = (u - (double)cell) * rst_quintic;
    return cell * rst_quintic;
}

static inline int64_t rst_slip_find(const restitute_table *t, double y, double *s)
{
    const int turned = y > 0.5;
    const double u = turned ? 1 - y : y;
    double number = t->slip.end + u * t->slip.stretch;
    const double last = 0.49999999999999994; /* next below 1/2 */
    if (number > last) number = last;
    int64_t bits;
    memcpy(&bits, &number, sizeof bits);
    const int64_t cell = (bits >> 52) - (1023 - t->slip.octaves);
    *s = (double)(bits & ((INT64_C(1) << 52) - 1)) * (0x1p-52 * rst_quintic);
    return (turned ? t->turned_start : t->slip_start) + cell * rst_quintic;
}

#endif
