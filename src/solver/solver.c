/* One impact from input to result: checks, merging of terms, the method, units.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solver/solver.h"
#include "base/clock.h"
#include "base/material.h"
#include "base/method.h"
#include "base/status.h"
#include "euler/euler.h"
#include "solver/output.h"
#include "solver/validity.h"
#include "sync/sync.h"

struct restitute_solver {
    restitute_options options;
    struct rst_workspace workspace;
    struct rst_sample *samples;
    size_t samples_size;
};

/* Share of the tolerance by which merged terms may change the pair. */
static const double merging_share = 0.1;

/* The bounds of merging grow with the largest indentation, whose estimate has an error of about 10
 * %. */
static const double depth_margin = 1.2;

/* Time to the largest indentation over that indentation, for an elastic solid (half of the contact
 * time 2.943 T). For other solids the computed contact time is checked. */
static const double elastic_compression = 1.47;

/* Contact time in compression times up to which the merging of slow terms holds. Longer contacts
 * are solved again. */
static const double contact_in_compressions = 6;

const restitute_method *restitute_method_euler(void)
{
    return &rst_method_euler;
}

const restitute_method *restitute_method_sync(void)
{
    return &rst_method_sync;
}

const char *restitute_method_name(const restitute_method *method)
{
    return method ? method->name : "";
}

void restitute_options_init(restitute_options *options)
{
    if (!options) return;
    *options = (restitute_options){.struct_size = sizeof *options,
                                   .method = &rst_method_euler,
                                   .tolerance = 1e-3,
                                   .max_updates = 10000000000,
                                   .speed_limit = 0.1,
                                   .radius_limit = 0.1,
                                   .displacement_limit = 0.3,
                                   .dundurs_limit = 0.1};
}

static int check_options(const restitute_options *options, restitute_error *error)
{
    int status = rst_check_size(options->struct_size, sizeof *options, "restitute_options", error);
    if (status) return status;
    if (!options->method) return rst_report(error, RESTITUTE_ERROR_NULL, "options.method is NULL");
    status = rst_check_range(options->tolerance, 1e-8, 0.1, "tolerance", error);
    if (!status && options->elements != 0)
        status = rst_check_range((double)options->elements, 4, 1e6, "elements", error);
    if (!status) status = rst_check_within(options->time_step, rst_lengths, 0, "time_step", error);
    if (!status && options->time_step > 0 && !options->method->takes_time_step)
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN,
                            "time_step = %g: must be 0 with the method %s, which chooses its steps itself",
                            options->time_step, options->method->name);
    if (!status && options->max_updates <= 0)
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "max_updates = %lld: must be > 0",
                            (long long)options->max_updates);
    if (!status) status = rst_check_range(options->time_limit, 0, INFINITY, "time_limit (s)", error);
    if (!status) status = rst_check_range(options->speed_limit, 0, INFINITY, "speed_limit", error);
    if (!status) status = rst_check_range(options->radius_limit, 0, INFINITY, "radius_limit", error);
    if (!status) status = rst_check_range(options->displacement_limit, 0, INFINITY, "displacement_limit", error);
    if (!status) status = rst_check_range(options->dundurs_limit, 0, INFINITY, "dundurs_limit", error);
    return status;
}

int restitute_solver_create(const restitute_options *options, restitute_solver **solver, restitute_error *error)
{
    restitute_options chosen;
    if (!solver) return rst_report(error, RESTITUTE_ERROR_NULL, "solver is NULL");
    restitute_options_init(&chosen);
    if (options) {
        int status = check_options(options, error);
        if (status) return status;
        chosen = *options;
    }
    restitute_solver *s = calloc(1, sizeof *s);
    if (!s) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a solver");
    s->options = chosen;
    if (chosen.method->reserve && chosen.method->reserve(chosen.tolerance, &s->workspace)) {
        restitute_solver_destroy(s);
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the workspace of a solver");
    }
    *solver = s;
    return rst_done(error);
}

void restitute_solver_destroy(restitute_solver *solver)
{
    if (!solver) return;
    rst_workspace_free(&solver->workspace);
    free(solver->samples);
    free(solver);
}

const struct restitute_method *restitute_private_method(const restitute_solver *solver)
{
    return solver->options.method;
}

struct rst_workspace *restitute_private_workspace(restitute_solver *solver)
{
    return &solver->workspace;
}

/* What merging did to a problem. */
struct merged {
    int64_t terms;
    double slow_rate, fast_bound; /* bound: slow_rate * contact time + fast_bound */
};

/* Merge terms whose relaxation does not matter in this contact. `window`: its longest duration, in
 * T. */
