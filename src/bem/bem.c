/* The method `bem`: pairs of runs on finer grids with smaller steps until they agree.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/bem.h>

#include <math.h>
#include <stdio.h>

#include "bem/box.h"
#include "bem/method.h"

/* Error of the grid times (cells over the radius)^(3/2) (docs/bem.md). */
static const double grid_error_ez = 0.002, grid_error_ex = 0.04;

/* The error of e_x grows with chi up to this value, and for a narrow slip ring. */
static const double largest_chi = 10, thin_slip = 0.1;

/* With very little slip the traction is nearly singular at the edge of the contact. This adds an
 * error of first order in the cells. */
static const double singular = 0.6, singular_slip = 0.01;

/* A solid with nearly no instantaneous compliance oscillates from step to step (solid.h). The error
 * of e_z is up to this without damping, and the usual one if 1 - ringing is above the limit
 * (docs/bem.md). */
static const double most_ringing_error = 0.1, damped_enough = 0.005;

/* Refinement continues only if the estimate falls at least by this factor. */
static const double falls_to = 0.9;

/* Steps of an impact: with 60 cells over the radius if both are chosen here; with any number of
 * cells if that is prescribed. */
static const double usual_elements = 60, usual_steps = 200;

/* The tangential motion in stick is faster than the normal one by sqrt(2 chi); steps are made for
 * chi up to 4. */
static const double usual_chi = 4;

/* No run has so many steps. The limit keeps the number an integer for any prescribed step. */
static const double most_steps = 1e15;

enum { first_elements = 15, most_elements = 2000, most_tries = 8, most_halvings = 12 };

/* Width of the grid over that of the contact; some cells are added. */
static const double margin = 1.03, margin_cells = 1.5;

static int out_of_memory(restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the fields of the method bem");
}

/* What the runs of one impact have in common. */
struct impact {
    const struct rst_problem *problem;
    const struct bem_method *method;
    struct bem_memory *memory;
    struct bem_solid solid;
    struct bem_box box;
    int keep_ledger;
    int64_t updates;
    int halved; /* factor by which steps are smaller than wanted, to be stable */
};

/* Widths whose transforms are fast: products of 2, 3 and 5. */
static int64_t fast_size(double cells)
{
    for (int64_t m = 2 * (int64_t)ceil(cells / 2);; m += 2) {
        int64_t rest = m;
        while (rest % 2 == 0)
            rest /= 2;
        while (rest % 3 == 0)
            rest /= 3;
        while (rest % 5 == 0)
            rest /= 5;
        if (rest == 1) return m;
    }
}

/* A slower rebound counts as none: it changes ez by far less than the tolerance, or than the
 * residuals of the iterations. */
static double rest_speed(const struct rst_problem *problem)
{
    return fmax(1e-5, 0.01 * problem->tolerance);
}

static double duration_of(const struct impact *impact)
{
    return impact->box.sinks ? impact->box.sink_time : impact->box.time;
}

static struct bem_setup setup_of(struct impact *impact, double elements, double step, double spacing)
{
    const struct bem_box *box = &impact->box;
    const double duration = duration_of(impact);
    return (struct bem_setup){.problem = impact->problem,
                              .solid = &impact->solid,
                              .variant = impact->method->variant,
                              .m = fast_size(margin * elements + margin_cells),
                              .spacing = spacing > 0 ? spacing : box->radius / elements,
                              .step = step,
                              .rest_speed = rest_speed(impact->problem),
                              .most_steps = (int64_t)fmin(most_steps, ceil(20 * duration / step)) + 100};
}

/* Usual number of convolutions in a step. */
static const double convolutions_per_step = 12;

static double updates_of(double steps, int64_t m)
{
    return steps * convolutions_per_step * 4 * (double)(m * m);
}

/* Stability of explicit steps may need much smaller steps than accuracy. */
static int may_halve(const struct impact *impact, const struct bem_setup *setup)
{
    const double next = updates_of(2 * duration_of(impact) / setup->step, setup->m);
    return impact->method->variant.explicit_euler && !(impact->problem->time_step > 0) &&
           impact->halved < 1 << most_halvings &&
           (double)impact->updates + next <= (double)impact->problem->max_updates;
}

