/* The figures of the command: a grid of impacts, and the history of one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FIGURE_H
#define CLI_FIGURE_H

#include "rows.h"

/* Refuse, before any work, a figure that could not be drawn or written. */
bool figure_check(const char *path, struct reason *why);

/* Refuse cases that cannot be drawn: one or two of their columns must vary. */
bool figure_check_cases(const struct cases *cases, bool contours, struct reason *why);

/* ez and ex over one column with a curve for each value of a second one, or as contours over both. A grid of speed and
 * angle has ez over the normal speed. */
bool figure_of_cases(const char *path, const struct settings *settings, const struct cases *cases,
                     struct materials *materials, const struct row *rows, struct reason *why);

/* Name and unit of a field on an axis. */
void figure_label(enum field field, char *text, size_t size);

/* Forces, indentation and radii, velocities over time; the names of the columns label the axes. */
bool figure_of_history(const char *path, const struct settings *settings, const struct problem *problem,
                       const restitute_history *history, struct reason *why);

#endif
