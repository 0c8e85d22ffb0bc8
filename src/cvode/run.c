/* Follows one impact: compression, restitution and, with a tangential side, gross slip before it
 * (docs/theory.md, section 4).
 *
 * CVODE restarts at the end of gross slip and at the largest indentation, where the formula of the
 * force changes. It also restarts where elements stick again, if treating them as slipping for the
 * rest of the step would be too inaccurate. At entries, exits and stick -> slip the right-hand side
 * is continuous, and CVODE is not interrupted.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/gross_slip.h"

/* Root functions before those of the elements. */
enum { ROOT_PHASE, ROOT_SLIP_END, ROOT_ENTRY, ROOT_EXIT, ROOTS };

/* Knots of the trace are at most this far apart, in units of the depth scale times the fourth root
 * of the error of a step: Hermite's cubic between them, of fourth order, then errs by less than a
 * hundredth of that. */
static const double knot_factor = 0.5;

/* Functions of elements that are 0 by construction are shifted by this share of the allowed error,
 * so that CVODE does not report events. An element changes its motion later by as much. */
static const double shift_of_root = 1e-3;

/* If some elements already stuck within a step, the step is repeated if this changed U' by more
 * than this share of the allowed error. */
static const double late_part = 1;

/* A small velocity of a sphere that may sink in is computed more accurately: errors must not change
 * its sign while it is compared with rest_speed. */
static const double sinking_scale = 0.02;

/* Below this psi tangential stresses are much smaller than normal ones almost everywhere. */
static const double mostly_sticks = 0.2;

/* Error of the states over the error of a step (docs/cvode.md). */
static const double error_margin = 100;

static size_t position_of_shear(const struct cvode_scene *scene)
{
    return 2 + 2 * (size_t)scene->n_terms;
}

double rst_run_velocity(const struct run *run, const double *y)
{
    (void)run;
    return y[1];
}

/* In gross slip U' follows from D' (27); without friction U' is constant. */
double rst_run_shear_velocity(const struct run *run, const double *y)
{
    if (run->shears) return y[position_of_shear(&run->scene) + 1];
    return rst_slipping_velocity(run->setup->problem, y[1]);
}

double rst_run_stick_radius(const struct run *run)
{
    const struct elements *e = &run->elements;
    int64_t i = run->inside;
    if (!run->shears || i == 0) return 0;
    if (run->scene.mode == RST_NO_SLIP) return run->contact.radius;
    while (i > 0 && !(e->motion[i - 1] == RST_ELEMENT_STICKS && e->d[i - 1] > 0 && e->d[i - 1] < 2 * e->f[i - 1]))
        i--;
    if (i == run->inside) return run->contact.radius;
    return i > 0 ? e->x[i - 1] : 0;
}

static void evaluate(struct run *run, double t, const double *y, double *rate)
{
    const struct rst_solid *s = &run->setup->problem->solid;
    const struct elements *e = &run->elements;
    rst_cvode_normal_rates(&run->scene, s->g, s->tau, run->trace->knot, run->trace->memory, &run->near, t, y, rate,
                           &run->contact);
    if (!run->shears) return;
    rst_cvode_margins(&run->scene, s->g, s->tau, &run->contact, e->x, e->entry, e->past, e->shift, e->c, e->b,
                      e->layer_weight, run->start_y, run->start_rate, t, y, &run->inside, e->d, e->f, e->layer);
    struct cvode_contact contact = run->contact;
    if (run->setup->problem->shear_speed < mostly_sticks || run->scene.mode == RST_NO_SLIP)
        rst_cvode_force_by_rule(&run->scene, s->tau, &run->contact, e->x, e->entry, e->past, e->c, e->layer_weight,
                                run->inside, e->f, t, y, &contact.force);
    rst_cvode_shear_rates(&run->scene, s->g, s->tau, &contact, e->x, e->entry, e->motion, run->inside, e->d, e->f,
                          e->layer, t, y, rate, &run->sums);
}

/* ---- what CVODE calls */

