/* The energy ledger of the method `sync` (docs/theory.md, section 8): a walk over elements keeps
 * it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/gross_slip.h"
#include "base/status.h"
#include "sync/record.h"
#include "sync/tuning.h"
#include "sync/walk.h"

/* A sphere that has sunk in is not followed. Of its energy nothing is left at the end of time,
 * neither in it nor in springs, which all relax: what friction did not take is viscous work.
 * Friction is that of gross slip, to its end if it ends; slip at the edge after that is counted as
 * viscous. */
static void sink(const struct rst_problem *problem, struct rst_outcome *outcome)
{
    const double before = problem->shear_speed, after = outcome->shear_velocity;
    struct rst_ledger *ledger = &outcome->ledger;
    ledger->viscous_z = 1;
    if (problem->mode == RST_FRICTIONLESS) return;
    if (problem->mode == RST_GROSS_SLIP)
        ledger->friction_x =
            rst_gross_slip_work(problem, rst_never_sticks(problem, 0) ? 0 : rst_end_of_gross_slip(problem));
    ledger->viscous_x = before * before - after * after - ledger->friction_x;
}

int rst_motion_ledger(struct rst_motion *motion, const struct rst_problem *problem, const struct rst_run *run,
                      struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_walk walk;
    if (outcome->sunk) {
        sink(problem, outcome);
        return RESTITUTE_OK;
    }
    /* U' swings faster than D' */
    const double least = fmin(rst_ledger_elements * sqrt(fmax(1, problem->chi)), rst_most_ledger_elements);
    const int64_t parts = 1 + (int64_t)least / run->normal.n_compression;
    if (rst_walk(motion, run, problem, !rst_never_sticks(problem, -outcome->velocity), parts, &walk))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
    outcome->ledger = walk.ledger;
    return RESTITUTE_OK;
}
