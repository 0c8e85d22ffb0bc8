/* Solving and recording by the method cvode, for any family of formulas.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_SOLVE_H
#define RST_CVODE_SOLVE_H

#include "cvode/method.h"
#include "cvode/run.h"

/* Memory that a solver keeps between calls. */
struct cvode_memory {
    struct rst_own_memory base; /* first */
    struct trace trace;         /* of the last impact */
    restitute_cvode_work work;
    int64_t updates;
};

/* A run without elements, as the problem wants it. */
struct run_setup rst_cvode_setup(const struct rst_problem *problem);

/* See struct restitute_method. */
int rst_cvode_solve(const struct rst_problem *problem, struct cvode_memory *memory, int keep_ledger,
                    struct rst_outcome *outcome, restitute_error *error);
int rst_cvode_record(const struct rst_problem *problem, struct cvode_memory *memory, const struct rst_outcome *outcome,
                     struct rst_history *history, restitute_error *error);

/* Fill outcome->ledger; the rest of the outcome is known. */
int rst_cvode_ledger(const struct run_setup *setup, struct cvode_memory *memory, struct rst_outcome *outcome,
                     restitute_error *error);

#endif