static int call_rates(void *owner, double t, const double *y, double *rate)
{
    struct run *run = owner;
    evaluate(run, t, y, rate);
    double sum = 0;
    for (int64_t i = 0; i < run->scene.n_states; i++)
        sum += rate[i];
    return !isfinite(sum);
}

static double error_scale(const struct run *run)
{
    return run->setup->closeness * fmin(1, run->setup->problem->shear_speed);
}

/* Threshold below which a value that is 0 by construction counts as 0. */
static double nearly(const struct run *run)
{
    return shift_of_root * error_scale(run);
}

static void call_roots(void *owner, double t, const double *y, double *value)
{
    struct run *run = owner;
    const struct elements *e = &run->elements;
    evaluate(run, t, y, run->scratch);
    value[ROOT_PHASE] = run->scene.restitution ? run->contact.square : y[1];
    value[ROOT_SLIP_END] = run->shears ? 1 : y[1] - run->slip_end; /* after it D' may stay there, which CVODE refuses */
    value[ROOT_ENTRY] = value[ROOT_EXIT] = 1;
    if (run->log && run->setup->n_nodes > 0) {
        if (!run->scene.restitution && run->next_entry < run->setup->n_nodes)
            value[ROOT_ENTRY] = e->x[run->next_entry] * e->x[run->next_entry] - run->contact.square;
        if (run->scene.restitution && run->outermost > 0)
            value[ROOT_EXIT] = run->contact.square - e->x[run->outermost] * e->x[run->outermost];
    }
    if (!run->shears) return;
    const double least = nearly(run);
    rst_cvode_slip_rates(&run->scene, e->motion, run->inside, run->recovery.rate, run->recovery.u, e->amplitude, least,
                         least, e->d, e->f, t, y, value + ROOTS);
}

static void call_newton(void *owner, double gamma, const double *y, const double *b, double *x)
{
    struct run *run = owner;
    const struct rst_solid *s = &run->setup->problem->solid;
    rst_cvode_solve_newton(&run->scene, s->g, s->tau, &run->contact, &run->sums, gamma, y, b, x);
}

/* Error weights: relative for states that may grow, absolute for the others, by the scales of the
 * impact: velocities 1 (tangential ones psi), stresses those that stop the sphere. */
static void call_weights(void *owner, const double *y, double *weight)
{
    const struct run *run = owner;
    const struct run_setup *s = run->setup;
    const double close = s->closeness, stress = 1 / (s->depth * sqrt(s->depth));
    const size_t n = (size_t)s->problem->solid.n_terms, shear = position_of_shear(&run->scene);
    weight[0] = 1 / (close * fmax(s->depth, fabs(y[0])));
    weight[1] = 1 / (close * (s->problem->solid.can_sink ? fmax(sinking_scale, fabs(y[1])) : 1));
    for (size_t k = 0; k < n; k++) {
        weight[2 + k] = 1 / (close * fmax(stress, fabs(y[2 + k])));
        weight[2 + n + k] = 1 / (close * fmax(stress * sqrt(s->depth), fabs(y[2 + n + k])));
    }
    if (!run->shears) return;
    const double share = fmin(1, s->problem->shear_speed);
    weight[shear] = 1 / (close * share * fmax(s->depth, fabs(y[shear])));
    weight[shear + 1] = 1 / (close * share);
    for (size_t k = 0; k < n; k++)
        weight[shear + 2 + k] = 1 / (close * share * fmax(stress, fabs(y[shear + 2 + k])));
}

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

static int fail(struct run *run, int status, const char *text)
{
    snprintf(run->text, sizeof run->text, "%s", text);
    return status;
}

/* Positions of the elements, equally spaced in the angle of the edge; when the edge passed them;
 * and the memory that elements start with. */
