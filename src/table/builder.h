/* The build of a table.
 *
 *   start     a few columns over the speeds; a seam where rebound begins
 *   refine    where the cubics have too large an error, a new column halves a cell; each column has as
 *             many places of psi as it needs
 *   verify    compare the table with impacts at other places; refine again where the error is too large
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_BUILDER_H
#define RST_TABLE_BUILDER_H

#include "base/parallel.h"
#include "table/column.h"

/* Constants of the build, measured with the target table-campaign (docs/records/table.md). */

/* Nodes and checks are solved to this share of the tolerance, so that their errors are not taken
 * for a shape of the function. True errors are a quarter of the estimates. */
static const double rst_part_for_nodes = 0.3;
/* Allowed errors along the speed and along psi, as shares of the tolerance. The rest is for the
 * solver. */
static const double rst_part_of_axis = 0.4;

/* Speed. Expected error of a halved cell over the error found at its midpoint: a smooth function
 * has 1/16, a kink up to 1/2. For cells that were halved before, the ratio found then is used. */
static const double rst_gain = 0.0625, rst_least_gain = 0.03, rst_most_gain = 0.5;
/* Cells whose error is within the first factor of the largest are halved together. Cells are not
 * narrower than the second number, in s. */
static const double rst_together = 8, rst_narrowest = 0x1p-10;

/* psi. First cells at a tolerance of 1e-5: the error of the cubics is then 3e-6, unless e_x has a
 * fold. A fold, where the slope jumps, would need any number: there are at most `finest` times the
 * first. A column is finished when the cubics agree with `probes` midpoints in a row: two at the
 * ends, three elsewhere. With three in all, folds were missed. `last_probes` midpoints of the
 * finest cells are solved. Their largest difference is the remaining error along psi. */
enum { rst_first_stick = 12, rst_first_slip = 44, rst_finest = 4, rst_probes = 5, rst_last_probes = 3 };

/* Checks. Refinement may take this share of the impacts, and of the time. */
static const double rst_for_refining = 0.8;
/* Stated error over the largest difference of the checks, since 10 000 random places find larger
 * differences than the checks do. */
static const double rst_margin = 1.7;
/* Number of places of a check where the values of the table suggest the largest error of the
 * cubics. With four, a random solid exceeded its stated error by 1.4; with six it does not. */
enum { rst_doubtful = 6 };
/* Cells with more than this share of the largest error are compared again around their worst
 * places, `looks` times in all. Refinement and checks alternate up to `rounds` times. */
static const double rst_look_again = 0.7;
enum { rst_looks = 3, rst_rounds = 6 };

/* psi has two panels: 0 stick, 1 slip; x in [0, 1]. */
struct rst_place {
    int panel;
    double x;
};

struct rst_column {
    double speed, at; /* m/s; s */
    struct rst_column_normal normal;
    int64_t cells[2];
    double *g[2];    /* [cells + 1] */
    double solver;   /* largest estimated error of ex */
    double by_psi;   /* error of its cubics, if it has the largest number of cells; else 0 */
    int64_t impacts; /* that it took */
    /* of the cell above: */
    double missed;   /* error of the cubics of its parent cell at this or the next column */
    double by_speed; /* its estimated error */
    double checked[2]; /* differences in ez and ex of the last check; negative: none yet */
    struct rst_place worst; /* of ex */
};

/* A column to be solved. */
struct rst_task {
    struct rst_column column;
    int may_fail; /* with TOO_MUCH_WORK or CONVERGENCE in its status: where there is a column on both sides */
    int status;
    restitute_error why;
};

struct rst_builder {
    struct rst_contact contact;
    restitute_table_options options;
    struct rst_column *column;
    int64_t columns, room;
    double began;               /* of rst_table_clock() */
    int64_t first[2], cells[2]; /* of psi: at first, and of all columns */
    struct rst_column_solver *solver; /* one a thread */
    int threads;
    int64_t impacts, checks;
    double error_ez, error_ex; /* of the last verification */
};

/* Solve tasks (solve.c); their columns get values. Fewer impacts are left then. */
int rst_solve_tasks(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* Least number of impacts of n columns. */
int64_t rst_cost(const struct rst_builder *b, int64_t n);

/* Put solved columns in their places; on failure they are released. */
int rst_insert(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error);

/* A column of zeros. */
int rst_column_create(const struct rst_builder *b, struct rst_column *c);
void rst_column_destroy(struct rst_column *c);

/* psi at x in [0, 1] of a panel. */
double rst_psi_at(const struct rst_builder *b, int panel, double x, double ez);

/* Slope at node i of n by the polynomial through the nodes around it (panel.c). */
enum { rst_most_points = 7 };
struct rst_stencil {
    int64_t first;
    int n;
    double w[rst_most_points];
};
void rst_find_stencil(const double *at, int64_t n, int64_t i, struct rst_stencil *s);

/* The same along the columns, all on the same side of a seam as column i (refine.c). */
void rst_column_stencil(const struct rst_builder *b, int64_t i, struct rst_stencil *s);

/* Slope at i of cells + 1 even values, by i. */
double rst_even_slope(const double *f, int64_t cells, int64_t i);

/* A panel of a column that is being solved. */
struct rst_panel {
    const struct rst_builder *b;
    struct rst_column_solver *solver;
    struct rst_task *task;
    int panel;
    double missed; /* of the last cubics, in e_x; may be too large if the number of cells is the largest */
};

/* g at x in [0, 1]. */
int rst_panel_solve(const struct rst_panel *p, double x, double *g);

/* Halve the cells until the cubics agree with the solved midpoints of the most doubtful cells.
 * Other midpoints are filled by polynomials of degree 7. */
int rst_panel_refine(struct rst_panel *p);

/* Halve the cells once, all by polynomials. */
int rst_panel_fill(double **g, int64_t *cells);

/* Start, seams and refinement; open cells only. OK also if impacts run out. */
int rst_refine(struct rst_builder *b, restitute_error *error);

/* The part of the stated error between columns i and i + 1 that finer cells of speed cannot
 * reduce. */
double rst_left_by_psi(const struct rst_builder *b, int64_t i);

/* The table of the columns (make.c). */
int rst_make_table(const struct rst_builder *b, restitute_table **table, restitute_error *error);

/* Compare cells that were not compared yet with new impacts. Set the errors and mark cells with too
 * large ones (verify.c). */
int rst_verify(struct rst_builder *b, const restitute_table *table, int round, int *missed, restitute_error *error);

/* Time of day, in s (refine.c). */
double rst_table_clock(void);

/* ---- all of it */

/* One table; the scene is checked, the options were (builder.c). */
int rst_build(const restitute_scene *scene, const restitute_table_options *options, int threads,
              restitute_table **table, restitute_error *error);

/* The caller's options, with defaults for what they have not (NULL: for all), and checked. */
int rst_table_take_options(const restitute_table_options *theirs, restitute_table_options *ours,
                           restitute_error *error);

#endif
