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

/* The method and the workspace of a solver, for components of the same version that bring a method.
 * Exported from the shared library, but no part of its interface. */
RESTITUTE_API const struct restitute_method *restitute_private_method(const restitute_solver *solver);
RESTITUTE_API struct rst_workspace *restitute_private_workspace(restitute_solver *solver);

#endif
