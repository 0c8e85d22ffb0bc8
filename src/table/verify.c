/* Verification: every cell of speed is compared with impacts at one other speed and at many places
 * of psi.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

/* Multiples of these, less whole numbers, fill [0, 1] evenly: golden ratio and plastic number. */
static const double golden = 0.6180339887498949, plastic = 0.7548776662466927;

static double part(double x)
{
    return x - floor(x);
}

/* Result of the comparison at one speed. */
struct check {
    double speed, ez, ex; /* largest differences, plus the error of the solver */
    int64_t cell;         /* of speed */
    struct rst_place doubtful[rst_doubtful], worst; /* of psi: most doubtful places, and the worst place found */
    int status;
    restitute_error why;
};

struct work {
    struct rst_builder *b;
    const restitute_table *table;
    struct check *check;
    int64_t places;
    int round;
};

/* Error at a node of the cubic through the nodes below and above: where the function is smooth, 16
 * times the error of cubics of half the width. Values and slopes are `slope` apart, `low` and
 * `high` are the distances of both nodes. */
static double miss_node(const double *below, const double *node, const double *above, int slope, double low, double high)
{
    const double width = low + high;
    double w[4];
    rst_hermite(low / width, w);
    return fabs(w[0] * below[0] + w[2] * above[0] + width * (w[1] * below[slope] + w[3] * above[slope]) - node[0]);
}

/* The same at place j of speed i, along psi and along the speed. It is large at a fold, wherever
 * the fold lies between the nodes. */
static double doubt_of_node(const struct rst_builder *b, const restitute_table_data *d, int64_t i, int64_t j)
{
    const int64_t row = 4 * rst_places(d), slips = j > d->stick_cells ? d->stick_cells + 1 : 0, p = j - slips;
    const struct rst_column *c = b->column + i;
    const double *node = d->ex + i * row + 4 * j;
    double doubt = 0;
    if (p > 0 && p < b->cells[slips > 0]) doubt += miss_node(node - 4, node, node + 4, 2, 1, 1);
    if (i > 0 && i + 1 < b->columns && c[-1].at < c->at && c->at < c[1].at)
        doubt += miss_node(node - row, node, node + row, 1, c->at - c[-1].at, c[1].at - c->at);
    return slips ? doubt / rst_psi_at(b, 1, (double)p / (double)b->cells[1], c->normal.ez) : doubt;
}

/* The midpoints of the most doubtful cells of psi between speeds i and i + 1; no two beside each
 * other. */
static void find_doubtful(const struct rst_builder *b, const restitute_table_data *d, int64_t i,
                          struct rst_place *place)
{
    const int64_t places = rst_places(d);
    double doubt[2][2 * rst_most_cells + 2];
    int64_t cell[rst_doubtful] = {0};
    for (int64_t j = 0; j < places; j++)
        for (int k = 0; k < 2; k++)
            doubt[k][j] = doubt_of_node(b, d, i + k, j);
    for (int k = 0; k < rst_doubtful; k++) {
        double most = -1;
        for (int64_t j = 0; j + 1 < places; j++) {
            int taken = j == d->stick_cells; /* between the panels */
            for (int m = 0; m < k; m++)
                taken |= j >= cell[m] - 1 && j <= cell[m] + 1;
            if (taken) continue;
            const double sum = doubt[0][j] + doubt[0][j + 1] + doubt[1][j] + doubt[1][j + 1];
            if (sum > most) most = sum, cell[k] = j;
        }
        const int panel = cell[k] > d->stick_cells;
        const int64_t in_panel = cell[k] - panel * (d->stick_cells + 1);
        place[k] = (struct rst_place){panel, ((double)in_panel + 0.5) / (double)b->cells[panel]};
    }
}

/* Places around the worst one, half a cell apart. */
static void find_around(const struct rst_builder *b, struct rst_place worst, struct rst_place *place)
{
    for (int k = 0; k < rst_doubtful; k++) {
        const double cells = 0.5 * (k - rst_doubtful / 2 + (k >= rst_doubtful / 2));
        place[k] = (struct rst_place){worst.panel, fmin(1, fmax(0, worst.x + cells / (double)b->cells[worst.panel]))};
    }
}

/* Some places are the doubtful ones. The others fill the panels uniformly, a third of them in the
 * stick panel, which is smooth. */
static struct rst_place place_of(const struct check *c, int64_t i, int64_t seed)
{
    if (i < rst_doubtful) return c->doubtful[i];
    i -= rst_doubtful;
    return (struct rst_place){i % 3 > 0, part(0.5 + golden * (double)i + plastic * (double)seed)};
}

/* Between the onset of rebound and the next column there is no impact to compare with. There e_z
 * and e_x lie between 0 and the largest values of that column. */
static void bound(const struct rst_builder *b, struct check *c)
{
    const struct rst_column *above = &b->column[c->cell + 1];
    c->ez = above->normal.ez;
    for (int panel = 0; panel < 2; panel++)
        for (int64_t i = 0; i <= b->cells[panel]; i++)
            c->ex = fmax(c->ex, fabs(above->g[panel][i]));
}

