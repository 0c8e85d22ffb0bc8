/* The method `cvode`: the normal motion at two tolerances, then twice as many elements until the
 * pairs agree.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/gross_slip.h"
#include "base/report.h"
#include "cvode/solve.h"

/* Error of a step of CVODE as a share of the tolerance. The errors of some thousand steps, and of
 * the kinks in them, add up to the second value times as much (docs/cvode.md). */
static const double closeness_part = 2e-3, adding_up = 50;

/* The normal motion is also computed with this much larger errors. The second value is the share of
 * the change that estimates the error. */
static const double looser = 10, share_of_change_ez = 0.3;

/* Rounding in CVODE's predictions. */
static const double closest = 1e-13;

/* The trapezoidal rule is of second order: a third of the change from half as many elements is
 * taken off. The estimate follows from the change of this result from half as many elements. A
 * change may be small by chance, so the error of the median impact, 0.2 max(1, chi)^(3/2) n^(-5/2),
 * is added. */
static const double part_taken_ex = 1.0 / 3, share_of_change_ex = 0.5, usual_error = 0.2;

/* The rest of the tolerance is for what the solver leaves out. */
static const double acceptance = 0.9;

static const int64_t most_elements = 16384;

/* Limits of the events an element and of steps. More mean a failure. */
static const int64_t most_events = 64, most_steps = 1000000;

/* Elements that the median impact needs for 1e-5, and how their number falls with the tolerance;
 * those of a log where the pair needs none. */
static const double usual_elements = 96, usual_tolerance = 1e-5, usual_power = 0.4;
static const int64_t elements_of_log = 64;

/* Above it no fewer elements are taken. A quarter of fewer is too coarse for narrow slip at the
 * edge (psi << 1) of a sphere that vibrates (chi > 4) or is damped: three runs agreed by chance. */
static const double loosest = 2e-4;

/* If the solid relaxes or damps more often than the first value in a compression, backward
 * differentiation is used. Above the second value Adams' formulas are refused: their steps would be
 * at the stability limit, where the error estimate does not hold. */
static const double stiff = 30, too_stiff = 300;

/* The fastest relaxation in a compression. */
static double stiffness_of(const struct rst_problem *problem, double depth)
{
    const struct rst_solid *s = &problem->solid;
    double fastest = 2 * rst_mass_factor() * fmax(1, problem->chi) * s->eta * sqrt(depth);
    for (int64_t k = 0; k < s->n_terms; k++)
        fastest = fmax(fastest, 1 / s->tau[k]);
    return fastest * depth;
}

/* How much faster than a rolling solid sphere on its contact the sphere vibrates in the tangential
 * direction. Errors of time and of the normal velocity count for as much more in e_x. */
static double vibration_of(const struct rst_problem *problem)
{
    return sqrt(fmax(1, problem->chi * 6 / 7));
}

static enum integrator_family family_of(const struct rst_problem *problem, double depth)
{
    return stiffness_of(problem, depth) > stiff ? INTEGRATOR_BDF : INTEGRATOR_ADAMS;
}

struct run_setup rst_cvode_setup(const struct rst_problem *problem)
{
    const enum integrator_family *family = rst_cvode_method_of(problem)->family;
    const struct rst_solid *solid = &problem->solid;
    const double depth = rst_likely_depth(solid->g_inf, solid->eta, solid->n_terms, solid->g, solid->tau);
    return (struct run_setup){.problem = problem,
                              .closeness = fmax(closest, closeness_part * problem->tolerance / vibration_of(problem)),
                              .depth = depth,
                              .rebound = NAN,
                              .rest_speed = 0.01 * problem->tolerance / vibration_of(problem),
                              .family = family ? *family : family_of(problem, depth),
                              .budget = problem->max_updates,
                              .until = problem->deadline,
                              .most_events = most_events,
                              .most_steps = most_steps};
}

static void add_work(struct cvode_memory *memory, const struct run *run)
{
    memory->work.steps += run->work.steps;
    memory->work.restarts += run->work.restarts;
    memory->work.rates += run->work.rates;
    memory->work.events += run->event_count;
    memory->updates += run->updates;
}

/* The normal motion alone, once with `looser` times the error and once with the wanted error. Its
 * trace stays in memory. */
