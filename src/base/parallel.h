/* Loops whose turns do not depend on each other, by several threads. Compiled into the components
 * that have such loops.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_PARALLEL_H
#define RST_PARALLEL_H

#include <stdint.h>

/* How many threads take n turns, if so many are wanted; 0: all. */
int rst_threads(int wanted, int64_t n);

/* Turns 0 to n - 1, by rst_threads(threads, n) threads; `thread` counts them from 0. */
void rst_loop(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of);

#endif
