/* Many impacts by several threads. Each case is solved alone. A solver keeps only data that the
 * next case would compute itself with the same bits. So the results do not depend on the number of
 * threads or on the order of the cases.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "base/parallel.h"
#include "base/sized.h"
#include "base/status.h"
#include "solver/solver.h"

/* The data of one thread: a solver, and the case that it would report to the caller. */
struct worker {
    restitute_solver *solver;
    size_t index;
    restitute_error error; /* of that case; its status is 0 as long as there was no remark */
};

/* One of the two arrays of cases is there. */
struct batch {
    size_t n;
    const restitute_impact *impacts;
    const restitute_scene *scenes;
    restitute_result *results;
    int *statuses;
    struct worker *workers; /* one a thread */
};

/* Failures come before remarks, then the lower index. */
static void note(struct worker *worker, size_t index, const restitute_error *error)
{
    const int first = worker->error.status == 0;
    const int graver = error->status < 0 && worker->error.status >= 0;
    const int as_grave = (error->status < 0) == (worker->error.status < 0);
    if (!first && !graver && !(as_grave && index < worker->index)) return;
    worker->index = index;
    worker->error = *error;
}

static void solve_case(void *of, int thread, int64_t index)
{
    const struct batch *const batch = of;
    struct worker *const worker = &batch->workers[thread];
    const size_t i = (size_t)index;
    restitute_error error;
    restitute_result *result = batch->results ? rst_at(batch->results, i) : NULL;
    error.status = batch->scenes
                       ? restitute_solve_scene(worker->solver, rst_at(batch->scenes, i), result, NULL, NULL, &error)
                       : restitute_solve(worker->solver, rst_at(batch->impacts, i), result, NULL, NULL, &error);
    if (batch->statuses) batch->statuses[i] = error.status;
    if (error.status != RESTITUTE_OK) note(worker, i, &error);
}

static int create_workers(const restitute_options *options, int threads, struct worker *workers, restitute_error *error)
{
    for (int i = 0; i < threads; i++) {
        const int status = restitute_solver_create(options, &workers[i].solver, error);
        if (status) return status;
        rst_solver_keep_motion(workers[i].solver); /* for consecutive impacts on one solid */
    }
    return RESTITUTE_OK;
}

/* The case that is reported to the caller. */
static int report_first(const struct batch *batch, int threads, restitute_error *error)
{
    const struct worker *const workers = batch->workers;
    struct worker first = workers[0];
    for (int i = 1; i < threads; i++)
        if (workers[i].error.status != RESTITUTE_OK) note(&first, workers[i].index, &workers[i].error);
    if (first.error.status == RESTITUTE_OK) return rst_done(error);
    return rst_report(error, first.error.status, "%s[%zu]: %s", batch->scenes ? "scenes" : "impacts", first.index,
                      first.error.message);
}

/* Where a struct has another size than the first, the next one cannot be found. */
static int check_batch(const struct batch *batch, restitute_error *error)
{
    int status = batch->scenes ? RST_CHECK_ARRAY(scene, batch->scenes, batch->n, "scenes", error)
                               : RST_CHECK_ARRAY(impact, batch->impacts, batch->n, "impacts", error);
    if (!status && batch->results) status = RST_CHECK_ARRAY(result, batch->results, batch->n, "results", error);
    return status;
}

static int solve_batch(struct batch *batch, const restitute_options *options, restitute_error *error)
{
    restitute_options chosen;
    int status = rst_take_options(options, &chosen, error);
    if (!status) status = check_batch(batch, error);
    if (status) return status;
    const int threads = rst_threads(chosen.threads, (int64_t)batch->n);
    struct worker *const workers = batch->workers = calloc((size_t)threads, sizeof *workers);
    if (!workers) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %d threads", threads);
    status = create_workers(&chosen, threads, workers, error);
    if (!status) {
        rst_loop(threads, (int64_t)batch->n, solve_case, batch);
        status = report_first(batch, threads, error);
    }
    for (int i = 0; i < threads; i++)
        restitute_solver_destroy(workers[i].solver);
    free(workers);
    return status;
}

int restitute_solve_many(size_t n, const restitute_impact *impacts, const restitute_options *options,
                         restitute_result *results, int *statuses, restitute_error *error)
{
    struct batch batch = {.n = n, .impacts = impacts, .results = results, .statuses = statuses};
    if (n > 0 && !impacts) return rst_report(error, RESTITUTE_ERROR_NULL, "impacts is NULL");
    return solve_batch(&batch, options, error);
}

int restitute_solve_scene_many(size_t n, const restitute_scene *scenes, const restitute_options *options,
                               restitute_result *results, int *statuses, restitute_error *error)
{
    struct batch batch = {.n = n, .scenes = scenes, .results = results, .statuses = statuses};
    if (n > 0 && !scenes) return rst_report(error, RESTITUTE_ERROR_NULL, "scenes is NULL");
    return solve_batch(&batch, options, error);
}
