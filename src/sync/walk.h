/* The walk over elements, where a front does not describe slip, and for the energy ledger
 * (docs/sync.md).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_WALK_H
#define RST_SYNC_WALK_H

#include "sync/motion.h"

/* What a walk found: U' at the end, and the ledger. Its levels stay in the motion: `n` of each
 * phase, with their times, and U' and S at each of the 2 n + 1; of a sphere that stops in the solid
 * at the first n + 1. */
struct rst_walk {
    int64_t n;
    double velocity;
    const double *time;
    const struct walk_shear *shear;
    struct rst_ledger ledger;
};

/* Walk with `parts` elements in each panel of the compression; sticks: at some time elements do;
 * divides: for the parts of the ledger. Nonzero: out of memory. */
int rst_walk(struct rst_motion *motion, const struct rst_run *run, const struct rst_problem *problem, int sticks,
             int64_t parts, int divides, struct rst_walk *walk);

/* U' by more and more elements, on the panels of the run with `halvings` or of a coarser one. The
 * status may be TOLERANCE_NOT_REACHED if max_work is spent and there is a result. */
int rst_walk_refining(struct rst_motion *motion, const struct rst_problem *problem, int halvings,
                      struct rst_outcome *outcome, restitute_error *error);

#endif
