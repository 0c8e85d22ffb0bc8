/* The levels that the tangential problem of the method `sync` is followed on, made from those of the normal problem,
 * and its arrays of elements. SPDX-License-Identifier: BSD-3-Clause */
#include "kernels.h"
#include "status.h"
#include "sync_run.h"

static int64_t padded(int64_t count)
{
    return (count + rst_sync_lanes - 1) / rst_sync_lanes * rst_sync_lanes;
}

/* Start of `count` doubles behind what is taken already. */
static double *take(double *block, size_t *taken, size_t count)
{
    double *start = block ? block + *taken : NULL;
    *taken += count;
    return start;
}

/* Lay out the levels behind what is taken of the block. All members are structs of doubles. */
static void lay_out_levels(double *block, int64_t levels, int64_t n_terms, size_t *taken, struct store *store)
{
    const size_t n = (size_t)levels, m = (size_t)n_terms;
    store->levels = levels;
    store->level = (struct sync_level *)take(block, taken, (2 * n + 1) * (sizeof *store->level / sizeof(double)));
    store->trace = (struct sync_trace *)take(block, taken, m * (2 * n + 1) * (sizeof *store->trace / sizeof(double)));
    store->node = (struct sync_node *)take(block, taken, (n + 1) * (sizeof *store->node / sizeof(double)));
}

/* The same for what a run on them works on. */
static void lay_out_elements(double *block, int64_t levels, int64_t n_terms, size_t *taken, struct store *store)
{
    const size_t m = (size_t)n_terms;
    store->capacity = padded(levels + rst_sync_lanes); /* the loop goes on to the end of a group of lanes */
    const size_t capacity = (size_t)store->capacity;
    store->term = (struct sync_term *)take(block, taken, m * (sizeof *store->term / sizeof(double)));
    store->body = take(block, taken, capacity * rst_sync_columns);
    store->beta = take(block, taken, m * capacity);
    store->faded = take(block, taken, m * capacity);
}

/* Most of them: levels may be halved until one is left. */
enum { most_rungs = 20 };

/* `levels`, half of them, and so on, behind each other; returns how many doubles that takes. */
static size_t lay_out_rungs(double *block, int64_t levels, int count, int64_t n_terms, struct store rung[most_rungs])
{
    size_t taken = 0;
    for (int k = 0; k < count; k++, levels /= 2)
        lay_out_levels(block, levels, n_terms, &taken, &rung[k]);
    return taken;
}

/* `levels` thinned to no more than `most` are the last of so many rungs. */
static int rungs_down_to(int64_t levels, int64_t most)
{
    int count = 1;
    for (; levels > most && levels % 4 == 0; levels /= 2)
        count++;
    return count;
}

size_t rst_sync_run_room(int64_t levels, int64_t n_terms)
{
    struct store store;
    size_t taken = 0;
    lay_out_levels(NULL, levels, n_terms, &taken, &store);
    lay_out_elements(NULL, levels, n_terms, &taken, &store);
    return taken;
}

size_t rst_sync_first_room(int64_t levels, int64_t n_terms)
{
    struct store rung[most_rungs];
    return lay_out_rungs(NULL, levels, rst_sync_first_runs, n_terms, rung);
}

/* `ratio` times the levels of the normal problem, then every other one of them, and so on, for runs from rung `first`
 * on. Nonzero: an error, or a time was not found. */
static int make_rungs(const struct rst_problem *problem, const struct normal *normal, int64_t ratio, int first,
                      int count, const struct store *rung, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    int64_t failed = 0;
    rst_dense_levels(&normal->grid, s->g_inf, s->eta, s->n_terms, s->g, s->tau, normal->levels, ratio,
                                 normal->level, rung->level, rung->trace, rung->node, &failed);
    if (failed)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "iterations do not settle between %lld levels; take the method euler for this solid",
                          (long long)normal->levels);
    for (int k = 1; k < count; k++)
        rst_thin_levels(s->n_terms, rung[k].levels, rung[k - 1].level, rung[k - 1].trace, rung[k - 1].node,
                        rung[k].level, rung[k].trace, rung[k].node);
    for (int k = first; k < count; k++)
        rst_finish_levels(s->g_inf, s->n_terms, rung[k].levels, rung[k].trace, rung[k].node, rung[k].level);
    return RESTITUTE_OK;
}

