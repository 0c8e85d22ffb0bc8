/* `restitute sweep NAME`: the figures of the paper and more, from impacts drawn at random, checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_H
#define CLI_SWEEP_H

#include "options.h"

/* Returns the exit status. */
int sweep_run(const struct settings *settings);

#endif