static struct merged merge(struct rst_problem *problem, double window_factor)
{
    struct rst_solid *s = &problem->solid;
    struct merged merged = {0};
    int64_t before = s->n_terms;
    if (before == 0) return merged;
    double depth = depth_margin * rst_likely_depth(s->g_inf, s->eta, s->n_terms, s->g, s->tau);
    double time = elastic_compression * depth;
    double chi = problem->mode == RST_FRICTIONLESS ? 0 : problem->chi;
    rst_merge_terms(chi, window_factor * time, depth, merging_share * problem->tolerance, &s->g_inf, &s->eta,
                    &s->n_terms, s->g, s->tau, &merged.slow_rate, &merged.fast_bound);
    merged.terms = before - s->n_terms;
    return merged;
}

/* With a prescribed resolution there is no limit of work. */
static double time_limit(const restitute_options *o)
{
    if (o->time_limit > 0) return o->time_limit;
    return o->elements > 0 || o->time_step > 0 ? INFINITY : o->method->time_limit;
}

/* One of the two kinds of input, and the workspace to make a problem from it. */
struct input {
    const restitute_impact *impact;
    const restitute_scene *scene;
    restitute_numbers numbers;
    double deadline;
};

static int make_problem(restitute_solver *solver, struct input *input, struct rst_problem *problem,
                        restitute_error *error)
{
    const restitute_options *o = &solver->options;
    const restitute_material *solid = input->scene ? input->scene->material : input->impact->solid;
    if (rst_workspace_terms(&solver->workspace, solid ? solid->n_terms : 1))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", solid ? solid->n_terms : 1);
    *problem = (struct rst_problem){.method = o->method,
                                    .tolerance = o->tolerance,
                                    .elements = o->elements,
                                    .max_updates = o->max_updates,
                                    .time_limit = time_limit(o),
                                    .clock = input->deadline < INFINITY ? rst_clock : NULL,
                                    .deadline = input->deadline};
    problem->solid.g = solver->workspace.terms;
    problem->solid.tau = solver->workspace.terms + solver->workspace.terms_size / rst_term_arrays;
    int status = input->scene ? rst_problem_from_scene(input->scene, &input->numbers, problem, error)
                              : rst_problem_from_impact(input->impact, problem, error);
    if (!status) problem->time_step = o->time_step / problem->time_unit;
    return status;
}

int rst_solver_check(restitute_solver *solver, const restitute_impact *impact, const restitute_scene *scene,
                     restitute_error *error)
{
    struct rst_problem problem;
    return make_problem(solver, &(struct input){.impact = impact, .scene = scene}, &problem, error);
}

void rst_solver_keep_motion(restitute_solver *solver)
{
    solver->workspace.keeps_motion = 1;
}

/* Solve with merged terms. If the contact lasts longer than the window for slow terms, solve it
 * again with these terms. */
static int solve_merged(restitute_solver *solver, struct input *input, int keep_ledger, struct rst_problem *problem,
                        struct rst_outcome *outcome, struct merged *merged, restitute_error *error)
{
    double window = contact_in_compressions;
    for (;;) {
        int status = make_problem(solver, input, problem, error);
        if (status) return status;
        *merged = solver->options.method->takes_all_terms ? (struct merged){0} : merge(problem, window);
        status = solver->options.method->solve(problem, &solver->workspace, keep_ledger, outcome, error);
        if (status < 0 || merged->slow_rate <= 0 || outcome->sunk) return status;
        if (merged->slow_rate * outcome->contact_time <= merging_share * problem->tolerance) return status;
        if (rst_time_left(problem) <= 0) return status; /* its estimate includes the bound of the merged terms */
        window *= 8;
    }
}

static int record(restitute_solver *solver, const struct rst_problem *problem, const struct rst_outcome *outcome,
                  size_t capacity, struct rst_history *history, restitute_error *error)
{
    const size_t states = (size_t)outcome->steps + 1;
    if (capacity > states && !solver->options.method->records_between_steps) capacity = states;
    if (capacity > solver->samples_size) {
        struct rst_sample *samples = malloc(capacity * sizeof *samples);
        if (!samples) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu samples", capacity);
        free(solver->samples);
        solver->samples = samples;
        solver->samples_size = capacity;
    }
    *history = (struct rst_history){.capacity = capacity, .samples = solver->samples};
    return solver->options.method->record(problem, &solver->workspace, outcome, history, error);
}

static int check_outputs(const restitute_solver *solver, const restitute_result *result, const restitute_ledger *ledger,
                         const restitute_history *history, restitute_error *error)
{
    if (!solver) return rst_report(error, RESTITUTE_ERROR_NULL, "solver is NULL");
    int status = RESTITUTE_OK;
    if (result) status = rst_check_size(result->struct_size, sizeof *result, "restitute_result", error);
    if (!status && ledger) status = rst_check_size(ledger->struct_size, sizeof *ledger, "restitute_ledger", error);
    if (!status && history) status = rst_check_size(history->struct_size, sizeof *history, "restitute_history", error);
    if (!status && history && (history->capacity < 2 || history->capacity > 1000000000))
        status =
            rst_report(error, RESTITUTE_ERROR_DOMAIN, "history.capacity = %zu: must be in [2, 1e9]", history->capacity);
    return status;
}

/* A method aims at a share of the tolerance, and merged terms add their bound. The status follows
 * from the reported estimate. */
