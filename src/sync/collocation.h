/* The method `sync` by collocation (docs/sync.md), which is to replace that of src/core/sync.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_COLLOCATION_H
#define RST_COLLOCATION_H

#include "method.h"

extern const struct restitute_method rst_method_collocation;

#endif
