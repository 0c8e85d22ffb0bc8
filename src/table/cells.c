/* The stages of the build of a table of trees (cells.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cells.h"

#include <float.h>
#include <stdlib.h>

/* Parts of the tolerance that the polynomial of a cell may miss where it is compared with impacts, all axes together:
 * ez shifts psi_c. */
static const double part_for_rebound = 0.15, part_for_tangent = 0.8;

/* Impacts at nodes are solved to these parts of the tolerance: cells are halved where a few impacts miss, and the
 * solver's errors, which are up to several times its estimates in a few corners, must not be taken for that. */
static const double part_for_rebound_nodes = 0.03, part_for_nodes = 0.3;

/* A cell is compared with impacts at so many places: on its edges along each axis, and inside. The tree of ez has few
 * cells, and that of ex rests on it. */
enum { rebound_along = 8, rebound_inside = 12, tangent_along = 4, tangent_inside = 8 };

/* Rounds of checks that may fail, and tables whose seams may tell before the checks do. */
enum { most_rounds = 12, most_seam_rounds = 2 };

/* A root of log2 w is as wide as the range, but no wider than 2^1 octaves and no narrower than 2^-5. */
enum { widest = 1, narrowest = -5 };

/* Nodes of cells at the ends of the range of delta1 lie outside, no farther than by this factor, since a root spans 2
 * octaves of w, and an octave of gamma 1 of h; there ez must be known. */
static const double beyond_range = 8;

static int64_t width_of(const double range[2])
{
    const double octaves = log2(range[1] / range[0]);
    int64_t width = widest;
    while (width > narrowest && ldexp(1, (int)width) > octaves)
        width--;
    return width;
}

/* log2 w must be a number at all nodes. */
static int check_range(const struct restitute_table_builder *b, restitute_error *error)
{
    const double(*range)[2] = b->family.range;
    const double low = range[0][0] / beyond_range * rst_table_h(b->seam_low[1]);
    const double high = range[0][1] * beyond_range * rst_table_h(b->seam_high[1]);
    if (low >= DBL_MIN && high <= DBL_MAX) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "delta1 in [%g, %g], gamma in [%g, %g]: delta1 gamma^0.56 (1 + gamma)^0.44 must be in [%.0e, %.0e]",
                      range[0][0], range[0][1], range[1][0], range[1][1], beyond_range * DBL_MIN,
                      DBL_MAX / beyond_range);
}

/* Values are kept in single precision. */
static const double least_tolerance = 1e-6;

static int out_of_memory(restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
}

int rst_cells_create(struct restitute_table_builder *b, restitute_error *error)
{
    const int status = check_range(b, error);
    if (status) return status;
    if (b->options.tolerance < least_tolerance)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "tolerance = %g: must be in [1e-06, 0.1] for a table with axes of delta1 and gamma",
                          b->options.tolerance);
    struct rst_cells *c = calloc(1, sizeof *c);
    b->cells = c;
    if (!c) return out_of_memory(error);
    rst_octaves_set(b->seam_low[1], b->seam_high[1], 0, &c->gamma);
    const double *range = b->family.range[0];
    rst_w_axis_set(range[0] / beyond_range, range[1] * beyond_range, &c->gamma, width_of(range), &c->w);
    c->growing = &c->rebound;
    c->rebound.beyond = beyond_range;
    c->tangent.beyond = 1;
    c->rebound.part = part_for_rebound;
    c->rebound.places_an_axis = rebound_along;
    c->rebound.places_inside = rebound_inside;
    c->rebound.of.sheets = 1;
    c->rebound.active[RST_W] = c->rebound.active[RST_G] = 1;
    b->filling_tolerance = b->later_tolerance = part_for_rebound_nodes * b->options.tolerance;
    c->tangent.part = part_for_tangent;
    c->tangent.places_an_axis = tangent_along;
    c->tangent.places_inside = tangent_inside;
    c->tangent.of.sheets = rst_sheets;
    for (int a = 0; a < rst_cell_axes; a++)
        c->tangent.active[a] = a != RST_C || b->active[RST_CHI];
    return rst_growth_begin(&c->rebound, c, b) ? out_of_memory(error) : RESTITUTE_OK;
}