/* One run. Repeated on a larger grid if the contact outgrows it, or with smaller steps if that is
 * allowed. */
static enum bem_end run_once(struct impact *impact, double elements, double step, int keep_ledger,
                             struct bem_setup *setup, struct bem_run *run)
{
    int outgrown = 0;
    for (;;) {
        *setup = setup_of(impact, elements, step / impact->halved, 0);
        setup->keep_ledger = keep_ledger;
        rst_bem_solid_step(setup->step, impact->method->variant.explicit_euler, &impact->solid);
        rst_bem_run(setup, impact->memory, NULL, run);
        impact->updates += run->updates;
        if (run->end == BEM_OUTGREW && ++outgrown < most_tries)
            impact->box.radius *= 1.1;
        else if (run->end == BEM_UNSETTLED && may_halve(impact, setup))
            impact->halved *= 2;
        else
            return run->end;
    }
}

static int begin(const struct rst_problem *problem, struct rst_workspace *workspace, struct impact *impact,
                 restitute_error *error)
{
    const size_t n = (size_t)problem->solid.n_terms + 1;
    *impact = (struct impact){.problem = problem, .method = (const struct bem_method *)problem->method, .halved = 1};
    if (problem->solid.eta > 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "the solid has a parallel dashpot and so no instantaneous modulus: the method bem cannot do "
                          "it; give a Prony term with a short relaxation time instead, or take another method");
    if (problem->elements > most_elements)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "elements = %lld: must be in [4, %d] with the method bem",
                          (long long)problem->elements, most_elements);
    impact->memory = rst_bem_memory_of(workspace);
    double *terms = impact->memory ? rst_bem_memory_terms(impact->memory, 4 * n) : NULL;
    if (!terms) return out_of_memory(error);
    impact->solid =
        (struct bem_solid){.compliance = terms, .lambda = terms + n, .decay = terms + 2 * n, .gain = terms + 3 * n};
    double shortest, longest;
    rst_bem_solid_creep(&problem->solid, &impact->solid);
    rst_bem_guess_times(&problem->solid, &shortest, &longest);
    rst_bem_solid_prune(shortest, longest, &impact->solid);
    return RESTITUTE_OK;
}

static int find_box(struct impact *impact, restitute_error *error)
{
    const enum bem_end end = rst_bem_find_box(impact->problem, &impact->solid, impact->memory, &impact->box);
    if (end == BEM_REBOUND) {
        rst_bem_solid_prune(duration_of(impact), duration_of(impact), &impact->solid);
        return RESTITUTE_OK;
    }
    if (end == BEM_NO_MEMORY) return out_of_memory(error);
    return rst_report(error, RESTITUTE_ERROR_CONVERGENCE,
                      "the method bem finds no box and step for this solid: its impact and its relaxation are too far "
                      "apart; take another method");
}

static void fill(const struct impact *impact, const struct bem_setup *setup, double elements, const struct bem_run *run,
                 struct rst_outcome *outcome)
{
    const struct bem_motion *q = &run->last;
    const struct bem_work *w = &run->work;
    const int elastic = rst_bem_is_elastic(&impact->solid), sunk = run->end == BEM_SUNK;
    *outcome =
        (struct rst_outcome){.velocity = sunk ? 0 : q->velocity,
                             .shear_velocity = sunk && impact->problem->mode == RST_NO_SLIP ? 0 : q->shear_velocity,
                             .contact_time = sunk ? INFINITY : run->contact_time,
                             .followed_time = q->time,
                             .max_indentation = run->max_depth,
                             .max_contact_radius = rst_bem_radius_of(run->max_area),
                             .max_normal_force = run->max_force / 8,
                             .spacing = setup->spacing,
                             .step = setup->step,
                             .elements = (int64_t)elements,
                             .steps = run->steps,
                             .updates = impact->updates,
                             .sunk = sunk};
    outcome->ledger = (struct rst_ledger){.viscous_z = elastic ? 0 : w->normal - w->left_normal,
                                            .left_z = w->left_normal,
                                            .friction_x = w->friction,
                                            .viscous_x = elastic ? 0 : w->shear - w->friction - w->left_shear,
                                            .left_x = w->left_shear};
}

