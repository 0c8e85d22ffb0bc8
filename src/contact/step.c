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
    if (!(rates->step >= 1e-60 && rates->step <= 1e60))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates.step = %g s: must be in [1e-60, 1e+60]; restitute_contact_rates_set fills rates",
                          rates->step);
    if (rates->law != law->hash)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates: are of another law; make them with restitute_contact_rates_set");
    return RESTITUTE_OK;
}

/* A contact that the kernel cannot take as it is: one that begins, outgrows its grid or rests
 * shallow is made ready. 0: it is refused, and nothing has changed, or it is not yet a contact. */
static int prepare(const restitute_contact_law *law, const restitute_contact_rates *rates,
                   const restitute_contact_motion *m, double *state, restitute_contact_force *force, int *status,
                   restitute_error *error)
{
    const double *n = m->normal, *v = m->velocity, area = m->overlap * m->radius;
    const double approach = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    *status = rst_check_motion(rates->step, m, error);
    if (!*status) *status = rst_check_state(law, state, error);
    if (!*status && !rst_is_new(state)) *status = rst_check_turn(n, state, error);
    if (*status) return 0;
    if (rst_is_new(state) && m->overlap <= 0) {
        *force = (restitute_contact_force){0};
        return 0;
    }
    if (rst_is_new(state) && !rst_contact_begin(&law->kernel, rates->step, m, state)) {
        *status = rst_report(error, RESTITUTE_ERROR_DOMAIN,
                             "step = %g s: a contact that begins with %g m/s would last less than ten steps; see "
                             "restitute_contact_time_step_limit",
                             rates->step, approach);
        return 0;
    }
    if (area > state[at_width] * state[at_width]) rst_contact_stretch(&law->kernel, area, state);
    if (rst_contact_may_shrink(&law->kernel, approach * rates->step, m->overlap, m->radius, state))
        rst_contact_shrink(&law->kernel, area, state);
    rst_mark(law, &state[at_width]);
    return 1;
}

/* The force, if it is finite: within their ranges all motions give a finite one. */
static int take(const struct rst_batch *batch, int lane, restitute_contact_force *force, restitute_error *error)
{
    const restitute_contact_force found = {
        batch->force[lane], {batch->tangential[0][lane], batch->tangential[1][lane], batch->tangential[2][lane]}};
    if (!(found.normal >= 0) ||
        !(fabs(found.normal) + fabs(found.tangential[0]) + fabs(found.tangential[1]) + fabs(found.tangential[2]) <=
          DBL_MAX))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "state: is corrupt, the force that it gives is negative or not finite");
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

static int advance(const restitute_contact_law *law, const restitute_contact_rates *rates,
                   const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                   restitute_error *error)
{
    struct rst_batch batch;
    int status;
    rst_put(motion, state, 0, &batch);
    if (!rst_all_good(law, rates->step, &batch, 1)) {
        if (!prepare(law, rates, motion, state, force, &status, error)) return status;
        rst_put(motion, state, 0, &batch);
    }
    law->step_one(&law->kernel, kernel_rates(rates), rates->step, &batch);
    return take(&batch, 0, force, error);
}

int restitute_contact_step(const restitute_contact_law *law, const restitute_contact_rates *rates,
                           const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                           restitute_error *error)
{
    int status = check_rates(law, rates, error);
    if (!status) status = check_places(motion, state, force, "", error);
    if (!status && !RST_IS_SIZED(contact_motion, motion)) status = RST_CHECK(contact_motion, motion, error);
    if (!status) status = advance(law, rates, motion, state, force, error);
    return status ? status : rst_done(error);
}

/* As many contacts as there are lanes; 0: one of them has to be looked at. */
static int advance_lanes(const restitute_contact_law *law, const restitute_contact_rates *rates,
                         const restitute_contact_motion *motions, double *const *states, struct rst_batch *batch)
{
    for (int l = 0; l < rst_lanes; l++)
        rst_put(rst_at(motions, (size_t)l), states[l], l, batch);
    if (!rst_all_good(law, rates->step, batch, rst_lanes)) return 0;
    law->step_lanes(&law->kernel, kernel_rates(rates), rates->step, batch);
    return 1;
}

int restitute_contact_step_many(const restitute_contact_law *law, const restitute_contact_rates *rates, size_t n,
                                const restitute_contact_motion *motions, double *const *states,
                                restitute_contact_force *forces, int *statuses, restitute_error *error)
{
    struct rst_batch batch;
    restitute_error its;
    int first = RESTITUTE_OK, status = check_rates(law, rates, error);
    if (!status && n > 0) status = check_places(motions, states, forces, "s", error);
    if (!status) status = RST_CHECK_ARRAY(contact_motion, motions, n, "motions", error);
    for (size_t i = 0; i < n && !status; i++)
        if (!states[i]) status = rst_report(error, RESTITUTE_ERROR_NULL, "states[%zu] is NULL", i);
    if (status) return status;
    for (size_t i = 0, end; i < n; i = end) {
        end = n - i < rst_lanes ? n : i + rst_lanes;
        const int done = end - i == rst_lanes && advance_lanes(law, rates, rst_at(motions, i), states + i, &batch);
        for (size_t j = i; j < end; j++) {
            status = done ? take(&batch, (int)(j - i), &forces[j], &its)
                          : advance(law, rates, rst_at(motions, j), states[j], &forces[j], &its);
            if (statuses) statuses[j] = status;
            if (status && !first) first = rst_report(error, status, "motions[%zu]: %.220s", j, its.message);
        }
    }
    return first ? first : rst_done(error);
}