static int out_of_memory(int64_t levels, restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)levels);
}

int rst_sync_levels(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                    const struct resolution *resolution, size_t more, struct store *store, double *largest_force,
                    double **room, restitute_error *error)
{
    const int64_t n_terms = problem->solid.n_terms, all = resolution->ratio * normal->levels;
    const int count = rungs_down_to(all, resolution->levels);
    struct store rung[most_rungs];
    size_t taken = lay_out_rungs(NULL, all, count, n_terms, rung);
    const size_t of_levels = taken;
    lay_out_elements(NULL, rung[count - 1].levels, n_terms, &taken, &rung[count - 1]);
    if (rst_workspace_elements(workspace, taken + more)) return out_of_memory(all, error);
    lay_out_rungs(workspace->elements, all, count, n_terms, rung);
    const int status = make_rungs(problem, normal, resolution->ratio, count - 1, count, rung, error);
    if (status) return status;
    *store = rung[count - 1];
    *room = workspace->elements + taken;
    taken = of_levels;
    lay_out_elements(workspace->elements, store->levels, n_terms, &taken, store);
    *largest_force = rst_sync_largest_force(rung->level, all);
    return RESTITUTE_OK;
}

int rst_sync_first_levels(const struct rst_problem *problem, struct rst_workspace *workspace,
                          const struct normal *normal, const struct resolution *resolution, int runs,
                          struct store *store, double *largest_force, restitute_error *error)
{
    struct rst_shelf *shelf = rst_sync_shelf(problem, workspace);
    struct kept *kept = rst_sync_kept(shelf);
    const int64_t n_terms = problem->solid.n_terms, all = resolution->ratio * normal->levels;
    const int first = rungs_down_to(all, resolution->levels) - 1, count = first + runs;
    struct store rung[most_rungs];
    size_t taken = 0;
    lay_out_elements(NULL, resolution->levels, n_terms, &taken, store);
    if (rst_workspace_elements(workspace, taken)) return out_of_memory(all, error);
    if (kept->ratio != resolution->ratio || kept->levels != resolution->levels || kept->all != all) {
        kept->ratio = 0;
        if (rst_shelf_dense(shelf, lay_out_rungs(NULL, all, count, n_terms, rung))) return out_of_memory(all, error);
        lay_out_rungs(shelf->dense, all, count, n_terms, rung);
        const int status = make_rungs(problem, normal, resolution->ratio, first, count, rung, error);
        if (status) return status;
        *kept = (struct kept){resolution->ratio, resolution->levels, all, rst_sync_largest_force(rung->level, all)};
    }
    lay_out_rungs(shelf->dense, all, count, n_terms, rung);
    for (int k = 0; k < runs; k++) {
        store[k] = rung[first + k];
        taken = 0;
        lay_out_elements(workspace->elements, store[k].levels, n_terms, &taken, &store[k]);
    }
    *largest_force = kept->largest_force;
    return RESTITUTE_OK;
}

int rst_sync_repeat(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, int64_t most, size_t a_level, size_t more, struct store *store,
                    double **room, restitute_error *error)
{
    struct normal normal;
    double largest_force;
    const int64_t coarse = outcome->normal_levels, wanted = outcome->elements < most ? outcome->elements : most;
    struct resolution resolution = {wanted / coarse > 0 ? wanted / coarse : 1, wanted};
    int status = rst_sync_normal_of(problem, workspace, coarse, &normal, error);
    if (status) return status;
    for (;; resolution.levels = resolution.ratio * coarse) {
        const size_t all = a_level * (size_t)(2 * resolution.ratio * coarse + 1) + more;
        status = rst_sync_levels(problem, workspace, &normal, &resolution, all, store, &largest_force, room,
                                 resolution.ratio > 1 ? NULL : error);
        if (status != RESTITUTE_ERROR_TOO_MUCH_WORK || resolution.ratio == 1) return status;
        resolution.ratio /= 2;
    }
}
