/* The method `sync`: the normal problem without elements (sync_normal.c), then the tangential one with elements at
 * the places where the edge of contact is at the levels of time (THEORY 4.3 to 4.6 and 6), refined until its error
 * estimate is met. SPDX-License-Identifier: BSD-3-Clause */
#include "sync.h"

#include <math.h>
#include <stdio.h>

#include "euler.h"
#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Tangential solutions at n and n/2 levels are compared. Their errors are of third order or a little more, but
 * irregular: this small part of what third order would take off is best on the average. */
static const double part_taken = 1.0 / 25;

/* The estimate is this part of the change, so that 95 of 100 are not too small (docs/accuracy.md). A change may be
 * small by chance, so it does not stand alone: three times the error of the median impact, 8 max(1, chi)^(3/2) n^-3,
 * is added, and several times that where psi is so small that few nodes slip; and what rounding leaves of the
 * velocity in a level. */
static const double share_of_change = 0.25, usual_error = 8, thin_slip = 0.15, least_slip = 0.02,
                    rounding_of_level = 6e-13;

/* Where slip stays behind one front errors are smaller. (Levels that are told are those of the history too, for which
 * elements are stepped.) */
static const double share_behind_front = 0.2, usual_behind_front = 4, thin_behind_front = 0.06;

/* A change may be small by chance: it is not taken for less than that part of the change before it, which is known
 * from the second doubling on, and for impacts with so small a rebound from the first, since their times differ by
 * decades. */
static const double fall_at_least = 1.0 / 8, small_rebound = 0.3;

/* Above that chi slip may turn round within a step, or end everywhere; just above 1/2 gross slip hardly changes its
 * velocity: such errors fall with n^-2, irregularly. */
static const double turning_back = 1.8, all_but_even = 0.02, usual_error_then = 0.15;

/* A graded grid wants more levels than that: with fewer, times between them are not always found. */
static const double graded_more = 1.319;

/* Part of the tolerance that the normal problem may take of that of the tangential one, which rests on it. */
static const double normal_part = 0.25;

/* e_x differs from that without slip by at most this times psi (docs/accuracy.md), which is left out where it is a
 * small part of the tolerance. */
static const double change_by_slip = 2, negligible_part = 0.05;

/* The rest of the tolerance is for merged terms. */
static const double acceptance = 0.9;

static const double least_levels = 16;

/* The normal problem is solved with a quarter of its levels too, which are to settle for a solid without strong
 * damping. */
enum { least_normal = 16, least_told = 8 };

int rst_sync_sticks(const struct rst_problem *problem, double rebound)
{
    if (problem->mode == RST_FRICTIONLESS) return 0;
    return problem->mode == RST_NO_SLIP || problem->psi < rst_critical_psi(problem->chi, rebound);
}

static double full_slip(const struct rst_problem *problem, double velocity)
{
    return problem->mode == RST_FRICTIONLESS ? problem->psi : problem->psi - 2 * problem->chi * (1 - velocity);
}

struct sync_scene rst_sync_scene(const struct rst_problem *problem, const struct store *store)
{
    return (struct sync_scene){.chi = problem->chi,
                               .psi = problem->psi,
                               .g_inf = problem->solid.g_inf,
                               .eta = problem->solid.eta,
                               .n_terms = problem->solid.n_terms,
                               .n = store->levels,
                               .capacity = store->capacity,
                               .no_slip = problem->mode == RST_NO_SLIP};
}

struct rst_outcome rst_sync_with_elements(const struct rst_problem *problem, const struct rst_outcome *outcome)
{
    struct rst_outcome finer = *outcome;
    if (problem->elements <= 0 && 2 * outcome->elements <= rst_sync_most_levels) finer.elements *= 2;
    return finer;
}

double rst_sync_largest_force(const struct sync_level *level, int64_t n)
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
    int one_front; /* slip stayed behind one front: no element was stepped */
    double velocity;
};

/* stepped: with elements from the start; 0: if slip does not stay behind one front. */
static void follow_shear(const struct rst_problem *problem, const struct store *store, int stepped, struct run *run,
                         struct rst_outcome *outcome)
{
    const struct rst_solid *s = &problem->solid;
    struct sync_scene scene = rst_sync_scene(problem, store);
    struct sync_shear shear;
    scene.stepped = stepped;
    rst_follow_shear(&scene, s->g, s->tau, store->level, store->trace, store->node, store->body,
                     store->beta, store->faded, store->term, &shear);
    *run = (struct run){.levels = store->levels,
                        .updates = 2 * store->levels + shear.updates * (1 + s->n_terms),
                        .one_front = shear.updates == 0,
                        .velocity = shear.velocity};
    outcome->updates += run->updates;
}

