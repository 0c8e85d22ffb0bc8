/* Where a table needs more nodes (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

#include <stdlib.h>

/* Derivative at node i of the polynomial through the five nodes of [low, high] around it. */
void rst_stencil_at(const double *at, int64_t low, int64_t high, int64_t i, struct rst_stencil *s)
{
    const int64_t most = high - low + 1;
    s->n = most < 5 ? (int)most : 5;
    s->first = i - 2 < low ? low : i - 2;
    if (s->first + s->n - 1 > high) s->first = high - s->n + 1;
    const double *x = at + s->first;
    const int here = (int)(i - s->first);
    for (int j = 0; j < s->n; j++) {
        double w = j == here ? 0 : 1 / (x[j] - x[here]);
        for (int k = 0; k < s->n; k++) {
            if (k == here || k == j) continue;
            w = j == here ? w : w * (x[here] - x[k]) / (x[j] - x[k]);
        }
        for (int k = 0; j == here && k < s->n; k++)
            if (k != here) w += 1 / (x[here] - x[k]);
        s->w[j] = w;
    }
}

/* ---- psi */

static double even_slope(const double *f, int64_t n, int64_t i)
{
    static const double place[5] = {0, 1, 2, 3, 4};
    const int64_t first = i - 2 < 0 ? 0 : i + 2 > n ? n - 4 : i - 2;
    struct rst_stencil s;
    rst_stencil_at(place, 0, 4, i - first, &s);
    double sum = 0;
    for (int j = 0; j < 5; j++)
        sum += s.w[j] * f[2 * (first + j)];
    return sum;
}

/* Every other node leaves out how much? Half the grid misses that, and the grid itself a part of it. */
double rst_panel_error(const struct rst_builder *b, const struct rst_column *c, int panel)
{
    const double *f = c->g + (panel ? b->stick + 1 : 0);
    const int64_t n = (panel ? b->slip : b->stick) / 2;
    double worst = 0;
    if (n < 4) return 0;
    for (int64_t i = 0; i < n; i++) {
        const double low = even_slope(f, n, i), high = even_slope(f, n, i + 1);
        const double middle = 0.5 * (f[2 * i] + f[2 * i + 2]) + 0.125 * (low - high);
        worst = fmax(worst, fabs(middle - f[2 * i + 1]));
    }
    return rst_gain * worst;
}

int rst_double_panel(struct rst_builder *b, int panel, restitute_error *error)
{
    const int64_t stick = b->stick, slip = b->slip;
    struct rst_task *task = calloc((size_t)b->columns, sizeof *task);
    if (!task) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the columns");
    for (int64_t i = 0; i < b->columns; i++)
        task[i] = (struct rst_task){
            .column = b->column[i], .old = b->column[i].g, .old_stick = stick, .old_slip = slip};
    *(panel ? &b->slip : &b->stick) *= 2;
    const int status = rst_solve_tasks(b, b->columns, task, error);
    if (status) {
        b->stick = stick;
        b->slip = slip;
    }
    for (int64_t i = 0; i < b->columns && !status; i++) {
        free(b->column[i].g);
        b->column[i] = task[i].column;
    }
    b->impacts += b->columns * (panel ? slip : stick);
    free(task);
    return status;
}

static int64_t left(const struct rst_builder *b)
{
    return (int64_t)(rst_part_for_refining * (double)b->options.max_impacts) - b->impacts;
}

/* Double panels that some column misses. */
static int refine_panels(struct rst_builder *b, restitute_error *error)
{
    const int64_t most[2] = {256, rst_most_cells / 2};
    if (b->contact.sliding != RST_SLIDES) return RESTITUTE_OK;
    for (int panel = 0; panel < 2; panel++) {
        int64_t *cells = panel ? &b->slip : &b->stick;
        while (*cells <= most[panel] && b->columns * *cells <= left(b)) {
            double worst = 0;
            for (int64_t i = 0; i < b->columns; i++)
                worst = fmax(worst, rst_panel_error(b, &b->column[i], panel));
            if (worst <= rst_part_of_axis * b->options.tolerance) break;
            const int status = rst_double_panel(b, panel, error);
            if (status) return status;
        }
    }
    return RESTITUTE_OK;
}

/* ---- speed */