static void place_elements(struct run *run)
{
    const int64_t n = run->setup->n_nodes, terms = run->scene.n_terms;
    struct elements *e = &run->elements;
    double *past = run->look; /* holds more than that */
    for (int64_t i = 0; i < n; i++) {
        e->x[i] = run->setup->radius * sin(asin(1.0) * (double)i / (double)n);
        e->entry[i] = i > 0 ? rst_trace_time(run->trace, e->x[i] * e->x[i]) : 0;
        e->motion[i] = RST_ELEMENT_STICKS;
        rst_cvode_past(&run->scene, run->trace->knot, run->trace->memory, e->entry[i], past);
        for (int64_t k = 0; k < terms; k++)
            e->past[k * n + i] = i > 0 ? past[k] : 0;
    }
    rst_cvode_layer_weights(&run->scene, run->setup->problem->solid.tau, e->entry, e->layer_weight);
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
        return fail(run, RESTITUTE_ERROR_MEMORY, "out of memory");
    lay_out(run, run->doubles);
    if (n == 0) {
        rst_trace_begin(run->trace, k);
        return RESTITUTE_OK;
    }
    place_elements(run);
    struct recovery *r = &run->recovery;
    rst_cvode_recovery_modes(k, run->scene.n_modes, solid->g_inf, solid->eta, solid->g, solid->tau, run->doubles + size,
                             r->rate, r->u, r->v, r->from_u, r->from_v);
    return RESTITUTE_OK;
}

static void count_work(struct run *run)
{
    if (!run->integrator) return;
    const struct integrator_counts work = rst_integrator_work(run->integrator);
    const int64_t inside = run->shears ? run->setup->n_nodes : 1;
    run->work.steps += work.steps;
    run->work.restarts += work.restarts;
    run->work.rates += work.rates;
    run->work.roots += work.roots;
    run->updates += (work.rates + work.roots) * inside * (1 + run->scene.n_terms);
    rst_integrator_destroy(run->integrator);
    run->integrator = NULL;
}

static int64_t spent(const struct run *run)
{
    const struct integrator_counts work = rst_integrator_work(run->integrator);
    const int64_t inside = run->shears ? run->setup->n_nodes : 1;
    return run->updates + (work.rates + work.roots) * inside * (1 + run->scene.n_terms);
}

void rst_run_release(struct run *run)
{
    count_work(run);
    free(run->doubles); /* run->y is gone with it */
    free(run->elements.motion);
    free(run->elements.change);
    run->doubles = NULL;
    run->elements.motion = NULL;
    run->elements.change = NULL;
}

/* A new CVODE for the states that there are now. */
static int integrate_from(struct run *run)
{
    if (run->integrator) run->work.restarts++; /* the first one is a start */
    count_work(run);
    const struct integrator_system system = {.n_states = run->scene.n_states,
                                             .n_roots = ROOTS + (run->shears ? run->scene.n_nodes : 0),
                                             .family = run->setup->family,
                                             .horizon = run->setup->depth,
                                             .rates = call_rates,
                                             .roots = call_roots,
                                             .newton = call_newton,
                                             .weights = call_weights,
                                             .owner = run};
    return rst_integrator_create(&system, run->time, run->y, &run->integrator, run->text, sizeof run->text);
}

/* ---- elements */

static void fade_to(struct run *run, double t)
{
    const struct elements *e = &run->elements;
    rst_cvode_fade(&run->scene, run->setup->problem->solid.tau, run->recovery.rate, t, e->c, e->b, e->amplitude);
    run->scene.reference = t;
}

/* Set the memory of the elements that have entered by now. Nonzero: CVODE cannot interpolate so far
 * back. */
static int admit(struct run *run, double t)
{
    const struct elements *e = &run->elements;
    fade_to(run, t);
    if (run->scene.restitution) return 0;
    while (run->scene.n_entered < run->scene.n_nodes && e->entry[run->scene.n_entered] <= t) {
        const int64_t i = run->scene.n_entered;
        const double entry = fmax(e->entry[i], run->scene.step_start);
        const double *y = run->start_y;
        if (entry > run->scene.step_start) {
            if (rst_integrator_look(run->integrator, entry, run->look)) return 1;
            y = run->look;
        }
        run->scene.n_entered++;
        rst_cvode_enter_element(&run->scene, run->setup->problem->solid.tau, i + 1, entry, e->past, y, e->motion,
                                e->shift, e->c, e->b, e->amplitude);
    }
    return 0;
}

