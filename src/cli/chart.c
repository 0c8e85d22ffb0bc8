/* Charts.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "chart.h"

#include <math.h>
#include <stdlib.h>

#include "gnuplot.h"

unsigned chart_colour(double fraction)
{
    static const unsigned char anchors[][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139}, {44, 113, 142},
                                               {33, 144, 141}, {39, 173, 129}, {92, 200, 99}, {170, 220, 50}};
    const int last = sizeof anchors / sizeof anchors[0] - 1;
    const double at = fraction * last;
    const int cell = at >= last ? last - 1 : (int)at;
    unsigned colour = 0;
    for (int i = 0; i < 3; i++) {
        const double value = anchors[cell][i] + (at - cell) * (anchors[cell + 1][i] - anchors[cell][i]);
        colour = colour << 8 | (unsigned)lround(value);
    }
    return colour;
}

void chart_origin(const struct settings *settings, char *text, size_t size)
{
    snprintf(text, size, "restitute %s, method %s, tolerance %s", restitute_version(),
             restitute_method_name(settings->solver.method), number_text(settings->solver.tolerance).text);
}

static void label(FILE *commands, int number, const char *text, const char *place)
{
    fprintf(commands, "set label %d ", number);
    gnuplot_string(commands, text);
    fprintf(commands, " at screen %s noenhanced\n", place);
}

void chart_frame(FILE *commands, const char *title, const char *description, const char *origin)
{
    label(commands, 1, title, "0.02,0.955 font ',16'");
    label(commands, 2, description, "0.02,0.89 font ',12' textcolor rgb '#555555'");
    label(commands, 3, origin, "0.985,0.955 right font ',10' textcolor rgb '#888888'");
    fputs("set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\n"
          "set grid linecolor rgb '#dddddd' linewidth 0.7 linetype 1\nset key noautotitle\n",
          commands);
}

struct chart *chart_new(const struct settings *settings, size_t panels)
{
    struct chart *chart = allocate(1, sizeof *chart);
    chart->panels = panels;
    for (size_t i = 0; i < CHART_PANELS; i++)
        for (int end = 0; end < 2; end++)
            chart->panel[i].xrange[end] = chart->panel[i].yrange[end] = NAN;
    chart_origin(settings, chart->origin, sizeof chart->origin);
    return chart;
}

void chart_release(struct chart *chart)
{
    for (size_t i = 0; chart && i < chart->panels; i++) {
        for (size_t k = 0; k < chart->panel[i].count; k++)
            free(chart->panel[i].series[k].x);
        free(chart->panel[i].heights.x);
    }
    free(chart);
}

struct series *chart_series(struct panel *panel, enum mark mark, size_t style, size_t count, const char *name)
{
    if (panel->count == PANEL_SERIES) return NULL;
    struct series *series = &panel->series[panel->count++];
    *series = (struct series){.mark = mark, .style = style, .x = allocate(2 * count, sizeof(double))};
    series->y = series->x + count;
    snprintf(series->name, sizeof series->name, "%s", name);
    return series;
}

void series_add(struct series *series, double x, double y)
{
    series->x[series->count] = x;
    series->y[series->count++] = y;
}

void chart_heights(struct panel *panel, const char *name, size_t nx, size_t ny, double noise)
{
    double *values = allocate(nx + ny + nx * ny, sizeof *values);
    panel->heights = (struct heights){
        .name = name, .nx = nx, .ny = ny, .x = values, .y = values + nx, .z = values + nx + ny, .noise = noise};
}

static void write_series(FILE *commands, size_t panel, const struct panel *p)
{
    for (size_t k = 0; k < p->count; k++) {
        fprintf(commands, "$s%zu_%zu << END\n", panel, k);
        for (size_t i = 0; i < p->series[k].count; i++)
            fprintf(commands, "%.8g %.8g\n", p->series[k].x[i], p->series[k].y[i]);
        if (p->series[k].count == 0) fputs("NaN NaN\n", commands);
        fputs("END\n", commands);
    }
}

struct levels {
    double low, high, interval; /* 0: the heights are all the same */
};

/* The interval is 1, 2 or 5 times a power of ten, and there are 5 to 13 levels. gnuplot writes them with six digits. */
static struct levels levels_of(const struct heights *h)
{
    static const double factors[] = {10, 5, 2, 1};
    struct levels l = {INFINITY, -INFINITY, 0};
    for (size_t i = 0; i < h->nx * h->ny; i++)
        l.low = fmin(l.low, h->z[i]), l.high = fmax(l.high, h->z[i]);
    const double range = l.high - l.low, power = pow(10, floor(log10(range / 13)));
    if (range > fmax(h->noise, 1e-4))
        for (size_t i = 0; i < 4 && range <= 13 * factors[i] * power; i++)
            l.interval = factors[i] * power;
    return l;
}