static int solve_normal(struct run_setup *setup, struct cvode_memory *memory, struct rst_outcome *outcome,
                        restitute_error *error)
{
    const double close = setup->closeness;
    double velocity = 0;
    for (int i = 0; i < 2; i++) {
        struct run run = {0};
        setup->closeness = i == 0 ? fmin(looser * close, 1e-3) : close;
        setup->budget = setup->problem->max_updates - memory->updates;
        const int status = rst_run_follow(&run, setup, &memory->trace, NULL);
        rst_run_release(&run);
        add_work(memory, &run);
        if (status) return rst_report(error, status, "%s", run.text);
        *outcome = (struct rst_outcome){
            .velocity = run.sunk ? 0 : run.end_velocity,
            .shear_velocity = run.end_shear_velocity,
            .error_ez = run.sunk ? 0 : share_of_change_ez * fabs(run.end_velocity - velocity) + adding_up * close,
            .contact_time = run.sunk ? INFINITY : run.time,
            .followed_time = run.time,
            .max_indentation = run.sunk ? run.depth : run.max_depth,
            .max_normal_force = run.max_force,
            .steps = run.work.steps,
            .step = run.time / (double)run.work.steps,
            .sunk = run.sunk};
        outcome->max_contact_radius = sqrt(outcome->max_indentation);
        velocity = run.end_velocity;
    }
    return RESTITUTE_OK;
}

/* One run with elements. */
static int solve_elements(const struct run_setup *setup, int64_t n, struct cvode_memory *memory, struct event_log *log,
                          struct run *run, restitute_error *error)
{
    struct run_setup with_elements = *setup;
    with_elements.n_nodes = n;
    *run = (struct run){0};
    const double begin = setup->problem->clock ? setup->problem->clock() : 0;
    const int status = rst_run_follow(run, &with_elements, &memory->trace, log);
    if (setup->problem->clock) run->seconds = setup->problem->clock() - begin;
    rst_run_release(run);
    add_work(memory, run);
    return status ? rst_report(error, status, "%s", run->text) : RESTITUTE_OK;
}

/* What a tolerance usually needs, but not less than the loosest. */
static int64_t elements_for(const struct rst_problem *problem, double tolerance)
{
    const double share = pow(usual_tolerance / fmin(loosest, tolerance), usual_power);
    return (int64_t)fmin((double)most_elements, 4 * ceil(0.25 * usual_elements * vibration_of(problem) * share));
}

/* U' at the end, extrapolated from two runs, the second with twice the elements. */
static double extrapolated(const struct run *coarse, const struct run *fine)
{
    return fine->end_shear_velocity + part_taken_ex * (fine->end_shear_velocity - coarse->end_shear_velocity);
}

/* The pair and its error from three runs, each with twice the elements of the one before. */
static void compare(const struct run_setup *setup, const struct run *run, int64_t n, struct rst_outcome *outcome)
{
    const struct run *fine = &run[2];
    const double best = extrapolated(&run[1], fine), changed = fabs(best - extrapolated(&run[0], &run[1]));
    const double usual = usual_error * pow(fmax(1, setup->problem->chi), 1.5) * pow((double)n, -2.5);
    /* fewer than are ever chosen may agree by chance: their error is of second order at least */
    const double coarse = fmax(1, (double)elements_for(setup->problem, loosest) / (double)n);
    outcome->shear_velocity = best;
    outcome->error_ex = coarse * coarse * share_of_change_ex * changed / setup->problem->shear_speed + usual +
                        vibration_of(setup->problem) * outcome->error_ez;
    outcome->elements = n;
    outcome->spacing = outcome->max_contact_radius / (double)n;
    outcome->steps = fine->work.steps;
    outcome->step = fine->time / (double)fine->work.steps;
}

/* Return the present pair, with the reason why there is no better one. */
static int too_coarse(const struct rst_problem *problem, const struct rst_outcome *outcome, const char *obstacle,
                      restitute_error *error)
{
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld elements; %s", problem->asked,
                      outcome->error_ez, outcome->error_ex, (long long)outcome->elements, obstacle);
}

/* What ends a finer run leaves the coarser ones as they are. */
static int is_obstacle(int status)
{
    return status == RESTITUTE_ERROR_TOO_MUCH_WORK || status == RESTITUTE_ERROR_CONVERGENCE;
}

/* Three runs, the last with n of the `wanted` elements, each with twice as many as the one
 * before. */
struct ladder {
    struct run run[3];
    int64_t wanted, n;
    int halvings; /* of wanted, that lead to n */
};

static int64_t halved(int64_t n, int times)
{
    return (n + ((int64_t)1 << times) - 1) >> times;
}

/* The first run has a quarter of the elements, or as many as an eighth of the remaining work
 * allows. The next run takes four times as much, so trials that are too expensive cost little. */
