/* Many impacts: `restitute pair --input` and `--grid`.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_BATCH_H
#define CLI_BATCH_H

#include "options.h"

/* Returns the exit status. */
int batch_run(const struct settings *settings);

#endif
