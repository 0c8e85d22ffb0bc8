/* From columns to a table of patches (grid.h): the polynomials of every column are taken at the table's nodes of psi and chi, whose cells
 * are as many as the columns need; then cells of delta1 and gamma collect the columns at their nodes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "grid.h"
#include "interpolation.h"

/* Part of the tolerance that cells of psi or chi may cost, and the most of them. */
static const double part_for_cells = 0.4;
enum { most_cells = 24, most_nodes = most_cells * rst_cubic + 1, most_column_points = 65 };

/* Nodes of cells, and the middles between them, as places in [0, 1] of the Chebyshev points. */
struct places {
    int64_t nodes;
    double node[most_nodes], middle[most_nodes];
};

/* Half of the slip side, towards y = 0 or, turned, towards y = 1. */
enum side { CHI_SIDE, STICK_SIDE, SLIP_SIDE, TURNED_SIDE };

static double place_of(enum side side, int64_t cells, double i)
{
    if (side < SLIP_SIDE) return i / (double)(cells * rst_cubic);
    return rst_t_of_root(i * rst_slip_node(cells, 1), side == TURNED_SIDE);
}

static void set_places(enum side side, int64_t cells, struct places *p)
{
    p->nodes = cells * rst_cubic + 1;
    for (int64_t i = 0; i < p->nodes; i++) {
        p->node[i] = place_of(side, cells, (double)i);
        if (i + 1 < p->nodes) p->middle[i] = place_of(side, cells, (double)i + 0.5);
    }
}

/* Rows from n points to what the cubics of the cells miss in the middles. */
static int difference_rows(const struct places *p, int64_t n, double **rows)
{
    const int64_t m = p->nodes - 1;
    double *row = malloc((size_t)((p->nodes + m) * n) * sizeof *row), *at_nodes = row ? row + m * n : NULL;
    *rows = row;
    if (!row) return 1;
    rst_table_weights(n, m, p->middle, row);
    rst_table_weights(n, p->nodes, p->node, at_nodes);
    for (int64_t i = 0; i < m; i++) {
        double w[4];
        rst_cubic_weights((double)(i % rst_cubic) + 0.5, w);
        for (int64_t j = 0; j < n; j++)
            for (int l = 0; l < 4; l++)
                row[i * n + j] -= w[l] * at_nodes[(i / rst_cubic * rst_cubic + l) * n + j];
    }
    return 0;
}

/* Largest value of rows applied along one direction of an array. */
static double largest(int64_t before, int64_t n, int64_t after, const double *value, int64_t m, const double *row)
{
    double most = 0;
    for (int64_t h = 0; h < before; h++)
        for (int64_t i = 0; i < m; i++)
            for (int64_t k = 0; k < after; k++) {
                double sum = 0;
                for (int64_t j = 0; j < n; j++)
                    sum += row[i * n + j] * value[(h * n + j) * after + k];
                most = fmax(most, fabs(sum));
            }
    return most;
}

static double column_error(const struct rst_column *c, enum side side, int64_t m, const double *row)
{
    const double *slip = c->value + c->n[RST_BY_CHI] * c->n[RST_BY_STICK];
    const int64_t n = c->n[RST_BY_CHI];
    if (side == STICK_SIDE) return largest(n, c->n[RST_BY_STICK], 1, c->value, m, row);
    if (side != CHI_SIDE) return largest(n, c->n[RST_BY_SLIP], 1, slip, m, row);
    const double stick = largest(1, n, c->n[RST_BY_STICK], c->value, m, row);
    return c->n[RST_BY_SLIP] > 0 ? fmax(stick, largest(1, n, c->n[RST_BY_SLIP], slip, m, row)) : stick;
}

