/* The methods that the report compares: those of the library by their handles, and the paper's algorithm.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_METHODS_H
#define BENCH_METHODS_H

#include <restitute/restitute.h>

#include "paper.h"

struct bench_method {
    const char *name;
    const restitute_method *(*handle)(void); /* NULL: the paper's algorithm */
    enum paper_motion motion;                /* of the paper's algorithm */
    int takes_time_step; /* else only the number of elements can be prescribed */
    double finest;       /* tolerance at which it can serve as reference in a run; 0: it does not */
    double fine;         /* the same where hundreds of references are needed */
};

#ifdef RESTITUTE_WITH_CVODE
enum { BENCH_METHODS = 6 };
#else
enum { BENCH_METHODS = 5 };
#endif

/* In the order of all tables. */
extern const struct bench_method bench_methods[BENCH_METHODS];

/* The method with the smallest `finest`. */
const struct bench_method *bench_reference_method(void);

/* Index by name, -1 if there is none. */
int bench_method_index(const char *name, size_t length);

#endif
