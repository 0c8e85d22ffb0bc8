/* Events of an impact: what changes where a function that CVODE watches falls through 0.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_EVENTS_H
#define RST_CVODE_EVENTS_H

#include "cvode/run_state.h"

/* Count an event and log it. */
int rst_run_note(struct run *run, int kind, double position, int elements);

/* React to the events that CVODE found. Elements from `first` on have entered since its last
 * return. */
int rst_run_react(struct run *run, int64_t first);

/* A step without an event, or its part after the last event. */
int rst_run_end_step(struct run *run);

#endif
