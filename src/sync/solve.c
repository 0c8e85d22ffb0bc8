/* The method `sync` (docs/sync.md): the normal motion, then the tangential one on it, each at two resolutions that are compared,
 * and at finer ones until the estimate meets the tolerance.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "motion.h"
#include "record.h"
#include "status.h"
#include "collocation.h"
#include "tuning.h"
#include "walk.h"

/* One resolution. */
struct attempt {
    const struct rst_run *run;
    int halvings, sticks_again; /* sticks_again: slip is not behind one front, there is no shear_velocity */
    double velocity, shear_velocity;
};

static int slips_to_the_end(const struct rst_problem *problem, double rebound)
{
    return problem->mode != RST_NO_SLIP && problem->psi >= rst_critical_psi(problem->chi, rebound);
}

/* (27) */
static double full_slip(const struct rst_problem *problem, double velocity)
{
    return problem->psi - 2 * problem->chi * (1 - velocity);
}

static const struct sync_panel *last_panel(const struct rst_run *run)
{
    return &run->normal.panel[run->normal.n_panels - 1];
}

static int too_hard(restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "sync did not converge for this solid; use the method euler");
}

/* The pair at one resolution. */
static int attempt(struct rst_motion *motion, const struct rst_problem *problem, int halvings, struct attempt *a,
                   struct rst_outcome *outcome, restitute_error *error)
{
    int64_t found;
    *a = (struct attempt){.run = rst_motion_run(motion, halvings), .halvings = halvings};
    if (!a->run) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for panels");
    if (a->run->found == RST_DOES_NOT_CONVERGE) return too_hard(error);
    a->velocity = a->run->found == RST_STOPS ? 0 : last_panel(a->run)->velocity[rst_stages];
    outcome->updates += a->run->normal.n_panels * rst_points * (1 + a->run->normal.n_arms);
    if (problem->mode == RST_FRICTIONLESS || slips_to_the_end(problem, -a->velocity)) {
        a->shear_velocity = problem->mode == RST_FRICTIONLESS ? problem->psi : full_slip(problem, a->velocity);
        return RESTITUTE_OK;
    }
    if (rst_motion_contact(motion, a->run, problem, halvings, &a->shear_velocity, &found))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for pieces");
    outcome->updates += motion->store.n_pieces * rst_points * (1 + a->run->normal.n_arms);
    a->sticks_again = found == RST_STICKS_AGAIN;
    return RESTITUTE_OK;
}

/* The largest value that the polynomials of the force have, sampled. */
static double largest_force(const struct sync_normal *normal)
{
    enum { samples = 64 };
    double largest = 0, weight[rst_points];
    int64_t at = 0;
    for (int64_t p = 0; p < normal->n_panels; p++)
        for (int i = 0; i < rst_points; i++)
            if (normal->panel[p].force[i] > largest) {
                largest = normal->panel[p].force[i];
                at = p;
            }
    for (int64_t p = at > 0 ? at - 1 : 0; p <= at + 1 && p < normal->n_panels; p++)
        for (int i = 0; i <= samples; i++) {
            double force = 0;
            rst_sync_weights_at((double)i / samples, weight);
            for (int j = 0; j < rst_points; j++)
                force += weight[j] * normal->panel[p].force[j];
            largest = fmax(largest, force);
        }
    return largest;
}

