/* From trees that have grown to a table (cells.h). Of two cells that touch, the deeper one is nowhere wider (tree.h):
 * its nodes on their common face are put on the polynomials of the other. Cells are finished from the shallowest on,
 * so that those are final. SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "cells.h"
#include "parallel.h"

/* What a cell may miss at the nodes of its smaller neighbours: beyond that part of the tolerance it fails, if its own
 * impacts tell no better polynomial than what is left of it; beyond the second part of what it may miss where it is
 * compared, if that is why a check of the neighbour fails. */
static const double part_at_seams = 1, part_to_blame = 0.3;

/* A tree with the values at the nodes of its leaves, then their coefficients. */
struct harvest {
    struct rst_growth *growth;
    const struct restitute_table_builder *builder;
    struct rst_tree *tree;
    int64_t *cell; /* which one a leaf is */
    double *value;
    char *fails;           /* leaves that miss too much at the nodes of their neighbours */
    const int64_t *sorted; /* leaves by depth, those of one depth from here on */
};

/* ---- leaves, and what was solved at their nodes */

struct numbered_leaf {
    struct rst_leaf at;
    int64_t cell;
};

/* By place: a root after the other, and what is close in it is close in memory. */
static int by_place(const void *a, const void *b)
{
    const struct rst_leaf *x = &((const struct numbered_leaf *)a)->at, *y = &((const struct numbered_leaf *)b)->at;
    const int64_t keys[5][2] = {{x->octave, y->octave},
                                {x->root, y->root},
                                {x->sheet, y->sheet},
                                {x->path << (rst_deepest - x->depth), y->path << (rst_deepest - y->depth)},
                                {x->part << (rst_finest_part - x->level), y->part << (rst_finest_part - y->level)}};
    for (int i = 0; i < 5; i++)
        if (keys[i][0] != keys[i][1]) return keys[i][0] < keys[i][1] ? -1 : 1;
    return 0;
}

static int plant(struct harvest *h, const int8_t *chain, int64_t length)
{
    const struct rst_growth *g = h->growth;
    int64_t leaves = 0;
    struct numbered_leaf *sorted = malloc((size_t)(g->count + 1) * sizeof *sorted);
    struct rst_leaf *leaf = malloc((size_t)(g->count + 1) * sizeof *leaf);
    h->cell = malloc((size_t)(g->count + 1) * sizeof *h->cell);
    int failed = !sorted || !leaf || !h->cell;
    for (int64_t k = 0; k < g->count && !failed; k++)
        if (g->cell[k].state == RST_SETTLED) sorted[leaves++] = (struct numbered_leaf){g->cell[k].at, k};
    if (!failed) qsort(sorted, (size_t)leaves, sizeof *sorted, by_place);
    for (int64_t i = 0; i < leaves && !failed; i++) {
        leaf[i] = sorted[i].at;
        h->cell[i] = sorted[i].cell;
    }
    rst_tree_begin(g->of, chain, length, h->tree);
    if (!failed) failed = rst_tree_plant(h->tree, leaf, leaves) != 0;
    free(sorted);
    free(leaf);
    return failed;
}

/* ---- neighbours */

enum { directions = 81 };

static void direction_of(int number, int d[rst_cell_axes])
{
    for (int a = 0; a < rst_cell_axes; a++, number /= 3)
        d[a] = number % 3 - 1;
}

static int number_of(const int d[rst_cell_axes])
{
    int number = 0;
    for (int a = rst_cell_axes - 1; a >= 0; a--)
        number = 3 * number + d[a] + 1;
    return number;
}

