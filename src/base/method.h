/* The interface between a method and the core.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_METHOD_H
#define RST_METHOD_H

#include "base/problem.h"
#include "base/workspace.h"

struct restitute_method {
    const char *name;
    double time_limit; /* s, where the options have none */
    /* Allocate memory for usual impacts at this tolerance, so that a solver need not do it later.
     * Optional. Nonzero: out of memory. */
    int (*reserve)(double tolerance, struct rst_workspace *workspace);
    int takes_time_step;       /* 0: chooses its steps itself, restitute_options.time_step must be 0 */
    int takes_all_terms;       /* no merging: a fast term would become a dashpot, which this method cannot do */
    int records_between_steps; /* samples of a history may be closer than its steps */
    /* Solve; `outcome` is valid if the status is not negative. keep_ledger: fill
     * outcome->ledger. */
    int (*solve)(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                 struct rst_outcome *outcome, restitute_error *error);
    /* Repeat the run that gave `outcome` and sample it at equal times into `history`. */
    int (*record)(const struct rst_problem *problem, struct rst_workspace *workspace, const struct rst_outcome *outcome,
                  struct rst_history *history, restitute_error *error);
};

#endif
