/* The compression: depth, velocity and memory at instants that are close enough to interpolate.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_TRACE_H
#define RST_CVODE_TRACE_H

#include <stdint.h>

struct trace {
    int64_t n_terms, count, capacity;
    double *knot;   /* time, depth, velocity */
    double *memory; /* 2 n_terms: M and P */
};

/* Empty it, for a solid of n_terms terms. */
void rst_trace_begin(struct trace *trace, int64_t n_terms);

/* One more instant, later than all before. Nonzero: no memory. */
int rst_trace_add(struct trace *trace, double time, double depth, double velocity, const double *memory);

/* The time when the sphere first reached this depth; it must have reached it. */
double rst_trace_time(const struct trace *trace, double depth);

void rst_trace_release(struct trace *trace);

#endif
