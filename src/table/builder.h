/* The build of a table, as a machine that can stop after any impact.
 *
 *   probing    lines of impacts along every axis, at the middle and at the corners of the others, tell how many
 * Chebyshev
 *              points each axis needs; a line that is not resolved is doubled
 *   filling    impacts at all products of these points
 *   checking   the table is made from them, finer and with local polynomials (table_form.h), and compared with impacts
 *              half way between the points in all axes, and in the middles of some of its cells; if the difference is
 * too large: panels are halved or get more points,
 *              and what is not yet known is filled in
 *
 * Every stage has two parts: first the impacts with psi <= 1, then those beyond, whose places depend on e_z through
 * psi_c. All impacts that were solved are kept in the order in which they were asked for, which depends on nothing but
 * the family and the options; a build goes on from them when it is resumed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_BUILDER_H
#define RST_TABLE_BUILDER_H

#include "family.h"

enum rst_axis { RST_SPEED, RST_GAMMA, RST_CHI, RST_STICK, RST_SLIP, rst_axes };
enum rst_stage { RST_PROBING, RST_FILLING, RST_CHECKING, RST_FINISHED };

enum { rst_most_points = 1025, rst_most_panels = 128, rst_most_cell_checks = 24 };

/* An axis in [0, 1], cut at its edges; each panel has n points, those at seams shared. */
struct rst_panels {
    int count;
    double edge[rst_most_panels + 1];
    int64_t n[rst_most_panels];
};

void rst_panels_one(int64_t n, struct rst_panels *p);
int64_t rst_panels_points(const struct rst_panels *p);
void rst_panels_nodes(const struct rst_panels *p, double *x);
int64_t rst_panels_half_ways(const struct rst_panels *p, double *x);
int rst_panels_find(const struct rst_panels *p, double x);
void rst_panels_rows(const struct rst_panels *p, int64_t m, const double *place, double *row);
void rst_panels_last(const struct rst_panels *p, int panel, double *row);
int rst_panels_halve(struct rst_panels *p, int panel);

/* Where an impact is: places in [0, 1] along the axes, of which one of RST_STICK and RST_SLIP counts. */
struct rst_point {
    double u[3];
    double s;       /* psi, or the place t with y = (1 - cos(pi t))/2 */
    int64_t column; /* of a slip point: the point whose ez gives its psi_c; -1: the table does */
    int64_t slot;   /* cells.h: which node or check; u and s are the numbers themselves */
    int later; /* solved in the second part of a stage: it slips and needs an ez */
    int known; /* solved in an earlier round */
};

/* What came of it. */
struct rst_solved { /* as in the journal */
    double ez, ex, error_ez, error_ex;
};

/* Results of earlier rounds, found again by their places. */
struct rst_memo {
    struct rst_memory *slot;
    int64_t size, used; /* size: a power of 2, or 0 */
};

/* Nonzero: out of memory (memo.c). */
int rst_memo_add(struct rst_memo *memo, int stage, const struct rst_point *p, const struct rst_solved *s);
int rst_memo_find(const struct rst_memo *memo, int stage, const struct rst_point *p, struct rst_solved *s);
void rst_memo_clear(struct rst_memo *memo);

struct restitute_table_builder {
    struct rst_family family;
    restitute_table_options options;
    double low[3], high[3]; /* of the axes, outwards to seams of cells; logarithms for speed and gamma */
    double seam_low[2], seam_high[2];
    int active[rst_axes]; /* nonzero: more than one node */
    int64_t n[rst_axes];  /* points */
    struct rst_panels panels[rst_axes];
    int64_t probe[rst_axes];
    int begun; /* 0: a call failed, and the next one begins anew from the journal */
    enum rst_stage stage;
    int part, rounds, stagnant; /* stagnant: rounds on end that brought little */

    struct rst_point *point;
    struct rst_solved *solved;
    int64_t points, capacity, next; /* next: point to be solved */

    struct rst_solved *journal;
    int64_t journal_count, journal_capacity, used;

    restitute_table *draft;
    double tail[rst_axes];                 /* size of the last coefficients of the last filling */
    double panel_tail[2][rst_most_panels]; /* the same for panels of speed and gamma */
    int failing[2][rst_most_panels];       /* panels in which a check failed */
    double filling_tolerance, later_tolerance; /* of the first part, and of the second */
    struct rst_memo memo;
    struct rst_cells *cells; /* NULL: no table of trees */
    double worst_ez, worst_ex;
};

/* Coordinate [0, 1] -> number along speed, gamma or chi. */
double rst_builder_number(const struct restitute_table_builder *b, enum rst_axis axis, double u);

double rst_y_of_t(double t);

/* t with y = (1 - cos(pi t))/2 where r(y), or turned r(1 - y), is r (draft.c). */
double rst_t_of_root(double r, int turned);

/* Append a point to be solved (plan.c), or forget all points; nonzero: out of memory. */
int rst_plan_add(struct restitute_table_builder *b, struct rst_point point);
void rst_plan_begin(struct restitute_table_builder *b);

/* Points of a stage (plan.c); nonzero: out of memory. */
int rst_plan_probes(struct restitute_table_builder *b);
int rst_plan_filling(struct restitute_table_builder *b);
int rst_plan_checks(struct restitute_table_builder *b);

/* Orders from the probes; nonzero if all lines are resolved, else those that are not are doubled (plan.c). */
int rst_read_probes(struct restitute_table_builder *b, int *resolved);

/* The table from the filling (draft.c). */
int rst_make_draft(struct restitute_table_builder *b, restitute_error *error);

/* ex of full slip (27), and psi at a slip point. */
double rst_full_slip(double chi, double ez, double psi);

#endif
