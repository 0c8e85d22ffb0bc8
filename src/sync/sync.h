/* The method `sync` (docs/sync.md).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_H
#define RST_SYNC_H

#include "base/method.h"

extern const struct restitute_method rst_method_sync;

#endif
