/* Fans that lead to the same leaves become one. Parts of gamma in a root with finer parts elsewhere have ways of their
 * own through larger leaves: in a table of 92 000 leaves 31 000 of 112 000 fans are left, and a lookup finds more of
 * them near by. SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "tree.h"

/* Fans met so far, by what they hold. */
struct known {
    int32_t *fan; /* -1: none */
    uint64_t mask;
};

static uint64_t hash_of(const int32_t fan[rst_fan])
{
    uint64_t hash = 0;
    for (int i = 0; i < rst_fan; i++)
        hash = (hash ^ (uint32_t)fan[i]) * UINT64_C(0x9e3779b97f4a7c15) + (hash >> 29);
    return hash ^ hash >> 32;
}

/* Number of the fan that is the same, or this one, which then is known. */
static int32_t same_as(const struct rst_tree *t, struct known *known, int32_t fan)
{
    uint64_t at = hash_of(t->fan[fan]) & known->mask;
    while (known->fan[at] >= 0 && memcmp(t->fan[known->fan[at]], t->fan[fan], sizeof *t->fan) != 0)
        at = (at + 1) & known->mask;
    if (known->fan[at] < 0) known->fan[at] = fan;
    return known->fan[at];
}

static inline int32_t renamed(const int32_t *name, int32_t next)
{
    return next >= 0 ? name[next] : next;
}

/* Fans are behind those that lead to them, so that from the last on all that a fan holds is settled. */
static void find_equals(struct rst_tree *t, struct known *known, int32_t *name)
{
    for (int32_t f = (int32_t)t->fans - 1; f >= 0; f--) {
        for (int i = 0; i < rst_fan; i++)
            t->fan[f][i] = renamed(name, t->fan[f][i]);
        name[f] = same_as(t, known, f);
    }
}

/* Those that are left move together, in their order. */
static void close_up(struct rst_tree *t, int32_t *name)
{
    int32_t left = 0;
    int32_t *place = malloc((size_t)t->fans * sizeof *place);
    if (!place) return;
    for (int32_t f = 0; f < t->fans; f++)
        if (name[f] == f) place[f] = left++;
    const int64_t starts = (t->of.octaves * t->of.roots * t->of.sheets) << t->part_bits;
    for (int64_t i = 0; i < starts; i++)
        if (t->start[i] >= 0) t->start[i] = place[name[t->start[i]]];
    for (int32_t f = 0; f < t->fans; f++)
        for (int i = 0; name[f] == f && i < rst_fan; i++)
            t->fan[place[f]][i] = renamed(place, t->fan[f][i]);
    t->fans = left;
    free(place);
}

void rst_tree_share(struct rst_tree *t)
{
    struct known known = {.mask = 1};
    while (known.mask < 2 * (uint64_t)t->fans)
        known.mask = 2 * known.mask + 1;
    known.fan = malloc((size_t)(known.mask + 1) * sizeof *known.fan);
    int32_t *name = malloc((size_t)t->fans * sizeof *name);
    if (known.fan && name) {
        memset(known.fan, -1, (size_t)(known.mask + 1) * sizeof *known.fan);
        find_equals(t, &known, name);
        close_up(t, name);
    }
    free(known.fan);
    free(name);
}
