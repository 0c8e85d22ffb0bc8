/* The tables of the report, as CSV and as text.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_TABLES_H
#define BENCH_TABLES_H

#include <stdio.h>

#include "omissions.h"
#include "stability.h"
#include "summary.h"

void bench_write_runs(const struct bench_scenes *scenes, const struct bench_runs *runs, FILE *stream);

/* One row a set, method and setting; the set "all" where there is more than one. */
void bench_write_summary(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets, FILE *stream);

void bench_write_speed(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned methods,
                       FILE *stream);

/* Summary over all scenes, and speed, for reading. */
void bench_print_precision(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned methods,
                           FILE *stream);

void bench_write_omissions(const struct bench_omission *rows, size_t n, FILE *stream);
void bench_print_omissions(const struct bench_omission *rows, size_t n, FILE *stream);

void bench_write_map_header(FILE *stream);
void bench_write_cell(const struct bench_cell *cell, FILE *stream);

/* Read a line written by bench_write_cell(); false if it is none. */
int bench_read_cell(const char *line, struct bench_cell *cell);

/* How often which verdict, a line a method and number of steps. */
void bench_print_map(const struct bench_cell *cells, size_t n, FILE *stream);

#endif
