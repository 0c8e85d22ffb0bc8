/* Growing arrays of the compression, and the time of a depth by Newton's method on Hermite's cubic.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cvode/kernels.h"

void rst_trace_begin(struct trace *trace, int64_t n_terms)
{
    if (trace->n_terms != n_terms) rst_trace_release(trace);
    trace->n_terms = n_terms;
    trace->count = 0;
}

static int grow(struct trace *trace)
{
    const int64_t capacity = trace->capacity ? 2 * trace->capacity : 512;
    double *knot = realloc(trace->knot, 3 * (size_t)capacity * sizeof *knot);
    if (!knot) return 1;
    trace->knot = knot;
    double *memory = realloc(trace->memory, (2 * (size_t)trace->n_terms + 1) * (size_t)capacity * sizeof *memory);
    if (!memory) return 1;
    trace->memory = memory;
    trace->capacity = capacity;
    return 0;
}

int rst_trace_add(struct trace *trace, double time, double depth, double velocity, const double *memory)
{
    if (trace->count == trace->capacity && grow(trace)) return 1;
    double *knot = trace->knot + 3 * trace->count;
    knot[0] = time;
    knot[1] = depth;
    knot[2] = velocity;
    memcpy(trace->memory + 2 * trace->n_terms * trace->count, memory, 2 * (size_t)trace->n_terms * sizeof *memory);
    trace->count++;
    return 0;
}

double rst_trace_time(const struct trace *trace, double depth)
{
    int64_t low = 0, high = trace->count - 1;
    while (high - low > 1) {
        const int64_t middle = (low + high) / 2;
        if (trace->knot[3 * middle + 1] <= depth)
            low = middle;
        else
            high = middle;
    }
    const double *knot = trace->knot + 3 * low;
    double from = knot[0], to = knot[3], t = from, there, slope;
    for (int i = 0; i < 60; i++) {
        rst_cvode_hermite(knot, knot + 3, t, &there, &slope);
        const double missing = depth - there;
        if (missing >= 0)
            from = t;
        else
            to = t;
        double next = slope > 0 ? t + missing / slope : 0.5 * (from + to);
        if (!(next >= from && next <= to)) next = 0.5 * (from + to);
        if (fabs(next - t) <= 1e-16 * knot[3]) break;
        t = next;
    }
    return t;
}

void rst_trace_release(struct trace *trace)
{
    free(trace->knot);
    free(trace->memory);
    *trace = (struct trace){0};
}
