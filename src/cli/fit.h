/* restitute fit: constants of a solid from measured impacts or from a DMA curve, into a material file.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FIT_H
#define CLI_FIT_H

#include "message.h"

/* Read the options behind `restitute fit` and run. Returns the exit status. */
int fit_main(int count, char **arguments);

#endif
