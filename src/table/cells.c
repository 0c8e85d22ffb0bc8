/* The stages of the build of a table of trees (cells.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cells.h"

#include <float.h>
#include <stdlib.h>

/* Parts of the tolerance that the cubics of a cell may miss half way between nodes, all axes together: ez shifts psi_c. */
static const double part_for_rebound = 0.15, part_for_tangent = 0.7;

/* Checks: at least so many in all, and in a cell. Rounds of them that may fail, and tables whose seams may tell before the checks do. */
enum { least_checks = 10000, least_a_cell = 2, most_rounds = 12, most_seam_rounds = 3, most_tries = 200 };

/* A root of log2 w is as wide as the range, but no wider than 2^1 octaves and no narrower than 2^-5. */
enum { widest = 1, narrowest = -5 };

/* Nodes of cells at the ends of the range of delta1 lie outside, no farther than by this factor, since a root spans 2 octaves of w, and an
 * octave of gamma 1 of h; there ez must be known. */
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
    c->rebound.of.sheets = 1;
    c->rebound.active[RST_W] = c->rebound.active[RST_G] = 1;
    c->tangent.part = part_for_tangent;
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

/* As a lookup takes it from the nodes of the octave. */
static double h_of(const struct rst_octaves *gamma, int64_t octave, double place)
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
    p->delta1 = w / h_of(&c->gamma, octave, part);
    p->chi = rst_builder_number(b, RST_CHI, at[RST_C] / rst_lattice);
    p->y = sheet > 1 ? y_of((sheet - 1) / rst_slip_sheets) : 0;
    p->psi = sheet;
    p->ez = 0;
    if (c->growing == &c->rebound || sheet <= 1) return;
    p->ez = rst_table_rebound(c->ez, p->delta1, p->gamma);
    p->psi = 1 + p->y * (restitute_critical_psi(p->chi, p->ez) - 1);
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

/* ---- checks */

static int add_check(struct restitute_table_builder *b, struct rst_check check)
{
    struct rst_cells *c = b->cells;
    if (c->checks == c->check_capacity) {
        const int64_t capacity = c->checks ? 2 * c->checks : 1024;
        struct rst_check *checks = realloc(c->check, (size_t)capacity * sizeof *checks);
        if (!checks) return 1;
        c->check = checks;
        c->check_capacity = capacity;
    }
    const struct rst_point p = {
        .u = {check.delta1, check.gamma, check.chi}, .s = check.psi, .column = -1, .slot = c->checks};
    c->check[c->checks++] = check;
    return rst_plan_add(b, p);
}

/* Additive recurrences of the plastic number's kind for four axes: evenly spread, and no period of the cells. */
static const double spread[rst_cell_axes] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                             0.5385972572236101};

/* An arbitrary place of what was asked for in a cell, number n of all that are drawn; nonzero: there is none at that gamma. */
static int place_in_cell(const struct restitute_table_builder *b, int64_t k, int64_t n, double at[rst_cell_axes])
{
    const struct rst_cells *c = b->cells;
    const double(*range)[2] = b->family.range;
    struct rst_spot_on_lattice corner;
    int32_t step[rst_cell_axes];
    double end[2][rst_cell_axes], log_w[2];
    struct rst_place p[2];
    rst_cell_place(&c->tangent, &c->tangent.cell[k].at, &corner, step);
    for (int a = 0; a < rst_cell_axes; a++) {
        end[0][a] = corner.at[a];
        end[1][a] = corner.at[a] + rst_cubic * step[a];
        at[a] = end[0][a] + (end[1][a] - end[0][a]) * fmod(spread[a] * (double)(n + 1), 1);
    }
    for (int i = 0; i < 2; i++)
        rst_cells_numbers(b, end[i], &p[i]);
    const double low = fmax(range[1][0], p[0].gamma), high = fmin(range[1][1], p[1].gamma);
    const double part = (at[RST_G] - end[0][RST_G]) / (end[1][RST_G] - end[0][RST_G]);
    const double gamma = low + part * (high - low);
    at[RST_G] = end[0][RST_G] + (gamma - p[0].gamma) / (p[1].gamma - p[0].gamma) * (end[1][RST_G] - end[0][RST_G]);
    const int64_t octave = c->tangent.cell[k].at.octave;
    const double h = h_of(&c->gamma, octave, at[RST_G] / rst_lattice - (double)octave);
    for (int i = 0; i < 2; i++) {
        const double of_range = (log2(range[0][i] * h) * c->w.scale - (double)c->w.first) * rst_lattice;
        log_w[i] = i ? fmin(end[i][RST_W], of_range) : fmax(end[i][RST_W], of_range);
    }
    at[RST_W] = log_w[0] + (log_w[1] - log_w[0]) * (at[RST_W] - end[0][RST_W]) / (end[1][RST_W] - end[0][RST_W]);
    return log_w[0] > log_w[1];
}

