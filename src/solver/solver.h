/* What others need of a solver.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SOLVER_H
#define RST_SOLVER_H

#include <restitute/restitute.h>

#include "base/method.h"

/* Refuse what restitute_solve, or restitute_solve_scene, would refuse. One of the two is given, with its material. */
int rst_solver_check(restitute_solver *solver, const restitute_impact *impact, const restitute_scene *scene,
                     restitute_error *error);

/* From now on a normal motion that was solved serves the next impact, if its solid is the same bit by bit: for whoever
 * holds a solver for many impacts on one solid, a plan or a thread of a batch. No result changes by a bit. */
void rst_solver_keep_motion(restitute_solver *solver);

/* Check the caller's options (NULL: the defaults) and take them. */
int rst_take_options(const restitute_options *options, restitute_options *chosen, restitute_error *error);

#endif
