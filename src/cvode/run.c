/* Follows one impact: compression, restitution and, with a tangential side, gross slip before it
 * (docs/theory.md, section 4).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/gross_slip.h"
#include "cvode/elements.h"
#include "cvode/events.h"

/* Knots of the trace are at most this far apart, in units of the depth scale times the fourth root
 * of the error of a step: Hermite's cubic between them, of fourth order, then errs by less than a
 * hundredth of that. */
static const double knot_factor = 0.5;

/* ---- memory */

/* Take memory from a block; without a block only count it. */
struct taken {
    double *block;
    int64_t count;
};

static double *take(struct taken *taken, int64_t count)
{
    double *start = taken->block ? taken->block + taken->count : NULL;
    taken->count += count;
    return start;
}

static int64_t lay_out(struct run *run, double *block)
{
    struct elements *e = &run->elements;
    struct recovery *r = &run->recovery;
    const int64_t n = run->setup->n_nodes, k = run->scene.n_terms, m = run->scene.n_modes, states = 4 + 3 * k;
    struct taken place = {block, 0};
    e->x = take(&place, n);
    e->entry = take(&place, n);
    e->shift = take(&place, n);
    e->value = take(&place, n);
    e->d = take(&place, n);
    e->f = take(&place, n);
    e->layer = take(&place, n);
    e->past = take(&place, n * k);
    e->layer_weight = take(&place, n * k);
    e->c = take(&place, n * k);
    e->b = take(&place, n * k);
    e->amplitude = take(&place, n * m);
    r->rate = take(&place, m);
    r->u = take(&place, m);
    r->v = take(&place, k * m);
    r->from_u = take(&place, m);
    r->from_v = take(&place, k * m);
    run->y = take(&place, states);
    run->start_y = take(&place, states);
    run->start_rate = take(&place, states);
    run->look = take(&place, states);
    run->scratch = take(&place, states);
    return place.count;
}

static int prepare(struct run *run)
{
    const struct run_setup *s = run->setup;
    const struct rst_solid *solid = &s->problem->solid;
    const int64_t k = solid->n_terms, n = s->n_nodes;
    run->scene = (struct cvode_scene){.chi = s->problem->chi,
                                      .g_inf = solid->g_inf,
                                      .eta = solid->eta,
                                      .n_terms = k,
                                      .n_modes = k + (solid->eta > 0),
                                      .n_states = 2 + 2 * k,
                                      .n_knots = run->trace->count,
                                      .n_nodes = n,
                                      .mode = s->problem->mode};
    run->near = 1;
    const size_t size = (size_t)lay_out(run, run->doubles), modes = (size_t)run->scene.n_modes;
    run->doubles = calloc(size + 2 * modes * modes, sizeof(double));
    run->elements.motion = calloc((size_t)n + 1, sizeof *run->elements.motion);
    run->elements.change = calloc((size_t)n + 1, sizeof *run->elements.change);
    if (!run->doubles || !run->elements.motion || !run->elements.change)
        return rst_run_fail(run, RESTITUTE_ERROR_MEMORY, "out of memory");
    lay_out(run, run->doubles);
    if (n == 0) {
        rst_trace_begin(run->trace, k);
        return RESTITUTE_OK;
    }
    rst_run_place_elements(run);
    struct recovery *r = &run->recovery;
    rst_cvode_recovery_modes(k, run->scene.n_modes, solid->g_inf, solid->eta, solid->g, solid->tau, run->doubles + size,
                             r->rate, r->u, r->v, r->from_u, r->from_v);
    return RESTITUTE_OK;
}

void rst_run_release(struct run *run)
{
    rst_run_count_work(run);
    free(run->doubles); /* run->y is gone with it */
    free(run->elements.motion);
    free(run->elements.change);
    run->doubles = NULL;
    run->elements.motion = NULL;
    run->elements.change = NULL;
}

/* ---- following */

/* Knots of the trace within the step that led from `from` to run->time. */
static int extend_trace(struct run *run, double from)
{
    const double spacing = knot_factor * run->setup->depth * pow(run->setup->closeness, 0.25);
    const int parts = (int)fmin(64, ceil((run->time - from) / spacing));
    for (int i = 1; i <= parts; i++) {
        const double t = i < parts ? from + (run->time - from) * i / parts : run->time;
        const double *y = run->y;
        if (i < parts) {
            if (rst_integrator_look(run->integrator, t, run->look))
                return rst_run_fail(run, RESTITUTE_ERROR_INTERNAL, "CVODE does not know its last step");
            y = run->look;
        }
        if (rst_trace_add(run->trace, t, y[0], y[1], y + 2))
            return rst_run_fail(run, RESTITUTE_ERROR_MEMORY, "out of memory for the trace");
    }
    return RESTITUTE_OK;
}

/* Kinetic energy and twice what the springs could give back, with the mean stress of each over the
 * contact, in units of the impact energy: below rest_speed^2 the sphere has stopped
 * (docs/theory.md, section 6). */
