/* A table with axes of delta1 and gamma made by hand: cells that are divided at random, values from functions that every cell holds
 * without error but rounding: of degree four along each axis, with no more products of powers than there are in a cell.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CELLS_H
#define TEST_CELLS_H

#include <stdlib.h>
#include <string.h>

#include <restitute/table.h>

#include "check.h"
#include "random.h"

enum { cells_octaves = 2, cells_roots = 3, cells_sheets = 5 };

/* Leaves as restitute_table_data has them. */
struct cells_leaves {
    int64_t (*leaf)[7];
    int64_t count, room;
};

struct cells {
    restitute_table_data data;
    struct cells_leaves tangent, rebound;
    double *ez;
    float *ex;
};

/* ---- the functions */

/* h at a gamma, by the cubic through four nodes of its octave, which is `start` to 2 start. */
static inline double cells_h(double start, double gamma)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const double node = start * (1 + i / 3.0);
        double weight = 1;
        for (int j = 0; j < 4; j++)
            if (j != i) weight *= (gamma - start * (1 + j / 3.0)) / (start * (i - j) / 3.0);
        sum += weight * pow(node, 0.56) * pow(1 + node, 0.44);
    }
    return sum;
}

/* The octaves are those of 0.25 and 0.5. */
static inline double cells_log_w(double delta1, double gamma)
{
    return log2(delta1 * cells_h(gamma < 0.5 ? 0.25 : 0.5, gamma));
}

/* Of degree four, and two. */
static inline double cells_quartic(double x)
{
    return x * (0.1 + x * (-0.03 + x * (0.01 - 0.004 * x)));
}

static inline double cells_square(double x)
{
    return 0.2 * x - 0.07 * x * x;
}

static inline double cells_ez(double log_w, double gamma)
{
    return 0.5 + 0.3 * cells_quartic(log_w) * (1 - 0.3 * gamma) - 0.7 * (1 + 0.1 * log_w) * cells_quartic(gamma) +
           0.3 * cells_square(log_w) * cells_square(gamma);
}

/* What is kept at psi = 1, and what there is more of, which has no powers. */
static inline double cells_at_one(double log_w, double gamma, double chi)
{
    const double squares[3] = {cells_square(log_w), cells_square(gamma), cells_square(chi)};
    return 0.1 + 0.3 * (1 + gamma) * cells_quartic(log_w) * (1.5 - chi) + 0.4 * cells_quartic(gamma) * chi +
           0.2 * cells_quartic(chi) * (1 - 0.2 * log_w) + 0.5 * squares[0] * squares[1] +
           0.4 * squares[0] * squares[2] * (1 + gamma) - 0.3 * squares[1] * squares[2];
}

static inline double cells_linear(double log_w, double gamma, double chi)
{
    return (1 + 0.2 * log_w) * (1 - 0.5 * gamma) * (0.3 + 0.2 * chi);
}

/* What is kept: on the sheet of psi <= 1 by psi; on the others by t, 0 at psi = 1 and 1 at psi_c. Alike at psi = 1, 0 at psi_c. */
static inline double cells_kept(double log_w, double gamma, double chi, int slips, double x)
{
    const double one = cells_at_one(log_w, gamma, chi), linear = cells_linear(log_w, gamma, chi);
    const double more = linear * x * (1 - x) * (slips ? 0.5 - x * x : 0.3 + 0.4 * x * x) +
                        0.3 * x * (1 - x) * cells_square(log_w) * (1 + gamma);
    return one * (slips ? 1 - x : 1.2 - 0.2 * x) + more;
}

/* t of y: y is divided evenly by r(y) up to 1/2, and by r(1 - y) beyond. */
static inline double cells_t(double y)
{
    const double c = 1.0 / 64, half = sqrt(0.5 + c * c) - c;
    const double r = sqrt(fmin(y, 1 - y) + c * c) - c;
    return y <= 0.5 ? r / (2 * half) : 1 - r / (2 * half);
}

