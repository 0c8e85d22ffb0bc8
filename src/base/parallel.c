/* Loops by several threads (parallel.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/parallel.h"

#ifdef _OPENMP
#include <fenv.h>
#include <omp.h>

/* Threads of a pool keep the rounding mode and the treatment of subnormal numbers that were set
 * when they started. During the call they take those of the caller. Otherwise a result would depend
 * on the thread that computes it. */
static void share(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of)
{
    fenv_t callers;
    fegetenv(&callers);
#pragma omp parallel num_threads(threads)
    {
        fenv_t own;
        fegetenv(&own);
        fesetenv(&callers);
#pragma omp for schedule(dynamic)
        for (int64_t i = 0; i < n; i++)
            turn(of, omp_get_thread_num(), i);
        fesetenv(&own);
    }
}
#endif

int rst_threads(int threads, int64_t n)
{
#ifdef _OPENMP
    if (threads <= 0) threads = omp_get_max_threads();
    return n < threads ? (int)(n > 1 ? n : 1) : threads;
#else
    (void)threads, (void)n;
    return 1;
#endif
}

void rst_loop(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of)
{
#ifdef _OPENMP
    threads = rst_threads(threads, n);
    if (threads > 1) {
        share(threads, n, turn, of);
        return;
    }
#endif
    (void)threads;
    for (int64_t i = 0; i < n; i++)
        turn(of, 0, i);
}
