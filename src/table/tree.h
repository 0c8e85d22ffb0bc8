/* A tree of cells: how a table with axes of delta1 and of gamma is divided.
 *
 * The axes of the cells are gamma, by octaves; w = delta1 h(gamma), by its logarithm; chi; and places of psi. ex turns
 * sharply near w = 1/3 for small gamma, whatever gamma is (docs/table.md), so that cells may be wide in gamma and
 * narrow in w. A root is an octave of gamma, a width of log2 w, all of chi and a sheet of psi. It is halved again and
 * again along w, chi or psi, always in the same order (`chain`), and along gamma, at depths that the octave has of its
 * own. So of two cells that touch, the one that is deeper is nowhere wider than the other, and the values at its nodes
 * on their common face can be put on the polynomials of the other: the table is continuous.
 *
 * A place is found by the bits of its coordinates in the order of the chain, four at a time.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_TREE_H
#define RST_TABLE_TREE_H

#include <stdint.h>
#include <string.h>

enum rst_along { RST_ALONG_W, RST_ALONG_CHI, RST_ALONG_PSI, rst_alongs };

enum {
    rst_deepest = 32,       /* halvings of a root, but for those along gamma */
    rst_most_halvings = 12, /* along one axis */
    rst_finest_part = 4,    /* along gamma */
    rst_fan_bits = 4,
    rst_fan = 1 << rst_fan_bits,
    rst_slip_sheets = 4, /* quarters of the slip side, behind the sheet of psi <= 1 */
    rst_sheets = 1 + rst_slip_sheets
};

/* Where a cell is. */
struct rst_leaf {
    int64_t octave, root, sheet;
    int64_t depth, path; /* the halvings along the chain: bit depth - 1 - d of the path tells which half at depth d */
    int64_t level, part; /* 2^level parts of the octave of gamma */
};

/* All roots: [octave][root][sheet]. */
struct rst_roots {
    int64_t octaves, roots, sheets;
};

/* What a lookup needs to know of a leaf. */
struct rst_shape {
    uint8_t depth, level;
};

struct rst_tree {
    struct rst_roots of;
    int64_t leaves, fans;
    int64_t part_bits; /* the finest level there is */
    int64_t chain_length;
    int8_t chain[rst_deepest];
    int8_t halvings[rst_deepest + 1][rst_alongs]; /* at a depth, along an axis */
    uint32_t spread[rst_alongs][2]
                   [1 << rst_most_halvings / 2]; /* bits of a coordinate in their places, by its halves */
    int32_t *start;                              /* [octave][root][part of gamma][sheet] */
    int32_t (*fan)[rst_fan];                     /* >= 0: a fan; negative: leaf ~number */
    struct rst_shape *shape;                     /* [leaf] */
    struct rst_leaf *leaf;                       /* [leaf] */
    void *room;                                  /* of the arrays */
};

/* Set the chain; the rest is empty. */
void rst_tree_begin(struct rst_roots of, const int8_t *chain, int64_t length, struct rst_tree *tree);

/* Whether there is such a leaf, whatever else there is. */
int rst_tree_takes(const struct rst_tree *tree, const struct rst_leaf *leaf);

/* Make room for the leaves, copy them, and make the fans that lead to them; where there is no leaf they lead to
 * another. Returns 0; 1: out of memory; 2: leaves overlap, or there are none. */
int rst_tree_plant(struct rst_tree *tree, const struct rst_leaf *leaf, int64_t leaves);

/* Make one of fans that are the same; without memory for that they stay. */
void rst_tree_share(struct rst_tree *tree);

void rst_tree_fell(struct rst_tree *tree);

/* 52 bits of a coordinate u in [0, 1), the first one leading: n halvings use up n of them, and the others are the place
 * in what is left, without a product and two conversions. */
static const double rst_below_number = 1 - 0x1p-52; /* the largest u */

static inline uint64_t rst_tree_bits(double u)
{
    const double number = 1 + u;
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits << 12;
}

/* 1 and that place; the place in [0, 1); in single precision 23 bits of it. */
static inline double rst_tree_number(uint64_t bits, int halvings)
{
    const uint64_t placed = bits << halvings >> 12 | UINT64_C(1023) << 52;
    double number;
    memcpy(&number, &placed, sizeof number);
    return number;
}

static inline double rst_tree_place(uint64_t bits, int halvings)
{
    return rst_tree_number(bits, halvings) - 1;
}

static inline float rst_tree_place_single(uint64_t bits, int halvings)
{
    const uint32_t placed = (uint32_t)(bits << halvings >> 41) | UINT32_C(127) << 23;
    float number;
    memcpy(&number, &placed, sizeof number);
    return number - 1;
}

/* Which halves a coordinate is in, along one axis, in the places of the chain; those of the axes are put together by
 * `or`. */
static inline uint32_t rst_tree_code(const struct rst_tree *t, enum rst_along along, uint64_t bits)
{
    const int half = rst_most_halvings / 2;
    return t->spread[along][0][bits >> (64 - half)] | t->spread[along][1][bits << half >> (64 - half)];
}

/* The same in a tree that has halvings along this axis alone; bits beyond them lead nowhere else. */
static inline uint32_t rst_tree_code_alone(uint64_t bits)
{
    return (uint32_t)(bits >> (64 - rst_deepest));
}

/* Where the ways to leaves begin: as a fan has it, those of the sheets side by side. gamma: in [0, 1) of the octave. */
static inline const int32_t *rst_tree_start(const struct rst_tree *t, int64_t octave, int64_t root, uint64_t gamma)
{
    const int64_t part = (int64_t)(gamma >> 1 >> (63 - t->part_bits)); /* part_bits may be 0 */
    const int64_t at = ((octave * t->of.roots + root) << t->part_bits) + part;
    return &t->start[at * t->of.sheets];
}

/* What is behind the first fan, without a branch: most leaves are behind one, many before it, and which cannot be
 * foreseen. */
static inline int32_t rst_tree_first(const struct rst_tree *t, int32_t start, uint32_t code)
{
    const int32_t is_leaf = start >> 31, behind = t->fan[start & ~is_leaf][code >> (rst_deepest - rst_fan_bits)];
    return (start & is_leaf) | (behind & ~is_leaf);
}

/* Number of the leaf: the rest of the way, when so many fans are behind. */
static inline int64_t rst_tree_rest(const struct rst_tree *t, int32_t next, int fans, uint32_t code)
{
    for (int shift = rst_deepest - (fans + 1) * rst_fan_bits; next >= 0; shift -= rst_fan_bits)
        next = t->fan[next][(code >> shift) & (rst_fan - 1)];
    return ~(int64_t)next;
}

/* Number of a leaf. */
static inline int64_t rst_tree_find(const struct rst_tree *t, int64_t octave, int64_t root, int64_t sheet,
                                    uint64_t gamma, uint32_t code)
{
    return rst_tree_rest(t, rst_tree_start(t, octave, root, gamma)[sheet], 0, code);
}

#endif
