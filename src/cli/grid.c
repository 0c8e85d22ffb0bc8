/* Reading --grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/number.h"

static const double most_points = 10000;    /* on an axis */
static const double most_impacts = 1000000; /* they are kept in memory, for the figure */

static double grid_point(const struct grid_axis *axis, size_t index)
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

struct reason grid_cell(const struct grid_axis *axis, size_t index)
{
    struct reason cell;
    snprintf(cell.text, sizeof cell.text, "%s",
             axis->words ? axis->words[index] : number_text(grid_point(axis, index)).text);
    return cell;
}

/* The parts behind "speed=": FROM, TO, N, and perhaps log. */
static bool read_numbers(const char *name, char *text, struct grid_axis *axis, struct reason *why)
{
    char *part[5] = {NULL}, *rest = NULL, place[80];
    size_t parts = 0;
    for (char *at = strtok_r(text, ":", &rest); at && parts < 5; at = strtok_r(NULL, ":", &rest))
        part[parts++] = at;
    axis->logarithmic = parts == 4 && strcmp(part[3], "log") == 0;
    if (parts < 3 || parts > 4 || (parts == 4 && !axis->logarithmic))
        return refuse(why, "--grid: %s must be FROM:TO:N or FROM:TO:N:log", name);
    snprintf(place, sizeof place, "--grid: %s", name);
    if (!field_read(axis->field, part[0], place, &axis->from, why) ||
        !field_read(axis->field, part[1], place, &axis->to, why))
        return false;
    double count;
    if (rst_number_read(part[2], &count) != RESTITUTE_OK || !(count >= 1 && count <= most_points) ||
        count != floor(count))
        return refuse(why, "%s: N = \"%.40s\": must be a whole number in [1, %g]", place, part[2], most_points);
    axis->count = (size_t)count;
    if (!isfinite(axis->from) || !isfinite(axis->to)) return refuse(why, "%s: both ends must be finite", place);
    if (axis->logarithmic && !(axis->from > 0 && axis->to > 0))
        return refuse(why, "%s = %g: must be > 0 on a logarithmic axis", place, axis->from > 0 ? axis->to : axis->from);
    if (axis->count == 1 ? axis->from != axis->to : !(axis->from < axis->to))
        return refuse(why, "%s: FROM = %g must be %s TO = %g", place, axis->from,
                      axis->count == 1 ? "(with one point)" : "less than", axis->to);
    return true;
}

static bool read_files(char *text, struct grid_axis *axis, struct reason *why)
{
    char *rest = NULL;
    axis->field = FIELD_COUNT;
    axis->words = allocate(strlen(text) + 1, sizeof *axis->words);
    for (char *at = strtok_r(text, ":", &rest); at; at = strtok_r(NULL, ":", &rest))
        axis->words[axis->count++] = copy_of(at);
    return axis->count ? true : refuse(why, "--grid: material must be FILE:FILE:...");
}

/* A field by the name of its option. */
static enum field field_of_axis(const char *name)
{
    enum field field = 0;
    while (field < FIELD_COUNT && strcmp(name, field_rules[field].option) != 0 &&
           !(field_rules[field].alias && strcmp(name, field_rules[field].alias) == 0))
        field++;
    return field;
}

static bool read_axis(char *text, struct grid *grid, struct reason *why)
{
    char *equals = strchr(text, '=');
    if (grid->axes == 2) return refuse(why, "--grid: one or two axes, not more");
    if (equals) *equals = '\0';
    struct grid_axis *axis = &grid->axis[grid->axes];
    const bool material = strcmp(text, "material") == 0;
    axis->field = material ? FIELD_COUNT : field_of_axis(text);
    if (!equals || (!material && axis->field == FIELD_COUNT))
        return refuse(why,
                      "--grid: \"%.64s\" must be NAME=FROM:TO:N[:log], NAME that of an option such as speed, angle or "
                      "psi, or material=FILE:FILE:...",
                      text);
    grid->axes++;
    if (grid->axes == 2 && grid->axis[0].field == axis->field) return refuse(why, "--grid: %s is given twice", text);
    return material ? read_files(equals + 1, axis, why) : read_numbers(text, equals + 1, axis, why);
}

/* Curves are made of the first axis; those of a speed, over the angle, and of materials. */
static void put_in_order(struct grid *grid)
{
    const struct grid_axis first = grid->axis[0];
    if (grid->axes < 2) return;
    if (!grid->axis[1].words && !(first.field == FIELD_ANGLE && grid->axis[1].field == FIELD_SPEED)) return;
    grid->axis[0] = grid->axis[1];
    grid->axis[1] = first;
}

bool grid_read(const char *text, struct grid *grid, struct reason *why)
{
    char *copy = copy_of(text), *rest = NULL;
    bool good = true;
    memset(grid, 0, sizeof *grid);
    for (char *at = strtok_r(copy, ",", &rest); at && good; at = strtok_r(NULL, ",", &rest))
        good = read_axis(at, grid, why);
    free(copy);
    if (good && grid->axes == 0) good = refuse(why, "--grid: is empty: must be NAME=FROM:TO:N[:log]");
    const double impacts = (double)grid->axis[0].count * (grid->axes > 1 ? (double)grid->axis[1].count : 1);
    if (good && impacts > most_impacts)
        good = refuse(why, "--grid: %.0f impacts: must be at most %.0f", impacts, most_impacts);
    if (good) put_in_order(grid);
    if (!good) grid_release(grid);
    return good;
}

void grid_release(struct grid *grid)
{
    for (size_t k = 0; k < 2; k++) {
        for (size_t i = 0; grid->axis[k].words && i < grid->axis[k].count; i++)
            free(grid->axis[k].words[i]);
        free(grid->axis[k].words);
    }
    memset(grid, 0, sizeof *grid);
}
