/* Where a table needs more columns (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

double rst_table_clock(void)
{
    struct timespec t = {0};
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Impacts that refinement may still take: of max_impacts, and in the time left at the present
 * rate. */
static int64_t left(const struct rst_builder *b)
{
    const double spent = rst_table_clock() - b->began, limit = b->options.time_limit;
    double most = (double)b->options.max_impacts;
    if (limit < INFINITY && spent > 0) most = fmin(most, (double)b->impacts * (limit / spent));
    return (int64_t)(rst_for_refining * most) - b->impacts;
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
    rst_find_stencil(at, high - low + 1, i - low, s);
    s->first += low;
    if (c[i].normal.ez <= 0) s->n = 0; /* e_z and e_x begin with zero slope, and vary strongly */
}

/* Value of a column at place j of n cells of a panel; panel -1: e_z. */
static double value(const struct rst_column *c, int panel, int64_t n, int64_t j)
{
    return panel < 0 ? c->normal.ez : c->g[panel][j * (c->cells[panel] / n)];
}

/* Error of the cubics of the cell above column i at a new column in it, at the common places of
 * psi. */
static double miss(const struct rst_builder *b, int64_t i, const struct rst_column *c)
{
    const struct rst_column *o = b->column;
    struct rst_stencil s[2];
    double x[4], worst = 0;
    rst_column_stencil(b, i, &s[0]);
    rst_column_stencil(b, i + 1, &s[1]);
    const double width = o[i + 1].at - o[i].at;
    rst_hermite((c->at - o[i].at) / width, x);
    for (int panel = -1; panel < 2; panel++) {
        const int64_t n = panel < 0 ? 0 : b->cells[panel] < c->cells[panel] ? b->cells[panel] : c->cells[panel];
        for (int64_t j = 0; j <= n; j++) {
            double sum = x[0] * value(&o[i], panel, n, j) + x[2] * value(&o[i + 1], panel, n, j);
            for (int side = 0; side < 2; side++)
                for (int k = 0; k < s[side].n; k++)
                    sum += x[1 + 2 * side] * width * s[side].w[k] * value(&o[s[side].first + k], panel, n, j);
            const double psi = panel == 1 ? rst_psi_at(b, 1, (double)j / (double)n, c->normal.ez) : 1; /* g is psi e_x */
            worst = fmax(worst, fabs(sum - value(c, panel, n, j)) / psi);
        }
    }
    return worst;
}

double rst_left_by_psi(const struct rst_builder *b, int64_t i)
{
    return rst_margin * fmax(b->column[i].by_psi, b->column[i + 1].by_psi);
}

/* More columns reduce neither the error of the solver nor the error along psi. */
static int can_halve(const struct rst_builder *b, int64_t i)
{
    const struct rst_column *c = &b->column[i];
    if (c->speed >= b->options.speed[1] || c[1].at - c->at <= 2 * rst_narrowest) return 0;
    return !(rst_column_rests(&b->contact, &c->normal) && c[1].normal.sunk) &&
           c->by_speed > fmax(fmax(c->solver, c[1].solver), rst_part_of_axis * rst_left_by_psi(b, i));
}

/* Expected error of both halves of a cell. */
static void judge(struct rst_column *low, struct rst_column *middle, double missed)
{
    const double before = low->missed;
    const double gain = before > 0 ? fmin(rst_most_gain, fmax(rst_least_gain, missed / before)) : rst_gain;
    low->missed = middle->missed = missed;
    low->by_speed = middle->by_speed = gain * missed;
    middle->checked[0] = middle->checked[1] = -1;
}

/* A new column changes slopes, and so the neighbouring cells. These are compared again. */
static void forget_checks(struct rst_builder *b, int64_t i)
{
    for (int64_t k = i > 0 ? i - 1 : 0; k < b->columns && k <= i + 1; k++)
        b->column[k].checked[0] = b->column[k].checked[1] = -1;
}

static int halve(struct rst_builder *b, int64_t n, struct rst_task *task, const int64_t *cell, restitute_error *error)
{
    const int status = rst_solve_tasks(b, n, task, error);
    if (status) return status;
    int64_t solved = 0;
    for (int64_t k = 0; k < n; k++) {
        if (task[k].status < 0) {
            rst_column_destroy(&task[k].column);
            b->column[cell[k]].by_speed = 0; /* cannot be halved */
            continue;
        }
        forget_checks(b, cell[k]);
        judge(&b->column[cell[k]], &task[k].column, miss(b, cell[k], &task[k].column));
        task[solved++] = task[k];
    }
    return rst_insert(b, solved, task, error);
}

/* Columns in the middles of the cells whose error is larger than `least`. */
static int64_t plan_halves(const struct rst_builder *b, double least, struct rst_task *task, int64_t *cell)
{
    int64_t n = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        if (!can_halve(b, i) || c->by_speed <= least) continue;
        const double at = 0.5 * (c->at + c[1].at);
        task[n] = (struct rst_task){.column = {.speed = rst_axis_speed(at), .at = at}, .may_fail = 1};
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

int rst_refine(struct rst_builder *b, restitute_error *error)
{
    const double enough = rst_part_of_axis * b->options.tolerance;
    int done = 0, status = RESTITUTE_OK;
    while (!status && !done) {
        const double worst = worst_of_cells(b);
        if (worst <= enough) break;
        status = halve_cells(b, fmax(enough, worst / rst_together), &done, error);
    }
    return status;
}
