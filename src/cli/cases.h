/* Many impacts: the rows of a case file, or the points of a grid, as one table of text cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_CASES_H
#define CLI_CASES_H

#include <restitute/files.h>

#include "options.h"

struct cases {
    size_t rows, columns;
    restitute_csv *csv; /* where they were read from; NULL for a grid */
    const char *source; /* name of the file for messages; NULL for a grid */
    char **grid;        /* cells of a grid, row by row; NULL for a file */
    size_t axis[2];     /* points of the grid's axes, speed and angle */
};

/* From --input or --grid. */
bool cases_open(const struct settings *settings, struct cases *cases, struct reason *why);
void cases_release(struct cases *cases);

const char *cases_name(const struct cases *cases, size_t column);
const char *cases_cell(const struct cases *cases, size_t row, size_t column);

/* The line of the file a row stands in; for a grid the row's number from 1. */
size_t cases_line(const struct cases *cases, size_t row);

/* Refuse unknown columns, columns whose value an option gives too, and columns that do not make an impact. */
bool cases_check(const struct cases *cases, const struct settings *settings, struct reason *why);

/* The values of a row: its cells, and the options for what is no column. */
bool cases_values(const struct cases *cases, const struct settings *settings, size_t row, struct values *values,
                  struct reason *why);

#endif
