/* The method `sync` (docs/sync.md): the normal motion, then the tangential one on it, each at two
 * resolutions that are compared, and at finer ones until the estimate meets the tolerance.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <fenv.h>
#include <math.h>

#include "base/gross_slip.h"
#include "sync/motion.h"
#include "sync/record.h"
#include "sync/sync.h"
#include "sync/verdict.h"
#include "sync/walk.h"

/* Work is counted in updates of an element in a walk. A point of a panel or piece takes as long as
 * so many: 60 to 190 ns, and 1.2 to 2.7 ns (measured, x86-64). */
static const int64_t updates_of_point = 100;

/* One resolution. */
struct attempt {
    const struct rst_run *run;
    int halvings, fails;
    int sticks_again; /* slip is not behind one front, there is no shear_velocity */
    double velocity, shear_velocity;
};

static int did_not_converge(const struct rst_problem *problem, restitute_error *error)
{
    if (problem->elements > 0)
        return rst_report(
            error, RESTITUTE_ERROR_CONVERGENCE,
            "elements = %lld: sync did not converge for this solid; use the method euler or another number",
            (long long)problem->elements);
    return rst_report(error, RESTITUTE_ERROR_CONVERGENCE, "sync did not converge for this solid; use the method euler");
}

static int attempt_contact(struct rst_motion *motion, const struct rst_problem *problem, struct attempt *a,
                           struct rst_outcome *outcome, restitute_error *error)
{
    const int64_t cost = updates_of_point * rst_points * (1 + a->run->normal.n_arms); /* of a panel or piece */
    int64_t found;
    if (rst_motion_contact(motion, a->run, problem, a->halvings, (problem->max_updates - outcome->updates) / cost,
                           &a->shear_velocity, &found))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for pieces");
    outcome->updates += motion->store.n_pieces * cost;
    if (found == RST_LACKS_PIECES) return rst_sync_too_much_work(problem, error);
    a->sticks_again = found == RST_STICKS_AGAIN;
    return RESTITUTE_OK;
}

/* The pair at one resolution, if max_work allows it. */
static int attempt(struct rst_motion *motion, const struct rst_problem *problem, int halvings, struct attempt *a,
                   struct rst_outcome *outcome, restitute_error *error)
{
    const int64_t cost = updates_of_point * rst_points * (1 + motion->n_arms);
    const int64_t most = (problem->max_updates - outcome->updates) / cost;
    *a = (struct attempt){.run = rst_motion_run(motion, halvings, most), .halvings = halvings};
    if (!a->run) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for panels");
    if (a->run->found == RST_LACKS_ROOM || a->run->normal.n_panels > most) return rst_sync_too_much_work(problem, error);
    outcome->updates += a->run->normal.n_panels * cost;
    a->fails = a->run->found == RST_DOES_NOT_CONVERGE;
    if (a->fails) return RESTITUTE_OK;
    a->velocity = a->run->found == RST_STOPS ? 0 : rst_last_panel(a->run)->velocity[rst_stages];
    if (!rst_never_sticks(problem, -a->velocity)) return attempt_contact(motion, problem, a, outcome, error);
    a->shear_velocity = rst_slipping_velocity(problem, a->velocity);
    return RESTITUTE_OK;
}

/* The largest value that the polynomials of the force have, sampled. */
static double largest_force(const struct sync_normal *normal)
{
    double largest = 0, weight[rst_points];
    int64_t first = 0, last = 0;
    for (int64_t p = 0; p < normal->n_panels; p++)
        for (int i = 0; i < rst_points; i++)
            if (normal->panel[p].force[i] > largest) {
                largest = normal->panel[p].force[i];
                first = p;
                last = i < rst_stages ? p : p + 1; /* at the end of a panel: maybe beyond it */
            }
    for (int64_t p = first; p <= last && p < normal->n_panels; p++)
        for (int i = 0; i <= rst_force_samples; i++) {
            rst_sync_weights_at((double)i / rst_force_samples, weight);
            largest = fmax(largest, rst_value_of(weight, normal->panel[p].force));
        }
    return largest;
}

