/* A method of this component: what the core sees, and what it does not.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_METHOD_H
#define BEM_METHOD_H

#include "base/method.h"
#include "base/report.h"
#include "bem/run.h"

struct bem_method {
    struct restitute_method base; /* first: the core's pointer is one to the whole */
    struct bem_variant variant;
    struct restitute_bem_recorder *recorder; /* NULL: keeps no fields */
};

/* The method bem without a recorder. */
extern const struct bem_method rst_bem_standard;

/* A new impact: forget the last one. */
void rst_bem_recorder_begin(struct restitute_bem_recorder *recorder);

/* Its snapshot of a step, if it is time for one; nonzero: out of memory. */
int rst_bem_recorder_see(struct restitute_bem_recorder *recorder, const struct bem_setup *setup, int64_t step,
                         int64_t steps, const struct bem_motion *motion, const struct bem_fields *fields);

#endif
