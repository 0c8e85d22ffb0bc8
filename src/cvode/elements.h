/* What CVODE integrates: the sphere and, with a tangential side, its elements.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_ELEMENTS_H
#define RST_CVODE_ELEMENTS_H

#include "cvode/run_state.h"

/* Root functions before those of the elements. */
enum { ROOT_PHASE, ROOT_SLIP_END, ROOT_ENTRY, ROOT_EXIT, ROOTS };

/* Where the tangential states begin in y. */
size_t rst_run_position_of_shear(const struct cvode_scene *scene);

/* Tangential velocity of the sphere now. */
double rst_run_shear_velocity(const struct run *run, const double *y);

/* Stick radius, from the margins last computed. */
double rst_run_stick_radius(const struct run *run);

/* The right-hand side, with the contact, margins and sums on the way. */
void rst_run_rates(struct run *run, double t, const double *y, double *rate);

/* Allowed error of a step in tangential velocities. */
double rst_run_error_scale(const struct run *run);

/* Threshold below which a value that is 0 by construction counts as 0. */
double rst_run_nearly(const struct run *run);

/* Positions of the elements, equally spaced in the angle of the edge; when the edge passed them;
 * and the memory that elements start with. */
void rst_run_place_elements(struct run *run);

/* A new CVODE for the states that there are now. */
int rst_run_integrate_from(struct run *run);

/* Add the work of this CVODE to that of the run, and end it. */
void rst_run_count_work(struct run *run);

/* Updates up to now, those of this CVODE included. */
int64_t rst_run_spent(const struct run *run);

/* Set the memory of the elements that have entered by now. Nonzero: CVODE cannot interpolate so far
 * back. */
int rst_run_admit(struct run *run, double t);

/* A step begins here. */
void rst_run_begin_step(struct run *run);

/* From here on tangential states are integrated. */
int rst_run_begin_shear(struct run *run, int after_gross_slip);

#endif
