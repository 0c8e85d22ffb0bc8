/* The method `euler`: the paper's foundation and explicit Euler (9)-(17), refined until its error
 * estimate is met.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "euler/euler.h"

#include <math.h>
#include <string.h>

#include "base/gross_slip.h"
#include "base/status.h"
#include "euler/kernels.h"

/* Steps in the compression for each element over the largest radius. With 16 the errors in time and
 * in space are of similar size (docs/theory.md, section 4). */
static const double steps_per_element = 16;
static const int64_t first_elements = 8;

/* Estimate over the change between levels. For a method of first order the change equals the error;
 * the factor covers levels that are not yet asymptotic. */
static const double estimate_slack = 1.25;

/* Refinement stops when the estimate is below this share of the tolerance, because some estimates
 * are too small (docs/records/accuracy.md). */
static const double acceptance = 0.8;

/* Some milliseconds. */
static const int64_t updates_between_looks = 4000000;

/* Step of the coarsest level over the largest stable step, at most. */
static const double stability_margin = 0.5;

/* Resolution of one run, and what it returned. */
struct run {
    int64_t elements;
    double step;
    struct euler_state state;
};

struct layout {
    double *g, *tau, *decay, *gain;                            /* per term */
    double *x2, *f, *u, *q, *slip, *move, *q_before, *yz, *yx; /* per element, yz and yx per element and term */
};

struct scout {
    double depth, time, force; /* largest indentation and when, largest force, about 1 % accurate */
    int64_t sinks;
    double stable_step;
};

static double rest_speed(const struct rst_problem *problem)
{
    return 0.01 * problem->tolerance; /* a rebound this slow changes e_z by far less than the tolerance */
}

/* Whether tangential elements will be stepped: not without friction, and not in slip to the end
 * (27), psi_c <= 4 chi - 1. */
static int moves_tangentially(const struct rst_problem *problem)
{
    return !rst_never_sticks(problem, 1);
}

static int64_t capacity_of(int64_t elements)
{
    return 2 * elements + 8; /* the estimated depth may be too small, and a coarse run may exceed it */
}

/* Terms get their arrays before the elements. */
static double *array_of_terms(const struct rst_workspace *workspace, size_t number)
{
    return workspace->terms + number * (workspace->terms_size / rst_term_arrays);
}

static struct layout lay_out(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t capacity)
{
    struct layout l;
    size_t n = (size_t)capacity, terms = (size_t)problem->solid.n_terms;
    double *p = workspace->elements;
    l.g = problem->solid.g;
    l.tau = problem->solid.tau;
    l.decay = array_of_terms(workspace, 2);
    l.gain = array_of_terms(workspace, 3);
    double **arrays[] = {&l.x2, &l.f, &l.u, &l.q, &l.slip, &l.move, &l.q_before};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++, p += n)
        *arrays[i] = p;
    l.yz = p;
    l.yx = p + n * terms;
    return l;
}

static void look_ahead(const struct rst_problem *problem, struct rst_workspace *workspace, struct scout *scout)
{
    const struct rst_solid *s = &problem->solid;
    rst_scout_compression(s->g_inf, s->eta, s->n_terms, s->g, s->tau, s->can_sink, rest_speed(problem),
                          array_of_terms(workspace, 4), &scout->depth, &scout->time, &scout->force, &scout->sinks);
    /* int f dX over a contact of radius A changes velocities at the rate (15/8) A in z and 2 chi
     * times that in x */
    double coupling = rst_mass_factor() * sqrt(scout->depth);
    if (moves_tangentially(problem)) coupling *= fmax(1, 2 * problem->chi);
    scout->stable_step = rst_largest_stable_step(coupling, s->g_inf, s->eta, s->n_terms, s->g, s->tau);
}

static int prepare(const struct rst_problem *problem, struct rst_workspace *workspace, const struct scout *scout,
                   const struct run *run, int keep_ledger, struct euler_scene *scene, struct layout *l)
{
    const struct rst_solid *s = &problem->solid;
    size_t capacity = (size_t)capacity_of(run->elements);
    if (rst_workspace_elements(workspace, capacity * (7 + 2 * (size_t)s->n_terms))) return 1;
    *l = lay_out(problem, workspace, (int64_t)capacity);
    *scene = (struct euler_scene){.chi = problem->chi,
                                  .shear_speed = problem->shear_speed,
                                  .g_inf = s->g_inf,
                                  .eta = s->eta,
                                  .step = run->step,
                                  .spacing = sqrt(scout->depth) / (double)run->elements,
                                  .rest_speed = rest_speed(problem),
                                  .n_terms = s->n_terms,
                                  .capacity = (int64_t)capacity,
                                  .can_sink = s->can_sink,
                                  .keep_ledger = keep_ledger,
                                  .mode = problem->mode};
    rst_step_coefficients(run->step, s->n_terms, s->g, s->tau, l->decay, l->gain);
    return 0;
}