/* What a lookup must give, for numbers in the ranges. */
static inline restitute_table_value cells_pair(double chi, double psi, double delta1, double gamma)
{
    const double log_w = cells_log_w(delta1, gamma), ez = cells_ez(log_w, gamma);
    const double critical = restitute_critical_psi(chi, ez), y = (psi - 1) / (critical - 1);
    restitute_table_value pair = {ez, 0};
    if (psi > critical)
        pair.ex = 2 * chi * (1 + ez) / psi - 1;
    else if (psi > 1)
        pair.ex = (cells_kept(log_w, gamma, chi, 1, cells_t(y)) + y * ez) / psi;
    else
        pair.ex = cells_kept(log_w, gamma, chi, 0, psi);
    return pair;
}

/* ---- the cells */

static inline void cells_add(struct cells_leaves *to, const int64_t leaf[7])
{
    if (to->count == to->room) {
        to->room = 2 * to->room + 64;
        to->leaf = realloc(to->leaf, (size_t)to->room * sizeof *to->leaf);
        assert_non_null(to->leaf);
    }
    memcpy(to->leaf[to->count++], leaf, sizeof *to->leaf);
}

/* Divide a leaf or keep it. leaf[3..6]: depth, path, level, part. */
static inline void cells_grow(struct cells_leaves *to, const int64_t leaf[7], int64_t deepest, uint64_t *state)
{
    const double chance = random_in(state, 0, 1);
    const int along_chain = chance < 0.5 && leaf[3]<deepest, along_gamma = chance> 0.88 && leaf[5] < 4;
    if (!along_chain && !along_gamma) {
        cells_add(to, leaf);
        return;
    }
    for (int64_t side = 0; side < 2; side++) {
        int64_t part[7];
        memcpy(part, leaf, sizeof part);
        part[along_chain ? 3 : 5]++;
        part[along_chain ? 4 : 6] = 2 * part[along_chain ? 4 : 6] + side;
        cells_grow(to, part, deepest, state);
    }
}

static inline void cells_grow_all(struct cells_leaves *to, int64_t sheets, int64_t deepest, uint64_t *state)
{
    for (int64_t i = 0; i < cells_octaves * cells_roots * sheets; i++) {
        const int64_t root[7] = {i / sheets / cells_roots, i / sheets % cells_roots, i % sheets, 0, 0, 0, 0};
        cells_grow(to, root, deepest, state);
    }
}

/* Place in [0, 1] of a node along an axis of the chain. */
static inline double cells_place(const restitute_table_data *d, const int64_t leaf[7], int64_t along, int node)
{
    double width = 1, start = 0;
    for (int64_t i = 0; i < leaf[3]; i++) {
        if ((d ? d->chain[i] : 0) != along) continue;
        width *= 0.5;
        start += width * (double)(leaf[4] >> (leaf[3] - 1 - i) & 1);
    }
    return start + width * node / 4;
}

/* log2 w: two octaves a root, from -2 on. */
static inline double cells_leaf_log_w(const restitute_table_data *d, const int64_t leaf[7], int node)
{
    return 2 * ((double)leaf[1] - 1 + cells_place(d, leaf, 0, node));
}

static inline double cells_leaf_gamma(const int64_t leaf[7], int node)
{
    return 0.25 * (double)(1 << leaf[0]) * (1 + ((double)leaf[6] + node / 4.0) / (double)(1 << leaf[5]));
}

/* What a value at a place exceeds that of lower levels by: weights of the values at u = 0, 1/4, 1/2, 3/4, 1. */
static const double cells_weights[5][5] = {{1, 0, 0, 0, 0},
                                           {-0.375, 1, -0.75, 0, 0.125},
                                           {-0.5, 0, 1, 0, -0.5},
                                           {0.125, 0, -0.75, 1, -0.375},
                                           {0, 0, 0, 0, 1}};

static inline double cells_leaf_ez(const int64_t leaf[7], const int64_t place[4])
{
    double sum = 0;
    for (int i = 0; i < 25; i++) {
        const double weight = cells_weights[place[0]][i / 5] * cells_weights[place[1]][i % 5];
        if (weight != 0) sum += weight * cells_ez(cells_leaf_log_w(NULL, leaf, i / 5), cells_leaf_gamma(leaf, i % 5));
    }
    return sum;
}

