/* Which impacts are solved: probes, filling, checks (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "builder.h"
#include "interpolation.h"

/* Most points of a line of probes: one that needs more is cut into panels. */
static const int64_t most_points = 33;

int rst_plan_add(struct restitute_table_builder *b, struct rst_point point)
{
    if (b->points == b->capacity) {
        const int64_t capacity = b->capacity ? 2 * b->capacity : 1024;
        struct rst_point *points = realloc(b->point, (size_t)capacity * sizeof *points);
        if (!points) return 1;
        b->point = points;
        struct rst_solved *solved = realloc(b->solved, (size_t)capacity * sizeof *solved);
        if (!solved) return 1;
        b->solved = solved;
        b->capacity = capacity;
    }
    b->point[b->points++] = point;
    return 0;
}

void rst_plan_begin(struct restitute_table_builder *b)
{
    b->points = b->next = 0;
    b->part = 0;
}

/* The columns that probes go through: the middle and the corners of all axes but `along`, that is, 1, 3 or 5 of them.
 * */
struct columns {
    int count;
    double u[9][3];
};

static struct columns columns_beside(const struct restitute_table_builder *b, enum rst_axis along)
{
    struct columns c = {.count = 1, .u = {{0.5, 0.5, 0.5}}};
    int beside = 0;
    for (int a = 0; a < 3; a++)
        beside |= (b->active[a] && a != (int)along) << a;
    for (int corner = 0; corner < 8; corner++) {
        if ((corner & ~beside) != 0 || beside == 0) continue;
        for (int a = 0; a < 3; a++)
            c.u[c.count][a] = beside >> a & 1 ? (double)(corner >> a & 1) : 0.5;
        c.count++;
    }
    return c;
}

/* A line along speed, gamma or chi in three values of psi: 0, 1, and the middle of the slip side. */
static int probe_outer(struct restitute_table_builder *b, enum rst_axis axis, double *x)
{
    const struct columns c = columns_beside(b, axis);
    const int64_t n = b->probe[axis];
    rst_table_nodes(n, x);
    for (int i = 0; i < c.count; i++) {
        const int64_t first = b->points;
        for (int kind = 0; kind < 3; kind++) {
            if (kind == 1 && !b->active[RST_STICK]) continue;
            if (kind == 2 && !b->active[RST_SLIP]) continue;
            for (int64_t j = 0; j < n; j++) {
                struct rst_point p = {.s = kind == 2 ? 0.5 : kind, .later = kind == 2, .column = first + j};
                memcpy(p.u, c.u[i], sizeof p.u);
                p.u[axis] = x[j];
                if (rst_plan_add(b, p)) return 1;
            }
        }
    }
    return 0;
}

/* Lines along psi, on both sides. The ends of the slip side are known. */
static int probe_psi(struct restitute_table_builder *b, double *x)
{
    const struct columns c = columns_beside(b, RST_STICK);
    for (int i = 0; i < c.count; i++) {
        const int64_t first = b->points;
        for (int side = 0; side < 2; side++) {
            const enum rst_axis axis = side ? RST_SLIP : RST_STICK;
            if (!b->active[axis]) continue;
            const int64_t n = b->probe[axis];
            rst_table_nodes(n, x);
            for (int64_t j = side; j < n - side; j++) {
                struct rst_point p = {.s = x[j], .later = side, .column = first};
                memcpy(p.u, c.u[i], sizeof p.u);
                if (rst_plan_add(b, p)) return 1;
            }
        }
    }
    return 0;
}

int rst_plan_probes(struct restitute_table_builder *b)
{
    double x[rst_most_points];
    rst_plan_begin(b);
    for (int axis = 0; axis < 3; axis++)
        if (b->active[axis] && probe_outer(b, (enum rst_axis)axis, x)) return 1;
    if (b->active[RST_STICK] && probe_psi(b, x)) return 1;
    return 0;
}

/* Fewest points whose neglected coefficients have a norm below `goal`; n + 1 if the last ones are not small either.
 * The norm and not the sum: the solver's errors are in all of them alike, and would add up. */
static int64_t points_needed(const double *value, int64_t n, double goal)
{
    double *row = malloc((size_t)(n * n + n) * sizeof *row);
    if (!row) return -1;
    double *c = row + n * n, sum = 0;
    rst_table_spectrum(n, row);
    rst_table_along(1, n, n, 1, row, value, c);
    int64_t needed = n;
    for (; needed > 2 && sum + c[needed - 1] * c[needed - 1] < goal * goal; needed--)
        sum += c[needed - 1] * c[needed - 1];
    free(row);
    return needed > n - 2 ? n + 1 : needed + 1; /* one more: a line between the probes may want it */
}

