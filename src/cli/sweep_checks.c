/* Numbers that the figures must meet.
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

/* How far the impacts in SI units lie from what their dimensionless numbers give. */
static int check_scatter(const struct sweep *sweep, const struct row *rows)
{
    double ez = 0, ex = 0;
    const double tolerance = sweep->settings->solver.tolerance;
    for (size_t i = 0; i < sweep->count; i++) {
        const struct sweep_sample *s = &sweep->samples[i];
        if (!rows[i].solved) continue;
        ez = fmax(ez, fabs(rows[i].number[ROW_EZ] - s->ez));
        if (isfinite(rows[i].number[ROW_CONTACT_TIME])) ex = fmax(ex, fabs(rows[i].number[ROW_EX] - s->ex));
    }
    return check("scatter of e_z about the curves", ez, 0, tolerance) +
           check("scatter of e_x about the curves", ex, 0, tolerance);
}

int sweep_check(const struct sweep *sweep, const struct row *rows, const struct chart *chart)
{
    int failed = 0;
    (void)chart;
    if (sweep->figure->kind != SWEEP_TEMPERATURE) failed += check_scatter(sweep, rows);
    return failed;
}
