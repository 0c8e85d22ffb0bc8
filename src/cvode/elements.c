/* What CVODE integrates (docs/cvode.md): the states of the sphere, and the elements that follow
 * from them between events. CVODE calls for rates, roots, Newton steps and error weights.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/elements.h"

#include <math.h>
#include <string.h>

#include "base/gross_slip.h"

/* Functions of elements that are 0 by construction are shifted by this share of the allowed error,
 * so that CVODE does not report events. An element changes its motion later by as much. */
static const double shift_of_root = 1e-3;

/* A small velocity of a sphere that may sink in is computed more accurately: errors must not change
 * its sign while it is compared with rest_speed. */
static const double sinking_scale = 0.02;

/* Below this psi tangential stresses are much smaller than normal ones almost everywhere. */
static const double mostly_sticks = 0.2;

size_t rst_run_position_of_shear(const struct cvode_scene *scene)
{
    return 2 + 2 * (size_t)scene->n_terms;
}

/* In gross slip U' follows from D' (27); without friction U' is constant. */
double rst_run_shear_velocity(const struct run *run, const double *y)
{
    if (run->shears) return y[rst_run_position_of_shear(&run->scene) + 1];
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

void rst_run_rates(struct run *run, double t, const double *y, double *rate)
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
    rst_run_rates(run, t, y, rate);
    double sum = 0;
    for (int64_t i = 0; i < run->scene.n_states; i++)
        sum += rate[i];
    return !isfinite(sum);
}

double rst_run_error_scale(const struct run *run)
{
    return run->setup->closeness * fmin(1, run->setup->problem->shear_speed);
}

double rst_run_nearly(const struct run *run)
{
    return shift_of_root * rst_run_error_scale(run);
}

static void call_roots(void *owner, double t, const double *y, double *value)
{
    struct run *run = owner;
    const struct elements *e = &run->elements;
    rst_run_rates(run, t, y, run->scratch);
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
    const double least = rst_run_nearly(run);
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
    const size_t n = (size_t)s->problem->solid.n_terms, shear = rst_run_position_of_shear(&run->scene);
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

/* What CVODE itself takes for an evaluation, in updates of an element; it counts where there are no
 * elements. */
enum { updates_of_cvode = 64 };

int64_t rst_run_spent(const struct run *run)
{
    const struct integrator_counts work = rst_integrator_work(run->integrator);
    const int64_t inside = run->shears ? run->setup->n_nodes : updates_of_cvode;
    return run->updates + (work.rates + work.roots) * inside * (1 + run->scene.n_terms);
}

void rst_run_count_work(struct run *run)
{
    if (!run->integrator) return;
    const struct integrator_counts work = rst_integrator_work(run->integrator);
    run->updates = rst_run_spent(run);
    run->work.steps += work.steps;
    run->work.restarts += work.restarts;
    run->work.rates += work.rates;
    run->work.roots += work.roots;
    rst_integrator_destroy(run->integrator);
    run->integrator = NULL;
}

int rst_run_integrate_from(struct run *run)
{
    if (run->integrator) run->work.restarts++; /* the first one is a start */
    rst_run_count_work(run);
    const struct integrator_system system = {.n_states = run->scene.n_states,
                                             .n_roots = ROOTS + (run->shears ? run->scene.n_nodes : 0),
                                             .family = run->setup->family,
                                             .horizon = run->setup->depth,
                                             .longest_step = run->setup->longest_step,
                                             .rates = call_rates,
                                             .roots = call_roots,
                                             .newton = call_newton,
                                             .weights = call_weights,
                                             .owner = run};
    return rst_integrator_create(&system, run->time, run->y, &run->integrator, run->text, sizeof run->text);
}

/* ---- elements */

void rst_run_place_elements(struct run *run)
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

static void fade_to(struct run *run, double t)
{
    const struct elements *e = &run->elements;
    rst_cvode_fade(&run->scene, run->setup->problem->solid.tau, run->recovery.rate, t, e->c, e->b, e->amplitude);
    run->scene.reference = t;
}

int rst_run_admit(struct run *run, double t)
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

void rst_run_begin_step(struct run *run)
{
    run->scene.step_start = run->time;
    if (!run->shears) return;
    memcpy(run->start_y, run->y, (size_t)run->scene.n_states * sizeof *run->y);
    rst_run_rates(run, run->time, run->y, run->start_rate);
}

/* All elements in contact stick with the force of gross slip: the tangential memory equals the
 * normal one, and with U = D nothing else is needed. */
static void take_over_gross_slip(struct run *run)
{
    const struct elements *e = &run->elements;
    const int64_t n = run->scene.n_nodes, terms = run->scene.n_terms;
    const double *tau = run->setup->problem->solid.tau;
    double *shear = run->y + rst_run_position_of_shear(&run->scene);
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

int rst_run_begin_shear(struct run *run, int after_gross_slip)
{
    run->shears = 1;
    run->scene.n_states = 4 + 3 * run->scene.n_terms;
    run->scene.reference = run->scene.step_start = run->time;
    if (after_gross_slip)
        take_over_gross_slip(run);
    else
        run->y[rst_run_position_of_shear(&run->scene) + 1] = run->setup->problem->shear_speed;
    const int status = rst_run_integrate_from(run);
    if (!status) rst_run_begin_step(run);
    return status;
}