/* What the normal problem says, and the tangential one in slip to the end. */
static void note_normal(const struct rst_problem *problem, const struct normal *normal, struct rst_outcome *outcome)
{
    const double n = (double)normal->levels;
    *outcome =
        (struct rst_outcome){.velocity = normal->velocity,
                             .shear_velocity = full_slip(problem, normal->velocity),
                             .error_ez = normal->error,
                             .contact_time = normal->contact_time,
                             .followed_time = normal->contact_time,
                             .max_indentation = normal->depth,
                             .max_contact_radius = sqrt(normal->depth),
                             .max_normal_force = 15.0 / 8.0 * rst_sync_largest_force(normal->level, normal->levels),
                             .spacing = sqrt(normal->depth) / n,
                             .step = normal->contact_time / (2 * n),
                             .elements = normal->levels,
                             .steps = 2 * normal->levels,
                             .updates = normal->updates,
                             .normal_levels = normal->levels};
    if (problem->mode != RST_FRICTIONLESS) outcome->error_ex = 2 * problem->chi * normal->error / problem->psi;
}

/* What that adds to the estimate, times n^-2 and, as nothing turns round where damping is strong, at most twice the
 * rebound: three times the errors seen, or more (docs/accuracy.md). */
static double second_order_error(double chi)
{
    if (chi > 0.5 && chi < 0.5 + all_but_even) return 4 * usual_error_then;
    if (chi <= turning_back) return 0;
    return chi > 2 ? 6 * usual_error_then * sqrt(chi / 2) : usual_error_then;
}

/* The error of the second of two runs, without what both have of the normal problem. */
static double error_beside(const struct rst_problem *problem, double change_before, const struct run *before,
                           const struct run *now)
{
    const double n = (double)now->levels, change = now->velocity - before->velocity, chi = fmax(1, problem->chi);
    const int one_front = before->one_front && now->one_front && problem->elements <= 0;
    const double of_run = one_front ? usual_behind_front : usual_error;
    const double thin = 1 + (one_front ? thin_behind_front : thin_slip) / (least_slip + problem->psi);
    return (one_front ? share_behind_front : share_of_change) *
               fmax(fabs(change), fall_at_least * fabs(change_before)) / problem->psi +
           of_run * thin * chi * sqrt(chi) / (n * n * n);
}

/* The velocity, extrapolated from it and that of the run before with half the levels, and its error. change_before:
 * between that and the one before it, 0 if there was none. */
static void note_shear(const struct rst_problem *problem, const struct normal *normal, double change_before,
                       const struct run *before, const struct run *now, struct rst_outcome *outcome)
{
    const double n = (double)now->levels;
    outcome->shear_velocity = now->velocity + (now->velocity - before->velocity) * part_taken;
    outcome->error_ex = error_beside(problem, change_before, before, now) + rounding_of_level * n +
                        fmax(normal->error, 2 * fmax(1, problem->chi) * normal->taken_off) +
                        fmin(1, -2 * normal->velocity) * second_order_error(problem->chi) / (n * n);
    outcome->spacing = sqrt(normal->depth) / n;
    outcome->step = outcome->contact_time / (2 * n);
    outcome->elements = now->levels;
    outcome->steps = 2 * now->levels;
    outcome->normal_levels = normal->levels;
}

/* Where a sphere that sinks in was given up: how deep, when, the largest force until then, about 1 % accurate. */
struct scout {
    int64_t sinks;
    double depth, time, force;
};

/* A rebound slower than that is none. */
static double rest_speed(const struct rst_problem *problem)
{
    return 0.01 * problem->tolerance;
}

/* A solid without equilibrium modulus that the sphere sinks into (THEORY 4.9). The tangential velocity ends at
 * nothing too, unless it slips to the end: with 2 chi > 1 it falls faster than the normal one, once the contact
 * sticks. With 2 chi <= 1, rotation being blocked, it falls more slowly and what is left has no closed form. */