/* A point of every line, about its middle: the third, half and two thirds by turns, so that labels seldom meet. */
static void write_label_places(FILE *commands, size_t panel)
{
    fprintf(commands,
            "set print $l%zu\nn = 0\nturn = 0\ndo for [i=1:|$c%zu|] {\n"
            "  if (words($c%zu[i]) == 3 && word($c%zu[i],1) ne '#') {\n    n = n + 1\n  } else {\n"
            "    if (n > 0) { print $c%zu[i - 1 - n * (2 + turn) / 6]; turn = (turn + 1) %% 3 }\n    n = 0\n  }\n}\n"
            "unset print\n",
            panel, panel, panel, panel, panel);
}

/* The lines come from gnuplot as a block of text, in which a level is a column. */
static void write_contours(FILE *commands, size_t panel, const struct heights *h)
{
    const struct levels l = levels_of(h);
    if (l.interval == 0) return;
    fprintf(commands, "$h%zu << END\n", panel);
    for (size_t j = 0; j < h->ny; j++) {
        for (size_t i = 0; i < h->nx; i++)
            fprintf(commands, "%.8g %.8g %.8g\n", h->x[i], h->y[j], h->z[j * h->nx + i]);
        fputc('\n', commands);
    }
    fprintf(commands,
            "END\nset contour base\nunset surface\nset cntrparam linear\nset cntrparam levels incremental %g,%g,%g\n"
            "set table $c%zu\nsplot $h%zu using 1:2:3\nunset table\nunset contour\nset surface\n",
            ceil(l.low / l.interval) * l.interval, l.interval, l.high, panel, panel);
    write_label_places(commands, panel);
}

/* Solid above zero, thick at zero, dashed below; the level stands on the line. NaN: something to plot without lines. */
static void plot_contours(FILE *commands, size_t panel, const struct heights *h)
{
    const struct levels l = levels_of(h);
    const double zero = 1e-3 * l.interval;
    if (l.interval == 0)
        fprintf(commands, "set label '%s = %.4g everywhere' at graph 0.5,0.5 center\nplot NaN", h->name,
                0.5 * (l.low + l.high));
    else
        fprintf(commands,
                "plot NaN, $c%zu using 1:($3>%g?$2:NaN) with lines linewidth 1.1 linecolor rgb '#3b518b', \\\n"
                "  '' using 1:(abs($3)<=%g?$2:NaN) with lines linewidth 2.4 linecolor rgb '#222222', \\\n"
                "  '' using 1:($3<-%g?$2:NaN) with lines linewidth 1.1 dashtype 2 linecolor rgb '#777777'",
                panel, zero, zero, zero);
}

static void plot_levels(FILE *commands, size_t panel, const struct heights *h)
{
    const double interval = levels_of(h).interval;
    if (interval > 0)
        fprintf(commands, ", \\\n  $l%zu using 1:2:(sprintf('%%g',abs($3)<%g?0:$3)) with labels font ',10' boxed",
                panel, 1e-3 * interval);
}

static void plot_title(FILE *commands, const struct series *s)
{
    if (!*s->name) return;
    fputs(" title ", commands);
    gnuplot_string(commands, s->name);
}

static void plot_shade(FILE *commands, const char *data, const struct series *s, double top, bool named)
{
    static const unsigned colours[] = {0x777777, 0xb03030, 0xc08020, 0x3b518b};
    fprintf(commands, "%s using 1:2 with filledcurves y=%g fillstyle transparent solid 0.22 noborder linecolor rgb '#%06x'",
            data, top, colours[s->style % 4]);
    if (named) plot_title(commands, s);
}

static void plot_series(FILE *commands, const char *data, const struct series *s, size_t styles, bool named)
{
    static const char *const kinds[] = {
        [MARK_LINE] = "lines", [MARK_POINTS] = "points", [MARK_BOTH] = "linespoints", [MARK_LIMIT] = "lines"};
    static const int points[] = {4, 6, 8, 10, 12, 1, 2}; /* hollow ones, plus and cross */
    const unsigned colour = s->mark == MARK_LIMIT ? 0xb03030 : chart_colour((double)s->style / (double)styles);
    fprintf(commands, "%s using 1:2 with %s linecolor rgb '#%06x'", data, kinds[s->mark], colour);
    if (s->mark != MARK_POINTS)
        fprintf(commands, " linewidth %g dashtype %zu", s->mark == MARK_LIMIT ? 2.2 : 1.7,
                s->mark == MARK_LIMIT ? 4 : 1 + s->style % 5);
    if (s->mark == MARK_POINTS || s->mark == MARK_BOTH)
        fprintf(commands, " pointtype %d pointsize %g", s->mark == MARK_BOTH ? 7 : points[s->style % 7],
                s->mark == MARK_BOTH ? 0.35 : 0.5);
    if (named) plot_title(commands, s);
}