static double ringing_error(const struct bem_run *run)
{
    return most_ringing_error * fmax(0, 1 - (1 - run->ringing) / damped_enough);
}

/* The finer of two runs, extrapolated, with the error estimated from the coarser one. */
static void compare(const struct impact *impact, const struct bem_run *coarse, const struct bem_run *run,
                    double elements, struct rst_outcome *outcome)
{
    const double slip = impact->problem->mode == RST_NO_SLIP ? 0 : impact->problem->psi;
    const double grid = pow(elements, -1.5), ratio = coarse->step / outcome->step;
    const double harder = fmin(largest_chi, fmax(1, impact->problem->chi));
    const double tangential =
        (1 + thin_slip / (thin_slip + slip)) * grid + singular * singular_slip / (singular_slip + slip) / elements;
    const double part = 1 / ((impact->method->variant.explicit_euler ? ratio : ratio * ratio) - 1); /* by the order */
    const double change = outcome->sunk ? 0 : part * (outcome->velocity - coarse->last.velocity);
    const double shear_change = part * (outcome->shear_velocity - coarse->last.shear_velocity);
    outcome->error_ez = fabs(change) + grid_error_ez * grid + ringing_error(run);
    if (outcome->sunk) outcome->error_ez = rest_speed(impact->problem);
    outcome->velocity += change;
    if (impact->problem->mode == RST_FRICTIONLESS) return;
    outcome->error_ex =
        fabs(shear_change) / impact->problem->shear_speed + grid_error_ex * tangential * harder + outcome->error_ez;
    outcome->shear_velocity += shear_change;
}

static int met(const struct impact *impact, const struct rst_outcome *outcome)
{
    return fmax(outcome->error_ez, outcome->error_ex) <= impact->problem->tolerance;
}

static int not_reached(const struct impact *impact, const struct rst_outcome *outcome, restitute_error *error)
{
    return rst_report(
        error, RESTITUTE_TOLERANCE_NOT_REACHED,
        "tolerance = %g: estimated errors %.2g (ez), %.2g (ex) with %lld cells over the radius and %lld steps",
        impact->problem->asked, outcome->error_ez, outcome->error_ex, (long long)outcome->elements,
        (long long)outcome->steps);
}

static int no_result(const struct impact *impact, enum bem_end end, double step, int late, restitute_error *error)
{
    const struct rst_problem *p = impact->problem;
    if (end == BEM_NO_MEMORY) return out_of_memory(error);
    if (end == BEM_TOO_LONG)
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "the contact lasts too long for steps of %.3g %s",
                          step * p->time_unit, p->unit_name);
    if (end == BEM_REBOUND || end == BEM_SUNK) /* one run only, nothing to compare it with */
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "%s: too little for the two runs of a result; raise it",
                          rst_spent(p, late).text);
    return rst_report(error, RESTITUTE_ERROR_UNSTABLE_STEP,
                      "steps of %.6g %s: unstable or contact not found; take a smaller time_step or another method",
                      step * p->time_unit, p->unit_name);
}

static double steps_wanted(const struct impact *impact, double elements)
{
    const double faster =
        impact->problem->mode == RST_FRICTIONLESS ? 1 : sqrt(fmax(1, impact->problem->chi / usual_chi));
    return usual_steps * faster * elements / usual_elements;
}

static int too_long_a_step(const struct impact *impact, double step, restitute_error *error)
{
    const struct rst_problem *p = impact->problem;
    const double duration = duration_of(impact);
    if (2 * step < duration) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_UNSTABLE_STEP,
                      "time_step = %.6g %s: must be below half the time of contact, which is about %.3g %s",
                      step * p->time_unit, p->unit_name, duration * p->time_unit, p->unit_name);
}