static void advance(const struct euler_scene *scene, const struct layout *l, int64_t n_steps, struct euler_state *state)
{
    rst_advance_impact(scene, l->g, l->tau, l->decay, l->gain, l->x2, l->f, l->yz, l->u, l->yx, l->q, l->slip, l->move,
                       l->q_before, n_steps, state);
}

/* Take as many steps as the limits allow. Returns whether the time limit was reached. */
static int advance_within(const struct rst_problem *problem, const struct euler_scene *scene, const struct layout *l,
                          int64_t updates, struct run *run)
{
    const int64_t of_step = run->elements * (1 + problem->solid.n_terms);
    const int64_t most = (problem->max_updates - updates) / of_step + 1, piece = updates_between_looks / of_step + 1;
    while (run->state.phase < RST_DONE && run->state.n_steps < most) {
        if (rst_time_left(problem) <= 0) return 1;
        const int64_t rest = most - run->state.n_steps;
        advance(scene, l, rest < piece ? rest : piece, &run->state);
    }
    return 0;
}

/* One impact at one resolution. */
static int run_once(const struct rst_problem *problem, struct rst_workspace *workspace, const struct scout *scout,
                    int keep_ledger, int64_t *updates, struct run *run, restitute_error *error)
{
    struct euler_scene scene;
    struct layout l;
    if (prepare(problem, workspace, scout, run, keep_ledger, &scene, &l))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld elements", (long long)run->elements);
    rst_start_impact(&scene, &run->state, l.x2);
    const int late = advance_within(problem, &scene, &l, *updates, run);
    *updates += run->state.n_updates * (1 + problem->solid.n_terms);
    if (run->state.phase == RST_STALLED)
        return rst_report(error, RESTITUTE_ERROR_CONVERGENCE,
                          "rebound too slow: steps of %.3g %s are lost in the rounding of the indentation; "
                          "the damping is too strong for this method",
                          run->step * problem->time_unit, problem->unit_name);
    if (run->state.phase == RST_OVERFLOW)
        return rst_report(error, RESTITUTE_ERROR_UNSTABLE_STEP,
                          "steps of %.6g %s: the indentation outgrew the foundation; take a smaller time_step",
                          run->step * problem->time_unit, problem->unit_name);
    if (run->state.phase < RST_DONE)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "%s: reached after %lld steps of %.3g %s; raise it or take the method sync",
                          rst_spent(problem, late).text, (long long)run->state.n_steps, run->step * problem->time_unit,
                          problem->unit_name);
    return RESTITUTE_OK;
}

static double ez_of(const struct euler_state *state)
{
    return state->phase == RST_SUNK ? 0 : -state->velocity;
}

static double ex_of(const struct rst_problem *problem, const struct euler_state *state)
{
    return -state->shear_velocity / problem->shear_speed;
}

static void change(const struct rst_problem *problem, const struct run *a, const struct run *b, double *ez, double *ex)
{
    *ez = fabs(ez_of(&a->state) - ez_of(&b->state));
    *ex = fabs(ex_of(problem, &a->state) - ex_of(problem, &b->state));
}

/* The outcome of a run. Two changes estimate the error of the last of three levels, since one may
 * be small by chance. To it the distance of the run from that level is added. */
