/* Loops by several threads (builder.h). All threads use the rounding mode of the caller, so that
 * the bits do not depend on the thread.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <time.h>

#ifdef _OPENMP
#include <fenv.h>
#include <omp.h>

static void share(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of)
{
    fenv_t callers;
    fegetenv(&callers);
#pragma omp parallel num_threads(threads)
    {
        fenv_t own;
        fegetenv(&own);
        fesetenv(&callers);
#pragma omp for schedule(dynamic, 1)
        for (int64_t i = 0; i < n; i++)
            turn(of, omp_get_thread_num(), i);
        fesetenv(&own);
    }
}
#endif

int rst_table_threads(int threads, int64_t n)
{
#ifdef _OPENMP
    if (threads <= 0) threads = omp_get_max_threads();
    return n < threads ? (int)(n > 1 ? n : 1) : threads;
#else
    (void)threads, (void)n;
    return 1;
#endif
}

void rst_table_loop(int threads, int64_t n, void (*turn)(void *of, int thread, int64_t i), void *of)
{
#ifdef _OPENMP
    threads = rst_table_threads(threads, n);
    if (threads > 1) {
        share(threads, n, turn, of);
        return;
    }
#endif
    (void)threads;
    for (int64_t i = 0; i < n; i++)
        turn(of, 0, i);
}

void rst_table_one_at_a_time(void (*act)(void *of), void *of)
{
#ifdef _OPENMP
#pragma omp critical(rst_table_one_at_a_time)
#endif
    act(of);
}

double rst_table_clock(void)
{
    struct timespec t = {0};
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