static int too_many_steps(struct impact *impact, double elements, double step, restitute_error *error)
{
    const struct rst_problem *p = impact->problem;
    const double updates = updates_of(duration_of(impact) / step, setup_of(impact, elements, step, 0).m);
    if (updates <= (double)p->max_updates) return RESTITUTE_OK;
    return rst_report(
        error, RESTITUTE_ERROR_TOO_MUCH_WORK,
        "max_work = %g: some %.2g are needed for %lld cells over the radius and steps of %.3g %s; raise it",
        p->max_work, updates / p->method->updates_per_second, (long long)elements, step * p->time_unit, p->unit_name);
}

/* Elements or step prescribed: one run with them, and one with half the cells and twice the
 * step. */
static int solve_prescribed(struct impact *impact, struct rst_outcome *outcome, restitute_error *error)
{
    const struct rst_problem *p = impact->problem;
    const double duration = duration_of(impact);
    const double elements = p->elements > 0 ? (double)p->elements : usual_elements;
    const double step = p->time_step > 0 ? p->time_step : duration / steps_wanted(impact, usual_elements);
    struct bem_setup setup, beside;
    struct bem_run run, coarse;
    int status = too_long_a_step(impact, step, error);
    if (!status) status = too_many_steps(impact, elements, step, error);
    if (status) return status;
    const enum bem_end end_of_coarse = run_once(impact, elements / 2, 2 * step, 0, &beside, &coarse);
    if (end_of_coarse == BEM_NO_MEMORY) return out_of_memory(error);
    const enum bem_end end = run_once(impact, elements, step, impact->keep_ledger, &setup, &run);
    if (end != BEM_REBOUND && end != BEM_SUNK) return no_result(impact, end, step, 0, error);
    fill(impact, &setup, elements, &run, outcome);
    if (end_of_coarse == end)
        compare(impact, &coarse, &run, elements, outcome);
    else
        outcome->error_ez = outcome->error_ex = 1; /* nothing is known but |e| <= 1 */
    return met(impact, outcome) ? RESTITUTE_OK : not_reached(impact, outcome, error);
}

static int solve_refining(struct impact *impact, struct rst_outcome *outcome, restitute_error *error)
{
    const double duration = duration_of(impact);
    struct bem_setup setup;
    struct bem_run run, coarse = {.end = BEM_UNSETTLED};
    int found = 0, late = 0;
    enum bem_end end = BEM_UNSETTLED;
    double step = 0, last_worst = 0;
    for (double elements = first_elements; elements <= most_elements; elements *= 2) {
        step = duration / steps_wanted(impact, elements);
        const int64_t before = impact->updates;
        const double left = rst_time_left(impact->problem);
        end = run_once(impact, elements, step, impact->keep_ledger, &setup, &run);
        if (end == BEM_NO_MEMORY) return out_of_memory(error);
        if ((end == BEM_REBOUND || end == BEM_SUNK) && coarse.end == end) {
            fill(impact, &setup, elements, &run, outcome);
            compare(impact, &coarse, &run, elements, outcome);
            if (met(impact, outcome)) return RESTITUTE_OK;
            const double worst = fmax(outcome->error_ez, outcome->error_ex);
            if (found && ringing_error(&run) > 0 && worst > falls_to * last_worst) break; /* it would take years */
            last_worst = worst;
            found = 1;
        }
        coarse = run;
        /* the next run takes some ten times as much as this one, which began with `left` seconds */
        late = rst_lacks_time(impact->problem, 10, left);
        const double next = (double)impact->updates + 10 * (double)(impact->updates - before);
        if (late || next > (double)impact->problem->max_updates) break;
    }
    return found ? not_reached(impact, outcome, error) : no_result(impact, end, step, late, error);
}

static int bem_solve(const struct rst_problem *problem, struct rst_workspace *workspace, int keep_ledger,
                     struct rst_outcome *outcome, restitute_error *error)
{
    struct impact impact;
    int status = begin(problem, workspace, &impact, error);
    if (!status) status = find_box(&impact, error);
    if (status) return status;
    impact.keep_ledger = keep_ledger;
    status = problem->elements > 0 || problem->time_step > 0 ? solve_prescribed(&impact, outcome, error)
                                                             : solve_refining(&impact, outcome, error);
    return status == RESTITUTE_OK ? rst_done(error) : status;
}

