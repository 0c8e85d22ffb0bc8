/* The method `sync`: the normal problem without elements (sync_normal.c), then the tangential one with elements at the places where
 * the edge of contact is at the levels of time (THEORY 4.3 to 4.6 and 6), refined until its error estimate is met.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync.h"

#include <math.h>
#include <stdio.h>

#include "euler.h"
#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Tangential solutions at n and n/2 levels are compared. They are of third order where kinks fall regularly between nodes; half
 * of what that would take off is best. */
static const double part_taken = 1.0 / 14;

/* The estimate is this part of the change, so that 95 of 100 are not too small (docs/accuracy.md). A change may be small by chance,
 * so it does not stand alone: twice the error of the median impact, 30 max(1, chi)^(3/2) n^-3, is added, and twice that
 * where psi is so small that few nodes slip; and what rounding leaves of the velocity in a level. */
static const double share_of_change = 0.6, usual_error = 30, thin_slip = 0.1, rounding_of_level = 6e-13;

/* Part of the tolerance that the normal problem may take of that of the tangential one, which rests on it. */
static const double normal_part = 0.25;

/* e_x differs from that without slip by at most this times psi (docs/accuracy.md), which is left out where it is a small
 * part of the tolerance. */
static const double change_by_slip = 2, negligible_part = 0.05;

/* The rest of the tolerance is for merged terms. */
static const double acceptance = 0.9;

/* The normal problem is solved with a quarter of its levels too, which are to settle for a solid without strong damping. */
enum { least_normal = 16, least_told = 8 };

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
    store->trace = (struct sync_trace *)take(block, &taken, m * (2 * n + 1) * (sizeof *store->trace / sizeof(double)));
    store->node = (struct sync_node *)take(block, &taken, (n + 1) * (sizeof *store->node / sizeof(double)));
    store->term = (struct sync_term *)take(block, &taken, m * (sizeof *store->term / sizeof(double)));
    store->body = take(block, &taken, capacity * rst_sync_columns);
    store->beta = take(block, &taken, m * capacity);
    store->faded = take(block, &taken, m * capacity);
    return taken;
}

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

/* `ratio` times the levels of the normal problem, and `more` doubles behind them. Nonzero: an error, or a time was not found. */
static int make_dense(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                      int64_t ratio, size_t more, struct store *store, double **room, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    const int64_t n = ratio * normal->levels;
    const size_t taken = lay_out(NULL, n, s->n_terms, store);
    int64_t failed;
    if (rst_workspace_elements(workspace, taken + more))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)n);
    lay_out(workspace->elements, n, s->n_terms, store);
    *room = workspace->elements + taken;
    rst_dense_levels(&normal->grid, s->g_inf, s->eta, s->n_terms, s->g, s->tau, normal->levels, ratio, normal->level,
                     store->level, store->trace, store->node, &failed);
    if (!failed) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "iterations do not settle between %lld levels; take the method euler for this solid",
                      (long long)normal->levels);
}

int rst_sync_repeat(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, int64_t most, size_t a_level, size_t more, struct store *store,
                    int64_t *levels, double **room, restitute_error *error)
{
    struct normal normal;
    int64_t coarse = outcome->normal_levels;
    const int64_t wanted = outcome->elements < most ? outcome->elements : most;
    while (coarse > most && coarse % 4 == 0)
        coarse /= 2;
    for (;; coarse *= 2) {
        const int64_t ratio = wanted / coarse > 0 ? wanted / coarse : 1;
        int status = rst_sync_normal_again(problem, workspace, coarse, &normal, error);
        *levels = ratio * coarse;
        if (status) return status;
        status = RESTITUTE_ERROR_TOO_MUCH_WORK;
        if (normal.levels > 0)
            status = make_dense(problem, workspace, &normal, ratio, a_level * (size_t)(2 * *levels + 1) + more, store,
                                room, error);
        if (status != RESTITUTE_ERROR_TOO_MUCH_WORK || coarse >= outcome->normal_levels) return status;
    }
}

