/* The time history of one impact: `restitute history`.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_HISTORY_H
#define CLI_HISTORY_H

#include "options.h"

/* Returns the exit status. */
int history_run(const struct settings *settings);

#endif
