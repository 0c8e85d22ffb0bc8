/* The clock behind the limit of time (clock.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/clock.h"

#include <time.h>

double rst_clock(void)
{
    struct timespec t = {0};
#ifdef CLOCK_THREAD_CPUTIME_ID
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
#else
    timespec_get(&t, TIME_UTC);
#endif
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