/* The leaf that holds a place on the lattice; -1: none. */
static int64_t leaf_at(const struct harvest *h, const double at[rst_cell_axes])
{
    static const enum rst_along along[rst_cell_axes] = {[RST_W] = RST_ALONG_W, [RST_C] = RST_ALONG_CHI, [RST_P] = RST_ALONG_PSI};
    const struct rst_tree *t = h->tree;
    const int64_t most[rst_cell_axes] = {t->of.roots, t->of.octaves, 1, t->of.sheets};
    int64_t whole[rst_cell_axes];
    uint64_t part[rst_cell_axes];
    uint32_t code = 0;
    for (int a = 0; a < rst_cell_axes; a++) {
        whole[a] = (int64_t)floor(at[a] / rst_lattice);
        if (whole[a] < 0 || whole[a] >= most[a]) return -1;
        part[a] = rst_tree_bits(at[a] / rst_lattice - (double)whole[a]);
        if (a != RST_G) code |= rst_tree_code(t, along[a], part[a]);
    }
    const int64_t leaf = rst_tree_find(t, whole[RST_G], whole[RST_W], whole[RST_P], part[RST_G], code);
    return rst_cell_holds(h->growth, &t->leaf[leaf], at) ? leaf : -1;
}

static int is_shallower(const struct rst_leaf *a, const struct rst_leaf *b)
{
    return a->depth < b->depth || (a->depth == b->depth && a->level < b->level);
}

/* The shallowest leaf that touches the part of the boundary which lies in a direction, if it is shallower than the
 * leaf itself; else -1. */
static void find_masters(const struct harvest *h, int64_t leaf, int64_t master[directions])
{
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    int64_t beside[directions];
    int d[rst_cell_axes];
    rst_cell_place(h->growth, &h->tree->leaf[leaf], &corner, step);
    for (int n = 0; n < directions; n++) {
        double at[rst_cell_axes];
        int inside = 1, possible = 1;
        direction_of(n, d);
        for (int a = 0; a < rst_cell_axes; a++) {
            at[a] = corner.at[a] + 0.5 * rst_quarters * step[a] * (1 + d[a]) + 0.25 * d[a];
            inside &= d[a] == 0;
            possible &= d[a] == 0 || h->growth->active[a];
        }
        beside[n] = inside || !possible ? -1 : leaf_at(h, at);
    }
    for (int n = 0; n < directions; n++) {
        int wider[rst_cell_axes];
        master[n] = -1;
        direction_of(n, d);
        /* the directions that keep some of the components of this one */
        for (int kept = 1; kept < 1 << rst_cell_axes; kept++) {
            for (int a = 0; a < rst_cell_axes; a++)
                wider[a] = kept >> a & 1 ? d[a] : 0;
            const int64_t other = beside[number_of(wider)];
            if (other < 0) continue;
            const struct rst_leaf *best = &h->tree->leaf[master[n] >= 0 ? master[n] : leaf];
            if (is_shallower(&h->tree->leaf[other], best)) master[n] = other;
        }
    }
}

/* ---- nodes on faces */

static double polynomial(const struct harvest *h, int64_t leaf, const struct rst_spot_on_lattice *spot)
{
    const struct rst_growth *g = h->growth;
    double u[rst_cell_axes];
    rst_cell_local(g, &h->tree->leaf[leaf], (double[]){spot->at[0], spot->at[1], spot->at[2], spot->at[3]}, u);
    return rst_serendipity_sum(&g->of_cell, h->value + leaf * g->of_cell.count, u);
}

/* What a node is worth less than that is psi ex (cells.h). */
static double psi_at(const struct harvest *h, const struct rst_spot_on_lattice *spot)
{
    struct rst_place p;
    rst_cells_numbers(h->builder, (double[]){spot->at[0], spot->at[1], spot->at[2], spot->at[3]}, &p);
    return fmax(1, p.psi);
}

/* Keep the largest of each neighbour, and the largest of all. */
static void note_pull(struct rst_cell *cell, struct rst_pull pull)
{
    for (int i = 0; i < rst_most_pulls; i++) {
        const struct rst_pull before = cell->pull[i];
        if (before.by > 0 && before.cell == pull.cell) {
            if (pull.by > before.by) cell->pull[i] = pull;
            return;
        }
        if (before.by >= pull.by) continue;
        cell->pull[i] = pull;
        if (before.by == 0) return;
        pull = before;
    }
}