static void range(FILE *commands, char axis, const double ends[2], bool logarithmic)
{
    char text[2][32];
    for (int i = 0; i < 2; i++)
        snprintf(text[i], sizeof text[i], isnan(ends[i]) ? "*" : "%g", ends[i]);
    fprintf(commands, "set %crange [%s:%s]\n%sset logscale %c\nset format %c '%s'\n", axis, text[0], text[1],
            logarithmic ? "" : "un", axis, axis,
            !logarithmic  ? "%h"
            : axis == 'y' ? "10^{%T}"
                          : "%g");
}

static void text_setting(FILE *commands, const char *what, const char *text)
{
    fprintf(commands, "set %s ", what);
    gnuplot_string(commands, text);
    fputc('\n', commands);
}

/* Where panel `index` stands on the sheet, its key of so many lines to the right of it: smaller if they are many. */
static void place(FILE *commands, size_t index, size_t panels, size_t lines)
{
    static const double places[][2] = {{0.125, 0.78}, {0.085, 0.42}, {0.53, 0.85}};
    const double *at = places[panels == 1 ? 0 : 1 + index];
    fprintf(
        commands,
        "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen 0.14\nset tmargin at screen 0.78\n",
        at[0], at[1]);
    if (lines)
        fprintf(commands, "set key at screen %g,0.8 left top Left reverse samplen %g font ',%d' spacing %g\n",
                at[1] + 0.012, lines > 8 ? 1.2 : 1.8, lines > 8 ? 9 : 14, lines > 8 ? 0.9 : 1.15);
}

static void plot_panel(FILE *commands, const struct chart *chart, size_t index)
{
    const struct panel *p = &chart->panel[index];
    const struct heights *h = &p->heights;
    const bool key = index + 1 == chart->panels;
    size_t styles = 1, named = 0;
    const char *separator = "plot ";
    for (size_t k = 0; k < p->count; k++)
        styles = p->series[k].style > styles ? p->series[k].style : styles, named += *p->series[k].name != '\0';
    place(commands, index, chart->panels, key ? named : 0);
    text_setting(commands, "title", p->title);
    text_setting(commands, "xlabel", p->xlabel);
    text_setting(commands, "ylabel", p->ylabel);
    if (key && *p->key) text_setting(commands, "key title", p->key);
    range(commands, 'x', p->xrange, p->xlog);
    range(commands, 'y', p->yrange, p->ylog);
    if (h->nx) {
        const double x[] = {h->x[0], h->x[h->nx - 1]}, y[] = {h->y[0], h->y[h->ny - 1]};
        range(commands, 'x', x, p->xlog);
        range(commands, 'y', y, p->ylog);
        plot_contours(commands, index, h);
        separator = ", \\\n  ";
    }
    for (size_t k = 0; k < p->count; k++, separator = ", \\\n  ") {
        char data[48];
        snprintf(data, sizeof data, "$s%zu_%zu", index, k);
        fputs(separator, commands);
        if (p->series[k].mark == MARK_ABOVE)
            plot_shade(commands, data, &p->series[k], p->yrange[1], key);
        else
            plot_series(commands, data, &p->series[k], styles, key);
    }
    plot_levels(commands, index, h);
    fputs("\nunset label\nset key notitle\n", commands);
}

bool chart_draw(const struct chart *chart, const char *path, struct reason *why)
{
    struct gnuplot gnuplot;
    if (!gnuplot_open(path, chart->panels == 1 ? 760 : 1080, 480, &gnuplot, why)) return false;
    FILE *commands = gnuplot.commands;
    for (size_t i = 0; i < chart->panels; i++) {
        write_series(commands, i, &chart->panel[i]);
        write_contours(commands, i, &chart->panel[i].heights);
    }
    chart_frame(commands, chart->title, chart->description, chart->origin);
    fputs("set xzeroaxis linetype 1 linewidth 1 linecolor rgb '#444444'\n"
          "set style textbox opaque noborder fillcolor rgb 'white' margins 0.4,0.4\nset multiplot\n",
          commands);
    for (size_t i = 0; i < chart->panels; i++)
        plot_panel(commands, chart, i);
    fputs("unset multiplot\n", commands);
    return gnuplot_close(&gnuplot, why);
}