/* A step begins here. */
static void begin_step(struct run *run)
{
    run->scene.step_start = run->time;
    if (!run->shears) return;
    memcpy(run->start_y, run->y, (size_t)run->scene.n_states * sizeof *run->y);
    evaluate(run, run->time, run->y, run->start_rate);
}

/* All elements in contact stick with the force of gross slip: the tangential memory equals the
 * normal one, and with U = D nothing else is needed. */
static void take_over_gross_slip(struct run *run)
{
    const struct elements *e = &run->elements;
    const int64_t n = run->scene.n_nodes, terms = run->scene.n_terms;
    const double *tau = run->setup->problem->solid.tau;
    double *shear = run->y + position_of_shear(&run->scene);
    shear[0] = run->y[0];
    shear[1] = run->slip_end;
    memcpy(shear + 2, run->y + 2, (size_t)terms * sizeof *shear);
    run->scene.n_entered = 0;
    for (int64_t i = 0; i < n && (run->scene.restitution || e->entry[i] <= run->time); i++) {
        e->shift[i] = e->x[i] * e->x[i];
        for (int64_t k = 0; k < terms; k++) {
            e->c[k * n + i] = exp(-fmax(0, run->time - e->entry[i]) / tau[k]) * e->past[k * n + i];
            e->b[k * n + i] = 0;
        }
        run->scene.n_entered++;
    }
}

static int begin_shear(struct run *run, int after_gross_slip)
{
    run->shears = 1;
    run->scene.n_states = 4 + 3 * run->scene.n_terms;
    run->scene.reference = run->scene.step_start = run->time;
    if (after_gross_slip)
        take_over_gross_slip(run);
    else
        run->y[position_of_shear(&run->scene) + 1] = run->setup->problem->shear_speed;
    const int status = integrate_from(run);
    if (!status) begin_step(run);
    return status;
}

/* ---- events */

static int note(struct run *run, int kind, double position, int elements)
{
    run->event_count++;
    if (!run->log) return RESTITUTE_OK;
    const restitute_cvode_event event = {.time = run->time,
                                         .position = position,
                                         .indentation = run->y[0],
                                         .normal_velocity = run->y[1],
                                         .tangential_velocity = rst_run_shear_velocity(run, run->y),
                                         .kind = kind,
                                         .elements = elements};
    return rst_log_add(run->log, &event) ? fail(run, RESTITUTE_ERROR_MEMORY, "out of memory for events") : RESTITUTE_OK;
}

/* Error of U' at the end of CVODE's step, over a weight of contact, if elements that stick from now
 * on are treated as slipping. */
static double suffered(struct run *run, double weight)
{
    const struct rst_solid *s = &run->setup->problem->solid;
    const double reached = rst_integrator_reached(run->integrator), late = reached - run->time;
    double stiffness = s->g_inf;
    for (int64_t k = 0; k < s->n_terms; k++)
        stiffness += s->g[k];
    if (late <= 0 || rst_integrator_look(run->integrator, reached, run->look)) return 0;
    const double *now = run->y, *then = run->look;
    const size_t v = position_of_shear(&run->scene) + 1;
    const double slip =
        fabs(then[v] - now[v]) + fabs(then[1] - now[1]); /* not less than the velocity of the wrong slip */
    return 2 * rst_mass_factor() * run->setup->problem->chi * weight * late * slip *
           (s->eta / 2 + stiffness * late / 6);
}

/* The functions of the elements, of the margins last computed. */
static void watch(struct run *run)
{
    const struct elements *e = &run->elements;
    rst_cvode_slip_rates(&run->scene, e->motion, run->inside, run->recovery.rate, run->recovery.u, e->amplitude, 0, 0,
                         e->d, e->f, run->time, run->y, e->value);
}

/* At an event: elements whose change CVODE found; and elements from `first` on, which entered with
 * slip since its last return and whose slip has ended, since CVODE did not watch them. */
