/* Columns of a build, by several threads.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"
#include "parallel.h"

#include <stdlib.h>

static double psi_at(const struct rst_builder *b, int64_t place, double ez)
{
    if (place <= b->stick) return (double)place / (double)b->stick;
    const double y = rst_panel_y((double)(place - b->stick - 1) / (double)b->slip);
    return 1 + y * fmax(0, 2 * b->contact.numbers.chi - 1) * (1 + ez);
}

/* Value of a place from older values of a coarser grid; NULL: it is to be solved. */
static const double *known(const struct rst_builder *b, const struct rst_task *t, int64_t place)
{
    if (!t->old) return NULL;
    const int slips = place > b->stick;
    const int64_t i = slips ? place - b->stick - 1 : place;
    const int64_t times = slips ? b->slip / t->old_slip : b->stick / t->old_stick;
    if (i % times != 0) return NULL;
    return t->old + (slips ? t->old_stick + 1 : 0) + i / times;
}

/* Places of g that an impact gives: all but the ends of the slip panel, which are e_x at psi = 1, and 0. */
static int is_solved(const struct rst_builder *b, int64_t place)
{
    if (b->contact.sliding == RST_NO_FRICTION) return 0;
    if (b->contact.sliding == RST_NEVER_SLIPS) return place == 0;
    return place != b->stick + 1 && place != b->stick + 1 + b->slip;
}

/* g from e_x. */
static void set_g(const struct rst_builder *b, struct rst_column *c, int64_t place, double psi, double ex)
{
    const double width = (2 * b->contact.numbers.chi - 1) * (1 + c->normal.ez);
    c->g[place] = place <= b->stick ? ex : psi * ex - (psi - 1) / width * c->normal.ez;
}

struct work {
    struct rst_builder *b;
    struct rst_task *task;
};

static int solve_places(const struct rst_builder *b, struct rst_column_solver *s, struct rst_task *t, double *room)
{
    struct rst_column *c = &t->column;
    const int64_t places = rst_builder_places(b);
    double *psi = room, *ex = room + places, *error_ex = room + 2 * places;
    int64_t n = 0;
    s->levels = 0;
    int status = rst_column_begin(s, c->speed, &t->why);
    if (!status && !t->old) status = rst_column_normal(s, &c->normal, &t->why);
    if (status < 0 || c->normal.sunk) return status;
    for (int64_t i = 0; i < places; i++)
        if (is_solved(b, i) && !known(b, t, i)) psi[n++] = psi_at(b, i, c->normal.ez);
    status = rst_column_solve(s, n, psi, ex, error_ex, &t->why);
    if (status < 0) return status;
    c->levels = s->levels > c->levels ? s->levels : c->levels;
    n = 0;
    for (int64_t i = 0; i < places; i++) {
        const double *old = known(b, t, i);
        if (old)
            c->g[i] = *old;
        else if (is_solved(b, i)) {
            c->solver = fmax(c->solver, error_ex[n]);
            set_g(b, c, i, psi[n], ex[n]);
            n++;
        }
    }
    if (b->contact.sliding == RST_NEVER_SLIPS) c->g[1] = c->g[0];
    c->g[b->stick + 1] = c->g[b->stick];
    return RESTITUTE_OK;
}

static void turn(void *of, int thread, int64_t i)
{
    const struct work *w = of;
    struct rst_task *t = &w->task[i];
    const size_t places = (size_t)rst_builder_places(w->b);
    double *room = malloc(3 * places * sizeof *room);
    t->column.g = calloc(places, sizeof *t->column.g);
    if (room && t->column.g)
        t->status = solve_places(w->b, &w->b->solver[thread], t, room);
    else
        t->status = rst_report(&t->why, RESTITUTE_ERROR_MEMORY, "out of memory for a column");
    free(room);
}

int64_t rst_cost(const struct rst_builder *b, int64_t n)
{
    return n * (b->contact.sliding == RST_SLIDES ? rst_builder_places(b) - 1 : 2);
}

int rst_solve_tasks(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error)
{
    struct work w = {b, task};
    for (int64_t i = 0; i < n; i++)
        task[i].column.g = NULL;
    rst_table_loop(b->threads, n, turn, &w);
    int status = RESTITUTE_OK;
    for (int64_t i = n - 1; i >= 0; i--)
        if (task[i].status < 0 && !(task[i].status == RESTITUTE_ERROR_TOO_MUCH_WORK && task[i].may_fail))
            status = rst_report(error, task[i].status, "%s", task[i].why.message);
    for (int64_t i = 0; status && i < n; i++) {
        free(task[i].column.g);
        task[i].column.g = NULL;
    }
    return status;
}

static int by_place(const void *a, const void *b)
{
    const struct rst_column *x = a, *y = b;
    if (x->at < y->at || x->at > y->at) return x->at < y->at ? -1 : 1;
    return y->normal.sunk - x->normal.sunk; /* of a seam's two the one that sinks: faster impacts rebound */
}

int rst_insert(struct rst_builder *b, int64_t n, struct rst_task *task, restitute_error *error)
{
    if (b->columns + n > b->room) {
        const int64_t room = 2 * (b->columns + n);
        struct rst_column *more = realloc(b->column, (size_t)room * sizeof *more);
        if (!more) {
            for (int64_t i = 0; i < n; i++)
                free(task[i].column.g);
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld columns", (long long)room);
        }
        b->column = more;
        b->room = room;
    }
    for (int64_t i = 0; i < n; i++)
        b->column[b->columns++] = task[i].column;
    qsort(b->column, (size_t)b->columns, sizeof *b->column, by_place);
    return RESTITUTE_OK;
}