static void fill(const struct rst_problem *problem, const struct scout *scout, const struct run *level,
                 const struct run *run, int64_t updates, struct rst_outcome *outcome)
{
    double error_ez, error_ex, before_ez, before_ex, off_ez, off_ex;
    change(problem, &level[1], &level[0], &before_ez, &before_ex);
    change(problem, &level[2], &level[1], &error_ez, &error_ex);
    change(problem, &level[2], run, &off_ez, &off_ex);
    error_ez = estimate_slack * fmax(error_ez, 0.5 * before_ez) + off_ez;
    /* the error of the normal motion reaches e_x too, even where the changes of e_x happen to
     * cancel */
    error_ex = fmax(error_ez, estimate_slack * fmax(error_ex, 0.5 * before_ex) + off_ex);
    const struct euler_state *s = &run->state;
    const int sunk = s->phase == RST_SUNK;
    if (sunk) { /* the run stopped with these velocities still left; |dU'| <= 2 chi |dD'| */
        error_ez += rest_speed(problem);
        error_ex += 2 * problem->chi * rest_speed(problem) / problem->shear_speed;
    }
    *outcome = (struct rst_outcome){.velocity = sunk ? 0 : s->velocity,
                                    .shear_velocity = s->shear_velocity,
                                    .error_ez = error_ez,
                                    .error_ex = problem->mode == RST_FRICTIONLESS ? 0 : error_ex,
                                    .contact_time = sunk ? INFINITY : s->time,
                                    .followed_time = s->time,
                                    .max_indentation = s->max_depth,
                                    .max_contact_radius = sqrt(s->max_depth),
                                    .max_normal_force = s->max_force,
                                    .spacing = sqrt(scout->depth) / (double)run->elements,
                                    .step = run->step,
                                    .elements = run->elements,
                                    .steps = s->n_steps,
                                    .updates = updates,
                                    .ledger = s->ledger,
                                    .sunk = sunk};
    if (outcome->sunk && problem->mode == RST_NO_SLIP) outcome->shear_velocity = 0; /* stuck for good */
}

/* The tangential oscillation in stick is faster than the normal one by sqrt(2 chi), and needs as
 * many more elements and steps. The default numbers are for solid spheres, chi = 7/6. */
static int64_t elements_to_start(const struct rst_problem *problem)
{
    if (!moves_tangentially(problem)) return first_elements;
    return llround((double)first_elements * sqrt(fmax(1, problem->chi * 6 / 7)));
}

/* The tolerance is met. A remark names the cost if it is high. */
static int finish(const struct rst_problem *problem, const struct rst_outcome *outcome, restitute_error *error)
{
    const double work = (double)outcome->updates / problem->method->updates_per_second, high = 1;
    if (work < high) return rst_done(error);
    return rst_report(error, RESTITUTE_OK, "tolerance = %g took %.2g nominal seconds; the method sync is far faster",
                      problem->asked, work);
}

static double step_for(const struct scout *scout, int64_t elements)
{
    return fmin(scout->time / (steps_per_element * (double)elements), stability_margin * scout->stable_step);
}

static struct run refined(const struct run *run, double times)
{
    return (struct run){.elements = (int64_t)ceil(times * (double)run->elements), .step = run->step / times};
}

static struct run first_level(const struct rst_problem *problem, const struct scout *scout)
{
    const int64_t elements = elements_to_start(problem);
    /* where it sinks, the estimated time is that of the decay, not of the impact */
    return (struct run){.elements = elements, .step = (scout->sinks ? 0.25 : 1) * step_for(scout, elements)};
}

/* Refine elements and step together until the change between levels meets the tolerance. */
static int solve_refining(const struct rst_problem *problem, struct rst_workspace *workspace, const struct scout *scout,
                          int keep_ledger, struct rst_outcome *outcome, restitute_error *error)
{
    struct run run[3] = {[2] = first_level(problem, scout)}, *now = &run[2];
    int64_t updates = 0;
    int found = 0, late = 0;
    int status = run_once(problem, workspace, scout, keep_ledger, &updates, now, error);
    for (int level = 1; !status; level++) {
        const double left = rst_time_left(problem);
        run[0] = run[1];
        run[1] = run[2];
        *now = refined(&run[1], 2);
        status = run_once(problem, workspace, scout, keep_ledger, &updates, now, error);
        if (status) break;
        if (level < 2) continue;
        fill(problem, scout, run, now, updates, outcome);
        found = 1;
        if (fmax(outcome->error_ez, outcome->error_ex) <= acceptance * problem->tolerance)
            return finish(problem, outcome, error);
        late = rst_lacks_time(problem, 4, left); /* twice the elements, twice the steps */
        if (late) break;
    }
    if (found && status == RESTITUTE_ERROR_CONVERGENCE)
        return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                          "tolerance = %g: estimated errors %.2g (ez), %.2g (ex); finer steps are lost in rounding",
                          problem->asked, outcome->error_ez, outcome->error_ex);
    if (!found || (status && status != RESTITUTE_ERROR_TOO_MUCH_WORK)) return status;
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex); a finer run exceeds %s; "
                      "the method sync is faster",
                      problem->asked, outcome->error_ez, outcome->error_ex,
                      rst_spent(problem, late || rst_time_left(problem) <= 0).text);
}

