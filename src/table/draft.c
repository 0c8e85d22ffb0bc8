/* From impacts at Chebyshev points to a table: the polynomials through them are taken at the nodes of the table's
 * cells, whose number is doubled until the local polynomials differ from the global ones by a small part of the
 * tolerance. SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "builder.h"
#include "interpolation.h"

/* Part of the tolerance that cells may cost along an axis, and the finest that are tried. */
static const double part_for_cells = 0.15;
enum { finest_octave = 7, most_cells = 64 };

static const double pi = 3.14159265358979323846;

/* Values at the Chebyshev points: ez[speed][gamma], stick and slip[speed][gamma][chi][their own]. */
struct coarse {
    int64_t n_speed, n_gamma, n_chi, n_stick, n_slip;
    double *ez, *stick, *slip;
};

double rst_y_of_t(double t)
{
    const double s = sin(0.5 * pi * t);
    return s * s;
}

double rst_full_slip(double chi, double ez, double psi)
{
    return 2 * chi * (1 + ez) / psi - 1;
}

/* ---- the values */

static int coarse_allocate(const struct restitute_table_builder *b, struct coarse *c)
{
    *c = (struct coarse){.n_speed = b->n[RST_SPEED],
                         .n_gamma = b->n[RST_GAMMA],
                         .n_chi = b->n[RST_CHI],
                         .n_stick = b->n[RST_STICK],
                         .n_slip = b->active[RST_SLIP] ? b->n[RST_SLIP] : 0};
    const size_t plane = (size_t)(c->n_speed * c->n_gamma), rows = plane * (size_t)c->n_chi;
    c->ez = malloc((plane + rows * (size_t)(c->n_stick + c->n_slip)) * sizeof(double));
    if (!c->ez) return 1;
    c->stick = c->ez + plane;
    c->slip = c->stick + rows * (size_t)c->n_stick;
    return 0;
}

static void collect_row(const struct restitute_table_builder *b, double chi, double ez, const struct rst_solved *s,
                        double *stick, double *slip, int64_t n_slip)
{
    const int64_t n = b->n[RST_STICK];
    for (int64_t j = 0; j < n; j++)
        stick[j] = s[j].ex;
    if (n_slip == 0) return;
    const double width = restitute_critical_psi(chi, ez) - 1;
    double t[rst_most_points];
    rst_table_nodes(n_slip, t);
    slip[0] = stick[n - 1] - rst_full_slip(chi, ez, 1);
    slip[n_slip - 1] = 0;
    for (int64_t j = 1; j < n_slip - 1; j++)
        slip[j] = s[n + j - 1].ex - rst_full_slip(chi, s[n - 1].ez, 1 + rst_y_of_t(t[j]) * width);
}

static void collect(const struct restitute_table_builder *b, struct coarse *c)
{
    const struct rst_solved *s = b->solved;
    const int64_t row = c->n_stick + (c->n_slip > 2 ? c->n_slip - 2 : 0);
    double u[rst_most_points];
    rst_table_nodes(c->n_chi, u);
    for (int64_t i = 0; i < c->n_speed * c->n_gamma; i++) {
        c->ez[i] = fmin(1, fmax(0, s[c->n_stick - 1].ez));
        for (int64_t k = 0; k < c->n_chi; k++, s += row) {
            const double chi = rst_builder_number(b, RST_CHI, c->n_chi > 1 ? u[k] : 0.5);
            const int64_t at = i * c->n_chi + k;
            collect_row(b, chi, c->ez[i], s, c->stick + at * c->n_stick, c->slip + at * c->n_slip, c->n_slip);
        }
    }
}

/* ---- along one axis */

/* An array seen along one axis. */
struct view {
    const double *value;
    int64_t before, n, after;
};

/* The arrays that have an axis; returns how many. */
static int views_along(const struct coarse *c, enum rst_axis axis, struct view v[3])
{
    const int64_t s = c->n_speed, g = c->n_gamma, x = c->n_chi, l = c->n_stick, r = c->n_slip;
    int count = 0;
    switch (axis) {
    case RST_SPEED:
        v[count++] = (struct view){c->ez, 1, s, g};
        v[count++] = (struct view){c->stick, 1, s, g * x * l};
        if (r) v[count++] = (struct view){c->slip, 1, s, g * x * r};
        break;
    case RST_GAMMA:
        v[count++] = (struct view){c->ez, s, g, 1};
        v[count++] = (struct view){c->stick, s, g, x * l};
        if (r) v[count++] = (struct view){c->slip, s, g, x * r};
        break;
    case RST_CHI:
        v[count++] = (struct view){c->stick, s * g, x, l};
        if (r) v[count++] = (struct view){c->slip, s * g, x, r};
        break;
    case RST_STICK:
        v[count++] = (struct view){c->stick, s * g * x, l, 1};
        break;
    default:
        if (r) v[count++] = (struct view){c->slip, s * g * x, r, 1};
    }
    return count;
}

