/* One impact: `restitute pair` without a case file or grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SINGLE_H
#define CLI_SINGLE_H

#include "options.h"

/* Returns the exit status. */
int single_run(const struct settings *settings);

#endif
