/* What the figures of `restitute sweep` show, and what is checked in them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_CHARTS_H
#define CLI_SWEEP_CHARTS_H

#include "chart.h"
#include "rows.h"
#include "sweep_figures.h"

/* The chart of a figure whose samples are solved. */
struct chart *sweep_chart(const struct sweep *sweep, const struct cases *cases, const struct row *rows);

enum { SWEEP_LINE = 241 };

/* Dimensionless impacts along curve `curve`, at SWEEP_LINE places x. One that fails leaves NaN. */
void sweep_line(const struct sweep *sweep, size_t curve, double *x, restitute_result *results);

/* psi_c by bisection over full simulations with so many elements. */
double sweep_simulated_psi_c(const struct sweep *sweep, const struct sweep_numbers *numbers, int64_t elements);

/* Print the scatter and all checks of the figure; returns how many failed. */
int sweep_check(const struct sweep *sweep, const struct row *rows, const struct chart *chart);

#endif
