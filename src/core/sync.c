/* The method `sync`: the normal problem without elements, the tangential one with elements at the places where the edge
 * of contact is at the levels of time (THEORY 4.3 to 4.6 and 6), refined until its error estimate is met.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync.h"

#include <math.h>

#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Solutions at n and n/2 levels are compared. Errors fall by 8 (tangential, third order) or 16 (normal, fourth order)
 * from one to the other, so the change is 7 or 15 times the error; what the estimate keeps of it covers cases that are less
 * regular (docs/accuracy.md). */
static const double share_of_change_ez = 1.0 / 3, share_of_change_ex = 1.0 / 3;

/* What rounding leaves in the velocities, whatever the number of levels. */
static const double rounding = 2e-12;

/* Most levels that a run may have; work grows with the square. */
static const int64_t most_levels = 1 << 20;

struct run {
    int64_t levels;
    double velocity, shear_velocity;
    double contact_time, depth, force;
    int64_t updates;
};

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

/* Lay out the block; returns how many doubles that takes. All members are structs of doubles. */
static size_t lay_out(double *block, int64_t levels, int64_t n_terms, struct store *store)
{
    const size_t n = (size_t)levels, m = (size_t)n_terms;
    size_t taken = 0;
    store->capacity = padded(levels + 1);
    const size_t capacity = (size_t)store->capacity;
    store->level = (struct sync_level *)take(block, &taken, (2 * n + 1) * (sizeof *store->level / sizeof(double)));
    store->node = (struct sync_node *)take(block, &taken, (n + 1) * (sizeof *store->node / sizeof(double)));
    store->term = (struct sync_term *)take(block, &taken, m * (sizeof *store->term / sizeof(double)));
    store->memory = take(block, &taken, m * (2 * n + 1));
    store->loading = take(block, &taken, m * (n + 1));
    store->body = take(block, &taken, capacity * rst_sync_columns);
    store->beta = take(block, &taken, m * capacity);
    store->faded = take(block, &taken, m * capacity);
    return taken;
}

/* Whether elements are needed: not without friction, nor in slip to the end, which is known once e_z is (THEORY 4.2). */
int rst_sync_sticks(const struct rst_problem *problem, double rebound)
{
    if (problem->mode == RST_FRICTIONLESS) return 0;
    if (problem->mode != RST_GROSS_SLIP) return 1;
    return problem->psi < rst_critical_psi(problem->chi, rebound);
}

static double full_slip(const struct rst_problem *problem, double velocity)
{
    return problem->mode == RST_FRICTIONLESS ? problem->psi : problem->psi - 2 * problem->chi * (1 - velocity);
}

struct sync_scene rst_sync_scene(const struct rst_problem *problem, int64_t levels, const struct store *store)
{
    return (struct sync_scene){.chi = problem->chi,
                               .psi = problem->psi,
                               .g_inf = problem->solid.g_inf,
                               .eta = problem->solid.eta,
                               .n_terms = problem->solid.n_terms,
                               .n = levels,
                               .capacity = store->capacity,
                               .no_slip = problem->mode == RST_NO_SLIP};
}

static void follow_shear(const struct rst_problem *problem, sync_loop *loop, int64_t n, const struct store *store,
                         struct sync_shear *shear)
{
    const struct rst_solid *s = &problem->solid;
    const struct sync_scene scene = rst_sync_scene(problem, n, store);
    rst_follow_shear(&scene, loop, s->g, s->tau, store->level, store->memory, store->node, store->body, store->beta,
                     store->faded, store->term, shear);
}

/* Largest of 2n + 1 forces, by the parabola through it and its neighbours. */
static double largest_force(const struct sync_level *level, int64_t n)
{
    int64_t i = 1;
    while (i < 2 * n - 1 && level[i + 1].force > level[i].force)
        i++;
    const double a = level[i].time - level[i - 1].time, b = level[i + 1].time - level[i].time;
    const double rise = (level[i].force - level[i - 1].force) / a, fall = (level[i + 1].force - level[i].force) / b;
    const double bend = (fall - rise) / (a + b);
    const double slope = rise + a * bend; /* at i */
    return bend < 0 ? level[i].force - slope * slope / (4 * bend) : level[i].force;
}

static int solve_normal(const struct rst_problem *problem, const struct rst_workspace *workspace,
                        const struct sync_grid *grid, int64_t n, struct store *store)
{
    const struct rst_solid *s = &problem->solid;
    const double closeness = fmax(1e-13, 1e-3 * problem->tolerance);
    int64_t failed;
    lay_out(workspace->elements, n, s->n_terms, store);
    rst_normal_levels(grid, s->g_inf, s->eta, s->n_terms, s->g, s->tau, n, closeness, store->level, store->memory,
                      store->loading, store->node, &failed);
    return failed || !isfinite(store->level[2 * n].velocity);
}

int rst_sync_repeat(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels, size_t more,
                    struct store *store, double **room, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    struct sync_grid grid;
    const size_t taken = lay_out(NULL, levels, s->n_terms, store);
    if (rst_workspace_elements(workspace, taken + more))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)levels);
    rst_choose_grid(s->g_inf, s->eta, s->n_terms, s->g, s->tau, &grid);
    solve_normal(problem, workspace, &grid, levels, store); /* it has settled before */
    *room = workspace->elements + taken;
    return RESTITUTE_OK;
}

