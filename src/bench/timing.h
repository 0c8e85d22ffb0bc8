/* Time of short and long work on one core.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

#include <stddef.h>

/* Seconds of a clock that is never set back. */
double bench_clock(void);

/* Seconds that the processor gave to this thread, so that what other programs take does not count. A call takes half a
 * microsecond, which a difference of two includes. */
double bench_processor_time(void);

struct bench_time {
    double seconds; /* median */
    int repeats;
};

/* Processor time of `work`: once to warm up, then at least five times and until a millisecond is full. Work that takes
 * longer than `long_work` (s) is not repeated; what the first run needs beyond the later ones is nothing to it. */
struct bench_time bench_time_work(void (*work)(void *context), void *context, double long_work);

/* Median of n >= 1 values, which are sorted; NaN for none. */
double bench_median(double *values, size_t n);

#endif
