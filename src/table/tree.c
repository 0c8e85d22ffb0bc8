/* From the leaves of a tree to the fans that lead to them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "tree.h"

#include <stdlib.h>
#include <string.h>

void rst_tree_begin(struct rst_roots of, const int8_t *chain, int64_t length, struct rst_tree *tree)
{
    memset(tree, 0, sizeof *tree);
    tree->of = of;
    tree->chain_length = length;
    memcpy(tree->chain, chain, (size_t)length);
    for (int64_t d = 0; d < rst_deepest; d++)
        for (int a = 0; a < rst_alongs; a++)
            tree->halvings[d + 1][a] = (int8_t)(tree->halvings[d][a] + (d < length && chain[d] == a));
    for (int64_t d = 0; d < length; d++) {
        const int bit = rst_most_halvings - 1 - tree->halvings[d][chain[d]], half = rst_most_halvings / 2;
        for (int i = 0; i < 1 << half; i++)
            if (i >> bit % half & 1) tree->spread[chain[d]][bit < half][i] |= UINT32_C(1) << (rst_deepest - 1 - d);
    }
}

int rst_tree_takes(const struct rst_tree *t, const struct rst_leaf *l)
{
    return l->octave >= 0 && l->octave < t->of.octaves && l->root >= 0 && l->root < t->of.roots && l->sheet >= 0 &&
           l->sheet < t->of.sheets && l->depth >= 0 && l->depth <= t->chain_length && l->path >= 0 &&
           l->path < INT64_C(1) << l->depth && l->level >= 0 && l->level <= rst_finest_part && l->part >= 0 &&
           l->part < INT64_C(1) << l->level;
}

/* ---- room */

static int64_t root_of(const struct rst_tree *t, const struct rst_leaf *l)
{
    return (l->octave * t->of.roots + l->root) * t->of.sheets + l->sheet;
}

/* Of a part of gamma of the finest level */
static int32_t *start_of(const struct rst_tree *t, int64_t root, int64_t part)
{
    const int64_t whole = root / t->of.sheets, sheet = root % t->of.sheets;
    return &t->start[((whole << t->part_bits) + part) * t->of.sheets + sheet];
}

static int64_t fans_of(const struct rst_leaf *l)
{
    return l->depth > rst_fan_bits ? (l->depth - 1) / rst_fan_bits : 0;
}

static int make_room(struct rst_tree *t, int64_t leaves, int64_t fans)
{
    const size_t starts = (size_t)((t->of.octaves * t->of.roots * t->of.sheets) << t->part_bits);
    const size_t a = (size_t)leaves * sizeof *t->leaf, b = (size_t)fans * sizeof *t->fan;
    const size_t c = starts * sizeof *t->start, d = (size_t)leaves * sizeof *t->shape;
    const double total = (double)leaves * (double)(sizeof *t->leaf + sizeof *t->shape) +
                         (double)fans * (double)sizeof *t->fan + (double)starts * (double)sizeof *t->start;
    char *room = total < 0.5 * (double)SIZE_MAX ? malloc(a + b + c + d) : NULL; /* no sum may wrap */
    if (!room) return 1;
    t->room = room;
    t->leaf = (struct rst_leaf *)(void *)room;
    t->fan = (int32_t(*)[rst_fan])(void *)(room + a);
    t->start = (int32_t *)(void *)(room + a + b);
    t->shape = (struct rst_shape *)(void *)(room + a + b + c);
    return 0;
}

void rst_tree_fell(struct rst_tree *tree)
{
    free(tree->room);
    tree->room = NULL;
}

/* ---- fans */

static const int32_t nowhere = INT32_MAX;

static int32_t new_fan(struct rst_tree *t)
{
    for (int i = 0; i < rst_fan; i++)
        t->fan[t->fans][i] = nowhere;
    return (int32_t)t->fans++;
}

/* Write a leaf into one part of gamma; nonzero if another is there. */
static int lead_to(struct rst_tree *t, int32_t *next, const struct rst_leaf *l, int32_t number)
{
    int64_t left = l->depth;
    while (left > 0) {
        if (*next == nowhere) *next = new_fan(t);
        if (*next < 0) return 1;
        int32_t *fan = t->fan[*next];
        const int64_t bits = left < rst_fan_bits ? left : rst_fan_bits, rest = rst_fan_bits - bits;
        const int64_t first = (l->path >> (left - bits) & ((INT64_C(1) << bits) - 1)) << rest;
        left -= bits;
        next = &fan[first];
        for (int64_t i = 0; left == 0 && i < INT64_C(1) << rest; i++) {
            if (fan[first + i] != nowhere) return 1;
            fan[first + i] = ~number;
        }
    }
    if (l->depth > 0) return 0;
    if (*next != nowhere) return 1;
    *next = ~number;
    return 0;
}

