/* The build of a table, as a machine that can stop after any impact.
 *
 *   probing    lines of impacts along every axis, at the middle and at the corners of the others, tell how many Chebyshev
 *              points each axis needs; a line that is not resolved is doubled
 *   filling    impacts at all products of these points
 *   checking   the table is made from them, finer and with local polynomials (table_form.h), and compared with impacts
 *              half way between the points in all axes; if the difference is too large: more points, again from filling
 *
 * Every stage has two parts: first the impacts with psi <= 1, then those beyond, whose places depend on e_z through psi_c.
 * All impacts that were solved are kept in the order in which they were asked for, which depends on nothing but the family
 * and the options; a build goes on from them when it is resumed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_BUILDER_H
#define RST_TABLE_BUILDER_H

#include "family.h"

enum rst_axis { RST_SPEED, RST_GAMMA, RST_CHI, RST_STICK, RST_SLIP, rst_axes };
enum rst_stage { RST_PROBING, RST_FILLING, RST_CHECKING, RST_FINISHED };

/* Where an impact is: places in [0, 1] along the axes, of which one of RST_STICK and RST_SLIP counts. */
struct rst_point {
    double u[3];
    double s;          /* psi, or the place t with y = (1 - cos(pi t))/2 */
    int64_t column;    /* of a slip point: the point whose ez gives its psi_c; -1: the table does */
    int slips;
};

/* What came of it. */
struct rst_solved {
    double ez, ex, error_ez, error_ex;
};

struct restitute_table_builder {
    struct rst_family family;
    restitute_table_options options;
    double low[3], high[3]; /* of the axes, outwards to seams of cells; logarithms for speed and gamma */
    double seam_low[2], seam_high[2];
    int active[rst_axes];   /* nonzero: more than one node */
    int64_t n[rst_axes];    /* points */
    int64_t probe[rst_axes];
    enum rst_stage stage;
    int part, rounds;

    struct rst_point *point;
    struct rst_solved *solved;
    int64_t points, capacity, next; /* next: point to be solved */

    struct rst_solved *journal;
    int64_t journal_count, journal_capacity, used;

    restitute_table *draft;
    double tail[rst_axes]; /* size of the last coefficients of the last filling */
    double worst_ez, worst_ex;
};

/* Coordinate [0, 1] -> number along speed, gamma or chi. */
double rst_builder_number(const struct restitute_table_builder *b, enum rst_axis axis, double u);

double rst_y_of_t(double t);

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