/* Takes samples of a run, evenly spaced over its steps, and snapshots for a recorder. */
struct sampler {
    struct bem_observer observer;
    const struct rst_outcome *outcome;
    struct rst_history *history;
    struct restitute_bem_recorder *recorder;
    int failed;
};

static void add_sample(struct sampler *sampler, double shear_speed, const struct bem_motion *q)
{
    sampler->history->samples[sampler->history->count++] =
        (struct rst_sample){.time = q->time,
                            .indentation = q->depth,
                            .contact_radius = rst_bem_radius_of(q->contact),
                            .stick_radius = rst_bem_radius_of(q->stick),
                            .normal_force = q->force / 8,
                            .shear_force = q->shear_force / 8,
                            .velocity = q->velocity,
                            .shear_velocity = q->shear_velocity / shear_speed};
}

static void see(struct bem_observer *observer, const struct bem_setup *setup, const struct bem_run *run,
                const struct bem_motion *motion, const struct bem_fields *fields)
{
    struct sampler *s = (struct sampler *)observer;
    struct bem_motion q = *motion;
    const int64_t intervals = (int64_t)s->history->capacity - 1, steps = s->outcome->steps;
    const int64_t wanted = (int64_t)s->history->count * steps / intervals; /* the step of the next sample */
    if (s->recorder && rst_bem_recorder_see(s->recorder, setup, run->steps, steps, motion, fields)) s->failed = 1;
    if (s->history->count == s->history->capacity || run->steps < wanted) return;
    if (run->steps == steps && !s->outcome->sunk) { /* contact ends within the last step; after that the sphere flies */
        q.depth -= q.velocity * (q.time - s->outcome->contact_time);
        q.time = s->outcome->contact_time;
        q.contact = q.stick = q.force = q.shear_force = 0;
    }
    add_sample(s, setup->problem->shear_speed, &q);
}

static int bem_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                      const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error)
{
    struct impact impact;
    struct bem_run run;
    const int status = begin(problem, workspace, &impact, error);
    if (status) return status;
    struct sampler sampler = {
        .observer = {.see = see}, .outcome = outcome, .history = history, .recorder = impact.method->recorder};
    impact.box.time = outcome->followed_time;
    rst_bem_solid_prune(outcome->followed_time, outcome->followed_time, &impact.solid);
    rst_bem_solid_step(outcome->step, impact.method->variant.explicit_euler, &impact.solid);
    const struct bem_setup setup = setup_of(&impact, (double)outcome->elements, outcome->step, outcome->spacing);
    history->count = 0;
    if (sampler.recorder) rst_bem_recorder_begin(sampler.recorder);
    add_sample(&sampler, problem->shear_speed,
               &(struct bem_motion){.velocity = 1, .shear_velocity = problem->shear_speed});
    rst_bem_run(&setup, impact.memory, &sampler.observer, &run);
    return run.end == BEM_NO_MEMORY || sampler.failed ? out_of_memory(error) : RESTITUTE_OK;
}

/* What is counted are the cells of convolutions: 6 ns each, 5.8 to 6.6 (measured, x86-64). */
#define UPDATES_PER_SECOND 1.5e8

#define BASE(its_name)                                                                                                 \
    {                                                                                                                  \
        .struct_size = sizeof(struct restitute_method), .number = RST_METHOD_NUMBER, .name = (its_name),               \
        .time_limit = INFINITY, .updates_per_second = UPDATES_PER_SECOND, .takes_time_step = 1, .takes_all_terms = 1,  \
        .solve = bem_solve, .record = bem_record                                                                       \
    }
const struct bem_method rst_bem_standard = {.base = BASE("bem")};
static const struct bem_method of_the_paper = {.base = BASE("bem-paper"),
                                               .variant = {.explicit_euler = 1, .stick_sets = 1}};

const restitute_method *restitute_method_bem(void)
{
    return &rst_bem_standard.base;
}

const restitute_method *restitute_method_bem_paper(void)
{
    return &of_the_paper.base;
}