static int begin_ladder(struct run_setup *setup, struct cvode_memory *memory, struct ladder *ladder,
                        restitute_error *error)
{
    int status;
    for (ladder->halvings = 2;; ladder->halvings++) {
        ladder->n = halved(ladder->wanted, ladder->halvings);
        setup->budget = (setup->problem->max_updates - memory->updates) / 8;
        if (setup->problem->clock) setup->until = setup->problem->deadline - rst_time_left(setup->problem) * 7 / 8;
        status = solve_elements(setup, ladder->n, memory, NULL, &ladder->run[2], error);
        if (status != RESTITUTE_ERROR_TOO_MUCH_WORK || ladder->n == 1) return status;
    }
}

/* The next run takes four times as much as the last: twice the elements have twice the events, each
 * searched for over all elements. As much again is left for coarser runs. */
static int can_climb(const struct run_setup *setup, const struct cvode_memory *memory, const struct ladder *ladder)
{
    if (rst_time_left(setup->problem) < 5 * ladder->run[2].seconds) return 0;
    return memory->updates + 5 * ladder->run[2].updates <= setup->problem->max_updates;
}

/* One more run with twice the elements. It leaves enough work for runs with half and a quarter of
 * the present number. */
static int climb(struct run_setup *setup, struct cvode_memory *memory, struct ladder *ladder, restitute_error *error)
{
    struct run next;
    const int64_t n = ladder->halvings > 0 ? halved(ladder->wanted, ladder->halvings - 1) : 2 * ladder->n;
    setup->budget = setup->problem->max_updates - memory->updates - ladder->run[2].updates;
    if (setup->problem->clock) setup->until = setup->problem->deadline - ladder->run[2].seconds;
    const int status = solve_elements(setup, n, memory, NULL, &next, error);
    if (status) return status;
    ladder->run[0] = ladder->run[1];
    ladder->run[1] = ladder->run[2];
    ladder->run[2] = next;
    ladder->n = n;
    if (ladder->halvings > 0) ladder->halvings--;
    return RESTITUTE_OK;
}

/* Runs with a quarter, half and all of the elements. If that costs too much, coarser runs complete
 * the three. */
static int start_refining(struct run_setup *setup, struct cvode_memory *memory, struct ladder *ladder,
                          restitute_error *error)
{
    int runs = 1, status = begin_ladder(setup, memory, ladder, error);
    if (status) return status;
    while (runs < 3 && !status && can_climb(setup, memory, ladder)) {
        status = climb(setup, memory, ladder, error);
        if (status && !is_obstacle(status)) return status;
        runs += !status;
    }
    for (; runs < 3; runs++) { /* run[2], and run[1] if there are two, have been done */
        const int place = 2 - runs;
        setup->budget = setup->problem->max_updates - memory->updates;
        setup->until = INFINITY; /* each takes a quarter of the one before */
        status = solve_elements(setup, halved(ladder->wanted, ladder->halvings + runs), memory, NULL,
                                &ladder->run[place], error);
        if (status) return status;
    }
    return RESTITUTE_OK;
}

/* Double the elements until the pair converges. If that is impossible, return the present pair with
 * a remark. */
static int refine(const struct rst_problem *problem, struct run_setup *setup, struct cvode_memory *memory,
                  struct rst_outcome *outcome, restitute_error *error)
{
    const int64_t given = problem->elements;
    struct ladder ladder = {.wanted = given > 0 ? given : elements_for(problem, problem->tolerance)};
    char obstacle[256] = "elements: no more allowed";
    if (ladder.wanted > most_elements)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "elements = %lld: the method cvode takes 4 to %lld",
                          (long long)ladder.wanted, (long long)most_elements);
    setup->radius = outcome->max_contact_radius;
    int status = start_refining(setup, memory, &ladder, error);
    while (!status) {
        compare(setup, ladder.run, ladder.n, outcome);
        outcome->updates = memory->updates;
        if (fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance) return rst_done(error);
        if (ladder.halvings == 0 && (problem->elements > 0 || 2 * ladder.n > most_elements))
            return too_coarse(problem, outcome, obstacle, error);
        if (!can_climb(setup, memory, &ladder)) {
            const int late = rst_time_left(setup->problem) < 5 * ladder.run[2].seconds;
            snprintf(obstacle, sizeof obstacle, "%s: no more allowed", rst_spent(problem, late).text);
            return too_coarse(problem, outcome, obstacle, error);
        }
        restitute_error failure;
        status = climb(setup, memory, &ladder, &failure);
        outcome->updates = memory->updates;
        if (is_obstacle(status)) return too_coarse(problem, outcome, failure.message, error);
        if (status && error) *error = failure;
    }
    return status;
}