void rst_cells_free(struct rst_cells *c)
{
    if (!c) return;
    rst_growth_free(&c->rebound);
    rst_growth_free(&c->tangent);
    restitute_table_destroy(c->ez);
    restitute_table_destroy(c->made);
    free(c->check);
    free(c);
}

/* ---- places */

/* y at t in [0, 1] of the slip side. */
static double y_of(double t)
{
    const double y = rst_slip_y((t <= 0.5 ? t : 1 - t) * 2 * rst_largest_r);
    return t <= 0.5 ? y : 1 - y;
}

double rst_cells_h(const struct rst_octaves *gamma, int64_t octave, double place)
{
    double weight[4], h = 0;
    rst_cubic_weights(place * rst_cubic, weight);
    for (int i = 0; i < 4; i++)
        h += weight[i] * rst_table_h(rst_octaves_node(gamma, octave * rst_cubic + i));
    return h;
}

void rst_cells_numbers(const struct restitute_table_builder *b, const double at[rst_cell_axes], struct rst_place *p)
{
    const struct rst_cells *c = b->cells;
    const double g = at[RST_G] / rst_lattice, sheet = at[RST_P] / rst_lattice;
    int64_t octave = (int64_t)g;
    if (octave == c->gamma.cells) octave--;
    const double start = rst_octaves_node(&c->gamma, octave * rst_cubic), part = g - (double)octave;
    const double w = exp2(((double)c->w.first + at[RST_W] / rst_lattice) / c->w.scale);
    p->gamma = start * (1 + part);
    p->delta1 = w / rst_cells_h(&c->gamma, octave, part);
    p->chi = rst_builder_number(b, RST_CHI, at[RST_C] / rst_lattice);
    p->y = sheet > 1 ? y_of((sheet - 1) / rst_slip_sheets) : 0;
    p->psi = sheet;
    p->w = w;
    p->ez = 0;
    if (c->growing == &c->rebound) return;
    p->ez = rst_table_rebound(c->ez, p->delta1, p->gamma);
    if (sheet > 1) p->psi = 1 + p->y * (restitute_critical_psi(p->chi, p->ez) - 1);
}

int rst_cells_asked(const struct restitute_table_builder *b, double delta1, double gamma)
{
    const double(*range)[2] = b->family.range;
    return delta1 >= range[0][0] && delta1 <= range[0][1] && gamma >= range[1][0] && gamma <= range[1][1];
}

/* ---- nodes */

static struct rst_place numbers_at(const struct restitute_table_builder *b, const struct rst_lattice_node *node)
{
    struct rst_place p;
    const int32_t *at = node->spot.at;
    rst_cells_numbers(b, (double[]){at[0], at[1], at[2], at[3]}, &p);
    return p;
}

/* Far beyond psi_c: the normal problem alone. */
static const double full_slip_psi = 1e9;

static int add_node(struct restitute_table_builder *b, struct rst_growth *g, int64_t number)
{
    struct rst_lattice_node *node = &g->nodes.node[number];
    const struct rst_place p = numbers_at(b, node);
    if (g == &b->cells->tangent && p.y >= 1 && 2 * p.chi > 1) {
        node->value = 0; /* psi_c */
        return 0;
    }
    const struct rst_point point = {.u = {p.delta1, p.gamma, p.chi},
                                    .s = g == &b->cells->rebound ? full_slip_psi : p.psi,
                                    .column = -1,
                                    .slot = number};
    return rst_plan_add(b, point);
}

static int plan_nodes(struct restitute_table_builder *b)
{
    struct rst_growth *g = b->cells->growing;
    int failed = 0;
    rst_plan_begin(b);
    if (rst_growth_need(g)) return 1;
    int64_t *number = rst_nodes_new(&g->nodes);
    for (int64_t i = 0; number && i < g->nodes.count - g->nodes.solved && !failed; i++)
        failed = add_node(b, g, number[i]);
    free(number);
    return failed || !number;
}

