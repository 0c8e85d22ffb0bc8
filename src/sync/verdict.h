/* What is said of an outcome, or that it took too much (docs/sync.md, section 7).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_VERDICT_H
#define RST_SYNC_VERDICT_H

#include <math.h>

#include "base/status.h"
#include "sync/motion.h"
#include "sync/tuning.h"

static inline double rst_larger_error(const struct rst_outcome *outcome)
{
    return fmax(outcome->error_ez, outcome->error_ex);
}

static inline int rst_meets(const struct rst_problem *problem, const struct rst_outcome *outcome)
{
    return rst_larger_error(outcome) <= rst_acceptance * problem->tolerance;
}

static inline int rst_sync_too_much_work(const struct rst_problem *problem, restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "%s: too little for this impact",
                      rst_spent(problem, rst_time_left(problem) <= 0).text);
}

#endif
