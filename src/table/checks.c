/* A table of trees is compared with impacts at arbitrary places in its cells (cells.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "cells.h"

/* At least so many in all, and two in a cell as long as that is not many; and places drawn until one is in the range.
 * */
enum { least_checks = 10000, many_cells = 30000, most_tries = 200 };

static int add_check(struct restitute_table_builder *b, struct rst_check check)
{
    struct rst_cells *c = b->cells;
    if (c->checks == c->check_capacity) {
        const int64_t capacity = c->checks ? 2 * c->checks : 1024;
        struct rst_check *checks = realloc(c->check, (size_t)capacity * sizeof *checks);
        if (!checks) return 1;
        c->check = checks;
        c->check_capacity = capacity;
    }
    const struct rst_point p = {
        .u = {check.delta1, check.gamma, check.chi}, .s = check.psi, .column = -1, .slot = c->checks};
    c->check[c->checks++] = check;
    return rst_plan_add(b, p);
}

/* Where a check fails by more than this part of the tolerance even before the cell's nodes are put on its neighbours',
 * it is its own fault. */
static const double part_of_own = 0.8;

/* Additive recurrences of the plastic number's kind for four axes: evenly spread, and no period of the cells. */
static const double spread[rst_cell_axes] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                             0.5385972572236101};

/* An arbitrary place of what was asked for in a cell, number n of all that are drawn; nonzero: there is none at that
 * gamma. */
static int place_in_cell(const struct restitute_table_builder *b, int64_t k, int64_t n, double at[rst_cell_axes])
{
    const struct rst_cells *c = b->cells;
    const double(*range)[2] = b->family.range;
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    double end[2][rst_cell_axes], log_w[2];
    struct rst_place p[2];
    rst_cell_place(&c->tangent, &c->tangent.cell[k].at, &corner, step);
    for (int a = 0; a < rst_cell_axes; a++) {
        end[0][a] = corner.at[a];
        end[1][a] = corner.at[a] + rst_quarters * step[a];
        at[a] = end[0][a] + (end[1][a] - end[0][a]) * fmod(spread[a] * (double)(n + 1), 1);
    }
    for (int i = 0; i < 2; i++)
        rst_cells_numbers(b, end[i], &p[i]);
    const double low = fmax(range[1][0], p[0].gamma), high = fmin(range[1][1], p[1].gamma);
    const double part = (at[RST_G] - end[0][RST_G]) / (end[1][RST_G] - end[0][RST_G]);
    const double gamma = low + part * (high - low);
    at[RST_G] = end[0][RST_G] + (gamma - p[0].gamma) / (p[1].gamma - p[0].gamma) * (end[1][RST_G] - end[0][RST_G]);
    const int64_t octave = c->tangent.cell[k].at.octave;
    const double h = rst_cells_h(&c->gamma, octave, at[RST_G] / rst_lattice - (double)octave);
    for (int i = 0; i < 2; i++) {
        const double of_range = (log2(range[0][i] * h) * c->w.scale - (double)c->w.first) * rst_lattice;
        log_w[i] = i ? fmin(end[i][RST_W], of_range) : fmax(end[i][RST_W], of_range);
    }
    at[RST_W] = log_w[0] + (log_w[1] - log_w[0]) * (at[RST_W] - end[0][RST_W]) / (end[1][RST_W] - end[0][RST_W]);
    return log_w[0] > log_w[1];
}

static int check_cell(struct restitute_table_builder *b, int64_t k)
{
    struct rst_place p;
    for (int64_t i = 0; i < b->cells->checks_a_cell; i++) {
        struct rst_check check = {.cell = k};
        int tries = 0;
        while (place_in_cell(b, k, b->cells->drawn++, check.at) && ++tries < most_tries)
            continue;
        if (tries == most_tries) return 0;
        rst_cells_numbers(b, check.at, &p);
        check.delta1 = p.delta1;
        check.gamma = p.gamma;
        check.chi = p.chi;
        check.psi = p.psi;
        if (add_check(b, check)) return 1;
    }
    return 0;
}

