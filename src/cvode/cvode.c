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
    free(memory);
}

static int reserve(double tolerance, struct rst_workspace *workspace)
{
    (void)tolerance;
    return !rst_own_memory_of(workspace, sizeof(struct cvode_memory), release);
}

static int solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                 struct rst_outcome *outcome, restitute_error *error)
{
    if (reserve(problem->tolerance, workspace)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    return rst_cvode_solve(problem, (struct cvode_memory *)workspace->own, keep_ledger, outcome, error);
}

static int record(const struct rst_problem *problem, struct rst_workspace *workspace, const struct rst_outcome *outcome,
                  struct rst_history *history, restitute_error *error)
{
    return rst_cvode_record(problem, (struct cvode_memory *)workspace->own, outcome, history, error);
}

/* What is counted are elements, and terms of each, at every evaluation of the rates and of the
 * rootfunctions: 2 to 25 ns each with elements, 10 in the mean of impacts to 1e-5 (measured,
 * x86-64). */
#define UPDATES_PER_SECOND 1e8

#define BASE(word)                                                                                                     \
    {                                                                                                                  \
        .struct_size = sizeof(struct restitute_method), .number = RST_METHOD_NUMBER, .name = (word), .time_limit = 1,  \
        .updates_per_second = UPDATES_PER_SECOND, .reserve = reserve, .records_between_steps = 1, .solve = solve,      \
        .record = record                                                                                               \
    }

static const enum integrator_family bdf = INTEGRATOR_BDF, adams = INTEGRATOR_ADAMS;
static const struct cvode_method by_scene = {.base = BASE("cvode")};
static const struct cvode_method by_bdf = {.base = BASE("cvode-bdf"), .family = &bdf};
static const struct cvode_method by_adams = {.base = BASE("cvode-adams"), .family = &adams};

const restitute_method *restitute_method_cvode(void)
{
    return &by_scene.base;
}

const restitute_method *restitute_method_cvode_bdf(void)
{
    return &by_bdf.base;
}

const restitute_method *restitute_method_cvode_adams(void)
{
    return &by_adams.base;
}

const char *restitute_cvode_sundials_version(void)
{
    return rst_integrator_version();
}
