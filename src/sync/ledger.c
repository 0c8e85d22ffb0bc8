/* The energy ledger of the method `sync` (docs/theory.md, section 8): a walk over elements keeps
 * it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/gross_slip.h"
#include "base/status.h"
#include "sync/record.h"
#include "sync/tuning.h"
#include "sync/walk.h"

/* Largest change of a tangential part, over the energy before. */
static double change_of(const struct rst_problem *problem, struct rst_ledger a, struct rst_ledger b)
{
    const double friction = fabs(a.friction_x - b.friction_x), viscous = fabs(a.viscous_x - b.viscous_x);
    return fmax(friction, fmax(viscous, fabs(a.left_x - b.left_x))) / (problem->shear_speed * problem->shear_speed);
}

/* The parts need more elements than their sum where the solid relaxes while slip at the edge passes
 * an element: what friction takes then, and what elements leave with, depends on that. */
int rst_motion_ledger(struct rst_motion *motion, const struct rst_problem *problem, const struct rst_run *run,
                      struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_walk walk;
    if (outcome->sunk) {
        outcome->ledger = rst_sunk_ledger(problem, outcome->shear_velocity);
        return RESTITUTE_OK;
    }
    /* U' swings faster than D' */
    const double least = fmin(rst_ledger_elements * sqrt(fmax(1, problem->chi)), rst_most_ledger_elements);
    const int64_t panels = run->normal.n_compression;
    const int sticks = !rst_never_sticks(problem, -outcome->velocity);
    double change = INFINITY;
    int64_t parts = 1 + (int64_t)least / panels / 2;
    for (int walks = 0; walks < 2 || (change > rst_ledger_closeness && parts * panels <= rst_most_ledger_elements);
         walks++) {
        if (rst_walk(motion, run, problem, sticks, parts, 1, &walk))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
        change = change_of(problem, walk.ledger, outcome->ledger);
        outcome->ledger = walk.ledger;
        parts *= 2;
    }
    if (change > rst_ledger_closeness)
        rst_remark(error, "ledger: twice the elements change its tangential parts by %.2g of the energy", change);
    return RESTITUTE_OK;
}
