/* Numbers that the figures must meet: limits, identities and landmarks that do not come from the figure itself.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "sweep_charts.h"

/* One line; 1 if the value is outside. */
static int check(const char *what, double value, double low, double high)
{
    const bool good = value >= low && value <= high;
    printf("  %s: %.6g, must be in [%.6g, %.6g]: %s\n", what, value, low, high, good ? "ok" : "FAILED");
    return !good;
}

/* The larger one; NaN stays, and fails the check. */
static double worst(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

/* How far the impacts in SI units lie from what their dimensionless numbers give. */
static int check_scatter(const struct sweep *sweep, const struct row *rows)
{
    double ez = 0, ex = 0;
    const double tolerance = sweep->settings->solver.tolerance;
    for (size_t i = 0; i < sweep->count; i++) {
        const struct sweep_sample *s = &sweep->samples[i];
        if (!rows[i].solved) continue;
        ez = worst(ez, fabs(rows[i].number[ROW_EZ] - s->ez));
        if (isfinite(rows[i].number[ROW_CONTACT_TIME])) ex = worst(ex, fabs(rows[i].number[ROW_EX] - s->ex));
    }
    return check("scatter of e_z about the curves", ez, 0, tolerance) +
           check("scatter of e_x about the curves", ex, 0, tolerance);
}

static struct sweep_numbers numbers(double psi, double delta1, double gamma)
{
    return (struct sweep_numbers){.chi = 7.0 / 6, .psi = psi, .delta1 = delta1, .gamma = gamma};
}

static restitute_result solve(const struct sweep *sweep, struct sweep_numbers n)
{
    restitute_result result;
    struct reason why;
    sweep_solve(sweep->settings, 1, &n, &result, &why);
    return result;
}

/* Where a curve of the chart is lowest. */
static size_t lowest(const struct series *s)
{
    size_t at = 0;
    for (size_t i = 1; i < s->count; i++)
        if (s->y[i] < s->y[at]) at = i;
    return at;
}

/* docs/theory.md, section 12: both ends of the Kelvin-Voigt curve, with theta = sqrt(32/15) delta1. */
static int check_kelvin_voigt(const struct sweep *sweep, const struct chart *chart)
{
    const struct series *line = &chart->panel[0].series[0];
    const double small = sqrt(32.0 / 15) * 1e-3, large = sqrt(32.0 / 15) * 100;
    double rise = -1;
    for (size_t i = 1; i < line->count; i++)
        rise = worst(rise, line->y[i] - line->y[i - 1]);
    return check("largest rise of e_z between neighbours", rise, -1, 0) +
           check("(1 - e_z)/theta at delta1 = 0.001, in the limit 1.8917",
                 (1 - solve(sweep, numbers(0, 1e-3, 0)).ez) / small, 1.87, 1.8918) +
           check("e_z over its asymptote (4/(5 theta))^(2/3)/theta at delta1 = 100",
                 solve(sweep, numbers(0, 100, 0)).ez * large / pow(0.8 / large, 2.0 / 3), 0.97, 1.03);
}

/* The curve of gamma = 0.0825 is number 2; every curve is a line and its points. The grid of 241 places lets the
 * minimum lie 2 % beside its place and 1e-4 above its depth. */
static int check_minimum(const struct chart *chart)
{
    const struct series *line = &chart->panel[0].series[4];
    const size_t at = lowest(line);
    return check("gamma = 0.0825: least e_z", line->y[at], 0.1895, 0.1915) +
           check("gamma = 0.0825: delta1 of it", line->x[at], 1.2, 1.5) +
           check("gamma = 0.0825: e_z at delta1 = 100", line->y[line->count - 1], 0.95, 1);
}

/* The largest delta1 up to which e_x at psi = 2 stays above 0.45. */
static double reach(const struct sweep *sweep, const char *name)
{
    struct sweep other = {.figure = sweep_figure_named(name), .settings = sweep->settings};
    double x[SWEEP_LINE], end = 0;
    restitute_result results[SWEEP_LINE];
    sweep_line(&other, 30, x, results); /* curve 30 is psi = 2 */
    for (size_t i = 1; i < SWEEP_LINE; i++) {
        const double before = results[i - 1].ex - 0.45, after = results[i].ex - 0.45;
        end = x[i - 1] + (x[i] - x[i - 1]) * before / (before - after);
        if (after < 0) break;
    }
    return end;
}

static int check_elastic(const struct sweep *sweep)
{
    double best = 0, at = 0;
    const struct sweep_numbers elastic = numbers(1, 0, INFINITY);
    for (int i = 0; i <= 800; i++) {
        const double psi = 1.5 + 0.001 * i, ex = solve(sweep, numbers(psi, 0, INFINITY)).ex;
        if (ex > best) best = ex, at = psi;
    }
    return check("elastic: largest e_x", best, 0.5965, 0.5975) + check("elastic: psi of it", at, 1.88, 1.90) +
           check("elastic: psi_c by simulation with 128 elements, 11/3", sweep_simulated_psi_c(sweep, &elastic, 128),
                 11.0 / 3 - 1e-4, 11.0 / 3 + 1e-4);
}

static int check_contours(const struct sweep *sweep)
{
    const double kelvin_voigt = reach(sweep, "fig5"), weak = reach(sweep, "fig8"), strong = reach(sweep, "fig9");
    if (sweep->figure->curve[0] == 0) return check_elastic(sweep);
    if (sweep->figure->curve[0] < 1)
        return check("e_x > 0.45 at psi = 2 up to delta1, more than Kelvin-Voigt", weak / kelvin_voigt, 1.001,
                     INFINITY);
    return check("e_x > 0.45 at psi = 2 up to delta1, more than gamma = 0.0825", strong / weak, 1.1, INFINITY);
}

/* At both ends the solid is elastic, and an elastic sphere without slip has one e_x. */
static int check_no_slip(const struct sweep *sweep)
{
    const double elastic = solve(sweep, numbers(0, 0, INFINITY)).ex;
    return check("gamma = 1: e_x at delta1 = 1e-4 less the elastic one", solve(sweep, numbers(0, 1e-4, 1)).ex - elastic,
                 -1e-3, 1e-3) +
           check("gamma = 1: e_x at delta1 = 1e4 less the elastic one", solve(sweep, numbers(0, 1e4, 1)).ex - elastic,
                 -1e-3, 1e-3);
}

/* 64 elements of a scheme of first order: 8e-5 where it is worst. */
static int check_psi_c(const struct chart *chart, const struct sweep *sweep)
{
    double most = 0;
    for (size_t curve = 0; curve < sweep->figure->curves; curve++) {
        const struct series *s = &chart->panel[0].series[2 * curve + 1];
        for (size_t i = 0; i < s->count; i++) {
            const struct sweep_sample *sample = &sweep->samples[curve * sweep->figure->points + i];
            const double formula = restitute_critical_psi(sample->numbers.chi, sample->ez);
            most = worst(most, fabs(s->y[i] / formula - 1));
        }
    }
    return check("largest difference of simulations with 64 elements from (31)", most, 0, 1.5e-4);
}

/* Half the difference with twice the elements, at every delta1: the formula is the limit. */
static int check_convergence(const struct chart *chart)
{
    const struct series *coarse = &chart->panel[0].series[chart->panel[0].count - 2], *fine = coarse + 1;
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < fine->count; i++) {
        least = -worst(-least, -fine->y[i] / coarse->y[i]);
        most = worst(most, fine->y[i] / coarse->y[i]);
    }
    return check("difference with 64 elements over that with 32, least", least, 0.42, 0.58) +
           check("the same, largest", most, 0.42, 0.58);
}

