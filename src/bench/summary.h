/* What many runs say together.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_SUMMARY_H
#define BENCH_SUMMARY_H

#include "precision.h"

struct bench_range {
    double min, median, max;
};

/* One method at one tolerance, or pair of elements and steps, over the scenes of one set (all of `sets` that are bits).
 */
struct bench_summary {
    int method;
    double tolerance;
    int64_t elements, steps;
    size_t scenes; /* of the sets */
    size_t runs;   /* started */
    size_t solved; /* with a status that is not negative; all below is over these */
    size_t met;    /* status 0 */
    struct bench_range seconds, error;
    double estimate_ratio; /* median of estimate/true error */
    double honest;         /* part with true error <= estimate (and what the reference is uncertain by) */
    double worst;          /* largest true error/estimate, errors above the uncertainty of the reference */
};

enum { BENCH_SUMMARIES = 512 };

/* Summaries of a set in the order of methods, coarse to fine. Of the pairs of the paper's algorithm those are left than
 * which none is faster with a smaller median error. Returns their number, at most BENCH_SUMMARIES. */
size_t bench_summarise(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets,
                       struct bench_summary *summaries);

/* Medians mean something where nearly all scenes were solved: a sweep that ran out of time leaves the easy ones. */
int bench_summary_complete(const struct bench_summary *summary);

/* The time a method takes for an error over the scenes 0 < psi < psi_c of standard solids. Times are medians; a scene
 * without such a run counts as infinitely slow, and an infinite median is NaN, "not reached": nothing is extrapolated.
 */
struct bench_speed {
    int method;
    double error;
    size_t scenes;
    /* Asked for: one setting for all scenes, the error as tolerance. The paper's algorithm has none and gets the
     * fastest pair of elements and steps that keeps the error in half of the scenes. */
    int64_t elements, steps; /* that pair; else 0 */
    double seconds_asked;
    size_t within; /* scenes in which the true error then is that small */
    /* Got: in each scene the fastest run whose true error is that small, whatever was asked for. */
    double seconds_got;
    size_t reached;                /* scenes with such a run */
    double ratio_asked, ratio_got; /* paper-euler's time over the method's; NaN: one of them is */
};

enum { BENCH_SPEED_ERRORS = 5 };
extern const double bench_speed_errors[BENCH_SPEED_ERRORS];

struct bench_speed bench_speed_of(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                                  double error);

#endif
