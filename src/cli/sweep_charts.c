/* Charts of the figures.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_charts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "sweep_slip.h"

void sweep_line(const struct sweep *sweep, size_t curve, double *x, restitute_result *results)
{
    struct sweep_numbers numbers[SWEEP_LINE];
    struct reason why;
    for (size_t i = 0; i < SWEEP_LINE; i++) {
        x[i] = sweep_along(sweep->figure, (double)i / (SWEEP_LINE - 1));
        numbers[i] = sweep_numbers_at(sweep->figure, curve, x[i], 1);
    }
    sweep_solve(sweep->settings, SWEEP_LINE, numbers, results, &why); /* what fails is a gap */
    for (size_t i = 0; i < SWEEP_LINE; i++)
        if (isinf(results[i].contact_time)) results[i].ex = NAN; /* it stays in contact, and there is no after */
}

static void name_curve(const struct sweep_figure *f, size_t curve, char *name, size_t size)
{
    static const char *const rheologies[] = {"Kelvin-Voigt", "γ = %g", "Maxwell"};
    const double value = f->curve[curve];
    if (f->kind == SWEEP_TANGENT || f->kind == SWEEP_EZ || f->kind == SWEEP_NO_SLIP || f->kind == SWEEP_PSI_C)
        snprintf(name, size, rheologies[isnan(value) ? 2 : value > 0], value);
    else if (f->kind == SWEEP_PSI_C_ERROR)
        snprintf(name, size, "%g elements", value);
    else if (f->kind == SWEEP_TEMPERATURE)
        snprintf(name, size, "%g °C", value);
    else if (f->kind == SWEEP_MAXWELL)
        snprintf(name, size, "ψ = %g", value);
    else if (value > 0)
        snprintf(name, size, "δ_1 = %g", value);
    else
        snprintf(name, size, "elastic");
}

static const struct row *row_of(const struct sweep *sweep, const struct row *rows, size_t curve, size_t point)
{
    return &rows[curve * sweep->figure->points + point];
}

static double along(const struct sweep *sweep, size_t sample)
{
    const struct sweep_sample *s = &sweep->samples[sample];
    switch (sweep->figure->kind) {
    case SWEEP_MAXWELL:
        return s->numbers.relaxation;
    case SWEEP_FRICTION:
        return s->numbers.psi;
    case SWEEP_TEMPERATURE:
        return s->values.number[FIELD_SPEED] * cos(s->values.number[FIELD_ANGLE] * 3.14159265358979323846 / 180);
    default:
        return s->numbers.delta1;
    }
}

/* The drawn impacts of a curve: a number of their rows. */
static void add_points(struct panel *panel, const struct sweep *sweep, const struct row *rows, size_t curve, int number,
                       enum mark mark, const char *name)
{
    const size_t points = sweep->figure->points;
    struct series *s = chart_series(panel, mark, curve, points, name);
    for (size_t i = curve * points; i < (curve + 1) * points; i++) {
        const bool sunk = isinf(rows[i].number[ROW_CONTACT_TIME]) && number == ROW_EX;
        series_add(s, along(sweep, i), rows[i].solved && !sunk ? rows[i].number[number] : NAN);
    }
}

/* Lines of the dimensionless numbers, and the impacts drawn as points on them. */
static void add_curves(struct panel *panel, const struct sweep *sweep, const struct row *rows, int number)
{
    double x[SWEEP_LINE];
    restitute_result results[SWEEP_LINE];
    for (size_t curve = 0; curve < sweep->figure->curves; curve++) {
        char name[48];
        name_curve(sweep->figure, curve, name, sizeof name);
        sweep_line(sweep, curve, x, results);
        struct series *line = chart_series(panel, MARK_LINE, curve, SWEEP_LINE, name);
        for (size_t i = 0; i < SWEEP_LINE; i++)
            series_add(line, x[i], number == ROW_EZ ? results[i].ez : results[i].ex);
        add_points(panel, sweep, rows, curve, number, MARK_POINTS, "");
    }
}

