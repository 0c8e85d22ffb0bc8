/* The impacts at the nodes of a tree that is being built, found again by their places.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_NODES_H
#define RST_TABLE_NODES_H

#include <stdint.h>

/* Axes of a cell. */
enum rst_cell_axis { RST_W, RST_G, RST_C, RST_P, rst_cell_axes };

/* Steps of the lattice of all nodes and half ways between them in a root, along any axis. */
enum { rst_lattice = 1 << 15 };

/* Counted from the start of the first root, octave, range of chi, sheet. */
struct rst_spot_on_lattice {
    int32_t at[rst_cell_axes];
};

struct rst_lattice_node {
    struct rst_spot_on_lattice spot;
    double value;
};

struct rst_nodes {
    struct rst_lattice_node *node;
    int64_t count, capacity, solved; /* those before `solved` are */
    int32_t *slot;                   /* 1 + number, 0: empty */
    int64_t slots;                   /* a power of 2, or 0 */
};

/* Number of the node at a place, which is new if there was none; -1: out of memory. */
int64_t rst_nodes_need(struct rst_nodes *nodes, struct rst_spot_on_lattice spot);

/* The value at a place that was needed. */
double rst_nodes_value(const struct rst_nodes *nodes, struct rst_spot_on_lattice spot);

/* The numbers of those that are not solved, in an order in which impacts on one solid follow each other; to be freed.
 * NULL: out of memory. */
int64_t *rst_nodes_new(const struct rst_nodes *nodes);

void rst_nodes_clear(struct rst_nodes *nodes);

#endif
