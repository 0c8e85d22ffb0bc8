/* The figures of the command: a grid of impacts, and the history of one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FIGURE_H
#define CLI_FIGURE_H

#include "rows.h"

/* Refuse, before any work, a figure that could not be drawn or written. */
bool figure_check(const char *path, struct reason *why);

/* ez over the normal speed, and ex over the angle with a curve for each speed. */
bool figure_of_grid(const char *path, const struct settings *settings, const struct cases *cases,
                    struct materials *materials, const struct row *rows, struct reason *why);

/* Forces, indentation and radii, velocities over time; the names of the columns label the axes. */
bool figure_of_history(const char *path, const struct settings *settings, const struct problem *problem,
                       const restitute_history *history, struct reason *why);

#endif
