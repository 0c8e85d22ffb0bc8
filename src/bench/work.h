/* What a run took beside time: steps, and of the method cvode re-initialisations and events.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_WORK_H
#define BENCH_WORK_H

#include <stdio.h>

#include "precision.h"

/* Fill run->restarts and run->events by solving once more, with a recorder; 0 for methods that have none. */
void bench_read_work(const restitute_options *options, const restitute_impact *impact, struct bench_run *run);

/* Medians over all scenes of the methods of the library, against tolerance. */
void bench_print_work(const struct bench_runs *runs, unsigned methods, FILE *stream);

#endif