/* What both attempts say: the finer one, and what they differ by. */
static void compare(const struct rst_problem *problem, const struct attempt *coarse, const struct attempt *fine,
                    struct rst_outcome *outcome)
{
    const struct sync_normal *n = &fine->run->normal;
    const struct sync_panel *end = rst_last_panel(fine->run), *turn = &n->panel[n->n_compression - 1];
    const double points = (double)(rst_stages * n->n_compression);
    const int stops = fine->run->found == RST_STOPS;
    const double left = stops ? 2 * n->residual_speed : 0; /* its velocity changes by no more */
    const double least = rst_rounding + (problem->elements > 0 ? 0 : rst_least_estimate * problem->tolerance);
    outcome->velocity = fine->velocity;
    outcome->shear_velocity = fine->shear_velocity;
    outcome->error_ez = rst_share_of_change * fabs(fine->velocity - coarse->velocity) + least + left;
    outcome->error_ex =
        problem->mode == RST_FRICTIONLESS
            ? 0
            : (rst_share_of_change * fabs(fine->shear_velocity - coarse->shear_velocity) + rst_rounding) /
                      problem->shear_speed +
                  rst_piece_part * rst_piece_roughness(problem, fine->halvings) + least +
                  2 * problem->chi * left / problem->shear_speed; /* |S| <= F bounds the change of U' */
    if (stops && problem->mode == RST_NO_SLIP) { /* it sticks until it is at rest */
        outcome->error_ex += fabs(fine->shear_velocity) / problem->shear_speed;
        outcome->shear_velocity = 0;
    }
    outcome->contact_time = stops ? INFINITY : end->time[rst_stages];
    outcome->followed_time = end->time[rst_stages];
    outcome->max_indentation = turn->depth[rst_stages];
    outcome->max_contact_radius = sqrt(turn->depth[rst_stages]);
    outcome->spacing = outcome->max_contact_radius / points;
    outcome->elements = (int64_t)points;
    outcome->steps = rst_stages * n->n_panels;
    outcome->step = outcome->followed_time / (double)outcome->steps;
    outcome->sunk = stops;
    outcome->halvings = fine->halvings;
}

/* Panels of the first run, and of the last one. */
static int first_halvings(const struct rst_problem *problem)
{
    if (problem->elements > 0) {
        int halvings = 1;
        while (halvings < rst_most_halvings - 1 && (rst_stages << (halvings + 2)) <= problem->elements)
            halvings++;
        return halvings;
    }
    return 1 + (problem->chi > rst_usual_chi) +
           (int)ceil(fmax(0, log2(rst_coarse_above / problem->tolerance) / rst_stages));
}

/* What is said of a result; `spent`: a limit kept it from being refined. */
static int conclude(const struct rst_problem *problem, int spent, const struct rst_outcome *outcome,
                    restitute_error *error)
{
    if (rst_meets(problem, outcome)) return rst_done(error);
    if (spent)
        return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                          "tolerance = %g: estimated errors %.2g (ez), %.2g (ex); a finer run exceeds %s",
                          problem->asked, outcome->error_ez, outcome->error_ex, rst_spent(problem, outcome->late).text);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld elements", problem->asked,
                      outcome->error_ez, outcome->error_ex, (long long)outcome->elements);
}

/* Where rounding makes finer runs worse, the best pair is the result. Its pieces are made again,
 * for the history. */
static int return_best(struct rst_motion *motion, const struct rst_problem *problem, const struct rst_outcome *best,
                       struct attempt *fine, struct rst_outcome *outcome, restitute_error *error)
{
    if (!(rst_larger_error(best) < rst_larger_error(outcome))) return RESTITUTE_OK;
    const int64_t updates = outcome->updates;
    *outcome = *best;
    outcome->updates = updates;
    const int status = attempt(motion, problem, best->halvings, fine, outcome, error);
    return status == RESTITUTE_ERROR_TOO_MUCH_WORK ? RESTITUTE_TOLERANCE_NOT_REACHED : status;
}

/* Attempts until two on end agree; a resolution that is too coarse to converge is passed over. Slip
 * may stick again because panels are too coarse for it: finer ones cost less than elements. The
 * status may be TOLERANCE_NOT_REACHED if a limit is spent and there is a result. */
