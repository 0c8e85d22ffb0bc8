/* Columns of a table of patches: impacts of one delta1 and one gamma (grid.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "grid.h"
#include "interpolation.h"

/* The most points that a direction may have. */
static const int64_t most[rst_inners] = {25, 33, 65};

/* Parts of the goal that the last coefficients of a direction may be worth. Along chi, where a higher derivative of ex jumps near chi = 1.6 for
 * nearly elastic solids, those that follow are the most. */
static const double part[rst_inners] = {0.5, 1, 1.4};

static int64_t stick_size(const int64_t n[rst_inners])
{
    return n[RST_BY_CHI] * n[RST_BY_STICK];
}

static int64_t size_of(const int64_t n[rst_inners])
{
    return stick_size(n) + n[RST_BY_CHI] * n[RST_BY_SLIP];
}

static double chi_at(const struct restitute_table_builder *b, int64_t n, int64_t i)
{
    double x[rst_most_points];
    if (n == 1) return rst_builder_number(b, RST_CHI, 0);
    rst_table_nodes(n, x);
    return rst_builder_number(b, RST_CHI, x[i]);
}

static int add(struct restitute_table_builder *b, int64_t column, double chi, double s, int slips, int64_t slot)
{
    const struct rst_column *c = &b->grid->column[column];
    const struct rst_point p = {
        .u = {c->delta1, c->gamma, chi}, .s = s, .column = column, .slips = slips, .slot = slot};
    return rst_plan_add(b, p);
}

/* All points of a column that have no value yet: NaN stands for that. The slip side is known at psi_c, and at psi = 1 from the
 * other side. */
static int plan_column(struct restitute_table_builder *b, int64_t column)
{
    const struct rst_column *c = &b->grid->column[column];
    const int64_t n = c->n[RST_BY_STICK], m = c->n[RST_BY_SLIP], slip = stick_size(c->n);
    double stick_x[rst_most_points], slip_x[rst_most_points];
    rst_table_nodes(n, stick_x);
    if (m > 0) rst_table_nodes(m, slip_x);
    for (int64_t i = 0; i < c->n[RST_BY_CHI]; i++) {
        const double chi = chi_at(b, c->n[RST_BY_CHI], i);
        for (int64_t j = 0; j < n; j++)
            if (isnan(c->value[i * n + j]) && add(b, column, chi, stick_x[j], 0, i * n + j)) return 1;
        for (int64_t j = 1; j + 1 < m; j++)
            if (isnan(c->value[slip + i * m + j]) && add(b, column, chi, slip_x[j], 1, slip + i * m + j)) return 1;
    }
    return 0;
}

int rst_columns_plan(struct restitute_table_builder *b)
{
    rst_plan_begin(b);
    for (int64_t i = 0; i < b->grid->columns; i++)
        if (b->grid->column[i].pending && plan_column(b, i)) return 1;
    return 0;
}

/* The ends of the slip side. */
static void close_slip_side(const struct restitute_table_builder *b, struct rst_column *c)
{
    const int64_t n = c->n[RST_BY_STICK], m = c->n[RST_BY_SLIP];
    double *slip = c->value + stick_size(c->n);
    for (int64_t i = 0; i < c->n[RST_BY_CHI] && m > 0; i++) {
        const double chi = chi_at(b, c->n[RST_BY_CHI], i);
        slip[i * m] = c->value[i * n + n - 1] - rst_full_slip(chi, c->ez, 1);
        slip[i * m + m - 1] = 0;
    }
}