static void find_changes(struct run *run, int64_t first, const int *fell)
{
    const struct elements *e = &run->elements;
    watch(run);
    for (int64_t i = 0; i < run->inside; i++)
        e->change[i] = fell[i] || (i >= first && e->motion[i] != RST_ELEMENT_STICKS && e->value[i] <= nearly(run));
}

/* At the end of a step: elements that are past their change by more than the error. They entered
 * and changed within the step. */
static int find_late(struct run *run)
{
    const struct elements *e = &run->elements;
    const double depth = run->setup->depth, velocity = error_margin * error_scale(run);
    const double stress = error_margin * run->setup->closeness / (depth * sqrt(depth));
    int late = 0;
    watch(run);
    for (int64_t i = 0; i < run->inside; i++) {
        e->change[i] = e->value[i] < -(e->motion[i] == RST_ELEMENT_STICKS ? stress : velocity);
        late |= e->change[i];
    }
    return late;
}

/* Change the motion of the marked elements. */
static int change_motion(struct run *run, int *restart)
{
    const struct elements *e = &run->elements;
    const struct rst_solid *s = &run->setup->problem->solid;
    int slipping = 0, sticking = 0, status = RESTITUTE_OK;
    double slip_at = 0, stick_at = 0, weight = 0;
    for (int64_t i = 0; i < run->inside; i++) {
        if (!e->change[i]) continue;
        if (e->motion[i] == RST_ELEMENT_STICKS) {
            rst_cvode_begin_slip(&run->scene, s->g, e->x, i + 1, e->d, e->f, run->recovery.from_u, run->recovery.from_v,
                                 e->shift, e->c, e->b, run->y, e->motion, e->amplitude);
            slip_at = e->x[i];
            slipping++;
        } else {
            rst_cvode_begin_stick(&run->scene, s->g, e->x, i + 1, run->recovery.u, run->recovery.v, e->shift, e->c,
                                  e->b, run->y, e->motion, e->amplitude);
            stick_at = e->x[i];
            sticking++;
            weight += 0.5 * ((i + 1 < run->inside ? e->x[i + 1] : run->contact.radius) - (i > 0 ? e->x[i - 1] : 0));
        }
    }
    if (slipping) status = note(run, RESTITUTE_CVODE_EVENT_STICK_TO_SLIP, slip_at, slipping);
    if (sticking && !status) status = note(run, RESTITUTE_CVODE_EVENT_SLIP_TO_STICK, stick_at, sticking);
    if (sticking && suffered(run, weight) > late_part * error_scale(run)) *restart = 1;
    return status;
}

/* From here on the right-hand side is another one. */
static int restart(struct run *run)
{
    begin_step(run);
    if (rst_integrator_restart(run->integrator, run->time, run->y) == 0) return RESTITUTE_OK;
    return fail(run, RESTITUTE_ERROR_INTEGRATOR, rst_integrator_text(run->integrator));
}

static int end_contact(struct run *run)
{
    run->ended = 1;
    return note(run, RESTITUTE_CVODE_EVENT_CONTACT_END, 0, 1);
}

/* If the solid has relaxed completely, contact may already have ended: no function would fall
 * through 0. */
static int turn(struct run *run)
{
    run->y[1] = 0;
    run->max_depth = run->y[0];
    run->max_time = run->time;
    if (run->setup->n_nodes == 0) run->scene.n_knots = run->trace->count;
    run->near = run->scene.n_knots - 1;
    int status = note(run, RESTITUTE_CVODE_EVENT_TURN, sqrt(run->y[0]), 0);
    run->scene.restitution = 1;
    run->outermost = run->next_entry - 1;
    if (!status) status = restart(run);
    evaluate(run, run->time, run->y, run->scratch);
    return status || run->contact.square > 0 ? status : end_contact(run);
}