static inline double cells_leaf_kept(const restitute_table_data *d, const int64_t leaf[7], const int64_t place[4])
{
    double sum = 0;
    for (int i = 0; i < 625; i++) {
        const int w = i / 125, g = i / 25 % 5, c = i / 5 % 5, p = i % 5;
        const double weight = cells_weights[place[0]][w] * cells_weights[place[1]][g] * cells_weights[place[2]][c] *
                              cells_weights[place[3]][p];
        if (weight == 0) continue;
        const double psi = cells_place(d, leaf, 2, p);
        const double chi = d->chi_low + (d->chi_high - d->chi_low) * cells_place(d, leaf, 1, c);
        sum += weight * cells_kept(cells_leaf_log_w(d, leaf, w), cells_leaf_gamma(leaf, g), chi, leaf[2] > 0,
                                   leaf[2] > 0 ? ((double)(leaf[2] - 1) + psi) / 4 : psi);
    }
    return sum;
}

/* Which functions coefficients belong to is asked of a table that is 0. */
static inline void cells_functions(struct cells *c, int64_t (*place)[4])
{
    restitute_table *table = NULL;
    c->data.ez = c->ez;
    c->data.ex_cells = c->ex;
    assert_int_equal(restitute_table_from_data(&c->data, &table, NULL), RESTITUTE_OK);
    assert_int_equal(restitute_table_cell_functions(table, place), RESTITUTE_OK);
    restitute_table_destroy(table);
}

static inline void cells_fill(struct cells *c, int n_ex)
{
    const restitute_table_data *d = &c->data;
    int64_t place[136][4];
    c->ez = calloc((size_t)c->rebound.count * 17, sizeof *c->ez);
    c->ex = calloc((size_t)(c->tangent.count * n_ex), sizeof *c->ex);
    assert_non_null(c->ez);
    assert_non_null(c->ex);
    cells_functions(c, place);
    for (int64_t i = 0; i < c->rebound.count; i++)
        for (int m = 0, of_ez = 0; m < n_ex; m++)
            if (place[m][2] + place[m][3] == 0) c->ez[17 * i + of_ez++] = cells_leaf_ez(c->rebound.leaf[i], place[m]);
    for (int64_t i = 0; i < c->tangent.count; i++)
        for (int m = 0; m < n_ex; m++)
            c->ex[n_ex * i + m] = (float)cells_leaf_kept(d, c->tangent.leaf[i], place[m]);
}

/* chi from 1 to chi_high; 1: no axis. delta1 in [0.6, 3], gamma in [0.3, 0.9]. */
static inline void cells_make(double chi_high, uint64_t seed, struct cells *c)
{
    static const int64_t chain[10] = {0, 2, 1, 0, 2, 1, 0, 0, 2, 1};
    memset(c, 0, sizeof *c);
    restitute_table_data_init(&c->data);
    restitute_table_data *d = &c->data;
    const double range[3][2] = {{0.6, 3}, {0.3, 0.9}, {1, chi_high}};
    memcpy(d->range, range, sizeof range);
    d->tolerance = 1e-3;
    d->friction = d->radius = d->mass = d->duration = d->poisson_ratio = NAN;
    strcpy(d->version, "0");
    d->low[0] = 0.5, d->high[0] = 4, d->low[1] = 0.25, d->high[1] = 1;
    d->parts[0] = d->parts[1] = 1;
    d->chi_low = 1, d->chi_high = chi_high;
    d->w_width = 1, d->w_first = -1, d->w_roots = cells_roots;
    for (int i = 0; i < 10; i++)
        if (chain[i] != 1 || chi_high > 1) d->chain[d->chain_length++] = chain[i];
    cells_grow_all(&c->tangent, cells_sheets, d->chain_length, &seed);
    cells_grow_all(&c->rebound, 1, 12, &seed);
    d->cells = c->tangent.count;
    d->rebound_cells = c->rebound.count;
    d->leaves = c->tangent.leaf[0];
    d->rebound_leaves = c->rebound.leaf[0];
    cells_fill(c, chi_high > 1 ? 136 : 50);
}

static inline void cells_free(struct cells *c)
{
    free(c->tangent.leaf);
    free(c->rebound.leaf);
    free(c->ez);
    free(c->ex);
}

static inline restitute_table *cells_table(const struct cells *c)
{
    restitute_table *table = NULL;
    restitute_error error;
    CHECK(restitute_table_from_data(&c->data, &table, &error) == RESTITUTE_OK, "%s", error.message);
    return table;
}

#endif