/* The finest level in each root: its parts need no more entries of their own. */
static int64_t *finest_levels(const struct rst_tree *t, const struct rst_leaf *leaf, int64_t leaves)
{
    int64_t *finest = calloc((size_t)(t->of.octaves * t->of.roots * t->of.sheets), sizeof *finest);
    for (int64_t i = 0; finest && i < leaves; i++) {
        int64_t *level = &finest[root_of(t, &leaf[i])];
        if (leaf[i].level > *level) *level = leaf[i].level;
    }
    return finest;
}

/* As many as leaves may need at most: each those on its way, in each part of its root. */
static int64_t most_fans(const struct rst_tree *t, const struct rst_leaf *leaf, int64_t leaves, const int64_t *finest)
{
    int64_t most = 0;
    for (int64_t i = 0; i < leaves; i++)
        most += (fans_of(&leaf[i]) + 1) << (finest[root_of(t, &leaf[i])] - leaf[i].level);
    return most;
}

static int plant_all(struct rst_tree *t, const int64_t *finest)
{
    for (int64_t i = 0; i < t->leaves; i++) {
        const struct rst_leaf *l = &t->leaf[i];
        const int64_t root = root_of(t, l), more = finest[root] - l->level;
        t->shape[i] = (struct rst_shape){(uint8_t)l->depth, (uint8_t)l->level};
        for (int64_t p = l->part << more; p < (l->part + 1) << more; p++)
            if (lead_to(t, start_of(t, root, p << (t->part_bits - finest[root])), l, (int32_t)i)) return 2;
    }
    return 0;
}

/* The first leaf that a way leads to, or nowhere. */
static int32_t any_leaf(const struct rst_tree *t, int32_t next)
{
    for (int i = 0; next >= 0 && next != nowhere && i < rst_fan; i++) {
        const int32_t found = any_leaf(t, t->fan[next][i]);
        if (found < 0) return found;
    }
    return next < 0 ? next : nowhere;
}

/* No way may lead nowhere: places that no one asks for have the leaf beside them. There is a fan even if none is
 * needed, since a lookup reads one before it knows. */
static void fill_gaps(struct rst_tree *t, const int64_t *finest)
{
    if (t->fans == 0) new_fan(t);
    for (int64_t f = 0; f < t->fans; f++) {
        const int32_t found = any_leaf(t, (int32_t)f), other = found < 0 ? found : ~0;
        for (int i = 0; i < rst_fan; i++)
            if (t->fan[f][i] == nowhere) t->fan[f][i] = other;
    }
    const int64_t roots = t->of.octaves * t->of.roots * t->of.sheets;
    int32_t before = ~0;
    for (int64_t root = 0; root < roots; root++)
        for (int64_t part = 0; part < INT64_C(1) << t->part_bits; part++) {
            const int64_t same = t->part_bits - finest[root], first = part >> same << same;
            int32_t *start = start_of(t, root, part);
            if (*start == nowhere) *start = first < part ? *start_of(t, root, first) : before;
            before = *start;
        }
}

static void set_empty(struct rst_tree *t, const struct rst_leaf *leaf, int64_t leaves)
{
    t->leaves = leaves;
    t->fans = 0;
    memcpy(t->leaf, leaf, (size_t)leaves * sizeof *leaf);
    const int64_t starts = (t->of.octaves * t->of.roots * t->of.sheets) << t->part_bits;
    for (int64_t i = 0; i < starts; i++)
        t->start[i] = nowhere;
}

int rst_tree_plant(struct rst_tree *t, const struct rst_leaf *leaf, int64_t leaves)
{
    if (leaves <= 0 || leaves >= INT32_MAX) return 2;
    t->part_bits = 0;
    for (int64_t i = 0; i < leaves; i++)
        if (leaf[i].level > t->part_bits) t->part_bits = leaf[i].level;
    int64_t *finest = finest_levels(t, leaf, leaves);
    const int64_t most = finest ? most_fans(t, leaf, leaves, finest) : 0;
    int status = !finest ? 1 : most >= INT32_MAX ? 2 : make_room(t, leaves, most);
    if (!status) {
        set_empty(t, leaf, leaves);
        status = plant_all(t, finest);
        if (status) {
            rst_tree_fell(t);
        } else {
            fill_gaps(t, finest);
            rst_tree_share(t);
        }
    }
    free(finest);
    return status;
}
