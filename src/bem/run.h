/* One impact on one grid with one step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_RUN_H
#define BEM_RUN_H

#include "bem/memory.h"
#include "bem/setup.h"

/* Sees every step; NULL: not wanted. Fields outside of the part of the grid that a step used
 * (fields->m cells wide) are stale. */
struct bem_observer {
    void (*see)(struct bem_observer *observer, const struct bem_setup *setup, const struct bem_run *run,
                const struct bem_motion *motion, const struct bem_fields *fields);
};

void rst_bem_run(const struct bem_setup *setup, struct bem_memory *memory, struct bem_observer *observer,
                 struct bem_run *run);

#endif
