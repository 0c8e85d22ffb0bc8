/* The method objects: one that chooses its formulas by the scene, and one for each family.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/cvode.h>
#include <stdlib.h>

#include "base/report.h"
#include "cvode/solve.h"

static void release(struct rst_own_memory *own)
{
    struct cvode_memory *memory = (struct cvode_memory *)own;
    rst_trace_release(&memory->trace);
    rst_log_release(&memory->log);
    free(memory);
}

static int reserve(double tolerance, struct rst_workspace *workspace)
{
    (void)tolerance;
    if (workspace->own) return 0;
    struct cvode_memory *memory = calloc(1, sizeof *memory);
    if (!memory) return 1;
    memory->base.release = release;
    workspace->own = &memory->base;
    return 0;
}

static const enum integrator_family bdf = INTEGRATOR_BDF, adams = INTEGRATOR_ADAMS;

static int solve_with(const enum integrator_family *family, const struct rst_problem *problem,
                      struct rst_workspace *workspace, int keep_ledger, struct rst_outcome *outcome,
                      restitute_error *error)
{
    if (reserve(problem->tolerance, workspace)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    return rst_cvode_solve(problem, (struct cvode_memory *)workspace->own, family, keep_ledger, outcome, error);
}

static int record_with(const enum integrator_family *family, const struct rst_problem *problem,
                       struct rst_workspace *workspace, const struct rst_outcome *outcome, struct rst_history *history,
                       restitute_error *error)
{
    return rst_cvode_record(problem, (struct cvode_memory *)workspace->own, family, outcome, history, error);
}

/* A method object with its two functions. */
#define METHOD(identifier, word, family)                                                                               \
    static int identifier##_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger, \
                                  struct rst_outcome *outcome, restitute_error *error)                                 \
    {                                                                                                                  \
        return solve_with(family, problem, workspace, keep_ledger, outcome, error);                                    \
    }                                                                                                                  \
    static int identifier##_record(const struct rst_problem *problem, struct rst_workspace *workspace,                 \
                                   const struct rst_outcome *outcome, struct rst_history *history,                     \
                                   restitute_error *error)                                                             \
    {                                                                                                                  \
        return record_with(family, problem, workspace, outcome, history, error);                                       \
    }                                                                                                                  \
    static const struct restitute_method identifier = {.name = word,                                                   \
                                                       .time_limit = 1,                                                \
                                                       .reserve = reserve,                                             \
                                                       .records_between_steps = 1,                                     \
                                                       .solve = identifier##_solve,                                    \
                                                       .record = identifier##_record}

METHOD(by_scene, "cvode", NULL);
METHOD(by_bdf, "cvode-bdf", &bdf);
METHOD(by_adams, "cvode-adams", &adams);

const restitute_method *restitute_method_cvode(void)
{
    return &by_scene;
}

const restitute_method *restitute_method_cvode_bdf(void)
{
    return &by_bdf;
}

const restitute_method *restitute_method_cvode_adams(void)
{
    return &by_adams;
}

const char *restitute_cvode_sundials_version(void)
{
    return rst_integrator_version();
}
