/* Loops by several threads (parallel.h). They round as the caller does, or bits would depend on who takes a turn.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "parallel.h"

#ifdef _OPENMP
#include <fenv.h>
#include <omp.h>

/* Turns that a thread takes at once; fewer in all are not worth waking it. */
enum { turns_at_once = 64 };

static void share(int threads, int64_t n, void (*turn)(void *of, int64_t i), void *of)
{
    fenv_t callers;
    fegetenv(&callers);
#pragma omp parallel num_threads(threads)
    {
        fenv_t own;
        fegetenv(&own);
        fesetenv(&callers);
#pragma omp for schedule(dynamic, turns_at_once)
        for (int64_t i = 0; i < n; i++)
            turn(of, i);
        fesetenv(&own);
    }
}
#endif

void rst_table_loop(int threads, int64_t n, void (*turn)(void *of, int64_t i), void *of)
{
#ifdef _OPENMP
    if (threads <= 0) threads = omp_get_max_threads();
    if (threads > 1 && n > turns_at_once) {
        share(threads, n, turn, of);
        return;
    }
#endif
    (void)threads;
    for (int64_t i = 0; i < n; i++)
        turn(of, i);
}
