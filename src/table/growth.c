/* A tree of cells that grows: its cells, and how those that fail are halved (cells.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "cells.h"
#include "parallel.h"

/* An octave of gamma is halved along gamma where so many of its failing cells ask for that, for one that asks for
 * something else. */
static const double share_for_gamma = 0.3;

static const int axis_of_chain[rst_alongs] = {[RST_ALONG_W] = RST_W, [RST_ALONG_CHI] = RST_C, [RST_ALONG_PSI] = RST_P};

static int asks_for(const struct rst_cell *cell)
{
    int most = RST_W;
    for (int a = 0; a < rst_cell_axes; a++)
        if (cell->error[a] > cell->error[most]) most = a;
    return most;
}

/* ---- cells */

void rst_cell_place(const struct rst_growth *g, const struct rst_leaf *at, struct rst_spot_on_lattice *corner,
                    int32_t step[rst_cell_axes])
{
    int32_t size[rst_cell_axes] = {rst_lattice, rst_lattice >> at->level, rst_lattice, rst_lattice};
    corner->at[RST_W] = (int32_t)at->root * rst_lattice;
    corner->at[RST_G] = (int32_t)at->octave * rst_lattice + (int32_t)at->part * size[RST_G];
    corner->at[RST_C] = 0;
    corner->at[RST_P] = (int32_t)at->sheet * rst_lattice;
    for (int64_t d = 0; d < at->depth; d++) {
        const int axis = axis_of_chain[g->chain[d]];
        size[axis] /= 2;
        if (at->path >> (at->depth - 1 - d) & 1) corner->at[axis] += size[axis];
    }
    for (int a = 0; a < rst_cell_axes; a++)
        step[a] = g->active[a] ? size[a] / rst_quarters : 0;
}

int rst_cell_holds(const struct rst_growth *g, const struct rst_leaf *cell, const double at[rst_cell_axes])
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    rst_cell_place(g, cell, &corner, step);
    for (int a = 0; a < rst_cell_axes; a++)
        if (g->active[a] && (at[a] < corner.at[a] || at[a] > corner.at[a] + rst_quarters * step[a])) return 0;
    return 1;
}

/* Whether any of a cell is in what was asked for. h grows with gamma. */
static int is_asked(const struct rst_growth *g, const struct restitute_table_builder *b,
                    const struct rst_spot_on_lattice *corner, const int32_t step[rst_cell_axes])
{
    const double margin = 1e-9, beyond = g->beyond;
    double at[2][rst_cell_axes];
    struct rst_place low, high;
    for (int a = 0; a < rst_cell_axes; a++) {
        at[0][a] = corner->at[a];
        at[1][a] = corner->at[a] + rst_quarters * step[a];
    }
    rst_cells_numbers(b, (double[]){at[0][RST_W], at[1][RST_G], 0, 0}, &low);
    rst_cells_numbers(b, (double[]){at[1][RST_W], at[0][RST_G], 0, 0}, &high);
    const double(*range)[2] = b->family.range;
    if (low.delta1 > range[0][1] * beyond * (1 + margin) || high.delta1 < range[0][0] / beyond * (1 - margin)) return 0;
    return beyond > 1 || (high.gamma <= range[1][1] * (1 + margin) && low.gamma >= range[1][0] * (1 - margin));
}

/* `whole`: what it is a half of, NULL: a root; as_asked: it was halved along the axis along which its polynomial
 * misses most. */
static int add_cell(struct rst_growth *g, const struct restitute_table_builder *b, struct rst_leaf at,
                    const struct rst_cell *whole, int as_asked)
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    rst_cell_place(g, &at, &corner, step);
    if (!is_asked(g, b, &corner, step)) return 0;
    if (g->count == g->capacity) {
        const int64_t capacity = g->capacity ? 2 * g->capacity : 1024;
        struct rst_cell *cell = realloc(g->cell, (size_t)capacity * sizeof *cell);
        if (!cell) return 1;
        g->cell = cell;
        g->capacity = capacity;
    }
    const struct rst_cell cell = {.at = at,
                                  .state = RST_TO_JUDGE,
                                  .usual = whole ? whole->usual : 0,
                                  .before = whole ? whole->before : HUGE_VAL,
                                  .in_vain = (int8_t)(whole ? whole->in_vain + as_asked : 0)};
    g->cell[g->count++] = cell;
    return 0;
}

/* Halves of a cell, made from that of the lower one. */
static int add_halves(struct rst_growth *g, const struct restitute_table_builder *b, int64_t k, struct rst_leaf lower)
{
    const struct rst_cell whole = g->cell[k];
    const int along = lower.level > whole.at.level ? RST_G : axis_of_chain[g->chain[whole.at.depth]];
    const int as_asked = along == asks_for(&whole);
    struct rst_leaf upper = lower;
    upper.part += lower.level > whole.at.level;
    upper.path += lower.depth > whole.at.depth;
    g->cell[k].state = RST_DONE_WITH;
    g->cell[k].child = g->count;
    return add_cell(g, b, lower, &whole, as_asked) || add_cell(g, b, upper, &whole, as_asked);
}

int rst_growth_begin(struct rst_growth *g, const struct rst_cells *c, const struct restitute_table_builder *b)
{
    const size_t marks = (size_t)c->gamma.cells * (rst_deepest + 1);
    g->of.octaves = c->gamma.cells;
    g->of.roots = c->w.roots;
    rst_serendipity_set(g->active, &g->of_cell);
    g->level = calloc(marks, sizeof *g->level);
    g->closed = calloc(marks, sizeof *g->closed);
    if (!g->level || !g->closed) return 1;
    const int64_t sheets = b->active[RST_SLIP] ? g->of.sheets : 1;
    for (int64_t o = 0; o < g->of.octaves; o++)
        for (int64_t r = 0; r < g->of.roots; r++)
            for (int64_t s = 0; s < sheets; s++)
                if (add_cell(g, b, (struct rst_leaf){.octave = o, .root = r, .sheet = s}, NULL, 0)) return 1;
    return 0;
}

