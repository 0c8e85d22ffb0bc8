/* A table with axes of delta1 and gamma made by hand: cells that are divided at random, values from functions that are cubic along all
 * axes of the cells, so that every cell holds them without error but rounding.
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

static inline double cells_ez(double log_w, double gamma)
{
    const double a = 0.3 + log_w * (0.1 + log_w * (-0.03 + 0.01 * log_w));
    return 0.8 - 0.3 * a * (1 + gamma * (0.5 - 0.4 * gamma * gamma));
}

/* What is kept: on the sheet of psi <= 1 by psi; on the others by t, 0 at psi = 1 and 1 at psi_c. Alike at psi = 1, 0 at psi_c. */
static inline double cells_kept(double log_w, double gamma, double chi, int slips, double place)
{
    const double a = 0.5 + log_w * (0.1 + log_w * (-0.03 + 0.01 * log_w)), b = 1 - gamma * (0.5 - 0.3 * gamma * gamma);
    const double c = 0.8 + 0.2 * chi - 0.1 * chi * chi * chi, x = place;
    return 0.5 * a * b * c * (slips ? 0.9 * (1 - x) * (1 + x * (0.5 - x)) : 1 - x * (0.6 - 0.5 * x * x));
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
    return start + width * node / 3;
}

/* log2 w: two octaves a root, from -2 on. */
static inline double cells_leaf_log_w(const restitute_table_data *d, const int64_t leaf[7], int node)
{
    return 2 * ((double)leaf[1] - 1 + cells_place(d, leaf, 0, node));
}

static inline double cells_leaf_gamma(const int64_t leaf[7], int node)
{
    return 0.25 * (double)(1 << leaf[0]) * (1 + ((double)leaf[6] + node / 3.0) / (double)(1 << leaf[5]));
}

static inline void cells_fill(struct cells *c, int n_chi)
{
    const restitute_table_data *d = &c->data;
    c->ez = malloc((size_t)c->rebound.count * 16 * sizeof *c->ez);
    c->ex = malloc((size_t)(c->tangent.count * 4 * n_chi) * 16 * sizeof *c->ex);
    assert_non_null(c->ez);
    assert_non_null(c->ex);
    double *ez = c->ez;
    float *ex = c->ex;
    for (int64_t i = 0; i < c->rebound.count; i++)
        for (int m = 0; m < 16; m++)
            *ez++ = cells_ez(cells_leaf_log_w(NULL, c->rebound.leaf[i], m / 4),
                             cells_leaf_gamma(c->rebound.leaf[i], m % 4));
    for (int64_t i = 0; i < c->tangent.count; i++)
        for (int k = 0; k < 4; k++)
            for (int l = 0; l < n_chi; l++)
                for (int m = 0; m < 16; m++) {
                    const int64_t *leaf = c->tangent.leaf[i];
                    const double psi = cells_place(d, leaf, 2, k), chi = cells_place(d, leaf, 1, l);
                    const double place = leaf[2] > 0 ? ((double)(leaf[2] - 1) + psi) / 4 : psi;
                    *ex++ = (float)cells_kept(cells_leaf_log_w(d, leaf, m / 4), cells_leaf_gamma(leaf, m % 4),
                                              d->chi_low + (d->chi_high - d->chi_low) * chi, leaf[2] > 0, place);
                }
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
    cells_fill(c, chi_high > 1 ? 4 : 1);
    d->ez = c->ez;
    d->ex_cells = c->ex;
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