/* Raise the number of cells until it does for all columns, of n points. Those that a smaller number did for are not asked again. */
static int raise_cells(const struct rst_grid *g, enum side side, int64_t n, double tolerance, int64_t *cells)
{
    const int direction = side < SLIP_SIDE ? (int)side : RST_BY_SLIP;
    struct places p;
    double *row = NULL;
    for (int64_t i = 0; i < g->columns; i++) {
        if (g->column[i].n[direction] != n) continue;
        for (;;) {
            if (!row) {
                set_places(side, *cells, &p);
                if (difference_rows(&p, n, &row)) return 1;
            }
            if (*cells == most_cells || column_error(&g->column[i], side, p.nodes - 1, row) <= tolerance) break;
            free(row);
            row = NULL;
            *cells += 1;
        }
    }
    free(row);
    return 0;
}

static int choose_cells(const struct restitute_table_builder *b, enum side side, int64_t *cells)
{
    const double tolerance = part_for_cells * b->options.tolerance;
    *cells = 1;
    for (int64_t n = 2; n <= most_column_points; n++)
        if (raise_cells(b->grid, side, n, tolerance, cells) ||
            (side == SLIP_SIDE && raise_cells(b->grid, TURNED_SIDE, n, tolerance, cells)))
            return 1;
    return 0;
}

/* ---- columns at the nodes of psi and chi */

/* [psi][chi] of all columns. */
static double *spread(const struct rst_grid *g, const restitute_table *t)
{
    const int64_t inner = t->n_psi * t->n_chi;
    double *all = malloc((size_t)(g->columns * inner) * sizeof *all);
    double *by_chi = malloc((size_t)(t->n_psi * most_nodes) * sizeof *by_chi);
    double row[most_column_points * most_nodes], over_psi[most_column_points * 4 * most_nodes];
    struct places p;
    for (int64_t i = 0; i < g->columns && all && by_chi; i++) {
        const struct rst_column *c = &g->column[i];
        const int64_t n = c->n[RST_BY_CHI];
        const double *value = c->value;
        /* [chi][psi], then [psi][chi] */
        for (int side = STICK_SIDE; side <= TURNED_SIDE; side++) {
            const int64_t points = c->n[side == STICK_SIDE ? RST_BY_STICK : RST_BY_SLIP];
            if (points == 0) break;
            if (side == SLIP_SIDE) value += n * c->n[RST_BY_STICK];
            set_places((enum side)side, side == STICK_SIDE ? t->stick_cells : t->slip_cells, &p);
            rst_table_weights(points, p.nodes, p.node, row);
            for (int64_t k = 0; k < n; k++)
                rst_table_along(1, points, p.nodes, 1, row, value + k * points,
                                over_psi + k * t->n_psi + t->start[side - STICK_SIDE]);
        }
        for (int64_t k = 0; k < n; k++)
            for (int64_t j = 0; j < t->n_psi; j++)
                by_chi[j * n + k] = over_psi[k * t->n_psi + j];
        p.nodes = 1;
        p.node[0] = 0;
        if (t->n_chi > 1) set_places(CHI_SIDE, t->chi_cells, &p);
        rst_table_weights(n, p.nodes, p.node, row);
        rst_table_along(1, n, t->n_chi, t->n_psi, row, by_chi, all + i * inner);
    }
    if (!by_chi) {
        free(all);
        all = NULL;
    }
    free(by_chi);
    return all;
}

/* ---- cells */

/* Values of a node: those of its column, or, on the edge of a patch of fewer cells, those that its cubic has there. */
struct node {
    double ez;
    const double *value; /* [psi][chi]; of a column, or `own` */
    double *own;
};