/* All stick that have slipped since first touch. */
static int end_gross_slip(struct run *run)
{
    int inside = 0;
    for (int64_t i = 0; i < run->setup->n_nodes; i++)
        inside += run->elements.x[i] * run->elements.x[i] < run->contact.square;
    run->y[1] = run->slip_end;
    const int status = note(run, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END, run->contact.radius, inside);
    return status ? status : begin_shear(run, 1);
}

/* Gross slip may end at the same instant (psi = 2 chi). After a restart on that root CVODE would
 * not find it. */
static int turn_and_stick(struct run *run)
{
    const int both = !run->shears && run->setup->n_nodes > 0 && fabs(run->slip_end) <= nearly(run);
    const int status = turn(run);
    return status || !both || run->ended ? status : end_gross_slip(run);
}

static int react(struct run *run, int64_t first)
{
    const int *fell = rst_integrator_events(run->integrator);
    int status = RESTITUTE_OK, again = 0;
    evaluate(run, run->time, run->y, run->scratch);
    if (fell[ROOT_ENTRY]) {
        status = note(run, RESTITUTE_CVODE_EVENT_ENTRY, run->elements.x[run->next_entry], 1);
        run->next_entry++;
    }
    if (fell[ROOT_EXIT] && !status) {
        status = note(run, RESTITUTE_CVODE_EVENT_EXIT, run->elements.x[run->outermost], 1);
        run->outermost--;
    }
    if (run->shears && !status) {
        find_changes(run, first, fell + ROOTS);
        status = change_motion(run, &again);
        if (!status && again && !fell[ROOT_PHASE]) return restart(run);
    }
    if (status) return status;
    if (fell[ROOT_PHASE] && run->scene.restitution) return end_contact(run);
    if (fell[ROOT_PHASE]) return turn_and_stick(run);
    if (fell[ROOT_SLIP_END] && !run->shears && run->setup->n_nodes > 0) return end_gross_slip(run);
    return RESTITUTE_OK;
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
                return fail(run, RESTITUTE_ERROR_INTERNAL, "CVODE does not know its last step");
            y = run->look;
        }
        if (rst_trace_add(run->trace, t, y[0], y[1], y + 2))
            return fail(run, RESTITUTE_ERROR_MEMORY, "out of memory for the trace");
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

/* A step without an event, or its part after the last event. */
static int end_step(struct run *run)
{
    int status = RESTITUTE_OK, again = 0;
    begin_step(run);
    if (!run->shears || run->scene.mode == RST_NO_SLIP || !find_late(run)) return status;
    status = change_motion(run, &again);
    begin_step(run);
    return status;
}

/* One return of CVODE. */
static int advance(struct run *run)
{
    const double from = run->time;
    const int64_t first = run->scene.n_entered;
    const enum integrator_return what = rst_integrator_advance(run->integrator, &run->time, run->y);
    if (what == INTEGRATOR_FAILED) return fail(run, RESTITUTE_ERROR_INTEGRATOR, rst_integrator_text(run->integrator));
    if (run->sample) run->sample(run);
    if (run->shears && admit(run, run->time))
        return fail(run, RESTITUTE_ERROR_INTERNAL, "CVODE does not know its last step");
    int status = run->setup->n_nodes == 0 && !run->scene.restitution ? extend_trace(run, from) : RESTITUTE_OK;
    if (status) return status;
    if (run->observe) run->observe(run, from, run->time);
    status = what == INTEGRATOR_EVENT ? react(run, first) : end_step(run);
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
    } else if (spent(run) > s->budget) {
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
        return fail(run, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (setup->n_nodes > 0) status = note(run, RESTITUTE_CVODE_EVENT_ENTRY, 0, 1);
    if (status) return status;
    status = friction && problem->mode != RST_GROSS_SLIP ? begin_shear(run, 0) : integrate_from(run);
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

void rst_run_evaluate(struct run *run)
{
    evaluate(run, run->time, run->y, run->scratch);
}

int rst_run_look(struct run *run, double t, const double **y)
{
    if (rst_integrator_look(run->integrator, t, run->look)) return 1;
    *y = run->look;
    evaluate(run, t, run->look, run->scratch);
    return 0;
}
