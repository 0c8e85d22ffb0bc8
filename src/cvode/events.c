/* CVODE restarts at the end of gross slip and at the largest indentation, where the formula of the
 * force changes. It also restarts where elements stick again, if treating them as slipping for the
 * rest of the step would be too inaccurate. At entries, exits and stick -> slip the right-hand side
 * is continuous, and CVODE is not interrupted.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/events.h"

#include <math.h>

#include "cvode/elements.h"

/* If some elements already stuck within a step, the step is repeated if this changed U' by more
 * than this share of the allowed error. */
static const double late_part = 1;

/* Error of the states over the error of a step (docs/cvode.md). */
static const double error_margin = 100;

int rst_run_note(struct run *run, int kind, double position, int elements)
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
    return rst_log_add(run->log, &event) ? rst_run_fail(run, RESTITUTE_ERROR_MEMORY, "out of memory for events")
                                         : RESTITUTE_OK;
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
    const size_t v = rst_run_position_of_shear(&run->scene) + 1;
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
        e->change[i] =
            fell[i] || (i >= first && e->motion[i] != RST_ELEMENT_STICKS && e->value[i] <= rst_run_nearly(run));
}

/* At the end of a step: elements that are past their change by more than the error. They entered
 * and changed within the step. */
static int find_late(struct run *run)
{
    const struct elements *e = &run->elements;
    const double depth = run->setup->depth, velocity = error_margin * rst_run_error_scale(run);
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
    if (slipping) status = rst_run_note(run, RESTITUTE_CVODE_EVENT_STICK_TO_SLIP, slip_at, slipping);
    if (sticking && !status) status = rst_run_note(run, RESTITUTE_CVODE_EVENT_SLIP_TO_STICK, stick_at, sticking);
    if (sticking && suffered(run, weight) > late_part * rst_run_error_scale(run)) *restart = 1;
    return status;
}

/* From here on the right-hand side is another one. */
static int restart(struct run *run)
{
    rst_run_begin_step(run);
    if (rst_integrator_restart(run->integrator, run->time, run->y) == 0) return RESTITUTE_OK;
    return rst_run_fail(run, RESTITUTE_ERROR_INTEGRATOR, rst_integrator_text(run->integrator));
}

static int end_contact(struct run *run)
{
    run->ended = 1;
    return rst_run_note(run, RESTITUTE_CVODE_EVENT_CONTACT_END, 0, 1);
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
    int status = rst_run_note(run, RESTITUTE_CVODE_EVENT_TURN, sqrt(run->y[0]), 0);
    run->scene.restitution = 1;
    run->outermost = run->next_entry - 1;
    if (!status) status = restart(run);
    rst_run_rates(run, run->time, run->y, run->scratch);
    return status || run->contact.square > 0 ? status : end_contact(run);
}

/* All stick that have slipped since first touch. */
static int end_gross_slip(struct run *run)
{
    int inside = 0;
    for (int64_t i = 0; i < run->setup->n_nodes; i++)
        inside += run->elements.x[i] * run->elements.x[i] < run->contact.square;
    run->y[1] = run->slip_end;
    const int status = rst_run_note(run, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END, run->contact.radius, inside);
    return status ? status : rst_run_begin_shear(run, 1);
}

/* Gross slip may end at the same instant (psi = 2 chi). After a restart on that root CVODE would
 * not find it. */
static int turn_and_stick(struct run *run)
{
    const int both = !run->shears && run->setup->n_nodes > 0 && fabs(run->slip_end) <= rst_run_nearly(run);
    const int status = turn(run);
    return status || !both || run->ended ? status : end_gross_slip(run);
}

int rst_run_react(struct run *run, int64_t first)
{
    const int *fell = rst_integrator_events(run->integrator);
    int status = RESTITUTE_OK, again = 0;
    rst_run_rates(run, run->time, run->y, run->scratch);
    if (fell[ROOT_ENTRY]) {
        status = rst_run_note(run, RESTITUTE_CVODE_EVENT_ENTRY, run->elements.x[run->next_entry], 1);
        run->next_entry++;
    }
    if (fell[ROOT_EXIT] && !status) {
        status = rst_run_note(run, RESTITUTE_CVODE_EVENT_EXIT, run->elements.x[run->outermost], 1);
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

int rst_run_end_step(struct run *run)
{
    int status = RESTITUTE_OK, again = 0;
    rst_run_begin_step(run);
    if (!run->shears || run->scene.mode == RST_NO_SLIP || !find_late(run)) return status;
    status = change_motion(run, &again);
    rst_run_begin_step(run);
    return status;
}