/* Largest absolute value of rows applied along the axis; -1: out of memory. */
static double largest_along(const struct coarse *c, enum rst_axis axis, int64_t m, const double *row)
{
    struct view v[3];
    double largest = 0;
    const int count = views_along(c, axis, v);
    for (int i = 0; i < count; i++) {
        const int64_t size = v[i].before * m * v[i].after;
        double *result = malloc((size_t)size * sizeof *result);
        if (!result) return -1;
        rst_table_along(v[i].after, v[i].n, m, v[i].before, row, v[i].value, result);
        for (int64_t j = 0; j < size; j++)
            largest = fmax(largest, fabs(result[j]));
        free(result);
    }
    return largest;
}

/* What the last two coefficients are worth, in each panel. */
static int measure_tails(struct restitute_table_builder *b, const struct coarse *c)
{
    for (int axis = 0; axis < rst_axes; axis++) {
        b->tail[axis] = 0;
        if (!b->active[axis]) continue;
        double *row = malloc((size_t)(2 * b->n[axis]) * sizeof *row);
        if (!row) return 1;
        for (int panel = 0; panel < b->panels[axis].count && b->tail[axis] >= 0; panel++) {
            rst_panels_last(&b->panels[axis], panel, row);
            const double tail = largest_along(c, (enum rst_axis)axis, 2, row);
            if (axis < 2) b->panel_tail[axis][panel] = tail;
            b->tail[axis] = tail < 0 ? tail : fmax(b->tail[axis], tail);
        }
        free(row);
        if (b->tail[axis] < 0) return 1;
    }
    return 0;
}

/* ---- cells */

/* Largest difference of local polynomials through `nodes` places and the global one, in the middles between nodes. */
static double cell_error(const struct restitute_table_builder *b, const struct coarse *c, enum rst_axis axis,
                         int64_t nodes, const double *place, const double *middle)
{
    const int64_t n = b->n[axis], degree = rst_cubic, cells = (nodes - 1) / degree, m = nodes - 1;
    double *row = malloc((size_t)((nodes + m) * n) * sizeof *row), error = -1;
    if (!row) return -1;
    double *difference = row + nodes * n;
    rst_panels_rows(&b->panels[axis], nodes, place, row);
    rst_panels_rows(&b->panels[axis], m, middle, difference);
    for (int64_t i = 0; i < cells; i++)
        for (int64_t k = 0; k < degree; k++) {
            double w[4];
            rst_cubic_weights((double)k + 0.5, w);
            for (int64_t j = 0; j < n; j++)
                for (int64_t l = 0; l <= degree; l++)
                    difference[(i * degree + k) * n + j] -= w[l] * row[(i * degree + l) * n + j];
        }
    error = largest_along(c, axis, m, difference);
    free(row);
    return error;
}

/* Places in [0, 1] of the nodes along speed or gamma. */
static void octave_places(const struct restitute_table_builder *b, enum rst_axis axis, const struct rst_octaves *o,
                          double *place, double *middle)
{
    const double low = b->low[axis], width = b->high[axis] - low;
    const int64_t n = o->cells * rst_cubic + 1;
    for (int64_t i = 0; i < n; i++) {
        const double here = rst_octaves_node(o, i);
        place[i] = fmin(1, fmax(0, (log(here) - low) / width));
        if (i + 1 < n) middle[i] = fmin(1, fmax(0, (log(0.5 * (here + rst_octaves_node(o, i + 1))) - low) / width));
    }
}

static int choose_octaves(const struct restitute_table_builder *b, const struct coarse *c, enum rst_axis axis,
                          struct rst_octaves *o)
{
    rst_octaves_set(b->seam_low[axis], b->seam_low[axis], 1, o);
    if (!b->active[axis]) return 0;
    for (int k = 1; k <= finest_octave; k++) {
        rst_octaves_set(b->seam_low[axis], b->seam_high[axis], k, o);
        const int64_t nodes = o->cells * rst_cubic + 1;
        double *place = malloc((size_t)(2 * nodes) * sizeof *place);
        if (!place) return 1;
        octave_places(b, axis, o, place, place + nodes);
        const double error = cell_error(b, c, axis, nodes, place, place + nodes);
        free(place);
        if (error < 0) return 1;
        if (error <= part_for_cells * b->options.tolerance) return 0;
    }
    return 0;
}

