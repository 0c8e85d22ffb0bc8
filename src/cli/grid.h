/* The axes of --grid: NAME=FROM:TO:N[:log] of any field, or material=FILE:FILE:...; one or two of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_GRID_H
#define CLI_GRID_H

#include "fields.h"

struct grid_axis {
    enum field field;
    double from, to;
    size_t count;
    bool logarithmic;
    char **words; /* of the axis material: its files; else NULL */
};

struct grid {
    size_t axes;
    struct grid_axis axis[2]; /* as given, but speed before angle, material first */
};

/* Read the text of --grid; what was read is to be released. */
bool grid_read(const char *text, struct grid *grid, struct reason *why);
void grid_release(struct grid *grid);

/* Point number `index` of an axis as a cell. The inner points are rounded to ten digits, so that 0.3 is 0.3. */
struct reason grid_cell(const struct grid_axis *axis, size_t index);

#endif
