/* The figure of `restitute table build --figure`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>

#include "chart.h"
#include "table_settings.h"

enum { SPEEDS = 241, HEIGHT_SPEEDS = 81, ANGLES = 44 };
static const double degree = 3.14159265358979323846 / 180, steepest = 86; /* degrees from the normal */

static double speed_at(const restitute_table_info *i, size_t k, size_t n)
{
    return i->speed[0] * pow(i->speed[1] / i->speed[0], (double)k / (double)(n - 1));
}

/* All above `from`, over the whole height of a panel. */
static void shade(struct panel *panel, const restitute_table_info *i, double from, double bottom, size_t style,
                  const char *name)
{
    if (isinf(from)) return;
    struct series *s = chart_series(panel, MARK_ABOVE, style, 2, name);
    series_add(s, from, bottom);
    series_add(s, i->speed[1], bottom);
}

/* Angles from which on the slide is long. */
static void shade_slides(struct panel *panel, const restitute_table *table, const restitute_table_info *i, size_t style)
{
    struct series *s = chart_series(panel, MARK_ABOVE, style, SPEEDS, "slide");
    for (size_t k = 0; k < SPEEDS; k++) {
        const double v = speed_at(i, k, SPEEDS);
        double low = 0, high = steepest;
        for (int step = 0; step < 20; step++) {
            const double angle = 0.5 * (low + high);
            int flags = 0;
            restitute_table_flags(table, v, v * tan(angle * degree), &flags, NULL);
            *(flags & RESTITUTE_FLAG_LONG_SLIDE ? &high : &low) = angle;
        }
        series_add(s, v, high);
    }
}

static void axes(struct panel *panel, const char *title, const char *ylabel, double low, double high)
{
    snprintf(panel->title, sizeof panel->title, "%s", title);
    snprintf(panel->xlabel, sizeof panel->xlabel, "normal speed (m/s)");
    snprintf(panel->ylabel, sizeof panel->ylabel, "%s", ylabel);
    panel->xlog = true;
    panel->yrange[0] = low;
    panel->yrange[1] = high;
}

static void draw_ez(struct panel *panel, const restitute_table *table, const restitute_table_info *i)
{
    axes(panel, "e_z", "e_z", 0, 1);
    panel->xrange[0] = i->speed[0];
    panel->xrange[1] = i->speed[1];
    shade(panel, i, i->fast_speed, 0, 1, "");
    shade(panel, i, i->large_contact_speed, 0, 2, "");
    struct series *s = chart_series(panel, MARK_LINE, 0, SPEEDS, "");
    for (size_t k = 0; k < SPEEDS; k++) {
        const double v = speed_at(i, k, SPEEDS);
        double ez;
        restitute_table_pair(table, NULL, v, 0, &ez, NULL, NULL);
        series_add(s, v, ez);
    }
}

static void draw_ex(struct panel *panel, const restitute_table *table, const restitute_table_info *i)
{
    axes(panel, "e_x", "angle to the normal (degrees)", 0, steepest);
    chart_heights(panel, "e_x", HEIGHT_SPEEDS, ANGLES, 0);
    struct heights *h = &panel->heights;
    for (size_t row = 0; row < ANGLES; row++) {
        h->y[row] = steepest * (double)row / (ANGLES - 1);
        for (size_t k = 0; k < HEIGHT_SPEEDS; k++) {
            const double v = h->x[k] = speed_at(i, k, HEIGHT_SPEEDS);
            restitute_table_pair(table, NULL, v, v * tan(h->y[row] * degree), NULL, &h->z[row * HEIGHT_SPEEDS + k],
                                 NULL);
        }
    }
    shade(panel, i, i->fast_speed, 0, 1, "v/c_s");
    shade(panel, i, i->large_contact_speed, 0, 2, "a/R");
    shade_slides(panel, table, i, 3);
}

bool table_figure(const restitute_table *table, const struct table_settings *settings, const char *path,
                  struct reason *why)
{
    struct settings none = {.argument_count = settings->argument_count, .arguments = settings->arguments};
    restitute_table_info info;
    restitute_options_init(&none.solver);
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    struct chart *chart = chart_new(&none, 2);
    snprintf(chart->title, sizeof chart->title, "Restitution of one contact");
    snprintf(chart->description, sizeof chart->description,
             "friction %g, effective radius %g m, mass %g kg; shaded: beyond the limits of the model", info.friction,
             info.radius, info.mass);
    snprintf(chart->origin, sizeof chart->origin, "restitute %s, table, errors %.1e, %.1e", info.version, info.error_ez,
             info.error_ex);
    draw_ez(&chart->panel[0], table, &info);
    draw_ex(&chart->panel[1], table, &info);
    const bool good = chart_draw(chart, path, why);
    chart_release(chart);
    return good;
}
