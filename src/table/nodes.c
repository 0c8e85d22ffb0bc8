/* A hash table by place.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "nodes.h"

#include <stdlib.h>
#include <string.h>

static uint64_t hash(struct rst_spot_on_lattice spot)
{
    uint64_t h = 0;
    for (int a = 0; a < rst_cell_axes; a++) {
        h = (h ^ (uint32_t)spot.at[a]) * UINT64_C(0x9e3779b97f4a7c15);
        h ^= h >> 29;
    }
    return h;
}

/* Where a place is, or the free slot where it would be. */
static int32_t *slot_of(const struct rst_nodes *n, struct rst_spot_on_lattice spot)
{
    const uint64_t mask = (uint64_t)n->slots - 1;
    uint64_t i = hash(spot) & mask;
    while (n->slot[i] && memcmp(&n->node[n->slot[i] - 1].spot, &spot, sizeof spot) != 0)
        i = (i + 1) & mask;
    return &n->slot[i];
}

static void fill_slots(struct rst_nodes *n)
{
    memset(n->slot, 0, (size_t)n->slots * sizeof *n->slot);
    for (int64_t i = 0; i < n->count; i++)
        *slot_of(n, n->node[i].spot) = (int32_t)(i + 1);
}

static int grow(struct rst_nodes *n)
{
    const int64_t capacity = n->capacity ? 2 * n->capacity : 4096;
    if (capacity >= INT32_MAX) return 1;
    struct rst_lattice_node *node = realloc(n->node, (size_t)capacity * sizeof *node);
    if (!node) return 1;
    n->node = node;
    int32_t *slot = malloc((size_t)(2 * capacity) * sizeof *slot);
    if (!slot) return 1;
    free(n->slot);
    n->slot = slot;
    n->slots = 2 * capacity;
    n->capacity = capacity;
    fill_slots(n);
    return 0;
}

int64_t rst_nodes_need(struct rst_nodes *n, struct rst_spot_on_lattice spot)
{
    if (n->count == n->capacity && grow(n)) return -1;
    int32_t *slot = slot_of(n, spot);
    if (*slot) return *slot - 1;
    n->node[n->count] = (struct rst_lattice_node){.spot = spot};
    *slot = (int32_t)++n->count;
    return n->count - 1;
}

double rst_nodes_value(const struct rst_nodes *n, struct rst_spot_on_lattice spot)
{
    return n->node[*slot_of(n, spot) - 1].value;
}

struct numbered {
    struct rst_spot_on_lattice spot;
    int64_t number;
};

static int by_place(const void *a, const void *b)
{
    const struct numbered *x = a, *y = b;
    for (int i = 0; i < rst_cell_axes; i++)
        if (x->spot.at[i] != y->spot.at[i]) return x->spot.at[i] < y->spot.at[i] ? -1 : 1;
    return 0;
}

int64_t *rst_nodes_new(const struct rst_nodes *n)
{
    const size_t count = (size_t)(n->count - n->solved);
    struct numbered *sorted = malloc((count + 1) * sizeof *sorted);
    int64_t *number = malloc((count + 1) * sizeof *number);
    if (sorted && number) {
        for (size_t i = 0; i < count; i++)
            sorted[i] = (struct numbered){n->node[n->solved + (int64_t)i].spot, n->solved + (int64_t)i};
        qsort(sorted, count, sizeof *sorted, by_place);
        for (size_t i = 0; i < count; i++)
            number[i] = sorted[i].number;
    }
    free(sorted);
    if (sorted) return number;
    free(number);
    return NULL;
}

void rst_nodes_clear(struct rst_nodes *n)
{
    free(n->node);
    free(n->slot);
    memset(n, 0, sizeof *n);
}