static int refine_from(struct rst_motion *motion, const struct rst_problem *problem, int first, struct attempt *fine,
                       struct rst_outcome *outcome, restitute_error *error)
{
    struct attempt now, coarse;
    struct rst_outcome best = {.error_ez = INFINITY};
    int known = 0, walks = 0, tried = 0;
    for (int halvings = first; halvings <= rst_most_halvings; halvings++) {
        const int late = rst_time_left(problem) <= 0;
        const int status =
            late ? rst_sync_too_much_work(problem, error) : attempt(motion, problem, halvings, &now, outcome, error);
        if (late && walks) break;
        outcome->late = rst_time_left(problem) <= 0;
        if (status == RESTITUTE_ERROR_TOO_MUCH_WORK && known >= 2 && !walks) return RESTITUTE_TOLERANCE_NOT_REACHED;
        if (status) return status;
        if (now.fails) continue;
        coarse = *fine;
        *fine = now;
        if (++known < 2) continue;
        compare(problem, &coarse, fine, outcome);
        walks = fine->sticks_again || coarse.sticks_again;
        if (walks && (problem->elements > 0 || (++tried > rst_trials_of_front && fine->sticks_again))) break;
        if (!walks && (problem->elements > 0 || rst_meets(problem, outcome))) return RESTITUTE_OK;
        if (!walks && rst_larger_error(outcome) < rst_larger_error(&best)) best = *outcome;
    }
    if (known < 2) return did_not_converge(problem, error);
    if (walks && problem->mode == RST_PARTIAL_SLIP && problem->elements <= 0 &&
        rst_rounding * rst_first_elements / problem->psi >
            rst_change_by_slip * problem->psi) { /* worse than no slip: left out */
        outcome->error_ex = INFINITY;
        return RESTITUTE_TOLERANCE_NOT_REACHED;
    }
    if (walks) return rst_walk_refining(motion, problem, fine->halvings, outcome, error);
    return return_best(motion, problem, &best, fine, outcome, error);
}

/* Where fine runs are lost in rounding, or cost too much, coarser ones may not: their estimate says
 * what they are worth. Where the number of points is given, the finest of them that works. */
static int refine(struct rst_motion *motion, const struct rst_problem *problem, int first, struct attempt *fine,
                  struct rst_outcome *outcome, restitute_error *error)
{
    int status = refine_from(motion, problem, first, fine, outcome, error);
    while (first > 1 && (status == RESTITUTE_ERROR_CONVERGENCE || status == RESTITUTE_ERROR_TOO_MUCH_WORK)) {
        first = problem->elements > 0 ? first - 1 : 1;
        status = refine_from(motion, problem, first, fine, outcome, error);
    }
    return status;
}

static int solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                 struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_motion *motion = rst_motion_of(workspace);
    struct attempt fine = {0};
    const int first = first_halvings(problem);
    if (!motion || rst_motion_begin(motion, problem, first, workspace->keeps_motion))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the motion");
    *outcome = (struct rst_outcome){0};
    int status = refine(motion, problem, first, &fine, outcome, error);
    const int spent = status == RESTITUTE_TOLERANCE_NOT_REACHED;
    if (status < 0) return status;
    outcome->max_normal_force = largest_force(&fine.run->normal);
    status = conclude(problem, spent, outcome, error);
    const int kept = keep_ledger ? rst_motion_ledger(motion, problem, fine.run, outcome, error) : RESTITUTE_OK;
    return kept ? kept : status;
}

/* Room for three runs on a standard solid. */
static int reserve(double tolerance, struct rst_workspace *workspace)
{
    const struct rst_problem usual = {.tolerance = tolerance};
    const int first = first_halvings(&usual);
    struct rst_motion *motion = rst_motion_of(workspace);
    return !motion || rst_workspace_terms(workspace, 1) || rst_motion_reserve(motion, first, first + 2, 2);
}

/* Divergent iterates of Newton's method are discarded. They must not trap in a host. */
static int sync_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                      struct rst_outcome *outcome, restitute_error *error)
{
    fenv_t callers;
    feholdexcept(&callers);
    const int status = solve(problem, workspace, keep_ledger, outcome, error);
    fesetenv(&callers);
    return status;
}

static int sync_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                       const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error)
{
    fenv_t callers;
    feholdexcept(&callers);
    const int status = rst_motion_record(problem, workspace, outcome, history, error);
    fesetenv(&callers);
    return status;
}

const struct restitute_method rst_method_sync = {.struct_size = sizeof rst_method_sync,
                                                 .number = RST_METHOD_NUMBER,
                                                 .name = "sync",
                                                 .time_limit = 1,
                                                 .updates_per_second = 1e9, /* see updates_of_point */
                                                 .reserve = reserve,
                                                 .records_between_steps = 1,
                                                 .cheap_without_slip = 1,
                                                 .solve = sync_solve,
                                                 .record = sync_record};
