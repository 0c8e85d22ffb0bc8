/* What it saves to leave out what a scene does not need: for each method of the library the time of a scene that needs
 * everything over that of one that does not, in one run and in turn, elements and step prescribed and equal.
 *
 * Only the public interface is used, which never does what is not needed; so the full scene is one next to the lean
 * one in which nothing can be left out: a dashpot that is weak but not negligible, a psi below and not above 1, a
 * friction that is not zero. SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_OMISSIONS_H
#define BENCH_OMISSIONS_H

#include "methods.h"

enum { BENCH_OMISSIONS = 13 };

struct bench_omission {
    int method;
    const char *left_out, *full, *lean; /* in words */
    int status;                         /* negative: one of the two was refused, no times */
    double seconds_full, seconds_lean;  /* medians */
    double ratio;                       /* of these; of those of one step where the step is prescribed */
    int64_t elements, steps_full, steps_lean;
};

/* Fill BENCH_OMISSIONS rows of one method of the library, `repeats` >= 1 runs of each scene. */
int bench_measure_omissions(int method, int repeats, struct bench_omission *rows, restitute_error *error);

#endif