static int take_longer(int64_t *order, int64_t needed)
{
    if (needed < 0) return 1;
    if (needed > *order) *order = needed;
    return 0;
}

static int read_outer(struct restitute_table_builder *b, enum rst_axis axis, double goal, int64_t *first)
{
    const int64_t n = b->probe[axis];
    double value[rst_most_points];
    const int count = columns_beside(b, axis).count;
    for (int i = 0; i < count; i++)
        for (int kind = 0; kind < 3; kind++) {
            if (kind == 1 && !b->active[RST_STICK]) continue;
            if (kind == 2 && !b->active[RST_SLIP]) continue;
            const struct rst_solved *s = b->solved + *first;
            for (int64_t j = 0; j < n; j++)
                value[j] = s[j].ez;
            if (take_longer(&b->n[axis], points_needed(value, n, goal))) return 1;
            for (int64_t j = 0; j < n; j++)
                value[j] = s[j].ex;
            if (b->family.sliding != RST_NO_FRICTION && take_longer(&b->n[axis], points_needed(value, n, goal)))
                return 1;
            *first += n;
        }
    return 0;
}

static int read_psi(struct restitute_table_builder *b, double goal, int64_t first)
{
    double value[rst_most_points];
    const struct columns c = columns_beside(b, RST_STICK);
    for (int i = 0; i < c.count; i++) {
        const int64_t n = b->probe[RST_STICK], m = b->probe[RST_SLIP];
        const struct rst_solved *s = b->solved + first;
        for (int64_t j = 0; j < n; j++)
            value[j] = s[j].ex;
        if (take_longer(&b->n[RST_STICK], points_needed(value, n, goal))) return 1;
        first += n;
        if (!b->active[RST_SLIP]) continue;
        const double chi = rst_builder_number(b, RST_CHI, c.u[i][2]), ez = s[0].ez;
        const double critical = restitute_critical_psi(chi, ez);
        double x[rst_most_points];
        rst_table_nodes(m, x);
        value[0] = s[n - 1].ex - rst_full_slip(chi, ez, 1);
        value[m - 1] = 0;
        for (int64_t j = 1; j < m - 1; j++)
            value[j] = s[n + j - 1].ex - rst_full_slip(chi, ez, 1 + rst_y_of_t(x[j]) * (critical - 1));
        if (take_longer(&b->n[RST_SLIP], points_needed(value, m, goal))) return 1;
        first += m - 2;
    }
    return 0;
}

int rst_read_probes(struct restitute_table_builder *b, int *resolved)
{
    const double goal = 0.15 * b->options.tolerance; /* an axis; probes do not see all of it */
    int64_t first = 0;
    for (int axis = 0; axis < rst_axes; axis++)
        b->n[axis] = b->active[axis] ? 2 : 1;
    for (int axis = 0; axis < 3; axis++)
        if (b->active[axis] && read_outer(b, (enum rst_axis)axis, goal, &first)) return 1;
    if (b->active[RST_STICK] && read_psi(b, goal, first)) return 1;
    *resolved = 1;
    for (int axis = 0; axis < rst_axes; axis++) {
        const int unresolved = b->n[axis] > b->probe[axis], longer = 2 * b->probe[axis] - 1 <= most_points;
        if (unresolved) b->n[axis] = b->probe[axis];
        if (unresolved && longer) {
            b->probe[axis] = 2 * b->probe[axis] - 1;
            *resolved = 0;
        }
    }
    return 0;
}

/* All products; a slip point's ez is that of psi = 1 in its column, or of the only psi. */
static int fill_column(struct restitute_table_builder *b, const double u[3], const double *stick, const double *slip)
{
    const int64_t n = b->n[RST_STICK], m = b->active[RST_SLIP] ? b->n[RST_SLIP] : 0, first = b->points;
    for (int64_t j = 0; j < n; j++) {
        struct rst_point p = {.u = {u[0], u[1], u[2]}, .s = stick[j]};
        if (rst_plan_add(b, p)) return 1;
    }
    for (int64_t j = 1; j < m - 1; j++) {
        struct rst_point p = {.u = {u[0], u[1], u[2]}, .s = slip[j], .later = 1, .column = first + n - 1};
        if (rst_plan_add(b, p)) return 1;
    }
    return 0;
}

