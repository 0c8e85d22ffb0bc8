/* Steps of contacts. Those that are good are collected and advanced in lanes; all else is rare and
 * done before: contacts that begin, outgrow their grid or are refused.
 * SPDX-License-Identifier: BSD-3-Clause */
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
    if (rates->law == law->hash) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "rates: are of another law; make them with restitute_contact_rates_set");
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

/* A contact that the kernel cannot take as it is: one that begins, outgrows its grid or rests
 * shallow is made ready. A status; nothing has changed if it is refused. */
static int prepare(const restitute_contact_law *law, double step, const struct rst_batch *b, restitute_error *error)
{
    const double area = b->overlap[0] * b->radius[0];
    double *const state = b->state[0];
    const int status = rst_check_contact(law, step, b, error);
    if (status || (rst_is_new(state) && b->overlap[0] <= 0)) return status;
    if (rst_is_new(state) && !rst_contact_begin(&law->kernel, step, b, state))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "step = %g s: a contact that begins with %g m/s would last less than ten steps; see "
                          "restitute_contact_time_step_limit",
                          step, rst_approach(b, 0));
    if (area > state[at_width] * state[at_width]) rst_contact_stretch(&law->kernel, area, state);
    if (rst_contact_may_shrink(&law->kernel, step, b, 0)) rst_contact_shrink(&law->kernel, area, state);
    rst_mark(law, &state[at_width]);
    return RESTITUTE_OK;
}

static int take(const struct rst_batch *b, int l, restitute_contact_force *force, restitute_error *error)
{
    return rst_give_force(b->force[0][l], b->force[1][l], b->force[2][l], b->force[3][l], force, error);
}

/* The kernel is given n contacts if all are good: 0 if not. */
static int advance(const restitute_contact_law *law, const restitute_contact_rates *rates,
                   const restitute_contact_motion *motions, double *const *states, int n, struct rst_batch *batch)
{
    _Static_assert(sizeof(struct rst_rates) == sizeof rates->values, "values of the public struct");
    for (int l = 0; l < n; l++)
        rst_put(rst_at(motions, (size_t)l), states[l], l, batch);
    if (!rst_all_good(law, rates->step, batch, n)) return 0;
    (n > 1 ? law->step_lanes : law->step_one)(&law->kernel, (const struct rst_rates *)rates->values, rates->step,
                                              batch);
    return 1;
}

static int advance_one(const restitute_contact_law *law, const restitute_contact_rates *rates,
                       const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                       restitute_error *error)
{
    struct rst_batch batch;
    if (advance(law, rates, motion, &state, 1, &batch)) return take(&batch, 0, force, error);
    const int status = prepare(law, rates->step, &batch, error);
    if (status) return status;
    if (rst_is_new(state)) { /* not yet a contact */
        *force = (restitute_contact_force){0};
        return RESTITUTE_OK;
    }
    rst_put(motion, state, 0, &batch);
    law->step_one(&law->kernel, (const struct rst_rates *)rates->values, rates->step, &batch);
    return take(&batch, 0, force, error);
}

int restitute_contact_step(const restitute_contact_law *law, const restitute_contact_rates *rates,
                           const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                           restitute_error *error)
{
    int status = check_rates(law, rates, error);
    if (!status) status = check_places(motion, state, force, "", error);
    if (!status && !RST_IS_SIZED(contact_motion, motion)) status = RST_CHECK(contact_motion, motion, error);
    if (!status) status = advance_one(law, rates, motion, state, force, error);
    return status ? status : rst_done(error);
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
        const int done = end - i == rst_lanes && advance(law, rates, rst_at(motions, i), states + i, rst_lanes, &batch);
        for (size_t j = i; j < end; j++) {
            status = done ? take(&batch, (int)(j - i), &forces[j], &its)
                          : advance_one(law, rates, rst_at(motions, j), states[j], &forces[j], &its);
            if (statuses) statuses[j] = status;
            if (status && !first) first = rst_report(error, status, "motions[%zu]: %.220s", j, its.message);
        }
    }
    return first ? first : rst_done(error);
}