static void take_node(const struct rst_grid *g, const double *all, int64_t inner, int64_t p, const int64_t i[2],
                      struct node *node)
{
    const int64_t octave[2] = {p / g->axis[1].cells, p % g->axis[1].cells}, *k = g->region[p].k;
    int64_t at[2] = {rst_grid_at(octave[0], k[0], i[0]), rst_grid_at(octave[1], k[1], i[1])};
    int along;
    const int64_t other = rst_grid_coarser(g, p, i, &along);
    if (other < 0) {
        const struct rst_column *c = rst_grid_column(g, at[0], at[1]);
        node->ez = c->ez;
        node->value = all + (c - g->column) * inner;
        return;
    }
    const int64_t coarse = g->region[other].k[along], cells = INT64_C(1) << coarse;
    const double u = (double)i[along] / (double)(INT64_C(1) << (k[along] - coarse));
    int64_t cell = (int64_t)(u / rst_cubic);
    if (cell == cells) cell--;
    double w[4];
    rst_cubic_weights(u - (double)(cell * rst_cubic), w);
    node->ez = 0;
    node->value = node->own;
    for (int64_t j = 0; j < inner; j++)
        node->own[j] = 0;
    for (int64_t l = 0; l < 4; l++) {
        at[along] = rst_grid_at(octave[along], coarse, cell * rst_cubic + l);
        const struct rst_column *c = rst_grid_column(g, at[0], at[1]);
        const double *value = all + (c - g->column) * inner;
        node->ez += w[l] * c->ez;
        for (int64_t j = 0; j < inner; j++)
            node->own[j] += w[l] * value[j];
    }
}

static void fill_cell(const struct rst_grid *g, const double *all, double *scratch, int64_t p, int64_t i, int64_t j,
                      restitute_table *t)
{
    const int64_t inner = t->n_psi * t->n_chi;
    const int64_t cell = t->patch[p].first + (i << t->patch[p].k[1]) + j;
    for (int m = 0; m < rst_cell_nodes; m++) {
        const int64_t at[2] = {i * rst_cubic + m / 4, j * rst_cubic + m % 4};
        struct node node = {.own = scratch};
        take_node(g, all, inner, p, at, &node);
        t->ez[cell * rst_cell_nodes + m] = node.ez;
        for (int64_t l = 0; l < inner; l++)
            t->ex_cells[(cell * inner + l) * rst_cell_nodes + m] = (float)node.value[l];
    }
}

static int fill(const struct rst_grid *g, restitute_table *t)
{
    double *all = spread(g, t), *scratch = malloc((size_t)(t->n_psi * t->n_chi) * sizeof *scratch);
    for (int64_t p = 0; p < g->regions && all && scratch; p++)
        for (int64_t i = 0; i < INT64_C(1) << t->patch[p].k[0]; i++)
            for (int64_t j = 0; j < INT64_C(1) << t->patch[p].k[1]; j++)
                fill_cell(g, all, scratch, p, i, j, t);
    const int failed = !all || !scratch;
    free(all);
    free(scratch);
    return failed;
}

int rst_patches_make(struct restitute_table_builder *b, restitute_table **table)
{
    const struct rst_grid *g = b->grid;
    restitute_table form;
    rst_family_describe(&b->family, &form);
    form.speed = g->axis[0];
    form.gamma = g->axis[1];
    form.chi_low = rst_builder_number(b, RST_CHI, 0);
    form.chi_high = rst_builder_number(b, RST_CHI, 1);
    if ((b->active[RST_CHI] && choose_cells(b, CHI_SIDE, &form.chi_cells)) ||
        choose_cells(b, STICK_SIDE, &form.stick_cells) ||
        (b->active[RST_SLIP] && choose_cells(b, SLIP_SIDE, &form.slip_cells)))
        return 1;
    struct rst_patch *patch = calloc((size_t)g->regions, sizeof *patch);
    if (!patch) return 1;
    for (int64_t p = 0; p < g->regions; p++)
        memcpy(patch[p].k, g->region[p].k, sizeof patch[p].k);
    form.n_cells = rst_patches_number(patch, g->regions);
    rst_table_count(&form);
    restitute_table *t = rst_table_allocate(&form);
    if (t) memcpy(t->patch, patch, (size_t)g->regions * sizeof *patch);
    free(patch);
    if (!t) return 1;
    if (fill(g, t)) {
        restitute_table_destroy(t);
        return 1;
    }
    *table = t;
    return 0;
}
