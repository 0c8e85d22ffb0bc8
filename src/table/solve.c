/* Columns of a build, by several threads. Each is solved at the first places of psi, then where its
 * cubics have too large an error.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

struct work {
    struct rst_builder *b;
    struct rst_task *task;
};

/* The ends of the slip panel are e_x at psi = 1, and 0. */
static int solve_panel(struct rst_panel *p)
{
    const struct rst_builder *b = p->b;
    struct rst_column *c = &p->task->column;
    int64_t *cells = &c->cells[p->panel];
    double **g = &c->g[p->panel];
    int status = RESTITUTE_OK;
    if (p->panel) (*g)[0] = c->g[0][c->cells[0]];
    for (int64_t i = p->panel; i <= *cells - p->panel && !status; i++)
        status = rst_panel_solve(p, (double)i / (double)*cells, *g + i);
    p->missed = 0;
    if (!status && *cells > 1) status = rst_panel_refine(p);
    if (p->missed > rst_part_of_axis * b->options.tolerance) c->by_psi = fmax(c->by_psi, p->missed);
    return status;
}

static int solve_column(const struct rst_builder *b, struct rst_column_solver *s, struct rst_task *t)
{
    struct rst_column *c = &t->column;
    struct rst_panel p = {b, s, t, 0, 0};
    int status = rst_column_begin(s, c->speed, &t->why);
    if (!status) status = rst_column_normal(s, &c->normal, &t->why);
    c->impacts = 1;
    if (status < 0 || rst_column_rests(&b->contact, &c->normal) || b->contact.friction <= 0) return status;
    if (isinf(b->contact.friction)) return rst_panel_solve(&p, 0, c->g[0]); /* psi is 0 at all speeds */
    status = solve_panel(&p);
    p.panel = 1;
    return status ? status : solve_panel(&p);
}

/* Zeros at the first places. */
int rst_column_create(const struct rst_builder *b, struct rst_column *c)
{
    for (int k = 0; k < 2; k++) {
        c->cells[k] = b->first[k];
        c->g[k] = calloc((size_t)c->cells[k] + 1, sizeof *c->g[k]);
    }
    return c->g[0] && c->g[1] ? RESTITUTE_OK : RESTITUTE_ERROR_MEMORY;
}

void rst_column_destroy(struct rst_column *c)
{
    free(c->g[0]);
    free(c->g[1]);
}

static void turn(void *of, int thread, int64_t i)
{
    const struct work *w = of;
    struct rst_task *t = &w->task[i];
    t->status = rst_column_create(w->b, &t->column);
    if (!t->status) t->status = solve_column(w->b, &w->b->solver[thread], t);
    if (t->status == RESTITUTE_ERROR_MEMORY) rst_report(&t->why, t->status, "out of memory for a column");
}

int64_t rst_cost(const struct rst_builder *b, int64_t n)
{
    return n * (rst_has_psi(&b->contact) ? b->first[0] + b->first[1] + 1 : 2);
}

int rst_solve_tasks(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error)
{
    struct work w = {b, task};
    rst_loop(b->threads, n, turn, &w);
    int status = RESTITUTE_OK;
    for (int64_t i = n - 1; i >= 0; i--) {
        b->impacts += task[i].column.impacts;
        if (task[i].status < 0 && !(task[i].may_fail && rst_column_is_too_hard(task[i].status)))
            status = rst_report(error, task[i].status, "%s", task[i].why.message);
    }
    for (int64_t i = 0; status && i < n; i++)
        rst_column_destroy(&task[i].column);
    return status;
}

static int by_place(const void *a, const void *b)
{
    const struct rst_column *x = a, *y = b;
    if (x->at < y->at || x->at > y->at) return x->at < y->at ? -1 : 1;
    return y->normal.sunk - x->normal.sunk; /* of the two at a seam the one that sinks: faster impacts rebound */
}

/* All columns get the cells of the finest column. */
static int fill_panels(struct rst_builder *b)
{
    int status = RESTITUTE_OK;
    for (int k = 0; k < 2; k++) {
        for (int64_t i = 0; i < b->columns; i++)
            if (b->column[i].cells[k] > b->cells[k]) b->cells[k] = b->column[i].cells[k];
        for (int64_t i = 0; i < b->columns; i++)
            while (!status && b->column[i].cells[k] < b->cells[k]) {
                status = rst_panel_fill(&b->column[i].g[k], &b->column[i].cells[k]);
                b->column[i].checked[0] = b->column[i].checked[1] = -1; /* to be compared again */
            }
    }
    return status;
}

int rst_insert(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error)
{
    if (b->columns + n > b->room) {
        const int64_t room = 2 * (b->columns + n);
        struct rst_column *more = realloc(b->column, (size_t)room * sizeof *more);
        if (!more) {
            for (int64_t i = 0; i < n; i++)
                rst_column_destroy(&task[i].column);
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld columns", (long long)room);
        }
        b->column = more;
        b->room = room;
    }
    for (int64_t i = 0; i < n; i++)
        b->column[b->columns++] = task[i].column;
    qsort(b->column, (size_t)b->columns, sizeof *b->column, by_place);
    if (fill_panels(b)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for places of psi");
    return RESTITUTE_OK;
}