static void collect_nodes(struct restitute_table_builder *b)
{
    struct rst_growth *g = b->cells->growing;
    for (int64_t i = 0; i < b->points; i++) {
        struct rst_lattice_node *node = &g->nodes.node[b->point[i].slot];
        const struct rst_place p = numbers_at(b, node);
        if (g == &b->cells->rebound)
            node->value = fmin(1, fmax(0, b->solved[i].ez));
        else
            node->value = p.y > 0 ? p.psi * b->solved[i].ex - p.y * p.ez : b->solved[i].ex;
    }
    g->nodes.solved = g->nodes.count;
}

/* ---- stages */

static int finish(struct restitute_table_builder *b)
{
    rst_plan_begin(b);
    b->stage = RST_FINISHED;
    return RESTITUTE_OK;
}

/* Whether what is planned may be solved. If not, the last table that was compared is all there will be. */
static int within_limit(struct restitute_table_builder *b, restitute_error *error)
{
    if (b->used + b->points <= b->options.max_impacts) return RESTITUTE_OK;
    if (b->draft) return finish(b);
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "max_impacts = %lld: the table needs more after the %lld solved; raise it or the tolerance, "
                      "or narrow the ranges",
                      (long long)b->options.max_impacts, (long long)b->used);
}

static int begin_filling(struct restitute_table_builder *b, restitute_error *error)
{
    b->stage = RST_FILLING;
    return plan_nodes(b) ? out_of_memory(error) : within_limit(b, error);
}

static int begin_tangent(struct restitute_table_builder *b, restitute_error *error)
{
    b->filling_tolerance = b->later_tolerance = part_for_nodes * b->options.tolerance;
    if (rst_growth_begin(&b->cells->tangent, b->cells, b)) return out_of_memory(error);
    return begin_filling(b, error);
}

static int begin_checking(struct restitute_table_builder *b, restitute_error *error)
{
    b->stage = RST_CHECKING;
    return rst_checks_plan(b) ? out_of_memory(error) : within_limit(b, error);
}

/* The table of a tree that has grown; nonzero in `more` if seams have told that it must go on growing. */
static int make(struct restitute_table_builder *b, int *more)
{
    struct rst_cells *c = b->cells;
    struct rst_growth *g = c->growing;
    restitute_table *table = NULL;
    if (g == &c->rebound ? rst_cells_make_rebound(b) : rst_cells_make(b, &table)) return 1;
    if (table) {
        restitute_table_destroy(c->made);
        c->made = table;
    }
    const int enough = c->seam_rounds++ >= most_seam_rounds;
    return rst_growth_fails(g, enough) && !enough ? rst_growth_judge(g, b, more) : 0;
}

static int after_filling(struct restitute_table_builder *b, restitute_error *error)
{
    struct rst_cells *c = b->cells;
    int more = 0;
    collect_nodes(b);
    if (rst_growth_judge(c->growing, b, &more)) return out_of_memory(error);
    if (!more && make(b, &more)) return out_of_memory(error);
    if (more) return begin_filling(b, error);
    if (c->growing == &c->tangent) return begin_checking(b, error);
    c->growing = &c->tangent;
    c->seam_rounds = 0;
    return begin_tangent(b, error);
}

static int after_checking(struct restitute_table_builder *b, restitute_error *error)
{
    struct rst_growth *g = &b->cells->tangent;
    int more = 0;
    rst_checks_compare(b);
    if (!rst_growth_fails(g, 0) || b->cells->rounds++ >= most_rounds) return finish(b);
    if (rst_growth_judge(g, b, &more)) return out_of_memory(error);
    return more ? begin_filling(b, error) : finish(b);
}

static int go_on(struct restitute_table_builder *b, restitute_error *error)
{
    switch (b->stage) {
    case RST_PROBING:
        return begin_filling(b, error);
    case RST_CHECKING:
        return after_checking(b, error);
    default:
        return after_filling(b, error);
    }
}

/* A stage that failed has left things half done. */
int rst_cells_next(struct restitute_table_builder *b, restitute_error *error)
{
    struct rst_cells *c = b->cells;
    if (c->broken)
        return rst_report(error, c->broken, "builder: a stage has failed before; destroy it and begin with a new one");
    c->broken = go_on(b, error);
    if (c->broken) rst_plan_begin(b);
    return c->broken;
}