/* Largest of 2n + 1 forces, by the parabola through it and its neighbours. */
static double largest_force(const struct sync_level *level, int64_t n)
{
    int64_t i = 1;
    while (i < 2 * n - 1 && level[i + 1].force > level[i].force)
        i++;
    const double a = level[i].step, b = level[i + 1].step;
    const double rise = (level[i].force - level[i - 1].force) / a, fall = (level[i + 1].force - level[i].force) / b;
    const double bend = (fall - rise) / (a + b);
    const double slope = rise + a * bend; /* at i */
    return bend < 0 ? level[i].force - slope * slope / (4 * bend) : level[i].force;
}

/* A run of the tangential problem. */
struct run {
    int64_t levels, updates;
    double velocity;
};

static void follow_shear(const struct rst_problem *problem, const struct rst_workspace *workspace, int64_t n,
                         const struct store *store, struct run *run)
{
    const struct rst_solid *s = &problem->solid;
    const struct sync_scene scene = rst_sync_scene(problem, n, store);
    struct sync_shear shear;
    rst_follow_shear(&scene, workspace->loop, s->g, s->tau, store->level, store->trace, store->node, store->body,
                     store->beta, store->faded, store->term, &shear);
    *run = (struct run){n, 2 * n + shear.updates * (1 + s->n_terms), shear.velocity};
}

/* What the normal problem says, and the tangential one in slip to the end. */
static void note_normal(const struct rst_problem *problem, const struct normal *normal, struct rst_outcome *outcome)
{
    const double n = (double)normal->levels;
    *outcome = (struct rst_outcome){.velocity = normal->velocity,
                                    .shear_velocity = full_slip(problem, normal->velocity),
                                    .error_ez = normal->error,
                                    .contact_time = normal->contact_time,
                                    .followed_time = normal->contact_time,
                                    .max_indentation = normal->depth,
                                    .max_contact_radius = sqrt(normal->depth),
                                    .max_normal_force = 15.0 / 8.0 * largest_force(normal->level, normal->levels),
                                    .spacing = sqrt(normal->depth) / n,
                                    .step = normal->contact_time / (2 * n),
                                    .elements = normal->levels,
                                    .steps = 2 * normal->levels,
                                    .updates = normal->updates,
                                    .normal_levels = normal->levels};
    if (problem->mode != RST_FRICTIONLESS) outcome->error_ex = 2 * problem->chi * normal->error / problem->psi;
}

/* Two runs, the second with twice the levels: the extrapolated velocity and its error. */
static void note_shear(const struct rst_problem *problem, const struct normal *normal, const struct run *before,
                       const struct run *now, struct rst_outcome *outcome)
{
    const double n = (double)now->levels, change = now->velocity - before->velocity;
    const double usual = usual_error * (1 + thin_slip / (thin_slip + problem->psi)) * pow(fmax(1, problem->chi), 1.5);
    outcome->shear_velocity = now->velocity + change * part_taken;
    outcome->error_ex = share_of_change * fabs(change) / problem->psi + usual / (n * n * n) + rounding_of_level * n +
                        fmax(normal->error, 2 * normal->taken_off);
    outcome->spacing = sqrt(normal->depth) / n;
    outcome->step = outcome->contact_time / (2 * n);
    outcome->elements = now->levels;
    outcome->steps = 2 * now->levels;
    outcome->normal_levels = normal->levels;
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
    return unit * (int64_t)ceil(fmax(1, fmin(count, 2 * (double)rst_sync_most_levels) / (double)unit));
}

/* The counts that the median impact needs for its estimates to meet the tolerance (docs/accuracy.md). The tangential oscillation
 * in stick is faster than the normal one by sqrt(2 chi); counts are made for solid spheres, chi = 7/6. */