/* Whether a leaf misses so much at a place by its own impacts, before its nodes were put on its neighbours'. */
static int misses(const struct harvest *h, int64_t leaf, const struct rst_spot_on_lattice *spot, double most)
{
    const struct rst_growth *g = h->growth;
    double u[rst_cell_axes], coefficient[rst_most_functions];
    rst_cell_polynomial(g, &h->tree->leaf[leaf], coefficient);
    rst_cell_local(g, &h->tree->leaf[leaf], (double[]){spot->at[0], spot->at[1], spot->at[2], spot->at[3]}, u);
    const double off = rst_serendipity_sum(&g->of_cell, coefficient, u) - rst_nodes_value(&g->nodes, *spot);
    return fabs(off) > most * psi_at(h, spot);
}

/* The node of a leaf goes where the other leaf's polynomial is. If that is far from the impact at the node, the other
 * leaf fails. */
static void put_on(struct harvest *h, int64_t leaf, int64_t other, const struct rst_spot_on_lattice *spot,
                   double *value)
{
    const double there = polynomial(h, other, spot), tolerance = h->builder->options.tolerance;
    const double most = part_at_seams * tolerance, noted = part_to_blame * h->growth->part * tolerance;
    double off = fabs(there - *value);
    *value = there;
    if (off <= noted) return;
    off /= psi_at(h, spot);
    if (off > most && misses(h, other, spot, most)) {
#ifdef _OPENMP
#pragma omp atomic write
#endif
        h->fails[other] = 1;
    }
    if (off > noted) note_pull(&h->growth->cell[h->cell[leaf]], (struct rst_pull){off, h->cell[other]});
}

static void put_on_neighbours(struct harvest *h, int64_t leaf)
{
    const struct rst_serendipity *of_cell = &h->growth->of_cell;
    int64_t master[directions];
    struct rst_spot_on_lattice corner, spot;
    int32_t step[rst_cell_axes];
    memset(h->growth->cell[h->cell[leaf]].pull, 0, sizeof h->growth->cell->pull);
    find_masters(h, leaf, master);
    rst_cell_place(h->growth, &h->tree->leaf[leaf], &corner, step);
    for (int64_t n = 0; n < of_cell->count; n++) {
        int d[rst_cell_axes];
        for (int a = 0; a < rst_cell_axes; a++) {
            const int place = of_cell->at[n][a];
            d[a] = step[a] == 0 ? 0 : (place == rst_quarters) - (place == 0);
            spot.at[a] = corner.at[a] + place * step[a];
        }
        const int64_t other = master[number_of(d)];
        if (other >= 0) put_on(h, leaf, other, &spot, &h->value[leaf * of_cell->count + n]);
    }
}

enum { ranks = (rst_deepest + 1) * (rst_finest_part + 1) };

static int64_t rank_of(const struct rst_leaf *leaf)
{
    return leaf->depth * (rst_finest_part + 1) + leaf->level;
}

/* The leaves from the shallowest rank on; those of a rank begin at start[rank]. */
static void sort_by_rank(const struct rst_tree *tree, int64_t *sorted, int64_t start[ranks + 1])
{
    int64_t next[ranks];
    memset(start, 0, (ranks + 1) * sizeof *start);
    for (int64_t leaf = 0; leaf < tree->leaves; leaf++)
        start[rank_of(&tree->leaf[leaf]) + 1]++;
    for (int rank = 0; rank < ranks; rank++)
        next[rank] = start[rank + 1] += start[rank];
    for (int64_t leaf = tree->leaves - 1; leaf >= 0; leaf--)
        sorted[--next[rank_of(&tree->leaf[leaf])]] = leaf;
}

/* Those of one rank need none of each other. */
static void finish_leaf(void *of, int64_t i)
{
    struct harvest *h = of;
    const int64_t leaf = h->sorted[i];
    put_on_neighbours(h, leaf);
    rst_serendipity_rise(&h->growth->of_cell, h->value + leaf * h->growth->of_cell.count);
}

static int close_seams(struct harvest *h)
{
    int64_t start[ranks + 1], *sorted = malloc((size_t)(h->tree->leaves + 1) * sizeof *sorted);
    h->fails = calloc((size_t)(h->tree->leaves + 1), 1);
    if (sorted && h->fails) {
        sort_by_rank(h->tree, sorted, start);
        for (int rank = 0; rank < ranks; rank++) {
            h->sorted = sorted + start[rank];
            rst_table_loop(h->builder->options.threads, start[rank + 1] - start[rank], finish_leaf, h);
        }
        for (int64_t leaf = 0; leaf < h->tree->leaves; leaf++)
            if (h->fails[leaf]) rst_cell_fails(&h->growth->cell[h->cell[leaf]]);
    }
    free(sorted);
    return !sorted || !h->fails;
}