static int choose_resolution(const struct rst_problem *problem, const struct scout *scout, struct run *run,
                             restitute_error *error)
{
    const double below = scout->stable_step * (1 - 1e-5); /* stable when printed with six digits */
    if (problem->time_step > scout->stable_step)
        return rst_report(error, RESTITUTE_ERROR_UNSTABLE_STEP,
                          "time_step = %.6g %s: is unstable; the largest stable step: %.6g %s",
                          problem->time_step * problem->time_unit, problem->unit_name, below * problem->time_unit,
                          problem->unit_name);
    run->elements = problem->elements;
    run->step = problem->time_step;
    if (run->elements <= 0)
        run->elements = (int64_t)fmin(1e6, fmax(4, ceil(scout->time / run->step / steps_per_element)));
    if (run->step <= 0) run->step = step_for(scout, run->elements);
    return RESTITUTE_OK;
}

/* A step above this share of the largest stable one is so coarse that a comparison with a coarser
 * run is not meaningful. */
static const double smooth_part = 0.2;

/* Elements or step prescribed: the last of three levels. Where it is coarser than the third level
 * of a refinement, the first that is ever accepted, coarser runs say little of its error. Its
 * distance from that third level is added then to the estimate of the latter. */
static int solve_prescribed(const struct rst_problem *problem, struct rst_workspace *workspace,
                            const struct scout *scout, int keep_ledger, struct rst_outcome *outcome,
                            restitute_error *error)
{
    struct run given = {0}, level[3] = {first_level(problem, scout)};
    int64_t updates = 0;
    int status = choose_resolution(problem, scout, &given, error);
    if (!status) status = run_once(problem, workspace, scout, keep_ledger, &updates, &given, error);
    if (status) return status;
    level[1] = refined(&level[0], 2);
    level[2] = refined(&level[1], 2);
    const int coarse = scout->sinks || given.elements < level[2].elements || given.step > level[2].step ||
                       2 * given.step >= smooth_part * scout->stable_step;
    if (!coarse) {
        level[2] = given;
        level[1] = refined(&given, 0.5);
        level[0] = refined(&level[1], 0.5);
    }
    for (int k = 0; k < 2 + coarse && !status; k++)
        status = run_once(problem, workspace, scout, 0, &updates, &level[k], error);
    const int unknown = status == RESTITUTE_ERROR_TOO_MUCH_WORK || status == RESTITUTE_ERROR_CONVERGENCE;
    if (status && !unknown) return status;
    if (unknown) level[0] = level[1] = level[2] = given;
    fill(problem, scout, level, &given, updates, outcome);
    if (unknown) outcome->error_ez = 1, outcome->error_ex = 2; /* nothing was compared: their ranges */
    if (fmax(outcome->error_ez, outcome->error_ex) <= problem->tolerance) return rst_done(error);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with the given elements and time_step%s",
                      problem->asked, outcome->error_ez, outcome->error_ex,
                      unknown ? "; there is no run to compare with" : "");
}

/* Elements at the edge slip for a time of the order of psi, and swings in stick are faster by
 * sqrt(chi). The pair needs no step of that length, the division of the energy among friction and
 * dashpots does. */
static const double step_in_slip = 1.0 / 30, shortest_step = 1.0 / 64;

/* The ledger by such steps. It may take as much work as the pair; else the one by the steps of the
 * pair stays. */
static int follow_slip(const struct rst_problem *problem, struct rst_workspace *workspace, const struct scout *scout,
                       struct rst_outcome *outcome, restitute_error *error)
{
    const double wanted = step_in_slip * problem->psi / sqrt(fmax(1, problem->chi));
    struct run run = {.elements = outcome->elements, .step = fmax(shortest_step * outcome->step, wanted)};
    int64_t updates = 0;
    restitute_error why;
    if (problem->mode != RST_PARTIAL_SLIP || run.step >= outcome->step) return RESTITUTE_OK;
    const int status = run_once(problem, workspace, scout, 1, &updates, &run, &why);
    if (status == RESTITUTE_ERROR_MEMORY) return rst_report(error, status, "%s", why.message);
    outcome->coarse = status != RESTITUTE_OK;
    if (!outcome->coarse) outcome->ledger = run.state.ledger;
    return RESTITUTE_OK;
}

