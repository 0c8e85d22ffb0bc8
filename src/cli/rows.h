/* The result rows of many impacts: solving one, and writing and reading them as CSV or JSON.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_ROWS_H
#define CLI_ROWS_H

#include <jansson.h>
#include <stdio.h>

#include "cases.h"

enum { ROW_EZ, ROW_EX, ROW_CONTACT_TIME, ROW_MAX_INDENTATION, ROW_ERROR_EZ, ROW_ERROR_EX, ROW_NUMBERS };

struct row {
    bool solved;
    double number[ROW_NUMBERS];
    const char *method; /* lives as long as the library */
    char *status;       /* "" if done without a remark and within the model limits; on the heap */
};

void rows_release(struct row *rows, size_t count);

/* Solve `count` rows of the cases from number `first` on, into rows[first] and on. A row that fails says why in its
 * status. `solver` is for rows that need a second look. */
void rows_solve(const struct cases *cases, const struct settings *settings, struct materials *materials,
                restitute_solver *solver, size_t first, size_t count, struct row *rows);

/* The results of a solved impact as a row. */
void row_from_result(int status, const restitute_result *result, struct row *row);

/* One line of CSV: the column names, or a row. */
void row_write_header(FILE *stream, const struct cases *cases);
void row_write(FILE *stream, const struct cases *cases, size_t index, const struct row *row);

/* The result part alone, behind `stream`'s current cells: names, or values. */
void row_write_result_names(FILE *stream);
void row_write_result(FILE *stream, const struct row *row);

/* One cell, in quotes where it needs them. */
void cell_write(FILE *stream, const char *cell);

/* Read back a written row: cells `first` and on of a table with that header. Refuses what no run could have written. */
bool row_read(const struct rst_csv *csv, size_t index, size_t first, const restitute_method *method, struct row *row,
              struct reason *why);

/* Name of a column as written: those of the cases, then ROW_NUMBERS numbers, method, status. */
const char *row_column_name(const struct cases *cases, size_t column);

/* A row as a JSON object, inputs included, and the units of all columns. */
json_t *row_json(const struct cases *cases, size_t index, const struct row *row);
json_t *row_units(const struct cases *cases, bool physical);

#endif