int rst_plan_filling(struct restitute_table_builder *b)
{
    double x[rst_axes][rst_most_points];
    rst_plan_begin(b);
    for (int axis = 0; axis < rst_axes; axis++)
        rst_panels_nodes(&b->panels[axis], x[axis]);
    for (int64_t i = 0; i < b->n[0]; i++)
        for (int64_t j = 0; j < b->n[1]; j++)
            for (int64_t k = 0; k < b->n[2]; k++) {
                const double u[3] = {x[0][i], x[1][j], x[2][k]};
                if (fill_column(b, u, x[RST_STICK], x[RST_SLIP])) return 1;
            }
    return 0;
}

/* The middle of a cell along speed or gamma, as a coordinate in [0, 1]. */
static double middle_of_octaves(const struct restitute_table_builder *b, enum rst_axis axis,
                                const struct rst_octaves *o, int64_t cell)
{
    if (o->cells == 0) return 0.5;
    const double middle = 0.5 * (rst_octaves_node(o, cell * rst_cubic) + rst_octaves_node(o, (cell + 1) * rst_cubic));
    return (log(middle) - b->low[axis]) / (b->high[axis] - b->low[axis]);
}

/* The middle of a cell of psi: those of the stick side, then those of both halves of the slip side. */
static void middle_of_psi(const restitute_table *t, int64_t cell, struct rst_point *p)
{
    p->later = cell >= t->stick_cells && t->stick_cells > 0;
    if (!p->later) {
        p->s = t->stick_cells > 0 ? ((double)cell + 0.5) / (double)t->stick_cells : 0;
        return;
    }
    const int turned = cell >= t->stick_cells + t->slip_cells;
    const int64_t own = cell - t->stick_cells - (turned ? t->slip_cells : 0);
    const double low = rst_slip_node(t->slip_cells, own * rst_cubic);
    p->s = rst_t_of_root(0.5 * (low + rst_slip_node(t->slip_cells, (own + 1) * rst_cubic)), turned);
}

/* The middles of some of the table's cells, spread over all of them by the golden section. */
static int check_cells(struct restitute_table_builder *b)
{
    const restitute_table *t = b->draft;
    const double golden = 0.61803398874989485;
    const int64_t n[4] = {t->speed.cells > 0 ? t->speed.cells : 1, t->gamma.cells > 0 ? t->gamma.cells : 1,
                          t->chi_cells > 0 ? t->chi_cells : 1,
                          t->stick_cells > 0 ? t->stick_cells + 2 * t->slip_cells : 1};
    const int64_t all = n[0] * n[1] * n[2] * n[3], count = all < rst_most_cell_checks ? all : rst_most_cell_checks;
    for (int64_t i = 0; i < count; i++) {
        int64_t cell = count == all ? i : (int64_t)(fmod((double)(i + 1) * golden, 1) * (double)all);
        struct rst_point p = {.column = -1};
        middle_of_psi(t, cell % n[3], &p);
        cell /= n[3];
        p.u[RST_CHI] = ((double)(cell % n[2]) + 0.5) / (double)n[2];
        cell /= n[2];
        p.u[RST_GAMMA] = middle_of_octaves(b, RST_GAMMA, &t->gamma, cell % n[1]);
        p.u[RST_SPEED] = middle_of_octaves(b, RST_SPEED, &t->speed, cell / n[1]);
        if (rst_plan_add(b, p)) return 1;
    }
    return 0;
}

int rst_plan_checks(struct restitute_table_builder *b)
{
    double x[rst_axes][rst_most_points];
    int64_t n[rst_axes];
    rst_plan_begin(b);
    for (int axis = 0; axis < rst_axes; axis++)
        n[axis] = rst_panels_half_ways(&b->panels[axis], x[axis]);
    if (!b->active[RST_STICK]) x[RST_STICK][0] = 0;
    for (int64_t i = 0; i < n[0]; i++)
        for (int64_t j = 0; j < n[1]; j++)
            for (int64_t k = 0; k < n[2]; k++)
                for (int side = 0; side < 1 + b->active[RST_SLIP]; side++)
                    for (int64_t l = 0; l < n[RST_STICK + side]; l++) {
                        const struct rst_point p = {
                            .u = {x[0][i], x[1][j], x[2][k]}, .s = x[RST_STICK + side][l], .later = side, .column = -1};
                        if (rst_plan_add(b, p)) return 1;
                    }
    return check_cells(b);
}