/* Closed forms: no friction, slip to the end (27). */
static int without_elements(const struct rst_problem *problem, const struct rst_outcome *normal,
                            struct rst_outcome *outcome, restitute_error *error)
{
    *outcome = *normal;
    if (problem->mode != RST_FRICTIONLESS) {
        outcome->shear_velocity = rst_slipping_velocity(problem, normal->velocity);
        outcome->error_ex = 2 * problem->chi * outcome->error_ez / problem->shear_speed;
    }
    if (fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance) return rst_done(error);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED, "tolerance = %g: estimated errors %.2g (ez), %.2g (ex)",
                      problem->asked, outcome->error_ez, outcome->error_ex);
}

/* The sphere has stopped (docs/theory.md, section 6). With 2 chi > 1 sliding then stops, too. With
 * 2 chi <= 1 (blocked rotation) it creeps or slides ever more slowly, and there is no closed
 * form. */
static int stay(const struct rst_problem *problem, const struct run_setup *setup, struct rst_outcome *outcome,
                restitute_error *error)
{
    const int slides = rst_never_sticks(problem, 0);
    if (!slides && 2 * problem->chi <= 1)
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "chi = %g with psi = %g: a sphere that sinks in without turning needs the method euler or sync",
            problem->chi, problem->psi);
    outcome->shear_velocity = slides ? rst_slipping_velocity(problem, 0) : 0;
    /* that it stays is known to the speed below which it counts as at rest; |dU'| <= 2 chi |dD'|,
     * and where all sticks, psi < 1, U' falls with D' in proportion */
    outcome->error_ez = setup->rest_speed;
    outcome->error_ex =
        problem->mode == RST_FRICTIONLESS ? 0 : 2 * problem->chi * setup->rest_speed / fmax(1, problem->shear_speed);
    return rst_done(error);
}

/* Repeat the run with the log, if it was asked for. */
static int log_events(const struct run_setup *setup, const struct rst_outcome *outcome, struct cvode_memory *memory,
                      struct event_log *log, restitute_error *error)
{
    struct run run;
    struct run_setup all = *setup;
    all.radius = outcome->max_contact_radius;
    all.rebound = -outcome->velocity;
    all.budget = INT64_MAX;
    all.until = INFINITY;
    return solve_elements(&all, outcome->elements > 0 ? outcome->elements : elements_of_log, memory, log, &run, error);
}

static int solve(const struct rst_problem *problem, struct run_setup *setup, struct cvode_memory *memory,
                 int keep_ledger, struct rst_outcome *outcome, restitute_error *error)
{
    struct rst_outcome normal;
    const double stiffness = stiffness_of(problem, setup->depth);
    if (setup->family == INTEGRATOR_ADAMS && stiffness > too_stiff)
        return rst_report(
            error, RESTITUTE_ERROR_UNSTABLE_STEP,
            "the solid relaxes %.3g times within the compression: up to %g with cvode-adams; take cvode or cvode-bdf",
            stiffness, too_stiff);
    memory->work.stiff = setup->family == INTEGRATOR_BDF;
    memory->updates = 0;
    int status = solve_normal(setup, memory, &normal, error);
    if (status) return status;
    setup->rebound = -normal.velocity;
    *outcome = normal;
    outcome->updates = memory->updates;
    if (normal.sunk)
        status = stay(problem, setup, outcome, error);
    else if (rst_never_sticks(problem, setup->rebound))
        status = without_elements(problem, &normal, outcome, error);
    else
        status = refine(problem, setup, memory, outcome, error);
    if (status < 0 || !keep_ledger) return status;
    const int kept = rst_cvode_ledger(setup, memory, outcome, error);
    return kept < 0 ? kept : status;
}

int rst_cvode_solve(const struct rst_problem *problem, struct cvode_memory *memory, int keep_ledger,
                    struct rst_outcome *outcome, restitute_error *error)
{
    struct cvode_record *record = rst_cvode_method_of(problem)->record;
    struct run_setup setup = rst_cvode_setup(problem);
    restitute_cvode_work_init(&memory->work);
    const int status = solve(problem, &setup, memory, keep_ledger, outcome, error);
    if (!record) return status;
    record->units = problem->units;
    record->shear_speed = problem->shear_speed;
    record->work = memory->work; /* without what the log takes */
    record->log.count = 0;
    if (status < 0) return status;
    const int logged = log_events(&setup, outcome, memory, &record->log, error);
    if (logged < 0) record->log.count = 0;
    return logged < 0 ? logged : status;
}