void rst_columns_collect(struct restitute_table_builder *b, int slips)
{
    struct rst_grid *g = b->grid;
    for (int64_t i = 0; i < b->points; i++) {
        const struct rst_point *p = &b->point[i];
        const struct rst_solved *s = &b->solved[i];
        struct rst_column *c = &g->column[p->column];
        if (p->slips != slips) continue;
        if (isnan(c->ez)) c->ez = fmin(1, fmax(0, s->ez)); /* that of the first point, for all of the column */
        const double psi = 1 + rst_y_of_t(p->s) * (restitute_critical_psi(p->u[2], c->ez) - 1);
        c->value[p->slot] = slips ? s->ex - rst_full_slip(p->u[2], c->ez, psi) : s->ex;
    }
    for (int64_t i = 0; i < g->columns && slips; i++) {
        if (g->column[i].pending) close_slip_side(b, &g->column[i]);
        g->column[i].pending = 0;
    }
}

/* What the points of a direction leave out, by its last two coefficients; those fall by three or more from one to the next. */
static double neglected(int64_t before, int64_t n, int64_t after, const double *value)
{
    double row[2 * rst_most_points], largest[2] = {0, 0};
    rst_table_last(n, row);
    for (int64_t h = 0; h < before; h++)
        for (int64_t k = 0; k < after; k++)
            for (int which = 0; which < 2; which++) {
                double sum = 0;
                for (int64_t j = 0; j < n; j++)
                    sum += row[which * n + j] * value[(h * n + j) * after + k];
                largest[which] = fmax(largest[which], fabs(sum));
            }
    return fmax(0.3 * largest[0], largest[1]);
}

/* Values of a column at more points; those of the old stay, the others are NaN. */
static int stretch(struct rst_column *c, const int64_t n[rst_inners])
{
    double *value = malloc((size_t)size_of(n) * sizeof *value);
    if (!value) return 1;
    for (int64_t i = 0; i < size_of(n); i++)
        value[i] = NAN;
    const int64_t by_chi = c->n[0] > 1 ? (n[0] - 1) / (c->n[0] - 1) : 1;
    for (int side = 0; side < 2 && c->value; side++) {
        const int64_t old = c->n[1 + side], new = n[1 + side], by = old > 1 ? (new - 1) / (old - 1) : 1;
        const double *from = c->value + (side ? stick_size(c->n) : 0);
        double *to = value + (side ? stick_size(n) : 0);
        for (int64_t i = 0; i < c->n[0]; i++)
            for (int64_t j = 0; j < old; j++)
                to[i * by_chi * new + j *by] = from[i * old + j];
    }
    free(c->value);
    c->value = value;
    memcpy(c->n, n, sizeof c->n);
    return 0;
}

static int lengthen(struct rst_column *c, int *longer)
{
    const double *slip = c->value + stick_size(c->n);
    const int64_t *n = c->n;
    double missed[rst_inners] = {0};
    if (n[0] > 1) missed[0] = fmax(neglected(1, n[0], n[1], c->value), n[2] > 0 ? neglected(1, n[0], n[2], slip) : 0);
    missed[1] = neglected(n[0], n[1], 1, c->value);
    if (n[2] > 0) missed[2] = neglected(n[0], n[2], 1, slip);
    int64_t wanted[rst_inners];
    *longer = 0;
    for (int i = 0; i < rst_inners; i++) {
        const int more = missed[i] > part[i] * c->goal && n[i] < most[i];
        wanted[i] = more ? 2 * n[i] - 1 : n[i];
        *longer |= more;
    }
    return *longer && stretch(c, wanted);
}

/* Double points where they are too few; `any`: nonzero if some column wants more impacts. */
int rst_columns_lengthen(struct restitute_table_builder *b, int *any)
{
    *any = 0;
    for (int64_t i = 0; i < b->grid->columns; i++) {
        struct rst_column *c = &b->grid->column[i];
        int longer;
        if (lengthen(c, &longer)) return 1;
        c->pending = longer;
        *any |= longer;
    }
    return 0;
}

int rst_columns_start(struct restitute_table_builder *b, struct rst_column *c)
{
    const int64_t n[rst_inners] = {b->active[RST_CHI] ? 7 : 1, 5, b->active[RST_SLIP] ? 17 : 0};
    return stretch(c, n);
}
