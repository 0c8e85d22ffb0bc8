/* The Fortran procedures of the method `euler`, and the twins of their derived types; see
 * fortran/euler/interface.f90.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_EULER_KERNELS_H
#define RST_EULER_KERNELS_H

#include "base/kernels.h"

/* Phases of fortran/euler/euler.f90. */
enum { RST_COMPRESSION = 0, RST_RESTITUTION = 1, RST_DONE = 2, RST_SUNK = 3, RST_OVERFLOW = 4, RST_STALLED = 5 };

/* Twin of scene_type. */
struct euler_scene {
    double chi, shear_speed;
    double g_inf, eta;
    double step, spacing;
    double rest_speed;
    int64_t n_terms, capacity;
    int64_t can_sink, keep_ledger, mode;
};

/* Twin of state_type. */
struct euler_state {
    double time, depth, velocity, shift, shear_velocity;
    double force, shear_force, true_edge_force, true_edge_shear, centre_force, leave_time;
    double max_depth, max_force, max_time;
    int64_t n_contact, max_contact, phase, mode, n_steps, n_updates, n_stalled;
    struct rst_ledger ledger;
};

void rst_start_impact(const struct euler_scene *scene, struct euler_state *state, double *x2);
void rst_advance_impact(const struct euler_scene *scene, const double *g, const double *tau, const double *decay,
                        const double *gain, const double *x2, double *f, double *yz, double *u, double *yx, double *q,
                        double *slip, double *move, double *q_before, int64_t n_steps, struct euler_state *state);

#endif
