/* What gnuplot is told to draw; the caller starts it and sets the terminal.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_FIGURES_H
#define BENCH_FIGURES_H

#include <stdio.h>

#include "omissions.h"
#include "stability.h"
#include "summary.h"

/* Error over run time: a line a method through the medians over all scenes, a band from the least to the largest
 * error. */
void bench_draw_precision(const struct bench_scenes *scenes, const struct bench_runs *runs, FILE *commands);

/* A bar a method and omission. */
void bench_draw_omissions(const struct bench_omission *rows, size_t n, FILE *commands);

/* A panel a method (down) and number of steps (across). Returns through width and height the size it wants, in points.
 * */
void bench_size_map(unsigned methods, int levels, int *width, int *height);
void bench_draw_map(const struct bench_cell *cells, size_t n, unsigned methods, int levels, FILE *commands);

#endif
