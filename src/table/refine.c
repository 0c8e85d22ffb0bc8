/* Where a table needs more nodes (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

#include <stdlib.h>
#include <string.h>

/* Derivative at node i of the polynomial through the `most` of n nodes around it. */
static void find_stencil(const double *at, int64_t n, int most, int64_t i, struct rst_stencil *s)
{
    s->n = n < most ? (int)n : most;
    s->first = i < most / 2 ? 0 : i - most / 2;
    if (s->first + s->n > n) s->first = n - s->n;
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

double rst_even_slope(const double *f, int64_t cells, int64_t i)
{
    static const double place[rst_most_points] = {0, 1, 2, 3, 4, 5, 6};
    struct rst_stencil s;
    const int64_t n = cells + 1 < rst_most_points ? cells + 1 : rst_most_points, half = n / 2;
    const int64_t first = i < half ? 0 : i - half > cells + 1 - n ? cells + 1 - n : i - half;
    find_stencil(place, n, rst_most_points, i - first, &s);
    double sum = 0;
    for (int j = 0; j < s.n; j++)
        sum += s.w[j] * f[first + j];
    return sum;
}

/* The polynomial through f at 0 to n - 1, by Neville's scheme. */
static double polynomial(const double *f, int n, double x)
{
    double p[8];
    memcpy(p, f, (size_t)n * sizeof *p);
    for (int k = 1; k < n; k++)
        for (int j = 0; j + k < n; j++)
            p[j] = ((x - j) * p[j + 1] - (x - j - k) * p[j]) / k;
    return p[0];
}

/* By how much do the cubics miss polynomials of degree 7 in the middles of their cells? These are nearer to e_x by far, but for
 * kinks, of which both miss alike. */
double rst_panel_error(const struct rst_builder *b, const struct rst_column *c, int panel)
{
    const double *f = c->g + (panel ? b->stick + 1 : 0);
    const int64_t n = panel ? b->slip : b->stick;
    double worst = 0;
    if (n < 8) return 0;
    for (int64_t i = 0; i < n; i++) {
        const int64_t first = i < 3 ? 0 : i > n - 4 ? n - 7 : i - 3;
        const double middle = 0.5 * (f[i] + f[i + 1]) + 0.125 * (rst_even_slope(f, n, i) - rst_even_slope(f, n, i + 1));
        worst = fmax(worst, fabs(middle - polynomial(f + first, 8, (double)(i - first) + 0.5)));
    }
    return worst;
}

static int double_panel(struct rst_builder *b, int panel, restitute_error *error)
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
    return (int64_t)(rst_for_refining * (double)b->options.max_impacts) - b->impacts;
}

/* Largest error of a panel, over the columns. What the solver itself leaves open is no shape. */
static double worst_of_panel(const struct rst_builder *b, int panel)
{
    double worst = 0;
    for (int64_t i = 0; i < b->columns; i++) {
        const double error = rst_panel_error(b, &b->column[i], panel);
        if (error > b->column[i].solver && !rst_is_costly(b, &b->column[i])) worst = fmax(worst, error);
    }
    return worst;
}

/* ---- speed */

static double value(const struct rst_column *c, int64_t place)
{
    return place < 0 ? c->normal.ez : c->g[place];
}

void rst_column_stencil(const struct rst_builder *b, int64_t i, struct rst_stencil *s)
{
    const struct rst_column *c = b->column;
    int64_t low = i, high = i;
    double at[9];
    while (low > 0 && low > i - 4 && c[low - 1].at < c[low].at)
        low--;
    while (high + 1 < b->columns && high < i + 4 && c[high + 1].at > c[high].at)
        high++;
    for (int64_t k = low; k <= high; k++)
        at[k - low] = c[k].at;
    find_stencil(at, high - low + 1, 5, i - low, s);
    s->first += low;
    if (c[i].normal.ez <= 0) s->n = 0; /* e_z and e_x begin with no slope, and wildly */
}

/* By how much the cubics of the cell above column i miss a new column in it. */
static double miss(const struct rst_builder *b, int64_t i, const struct rst_column *c)
{
    const struct rst_column *o = b->column;
    struct rst_stencil s[2];
    double x[4], worst = 0;
    if (o[i].at >= o[i + 1].at) return 0;
    rst_column_stencil(b, i, &s[0]);
    rst_column_stencil(b, i + 1, &s[1]);
    const double width = o[i + 1].at - o[i].at;
    rst_hermite((c->at - o[i].at) / width, x);
    for (int64_t j = -1; j < rst_builder_places(b); j++) {
        double sum = x[0] * value(&o[i], j) + x[2] * value(&o[i + 1], j);
        for (int side = 0; side < 2; side++)
            for (int k = 0; k < s[side].n; k++)
                sum += x[1 + 2 * side] * width * s[side].w[k] * value(&o[s[side].first + k], j);
        worst = fmax(worst, fabs(sum - value(c, j)));
    }
    return worst;
}

