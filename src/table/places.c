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

int restitute_table_nodes(const restitute_table *table, int axis, double *places)
{
    if (!table || !places) return RESTITUTE_ERROR_NULL;
    if (axis < 0 || axis > 3 || table->n_cells > 0) return RESTITUTE_ERROR_DOMAIN;
    dense_nodes(table, axis, places);
    return RESTITUTE_OK;
}

/* ---- cells of a tree */

/* Place in [0, 1] of a node of a leaf along an axis of the chain: of the root's width, of chi, or of the sheet. */
static double place_in_root(const struct rst_tree *t, const struct rst_leaf *l, enum rst_along along, int place)
{
    int64_t part = 0;
    for (int64_t d = 0; d < l->depth; d++)
        if (t->chain[d] == (int8_t)along) part = 2 * part + (l->path >> (l->depth - 1 - d) & 1);
    return ldexp((double)part + 0.25 * place, -t->halvings[l->depth][along]);
}

/* psi, or 1 + y. */
static double psi_of_sheet(int64_t sheet, double place)
{
    if (sheet == 0) return place;
    const double t = ((double)(sheet - 1) + place) / rst_slip_sheets;
    return t <= 0.5 ? 1 + rst_slip_y(2 * rst_largest_r * t) : 2 - rst_slip_y(2 * rst_largest_r * (1 - t));
}

/* gamma, and h there as a lookup takes it: by the cubic of the octave. */
static double gamma_of_leaf(const restitute_table *t, const struct rst_leaf *l, int place, double *h)
{
    const double start = rst_octaves_node(&t->gamma, l->octave * rst_cubic);
    const double u = ldexp((double)l->part + 0.25 * place, -(int)l->level);
    *h = rst_h(t->h[l->octave], u);
    return start * (1 + u);
}

static double delta1_of_leaf(const restitute_table *t, const struct rst_leaf *l, int place, double h)
{
    const double u = (double)(t->w.first + l->root) + place_in_root(&t->tangent, l, RST_ALONG_W, place);
    return exp2(u / t->w.scale) / h;
}

/* What the polynomial of a leaf is at a node, times psi beyond psi = 1. */
static double kept_at(const restitute_table *t, int64_t leaf, const int8_t at[rst_cell_axes])
{
    double coefficient[rst_most_functions], u[rst_cell_axes];
    for (int64_t n = 0; n < t->of_ex.count; n++)
        coefficient[n] = (double)t->ex_cells[leaf * t->of_ex.count + n];
    for (int a = 0; a < rst_cell_axes; a++)
        u[a] = 0.25 * at[a];
    return rst_serendipity_sum(&t->of_ex, coefficient, u);
}

int restitute_table_cell_nodes(const restitute_table *table, int64_t cell, double (*nodes)[6])
{
    if (!table || !nodes) return RESTITUTE_ERROR_NULL;
    if (cell < 0 || cell >= table->n_cells) return RESTITUTE_ERROR_DOMAIN;
    const struct rst_leaf *l = &table->tangent.leaf[cell];
    for (int64_t n = 0; n < table->of_ex.count; n++) {
        const int8_t *at = table->of_ex.at[n];
        double h;
        const double gamma = gamma_of_leaf(table, l, at[RST_G], &h), delta1 = delta1_of_leaf(table, l, at[RST_W], h);
        const double part = table->n_chi > 1 ? place_in_root(&table->tangent, l, RST_ALONG_CHI, at[RST_C]) : 0;
        const double chi = table->chi_low + (table->chi_high - table->chi_low) * part;
        const double ez = rst_table_rebound(table, delta1, gamma);
        const double place = psi_of_sheet(l->sheet, place_in_root(&table->tangent, l, RST_ALONG_PSI, at[RST_P]));
        const double y = l->sheet > 0 ? place - 1 : 0;
        const double psi = l->sheet > 0 ? 1 + y * (restitute_critical_psi(chi, ez) - 1) : place;
        const double ex = (kept_at(table, cell, at) + y * ez) / fmax(1, psi);
        memcpy(nodes[n], (double[6]){delta1, gamma, chi, psi, ez, fmin(1, fmax(-1, ex))}, sizeof nodes[n]);
    }
    return RESTITUTE_OK;
}

int restitute_table_cell_functions(const restitute_table *table, int64_t (*places)[4])
{
    if (!table || !places) return RESTITUTE_ERROR_NULL;
    if (table->n_cells == 0) return RESTITUTE_ERROR_DOMAIN;
    for (int64_t n = 0; n < table->of_ex.count; n++)
        for (int a = 0; a < rst_cell_axes; a++)
            places[n][a] = table->of_ex.at[n][a];
    return RESTITUTE_OK;
}