/* Even cells of psi in [0, 1], or of chi. */
static int choose_even(const struct restitute_table_builder *b, const struct coarse *c, enum rst_axis axis,
                       int64_t *cells)
{
    double place[most_cells * rst_cubic + 1], middle[most_cells * rst_cubic];
    *cells = 0;
    if (!b->active[axis]) return 0;
    for (*cells = 1; *cells < most_cells; *cells += 1) {
        const int64_t n = *cells * rst_cubic;
        for (int64_t i = 0; i <= n; i++) {
            place[i] = (double)i / (double)n;
            if (i < n) middle[i] = ((double)i + 0.5) / (double)n;
        }
        const double error = cell_error(b, c, axis, n + 1, place, middle);
        if (error < 0) return 1;
        if (error <= part_for_cells * b->options.tolerance) return 0;
    }
    return 0;
}

double rst_t_of_root(double r, int turned)
{
    const double t = 2 / pi * asin(sqrt(rst_slip_y(r)));
    return turned ? 1 - t : t;
}

/* One half of the slip side, towards y = 0 or towards y = 1. */
static double slip_error(const struct restitute_table_builder *b, const struct coarse *c, int64_t cells, int turned)
{
    double place[most_cells * rst_cubic + 1], middle[most_cells * rst_cubic];
    const int64_t n = cells * rst_cubic;
    for (int64_t i = 0; i <= n; i++) {
        const double here = rst_slip_node(cells, i);
        place[i] = rst_t_of_root(here, turned);
        if (i < n) middle[i] = rst_t_of_root(0.5 * (here + rst_slip_node(cells, i + 1)), turned);
    }
    return cell_error(b, c, RST_SLIP, n + 1, place, middle);
}

static int choose_slip(const struct restitute_table_builder *b, const struct coarse *c, int64_t *cells)
{
    *cells = 0;
    if (!b->active[RST_SLIP]) return 0;
    for (*cells = 1; *cells < most_cells; *cells += 1) {
        const double low = slip_error(b, c, *cells, 0), high = slip_error(b, c, *cells, 1);
        if (low < 0 || high < 0) return 1;
        if (fmax(low, high) <= part_for_cells * b->options.tolerance) return 0;
    }
    return 0;
}

/* ---- the table */

/* Rows from Chebyshev points to nodes; NULL: out of memory. */
static double *octave_rows(const struct restitute_table_builder *b, enum rst_axis axis, const struct rst_octaves *o,
                           int64_t nodes)
{
    const int64_t n = b->n[axis];
    double *row = malloc((size_t)(nodes * n + 2 * nodes) * sizeof *row);
    if (!row) return NULL;
    if (o->cells == 0) {
        row[0] = 1;
        return row;
    }
    double *place = row + nodes * n;
    octave_places(b, axis, o, place, place + nodes);
    rst_panels_rows(&b->panels[axis], nodes, place, row);
    return row;
}

/* Rows from stick and slip points to nodes of psi, [psi][stick + slip]. */
static double *psi_rows(const struct restitute_table_builder *b, const restitute_table *t)
{
    const int64_t l = b->n[RST_STICK], r = b->active[RST_SLIP] ? b->n[RST_SLIP] : 0, n = l + r;
    double *row = calloc((size_t)(t->n_psi * n), sizeof *row), one[rst_most_points];
    if (!row) return NULL;
    for (int64_t i = 0; i < t->n_psi; i++) {
        const int slips = i >= t->start[1];
        const double stick = t->stick_cells ? (double)i / (double)(t->stick_cells * rst_cubic) : 0;
        const int turned = i >= t->start[2];
        const int64_t from_start = i - (turned ? t->start[2] : t->start[1]);
        const double place = slips ? rst_t_of_root(rst_slip_node(t->slip_cells, from_start), turned) : stick;
        rst_table_weights(slips ? r : l, place, one);
        memcpy(row + i * n + (slips ? l : 0), one, (size_t)(slips ? r : l) * sizeof *one);
    }
    return row;
}

/* Rows from points to nodes of chi. */
static double *chi_rows(const struct restitute_table_builder *b, const restitute_table *t)
{
    double *row = malloc((size_t)(t->n_chi * (b->n[RST_CHI] + 1)) * sizeof *row);
    if (!row) return NULL;
    double *place = row + t->n_chi * b->n[RST_CHI];
    for (int64_t i = 0; i < t->n_chi; i++)
        place[i] = t->n_chi > 1 ? (double)i / (double)(t->n_chi - 1) : 0;
    rst_panels_rows(&b->panels[RST_CHI], t->n_chi, place, row);
    return row;
}