/* Before a cell is halved for the first time its error is not known. */
static const double largest_guess = 1e-3;

static int can_halve(const struct rst_builder *b, int64_t i)
{
    const struct rst_column *c = &b->column[i];
    if (c->speed >= b->options.speed[1] || c[1].at - c->at <= 2 * rst_narrowest) return 0;
    if (rst_is_costly(b, c) && rst_is_costly(b, c + 1)) return 0;
    return !(c->normal.sunk && c[1].normal.sunk) && c->by_speed > fmax(c->solver, c[1].solver);
}

/* What is expected of both halves of a cell. */
static void judge(struct rst_column *low, struct rst_column *middle, double missed)
{
    const double before = low->missed;
    const double gain = before > 0 ? fmin(rst_most_gain, fmax(rst_least_gain, missed / before)) : rst_gain;
    low->missed = middle->missed = missed;
    low->by_speed = middle->by_speed = gain * missed;
    low->checked[0] = low->checked[1] = middle->checked[0] = middle->checked[1] = -1;
}

static int halve(struct rst_builder *b, int64_t n, struct rst_task *task, const int64_t *cell, restitute_error *error)
{
    const int status = rst_solve_tasks(b, n, task, error);
    if (status) return status;
    b->impacts += rst_cost(b, n);
    int64_t solved = 0;
    for (int64_t k = 0; k < n; k++) {
        if (task[k].status < 0) {
            free(task[k].column.g);
            b->column[cell[k]].by_speed = 0; /* cannot be halved */
            continue;
        }
        judge(&b->column[cell[k]], &task[k].column, miss(b, cell[k], &task[k].column));
        task[solved++] = task[k];
    }
    return rst_insert(b, solved, task, error);
}

/* A cell that begins where rebound does. */
static int is_beside_seam(const struct rst_builder *b, int64_t i)
{
    return i > 0 && b->column[i - 1].at >= b->column[i].at;
}

/* Columns in the middles of the cells whose error is larger than `least`. */
static int64_t plan_halves(const struct rst_builder *b, double least, struct rst_task *task, int64_t *cell)
{
    int64_t n = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        if (!can_halve(b, i) || c->by_speed <= least) continue;
        const double at = 0.5 * (c->at + c[1].at);
        task[n] = (struct rst_task){.column = {.speed = rst_axis_speed(at), .at = at},
                                    .may_fail = is_beside_seam(b, i)};
        cell[n++] = i;
    }
    return n;
}

/* Halve cells, fewer if impacts run out. */
static int halve_cells(struct rst_builder *b, double least, int *done, restitute_error *error)
{
    struct rst_task *task = malloc((size_t)b->columns * sizeof *task);
    int64_t *cell = malloc((size_t)b->columns * sizeof *cell), n = 0;
    int status = RESTITUTE_OK;
    if (!task || !cell)
        status = rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the columns");
    else
        do {
            n = plan_halves(b, least, task, cell);
            least *= 1.25;
        } while (n > 0 && (rst_cost(b, n) > left(b) || b->columns + n >= rst_most_speeds));
    *done = n == 0;
    if (n > 0) status = halve(b, n, task, cell, error);
    free(task);
    free(cell);
    return status;
}

/* ---- all */

/* Largest error of the cells that are not too narrow and not better than the solver. */
static double worst_of_cells(const struct rst_builder *b)
{
    double worst = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++)
        if (can_halve(b, i)) worst = fmax(worst, b->column[i].by_speed);
    return worst;
}

/* One step where the error is largest. */
static int refine_once(struct rst_builder *b, int *done, restitute_error *error)
{
    const double enough = rst_part_of_axis * b->options.tolerance, speed = worst_of_cells(b);
    *done = 0;
    for (int panel = 0; panel < 2 && b->contact.sliding == RST_SLIDES; panel++) {
        const int64_t cells = panel ? b->slip : b->stick;
        const double worst = fmax(b->by_psi[panel], worst_of_panel(b, panel));
        b->by_psi[panel] = 0;
        if (worst <= enough || worst < fmin(speed, largest_guess) || 2 * cells > rst_most_cells ||
            b->columns * cells > left(b))
            continue;
        return double_panel(b, panel, error);
    }
    if (speed > enough) return halve_cells(b, fmax(enough, speed / rst_together), done, error);
    *done = 1;
    return RESTITUTE_OK;
}

int rst_refine(struct rst_builder *b, restitute_error *error)
{
    int done = 0, status = RESTITUTE_OK;
    while (!status && !done)
        status = refine_once(b, &done, error);
    return status;
}