/* A tree with its coefficients, whose seams are closed. Nonzero: out of memory. */
static int reap(const struct restitute_table_builder *b, struct rst_growth *g, const int8_t *chain, int64_t length,
                struct rst_tree *tree, struct harvest *h)
{
    const int64_t nodes = g->of_cell.count;
    *h = (struct harvest){.growth = g, .builder = b, .tree = tree};
    if (plant(h, chain, length)) return 1;
    h->value = malloc((size_t)(tree->leaves * nodes) * sizeof *h->value);
    if (!h->value) return 1;
    for (int64_t leaf = 0; leaf < tree->leaves; leaf++)
        rst_cell_values(g, &tree->leaf[leaf], h->value + leaf * nodes);
    return close_seams(h);
}

static void harvest_free(struct harvest *h)
{
    free(h->cell);
    free(h->value);
    free(h->fails);
}

/* ---- tables */

static const int8_t always_w[rst_most_halvings] = {0}; /* RST_ALONG_W */

static void describe(const struct restitute_table_builder *b, restitute_table *form)
{
    rst_family_describe(&b->family, form);
    rst_octaves_set(b->seam_low[0], b->seam_high[0], 0, &form->speed);
    form->gamma = b->cells->gamma;
    form->w = b->cells->w;
    form->chi_low = rst_builder_number(b, RST_CHI, 0);
    form->chi_high = rst_builder_number(b, RST_CHI, 1);
}

/* Room for a table of the trees in `form`, which it takes over. */
static restitute_table *take_over(int failed, restitute_table *form)
{
    rst_table_count(form);
    restitute_table *t = failed ? NULL : rst_table_allocate(form);
    if (t) return t;
    rst_tree_fell(&form->rebound);
    rst_tree_fell(&form->tangent);
    return NULL;
}

/* Its own lookups reach nodes outside of the range of delta1. */
int rst_cells_make_rebound(struct restitute_table_builder *b)
{
    restitute_table form;
    struct harvest h;
    describe(b, &form);
    form.speed.low = 0;
    form.speed.high = HUGE_VAL;
    form.n_cells = 1; /* no ex is asked for */
    const int failed = reap(b, &b->cells->rebound, always_w, rst_most_halvings, &form.rebound, &h);
    restitute_table *t = take_over(failed, &form);
    if (t) memcpy(t->ez, h.value, (size_t)(form.rebound.leaves * b->cells->rebound.of_cell.count) * sizeof *t->ez);
    harvest_free(&h);
    restitute_table_destroy(b->cells->ez);
    b->cells->ez = t;
    return !t;
}

static int copy_tree(const struct rst_tree *from, struct rst_tree *to)
{
    rst_tree_begin(from->of, from->chain, from->chain_length, to);
    return rst_tree_plant(to, from->leaf, from->leaves);
}

int rst_cells_make(struct restitute_table_builder *b, restitute_table **table)
{
    struct rst_growth *g = &b->cells->tangent;
    const restitute_table *ez = b->cells->ez;
    restitute_table form;
    struct harvest h = {.value = NULL};
    describe(b, &form);
    const int failed =
        copy_tree(&ez->rebound, &form.rebound) || reap(b, g, g->chain, g->chain_length, &form.tangent, &h);
    form.n_cells = failed ? 1 : form.tangent.leaves;
    restitute_table *t = take_over(failed, &form);
    if (t) {
        memcpy(t->ez, ez->ez, (size_t)(form.rebound.leaves * rst_pair_functions) * sizeof *t->ez);
        for (int64_t i = 0; i < form.tangent.leaves * g->of_cell.count; i++)
            t->ex_cells[i] = (float)h.value[i];
        *table = t;
    }
    harvest_free(&h);
    return !t;
}
