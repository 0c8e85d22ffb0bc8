/* Results of earlier rounds: a hash table with open addressing, by the bits of the place.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "builder.h"

struct rst_memory {
    double place[4];
    int64_t kind; /* stage and side of psi; 0: empty */
    struct rst_solved solved;
};

static struct rst_memory key_of(int stage, const struct rst_point *p)
{
    return (struct rst_memory){.place = {p->u[0], p->u[1], p->u[2], p->s}, .kind = 1 + 2 * stage + p->later};
}

static int same(const struct rst_memory *a, const struct rst_memory *b)
{
    return a->kind == b->kind && memcmp(a->place, b->place, sizeof a->place) == 0;
}

static uint64_t hash(const struct rst_memory *m)
{
    uint64_t h = (uint64_t)m->kind;
    for (int i = 0; i < 4; i++) {
        uint64_t bits;
        memcpy(&bits, &m->place[i], sizeof bits);
        h = (h ^ bits ^ (h >> 29)) * UINT64_C(0x9e3779b97f4a7c15);
    }
    return h ^ (h >> 32);
}

/* The slot of a key, or the empty one where it would be. */
static struct rst_memory *slot_of(const struct rst_memo *memo, const struct rst_memory *key)
{
    const uint64_t mask = (uint64_t)memo->size - 1;
    uint64_t i = hash(key) & mask;
    while (memo->slot[i].kind != 0 && !same(&memo->slot[i], key))
        i = (i + 1) & mask;
    return &memo->slot[i];
}

static int grow(struct rst_memo *memo)
{
    struct rst_memo larger = {.size = memo->size ? 2 * memo->size : 4096, .used = memo->used};
    larger.slot = calloc((size_t)larger.size, sizeof *larger.slot);
    if (!larger.slot) return 1;
    for (int64_t i = 0; i < memo->size; i++)
        if (memo->slot[i].kind != 0) *slot_of(&larger, &memo->slot[i]) = memo->slot[i];
    free(memo->slot);
    *memo = larger;
    return 0;
}

int rst_memo_add(struct rst_memo *memo, int stage, const struct rst_point *p, const struct rst_solved *s)
{
    if (2 * memo->used >= memo->size && grow(memo)) return 1;
    struct rst_memory key = key_of(stage, p);
    struct rst_memory *slot = slot_of(memo, &key);
    memo->used += slot->kind == 0;
    key.solved = *s;
    *slot = key;
    return 0;
}

int rst_memo_find(const struct rst_memo *memo, int stage, const struct rst_point *p, struct rst_solved *s)
{
    if (memo->size == 0) return 0;
    const struct rst_memory key = key_of(stage, p);
    const struct rst_memory *slot = slot_of(memo, &key);
    if (slot->kind != 0) *s = slot->solved;
    return slot->kind != 0;
}

void rst_memo_clear(struct rst_memo *memo)
{
    free(memo->slot);
    *memo = (struct rst_memo){0};
}