static int judge_tolerance(const struct rst_problem *problem, const restitute_result *r, int status,
                           restitute_error *error)
{
    const int met = r->error_ez <= problem->tolerance && r->error_ex <= problem->tolerance;
    if (met) return status == RESTITUTE_TOLERANCE_NOT_REACHED ? rst_done(error) : status;
    if (status != RESTITUTE_OK) return status;
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED, "tolerance = %g: estimated errors %.2g (ez), %.2g (ex)",
                      problem->tolerance, r->error_ez, r->error_ex);
}

static int solve(restitute_solver *solver, struct input *input, restitute_result *result, restitute_ledger *ledger,
                 restitute_history *history, restitute_error *error)
{
    struct rst_problem problem;
    struct rst_outcome outcome;
    struct rst_history samples;
    struct merged merged = {0};
    restitute_result found;
    restitute_result_init(&found);
    rst_done(error);
    const double limit = time_limit(&solver->options);
    input->deadline = limit < INFINITY ? rst_clock() + limit : limit;
    int status = solve_merged(solver, input, ledger != NULL, &problem, &outcome, &merged, error);
    if (status < 0) return status;
    if (history) {
        int recorded = record(solver, &problem, &outcome, history->capacity, &samples, error);
        if (recorded < 0) return recorded;
    }
    struct rst_units units = rst_units_of(&problem, input->scene, &input->numbers);
    double slow = merged.slow_rate > 0 ? merged.slow_rate * outcome.followed_time : 0;
    rst_write_result(&problem, &outcome, &units, merged.terms, slow + merged.fast_bound, &found);
    found.method = solver->options.method->name;
    rst_judge_validity(&solver->options, input->scene, &input->numbers, &outcome, &found);
    if (result) *result = found;
    if (ledger) rst_write_ledger(&problem, &outcome, ledger);
    if (history) rst_write_history(&samples, &units, history);
    if (!outcome.sunk || !problem.solid.can_sink) /* with an equilibrium modulus the sphere rebounds, however slowly */
        status = judge_tolerance(&problem, &found, status, error);
    else if (status == RESTITUTE_OK)
        status = rst_report(error, RESTITUTE_NO_REBOUND, "%s", restitute_status_text(RESTITUTE_NO_REBOUND));
    rst_name_limits(&solver->options, &found, error);
    return status;
}

int restitute_solve(restitute_solver *solver, const restitute_impact *impact, restitute_result *result,
                    restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    int status = check_outputs(solver, result, ledger, history, error);
    if (status) return status;
    if (!impact) return rst_report(error, RESTITUTE_ERROR_NULL, "impact is NULL");
    status = rst_check_size(impact->struct_size, sizeof *impact, "restitute_impact", error);
    if (status) return status;
    return solve(solver, &(struct input){.impact = impact}, result, ledger, history, error);
}

int restitute_solve_scene(restitute_solver *solver, const restitute_scene *scene, restitute_result *result,
                          restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    int status = check_outputs(solver, result, ledger, history, error);
    if (status) return status;
    if (!scene) return rst_report(error, RESTITUTE_ERROR_NULL, "scene is NULL");
    status = rst_check_size(scene->struct_size, sizeof *scene, "restitute_scene", error);
    if (status) return status;
    if (!scene->material) return rst_report(error, RESTITUTE_ERROR_NULL, "scene.material is NULL");
    return solve(solver, &(struct input){.scene = scene}, result, ledger, history, error);
}

/* The one-call forms. */
static int solve_once(const restitute_impact *impact, const restitute_scene *scene, double *ez, double *ex,
                      restitute_error *error)
{
    restitute_solver *solver;
    restitute_result result;
    restitute_result_init(&result);
    int status = restitute_solver_create(NULL, &solver, error);
    if (status) return status;
    status = scene ? restitute_solve_scene(solver, scene, &result, NULL, NULL, error)
                   : restitute_solve(solver, impact, &result, NULL, NULL, error);
    restitute_solver_destroy(solver);
    if (status < 0) return status;
    if (ez) *ez = result.ez;
    if (ex) *ex = result.ex;
    return status;
}

int restitute_pair(double chi, double psi, double delta1, double gamma, double *ez, double *ex, restitute_error *error)
{
    restitute_impact impact;
    restitute_impact_init(&impact);
    impact.chi = chi;
    impact.psi = psi;
    impact.delta1 = delta1;
    impact.gamma = gamma;
    return solve_once(&impact, NULL, ez, ex, error);
}

int restitute_scene_pair(const restitute_scene *scene, double *ez, double *ex, restitute_error *error)
{
    if (!scene) return rst_report(error, RESTITUTE_ERROR_NULL, "scene is NULL");
    return solve_once(NULL, scene, ez, ex, error);
}

double restitute_critical_psi(double chi, double ez)
{
    if (!(chi > 0) || !(ez >= 0 && ez <= 1)) return NAN;
    return rst_critical_psi(chi, ez);
}
