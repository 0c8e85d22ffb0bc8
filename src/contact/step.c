/* Steps of contacts. Those that are good are collected and advanced in lanes; all else is rare and
 * done before: contacts that begin, outgrow their grid or are refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <math.h>

#include "base/report.h"
#include "base/sized.h"
#include "contact/law.h"

RST_DEFAULTS(contact_motion, .normal = {0, 0, 1})

static int check_rates(const restitute_contact_law *law, const restitute_contact_rates *rates, restitute_error *error)
{
    if (!law || !rates) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", law ? "rates" : "law");
    if (!RST_IS_SIZED(contact_rates, rates)) return RST_CHECK(contact_rates, rates, error);
    if (rates->law != law->hash)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates: are of another law; make them with restitute_contact_rates_set");
    return RESTITUTE_OK;
}

/* The first tangential axis has been turned by 60 degrees out of the tangential plane. */
static int has_jumped(const double *n, const double *axis)
{
    const double out = n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2];
    return axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2] - out * out < 0.25;
}

/* The first numbers of a state are ready for the kernel. */
static int prepare(const restitute_contact_law *law, const restitute_contact_rates *rates,
                   const restitute_contact_motion *m, double *state, restitute_error *error)
{
    const int is_new = rst_is_new(state);
    const double *n = m->normal, *v = m->velocity, area = m->overlap * m->radius;
    if (!is_new && has_jumped(n, state + at_axis))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "motion.normal = (%g, %g, %g): has turned too far since the last step; use "
                          "restitute_contact_turn",
                          n[0], n[1], n[2]);
    if (is_new && !rst_contact_begin(&law->kernel, rates->step, m, state))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "step = %g s: a contact that begins with %g m/s would last less than ten steps; see "
                          "restitute_contact_time_step_limit",
                          rates->step, n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
    const int outgrows = area > state[at_width] * state[at_width];
    if (outgrows) rst_contact_stretch(&law->kernel, area, state);
    if (is_new || outgrows) rst_mark(law, &state[at_width]);
    return RESTITUTE_OK;
}

/* A checked contact. Returns 1 if the kernel is to advance it; else it is refused, and nothing has
 * changed, or it is not yet a contact. */
static int admit(const restitute_contact_law *law, const restitute_contact_rates *rates,
                 const restitute_contact_motion *motion, double *state, restitute_contact_force *force, int *status,
                 restitute_error *error)
{
    *status = rst_check_motion(rates, motion, error);
    if (!*status) *status = rst_check_state(law, state, error);
    if (*status) return 0;
    if (rst_is_new(state) && motion->overlap <= 0) {
        *force = (restitute_contact_force){0};
        return 0;
    }
    *status = prepare(law, rates, motion, state, error);
    return !*status;
}

static void put(const restitute_contact_motion *m, double *state, int lane, struct rst_batch *batch)
{
    for (int i = 0; i < 3; i++) {
        batch->normal[i][lane] = m->normal[i];
        batch->velocity[i][lane] = m->velocity[i];
    }
    batch->overlap[lane] = m->overlap;
    batch->turn[lane] = m->spin;
    batch->inverse_mass[0][lane] = m->inverse_mass;
    batch->inverse_mass[1][lane] = m->inverse_tangential_mass;
    batch->radius[lane] = m->radius;
    batch->friction[lane] = m->friction;
    batch->state[lane] = state;
}

/* The force, if it is finite: within their ranges all motions give a finite one. */
static int take(const struct rst_batch *batch, int lane, restitute_contact_force *force, restitute_error *error)
{
    const restitute_contact_force found = {
        batch->force[lane], {batch->tangential[0][lane], batch->tangential[1][lane], batch->tangential[2][lane]}};
    if (!(fabs(found.normal) + fabs(found.tangential[0]) + fabs(found.tangential[1]) + fabs(found.tangential[2]) <=
          DBL_MAX))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "state: is corrupt, the force that it gives is not finite");
    *force = found;
    return RESTITUTE_OK;
}

