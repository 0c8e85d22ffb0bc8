/* The method `sync`: the normal problem without elements, the tangential one with elements at the places where the edge
 * of contact is at the levels of time (THEORY 4.3 to 4.6 and 6), refined until its error estimate is met.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync.h"

#include <math.h>
#include <stdio.h>

#include "euler.h"
#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Solutions at n and n/2 levels are compared. e_z is of fourth order: the change is 15 times the error of the finer one, which
 * is taken off. e_x is of third order where kinks fall regularly between nodes; half of what that would take off is best. */
static const double part_taken_ez = 1.0 / 15, part_taken_ex = 1.0 / 14;

/* The estimate is this part of the change, so that 95 of 100 are not too small (docs/accuracy.md). A change may be small by chance,
 * so it does not stand alone: it is not taken for less than an eighth of the change before, and for e_x twice the error of
 * the median impact, 30 max(1, chi)^(3/2) n^-3, is added, and twice that where psi is so small that few nodes slip. */
static const double share_of_change_ez = 0.6, share_of_change_ex = 0.6, usual_error = 30, thin_slip = 0.1;
static const double fall_at_least = 1.0 / 8;

/* Iterations stop when velocities change by less than this part of the tolerance, or by what rounding leaves; what rounding
 * leaves of the tangential velocity in a level adds up. */
static const double closeness = 0.002, rounding = 1e-12, rounding_of_level = 1e-12;

/* e_x differs from that without slip by at most this times psi (docs/accuracy.md), which is left out where it is a small
 * part of the tolerance. */
static const double change_by_slip = 2, negligible_part = 0.05;

/* The rest of the tolerance is for merged terms. */
static const double acceptance = 0.9;

/* asinh of the impact speed over that of the creep at the turning point (sync_grid.turn): 1e8. */
static const double strongest_damping = 19.1;

/* Most levels that a run may have: with more, rounding adds up to more than they gain. */
static const int64_t most_levels = 1 << 15;

/* Half as many are the fewest that settle for a solid without strong damping. */
static const double least_told = 8;

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
    store->capacity = padded(levels + rst_sync_lanes); /* the loop goes on to the end of a group of lanes */
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
    return problem->mode == RST_NO_SLIP || problem->psi < rst_critical_psi(problem->chi, rebound);
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

static double closeness_of(const struct rst_problem *problem)
{
    return problem->elements > 0 ? rounding : fmax(rounding, closeness * problem->tolerance);
}

