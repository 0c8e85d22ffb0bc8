/* Largest contact radius and contact time, from a rough run of the normal problem by this method.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_BOX_H
#define BEM_BOX_H

#include "bem/run.h"

struct bem_box {
    double radius, time; /* of contact; time is infinite if it sinks */
    int sinks;
    double sink_time; /* until it rests */
};

/* BEM_REBOUND, or why there is no answer; BEM_NO_MEMORY: out of memory. */
int rst_bem_find_box(const struct rst_problem *problem, struct bem_solid *solid, struct bem_memory *memory,
                     struct bem_box *box);

/* Bounds of the contact time. */
void rst_bem_guess_times(const struct rst_solid *solid, double *shortest, double *longest);

#endif
