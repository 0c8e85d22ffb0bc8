/* Reading --grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include "grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/files.h>

#include "fields.h"

static const char *const axis_names[2] = {"speed", "angle"};
static const enum field axis_fields[2] = {FIELD_SPEED, FIELD_ANGLE};
static const double most_points = 10000;    /* on an axis */
static const double most_impacts = 1000000; /* they are kept in memory, for the figure */

double grid_point(const struct grid_axis *axis, size_t index)
{
    if (index == 0) return axis->from;
    if (index + 1 == axis->count) return axis->to;
    const double part = (double)index / (double)(axis->count - 1);
    const double exact =
        axis->logarithmic ? axis->from * pow(axis->to / axis->from, part) : axis->from + (axis->to - axis->from) * part;
    char rounded[32];
    snprintf(rounded, sizeof rounded, "%.10g", exact);
    return strtod(rounded, NULL);
}

/* The parts behind "speed=": FROM, TO, N, and perhaps log. */
static bool read_parts(int which, char *text, struct grid_axis *axis, struct reason *why)
{
    char *part[5] = {NULL}, *rest = NULL, place[32];
    size_t parts = 0;
    for (char *at = strtok_r(text, ":", &rest); at && parts < 5; at = strtok_r(NULL, ":", &rest))
        part[parts++] = at;
    axis->logarithmic = parts == 4 && strcmp(part[3], "log") == 0;
    if (parts < 3 || parts > 4 || (parts == 4 && !axis->logarithmic))
        return refuse(why, "--grid: %s must be FROM:TO:N or FROM:TO:N:log", axis_names[which]);
    snprintf(place, sizeof place, "--grid: %s", axis_names[which]);
    if (!field_read(axis_fields[which], part[0], place, &axis->from, why) ||
        !field_read(axis_fields[which], part[1], place, &axis->to, why))
        return false;
    double count;
    if (restitute_number_read(part[2], &count) != RESTITUTE_OK || !(count >= 1 && count <= most_points) ||
        count != floor(count))
        return refuse(why, "%s: N = \"%.40s\": must be a whole number in [1, %g]", place, part[2], most_points);
    axis->count = (size_t)count;
    if (axis->logarithmic && !(axis->from > 0 && axis->to > 0))
        return refuse(why, "%s = %g: must be > 0 on a logarithmic axis", place, axis->from > 0 ? axis->to : axis->from);
    if (axis->count == 1 ? axis->from != axis->to : !(axis->from < axis->to))
        return refuse(why, "%s: FROM = %g must be %s TO = %g", place, axis->from,
                      axis->count == 1 ? "(with one point)" : "less than", axis->to);
    return true;
}

static bool read_axis(char *text, struct grid *grid, struct reason *why)
{
    for (int which = 0; which < 2; which++) {
        const size_t length = strlen(axis_names[which]);
        if (strncmp(text, axis_names[which], length) != 0 || text[length] != '=') continue;
        if (grid->axis[which].count) return refuse(why, "--grid: %s is given twice", axis_names[which]);
        return read_parts(which, text + length + 1, &grid->axis[which], why);
    }
    return refuse(why, "--grid: \"%.64s\" must be speed=FROM:TO:N[:log] or angle=FROM:TO:N[:log]", text);
}

bool grid_read(const char *text, struct grid *grid, struct reason *why)
{
    char *copy = copy_of(text), *rest = NULL;
    bool good = true;
    memset(grid, 0, sizeof *grid);
    for (char *at = strtok_r(copy, ",", &rest); at && good; at = strtok_r(NULL, ",", &rest))
        good = read_axis(at, grid, why);
    free(copy);
    if (!good) return false;
    for (int which = 0; which < 2; which++)
        if (!grid->axis[which].count) return refuse(why, "--grid: %s=FROM:TO:N is missing", axis_names[which]);
    const double impacts = (double)grid->axis[0].count * (double)grid->axis[1].count;
    if (impacts > most_impacts) return refuse(why, "--grid: %.0f impacts: must be at most %.0f", impacts, most_impacts);
    return true;
}
