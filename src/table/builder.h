/* The build of a table.
 *
 *   start     a few columns over the speeds; a seam where rebound begins
 *   refine    a new column halves every cell whose cubics miss it; both panels of psi are doubled where columns say so
 *   verify    the table is compared with impacts at other places; where it misses, refine again
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_BUILDER_H
#define RST_TABLE_BUILDER_H

#include "column.h"

/* Constants of the build, measured with the target table-campaign (docs/table.md). */

/* Nodes are solved to this part of the tolerance, and checks: their noise must not be taken for a shape. 0.3 adds columns. */
static const double rst_part_for_nodes = 0.1;
/* A halved cell has at most this part of the error that its middle showed. Smooth ones have 1/16, kinks 1/4. */
static const double rst_gain = 0.1;
/* What speed and psi may miss each, as a part of the tolerance. The sum leaves room for the solver. */
static const double rst_part_of_axis = 0.35;
/* Stated error over the largest difference of the checks: 10 000 random places find larger ones than the checks do. */
static const double rst_margin = 1.5;
/* Cells are not narrower than this, in s. */
static const double rst_narrowest = 0x1p-10;
/* What refinement leaves of the impacts for the checks. */
static const double rst_part_for_refining = 0.75;

struct rst_column {
    double speed, at; /* m/s; s */
    struct rst_column_normal normal;
    double *g;       /* at all places of psi */
    double solver;   /* largest estimated error of ex */
    double by_speed; /* estimated error of the cell above */
    int open;        /* that cell is to be halved */
};

/* A column to be solved. */
struct rst_task {
    struct rst_column column;
    int64_t old_stick, old_slip; /* cells of the values that `old` has; 0: none */
    const double *old;
    int status;
    restitute_error why;
};

struct rst_builder {
    struct rst_contact contact;
    restitute_table_options options;
    struct rst_column *column;
    int64_t columns, room;
    int64_t stick, slip; /* cells of psi */
    struct rst_column_solver *solver; /* one a thread */
    int threads;
    int64_t impacts, checks;
    double error_ez, error_ex; /* of the last verification */
};

static inline int64_t rst_builder_places(const struct rst_builder *b)
{
    return b->stick + b->slip + 2;
}

/* psi at a place of a column, and how many places are solved for (solve.c). */
double rst_psi_at(const struct rst_builder *b, int64_t place, double ez);

/* Solve tasks; their columns get values. Fewer impacts are left then. */
int rst_solve_tasks(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* Impacts of n columns. */
int64_t rst_cost(const struct rst_builder *b, int64_t n);

/* Put solved columns in their places; on failure they are released. */
int rst_insert(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* Weights of five neighbouring nodes for a derivative (refine.c). */
struct rst_stencil {
    int64_t first;
    int n;
    double w[5];
};
void rst_stencil_at(const double *at, int64_t low, int64_t high, int64_t i, struct rst_stencil *s);

/* Start, seams and refinement; open cells only. OK also if impacts run out. */
int rst_refine(struct rst_builder *b, restitute_error *error);

/* Twice the cells of psi of a panel: 0 stick, 1 slip. */
int rst_double_panel(struct rst_builder *b, int panel, restitute_error *error);

/* By how much the cubics of a column may miss in a panel. */
double rst_panel_error(const struct rst_builder *b, const struct rst_column *c, int panel);

/* The table of the columns (make.c). */
int rst_make_table(const struct rst_builder *b, restitute_table **table, restitute_error *error);

/* Compare with fresh impacts, set the errors; `missed`: number of cells opened or panels doubled (verify.c). */
int rst_verify(struct rst_builder *b, const restitute_table *table, int round, int *missed, restitute_error *error);

/* One table; the scene and options are checked (builder.c). */
int rst_build(const restitute_scene *scene, const restitute_table_options *options, int threads,
              restitute_table **table, restitute_error *error);
int rst_check_options(const restitute_table_options *options, restitute_error *error);

#endif
