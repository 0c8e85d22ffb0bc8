/* What many runs say together.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_SUMMARY_H
#define BENCH_SUMMARY_H

#include "precision.h"

struct bench_range {
    double min, median, max;
};

/* One method at one tolerance or resolution over the scenes of one set (all of `sets` that are bits). */
struct bench_summary {
    int method;
    double tolerance;
    int64_t resolution;
    size_t runs;   /* started */
    size_t solved; /* with a status that is not negative; all below is over these */
    size_t met;    /* status 0 */
    struct bench_range seconds, error;
    double estimate_ratio; /* median of estimate/true error */
    double honest;         /* part with true error <= estimate (and what the reference is uncertain by) */
    double worst;          /* largest true error/estimate, errors above the uncertainty of the reference */
};

/* Summaries of a set in the order of methods, coarse to fine. Returns their number, at most `capacity`. */
size_t bench_summarise(const struct bench_scenes *scenes, const struct bench_runs *runs, unsigned sets,
                       struct bench_summary *summaries, size_t capacity);

/* The time a method needs for a verified error over the scenes 0 < psi < psi_c of standard solids. */
struct bench_speed {
    int method;
    double error;
    size_t scenes, reached; /* scenes with a run whose true error is that small */
    double seconds;      /* median of the fastest such run, scenes not reached as infinite; NaN: not by half of them */
    double ratio;        /* median of (time of paper-euler at that error)/(time of the method); NaN likewise */
    size_t extrapolated; /* of the ratios: paper-euler's sweep ended before that error, cost then as 1/error^2 */
};

enum { BENCH_SPEED_ERRORS = 3 };
extern const double bench_speed_errors[BENCH_SPEED_ERRORS];

struct bench_speed bench_speed_of(const struct bench_scenes *scenes, const struct bench_runs *runs, int method,
                                  double error);

#endif
