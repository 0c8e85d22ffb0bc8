/* What the programs of this folder share: clocks and medians, methods, scenes, one timed solve.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCHMARK_BENCH_H
#define BENCHMARK_BENCH_H

#include <restitute/restitute.h>
#include <stdio.h>

#include "paper.h"

/* Processor time of this thread (s): what other programs take does not count. A call takes half a
 * microsecond. */
double bench_time(void);

/* Seconds of a clock that is never set back; a call takes some ten nanoseconds. */
double bench_clock(void);

/* Median of n >= 1 values, which are sorted. */
double bench_median(double *values, size_t n);

/* Median time of `work`. Once to warm up, then at least five times and until a millisecond is full.
 * What takes longer than 0.01 s is run once. */
double bench_time_of(void (*work)(void *context), void *context);

struct bench_method {
    const char *name;
    const restitute_method *(*handle)(void); /* NULL: the paper's algorithm */
    enum paper_motion motion;
    int takes_time_step; /* else only the number of elements can be prescribed */
};

/* NULL: there is none of this name in this build. */
const struct bench_method *bench_method(const char *name);

/* An impact, as the library and as the paper's algorithm take it. */
struct bench_scene {
    char name[48];
    double delta1, gamma;
    struct paper_problem paper;
    restitute_impact impact;
    restitute_material *solid;   /* NULL: delta1 and gamma say it */
    double radius, contact_time; /* a_el and T: the largest contact radius; from `sync` */
};

/* The next line of a file of scenes, "name,chi,psi,delta1,gamma,g_inf,g:tau g:tau ...": delta1 and
 * gamma, or in their place a series over G_r and T. 1: done, 0: the end. What cannot be read or
 * solved ends the program. */
int bench_read_scene(FILE *file, struct bench_scene *scene);

/* Solve a scene once or again and again, and print a line of CSV: asked for, found, taken.
 * elements, steps: asked for; 0: chosen by the method from its tolerance. budget: s.
 * Returns the time (s). */
double bench_run(const struct bench_scene *scene, const struct bench_method *method, double tolerance, int64_t elements,
                 int64_t steps, double budget);
void bench_print_head(void);

#endif
