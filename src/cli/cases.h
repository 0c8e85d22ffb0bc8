/* Many impacts: the rows of a case file, or the points of a grid, as one table of text cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_CASES_H
#define CLI_CASES_H

#include "files/csv_table.h"
#include "options.h"

enum { CASES_MADE_COLUMNS = 32 };

struct cases {
    size_t rows, columns;
    struct rst_csv *csv;                   /* where they were read from; NULL for a grid */
    const char *source;                    /* name of the file for messages; NULL for a grid */
    char **cells;                          /* of a grid or a sweep, row by row; NULL for a file */
    const char *names[CASES_MADE_COLUMNS]; /* of these */
    size_t notes;                          /* so many first columns of a sweep are no inputs */
    size_t axes, axis[2];                  /* of a grid, and how many points they have */
    bool logarithmic[2];
    size_t first, all; /* of --shard: rows of the file or grid that are left out before these; how many it has */
};

/* From --input or --grid. */
bool cases_open(const struct settings *settings, struct cases *cases, struct reason *why);

/* An empty table with these columns, to be filled by cases_set(). */
void cases_make(struct cases *cases, size_t rows, size_t columns, const char *const *names, size_t notes);
void cases_set(struct cases *cases, size_t row, size_t column, const char *text);

/* Leave only part number `shard` of `shards`, rows that follow each other. */
void cases_shard(struct cases *cases, size_t shard, size_t shards);
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
