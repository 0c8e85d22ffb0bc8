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

/* Nodes are solved to this part of the tolerance, and checks: their noise must not be taken for a shape. True errors are
 * a quarter of the estimates. */
static const double rst_part_for_nodes = 0.2;
/* A halved cell has this part of the error that its middle showed: smooth ones have 1/16. Of a cell that was halved
 * before what that brought is known; kinks have up to 1/2. */
static const double rst_gain = 0.1, rst_least_gain = 0.06, rst_most_gain = 0.5;
/* What speed and psi may miss each, as a part of the tolerance. The sum leaves room for the solver. */
static const double rst_part_of_axis = 0.35;
/* Stated error over the largest difference of the checks: 10 000 random places find larger ones than the checks do. */
static const double rst_margin = 1.7;
/* Cells that miss more than this part of the worst are compared again at other places, twice. */
static const double rst_look_again = 0.3;
/* Cells are not narrower than this, in s. */
static const double rst_narrowest = 0x1p-10;
/* What refinement leaves of the impacts for the checks. */
static const double rst_for_refining = 0.8;
/* Cells whose error is within this factor of the largest are halved together. */
static const double rst_together = 8;

struct rst_column {
    double speed, at; /* m/s; s */
    struct rst_column_normal normal;
    double *g;       /* at all places of psi */
    double solver;   /* largest estimated error of ex */
    int64_t levels;  /* most that an impact took */
    /* of the cell above: */
    double missed;   /* by how much its parent missed this or the next column */
    double by_speed; /* its estimated error */
    double checked[2]; /* differences in ez and ex of the last check; negative: none yet */
};

/* A column to be solved. */
struct rst_task {
    struct rst_column column;
    int64_t old_stick, old_slip; /* cells of the values that `old` has; 0: none */
    const double *old;
    int may_fail; /* with TOO_MUCH_WORK: its status tells */
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
    double by_psi[2];          /* by how much panels miss at least, from checks */
};

/* A column that takes more levels is costly, as where a sphere hardly rebounds: cells between two of them are left as they
 * are, and they call for no cells of psi. Usual ones take 400 levels at 1e-5, and as the third root of 1/tolerance. */
static inline int rst_is_costly(const struct rst_builder *b, const struct rst_column *c)
{
    return (double)c->levels > 1200 * cbrt(1e-5 / b->options.tolerance);
}

static inline int64_t rst_builder_places(const struct rst_builder *b)
{
    return b->stick + b->slip + 2;
}

/* Solve tasks (solve.c); their columns get values. Fewer impacts are left then. */
int rst_solve_tasks(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* Impacts of n columns. */
int64_t rst_cost(const struct rst_builder *b, int64_t n);

/* Put solved columns in their places; on failure they are released. */
int rst_insert(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* Weights of neighbours for a slope (refine.c). */
enum { rst_most_points = 7 };
struct rst_stencil {
    int64_t first;
    int n;
    double w[rst_most_points];
};

/* Those of up to five columns for the slopes of column i, all on its side of seams. */
void rst_column_stencil(const struct rst_builder *b, int64_t i, struct rst_stencil *s);

/* Slope at i of cells + 1 even values, by i. */
double rst_even_slope(const double *f, int64_t cells, int64_t i);

/* Start, seams and refinement; open cells only. OK also if impacts run out. */
int rst_refine(struct rst_builder *b, restitute_error *error);

/* By how much the cubics of a column may miss in a panel: 0 stick, 1 slip. */
double rst_panel_error(const struct rst_builder *b, const struct rst_column *c, int panel);

/* The table of the columns (make.c). */
int rst_make_table(const struct rst_builder *b, restitute_table **table, restitute_error *error);

/* Compare cells that were not compared yet with fresh impacts; set the errors, and what missed (verify.c). */
int rst_verify(struct rst_builder *b, const restitute_table *table, int round, int *missed, restitute_error *error);

/* One table; the scene and options are checked (builder.c). */
int rst_build(const restitute_scene *scene, const restitute_table_options *options, int threads,
              restitute_table **table, restitute_error *error);
int rst_check_options(const restitute_table_options *options, restitute_error *error);

#endif