/* Nonzero if its iterations did not settle. */
static int solve_normal(const struct rst_problem *problem, const struct rst_workspace *workspace,
                        const struct sync_grid *grid, int64_t n, struct store *store)
{
    const struct rst_solid *s = &problem->solid;
    int64_t failed;
    lay_out(workspace->elements, n, s->n_terms, store);
    rst_normal_levels(grid, s->g_inf, s->eta, s->n_terms, s->g, s->tau, n, closeness_of(problem), store->level, store->memory,
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

/* Two runs, the second with twice the levels: the extrapolated pair and its error. change_before: of the velocity, between the
 * first of them and the one before it; 0 if there was none. */
static void compare(const struct rst_problem *problem, const struct run *before, const struct run *now,
                    double change_before, int64_t updates, struct rst_outcome *outcome)
{
    const double n = (double)now->levels, change = now->velocity - before->velocity;
    const double shear_change = now->shear_velocity - before->shear_velocity;
    const double velocity = now->velocity + change * part_taken_ez;
    const double lost = 1.5 * closeness_of(problem);
    const int slides = !rst_sync_sticks(problem, -velocity);
    *outcome = (struct rst_outcome){
        .velocity = velocity,
        .shear_velocity = slides ? full_slip(problem, velocity) : now->shear_velocity + shear_change * part_taken_ex,
        .error_ez = share_of_change_ez * fmax(fabs(change), fall_at_least * fabs(change_before)) + lost,
        .contact_time = now->contact_time,
        .followed_time = now->contact_time,
        .max_indentation = now->depth,
        .max_contact_radius = sqrt(now->depth),
        .max_normal_force = 15.0 / 8.0 * now->force,
        .spacing = sqrt(now->depth) / n,
        .step = now->contact_time / (2 * n),
        .elements = now->levels,
        .steps = 2 * now->levels,
        .updates = updates};
    if (problem->mode == RST_FRICTIONLESS) return;
    const double usual = usual_error * (1 + thin_slip / (thin_slip + problem->psi)) * pow(fmax(1, problem->chi), 1.5);
    outcome->error_ex = slides ? 2 * problem->chi * outcome->error_ez / problem->psi
                               : share_of_change_ex * fabs(shear_change) / problem->psi + usual / (n * n * n) +
                                     rounding_of_level * n + outcome->error_ez;
}

/* A solid without equilibrium modulus that the sphere sinks into (THEORY 4.9). The tangential velocity ends at nothing too, unless it
 * slips to the end: with 2 chi > 1 it falls faster than the normal one, once the contact sticks. With 2 chi <= 1, rotation
 * being blocked, it falls more slowly and what is left has no closed form. */
static int solve_sunk(const struct rst_problem *problem, struct rst_outcome *outcome, restitute_error *error)
{
    const int slides = !rst_sync_sticks(problem, 0);
    *outcome =
        (struct rst_outcome){.shear_velocity = slides ? full_slip(problem, 0) : 0, .contact_time = INFINITY, .sunk = 1};
    return rst_done(error);
}

/* Panels have two levels, and a run has half as many as the next. */
static int64_t multiple_of(int64_t unit, double count)
{
    return unit * (int64_t)ceil(fmax(1, fmin(count, 2 * (double)most_levels) / (double)unit));
}

/* The counts that the median impact needs for its estimate to meet the tolerance (docs/accuracy.md). The tangential oscillation
 * in stick is faster than the normal one by sqrt(2 chi); counts are made for solid spheres, chi = 7/6. */
static double levels_to_start(const struct rst_problem *problem)
{
    const double normal = 1.5 * pow(problem->tolerance, -0.25);
    if (!rst_sync_sticks(problem, 1)) return fmax(8, normal);
    const double faster = sqrt(fmax(1, problem->chi * 6 / 7));
    return fmax(16, fmax(normal, 5.2 * faster / cbrt(problem->tolerance)));
}

/* Whether the updates ahead are not allowed. The first run is judged by its elements, the next by four times what the last
 * took. Without slip no element is stepped. */
static int too_much(const struct rst_problem *problem, int64_t levels, int64_t spent, int64_t last)
{
    const double stepped = problem->mode == RST_NO_SLIP || !rst_sync_sticks(problem, 1) ? 2 : (double)levels;
    const double first = (double)levels * stepped * (double)(1 + problem->solid.n_terms);
    return (double)spent + (last > 0 ? 4 * (double)last : first) > (double)problem->max_updates;
}

/* No two runs on end have settled. */
static int give_up(const struct rst_problem *problem, int64_t levels, int64_t updates, int64_t last, int told,
                   restitute_error *error)
{
    if (levels <= most_levels && too_much(problem, levels, updates, last))
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "max_updates = %lld: spent before there was a result; raise it", (long long)problem->max_updates);
    if (told && levels > most_levels)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "elements = %lld: the method sync takes up to %lld",
                          (long long)problem->elements, (long long)most_levels);
    if (told)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "elements = %lld: too few for this solid; take more",
                          (long long)problem->elements);
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "iterations do not settle with up to %lld levels; take the method euler for this solid",
                      (long long)most_levels);
}

static int not_reached(const struct rst_problem *problem, const struct rst_outcome *outcome, int64_t last, int told,
                       restitute_error *error)
{
    char limit[64] = "rounding adds up";
    if (told) snprintf(limit, sizeof limit, "elements = %lld", (long long)problem->elements);
    else if (too_much(problem, 2 * outcome->elements, outcome->updates, last))
        snprintf(limit, sizeof limit, "max_updates = %lld", (long long)problem->max_updates);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld levels; %s: no more allowed",
                      problem->tolerance, outcome->error_ez, outcome->error_ex, (long long)outcome->elements, limit);
}

/* Levels of the first run: half or, where that is cheap, a quarter of those that the median impact needs; less if the updates
 * allowed do not suffice. */
static int64_t first_levels(const struct rst_problem *problem)
{
    const double needed = levels_to_start(problem);
    int64_t levels = multiple_of(2, needed / (rst_sync_sticks(problem, 1) ? 2 : 4));
    while (levels > 4 && too_much(problem, 2 * levels, 0, 0))
        levels = multiple_of(2, (double)levels / 2);
    return levels;
}

/* Levels are doubled until runs on end agree: two, or three of those without elements, which begin coarse. With the number of
 * levels given: that one and its half. */