/* What both attempts say: the finer one, and what they differ by. */
static void compare(const struct rst_problem *problem, const struct attempt *coarse, const struct attempt *fine,
                    struct rst_outcome *outcome)
{
    const struct sync_normal *n = &fine->run->normal;
    const struct sync_panel *end = last_panel(fine->run), *turn = &n->panel[n->n_compression - 1];
    const double points = (double)(rst_stages * n->n_compression);
    const int stops = fine->run->found == RST_STOPS;
    const double stop_speed = rst_rest_part * problem->tolerance;
    outcome->velocity = fine->velocity;
    outcome->shear_velocity = fine->shear_velocity;
    outcome->error_ez = rst_share_of_change * fabs(fine->velocity - coarse->velocity) + rst_rounding + stops * stop_speed;
    outcome->error_ex =
        problem->mode == RST_FRICTIONLESS
            ? 0
            : (rst_share_of_change * fabs(fine->shear_velocity - coarse->shear_velocity) + rst_rounding) / problem->psi +
                  rst_share_of_pieces * rst_piece_roughness(problem, fine->halvings) +
                  stops * fmax(stop_speed, 2 * problem->chi * rst_slowest / problem->psi);
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

static int meets(const struct rst_problem *problem, const struct rst_outcome *outcome)
{
    return fmax(outcome->error_ez, outcome->error_ex) <= rst_acceptance * problem->tolerance;
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
    return 1 + (int)ceil(fmax(0, log2(rst_coarse_above / problem->tolerance) / rst_stages));
}

/* U' by elements, half as many and all of them, until the two agree: of second order, extrapolated. */
static int walk_refining(struct rst_motion *motion, const struct rst_problem *problem, const struct attempt *fine,
                         struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_walk coarse, now;
    const double error_ez = outcome->error_ez;
    int64_t parts = 1 + rst_first_elements / fine->run->normal.n_compression;
    if (problem->elements > 0) parts = 1 + problem->elements / (2 * fine->run->normal.n_compression);
    if (rst_walk(motion, fine->run, problem, RST_STICKS_SOMETIME, parts, &coarse))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
    for (;; coarse = now) {
        const double work = 2.0 * (double)coarse.n * (double)coarse.n * (1.0 + (double)problem->solid.n_terms);
        outcome->updates += (int64_t)work;
        parts *= 2;
        if (rst_walk(motion, fine->run, problem, RST_STICKS_SOMETIME, parts, &now))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
        const double change = now.velocity - coarse.velocity;
        outcome->shear_velocity = now.velocity + change / 3;
        outcome->error_ex = (rst_share_of_elements * fabs(change) + rst_rounding * (double)now.n) / problem->psi + error_ez;
        outcome->elements = now.n;
        outcome->steps = 2 * now.n;
        outcome->step = outcome->followed_time / (double)outcome->steps;
        outcome->spacing = outcome->max_contact_radius / (double)now.n;
        outcome->walked = parts;
        if (problem->elements > 0 || meets(problem, outcome) || 2 * now.n > rst_most_elements ||
            (double)outcome->updates + 4 * work > (double)problem->max_updates)
            return RESTITUTE_OK;
    }
}

static int conclude(const struct rst_problem *problem, const struct rst_outcome *outcome, restitute_error *error)
{
    if (meets(problem, outcome)) return rst_done(error);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld elements", problem->tolerance,
                      outcome->error_ez, outcome->error_ex, (long long)outcome->elements);
}

/* The pair of two attempts on end: a resolution that is too coarse to converge is passed over. */
static int attempt_twice(struct rst_motion *motion, const struct rst_problem *problem, int *halvings,
                         struct attempt *coarse, struct attempt *fine, struct rst_outcome *outcome,
                         restitute_error *error)
{
    int status = attempt(motion, problem, *halvings, coarse, outcome, error);
    while (status == RESTITUTE_ERROR_TOO_MUCH_WORK && *halvings < rst_most_halvings - 1)
        status = attempt(motion, problem, ++*halvings, coarse, outcome, error);
    if (!status) status = attempt(motion, problem, ++*halvings, fine, outcome, error);
    return status;
}

static int solve_refining(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                          struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_motion *motion = rst_motion_of(workspace);
    struct attempt coarse, fine;
    if (!motion || rst_motion_begin(motion, problem, workspace->keeps_motion))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the motion");
    *outcome = (struct rst_outcome){0};
    int halvings = first_halvings(problem);
    int status = attempt_twice(motion, problem, &halvings, &coarse, &fine, outcome, error);
    while (!status) {
        compare(problem, &coarse, &fine, outcome);
        if (fine.sticks_again || coarse.sticks_again) {
            if (outcome->sunk) return too_hard(error); /* the walk goes over a rebound */
            status = walk_refining(motion, problem, &fine, outcome, error);
            break;
        }
        if (problem->elements > 0 || halvings == rst_most_halvings || meets(problem, outcome)) break;
        coarse = fine;
        status = attempt(motion, problem, ++halvings, &fine, outcome, error);
    }
    if (status) return status;
    outcome->max_normal_force = 15.0 / 8.0 * largest_force(&fine.run->normal);
    if (keep_ledger) status = rst_motion_ledger(motion, problem, fine.run, outcome, error);
    return status ? status : conclude(problem, outcome, error);
}

/* Friction so strong that slip at the edge changes e_x by less than the tolerance, by about 0.4 psi, is no slip; the
 * energies in x are those parts of the whole, psi^2. */
static int sync_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                      struct rst_outcome *outcome, restitute_error *error)
{
    const double psi = problem->psi;
    const int strong = problem->mode == RST_PARTIAL_SLIP && problem->elements <= 0 &&
                       rst_change_by_slip * psi < rst_negligible_part * problem->tolerance;
    struct rst_problem without_slip = *problem;
    if (!strong) return solve_refining(problem, workspace, keep_ledger, outcome, error);
    without_slip.mode = RST_NO_SLIP;
    without_slip.psi = 1;
    const int status = solve_refining(&without_slip, workspace, keep_ledger, outcome, error);
    outcome->shear_velocity *= psi;
    outcome->error_ex += rst_change_by_slip * psi;
    outcome->ledger.friction_x *= psi * psi;
    outcome->ledger.viscous_x *= psi * psi;
    outcome->ledger.left_x *= psi * psi;
    return status;
}

const struct restitute_method rst_method_collocation = {
    .name = "sync", .records_between_steps = 1, .solve = sync_solve, .record = rst_motion_record};