/* The first is a value of tests/data/prony_truth.csv; the limit comes from the equation of the compression alone. */
static int check_maxwell(const struct sweep *sweep, const struct chart *chart)
{
    struct sweep_numbers n = numbers(2, 0, 0);
    n.relaxation = 3;
    struct sweep_numbers below = n, above = n;
    const double limit = chart->panel[0].series[chart->panel[0].count - 1].x[0];
    below.relaxation = 0.97 * limit;
    above.relaxation = 1.05 * limit;
    printf("  no rebound below tau = %.4f T\n", limit);
    return check("e_z at tau = 3 T, in the reference values 0.651750493", solve(sweep, n).ez, 0.651750, 0.651751) +
           check("duration over T at 0.97 of that, solved by the library", solve(sweep, below).contact_time, INFINITY,
                 INFINITY) +
           check("the same at 1.05", solve(sweep, above).contact_time, 0, 100);
}

/* Distance in e_z from the Kelvin-Voigt body of the same loss tangent, whose points come in order. */
static double distance(const struct series *kelvin_voigt, double x, double y)
{
    for (size_t i = 1; i < kelvin_voigt->count; i++) {
        const double *at = kelvin_voigt->x + i, *e = kelvin_voigt->y + i;
        if (x >= at[-1] && x < at[0]) return fabs(y - (e[-1] + (e[0] - e[-1]) * (x - at[-1]) / (at[0] - at[-1])));
    }
    return 0;
}