static void axes(struct panel *panel, const char *title, const char *xlabel, const char *ylabel, bool xlog)
{
    snprintf(panel->title, sizeof panel->title, "%s", title);
    snprintf(panel->xlabel, sizeof panel->xlabel, "%s", xlabel);
    snprintf(panel->ylabel, sizeof panel->ylabel, "%s", ylabel);
    panel->xlog = xlog;
}

static void add_limit(struct panel *panel, double x1, double y1, double x2, double y2, const char *name)
{
    struct series *s = chart_series(panel, MARK_LIMIT, 0, 2, name);
    series_add(s, x1, y1);
    series_add(s, x2, y2);
}

/* psi_c by (31) over delta1; style: like which curve it is drawn. */
static void add_critical(struct panel *panel, const struct sweep *sweep, size_t curve, enum mark mark, const char *name)
{
    double x[SWEEP_LINE];
    restitute_result results[SWEEP_LINE];
    sweep_line(sweep, curve, x, results);
    struct series *s = chart_series(panel, mark, curve, SWEEP_LINE, name);
    const double chi = sweep_numbers_at(sweep->figure, curve, 1, 1).chi;
    for (size_t i = 0; i < SWEEP_LINE; i++)
        series_add(s, x[i], restitute_critical_psi(chi, results[i].ez));
}

static void draw_contours(struct chart *chart, const struct sweep *sweep, const struct row *rows)
{
    const struct sweep_figure *f = sweep->figure;
    struct panel *panel = &chart->panel[0];
    axes(panel, "", "δ_1", "ψ", true);
    chart_heights(panel, "e_x", f->points, f->curves, 0);
    for (size_t j = 0; j < f->curves; j++) {
        panel->heights.y[j] = sweep->samples[j * f->points].numbers.psi;
        for (size_t i = 0; i < f->points; i++) {
            const struct row *row = row_of(sweep, rows, j, i);
            panel->heights.x[i] = sweep->samples[i].numbers.delta1;
            panel->heights.z[j * f->points + i] = row->solved ? row->number[ROW_EX] : NAN;
        }
    }
    add_critical(panel, sweep, 0, MARK_LIMIT, "ψ_c");
    add_limit(panel, f->low, 1, f->high, 1, "ψ = 1");
    panel->series[1].mark = MARK_LINE;
}

double sweep_simulated_psi_c(const struct sweep *sweep, const struct sweep_numbers *numbers, int64_t elements)
{
    restitute_result result; /* tells the simulation radius and duration */
    struct reason why;
    return sweep_solve(sweep->settings, 1, numbers, &result, &why)
               ? sweep_critical_psi(numbers->chi, numbers->delta1, numbers->gamma, &result, elements)
               : NAN;
}

static void draw_critical(struct chart *chart, const struct sweep *sweep)
{
    const struct sweep_figure *f = sweep->figure;
    const bool error = f->kind == SWEEP_PSI_C_ERROR;
    struct panel *panel = &chart->panel[0];
    axes(panel, "", "δ_1", error ? "|simulated ψ_c / ψ_c − 1|" : "ψ_c", true);
    panel->ylog = error;
    for (size_t curve = 0; curve < f->curves; curve++) {
        char name[48];
        name_curve(f, curve, name, sizeof name);
        if (!error) add_critical(panel, sweep, curve, MARK_LINE, name);
        struct series *s = chart_series(panel, error ? MARK_BOTH : MARK_POINTS, curve, f->points, error ? name : "");
        for (size_t i = curve * f->points; i < (curve + 1) * f->points; i++) {
            const struct sweep_numbers *n = &sweep->samples[i].numbers;
            const double formula = restitute_critical_psi(n->chi, sweep->samples[i].ez);
            if (batch_interrupted()) return;
            const double simulated = sweep_simulated_psi_c(sweep, n, error ? (int64_t)f->curve[curve] : 64);
            series_add(s, n->delta1, error ? fabs(simulated / formula - 1) : simulated);
        }
    }
}

/* Whether a Maxwell body lets the sphere sink in: compression alone, docs/theory.md, D'' = -(15/8) P and
 * P' = sqrt(D) D' - P/tau by the midpoint rule. At last D' obeys tau v'' + v' + (15/8) tau sqrt(D) v = 0, which crosses
 * zero if it is not overdamped. */
