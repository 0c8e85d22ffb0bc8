/* What the figures of `restitute sweep` show, and what is checked in them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_CHARTS_H
#define CLI_SWEEP_CHARTS_H

#include "chart.h"
#include "rows.h"
#include "sweep_figures.h"

/* The chart of a figure whose samples are solved. */
struct chart *sweep_chart(const struct sweep *sweep, const struct cases *cases, const struct row *rows);

/* Print the scatter and all checks of the figure; returns how many failed. */
int sweep_check(const struct sweep *sweep, const struct row *rows, const struct chart *chart);

#endif
