/* Timing by repetition; the median is not moved by what else the machine does now and then.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "timing.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

enum { least_repeats = 5, most_repeats = 1000 };
static const double full = 1e-3;

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_clock(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double bench_processor_time(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

static double time_once(void (*work)(void *context), void *context)
{
    const double start = bench_processor_time();
    work(context);
    return bench_processor_time() - start;
}

static int by_value(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

double bench_median(double *values, size_t n)
{
    if (n == 0) return NAN;
    qsort(values, n, sizeof *values, by_value);
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

struct bench_time bench_time_work(void (*work)(void *context), void *context, double long_work)
{
    double samples[most_repeats], sum = 0;
    int n = 0;
    const double first = time_once(work, context);
    if (first > long_work) return (struct bench_time){first, 1};
    while (n < least_repeats || (n < most_repeats && sum < full)) {
        samples[n] = time_once(work, context);
        sum += samples[n++];
    }
    return (struct bench_time){bench_median(samples, (size_t)n), n};
}