static const struct rst_rates *kernel_rates(const restitute_contact_rates *rates)
{
    _Static_assert(sizeof(struct rst_rates) == sizeof rates->values, "values of the public struct");
    return (const struct rst_rates *)rates->values;
}

/* `plural`: how the names of the arguments end. */
static int check_places(const void *motion, const void *state, const void *force, const char *plural,
                        restitute_error *error)
{
    if (motion && state && force) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_NULL, "%s%s is NULL",
                      !motion  ? "motion"
                      : !state ? "state"
                               : "force",
                      plural);
}

int restitute_contact_step(const restitute_contact_law *law, const restitute_contact_rates *rates,
                           const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                           restitute_error *error)
{
    struct rst_batch batch;
    int status = check_rates(law, rates, error);
    if (!status) status = check_places(motion, state, force, "", error);
    if (status) return status;
    if (admit(law, rates, motion, state, force, &status, error)) {
        put(motion, state, 0, &batch);
        law->step_one(&law->kernel, kernel_rates(rates), rates->step, &batch);
        status = take(&batch, 0, force, error);
    }
    return status ? status : rst_done(error);
}

/* What a call on many contacts works on. */
struct many {
    const restitute_contact_law *law;
    const restitute_contact_rates *rates;
    const restitute_contact_motion *motions;
    double *const *states;
    restitute_contact_force *forces;
    int *statuses;
    restitute_error *error;
    int waiting; /* for the kernel */
    size_t which[rst_lanes];
    struct rst_batch batch;
    size_t first; /* that failed, and its status */
    int status;
};

static void settle(struct many *m, size_t i, int status, const restitute_error *its)
{
    if (m->statuses) m->statuses[i] = status;
    if (!status || (m->status && m->first < i)) return;
    m->first = i;
    m->status = rst_report(m->error, status, "motions[%zu]: %.220s", i, its->message);
}

static void advance(struct many *m)
{
    restitute_error its;
    const int n = m->waiting;
    m->waiting = 0;
    if (n == rst_lanes) m->law->step_lanes(&m->law->kernel, kernel_rates(m->rates), m->rates->step, &m->batch);
    for (int l = 0; l < n; l++) {
        const size_t i = m->which[l];
        int status;
        if (n == rst_lanes)
            status = take(&m->batch, l, &m->forces[i], &its);
        else
            status = restitute_contact_step(m->law, m->rates, rst_at(m->motions, i), m->states[i], &m->forces[i], &its);
        settle(m, i, status, &its);
    }
}

int restitute_contact_step_many(const restitute_contact_law *law, const restitute_contact_rates *rates, size_t n,
                                const restitute_contact_motion *motions, double *const *states,
                                restitute_contact_force *forces, int *statuses, restitute_error *error)
{
    struct many m = {.law = law,
                     .rates = rates,
                     .motions = motions,
                     .states = states,
                     .forces = forces,
                     .statuses = statuses,
                     .error = error};
    restitute_error its;
    int status = check_rates(law, rates, error);
    if (!status && n > 0) status = check_places(motions, states, forces, "s", error);
    if (!status) status = RST_CHECK_ARRAY(contact_motion, motions, n, "motions", error);
    for (size_t i = 0; i < n && !status; i++)
        if (!states[i]) status = rst_report(error, RESTITUTE_ERROR_NULL, "states[%zu] is NULL", i);
    if (status) return status;
    for (size_t i = 0; i < n; i++) {
        const restitute_contact_motion *motion = rst_at(motions, i);
        if (admit(law, rates, motion, states[i], &forces[i], &status, &its)) {
            put(motion, states[i], m.waiting, &m.batch);
            m.which[m.waiting++] = i;
            if (m.waiting == rst_lanes) advance(&m);
        } else {
            settle(&m, i, status, &its);
        }
    }
    advance(&m);
    return m.status ? m.status : rst_done(error);
}