/* ex at the nodes of psi, still at the points of speed, gamma and chi: [speed][gamma][psi][chi]. */
static double *over_psi(const struct coarse *c, const restitute_table *t, const double *row)
{
    const int64_t n = c->n_stick + c->n_slip, columns = c->n_speed * c->n_gamma;
    double *ex = malloc((size_t)(columns * t->n_psi * c->n_chi) * sizeof *ex);
    if (!ex) return NULL;
    for (int64_t i = 0; i < columns; i++)
        for (int64_t j = 0; j < t->n_psi; j++)
            for (int64_t k = 0; k < c->n_chi; k++) {
                const double *stick = c->stick + (i * c->n_chi + k) * c->n_stick;
                const double *slip = c->slip + (i * c->n_chi + k) * c->n_slip;
                double sum = 0;
                for (int64_t l = 0; l < n; l++)
                    sum += row[j * n + l] * (l < c->n_stick ? stick[l] : slip[l - c->n_stick]);
                ex[(i * t->n_psi + j) * c->n_chi + k] = sum;
            }
    return ex;
}

static int fill(const struct restitute_table_builder *b, const struct coarse *c, restitute_table *t)
{
    const int64_t inner = t->n_psi * t->n_chi;
    double *by_psi = psi_rows(b, t), *by_gamma = octave_rows(b, RST_GAMMA, &t->gamma, t->n_gamma);
    double *by_speed = octave_rows(b, RST_SPEED, &t->speed, t->n_speed);
    double *ex = by_psi ? over_psi(c, t, by_psi) : NULL, *by_chi = chi_rows(b, t);
    double *over_chi = malloc((size_t)(c->n_speed * c->n_gamma * inner) * sizeof *over_chi);
    double *wide = malloc((size_t)(c->n_speed * t->n_gamma * inner) * sizeof *wide);
    double *wide_ez = malloc((size_t)(c->n_speed * t->n_gamma) * sizeof *wide_ez);
    const int failed = !by_gamma || !by_speed || !ex || !by_chi || !over_chi || !wide || !wide_ez;
    if (!failed) {
        rst_table_along(1, c->n_chi, t->n_chi, c->n_speed * c->n_gamma * t->n_psi, by_chi, ex, over_chi);
        rst_table_along(inner, c->n_gamma, t->n_gamma, c->n_speed, by_gamma, over_chi, wide);
        rst_table_along(t->n_gamma * inner, c->n_speed, t->n_speed, 1, by_speed, wide, t->ex);
        rst_table_along(1, c->n_gamma, t->n_gamma, c->n_speed, by_gamma, c->ez, wide_ez);
        rst_table_along(t->n_gamma, c->n_speed, t->n_speed, 1, by_speed, wide_ez, t->ez);
    }
    free(by_psi);
    free(by_gamma);
    free(by_speed);
    free(by_chi);
    free(over_chi);
    free(ex);
    free(wide);
    free(wide_ez);
    return failed;
}

static int make(struct restitute_table_builder *b, struct coarse *c, restitute_table **table)
{
    restitute_table form;
    if (measure_tails(b, c)) return 1;
    rst_family_describe(&b->family, &form);
    form.chi_low = rst_builder_number(b, RST_CHI, b->active[RST_CHI] ? 0 : 0.5);
    form.chi_high = rst_builder_number(b, RST_CHI, b->active[RST_CHI] ? 1 : 0.5);
    if (choose_octaves(b, c, RST_SPEED, &form.speed) || choose_octaves(b, c, RST_GAMMA, &form.gamma) ||
        choose_even(b, c, RST_CHI, &form.chi_cells) || choose_even(b, c, RST_STICK, &form.stick_cells) ||
        choose_slip(b, c, &form.slip_cells))
        return 1;
    rst_table_count(&form);
    *table = rst_table_allocate(&form);
    if (!*table) return 1;
    if (b->family.material)
        restitute_material_series(b->family.material, NULL, NULL, (*table)->term, (*table)->term + form.terms);
    if (fill(b, c, *table)) {
        restitute_table_destroy(*table);
        return 1;
    }
    rst_table_set_polynomials(*table);
    return 0;
}

int rst_make_draft(struct restitute_table_builder *b, restitute_error *error)
{
    struct coarse c;
    restitute_table *table;
    if (coarse_allocate(b, &c)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    collect(b, &c);
    const int failed = make(b, &c, &table);
    free(c.ez);
    if (failed) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    restitute_table_destroy(b->draft);
    b->draft = table;
    return RESTITUTE_OK;
}
