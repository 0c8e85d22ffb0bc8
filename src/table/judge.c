/* Which impacts a cell needs, and what they say of its polynomial (cells.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cells.h"

/* The same for the same cell, as if it were by chance. */
static uint64_t chance(int64_t cell, int axis, int n)
{
    uint64_t h = ((uint64_t)cell * 128 + (uint64_t)(axis * 16 + n) + 1) * UINT64_C(0x9e3779b97f4a7c15);
    h ^= h >> 31;
    h *= UINT64_C(0xbf58476d1ce4e5b9);
    return h >> 24;
}

static struct rst_spot_on_lattice node_at(const struct rst_spot_on_lattice *corner, const int32_t step[rst_cell_axes],
                                          const int8_t at[rst_cell_axes])
{
    struct rst_spot_on_lattice spot;
    for (int a = 0; a < rst_cell_axes; a++)
        spot.at[a] = corner->at[a] + at[a] * step[a];
    return spot;
}

/* On an edge of the cell along an axis, half way between two nodes, where its halves have nodes; for rst_cell_axes in
 * place of an axis inside, at eighths, where the products of high powers are that the polynomial lacks. */
static struct rst_spot_on_lattice place_to_compare(const struct rst_spot_on_lattice *corner,
                                                   const int32_t step[rst_cell_axes], int64_t cell, int axis, int n)
{
    uint64_t bits = chance(cell, axis, n);
    struct rst_spot_on_lattice spot;
    for (int a = 0; a < rst_cell_axes; a++, bits >>= 8) {
        const int edge = a == axis ? 2 * (n % rst_quarters) + 1 : 2 * rst_quarters * (int)(bits & 1);
        const int eighths = axis == rst_cell_axes ? 1 + (int)(bits % 7) : edge;
        spot.at[a] = corner->at[a] + eighths * (step[a] / 2);
    }
    return spot;
}

static int places_along(const struct rst_growth *g, int axis)
{
    return axis == rst_cell_axes ? g->places_inside : g->active[axis] ? g->places_an_axis : 0;
}

static int need_places(struct rst_growth *g, int64_t cell)
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    rst_cell_place(g, &g->cell[cell].at, &corner, step);
    for (int64_t n = 0; n < g->of_cell.count; n++)
        if (rst_nodes_need(&g->nodes, node_at(&corner, step, g->of_cell.at[n])) < 0) return 1;
    for (int axis = 0; axis <= rst_cell_axes; axis++)
        for (int n = 0; n < places_along(g, axis); n++)
            if (rst_nodes_need(&g->nodes, place_to_compare(&corner, step, cell, axis, n)) < 0) return 1;
    return 0;
}

int rst_growth_need(struct rst_growth *g)
{
    for (int64_t k = 0; k < g->count; k++)
        if (g->cell[k].state == RST_TO_JUDGE && need_places(g, k)) return 1;
    return 0;
}

void rst_cell_values(const struct rst_growth *g, const struct rst_leaf *at, double value[rst_most_functions])
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    rst_cell_place(g, at, &corner, step);
    for (int64_t n = 0; n < g->of_cell.count; n++)
        value[n] = rst_nodes_value(&g->nodes, node_at(&corner, step, g->of_cell.at[n]));
}

void rst_cell_polynomial(const struct rst_growth *g, const struct rst_leaf *at, double coefficient[rst_most_functions])
{
    rst_cell_values(g, at, coefficient);
    rst_serendipity_rise(&g->of_cell, coefficient);
}

void rst_cell_local(const struct rst_growth *g, const struct rst_leaf *cell, const double at[rst_cell_axes],
                    double u[rst_cell_axes])
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    rst_cell_place(g, cell, &corner, step);
    for (int a = 0; a < rst_cell_axes; a++)
        u[a] = step[a] > 0 ? (at[a] - corner.at[a]) / (rst_quarters * step[a]) : 0;
}

/* By how much the polynomial misses, at most; beyond psi = 1 the value is psi ex. */
static double missed_along(const struct rst_growth *g, const struct restitute_table_builder *b, int64_t cell, int axis,
                           const double *coefficient)
{
    struct rst_spot_on_lattice corner;
    struct rst_place numbers;
    int32_t step[rst_cell_axes];
    double worst = 0, u[rst_cell_axes];
    rst_cell_place(g, &g->cell[cell].at, &corner, step);
    for (int n = 0; n < places_along(g, axis); n++) {
        const struct rst_spot_on_lattice place = place_to_compare(&corner, step, cell, axis, n);
        const double at[rst_cell_axes] = {place.at[0], place.at[1], place.at[2], place.at[3]};
        rst_cells_numbers(b, at, &numbers);
        rst_cell_local(g, &g->cell[cell].at, at, u);
        const double off = rst_serendipity_sum(&g->of_cell, coefficient, u) - rst_nodes_value(&g->nodes, place);
        worst = fmax(worst, fabs(off) / fmax(1, numbers.psi));
    }
    return worst;
}

/* Where many halvings do not help, the impacts themselves are off. */
void rst_cell_judge(struct rst_growth *g, const struct restitute_table_builder *b, int64_t k)
{
    struct rst_cell *cell = &g->cell[k];
    double coefficient[rst_most_functions];
    rst_cell_polynomial(g, &cell->at, coefficient);
    double sum = missed_along(g, b, k, rst_cell_axes, coefficient);
    for (int a = 0; a < rst_cell_axes; a++)
        sum += cell->error[a] = missed_along(g, b, k, a, coefficient);
    const int is_good = sum <= g->part * b->options.tolerance;
    cell->usual = cell->usual > 0 ? sqrt(cell->usual * sum) : sum;
    if (is_good || cell->usual <= 0.5 * cell->before) {
        cell->before = cell->usual;
        cell->in_vain = 0;
    }
    cell->state = is_good || cell->in_vain >= rst_most_in_vain ? RST_SETTLED : RST_FAILING;
}
