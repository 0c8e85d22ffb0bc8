/* What the files of the method `sync` share: a run, its memory, its repetition.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_RUN_H
#define RST_SYNC_RUN_H

#include <stddef.h>

#include "problem.h"
#include "workspace.h"

/* What a run works on, laid out in the workspace. */
struct store {
    int64_t capacity;         /* of the arrays of elements */
    struct sync_level *level; /* 2n + 1 */
    struct sync_node *node;   /* n + 1 */
    struct sync_term *term;   /* n_terms */
    double *memory, *loading; /* n_terms times 2n + 1 and n + 1 */
    double *body;             /* columns times capacity */
    double *beta, *faded;     /* n_terms times capacity */
};

/* Whether elements are needed: not without friction, nor in slip to the end, which is known once e_z is (THEORY 4.2). */
int rst_sync_sticks(const struct rst_problem *problem, double rebound);

struct sync_scene rst_sync_scene(const struct rst_problem *problem, int64_t levels, const struct store *store);

/* Solve the normal problem again as it was solved at that number of levels, with room for `more` doubles behind it. */
int rst_sync_repeat(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels, size_t more,
                    struct store *store, double **room, restitute_error *error);

/* Fill outcome->ledger; the rest of the outcome is known. */
int rst_sync_ledger(const struct rst_problem *problem, struct rst_workspace *workspace, struct rst_outcome *outcome,
                    restitute_error *error);

/* See struct restitute_method. */
int rst_sync_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error);

#endif
