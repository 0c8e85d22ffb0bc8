/* The places of a table's nodes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table_form.h"

static double place_of_psi(const restitute_table *t, int64_t i)
{
    if (i >= t->start[2]) return 2 - rst_slip_y(rst_slip_node(t->slip_cells, i - t->start[2]));
    if (i >= t->start[1]) return 1 + rst_slip_y(rst_slip_node(t->slip_cells, i - t->start[1]));
    return t->stick_cells ? (double)i / (double)(t->stick_cells * rst_cubic) : 0;
}

static void dense_nodes(const restitute_table *t, int axis, double *place)
{
    const int64_t n[4] = {t->n_speed, t->n_gamma, t->n_chi, t->n_psi};
    for (int64_t i = 0; i < n[axis]; i++)
        place[i] = axis < 2    ? rst_octaves_node(axis ? &t->gamma : &t->speed, i)
                   : axis == 2 ? rst_chi_node(t, i)
                               : place_of_psi(t, i);
}

/* ---- cells of a tree */

/* Place in [0, 1] of a node of a leaf along an axis of the chain: of the root's width, of chi, or of the sheet. */
static double place_in_root(const struct rst_tree *t, const struct rst_leaf *l, enum rst_along along, int node)
{
    int64_t part = 0;
    for (int64_t d = 0; d < l->depth; d++)
        if (t->chain[d] == (int8_t)along) part = 2 * part + (l->path >> (l->depth - 1 - d) & 1);
    return ldexp((double)part + node / 3.0, -t->halvings[along][l->depth]);
}

/* As rst_sheet_find takes it: psi, or 1 + y. */
static double psi_of_sheet(int64_t sheet, double place)
{
    if (sheet == 0) return place;
    const double t = ((double)(sheet - 1) + place) / rst_slip_sheets;
    return t <= 0.5 ? 1 + rst_slip_y(2 * rst_largest_r * t) : 2 - rst_slip_y(2 * rst_largest_r * (1 - t));
}

/* gamma, and h there as a lookup takes it: by the cubic of the octave. */
static double gamma_of_leaf(const restitute_table *t, const struct rst_leaf *l, int node, double *h)
{
    double w[4];
    const double start = rst_octaves_node(&t->gamma, l->octave * rst_cubic);
    const double u = ldexp((double)l->part + node / 3.0, -(int)l->level), *along = t->along + l->octave * rst_cubic;
    rst_cubic_weights(rst_cubic * u, w);
    *h = (w[0] * along[0] + w[1] * along[1]) + (w[2] * along[2] + w[3] * along[3]);
    return start * (1 + u);
}

static double delta1_of_leaf(const restitute_table *t, const struct rst_leaf *l, int node, double h)
{
    const double u = (double)(t->w.first + l->root) + place_in_root(&t->tangent, l, RST_ALONG_W, node);
    return exp2(u / t->w.scale) / h;
}

static double *leaf_nodes(const restitute_table *t, const struct rst_leaf *l, int axis, double *place)
{
    double h;
    for (int m = 0; axis < 2 && m < rst_cell_nodes; m++) {
        const double gamma = gamma_of_leaf(t, l, m % 4, &h);
        *place++ = axis ? gamma : delta1_of_leaf(t, l, m / 4, h);
    }
    for (int m = 0; axis == 2 && m < t->n_chi; m++)
        *place++ = t->n_chi == 1
                       ? t->chi_low
                       : t->chi_low + (t->chi_high - t->chi_low) * place_in_root(&t->tangent, l, RST_ALONG_CHI, m);
    for (int m = 0; axis == 3 && m < t->n_psi; m++)
        *place++ = psi_of_sheet(l->sheet, place_in_root(&t->tangent, l, RST_ALONG_PSI, m));
    return place;
}

int restitute_table_nodes(const restitute_table *table, int axis, double *places)
{
    if (!table || !places) return RESTITUTE_ERROR_NULL;
    if (axis < 0 || axis > 3) return RESTITUTE_ERROR_DOMAIN;
    if (table->n_cells == 0) dense_nodes(table, axis, places);
    for (int64_t cell = 0; cell < table->n_cells; cell++)
        places = leaf_nodes(table, &table->tangent.leaf[cell], axis, places);
    return RESTITUTE_OK;
}
