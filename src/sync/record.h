/* History and ledger of the method `sync`, from the run that gave the pair.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_RECORD_H
#define RST_SYNC_RECORD_H

#include "sync/motion.h"

/* Fill outcome->ledger; the rest of the outcome is known. */
int rst_motion_ledger(struct rst_motion *motion, const struct rst_problem *problem, const struct rst_run *run,
                    struct rst_outcome *outcome, restitute_error *error);

/* See struct restitute_method. */
int rst_motion_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error);

#endif
