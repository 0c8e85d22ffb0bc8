/* The grid of --grid: speed=FROM:TO:N[:log],angle=FROM:TO:N[:log].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_GRID_H
#define CLI_GRID_H

#include "message.h"

struct grid_axis {
    double from, to;
    size_t count; /* 0: not given */
    bool logarithmic;
};

struct grid {
    struct grid_axis axis[2]; /* speed in m/s, angle in degrees */
};

/* Read the text of --grid; both axes are required, in any order. */
bool grid_read(const char *text, struct grid *grid, struct reason *why);

/* Point number `index` of an axis. The inner points are rounded to ten digits, so that 0.3 is 0.3. */
double grid_point(const struct grid_axis *axis, size_t index);

#endif
