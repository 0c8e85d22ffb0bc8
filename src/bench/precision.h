/* Error against run time: single runs of every method over its tolerances or resolutions.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_PRECISION_H
#define BENCH_PRECISION_H

#include "methods.h"
#include "scenes.h"

enum { BENCH_SETTINGS = 16 };

/* What is run. */
struct bench_plan {
    unsigned methods; /* bits of indices of bench_methods */
    double tolerances[BENCH_SETTINGS];
    int n_tolerances;
    double budget; /* s: no run that is expected to take longer is started */
    int doublings; /* of the paper's algorithm: of its elements and of its steps an element, the coarsest included */
};

/* One run: a method, how finely, a scene. */
struct bench_run {
    size_t scene;
    int method;
    double tolerance;       /* asked for; NaN for the paper's algorithm */
    int64_t elements_asked; /* over the contact radius; 0 for the methods of the library */
    int64_t steps_asked;    /* in the contact time; likewise */
    double seconds;         /* median */
    int repeats;
    double ez, ex, error_ez, error_ex; /* errors against the reference */
    double estimate;                   /* larger of the two; NaN if the method makes none */
    int status;
    int64_t elements, steps;
    double work;              /* nominal seconds */
    int64_t restarts, events; /* of the method cvode, with all its steps; 0: it has none */
};

struct bench_runs {
    struct bench_run *runs;
    size_t count, capacity;
};

/* What the paper's algorithm is told about a scene, favourably: radius and contact time, so that no element is wasted.
 * */
struct paper_settings bench_paper_settings(const struct bench_scene *scene, enum paper_motion motion, int64_t elements,
                                           int64_t steps);

/* All runs of one method on one scene, appended. Nonzero: out of memory. */
int bench_run_scene(const struct bench_plan *plan, const struct bench_scene *scene, size_t number, int method,
                    struct bench_runs *runs);

void bench_runs_release(struct bench_runs *runs);

/* The larger of the two errors. */
double bench_run_error(const struct bench_run *run);

#endif
