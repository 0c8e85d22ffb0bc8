/* One impact from input to result: checks, merging of terms, the method, units.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/material.h"
#include "base/method.h"
#include "base/sized.h"
#include "base/status.h"
#include "euler/euler.h"
#include "solver/output.h"
#include "solver/solver.h"
#include "solver/validity.h"
#include "sync/sync.h"

struct restitute_solver {
    restitute_options options;
    struct rst_workspace workspace;
    struct rst_sample *samples;
    size_t samples_size;
};

/* Share of the tolerance for the method by which merged terms may change the pair. */
static const double merging_share = 0.1;
/* The same for a ledger where slip is short, in tangential energies, psi^2. With it parts change by
 * 0.006 at most, without by 0.36, in 3000 impacts. */
static const double ledger_share = 0.01;

/* Slip is left out where it changes e_x by less than this part of the caller's tolerance. The
 * method gets the rest. Twice as much would ask it for a third more accuracy. */
static const double share_of_slip = 0.25;

/* Merging bounds rise with the largest indentation; the quick guess of it is good to some 10 %. */
static const double depth_margin = 1.2;

/* How many compression times a contact may last before slow terms are looked at again. */
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

RST_DEFAULTS(options, .method = &rst_method_euler, .tolerance = 1e-3, .threads = 1, .max_work = 10, .speed_limit = 0.1,
             .radius_limit = 0.1, .displacement_limit = 0.3, .dundurs_limit = 0.1)

/* A method of another component may be of another version, with which we share no struct. */
static int check_method(const restitute_method *method, restitute_error *error)
{
    if (!method) return rst_report(error, RESTITUTE_ERROR_NULL, "options.method is NULL");
    if (method->struct_size == sizeof *method && method->number == RST_METHOD_NUMBER) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                      "options.method has %zu bytes and the number %d: must have %zu and %d; its library belongs to "
                      "another version than librestitute %s",
                      method->struct_size, method->number, sizeof *method, RST_METHOD_NUMBER, restitute_version());
}

static int check_options(const restitute_options *options, restitute_error *error)
{
    int status = check_method(options->method, error);
    if (!status) status = rst_check_range(options->tolerance, 1e-8, 0.1, "tolerance", error);
    if (!status && options->elements != 0)
        status = rst_check_range((double)options->elements, 4, 1e6, "elements", error);
    if (!status) status = rst_check_within(options->time_step, rst_lengths, 0, "time_step", error);
    if (!status && options->time_step > 0 && !options->method->takes_time_step)
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN,
                            "time_step = %g: must be 0 with the method %s, which chooses its steps itself",
                            options->time_step, options->method->name);
    if (!status && (options->threads < 0 || options->threads > rst_most_threads))
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "threads = %d: must be in [0, %d] (0: all)",
                            options->threads, rst_most_threads);
    if (!status && !(options->max_work > 0))
        status =
            rst_report(error, RESTITUTE_ERROR_DOMAIN, "max_work = %g: must be > 0 (inf: no limit)", options->max_work);
    if (!status) status = rst_check_range(options->time_limit, 0, INFINITY, "time_limit (s)", error);
    if (!status) status = rst_check_range(options->speed_limit, 0, INFINITY, "speed_limit", error);
    if (!status) status = rst_check_range(options->radius_limit, 0, INFINITY, "radius_limit", error);
    if (!status) status = rst_check_range(options->displacement_limit, 0, INFINITY, "displacement_limit", error);
    if (!status) status = rst_check_range(options->dundurs_limit, 0, INFINITY, "dundurs_limit", error);
    return status;
}

int rst_take_options(const restitute_options *options, restitute_options *chosen, restitute_error *error)
{
    const int status = RST_TAKE(options, chosen, options, error);
    return status ? status : check_options(chosen, error);
}

