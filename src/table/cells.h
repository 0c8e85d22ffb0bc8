/* The build of a table with axes of delta1 and of gamma: trees of cells (tree.h), halved where they need it.
 *
 *   nodes      Impacts at the nodes of all cells of a depth, half way between them on edges, and inside. Where these
 * differ too much from the
 *              polynomial of the cell, it is halved. Along what is the same for all cells of a depth: what most of
 * them ask for. An octave
 *              of gamma is halved along gamma where enough of its cells ask for that.
 *   rebound    First the tree of ez alone; then, with psi_c from that, the tree of ex.
 *   checking   The table is compared with impacts at arbitrary places in every new cell; cells where that fails are
 * halved, too. All checks that
 *              were ever made are compared with the last table.
 *
 * The order of all depends on nothing but family and options.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_CELLS_H
#define RST_TABLE_CELLS_H

#include "builder.h"
#include "nodes.h"
#include "serendipity.h"

enum rst_cell_state {
    RST_TO_JUDGE,  /* its nodes may be missing */
    RST_FAILING,   /* waits for what its octave decides */
    RST_TO_HALVE,  /* waits for the chain */
    RST_SETTLED,   /* a leaf */
    RST_DONE_WITH /* has been halved */
};

/* What a neighbour shifts the nodes by that it shares; 0: none. */
struct rst_pull {
    double by;
    int64_t cell;
};

enum { rst_most_pulls = 3, rst_most_in_vain = 8 };

struct rst_cell {
    struct rst_leaf at;
    double error[rst_cell_axes]; /* what its polynomial misses along its edges */
    double usual, before;        /* a mean of that sum and those of the cells that it is a part of; when it was halved last */
    struct rst_pull pull[rst_most_pulls]; /* larger neighbours that shift its nodes by much, most first */
    int64_t child;               /* the first of its halves; of these there may be but one */
    int8_t state;
    int8_t checked;
    int8_t in_vain; /* halvings on end, along what it asked for, that have not brought that mean down to half */
};

struct rst_check {
    double delta1, gamma, chi, psi;
    double at[rst_cell_axes]; /* on the lattice */
    int64_t cell;             /* a leaf, as long as that is not halved */
    struct rst_solved solved;
};

/* One tree that grows. */
struct rst_growth {
    struct rst_roots of;
    int active[rst_cell_axes]; /* whether a cell has an extent along it */
    struct rst_serendipity of_cell;
    double beyond;             /* cells are made within this factor of the range of delta1 */
    int places_an_axis, places_inside; /* where a cell is compared with impacts */
    double part;               /* of the tolerance, that a cell may be off by where it is compared */
    int8_t chain[rst_deepest];
    int64_t chain_length;
    int8_t *level;  /* [octave][depth]: the finest level of gamma so far; */
    int8_t *closed; /* [octave][depth]: nonzero if there will be no finer one */
    struct rst_cell *cell;
    int64_t count, capacity;
    struct rst_nodes nodes;
};

struct rst_cells {
    struct rst_octaves gamma;
    struct rst_w_axis w;
    struct rst_growth rebound, tangent, *growing; /* one of the two */
    restitute_table *ez;   /* the finished tree of ez, in a table without ex */
    restitute_table *made; /* not compared yet; builder.draft is */
    int broken;            /* a status: the build cannot go on */
    struct rst_check *check;
    int64_t checks, check_capacity, checks_a_cell, drawn;
    int rounds, seam_rounds;
};

/* The machine's stages (cells.c). */
int rst_cells_create(struct restitute_table_builder *b, restitute_error *error);
void rst_cells_free(struct rst_cells *c);
int rst_cells_next(struct restitute_table_builder *b, restitute_error *error);

/* Growth (growth.c). Nonzero: out of memory. */
int rst_growth_begin(struct rst_growth *g, const struct rst_cells *c, const struct restitute_table_builder *b);
void rst_growth_free(struct rst_growth *g);
/* Judge these cells, and halve what fails; nonzero in `more` if there are new ones. */
int rst_growth_judge(struct rst_growth *g, const struct restitute_table_builder *b, int *more);

/* What all cells to be judged need (judge.c), nonzero: out of memory; whether a cell has settled or fails. */
int rst_growth_need(struct rst_growth *g);
void rst_cell_judge(struct rst_growth *g, const struct restitute_table_builder *b, int64_t k);

/* The values at its nodes, which were solved. */
void rst_cell_values(const struct rst_growth *g, const struct rst_leaf *at, double value[rst_most_functions]);

/* A place on the lattice in [0, 1]^4 of a cell. */
void rst_cell_local(const struct rst_growth *g, const struct rst_leaf *cell, const double at[rst_cell_axes],
                    double u[rst_cell_axes]);

/* Its polynomial as its own impacts tell it, before its nodes are put on neighbours'. */
void rst_cell_polynomial(const struct rst_growth *g, const struct rst_leaf *at, double coefficient[rst_most_functions]);

/* A leaf is to be halved, unless that has been in vain: 0. */
int rst_cell_fails(struct rst_cell *cell);
/* Whether any is; `pardon`: and now none is. */
int rst_growth_fails(struct rst_growth *g, int pardon);

/* Corner of a cell and the distance of its nodes on the lattice. */
void rst_cell_place(const struct rst_growth *g, const struct rst_leaf *at, struct rst_spot_on_lattice *corner,
                    int32_t step[rst_cell_axes]);

/* Whether a place on the lattice is in a cell. */
int rst_cell_holds(const struct rst_growth *g, const struct rst_leaf *cell, const double at[rst_cell_axes]);

/* The numbers at a place on the lattice, counted in its steps. Beyond psi = 1 psi follows from y and the table of ez;
 * while that grows it is so large that the contact slips to the end. */
struct rst_place {
    double delta1, gamma, w, chi, psi, y, ez;
};
void rst_cells_numbers(const struct restitute_table_builder *b, const double at[rst_cell_axes],
                       struct rst_place *place);

/* h at a place in [0, 1] of an octave of gamma, as a lookup takes it from the nodes of the octave. */
double rst_cells_h(const struct rst_octaves *gamma, int64_t octave, double place);

/* Whether a place is in what was asked for. */
int rst_cells_asked(const struct restitute_table_builder *b, double delta1, double gamma);

/* Checks (checks.c): in all leaves that have none, nonzero: out of memory; and what comes of all. The table that was
 * compared becomes the draft. */
int rst_checks_plan(struct restitute_table_builder *b);
void rst_checks_compare(struct restitute_table_builder *b);

/* From the trees that have grown to a table (seams.c); the first: of ez alone. Where cells of unlike size touch, the
 * nodes of the smaller one tell what the larger one misses, which may fail then. Nonzero: out of memory. */
int rst_cells_make_rebound(struct restitute_table_builder *b);
int rst_cells_make(struct restitute_table_builder *b, restitute_table **table);

#endif