static int check_cell(struct restitute_table_builder *b, int64_t k)
{
    struct rst_place p;
    for (int64_t i = 0; i < b->cells->checks_a_cell; i++) {
        struct rst_check check = {.cell = k};
        int tries = 0;
        while (place_in_cell(b, k, b->cells->drawn++, check.at) && ++tries < most_tries)
            continue;
        if (tries == most_tries) return 0;
        rst_cells_numbers(b, check.at, &p);
        check.delta1 = p.delta1;
        check.gamma = p.gamma;
        check.chi = p.chi;
        check.psi = p.psi;
        if (add_check(b, check)) return 1;
    }
    return 0;
}

/* How many checks a cell has: known when there are cells. */
static int64_t checks_for(const struct rst_growth *g)
{
    int64_t leaves = 0;
    for (int64_t k = 0; k < g->count; k++)
        leaves += g->cell[k].state == RST_SETTLED;
    const int64_t wanted = least_checks / (leaves > 0 ? leaves : 1) + 1;
    return wanted < least_a_cell ? least_a_cell : wanted;
}

static int plan_checks(struct restitute_table_builder *b)
{
    struct rst_growth *g = &b->cells->tangent;
    rst_plan_begin(b);
    if (b->cells->checks_a_cell == 0) b->cells->checks_a_cell = checks_for(g);
    for (int64_t k = 0; k < g->count; k++) {
        if (g->cell[k].state != RST_SETTLED || g->cell[k].checked) continue;
        g->cell[k].checked = 1;
        if (check_cell(b, k)) return 1;
    }
    return 0;
}

/* The leaf that a check is in now. */
static struct rst_cell *leaf_of(struct rst_growth *g, struct rst_check *check)
{
    while (g->cell[check->cell].state == RST_DONE_WITH) {
        const int64_t child = g->cell[check->cell].child;
        check->cell = rst_cell_holds(g, &g->cell[child].at, check->at) ? child : child + 1;
    }
    return &g->cell[check->cell];
}

/* Largest differences to all impacts of the checks; cells where they are too large fail. */
static void compare(struct restitute_table_builder *b)
{
    struct rst_cells *c = b->cells;
    for (int64_t i = 0; i < b->points; i++)
        c->check[b->point[i].slot].solved = b->solved[i];
    b->worst_ez = b->worst_ex = 0;
    for (int64_t i = 0; i < c->checks; i++) {
        struct rst_check *check = &c->check[i];
        struct rst_cell *cell = leaf_of(&c->tangent, check);
        restitute_table_value pair;
        rst_table_evaluate(c->made, check->delta1, check->gamma, check->chi, check->psi, &pair);
        const double ez = fabs(pair.ez - check->solved.ez) + check->solved.error_ez;
        const double ex = fabs(pair.ex - check->solved.ex) + check->solved.error_ex;
        b->worst_ez = fmax(b->worst_ez, ez);
        b->worst_ex = fmax(b->worst_ex, ex);
        if (ex <= b->options.tolerance) continue;
        rst_cell_fails(cell);
        if (cell->pulled > 0) rst_cell_fails(&c->tangent.cell[cell->puller]);
    }
    restitute_table_destroy(b->draft);
    b->draft = c->made;
    b->draft->checks = c->checks;
    c->made = NULL;
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
    if (rst_growth_begin(&b->cells->tangent, b->cells, b)) return out_of_memory(error);
    return begin_filling(b, error);
}

static int begin_checking(struct restitute_table_builder *b, restitute_error *error)
{
    b->stage = RST_CHECKING;
    return plan_checks(b) ? out_of_memory(error) : within_limit(b, error);
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
    compare(b);
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
