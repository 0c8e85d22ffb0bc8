/* The energy ledger of the method `sync` (docs/theory.md, section 8): a walk over elements keeps it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/status.h"
#include "sync/record.h"
#include "sync/tuning.h"
#include "sync/walk.h"

/* While all slips, q = f, friction does the work int f (U' - D'), and f is minus the acceleration: D' = 1 to
 * `velocity`. */
static double gross_slip_work(double chi, double psi, double velocity)
{
    return 4 * chi * ((psi - 2 * chi) * (1 - velocity) + (2 * chi - 1) * (1 - velocity * velocity) / 2);
}

/* A sphere that has sunk in is not followed. Of its energy nothing is left at the end of time, neither in it nor in
 * springs, which all relax: what friction did not take is viscous work. Friction is that of gross slip, to its end if
 * it ends; slip at the edge after that is counted as viscous. */
static void sink(const struct rst_problem *problem, struct rst_outcome *outcome)
{
    const double chi = problem->chi, psi = problem->psi;
    struct rst_ledger *ledger = &outcome->ledger;
    ledger->viscous_z = 1;
    if (problem->mode == RST_FRICTIONLESS) return;
    if (problem->mode == RST_GROSS_SLIP) {
        const double end = problem->psi < rst_critical_psi(chi, 0) ? (2 * chi - psi) / (2 * chi - 1) : 0;
        ledger->friction_x = gross_slip_work(chi, psi, end);
    }
    ledger->viscous_x = psi * psi - outcome->shear_velocity * outcome->shear_velocity - ledger->friction_x;
}

static enum rst_walk_kind sliding(const struct rst_problem *problem, double rebound)
{
    if (problem->mode == RST_FRICTIONLESS) return RST_WITHOUT_FRICTION;
    if (problem->mode == RST_NO_SLIP || problem->psi < rst_critical_psi(problem->chi, rebound)) return RST_STICKS_SOMETIME;
    return RST_SLIDES;
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
    if (rst_walk(motion, run, problem, sliding(problem, -outcome->velocity), parts, &walk))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
    outcome->ledger = walk.ledger;
    return RESTITUTE_OK;
}