static int compare(const struct work *w, struct check *c, struct rst_column_solver *s)
{
    const struct rst_builder *b = w->b;
    const int64_t n = rst_has_psi(&b->contact) ? w->places : isinf(b->contact.friction);
    struct rst_column_normal normal;
    double ez, ex;
    int status = rst_column_begin(s, c->speed, &c->why);
    if (!status) status = rst_column_normal(s, &normal, &c->why);
    if (rst_column_is_too_hard(status) && b->column[c->cell].normal.ez <= 0) {
        bound(b, c); /* just above the lowest speed with a rebound */
        return RESTITUTE_OK;
    }
    if (status < 0) return status;
    rst_table_evaluate(w->table, c->speed, 0, 1, &ez, &ex);
    c->ez = fabs(ez - normal.ez) + normal.error;
    for (int64_t i = 0; i < n && !rst_column_rests(&b->contact, &normal) && !status; i++) {
        const struct rst_place place = place_of(c, i, c->cell + 7 * w->round);
        const double psi = rst_has_psi(&b->contact) ? rst_psi_at(b, place.panel, place.x, normal.ez) : 0;
        double solved, error_ex;
        status = rst_column_solve(s, psi, &solved, &error_ex, &c->why);
        if (status < 0) break;
        rst_table_evaluate(w->table, c->speed, psi, 1, &ez, &ex);
        const double miss = fabs(ex - solved) + error_ex;
        if (miss > c->ex) c->ex = miss, c->worst = place;
    }
    return status;
}

static void turn(void *of, int thread, int64_t i)
{
    const struct work *w = of;
    w->check[i].status = compare(w, &w->check[i], &w->b->solver[thread]);
}

/* Cells that were not compared yet; or, to compare again, those with an error above `least`. */
static int64_t plan(const struct rst_builder *b, const restitute_table *table, int round, double least,
                    struct check *check)
{
    int64_t n = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        const int again = fmax(c->checked[0], c->checked[1]) > least;
        if (!(c[1].at > c->at) || (least > 0 ? !again : c->checked[0] >= 0)) continue;
        const double u = 0.3 + 0.4 * part(0.5 + plastic * (double)(i + 3 * round));
        const double speed = rst_axis_speed(c->at + u * (c[1].at - c->at));
        check[n] = (struct check){.speed = fmin(speed, b->options.speed[1]), .cell = i}; /* of one speed: that */
        if (least > 0)
            find_around(b, c->worst, check[n++].doubtful);
        else
            find_doubtful(b, &table->d, i, check[n++].doubtful);
    }
    return n;
}

/* Compare planned cells. */
static int look(struct rst_builder *b, const restitute_table *table, int round, double least, restitute_error *error)
{
    const int64_t even = least > 0 ? 0 : 6 + (b->first[0] + b->first[1]) / 4;
    struct work w = {b, table, malloc((size_t)b->columns * sizeof *w.check), rst_doubtful + even, round};
    if (!w.check) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the checks");
    const int64_t n = plan(b, table, round, least, w.check);
    int status = RESTITUTE_OK;
    rst_loop(b->threads, n, turn, &w);
    for (int64_t i = n - 1; i >= 0; i--) {
        struct rst_column *c = &b->column[w.check[i].cell];
        if (w.check[i].status < 0) status = rst_report(error, w.check[i].status, "%s", w.check[i].why.message);
        c->checked[0] = fmax(c->checked[0], w.check[i].ez);
        if (w.check[i].ex > c->checked[1]) c->checked[1] = w.check[i].ex, c->worst = w.check[i].worst;
    }
    free(w.check);
    b->impacts += n * (1 + (rst_has_psi(&b->contact) ? w.places : 0));
    b->checks += n * (rst_has_psi(&b->contact) ? w.places : 1);
    return status;
}

/* Largest error of all cells. */
static double worst_of(const struct rst_builder *b)
{
    double worst = 0;
    for (int64_t i = 0; i + 1 < b->columns; i++)
        worst = fmax(worst, fmax(b->column[i].checked[0], b->column[i].checked[1]));
    return worst;
}

int rst_verify(struct rst_builder *b, const restitute_table *table, int round, int *missed, restitute_error *error)
{
    int status = look(b, table, rst_looks * round, 0, error);
    for (int k = 1; k < rst_looks && !status; k++)
        status = look(b, table, rst_looks * round + k, rst_look_again * worst_of(b), error);
    b->error_ez = b->error_ex = 0;
    *missed = 0;
    for (int64_t i = 0; i + 1 < b->columns && !status; i++) {
        const double *checked = b->column[i].checked, both = fmax(checked[0], checked[1]), left = rst_left_by_psi(b, i);
        b->error_ez = fmax(b->error_ez, rst_margin * checked[0]);
        b->error_ex = fmax(b->error_ex, fmax(left, rst_margin * both)); /* e_z is in (27) */
        if (rst_margin * both <= fmax(left, b->options.tolerance)) continue;
        ++*missed; /* to be halved */
        b->column[i].by_speed = fmax(b->column[i].by_speed, both);
    }
    return status;
}
