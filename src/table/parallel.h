/* Loops of the build whose turns do not depend on each other, by several threads.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_PARALLEL_H
#define RST_TABLE_PARALLEL_H

#include <stdint.h>

/* How many threads take n turns; threads as in restitute_table_options, 0: all. */
int rst_table_threads(int threads, int64_t n);

/* Turns 0 to n - 1, by rst_table_threads(threads, n) threads; `thread` counts them from 0. */
void rst_table_loop(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of);

/* Let one thread at a time through. */
void rst_table_one_at_a_time(void (*act)(void *of), void *of);

#endif