static double normal_levels_to_start(double wanted)
{
    return fmax(least_normal, fmax(2 * pow(wanted, -0.22), 1.64 * pow(wanted, -0.25)));
}

double rst_sync_levels_to_start(const struct rst_problem *problem)
{
    return fmax(16, 5.8 * sqrt(fmax(1, problem->chi * 6 / 7)) / cbrt(problem->tolerance));
}

/* Updates of the tangential problem with that many levels, at most: n^2 and a quarter of it for the first two runs, times the trials
 * of a step where chi is large and levels are few; the next has four times what the last took. Without slip no element is
 * stepped. */
static double updates_ahead(const struct rst_problem *problem, int64_t levels, int64_t last)
{
    const double n = (double)levels, stepped = problem->mode == RST_NO_SLIP ? 2 : n;
    const double trials = problem->chi > 0.01 * n * n ? 8 : 1;
    return last > 0 ? 4 * (double)last : 2 * n + 1.25 * trials * n * stepped * (double)(1 + problem->solid.n_terms);
}

static int told_too_few_or_many(const struct rst_problem *problem, restitute_error *error)
{
    if (problem->elements > rst_sync_most_levels)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "elements = %lld: the method sync takes up to %d",
                          (long long)problem->elements, rst_sync_most_levels);
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "elements = %lld: too few for this solid; take more",
                      (long long)problem->elements);
}

/* No result at all. */
static int give_up(const struct rst_problem *problem, double ahead, restitute_error *error)
{
    if (ahead > (double)problem->max_updates)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "max_updates = %lld: spent before there was a result; raise it",
                          (long long)problem->max_updates);
    if (problem->elements > 0) return told_too_few_or_many(problem, error);
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "iterations do not settle with up to %d levels; take the method euler for this solid",
                      rst_sync_most_levels);
}

/* Whether the estimates of a result meet the tolerance; if not, what did not let them. */
static int conclude(const struct rst_problem *problem, const struct rst_outcome *outcome, double ahead,
                    restitute_error *error)
{
    char limit[64] = "rounding adds up";
    if (fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance) return rst_done(error);
    if (problem->elements > 0)
        snprintf(limit, sizeof limit, "elements = %lld", (long long)problem->elements);
    else if (ahead > (double)problem->max_updates)
        snprintf(limit, sizeof limit, "max_updates = %lld", (long long)problem->max_updates);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld levels; %s: no more allowed",
                      problem->tolerance, outcome->error_ez, outcome->error_ex, (long long)outcome->elements, limit);
}

/* The normal problem, to a part of the tolerance if the contact sticks. */
static int solve_normal(const struct rst_problem *problem, struct rst_workspace *workspace, struct normal *normal,
                        restitute_error *error)
{
    const int sticks = rst_sync_sticks(problem, 1);
    const double scale = sticks || problem->mode == RST_FRICTIONLESS ? 1 : fmin(1, problem->psi / (2 * problem->chi));
    const double wanted = (sticks ? normal_part : acceptance) * scale * problem->tolerance;
    if (problem->elements > 0) { /* told: both problems have these levels */
        const int64_t levels = multiple_of(4, fmax(least_told, (double)problem->elements));
        return rst_sync_normal(problem, workspace, levels / (levels % 8 ? 2 : 4), levels, wanted, normal, error);
    }
    const int64_t levels = multiple_of(8, normal_levels_to_start(wanted));
    return rst_sync_normal(problem, workspace, levels / 4, rst_sync_most_levels, wanted, normal, error);
}

/* The first two runs of the tangential problem, at `ratio` times the levels of the normal one and at half of that, from the same
 * levels. */
