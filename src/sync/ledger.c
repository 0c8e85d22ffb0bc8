/* The energy ledger of the method `sync` (docs/theory.md, section 8): a walk over elements keeps
 * it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/gross_slip.h"
#include "base/status.h"
#include "sync/record.h"
#include "sync/tuning.h"
#include "sync/walk.h"

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
    if (rst_walk(motion, run, problem, sticks, 1 + (int64_t)least / panels, 1, &walk))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
    outcome->ledger = walk.ledger;
    return RESTITUTE_OK;
}
