/* Functions of a solver for other components.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SOLVER_H
#define RST_SOLVER_H

#include <restitute/restitute.h>

#include "base/method.h"

/* Check the input as restitute_solve or restitute_solve_scene does. One of the two is given, with
 * its material. */
int rst_solver_check(restitute_solver *solver, const restitute_impact *impact, const restitute_scene *scene,
                     restitute_error *error);

/* Keep the normal motion between calls, for impacts on a bitwise equal solid: for a plan, or a
 * thread of a batch. No result changes by a bit. */
void rst_solver_keep_motion(restitute_solver *solver);

/* Check the caller's options (NULL: the defaults) and take them. */
int rst_take_options(const restitute_options *options, restitute_options *chosen, restitute_error *error);

#endif
