/* Loops of the build whose turns do not depend on each other, by several threads.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_PARALLEL_H
#define RST_TABLE_PARALLEL_H

#include <stdint.h>

/* Turns 0 to n - 1; threads as in restitute_table_options, 0: all. */
void rst_table_loop(int threads, int64_t n, void (*turn)(void *of, int64_t i), void *of);

#endif
