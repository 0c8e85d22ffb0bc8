/* Short ways to options of the method `sync`, and comparisons that know both errors.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SYNC_H
#define TEST_SYNC_H

#include "solve.h"

static inline restitute_options sync_to(double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = restitute_method_sync();
    return options;
}

/* A number of elements instead of a tolerance; small tolerance: nothing is merged, iterations are
 * finished. */
static inline restitute_options sync_with(int64_t elements)
{
    restitute_options options = sync_to(1e-8);
    options.elements = elements;
    options.max_work = INFINITY;
    return options;
}

/* The estimates are below the tolerance, or the status says that they are not. */
static inline int estimate_keeps_tolerance(const struct solution *s, double tolerance)
{
    if (s->status == RESTITUTE_TOLERANCE_NOT_REACHED) return 1;
    return s->status == RESTITUTE_OK && s->result.error_ez <= tolerance && s->result.error_ex <= tolerance;
}

/* The error that is certain: what is left after the error of the reference itself. */
static inline double certain_error(double value, double reference, double reference_error)
{
    return fmax(0, fabs(value - reference) - reference_error);
}

/* Error over estimate where it is more than 1, else 0: an estimate of 0 is right about an error of
 * 0. */
static inline double too_low_by(double error, double estimate)
{
    return error <= estimate ? 0 : error / estimate;
}

static inline int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