static int euler_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                       struct rst_outcome *outcome, restitute_error *error)
{
    struct scout scout;
    look_ahead(problem, workspace, &scout);
    if (problem->elements > 0 || problem->time_step > 0)
        return solve_prescribed(problem, workspace, &scout, keep_ledger, outcome, error);
    const int status = solve_refining(problem, workspace, &scout, keep_ledger, outcome, error);
    if (status < 0 || !keep_ledger) return status;
    const int followed = follow_slip(problem, workspace, &scout, outcome, error);
    return followed < 0 ? followed : status;
}

/* Where a quantity that is positive on elements 1..n vanishes outside of them: continued linearly
 * from the two outermost, by at most one cell. */
static double zero_beyond(double spacing, int64_t n, double outermost, double neighbour)
{
    double position = ((double)n - 0.5) * spacing;
    if (n < 2 || neighbour <= outermost) return position;
    return position + spacing * fmin(1, outermost / (neighbour - outermost));
}

/* Contact radius: while the contact grows it is sqrt(D); later it is where f vanishes. */
static double contact_radius(const struct euler_scene *scene, const struct euler_state *state, const double *f)
{
    int64_t n = state->n_contact;
    if (state->phase == RST_COMPRESSION || state->phase == RST_SUNK) return sqrt(fmax(0, state->depth));
    if (n == 0) return 0;
    return fmin(sqrt(state->max_depth), zero_beyond(scene->spacing, n, f[n - 1], n > 1 ? f[n - 2] : 0));
}

/* Radius of the inner part that did not slip in the last step: where f - |q| vanishes. */
static double stick_radius(const struct euler_scene *scene, const struct euler_state *state, const struct layout *l,
                           double contact)
{
    int64_t n = 0;
    if (state->mode == RST_NO_SLIP) return contact;
    if (state->mode != RST_PARTIAL_SLIP) return 0;
    while (n < state->n_contact && l->slip[n] == 0)
        n++;
    if (n == 0 || n == state->n_contact) return n == 0 ? 0 : contact;
    double outermost = l->f[n - 1] - fabs(l->q[n - 1]), neighbour = n > 1 ? l->f[n - 2] - fabs(l->q[n - 2]) : 0;
    return fmin(contact, zero_beyond(scene->spacing, n, outermost, neighbour));
}

static struct rst_sample sample(const struct rst_problem *problem, const struct euler_scene *scene,
                                const struct euler_state *state, const struct layout *l)
{
    double contact = state->n_steps > 0 ? contact_radius(scene, state, l->f) : 0;
    int ended = state->phase == RST_DONE;
    return (struct rst_sample){.time = state->time,
                               .indentation = state->depth,
                               .contact_radius = contact,
                               .stick_radius = state->n_steps > 0 ? stick_radius(scene, state, l, contact) : 0,
                               .normal_force = ended ? 0 : state->true_edge_force,
                               .shear_force = ended ? 0 : state->true_edge_shear,
                               .velocity = state->velocity,
                               .shear_velocity = state->shear_velocity / problem->shear_speed};
}

static int euler_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                        const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error)
{
    struct scout scout;
    struct run run = {.elements = outcome->elements, .step = outcome->step};
    struct euler_scene scene;
    struct layout l;
    look_ahead(problem, workspace, &scout);
    if (prepare(problem, workspace, &scout, &run, 0, &scene, &l))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld elements", (long long)run.elements);
    rst_start_impact(&scene, &run.state, l.x2);
    int64_t intervals = (int64_t)history->capacity - 1;
    int64_t stride = (outcome->steps + intervals - 1) / intervals;
    history->count = 0;
    while (history->count < history->capacity) {
        history->samples[history->count++] = sample(problem, &scene, &run.state, &l);
        if (run.state.phase >= RST_DONE) break;
        advance(&scene, &l, stride, &run.state);
    }
    return RESTITUTE_OK;
}

const struct restitute_method rst_method_euler = {
    .struct_size = sizeof rst_method_euler,
    .number = RST_METHOD_NUMBER,
    .name = "euler",
    .time_limit = 1,
    .updates_per_second = 1e9, /* 0.3 to 3.5 ns each, 1 to 1.6 in the mean: measured, x86-64 */
    .takes_time_step = 1,
    .solve = euler_solve,
    .record = euler_record};