/* One impact at one resolution; nonzero if its iterations did not settle. */
static int run_once(const struct rst_problem *problem, const struct rst_workspace *workspace,
                    const struct sync_grid *grid, struct run *run, struct store *store)
{
    const int64_t n = run->levels;
    if (solve_normal(problem, workspace, grid, n, store)) return 1;
    run->velocity = store->level[2 * n].velocity;
    run->contact_time = store->level[2 * n].time;
    run->depth = store->level[n].depth;
    run->force = largest_force(store->level, n);
    run->updates = 2 * n;
    run->shear_velocity = full_slip(problem, run->velocity);
    if (rst_sync_sticks(problem, -run->velocity)) {
        struct sync_shear shear;
        follow_shear(problem, workspace->loop, n, store, &shear);
        run->shear_velocity = shear.velocity;
        run->updates += shear.updates * (1 + problem->solid.n_terms);
    }
    return !isfinite(run->shear_velocity);
}

static void fill(const struct run *run, double error_ez, double error_ex, int64_t updates, struct rst_outcome *outcome)
{
    *outcome = (struct rst_outcome){.velocity = run->velocity,
                                    .shear_velocity = run->shear_velocity,
                                    .error_ez = error_ez,
                                    .error_ex = error_ex,
                                    .contact_time = run->contact_time,
                                    .followed_time = run->contact_time,
                                    .max_indentation = run->depth,
                                    .max_contact_radius = sqrt(run->depth),
                                    .max_normal_force = 15.0 / 8.0 * run->force,
                                    .spacing = sqrt(run->depth) / (double)run->levels,
                                    .step = run->contact_time / (double)(2 * run->levels),
                                    .elements = run->levels,
                                    .steps = 2 * run->levels,
                                    .updates = updates};
}

/* A solid without equilibrium modulus that the sphere sinks into (THEORY 4.9): both velocities end at nothing, unless it
 * slips to the end. */
static int solve_sunk(const struct rst_problem *problem, struct rst_outcome *outcome, restitute_error *error)
{
    const int slides = !rst_sync_sticks(problem, 0);
    *outcome =
        (struct rst_outcome){.shear_velocity = slides ? full_slip(problem, 0) : 0, .contact_time = INFINITY, .sunk = 1};
    return rst_done(error);
}

static int64_t even(double count)
{
    return 2 * (int64_t)ceil(fmin(count, (double)most_levels) / 2);
}

/* The counts that the error of the median impact asks for: e_x ~ 13 n^-3, e_z ~ 20 n^-4 (docs/accuracy.md). The tangential
 * oscillation in stick is faster than the normal one by sqrt(2 chi). */
static int64_t levels_to_start(const struct rst_problem *problem)
{
    const double normal = pow(20 / problem->tolerance, 0.25);
    if (!rst_sync_sticks(problem, 1)) return even(fmax(8, normal));
    const double faster = sqrt(fmax(1, problem->chi * 6 / 7));
    return even(fmax(8, fmax(normal, faster * cbrt(25 / problem->tolerance))));
}

static double error_from(double change, double share)
{
    return share * change + rounding;
}

static int too_much(const struct rst_problem *problem, int64_t levels, int64_t spent)
{
    const double cost = (double)levels * (double)levels * (double)(1 + problem->solid.n_terms);
    return levels > most_levels || (double)spent + cost > (double)problem->max_updates;
}

static int solve_refining(const struct rst_problem *problem, struct rst_workspace *workspace,
                          struct rst_outcome *outcome, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    struct run runs[2] = {{0}};
    struct sync_grid grid;
    struct store store;
    int64_t updates = 0, found = 0;
    int known = 0; /* whether the run before is of use */
    if (s->can_sink) {
        double depth, time;
        int64_t sinks;
        double *stress = workspace->terms + 4 * (workspace->terms_size / rst_term_arrays);
        rst_scout_compression(s->g_inf, s->eta, s->n_terms, s->g, s->tau, s->can_sink, 0.01 * problem->tolerance,
                              stress, &depth, &time, &sinks);
        if (sinks) return solve_sunk(problem, outcome, error);
    }
    rst_choose_grid(s->g_inf, s->eta, s->n_terms, s->g, s->tau, &grid);
    int64_t levels = problem->elements > 0 ? even((double)problem->elements / 2) : even(levels_to_start(problem) / 2);
    for (int last = 0;; levels *= 2) {
        struct run *now = &runs[1], *before = &runs[0];
        if (too_much(problem, levels, updates)) break;
        if (rst_workspace_elements(workspace, lay_out(NULL, levels, s->n_terms, &store)))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)levels);
        *before = *now;
        *now = (struct run){.levels = levels};
        int unsettled = run_once(problem, workspace, &grid, now, &store);
        updates += now->updates;
        if (!unsettled && known) {
            double error_ez = error_from(fabs(now->velocity - before->velocity), share_of_change_ez);
            double error_ex =
                error_from(fabs(now->shear_velocity - before->shear_velocity) / problem->psi, share_of_change_ex);
            fill(now, error_ez, problem->mode == RST_FRICTIONLESS ? 0 : error_ex, updates, outcome);
            found = 1;
            if (fmax(outcome->error_ez, outcome->error_ex) <= problem->tolerance) return rst_done(error);
        }
        known = !unsettled;
        if (problem->elements > 0 && last++) break;
    }
    if (!found)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "max_updates = %lld: spent before there was a result; raise it",
                          (long long)problem->max_updates);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) when max_updates = %lld were spent",
                      problem->tolerance, outcome->error_ez, outcome->error_ex, (long long)problem->max_updates);
}

static int sync_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                      struct rst_outcome *outcome, restitute_error *error)
{
    const int status = solve_refining(problem, workspace, outcome, error);
    if (status < 0 || !keep_ledger) return status;
    const int kept = rst_sync_ledger(problem, workspace, outcome, error);
    return kept ? kept : status;
}

const struct restitute_method rst_method_sync = {.name = "sync", .solve = sync_solve, .record = rst_sync_record};