static bool sinks_in(double tau)
{
    const double step = 1e-3;
    double depth = 0, v = 1, force = 0;
    while (v > 1e-8) {
        const double d = depth + 0.5 * step * v, w = v - 0.5 * step * 15 / 8 * force;
        const double f = force + 0.5 * step * (sqrt(depth) * v - force / tau);
        depth += step * w;
        v -= step * 15 / 8 * f;
        force += step * (sqrt(d) * w - f / tau);
    }
    return v > 0 && 7.5 * tau * tau * sqrt(depth) < 1;
}

static double no_rebound_limit(void)
{
    double low = 0.1, high = 3;
    while (high - low > 1e-5) {
        const double tau = 0.5 * (low + high);
        if (sinks_in(tau))
            low = tau;
        else
            high = tau;
    }
    return high;
}

static void draw_maxwell(struct chart *chart, const struct sweep *sweep, const struct row *rows)
{
    struct panel *z = &chart->panel[0], *x = &chart->panel[1];
    const double limit = no_rebound_limit();
    axes(z, "Normal restitution", "τ / T", "e_z", true);
    axes(x, "Tangential restitution", "τ / T", "e_x", true);
    add_curves(z, sweep, rows, ROW_EZ);
    add_curves(x, sweep, rows, ROW_EX);
    add_limit(z, limit, 0, limit, 1, "");
    add_limit(x, limit, -0.6, limit, 0.6, "limit of rebound");
}

static void draw_temperature(struct chart *chart, const struct sweep *sweep, const struct row *rows)
{
    axes(&chart->panel[0], "Normal restitution", "normal speed  (m/s)", "e_z", true);
    axes(&chart->panel[1], "Tangential restitution", "normal speed  (m/s)", "e_x", true);
    for (size_t curve = 0; curve < sweep->figure->curves; curve++) {
        char name[48];
        name_curve(sweep->figure, curve, name, sizeof name);
        add_points(&chart->panel[0], sweep, rows, curve, ROW_EZ, MARK_LINE, name);
        add_points(&chart->panel[1], sweep, rows, curve, ROW_EX, MARK_LINE, name);
    }
    chart->panel[0].yrange[0] = 0;
}

/* G''/G' at half a period per contact time, of the standard solid of G1 = 1 or the Maxwell body of G = 1. */
static double loss_tangent(const struct sweep_numbers *n, double contact_time)
{
    const double pi = 3.14159265358979323846, omega = pi / contact_time, theta = sqrt(32.0 / 15.0) * n->delta1;
    if (n->relaxation > 0) return 1 / (omega * n->relaxation);
    if (n->gamma == 0) return omega * theta;
    const double wt = omega * n->gamma * theta, arm = wt / n->gamma / (1 + wt * wt);
    return arm / (1 + arm * wt);
}

static void draw_tangent(struct chart *chart, const struct sweep *sweep, const struct row *rows)
{
    const struct sweep_figure *f = sweep->figure;
    axes(&chart->panel[0], "", "loss tangent at the frequency  1 / (2 contact time)", "e_z", true);
    for (size_t curve = 0; curve < f->curves; curve++) {
        char name[48];
        name_curve(f, curve, name, sizeof name);
        struct series *s = chart_series(&chart->panel[0], MARK_POINTS, curve, f->points, name);
        for (size_t i = curve * f->points; i < (curve + 1) * f->points; i++) {
            const struct sweep_numbers *n = &sweep->samples[i].numbers;
            restitute_result result;
            struct reason why;
            if (sweep_solve(sweep->settings, 1, n, &result, &why) && isfinite(result.contact_time) && rows[i].solved)
                series_add(s, loss_tangent(n, result.contact_time), rows[i].number[ROW_EZ]);
        }
    }
    chart->panel[0].xrange[1] = 20;
}