static int is_lost(const struct run *run)
{
    const struct rst_solid *s = &run->setup->problem->solid;
    const double speed = run->y[1], rest = run->setup->rest_speed, *loading = run->y + 2 + s->n_terms;
    if (!s->can_sink || run->scene.restitution || !(speed < rest)) return 0;
    return speed * speed + rst_recoverable_energy(run->y[0], s->g_inf, s->n_terms, s->g, loading) < rest * rest;
}

static void keep_largest(struct run *run)
{
    run->max_force = fmax(run->max_force, run->contact.force);
}

/* One return of CVODE. */
static int advance(struct run *run)
{
    const double from = run->time;
    const int64_t first = run->scene.n_entered;
    const enum integrator_return what = rst_integrator_advance(run->integrator, &run->time, run->y);
    if (what == INTEGRATOR_FAILED)
        return rst_run_fail(run, RESTITUTE_ERROR_INTEGRATOR, rst_integrator_text(run->integrator));
    if (run->sample) run->sample(run);
    if (run->shears && rst_run_admit(run, run->time))
        return rst_run_fail(run, RESTITUTE_ERROR_INTERNAL, "CVODE does not know its last step");
    int status = run->setup->n_nodes == 0 && !run->scene.restitution ? extend_trace(run, from) : RESTITUTE_OK;
    if (status) return status;
    if (run->observe) run->observe(run, from, run->time);
    status = what == INTEGRATOR_EVENT ? rst_run_react(run, first) : rst_run_end_step(run);
    if (run->observe && what == INTEGRATOR_EVENT && !status) run->observe(run, run->time, run->time);
    keep_largest(run);
    return status;
}

/* The clock costs as much as the rates of a few elements. */
static int is_late(struct run *run)
{
    const struct run_setup *s = run->setup;
    enum { steps_between_looks = 16 };
    double (*clock)(void) = s->problem->clock;
    return clock && run->checks++ % steps_between_looks == 0 && clock() > s->until;
}

static int spent_all(struct run *run, int by_time)
{
    const struct run_setup *s = run->setup;
    char what[48] = "the normal motion";
    if (s->n_nodes > 0) snprintf(what, sizeof what, "%lld elements", (long long)s->n_nodes);
    snprintf(run->text, sizeof run->text, "%s: too little for %s", rst_spent(s->problem, by_time).text, what);
    return RESTITUTE_ERROR_TOO_MUCH_WORK;
}

static int check_work(struct run *run)
{
    const struct run_setup *s = run->setup;
    const size_t size = sizeof run->text;
    int status = RESTITUTE_OK;
    if (run->event_count > s->most_events * (s->n_nodes + 4)) {
        status = RESTITUTE_ERROR_CONVERGENCE;
        snprintf(run->text, size,
                 "an event storm: %lld events of %lld elements, which change between stick and slip without end",
                 (long long)run->event_count, (long long)s->n_nodes);
    } else if (rst_integrator_work(run->integrator).steps > s->most_steps) {
        status = RESTITUTE_ERROR_CONVERGENCE;
        snprintf(run->text, size, "more than %lld steps of CVODE", (long long)s->most_steps);
    } else if (rst_run_spent(run) > s->budget) {
        status = spent_all(run, 0);
    } else if (is_late(run)) {
        status = spent_all(run, 1);
    }
    return status;
}

int rst_run_follow(struct run *run, const struct run_setup *setup, struct trace *trace, struct event_log *log)
{
    run->setup = setup;
    run->trace = trace;
    run->log = log;
    int status = prepare(run);
    if (status) return status;
    const struct rst_problem *problem = setup->problem;
    const int friction = setup->n_nodes > 0 && problem->mode != RST_FRICTIONLESS;
    run->y[1] = 1;
    run->next_entry = 1; /* the middle is in contact from the first touch on */
    run->slip_end = -2;
    const double rebound = isfinite(setup->rebound) ? setup->rebound : 0;
    if (friction && problem->mode == RST_GROSS_SLIP && !rst_never_sticks(problem, rebound))
        run->slip_end = rst_end_of_gross_slip(problem);
    if (setup->n_nodes == 0 && rst_trace_add(trace, 0, 0, 1, run->y + 2))
        return rst_run_fail(run, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (setup->n_nodes > 0) status = rst_run_note(run, RESTITUTE_CVODE_EVENT_ENTRY, 0, 1);
    if (status) return status;
    status = friction && problem->mode != RST_GROSS_SLIP ? rst_run_begin_shear(run, 0) : rst_run_integrate_from(run);
    while (!status && !run->ended) {
        status = advance(run);
        if (!status) status = check_work(run);
        if (!status && is_lost(run)) run->ended = run->sunk = 1;
    }
    run->end_velocity = run->y[1];
    run->end_shear_velocity = rst_run_shear_velocity(run, run->y);
    run->depth = run->y[0];
    return status;
}

int rst_run_look(struct run *run, double t, const double **y)
{
    if (rst_integrator_look(run->integrator, t, run->look)) return 1;
    *y = run->look;
    rst_run_rates(run, t, run->look, run->scratch);
    return 0;
}
