/* Input and output of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_SETUP_H
#define BEM_SETUP_H

#include "bem/solid.h"

/* How the steps are made; all 0: the method of the component. */
struct bem_variant {
    int explicit_euler;  /* positions, forces, velocities; entering cells stick from the step's beginning */
    int stick_sets;      /* the sticking set shrinks until none of it passes the friction limit */
};

struct bem_setup {
    const struct rst_problem *problem;
    struct bem_solid *solid;
    struct bem_variant variant;
    int normal_only, keep_ledger;
    int64_t m; /* the grid has 2m x 2m cells, a quarter of it is computed */
    double spacing, step;
    double rest_speed; /* a sphere that sinks is at rest below it */
    int64_t most_steps;
};

enum bem_end {
    BEM_REBOUND,
    BEM_OUTGREW, /* the contact reached the side of the grid */
    BEM_SUNK,
    BEM_TOO_LONG,  /* most_steps */
    BEM_UNSETTLED, /* a contact problem did not converge, or the step is unstable */
    BEM_NO_MEMORY
};

/* Where the sphere is after a step, and sums over its contact. */
struct bem_motion {
    double time, depth, velocity, shift, shear_velocity;
    double force, shear_force; /* integrals of p and tau */
    double contact, stick;     /* areas */
};

/* Work on the surface, in units of the kinetic energy before the impact; tangential: of U'^2. */
struct bem_work {
    double normal, shear, friction, left_normal, left_shear;
};

/* Radius of a contact with that area. */
static inline double rst_bem_radius_of(double area)
{
    return sqrt(area / 3.14159265358979323846);
}

struct bem_run {
    enum bem_end end;
    struct bem_motion last;
    double step, contact_time;
    double ringing; /* of the solid in these steps, solid.h */
    double max_depth, max_force, max_area;
    struct bem_work work;
    int64_t steps, iterations, convolutions, updates; /* updates: convolutions times cells */
};

#endif
