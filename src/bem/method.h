/* A method of this component: the interface to the core, and private data.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_METHOD_H
#define BEM_METHOD_H

#include "base/method.h"
#include "base/report.h"
#include "bem/run.h"

struct bem_method {
    struct restitute_method base; /* first member, so that a pointer of the core is a pointer to this struct */
    struct bem_variant variant;
    struct restitute_bem_recorder *recorder; /* NULL: keeps no fields */
};

/* The method bem without a recorder. */
extern const struct bem_method rst_bem_standard;

/* Reset for a new impact. */
void rst_bem_recorder_begin(struct restitute_bem_recorder *recorder);

/* Take a snapshot of the step if one is due; nonzero: out of memory. */
int rst_bem_recorder_see(struct restitute_bem_recorder *recorder, const struct bem_setup *setup, int64_t step,
                         int64_t steps, const struct bem_motion *motion, const struct bem_fields *fields);

#endif