void rst_growth_free(struct rst_growth *g)
{
    free(g->level);
    free(g->closed);
    free(g->cell);
    rst_nodes_clear(&g->nodes);
}

/* ---- which are halved */

int rst_cell_fails(struct rst_cell *cell)
{
    if (cell->state == RST_SETTLED && cell->in_vain < rst_most_in_vain) cell->state = RST_FAILING;
    return cell->state == RST_FAILING;
}

int rst_growth_fails(struct rst_growth *g, int pardon)
{
    int any = 0;
    for (int64_t k = 0; k < g->count; k++) {
        if (g->cell[k].state != RST_FAILING) continue;
        if (pardon) g->cell[k].state = RST_SETTLED;
        any = 1;
    }
    return any;
}

/* ---- how it is halved */

static int64_t mark_of(const struct rst_leaf *at)
{
    return at->octave * (rst_deepest + 1) + at->depth;
}

/* Octaves decide, for each depth, whether their failing cells are halved along gamma or with the chain. */
static int decide_on_gamma(struct rst_growth *g)
{
    const size_t marks = (size_t)g->of.octaves * (rst_deepest + 1);
    int32_t(*votes)[2] = calloc(marks, sizeof *votes);
    if (!votes) return 1;
    for (int64_t k = 0; k < g->count; k++) {
        const struct rst_cell *cell = &g->cell[k];
        if (cell->state == RST_FAILING && cell->at.level == g->level[mark_of(&cell->at)])
            votes[mark_of(&cell->at)][asks_for(cell) == RST_G]++;
    }
    for (size_t i = 0; i < marks; i++) {
        if (g->closed[i] || votes[i][0] + votes[i][1] == 0) continue;
        if (votes[i][1] > share_for_gamma * votes[i][0] && g->level[i] < rst_finest_part) {
            g->level[i]++;
        } else {
            g->closed[i] = 1;
            if (i % (rst_deepest + 1) < rst_deepest && g->level[i + 1] < g->level[i]) g->level[i + 1] = g->level[i];
        }
    }
    free(votes);
    return 0;
}

static int halve_along_gamma(struct rst_growth *g, const struct restitute_table_builder *b, int *more)
{
    const int64_t count = g->count;
    for (int64_t k = 0; k < count; k++) {
        struct rst_leaf at = g->cell[k].at;
        if (g->cell[k].state != RST_FAILING) continue;
        if (at.level >= g->level[mark_of(&at)]) {
            g->cell[k].state = RST_TO_HALVE;
            continue;
        }
        at.level++;
        at.part *= 2;
        if (add_halves(g, b, k, at)) return 1;
        *more = 1;
    }
    return 0;
}

static int times_in_chain(const struct rst_growth *g, int along)
{
    int times = 0;
    for (int64_t d = 0; d < g->chain_length; d++)
        times += g->chain[d] == along;
    return times;
}

/* One more halving: along what most of those ask for that wait for it. Nonzero: none is left. */
static int lengthen_chain(struct rst_growth *g)
{
    int64_t votes[rst_alongs] = {0};
    int best = -1;
    for (int64_t k = 0; k < g->count; k++) {
        const struct rst_cell *cell = &g->cell[k];
        if (cell->state != RST_TO_HALVE || cell->at.depth != g->chain_length) continue;
        int most = 0;
        for (int along = 0; along < rst_alongs; along++)
            if (cell->error[axis_of_chain[along]] > cell->error[axis_of_chain[most]]) most = along;
        votes[most]++;
    }
    for (int along = 0; along < rst_alongs; along++) {
        if (!g->active[axis_of_chain[along]] || times_in_chain(g, along) >= rst_most_halvings) continue;
        if (best < 0 || votes[along] > votes[best]) best = along;
    }
    if (best < 0 || g->chain_length >= rst_deepest) return 1;
    g->chain[g->chain_length++] = (int8_t)best;
    return 0;
}

static int halve_with_chain(struct rst_growth *g, const struct restitute_table_builder *b, int *more)
{
    const int64_t count = g->count;
    for (int64_t k = 0; k < count; k++) {
        struct rst_leaf at = g->cell[k].at;
        if (g->cell[k].state != RST_TO_HALVE || at.depth >= g->chain_length) continue;
        at.depth++;
        at.path *= 2;
        if (add_halves(g, b, k, at)) return 1;
        *more = 1;
    }
    return 0;
}

struct judging {
    struct rst_growth *growth;
    const struct restitute_table_builder *builder;
};

static void judge(void *of, int64_t k)
{
    const struct judging *j = of;
    if (j->growth->cell[k].state == RST_TO_JUDGE) rst_cell_judge(j->growth, j->builder, k);
}

int rst_growth_judge(struct rst_growth *g, const struct restitute_table_builder *b, int *more)
{
    int waiting = 0;
    *more = 0;
    rst_table_loop(b->options.threads, g->count, judge, &(struct judging){g, b});
    if (decide_on_gamma(g) || halve_along_gamma(g, b, more) || halve_with_chain(g, b, more)) return 1;
    for (int64_t k = 0; k < g->count; k++)
        waiting |= g->cell[k].state == RST_TO_HALVE;
    if (*more || !waiting) return 0;
    if (!lengthen_chain(g)) return halve_with_chain(g, b, more);
    for (int64_t k = 0; k < g->count; k++)
        if (g->cell[k].state == RST_TO_HALVE) g->cell[k].state = RST_SETTLED;
    return 0;
}
