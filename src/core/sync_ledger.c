/* The energy ledger of the method `sync` (THEORY 4.8).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "kernels.h"
#include "sync_run.h"

/* A ledger is a check: it is kept with this many levels where the pair took more, for it is dear and closes as n^-2. */
static const int64_t most_ledger_levels = 512;

static enum sync_sliding sliding(const struct rst_problem *problem, double rebound)
{
    if (problem->mode == RST_FRICTIONLESS) return RST_HAS_NO_FRICTION;
    return rst_sync_sticks(problem, rebound) ? RST_STICKS : RST_SLIPS_TO_THE_END;
}

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
    struct euler_ledger *ledger = &outcome->ledger;
    ledger->viscous_z = 1;
    if (problem->mode == RST_FRICTIONLESS) return;
    if (problem->mode == RST_GROSS_SLIP) {
        const double end = rst_sync_sticks(problem, 0) ? (2 * chi - psi) / (2 * chi - 1) : 0;
        ledger->friction_x = gross_slip_work(chi, psi, end);
    }
    ledger->viscous_x = psi * psi - outcome->shear_velocity * outcome->shear_velocity - ledger->friction_x;
}

int rst_sync_ledger(const struct rst_problem *problem, struct rst_workspace *workspace, struct rst_outcome *outcome,
                    restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    struct store store;
    double *before;
    if (outcome->sunk) {
        sink(problem, outcome);
        return RESTITUTE_OK;
    }
    const size_t terms = (size_t)s->n_terms, columns = terms + 2; /* of `before` */
    const size_t of_step = terms * (sizeof(struct sync_term) + sizeof(struct sync_loss)) / sizeof(double);
    const struct rst_outcome finer = rst_sync_with_elements(problem, outcome);
    int status = rst_sync_repeat(problem, workspace, &finer, most_ledger_levels, columns,
                                 2 * rst_sync_lanes * columns + of_step, &store, &before, error);
    if (status) return status;
    struct sync_term *now = (struct sync_term *)(before + columns * (size_t)store.capacity);
    struct sync_loss *loss = (struct sync_loss *)(now + terms);
    const struct sync_scene scene = rst_sync_scene(problem, &store);
    rst_keep_ledger(&scene, sliding(problem, -outcome->velocity), s->g, s->tau,
                    store.level, store.trace, store.node, store.body, store.beta, store.faded, store.term, before, now,
                    loss, &outcome->ledger);
    return RESTITUTE_OK;
}
