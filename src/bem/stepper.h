/* The parts of a time step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_STEPPER_H
#define BEM_STEPPER_H

#include "bem/bounded.h"
#include "bem/memory.h"
#include "bem/setup.h"

struct bem_stepper {
    const struct bem_setup *setup;
    const struct bem_solid *solid;
    struct bem_memory *memory;
    struct bem_fields f;
    struct bem_transform *near, *all; /* where contact is sought; where displacements are wanted */
    struct bem_motion motion, before;
    struct bem_run *run;
    double cell; /* weight of a value of a field in an integral: four quarters, one spacing being in the tractions */
};

/* The pressure at a depth, and the gap and force that follow; `shift` is only for the anchors of
 * cells that enter. */
enum bem_end rst_bem_solve_normal(struct bem_stepper *s, double depth, double shift);

/* The traction at a shift, under the pressure just found. */
enum bem_end rst_bem_solve_shear(struct bem_stepper *s, double shift);

/* Energy that the springs of the solid hold when the contact has ended. */
void rst_bem_find_left(struct bem_stepper *s);

#endif