static int solve_sunk(const struct rst_problem *problem, const struct scout *scout, struct rst_outcome *outcome,
                      restitute_error *error)
{
    const int slides = !rst_sync_sticks(problem, 0);
    *outcome = (struct rst_outcome){.shear_velocity = slides ? full_slip(problem, 0) : 0,
                                    .error_ez = rest_speed(problem),
                                    .contact_time = INFINITY,
                                    .followed_time = scout->time,
                                    .max_indentation = scout->depth,
                                    .max_contact_radius = sqrt(scout->depth),
                                    .max_normal_force = 15.0 / 8.0 * scout->force,
                                    .sunk = 1};
    if (problem->mode != RST_FRICTIONLESS) outcome->error_ex = 2 * problem->chi * rest_speed(problem) / problem->psi;
    return rst_done(error);
}

/* Panels have two levels, and a run has half as many as the next. */
static int64_t multiple_of(int64_t unit, double count)
{
    return unit * (int64_t)ceil(fmax(1, fmin(count, 2 * (double)rst_sync_most_levels) / (double)unit));
}

/* The counts that the median impact needs for its estimates to meet the tolerance (docs/accuracy.md). The tangential
 * oscillation in stick is faster than the normal one by sqrt(2 chi); counts are made for solid spheres, chi = 7/6. */
static double normal_levels_to_start(double wanted, double swings)
{
    return fmax(least_normal, fmax(2 * pow(wanted, -0.22), 1.64 * pow(wanted / swings, -0.25)));
}

double rst_sync_levels_to_start(double tolerance, double swings)
{
    return fmax(least_levels, 2.35 * sqrt(swings) / cbrt(tolerance));
}

/* Updates of the tangential problem with that many levels, at most: n^2 and a quarter of it for the first two runs,
 * times the trials of a step where chi is large and levels are few; the next has four times what the last took, or
 * more trials. Without slip no element is stepped. */
static double updates_ahead(const struct rst_problem *problem, int64_t levels, int64_t last)
{
    const double n = (double)levels, stepped = problem->mode == RST_NO_SLIP ? 2 : n;
    const double trials = problem->chi > 0.01 * n * n ? 20 : 1;
    return last > 0 ? (trials > 1 ? 12 : 4) * (double)last
                    : 2 * n + 1.25 * trials * n * stepped * (double)(1 + problem->solid.n_terms);
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
                          "max_updates = %lld: too few for a result, which may take %.2g; raise it",
                          (long long)problem->max_updates, ahead);
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
    if (2 * outcome->elements > rst_sync_most_levels) snprintf(limit, sizeof limit, "%d levels", rst_sync_most_levels);
    if (fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance) return rst_done(error);
    if (problem->elements > 0)
        snprintf(limit, sizeof limit, "elements = %lld", (long long)problem->elements);
    else if (ahead > (double)problem->max_updates)
        snprintf(limit, sizeof limit, "max_updates = %lld", (long long)problem->max_updates);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld levels; %s: no more allowed",
                      problem->tolerance, outcome->error_ez, outcome->error_ex, (long long)outcome->elements, limit);
}

/* The normal problem, to a part of the tolerance if the contact sticks. Between the levels of a graded grid the
 * motion is not known as well as at them: there the tangential problem has no more levels. */
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
    double start = normal_levels_to_start(wanted, rst_sync_stepped_swings(problem));
    if (sticks && rst_sync_is_graded(problem))
        start =
            fmax(start, graded_more * rst_sync_levels_to_start(problem->tolerance, rst_sync_stepped_swings(problem)));
    const int64_t levels = multiple_of(8, start);
    return rst_sync_normal(problem, workspace, levels / 4, rst_sync_most_levels, wanted, normal, error);
}

/* The first runs: with `resolution`, half and, where the rebound is small, a quarter of its levels. If the finest needs
 * elements, all are stepped. If the updates allowed may not be enough for all, it is the half one alone, which tells
 * what the next would take. */
static int first_runs(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                      const struct resolution *resolution, int half_alone, struct run *before, struct run *now,
                      double *change_before, struct rst_outcome *outcome, restitute_error *error)
{
    const int runs = -normal->velocity < small_rebound && resolution->levels % 8 == 0 ? 3 : 2;
    struct store store[rst_sync_first_runs];
    struct run quarter;
    double force;
    const int status = rst_sync_first_levels(problem, workspace, normal, resolution, runs, store, &force, error);
    if (status) return status;
    outcome->max_normal_force = 15.0 / 8.0 * force;
    *change_before = 0;
    if (half_alone) {
        follow_shear(problem, &store[1], 0, now, outcome);
        return RESTITUTE_OK;
    }
    follow_shear(problem, &store[0], 0, now, outcome);
    follow_shear(problem, &store[1], !now->one_front, before, outcome);
    if (runs > 2) {
        follow_shear(problem, &store[2], !now->one_front, &quarter, outcome);
        *change_before = before->velocity - quarter.velocity;
    }
    return RESTITUTE_OK;
}