static int check_tangent(const struct chart *chart)
{
    double most = 0, small = 0;
    size_t outside = 0;
    const struct panel *panel = &chart->panel[0];
    const struct series *first = &panel->series[0];
    for (size_t curve = 1; curve < panel->count; curve++)
        for (size_t i = 0; i < panel->series[curve].count; i++) {
            const double x = panel->series[curve].x[i], d = distance(&panel->series[0], x, panel->series[curve].y[i]);
            outside += !(first->count > 0 && x >= first->x[0] && x < first->x[first->count - 1]);
            most = worst(most, d);
            if (x < 0.3) small = worst(small, d);
        }
    printf("  %zu points left out: no Kelvin-Voigt impact has their loss tangent\n", outside);
    return check("largest distance from Kelvin-Voigt at equal loss tangent", most, 0, 0.13) +
           check("the same at loss tangents below 0.3", small, 0, 0.09);
}

/* In slip to the end, psi = 6, e_x is (27), and what is lost without a dashpot is lost to friction. */
static int check_friction(const struct sweep *sweep, const struct chart *chart)
{
    const struct series *slip = &chart->panel[0].series[0], *material = &chart->panel[1].series[0];
    const double ex = solve(sweep, numbers(6, 0, INFINITY)).ex;
    double most = 0;
    for (size_t i = 0; i < material->count; i++)
        most = worst(most, fabs(material->y[i]));
    return check("elastic: part to friction at psi = 6 less 1 - e_x^2", slip->y[slip->count - 1] - (1 - ex * ex), -1e-4,
                 1e-4) +
           check("elastic: largest part to the material", most, 0, 1e-2);
}

int sweep_check(const struct sweep *sweep, const struct row *rows, const struct chart *chart)
{
    const enum sweep_kind kind = sweep->figure->kind;
    int failed = kind == SWEEP_TEMPERATURE ? 0 : check_scatter(sweep, rows);
    if (kind == SWEEP_EZ)
        failed += sweep->figure->curves == 1 ? check_kelvin_voigt(sweep, chart) : check_minimum(chart);
    if (kind == SWEEP_CONTOURS) failed += check_contours(sweep);
    if (kind == SWEEP_NO_SLIP) failed += check_no_slip(sweep);
    if (kind == SWEEP_PSI_C) failed += check_psi_c(chart, sweep);
    if (kind == SWEEP_PSI_C_ERROR) failed += check_convergence(chart);
    if (kind == SWEEP_MAXWELL) failed += check_maxwell(sweep, chart);
    if (kind == SWEEP_TANGENT) failed += check_tangent(chart);
    if (kind == SWEEP_FRICTION) failed += check_friction(sweep, chart);
    return failed;
}
