/* The build of a table of patches (table_form.h): one with axes of delta1 and of gamma.
 *
 *   filling    At every node of delta1 and gamma that a cell needs there is a column: impacts at products of Chebyshev points of chi,
 *              of psi and of the slip side. Their numbers, less one, are doubled where the last coefficients are large, column by
 *              column, and old points are among the new.
 *   checking   The table is compared with impacts in every new cell: half way between nodes along delta1, or along gamma, at places of
 *              chi and psi that all columns have, which tells along which of the two a patch must be halved; and in its middle at any
 *              chi and psi. All checks that were ever made are compared with the last table.
 *
 * Columns and checks are in the order of patches and cells, so that the impacts depend on nothing but family and options.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_GRID_H
#define RST_TABLE_GRID_H

#include "builder.h"

/* Directions of the tensor of a column. */
enum rst_inner { RST_BY_CHI, RST_BY_STICK, RST_BY_SLIP, rst_inners };

struct rst_column {
    double delta1, gamma, ez;
    int64_t n[rst_inners]; /* points; 1: no axis; slip: 0 if there is no slip side */
    double goal;           /* that the last coefficients meet */
    double *value;         /* stick [chi][stick], then slip [chi][slip]: what ex exceeds full slip by */
    int pending;           /* points of it are being solved */
};

/* What the build knows of a patch. */
struct rst_region {
    int64_t k[2];
    int checked, failures;
    int along[2], middle; /* nonzero: checks failed */
};

struct rst_check {
    double delta1, gamma, chi, psi;
    int64_t patch;
    int kind; /* 0, 1: half way along delta1, gamma; 2: in the middle */
    struct rst_solved solved;
};

struct rst_grid {
    struct rst_octaves axis[2];
    struct rst_region *region; /* [octave of delta1][octave of gamma] */
    int64_t regions;
    int32_t *column_at; /* by place on the lattice of the finest nodes: 1 + its number, 0: none */
    int64_t lattice[2];
    struct rst_column *column;
    int64_t columns, column_capacity;
    struct rst_check *check;
    int64_t checks, check_capacity, first_new_check;
};

/* Nodes of a patch along an axis on the lattice. */
int64_t rst_grid_at(int64_t octave, int64_t k, int64_t i);

/* Patch that a node on an edge of a patch belongs to as well, if that one has fewer cells along the edge; -1: none.
 * `along`: the axis that the edge runs along. */
int64_t rst_grid_coarser(const struct rst_grid *g, int64_t patch, const int64_t i[2], int *along);

struct rst_column *rst_grid_column(const struct rst_grid *g, int64_t at, int64_t by);

/* The machine's stages (grid.c). Nonzero: a status, or out of memory. */
int rst_grid_create(struct restitute_table_builder *b);
void rst_grid_free(struct rst_grid *g);
int rst_grid_next(struct restitute_table_builder *b, restitute_error *error);

/* Columns (columns.c). */
int rst_columns_start(struct restitute_table_builder *b, struct rst_column *c);
int rst_columns_plan(struct restitute_table_builder *b);
void rst_columns_collect(struct restitute_table_builder *b, int slips);
int rst_columns_lengthen(struct restitute_table_builder *b, int *any);

/* The table from the columns (patches.c). */
int rst_patches_make(struct restitute_table_builder *b, restitute_table **table);

#endif