/* One more run after `now`. */
static int next_run(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                    const struct resolution *resolution, struct run *before, struct run *now, double *change_before,
                    struct rst_outcome *outcome, restitute_error *error)
{
    struct store store;
    double force, *room;
    const int status = rst_sync_levels(problem, workspace, normal, resolution, 0, &store, &force, &room, error);
    if (status) return status;
    outcome->max_normal_force = 15.0 / 8.0 * force;
    *change_before = before->levels > 0 ? now->velocity - before->velocity : 0;
    *before = *now;
    follow_shear(problem, &store, 0, now, outcome);
    return RESTITUTE_OK;
}

/* Twice the levels of the tangential problem: fewer left out, more between those of the normal problem, or more of it
 * where between its levels the motion is not known as well as at them: on a graded grid. normal->levels is 0 if that
 * does not settle. */
static int double_levels(const struct rst_problem *problem, struct rst_workspace *workspace, struct normal *normal,
                         struct resolution *resolution, restitute_error *error)
{
    struct normal finer;
    int status = RESTITUTE_OK;
    if (resolution->levels >= resolution->ratio * normal->levels) {
        if (rst_sync_is_graded(problem)) {
            status = rst_sync_normal_again(problem, workspace, 2 * normal->levels, &finer, error);
            normal->levels = finer.levels;
            normal->level = finer.level;
            normal->taken_off /= 16;
        } else
            resolution->ratio *= 2;
    }
    resolution->levels *= 2;
    return status;
}

static int too_many(const struct rst_problem *problem, int64_t levels)
{
    return updates_ahead(problem, levels, 0) > (double)problem->max_updates;
}

/* Not less than the median impact needs, nor less than half of what the normal problem has if that is more; fewer if
 * the updates allowed do not suffice. */
static struct resolution first_resolution(const struct rst_problem *problem, const struct normal *normal)
{
    const int told = problem->elements > 0;
    const double needed =
        told ? (double)normal->levels : rst_sync_levels_to_start(problem->tolerance, rst_sync_swings(problem));
    struct resolution r = {.ratio = 1, .levels = normal->levels};
    if (!rst_sync_is_graded(problem))
        r.ratio = (int64_t)ceil(fmin(needed, rst_sync_most_levels) / (double)normal->levels);
    if (r.ratio > 1 && r.ratio * normal->levels > rst_sync_most_levels) r.ratio--;
    while (!told && r.ratio > 1 && too_many(problem, r.ratio * normal->levels))
        r.ratio /= 2;
    r.levels = r.ratio * normal->levels;
    while (!told && r.levels % 8 == 0 && ((double)r.levels >= 2 * needed || too_many(problem, r.levels)))
        r.levels /= 2;
    return r;
}

/* Levels of the tangential problem are doubled until two runs on end agree. `ahead`: updates with a run that was not
 * made. */