/* Nodes on the same side of seams. */
static void segment(const double *at, int64_t n, int64_t i, int64_t *low, int64_t *high)
{
    for (*low = i; *low > 0 && at[*low - 1] < at[*low]; --*low)
        ;
    for (*high = i; *high < n - 1 && at[*high + 1] > at[*high]; ++*high)
        ;
}

/* By how much the cubics of the cell above column i miss a new column in it. */
static double miss(const struct rst_builder *b, const double *at, int64_t i, const struct rst_column *c)
{
    int64_t low, high;
    struct rst_stencil s[2];
    double x[4], worst;
    segment(at, b->columns, i, &low, &high);
    if (at[i] >= at[i + 1]) return 0;
    rst_stencil_at(at, low, high, i, &s[0]);
    rst_stencil_at(at, low, high, i + 1, &s[1]);
    const double width = at[i + 1] - at[i];
    rst_hermite((c->at - at[i]) / width, x);
    const struct rst_column *o = b->column;
    double sum = x[0] * o[i].normal.ez + x[2] * o[i + 1].normal.ez;
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < s[side].n; k++)
            sum += x[1 + 2 * side] * width * s[side].w[k] * o[s[side].first + k].normal.ez;
    worst = fabs(sum - c->normal.ez);
    for (int64_t j = 0; j < rst_builder_places(b); j++) {
        sum = x[0] * o[i].g[j] + x[2] * o[i + 1].g[j];
        for (int side = 0; side < 2; side++)
            for (int k = 0; k < s[side].n; k++)
                sum += x[1 + 2 * side] * width * s[side].w[k] * o[s[side].first + k].g[j];
        worst = fmax(worst, fabs(sum - c->g[j]));
    }
    return worst;
}

static void judge(struct rst_builder *b, struct rst_column *c, double error)
{
    c->by_speed = error;
    c->open = error > rst_part_of_axis * b->options.tolerance;
}

/* Columns in the middles of open cells. Of a cell that is too narrow its error stays. */
static int64_t plan_halves(struct rst_builder *b, struct rst_task *task, int64_t *cell)
{
    int64_t n = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++) {
        struct rst_column *c = &b->column[i];
        const double width = b->column[i + 1].at - c->at;
        if (!c->open) continue;
        c->open = 0;
        if (!(width > 2 * rst_narrowest) || (c->normal.sunk && b->column[i + 1].normal.sunk)) continue;
        const double at = c->at + 0.5 * width;
        task[n] = (struct rst_task){.column = {.speed = rst_axis_speed(at), .at = at}};
        cell[n++] = i;
    }
    return n;
}

static int halve(struct rst_builder *b, int64_t n, struct rst_task *task, const int64_t *cell, restitute_error *error)
{
    double *at = malloc((size_t)b->columns * sizeof *at);
    int status = at ? rst_solve_tasks(b, n, task, error) : RESTITUTE_ERROR_MEMORY;
    if (!at) rst_report(error, status, "out of memory for the columns");
    if (status) {
        free(at);
        return status;
    }
    b->impacts += rst_cost(b, n);
    for (int64_t i = 0; i < b->columns; i++)
        at[i] = b->column[i].at;
    for (int64_t k = 0; k < n; k++) {
        const double error_of_half = rst_gain * miss(b, at, cell[k], &task[k].column);
        judge(b, &b->column[cell[k]], error_of_half);
        judge(b, &task[k].column, error_of_half);
    }
    free(at);
    return rst_insert(b, n, task, error);
}

static int refine_speeds(struct rst_builder *b, int *done, restitute_error *error)
{
    struct rst_task *task = malloc((size_t)b->columns * sizeof *task);
    int64_t *cell = malloc((size_t)b->columns * sizeof *cell);
    int status = RESTITUTE_OK;
    *done = 1;
    if (!task || !cell)
        status = rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the columns");
    else {
        const int64_t n = plan_halves(b, task, cell);
        if (n > 0 && rst_cost(b, n) <= left(b) && b->columns + n < rst_most_speeds) {
            *done = 0;
            status = halve(b, n, task, cell, error);
        }
    }
    free(task);
    free(cell);
    return status;
}

int rst_refine(struct rst_builder *b, restitute_error *error)
{
    int done = 0, status = RESTITUTE_OK;
    while (!status && !done) {
        status = refine_panels(b, error);
        if (!status) status = refine_speeds(b, &done, error);
    }
    return status;
}