/* How many checks a cell has: known when there are cells. */
static int64_t checks_for(const struct rst_growth *g)
{
    int64_t leaves = 0;
    for (int64_t k = 0; k < g->count; k++)
        leaves += g->cell[k].state == RST_SETTLED;
    const int64_t wanted = least_checks / (leaves > 0 ? leaves : 1) + 1;
    return wanted < 2 && leaves < many_cells ? 2 : wanted;
}

int rst_checks_plan(struct restitute_table_builder *b)
{
    struct rst_growth *g = &b->cells->tangent;
    rst_plan_begin(b);
    if (b->cells->checks_a_cell == 0) b->cells->checks_a_cell = checks_for(g);
    for (int64_t k = 0; k < g->count; k++) {
        if (g->cell[k].state != RST_SETTLED || g->cell[k].checked) continue;
        g->cell[k].checked = 1;
        if (check_cell(b, k)) return 1;
    }
    return 0;
}

/* The leaf that a check is in now. */
static struct rst_cell *leaf_of(struct rst_growth *g, struct rst_check *check)
{
    while (g->cell[check->cell].state == RST_DONE_WITH) {
        const int64_t child = g->cell[check->cell].child;
        check->cell = rst_cell_holds(g, &g->cell[child].at, check->at) ? child : child + 1;
    }
    return &g->cell[check->cell];
}

/* What the polynomial misses at a check that the cell's own impacts tell. */
static double missed_by_own(const struct restitute_table_builder *b, const struct rst_cell *cell,
                            const struct rst_check *check)
{
    const struct rst_growth *g = &b->cells->tangent;
    double coefficient[rst_most_functions], u[rst_cell_axes];
    struct rst_place p;
    rst_cells_numbers(b, check->at, &p);
    rst_cell_polynomial(g, &cell->at, coefficient);
    rst_cell_local(g, &cell->at, check->at, u);
    const double kept = rst_serendipity_sum(&g->of_cell, coefficient, u), psi = p.y > 0 ? p.psi : 1;
    return fabs((kept + p.y * p.ez) / psi - check->solved.ex) + check->solved.error_ex;
}

/* A check has failed: its cell fails, or where its own impacts would do, the neighbours on whose polynomials its nodes
 * were put. */
static void blame(struct restitute_table_builder *b, struct rst_cell *cell, const struct rst_check *check)
{
    int blamed = 0;
    if (missed_by_own(b, cell, check) > part_of_own * b->options.tolerance) blamed = rst_cell_fails(cell);
    for (int i = 0; i < rst_most_pulls && cell->pull[i].by > 0; i++)
        blamed |= rst_cell_fails(&b->cells->tangent.cell[cell->pull[i].cell]);
    if (!blamed) rst_cell_fails(cell);
}

/* Largest differences to all impacts of the checks; cells where they are too large fail. */
void rst_checks_compare(struct restitute_table_builder *b)
{
    struct rst_cells *c = b->cells;
    for (int64_t i = 0; i < b->points; i++)
        c->check[b->point[i].slot].solved = b->solved[i];
    b->worst_ez = b->worst_ex = 0;
    for (int64_t i = 0; i < c->checks; i++) {
        struct rst_check *check = &c->check[i];
        struct rst_cell *cell = leaf_of(&c->tangent, check);
        restitute_table_value pair;
        rst_table_evaluate(c->made, check->delta1, check->gamma, check->chi, check->psi, &pair);
        const double ez = fabs(pair.ez - check->solved.ez) + check->solved.error_ez;
        const double ex = fabs(pair.ex - check->solved.ex) + check->solved.error_ex;
        b->worst_ez = fmax(b->worst_ez, ez);
        b->worst_ex = fmax(b->worst_ex, ex);
        if (ex > b->options.tolerance) blame(b, cell, check);
    }
    restitute_table_destroy(b->draft);
    b->draft = c->made;
    b->draft->checks = c->checks;
    c->made = NULL;
}
