/* The interface between a method and the core.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_METHOD_H
#define RST_METHOD_H

#include "base/problem.h"
#include "base/workspace.h"

/* A method may come from a library of another version. Raise the number with every change of this
 * struct or of what core and method share through it: rst_problem, rst_workspace, rst_outcome,
 * rst_history, and the procedures of base. */
enum { RST_METHOD_NUMBER = 1 };

struct restitute_method {
    size_t struct_size; /* these three stay where they are */
    int number;         /* RST_METHOD_NUMBER */
    const char *name;
    double time_limit;         /* s, where the options have none */
    double updates_per_second; /* what the method counts in a nominal second, see restitute_options.max_work */
    /* Memory for usual impacts at that tolerance, so that a solver does not allocate later.
     * Optional; nonzero: none left. */
    int (*reserve)(double tolerance, struct rst_workspace *workspace);
    int takes_time_step;       /* 0: chooses its steps itself, restitute_options.time_step must be 0 */
    int takes_all_terms;       /* no merging: a fast term would become a dashpot, which this method cannot do */
    int cheap_without_slip;    /* the core may solve again without slip, where following it errs by more */
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
