/* Charts of one or two panels: curves, points and contour lines, drawn by gnuplot. Readable in grey: curves differ by
 * dashes and marks as well as by colour, and the key stands beside the data.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_CHART_H
#define CLI_CHART_H

#include <stdio.h>

#include "options.h"

enum mark { MARK_LINE, MARK_POINTS, MARK_BOTH, MARK_LIMIT, MARK_ABOVE };

/* A curve or points. LIMIT: a thick dark line across the others. ABOVE: all above it is shaded, up to the end of the axis. */
struct series {
    char name[48]; /* in the key; empty: not there */
    enum mark mark;
    size_t style; /* like styles belong together; the least is the darkest */
    size_t count;
    double *x, *y; /* NaN: a gap */
};

/* Heights over a rectangular grid, z[j * nx + i] at (x[i], y[j]). */
struct heights {
    const char *name;
    size_t nx, ny;
    double *x, *y, *z;
    double noise; /* heights that differ by less are the same */
};

enum { PANEL_SERIES = 40, KEY_LINES = 15 /* at most, in one column */, CHART_PANELS = 2 };

struct panel {
    char title[64], xlabel[96], ylabel[96], key[48];
    bool xlog, ylog;
    double xrange[2], yrange[2]; /* NaN: as the data */
    struct heights heights;      /* nx = 0: none */
    size_t count;
    struct series series[PANEL_SERIES];
};

struct chart {
    char title[128], description[600], origin[160]; /* above the panels: what, given what, made how */
    size_t panels;
    struct panel panel[CHART_PANELS];
};

/* An empty chart; title and description are given later. */
struct chart *chart_new(const struct settings *settings, size_t panels);
void chart_release(struct chart *chart);

/* Room for a curve of `count` points at most, to be filled. NULL: the panel has no room for it. */
struct series *chart_series(struct panel *panel, enum mark mark, size_t style, size_t count, const char *name);
void series_add(struct series *series, double x, double y);

/* Room for heights to be filled; x and y ascend and are the ends of the axes. */
void chart_heights(struct panel *panel, const char *name, size_t nx, size_t ny, double noise);

/* Draw it; several endings, several files. */
bool chart_draw(const struct chart *chart, const char *path, struct reason *why);

/* A colour between dark violet and light green, told apart in grey print too, for a fraction in [0, 1]. */
unsigned chart_colour(double fraction);

/* Title, description and origin around panels, and how axes look. */
void chart_frame(FILE *commands, const char *title, const char *description, const char *origin);
void chart_origin(const struct settings *settings, char *text, size_t size);

#endif