static int first_runs(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                      int64_t ratio, struct run *half, struct run *now, struct rst_outcome *outcome,
                      restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    const int64_t n = ratio * normal->levels;
    struct store store;
    double *room;
    const int status = make_dense(problem, workspace, normal, ratio, 0, &store, &room, error);
    if (status) return status;
    follow_shear(problem, workspace, n, &store, now);
    outcome->max_normal_force = 15.0 / 8.0 * largest_force(store.level, n);
    rst_thin_levels(s->n_terms, s->g, s->tau, n / 2, store.level, store.trace, store.node);
    follow_shear(problem, workspace, n / 2, &store, half);
    outcome->updates += half->updates + now->updates;
    return RESTITUTE_OK;
}

static int next_run(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                    int64_t ratio, struct run *now, struct rst_outcome *outcome, restitute_error *error)
{
    struct store store;
    double *room;
    const int status = make_dense(problem, workspace, normal, ratio, 0, &store, &room, error);
    if (status) return status;
    follow_shear(problem, workspace, ratio * normal->levels, &store, now);
    outcome->max_normal_force = 15.0 / 8.0 * largest_force(store.level, now->levels);
    outcome->updates += now->updates;
    return RESTITUTE_OK;
}

/* Levels of the tangential problem are doubled until two runs on end agree. `ahead`: updates with a run that was not made. */
static int refine_shear(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                        struct rst_outcome *outcome, double *ahead, restitute_error *error)
{
    const double needed = problem->elements > 0 ? (double)normal->levels : rst_sync_levels_to_start(problem);
    int64_t ratio = (int64_t)ceil(needed / (double)normal->levels);
    struct run now = {0}, before;
    outcome->elements = 0; /* no result yet */
    while (problem->elements <= 0 && ratio > 1 &&
           updates_ahead(problem, ratio * normal->levels, 0) > (double)problem->max_updates)
        ratio /= 2;
    for (;; ratio *= 2) {
        const int64_t n = ratio * normal->levels;
        *ahead = (double)outcome->updates + updates_ahead(problem, n, now.updates);
        if (n > rst_sync_most_levels || *ahead > (double)problem->max_updates) break;
        if (now.levels > 0 && rounding_of_level * (double)n > problem->tolerance) break;
        before = now;
        const int status = now.levels > 0
                               ? next_run(problem, workspace, normal, ratio, &now, outcome, error)
                               : first_runs(problem, workspace, normal, ratio, &before, &now, outcome, error);
        if (status) return status;
        if (!isfinite(now.velocity)) break;
        note_shear(problem, normal, &before, &now, outcome);
        if (problem->elements > 0 || fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance)
            break;
    }
    return RESTITUTE_OK;
}

static int solve_refining(const struct rst_problem *problem, struct rst_workspace *workspace,
                          struct rst_outcome *outcome, restitute_error *error)
{
    struct normal normal;
    double ahead;
    if (problem->elements > rst_sync_most_levels) return told_too_few_or_many(problem, error);
    int status = solve_normal(problem, workspace, &normal, error);
    if (status) return status;
    if (normal.levels == 0) return give_up(problem, (double)normal.ahead, error);
    note_normal(problem, &normal, outcome);
    ahead = (double)normal.ahead;
    if (rst_sync_sticks(problem, -normal.velocity)) {
        status = refine_shear(problem, workspace, &normal, outcome, &ahead, error);
        if (status) return status;
        if (outcome->elements == 0) return give_up(problem, ahead, error);
    }
    return conclude(problem, outcome, ahead, error);
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
    const int64_t levels = multiple_of(2, 4 * rst_sync_levels_to_start(&usual));
    const int64_t normal = multiple_of(2, 4 * normal_levels_to_start(normal_part * tolerance));
    return rst_workspace_terms(workspace, 32) || rst_workspace_levels(workspace, rst_sync_normal_room(normal, 1)) ||
           rst_workspace_elements(workspace, lay_out(NULL, levels, 1, &store));
}

const struct restitute_method rst_method_sync = {.name = "sync",
                                                 .reserve = sync_reserve,
                                                 .records_between_steps = 1,
                                                 .solve = sync_solve,
                                                 .record = rst_sync_record};