int restitute_solver_create(const restitute_options *options, restitute_solver **solver, restitute_error *error)
{
    restitute_options chosen;
    if (!solver) return rst_report(error, RESTITUTE_ERROR_NULL, "solver is NULL");
    const int status = rst_take_options(options, &chosen, error);
    if (status) return status;
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

/* What merging did to a problem. */
struct merged {
    int64_t terms;
    double slow_rate, fast_bound; /* bound: slow_rate * contact time + fast_bound */
};

/* Merge terms whose relaxation does not matter in this contact: all together they may change the
 * energies by `allowed`. `window_factor`: its longest duration over that of a compression. */
static struct merged merge(struct rst_problem *problem, double allowed, double window_factor)
{
    struct rst_solid *s = &problem->solid;
    struct merged merged = {0};
    int64_t before = s->n_terms;
    if (before == 0) return merged;
    double depth = depth_margin * rst_likely_depth(s->g_inf, s->eta, s->n_terms, s->g, s->tau);
    double time = rst_elastic_contact_time() / 2 * depth; /* others are checked by what comes out */
    double share = problem->mode == RST_FRICTIONLESS ? 1 : fmax(1, problem->chi);
    rst_merge_terms(share, window_factor * time, depth, allowed, &s->g_inf, &s->eta, &s->n_terms, s->g, s->tau,
                    &merged.slow_rate, &merged.fast_bound);
    merged.terms = before - s->n_terms;
    return merged;
}

/* Slip at the edge, unless the caller prescribes the resolution. */
static int may_leave_out_slip(const struct rst_problem *problem)
{
    return problem->mode == RST_PARTIAL_SLIP && problem->elements <= 0 && !(problem->time_step > 0);
}

/* As if all stuck. The motion is then linear in U, which gets the unit of no slip. */
static void leave_out_slip(struct rst_problem *problem)
{
    problem->mode = RST_NO_SLIP;
    problem->slip_bound = rst_change_by_slip * problem->psi;
    problem->shear_scale = problem->psi;
    problem->shear_speed = 1;
    problem->units.shear_force *= problem->psi;
}

/* By the method. Where it follows slip with an error larger than what slip changes, slip is left
 * out after all. */
static int solve_problem(restitute_solver *solver, int keep_ledger, struct rst_problem *problem,
                         struct rst_outcome *outcome, restitute_error *error)
{
    const restitute_method *method = solver->options.method;
    const int status = method->solve(problem, &solver->workspace, keep_ledger, outcome, error);
    if (!method->cheap_without_slip || status != RESTITUTE_TOLERANCE_NOT_REACHED || !may_leave_out_slip(problem) ||
        outcome->error_ex < rst_change_by_slip * problem->psi)
        return status;
    const struct rst_problem before = *problem;
    const int64_t updates = outcome->updates;
    leave_out_slip(problem);
    problem->max_updates -= updates;
    problem->clock = NULL; /* the time may be over */
    const int again = method->solve(problem, &solver->workspace, keep_ledger, outcome, error);
    outcome->updates += updates;
    problem->max_updates = before.max_updates;
    problem->clock = before.clock;
    if (again != RESTITUTE_ERROR_TOO_MUCH_WORK) return again;
    return rst_report(error, again, "%s: too little for this impact", rst_spent(&before, 0).text);
}

/* A prescribed resolution has no time limit. */
static double time_limit(const restitute_options *o)
{
    if (o->time_limit > 0) return o->time_limit;
    return o->elements > 0 || o->time_step > 0 ? INFINITY : o->method->time_limit;
}

static double deadline(const restitute_options *o)
{
    const double limit = time_limit(o);
    return limit < INFINITY ? rst_clock() + limit : limit;
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
    const restitute_material *solid = input->scene ? input->scene->material : input->impact->material;
    if (rst_workspace_terms(&solver->workspace, solid ? solid->n_terms : 1))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", solid ? solid->n_terms : 1);
    *problem = (struct rst_problem){.method = o->method,
                                    .tolerance = o->tolerance,
                                    .asked = o->tolerance,
                                    .elements = o->elements,
                                    .max_work = o->max_work,
                                    .max_updates = (int64_t)fmin(1e18, o->max_work * o->method->updates_per_second),
                                    .time_limit = time_limit(o),
                                    .clock = input->deadline < INFINITY ? rst_clock : NULL,
                                    .deadline = input->deadline};
    problem->solid.g = solver->workspace.terms;
    problem->solid.tau = solver->workspace.terms + solver->workspace.terms_size / rst_term_arrays;
    int status = input->scene ? rst_problem_from_scene(input->scene, &input->numbers, problem, error)
                              : rst_problem_from_impact(input->impact, problem, error);
    if (status) return status;
    problem->units = rst_units_of(problem, input->scene, &input->numbers);
    problem->time_step = o->time_step / problem->time_unit;
    if (!may_leave_out_slip(problem) || rst_change_by_slip * problem->psi >= share_of_slip * o->tolerance)
        return RESTITUTE_OK;
    leave_out_slip(problem);
    problem->tolerance -= problem->slip_bound;
    return RESTITUTE_OK;
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

/* Solve with merged terms, which may change energies by their share of the tolerance, at most by
 * `most`. If the contact lasts longer than the window for slow terms, solve it again with these
 * terms. */
static int solve_merged(restitute_solver *solver, struct input *input, int keep_ledger, double most,
                        struct rst_problem *problem, struct rst_outcome *outcome, struct merged *merged,
                        restitute_error *error)
{
    double window = contact_in_compressions;
    for (;;) {
        int status = make_problem(solver, input, problem, error);
        if (status) return status;
        const double allowed = fmin(most, merging_share * problem->tolerance);
        *merged = solver->options.method->takes_all_terms ? (struct merged){0} : merge(problem, allowed, window);
        status = solve_problem(solver, keep_ledger, problem, outcome, error);
        if (status < 0 || merged->slow_rate <= 0 || outcome->sunk) return status;
        if (merged->slow_rate * outcome->contact_time <= allowed) return status;
        if (rst_time_left(problem) <= 0) return status; /* its estimate includes the bound of the merged terms */
        window *= 8;
    }
}

/* Merged terms that do not matter for the pair matter for the ledger where slip is as short as
 * their relaxation (docs/theory.md, section 7). Then the ledger is that of a run of its own with
 * fewer terms merged. It comes before that of the pair, to which history, events and kept motion
 * belong. */
struct ledger_run {
    int wanted, found;
    double shear_speed; /* its square is the unit of energy in x */
    struct rst_outcome outcome;
};

static int run_for_ledger(restitute_solver *solver, struct input *input, struct ledger_run *run, restitute_error *error)
{
    struct rst_problem problem;
    struct merged merged;
    restitute_error why;
    const int status = make_problem(solver, input, &problem, error);
    if (status || problem.mode != RST_PARTIAL_SLIP || solver->options.method->takes_all_terms) return status;
    const enum rst_mode mode = problem.mode;
    const double allowed = ledger_share * problem.psi * problem.psi;
    run->wanted = merge(&problem, merging_share * problem.tolerance, contact_in_compressions).fast_bound > allowed;
    if (!run->wanted) return RESTITUTE_OK;
    const int ran = solve_merged(solver, input, 1, allowed, &problem, &run->outcome, &merged, &why);
    if (ran == RESTITUTE_ERROR_MEMORY) return rst_report(error, ran, "%s", why.message);
    const int as_told = problem.elements > 0 || problem.time_step > 0;
    run->shear_speed = problem.shear_speed;
    run->wanted = ran < 0 || problem.mode == mode; /* else slip was left out after all */
    run->found =
        run->wanted && ran >= 0 && (as_told || fmax(run->outcome.error_ez, run->outcome.error_ex) <= problem.asked);
    return RESTITUTE_OK;
}

/* What is dissipated and left is that of the ledger's run, what comes back is that of the pair,
 * which may have left slip out, and has another unit then. */
static void take_ledger(const struct ledger_run *run, const struct rst_problem *problem, struct rst_outcome *outcome)
{
    const double ratio = problem->shear_speed / run->shear_speed;
    outcome->coarse = run->outcome.coarse;
    outcome->ledger = run->outcome.ledger;
    outcome->ledger.friction_x *= ratio * ratio;
    outcome->ledger.viscous_x *= ratio * ratio;
    outcome->ledger.left_x *= ratio * ratio;
}

/* What was not possible within the limits. */
static void remark_ledger(const struct ledger_run *run, const struct rst_outcome *outcome, restitute_error *error)
{
    if (run->wanted && !run->found)
        rst_remark(error, "ledger: less exact, terms are merged as for the pair");
    else if (outcome->coarse)
        rst_remark(error, "ledger: less exact, steps are longer than slip lasts");
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
    if (result) status = RST_CHECK(result, result, error);
    if (!status && ledger) status = RST_CHECK(ledger, ledger, error);
    if (!status && history) status = RST_CHECK(history, history, error);
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
    const int met = r->error_ez <= problem->asked && r->error_ex <= problem->asked;
    if (met) return status == RESTITUTE_TOLERANCE_NOT_REACHED ? rst_done(error) : status;
    if (status != RESTITUTE_OK) return status;
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED, "tolerance = %g: estimated errors %.2g (ez), %.2g (ex)",
                      problem->asked, r->error_ez, r->error_ex);
}

static int solve(restitute_solver *solver, struct input *input, restitute_result *result, restitute_ledger *ledger,
                 restitute_history *history, restitute_error *error)
{
    struct rst_problem problem;
    struct rst_outcome outcome;
    struct rst_history samples;
    struct merged merged = {0};
    struct ledger_run apart = {0};
    restitute_result found;
    restitute_ledger energies;
    restitute_history series;
    restitute_result_init(&found);
    rst_done(error);
    input->deadline = deadline(&solver->options);
    int status = ledger ? run_for_ledger(solver, input, &apart, error) : RESTITUTE_OK;
    if (status) return status;
    if (ledger) input->deadline = deadline(&solver->options); /* a ledger comes on top */
    status = solve_merged(solver, input, ledger && !apart.found, INFINITY, &problem, &outcome, &merged, error);
    if (status < 0) return status;
    if (history) {
        int recorded = record(solver, &problem, &outcome, history->capacity, &samples, error);
        if (recorded < 0) return recorded;
    }
    if (apart.found) take_ledger(&apart, &problem, &outcome);
    double slow = merged.slow_rate > 0 ? merged.slow_rate * outcome.followed_time : 0;
    rst_write_result(&problem, &outcome, merged.terms, slow + merged.fast_bound, &found);
    rst_judge_validity(&solver->options, input->scene, &input->numbers, &outcome, &found);
    if (ledger) {
        restitute_ledger_init(&energies);
        rst_write_ledger(&problem, &outcome, &energies);
        RST_GIVE(&energies, ledger);
    }
    if (result) RST_GIVE(&found, result);
    if (history) {
        RST_TAKE(history, &series, history, NULL); /* checked above */
        rst_write_history(&samples, &problem.units, &series);
        RST_GIVE(&series, history);
    }
    status = judge_tolerance(&problem, &found, status, error);
    if (status == RESTITUTE_OK && outcome.sunk && problem.solid.can_sink) /* else it comes back, however slowly */
        status = rst_report(error, RESTITUTE_NO_REBOUND, "%s", restitute_status_text(RESTITUTE_NO_REBOUND));
    rst_name_limits(&solver->options, input->scene, &found, error);
    remark_ledger(&apart, &outcome, error);
    return status;
}

int restitute_solve(restitute_solver *solver, const restitute_impact *impact, restitute_result *result,
                    restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    int status = check_outputs(solver, result, ledger, history, error);
    if (status) return status;
    if (!impact) return rst_report(error, RESTITUTE_ERROR_NULL, "impact is NULL");
    restitute_impact own;
    status = RST_TAKE(impact, &own, impact, error);
    if (status) return status;
    return solve(solver, &(struct input){.impact = &own}, result, ledger, history, error);
}

int restitute_solve_scene(restitute_solver *solver, const restitute_scene *scene, restitute_result *result,
                          restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    int status = check_outputs(solver, result, ledger, history, error);
    if (status) return status;
    if (!scene) return rst_report(error, RESTITUTE_ERROR_NULL, "scene is NULL");
    restitute_scene own;
    status = RST_TAKE(scene, &own, scene, error);
    if (status) return status;
    if (!own.material) return rst_report(error, RESTITUTE_ERROR_NULL, "scene.material is NULL");
    return solve(solver, &(struct input){.scene = &own}, result, ledger, history, error);
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