static int refine_shear(const struct rst_problem *problem, struct rst_workspace *workspace, struct normal *normal,
                        struct rst_outcome *outcome, double *ahead, restitute_error *error)
{
    struct resolution resolution = first_resolution(problem, normal);
    const double allowed = (double)problem->max_updates, enough = acceptance * problem->tolerance;
    struct run now = {0}, before = {0};
    double change_before;
    outcome->elements = 0; /* no result yet */
    for (;;) {
        const int64_t n = resolution.levels;
        const double both = updates_ahead(problem, n, now.updates);
        const int half_alone = now.levels == 0 && (double)outcome->updates + both > allowed;
        *ahead = (double)outcome->updates + (half_alone ? both / 5 : both);
        if (n > rst_sync_most_levels || *ahead > allowed) break;
        if (now.levels > 0 && rounding_of_level * (double)n > problem->tolerance) break;
        int status = now.levels == 0 ? first_runs(problem, workspace, normal, &resolution, half_alone, &before, &now,
                                                  &change_before, outcome, error)
                                     : next_run(problem, workspace, normal, &resolution, &before, &now, &change_before,
                                                outcome, error);
        if (status) return status;
        if (!isfinite(now.velocity)) break;
        if (half_alone) continue;
        note_shear(problem, normal, change_before, &before, &now, outcome);
        /* what the normal problem is off by does not fall any more */
        const int in_vain = fmax(normal->error, 2 * fmax(1, problem->chi) * normal->taken_off) > enough;
        if (problem->elements > 0 || in_vain || fmax(outcome->error_ez, outcome->error_ex) <= enough) break;
        status = double_levels(problem, workspace, normal, &resolution, error);
        if (status || normal->levels == 0) return status;
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
static struct scout look_ahead(const struct rst_problem *problem, const struct rst_workspace *workspace)
{
    const struct rst_solid *s = &problem->solid;
    double *stress = workspace->terms + 4 * (workspace->terms_size / rst_term_arrays);
    struct scout scout = {0};
    if (s->can_sink)
        rst_scout_compression(s->g_inf, s->eta, s->n_terms, s->g, s->tau, s->can_sink, rest_speed(problem), stress,
                              &scout.depth, &scout.time, &scout.force, &scout.sinks);
    return scout;
}

/* Friction so strong that slip at the edge changes e_x by less than the tolerance, by about psi, is no slip; the
 * energies in x are those parts of the whole, psi^2. */
static int solve_strong_friction(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                                 struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_problem without_slip = *problem;
    struct euler_ledger *ledger = &outcome->ledger;
    const double psi = problem->psi;
    without_slip.mode = RST_NO_SLIP;
    without_slip.psi = 1;
    const int status = solve_refining(&without_slip, workspace, outcome, error);
    const int kept =
        status >= 0 && keep_ledger ? rst_sync_ledger(&without_slip, workspace, outcome, error) : RESTITUTE_OK;
    outcome->shear_velocity *= psi;
    outcome->error_ex += change_by_slip * psi;
    ledger->friction_x *= psi * psi;
    ledger->viscous_x *= psi * psi;
    ledger->left_x *= psi * psi;
    return kept ? kept : status;
}

static int sync_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                      struct rst_outcome *outcome, restitute_error *error)
{
    const struct scout scout = look_ahead(problem, workspace);
    if (scout.sinks && 2 * problem->chi <= 1 && problem->mode == RST_PARTIAL_SLIP)
        return rst_method_euler.solve(problem, workspace, keep_ledger, outcome, error);
    if (problem->mode == RST_PARTIAL_SLIP && problem->elements <= 0 && !scout.sinks &&
        change_by_slip * problem->psi < negligible_part * problem->tolerance)
        return solve_strong_friction(problem, workspace, keep_ledger, outcome, error);
    const int status =
        scout.sinks ? solve_sunk(problem, &scout, outcome, error) : solve_refining(problem, workspace, outcome, error);
    if (status < 0 || !keep_ledger) return status;
    const int kept = rst_sync_ledger(problem, workspace, outcome, error);
    return kept ? kept : status;
}

/* For a standard solid and four (normal) and eight times (tangential problem) the levels to start with; 32 terms are
 * room for most polymers before they are merged. */
static int sync_reserve(double tolerance, struct rst_workspace *workspace)
{
    struct rst_problem usual = {.solid = {.g_inf = 1}, .psi = 1, .mode = RST_PARTIAL_SLIP, .tolerance = tolerance};
    int64_t levels = 0;
    for (int i = 0; i < rst_shelves; i++) {
        usual.chi = i ? 7.0 / 4 : 7.0 / 6; /* both ends of the range of solid spheres */
        struct rst_shelf *shelf = rst_sync_shelf(&usual, workspace);
        const double start = normal_levels_to_start(normal_part * tolerance, rst_sync_stepped_swings(&usual));
        const int64_t normal = multiple_of(2, 4 * start);
        levels = multiple_of(2, 8 * rst_sync_levels_to_start(tolerance, rst_sync_swings(&usual)));
        if (rst_shelf_levels(shelf, rst_sync_normal_room(normal, 1)) ||
            rst_shelf_levels(&workspace->spare, rst_sync_normal_room(normal, 1)) ||
            rst_shelf_dense(shelf, rst_sync_first_room(levels / 8 + normal, 1)))
            return 1;
    }
    return rst_workspace_terms(workspace, 32) || rst_workspace_elements(workspace, rst_sync_run_room(levels, 1));
}

const struct restitute_method rst_method_sync = {.name = "sync",
                                                 .reserve = sync_reserve,
                                                 .records_between_steps = 1,
                                                 .solve = sync_solve,
                                                 .record = rst_sync_record};