/* Parts of the energy of the tangential motion. */
static void draw_friction(struct chart *chart, const struct sweep *sweep)
{
    const struct sweep_figure *f = sweep->figure;
    const restitute_options options = sweep_fine_options(sweep->settings);
    restitute_solver *solver;
    axes(&chart->panel[0], "To friction", "ψ", "part of the tangential energy", false);
    axes(&chart->panel[1], "To the material", "ψ", "part of the tangential energy", false);
    if (restitute_solver_create(&options, &solver, NULL) < 0) return;
    for (size_t curve = 0; curve < f->curves; curve++) {
        char name[48];
        name_curve(f, curve, name, sizeof name);
        struct series *slip = chart_series(&chart->panel[0], MARK_LINE, curve, SWEEP_LINE, name);
        struct series *material = chart_series(&chart->panel[1], MARK_LINE, curve, SWEEP_LINE, name);
        for (size_t i = 0; i < SWEEP_LINE; i++) {
            const double psi = sweep_along(f, (double)i / (SWEEP_LINE - 1));
            const struct sweep_numbers n = sweep_numbers_at(f, curve, psi, 1);
            restitute_material *solid;
            const restitute_impact impact = sweep_impact(&n, &solid);
            restitute_result result;
            restitute_ledger ledger;
            restitute_result_init(&result);
            restitute_ledger_init(&ledger);
            if (restitute_solve(solver, &impact, &result, &ledger, NULL, NULL) < 0)
                ledger.friction_x = ledger.viscous_x = NAN;
            series_add(slip, psi, ledger.friction_x);
            series_add(material, psi, ledger.viscous_x + ledger.left_x);
        }
    }
    for (size_t i = 0; i < 2; i++)
        chart->panel[i].yrange[0] = 0, chart->panel[i].yrange[1] = 1;
    restitute_solver_destroy(solver);
}

struct chart *sweep_chart(const struct sweep *sweep, const struct cases *cases, const struct row *rows)
{
    const enum sweep_kind kind = sweep->figure->kind;
    const bool two = kind == SWEEP_MAXWELL || kind == SWEEP_TEMPERATURE || kind == SWEEP_FRICTION;
    struct chart *chart = chart_new(sweep->settings, two ? 2 : 1);
    struct panel *panel = &chart->panel[0];
    for (size_t i = 0; i < chart->panels && kind != SWEEP_FRICTION; i++)
        panel[i].xrange[0] = sweep->figure->low, panel[i].xrange[1] = sweep->figure->high;
    snprintf(chart->title, sizeof chart->title, "%s", sweep->figure->title);
    const char *slash = sweep->material ? strrchr(sweep->material, '/') : NULL;
    if (kind == SWEEP_TEMPERATURE)
        snprintf(chart->description, sizeof chart->description,
                 "%.100s; steel ball of radius 5 mm, friction 0.3, 30 degrees; times shifted as polyisobutylene's "
                 "(Williams, Landel and Ferry)",
                 slash ? slash + 1 : sweep->material);
    else
        snprintf(chart->description, sizeof chart->description, "χ = 7/6; %zu impacts drawn in SI units, seed %u",
                 cases->rows, sweep->settings->seed);
    if (kind == SWEEP_EZ || kind == SWEEP_NO_SLIP) {
        axes(panel, "", "δ_1", kind == SWEEP_EZ ? "e_z" : "e_x", true);
        panel->yrange[0] = kind == SWEEP_EZ ? 0 : NAN;
        add_curves(panel, sweep, rows, kind == SWEEP_EZ ? ROW_EZ : ROW_EX);
    } else if (kind == SWEEP_CONTOURS) {
        draw_contours(chart, sweep, rows);
    } else if (kind == SWEEP_PSI_C || kind == SWEEP_PSI_C_ERROR) {
        draw_critical(chart, sweep);
    } else if (kind == SWEEP_MAXWELL) {
        draw_maxwell(chart, sweep, rows);
    } else if (kind == SWEEP_TEMPERATURE) {
        draw_temperature(chart, sweep, rows);
    } else if (kind == SWEEP_TANGENT) {
        draw_tangent(chart, sweep, rows);
    } else {
        draw_friction(chart, sweep);
    }
    return chart;
}