static int solve_refining(const struct rst_problem *problem, struct rst_workspace *workspace,
                          struct rst_outcome *outcome, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    const int told = problem->elements > 0;
    struct run now, before = {0};
    struct sync_grid grid;
    struct store store;
    int64_t levels = told ? multiple_of(4, fmax(least_told, (double)problem->elements)) / 2 : first_levels(problem), updates = 0;
    int settled = 0, found = 0; /* runs on end, and whether there is a result */
    double change = 0;
    rst_choose_grid(s->g_inf, s->eta, s->n_terms, s->g, s->tau, &grid);
    if (grid.turn > strongest_damping)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "rebound slower than 1e-8 of the impact: lost in rounding; the damping is too strong for this "
                          "method, take euler");
    for (int runs = 0; runs < 2 || !told; runs++) {
        if (levels > most_levels || too_much(problem, levels, updates, before.updates)) break;
        if (found && rounding_of_level * (double)levels > problem->tolerance) break;
        if (rst_workspace_elements(workspace, lay_out(NULL, levels, s->n_terms, &store)))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)levels);
        now = (struct run){.levels = levels};
        settled = run_once(problem, workspace, &grid, &now, &store) ? 0 : settled + 1;
        updates += now.updates;
        if (settled > 1) {
            compare(problem, &before, &now, change, updates, outcome);
            change = now.velocity - before.velocity;
            found = 1;
            const int enough = rst_sync_sticks(problem, -now.velocity) || settled > 2;
            if (enough && fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance)
                return rst_done(error);
        }
        before = now;
        levels *= 2;
    }
    if (!found) return give_up(problem, levels, updates, before.updates, told, error);
    if (told && fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance) return rst_done(error);
    return not_reached(problem, outcome, before.updates, told, error);
}

/* Whether the sphere sinks in for good; only a solid without equilibrium modulus lets it. */
static int sinks(const struct rst_problem *problem, const struct rst_workspace *workspace)
{
    const struct rst_solid *s = &problem->solid;
    double depth, time, *stress = workspace->terms + 4 * (workspace->terms_size / rst_term_arrays);
    int64_t sinks = 0;
    if (s->can_sink)
        rst_scout_compression(s->g_inf, s->eta, s->n_terms, s->g, s->tau, s->can_sink, 0.01 * problem->tolerance,
                              stress, &depth, &time, &sinks);
    return sinks != 0;
}

/* Friction so strong that slip at the edge changes e_x by less than the tolerance: by about psi. */
static int solve_strong_friction(const struct rst_problem *problem, struct rst_workspace *workspace,
                                 struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_problem without_slip = *problem;
    without_slip.mode = RST_NO_SLIP;
    without_slip.psi = 1;
    const int status = solve_refining(&without_slip, workspace, outcome, error);
    outcome->shear_velocity *= problem->psi;
    outcome->error_ex += change_by_slip * problem->psi;
    return status;
}

static int sync_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                      struct rst_outcome *outcome, restitute_error *error)
{
    const int sunk = sinks(problem, workspace);
    if (sunk && 2 * problem->chi <= 1 && problem->mode == RST_PARTIAL_SLIP)
        return rst_method_euler.solve(problem, workspace, keep_ledger, outcome, error);
    const int strong = problem->mode == RST_PARTIAL_SLIP && problem->elements <= 0 &&
                       change_by_slip * problem->psi < negligible_part * problem->tolerance;
    const int status = sunk     ? solve_sunk(problem, outcome, error)
                       : strong ? solve_strong_friction(problem, workspace, outcome, error)
                                : solve_refining(problem, workspace, outcome, error);
    if (status < 0 || !keep_ledger) return status;
    const int kept = rst_sync_ledger(problem, workspace, outcome, error);
    return kept ? kept : status;
}

/* For a standard solid and four times the levels of the median impact; 32 terms are room for most polymers before they are merged. */
static int sync_reserve(double tolerance, struct rst_workspace *workspace)
{
    const struct rst_problem usual = {.chi = 7.0 / 6, .psi = 1, .mode = RST_PARTIAL_SLIP, .tolerance = tolerance};
    struct store store;
    const int64_t levels = multiple_of(2, 4 * levels_to_start(&usual));
    return rst_workspace_terms(workspace, 32) ||
           rst_workspace_elements(workspace, lay_out(NULL, levels, 1, &store));
}

const struct restitute_method rst_method_sync = {.name = "sync", .reserve = sync_reserve, .solve = sync_solve, .record = rst_sync_record};
