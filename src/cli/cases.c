/* Rows of a case file, or points of a grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "grid.h"

const char *cases_name(const struct cases *cases, size_t column)
{
    return cases->csv ? rst_csv_name(cases->csv, column) : cases->names[column];
}

const char *cases_cell(const struct cases *cases, size_t row, size_t column)
{
    row += cases->first;
    return cases->csv ? rst_csv_cell(cases->csv, row, column) : cases->cells[row * cases->columns + column];
}

size_t cases_line(const struct cases *cases, size_t row)
{
    row += cases->first;
    return cases->csv ? rst_csv_line(cases->csv, row) : row + 1;
}

void cases_make(struct cases *cases, size_t rows, size_t columns, const char *const *names, size_t notes)
{
    memset(cases, 0, sizeof *cases);
    cases->rows = cases->all = rows;
    cases->columns = columns;
    cases->notes = notes;
    memcpy(cases->names, names, columns * sizeof *names);
    cases->cells = allocate(rows * columns, sizeof *cases->cells);
}

void cases_set(struct cases *cases, size_t row, size_t column, const char *text)
{
    char **cell = &cases->cells[row * cases->columns + column];
    free(*cell);
    *cell = copy_of(text);
}

void cases_shard(struct cases *cases, size_t shard, size_t shards)
{
    cases->first = cases->all * (shard - 1) / shards;
    cases->rows = cases->all * shard / shards - cases->first;
}

static bool open_grid(const char *text, struct cases *cases, struct reason *why)
{
    struct grid grid;
    const char *names[2];
    if (!grid_read(text, &grid, why)) return false;
    for (size_t i = 0; i < grid.axes; i++)
        names[i] = grid.axis[i].words ? "material" : field_rules[grid.axis[i].field].column;
    cases_make(cases, grid.axis[0].count * (grid.axes > 1 ? grid.axis[1].count : 1), grid.axes, names, 0);
    cases->axes = grid.axes;
    for (size_t k = 0, block = cases->rows; k < grid.axes; k++) {
        cases->axis[k] = grid.axis[k].count;
        cases->logarithmic[k] = grid.axis[k].logarithmic;
        block /= grid.axis[k].count;
        for (size_t i = 0; i < cases->rows; i++)
            cases_set(cases, i, k, grid_cell(&grid.axis[k], i / block % grid.axis[k].count).text);
    }
    grid_release(&grid);
    return true;
}

bool cases_open(const struct settings *settings, struct cases *cases, struct reason *why)
{
    const char *path = settings->text[TEXT_INPUT];
    restitute_error error;
    memset(cases, 0, sizeof *cases);
    if (settings->text[TEXT_GRID]) return open_grid(settings->text[TEXT_GRID], cases, why);
    if (rst_csv_read(path, RST_BYTES_OF_TABLE, &cases->csv, &error) < 0) return refuse(why, "%s", error.message);
    cases->source = strcmp(path, "-") == 0 ? "standard input" : path;
    cases->rows = cases->all = rst_csv_rows(cases->csv);
    cases->columns = rst_csv_columns(cases->csv);
    if (cases->rows == 0) {
        cases_release(cases);
        return refuse(why, "%.200s: has column names but no rows", cases->source);
    }
    return true;
}

void cases_release(struct cases *cases)
{
    rst_csv_destroy(cases->csv);
    cases->csv = NULL;
    for (size_t i = 0; cases->cells && i < cases->columns * cases->all; i++)
        free(cases->cells[i]);
    free(cases->cells);
    cases->cells = NULL;
}

static const char known_columns[] =
    "known are chi, psi, delta1, gamma, delta2, radius1_m, density1_kg_m3, mass1_kg, inertia1_kg_m2, radius2_m, "
    "density2_kg_m3, mass2_kg, inertia2_kg_m2, speed_m_s, angle_deg, spin_rad_s, spin2_rad_s, friction, modulus1_Pa, "
    "modulus2_Pa, viscosity_Pa_s, poisson_ratio, time_shift, material, partner, rotation_blocked";

static const char *place_of(const struct cases *cases)
{
    return cases->source ? cases->source : "--grid";
}

/* Mark what a column gives in `present`; refuse it if an option gives it too. */
static bool check_column(const struct cases *cases, const char *name, const struct settings *settings,
                         struct values *present, struct reason *why)
{
    const enum field field = field_of_column(name);
    const char *option = name;
    bool twice;
    if (field < FIELD_COUNT) {
        twice = settings->values.given[field];
        option = field_rules[field].option;
        present->given[field] = true;
    } else if (strcmp(name, "material") == 0) {
        twice = settings->values.material != NULL;
        present->material = name;
    } else if (strcmp(name, "partner") == 0) {
        twice = settings->values.deformable != 0;
        present->deformable = RESTITUTE_ONE_BODY_DEFORMS;
    } else if (strcmp(name, "rotation_blocked") == 0) {
        twice = settings->values.rotation_blocked >= 0;
        option = "rotation-blocked";
        present->rotation_blocked = 1;
    } else {
        return refuse(why, "%.60s: unknown column \"%.40s\"; %s", place_of(cases), name, known_columns);
    }
    if (twice)
        return refuse(why, "%.200s: column %s and option --%s both give the value", place_of(cases), name, option);
    return true;
}

bool cases_check(const struct cases *cases, const struct settings *settings, struct reason *why)
{
    struct values present = settings->values;
    struct reason inner;
    for (size_t i = cases->notes; i < cases->columns; i++)
        if (!check_column(cases, cases_name(cases, i), settings, &present, why)) return false;
    /* A file may have both a mass and a density column, of which each row fills one. */
    const enum field alternatives[][2] = {{FIELD_MASS1, FIELD_DENSITY1}, {FIELD_MASS2, FIELD_DENSITY2}};
    for (int i = 0; i < 2; i++)
        if (!settings->values.given[alternatives[i][0]] && !settings->values.given[alternatives[i][1]])
            present.given[alternatives[i][0]] = false;
    if (!values_check(&present, NAME_COLUMNS, &inner)) return refuse(why, "%.100s: %s", place_of(cases), inner.text);
    return true;
}

bool cases_values(const struct cases *cases, const struct settings *settings, size_t row, struct values *values,
                  struct reason *why)
{
    *values = settings->values;
    for (size_t i = cases->notes; i < cases->columns; i++)
        if (!values_take(cases_name(cases, i), cases_cell(cases, row, i), values, why)) return false;
    return true;
}
