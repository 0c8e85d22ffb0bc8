/* Steps of contacts: checks of the input, and the mark of the law in the state.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/report.h"
#include "base/sized.h"
#include "contact/law.h"

/* The first number of a state is the grid width. Its lowest bits are replaced by bits of the hash
 * of the law, since a width does not need all its digits. */
static const uint64_t mark_bits = (1u << 24) - 1;

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void mark(const restitute_contact_law *law, double *width)
{
    const uint64_t bits = (bits_of(*width) & ~mark_bits) | (law->hash & mark_bits);
    memcpy(width, &bits, sizeof bits);
}

static int is_own(const restitute_contact_law *law, const double *state)
{
    return bits_of(state[0]) == 0 || ((bits_of(state[0]) ^ law->hash) & mark_bits) == 0;
}

static int is_unit(const double v[3])
{
    return fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) <= 1e-6;
}

/* Ranges in which the arithmetic does not overflow; far wider than any real radius or mass. */
static const double least_radius = 1e-15, largest_radius = 1e15, largest_mobility = 1e30, largest_friction = 1e6;
static const double least_step = 1e-60, largest_step = 1e60;

RST_DEFAULTS(contact_motion, .normal = {0, 0, 1})

RST_DEFAULTS(contact_energies, 0)

/* Motions and rates are read in place, since those of every caller have what a step needs. One test
 * for all: comparisons are false for NaN. */
static int is_good(const restitute_contact_rates *rates, const restitute_contact_motion *m)
{
    if (!RST_IS_SIZED(contact_motion, m)) return 0;
    const double *u = m->displacement, r = m->radius;
    return r >= least_radius && r <= largest_radius && fabs(m->overlap) <= r &&
           fabs(m->normal_velocity) <= r / rates->step && fabs(u[0]) <= r && fabs(u[1]) <= r && fabs(u[2]) <= r &&
           m->half_step_over_mass >= 0 && m->half_step_over_mass <= largest_mobility &&
           m->half_step_over_tangential_mass >= 0 && m->half_step_over_tangential_mass <= largest_mobility &&
           m->friction >= 0 && m->friction <= largest_friction && is_unit(m->normal);
}

/* A call on a state: nothing NULL (`other` is called `name`), and the state one of this law. */
static int check_state(const restitute_contact_law *law, const double *state, const void *other, const char *name,
                       restitute_error *error)
{
    if (!law || !state || !other)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", !law ? "law" : !state ? "state" : name);
    if (is_own(law, state)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "state[0] = %.17g: is of another law than the one with hash %016llx, or has lost digits", state[0],
                      (unsigned long long)law->hash);
}

static int check_unit(const double *v, const char *name, restitute_error *error)
{
    if (!v) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", name);
    if (is_unit(v)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = (%g, %g, %g): must be a unit vector", name, v[0], v[1], v[2]);
}

/* Report the first wrong value of a motion that failed the test. */
static int refuse(const restitute_contact_rates *rates, const restitute_contact_motion *m, restitute_error *error)
{
    const int status = RST_CHECK(contact_motion, m, error);
    if (status) return status;
    if (!(rates->step >= least_step && rates->step <= largest_step))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates.step = %g s: must be in [%g, %g]; restitute_contact_rates_set fills rates",
                          rates->step, least_step, largest_step);
    const double r = m->radius, fastest = r / rates->step, *u = m->displacement;
    const struct {
        const char *name;
        double value, low, high;
    } numbers[] = {{"radius", r, least_radius, largest_radius},
                   {"overlap", m->overlap, -r, r},
                   {"normal_velocity", m->normal_velocity, -fastest, fastest},
                   {"displacement[0]", u[0], -r, r},
                   {"displacement[1]", u[1], -r, r},
                   {"displacement[2]", u[2], -r, r},
                   {"half_step_over_mass", m->half_step_over_mass, 0, largest_mobility},
                   {"half_step_over_tangential_mass", m->half_step_over_tangential_mass, 0, largest_mobility},
                   {"friction", m->friction, 0, largest_friction}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!(numbers[i].value >= numbers[i].low && numbers[i].value <= numbers[i].high))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN, "motion.%s = %.17g: must be in [%g, %g]", numbers[i].name,
                              numbers[i].value, numbers[i].low, numbers[i].high);
    return check_unit(m->normal, "motion.normal", error);
}

static int refuse_step(int64_t why, const restitute_contact_rates *rates, const restitute_contact_motion *motion,
                       restitute_error *error)
{
    if (why == rst_step_too_long)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "step = %g s: a contact that begins with %g m/s would last less than ten steps; see "
                          "restitute_contact_time_step_limit",
                          rates->step, motion->normal_velocity);
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "motion.normal = (%g, %g, %g): has turned too far since the last step; use restitute_contact_turn",
                      motion->normal[0], motion->normal[1], motion->normal[2]);
}

static int is_finite(const restitute_contact_force *f)
{
    return fabs(f->normal) <= DBL_MAX && fabs(f->tangential[0]) <= DBL_MAX && fabs(f->tangential[1]) <= DBL_MAX &&
           fabs(f->tangential[2]) <= DBL_MAX;
}

/* Within their ranges all inputs give finite forces. */
static int refuse_corrupt(restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "state: is corrupt, the force that it gives is not finite");
}

/* A checked step. A refused step changes nothing. */
static int advance(const restitute_contact_law *law, const restitute_contact_rates *rates,
                   const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                   restitute_error *error)
{
    restitute_contact_force found;
    int64_t why;
    if (!is_good(rates, motion)) return refuse(rates, motion, error);
    if (!is_own(law, state)) return check_state(law, state, state, "state", error);
    if (bits_of(state[0]) == 0 && motion->overlap <= 0) { /* not yet a contact */
        *force = (restitute_contact_force){0};
        return RESTITUTE_OK;
    }
    rst_law_step(&law->kernel, rates, motion, state, &found, &why);
    if (why != rst_step_done) return refuse_step(why, rates, motion, error);
    if (!is_finite(&found)) return refuse_corrupt(error);
    mark(law, &state[0]);
    *force = found;
    return RESTITUTE_OK;
}

static int check_rates(const restitute_contact_law *law, const restitute_contact_rates *rates, restitute_error *error)
{
    if (!law || !rates) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", law ? "rates" : "law");
    if (!RST_IS_SIZED(contact_rates, rates)) return RST_CHECK(contact_rates, rates, error);
    if (rates->law != law->hash)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates: are of another law; make them with restitute_contact_rates_set");
    return RESTITUTE_OK;
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
    int status = check_rates(law, rates, error);
    if (!status) status = check_places(motion, state, force, "", error);
    if (!status) status = advance(law, rates, motion, state, force, error);
    return status ? status : rst_done(error);
}

int restitute_contact_step_many(const restitute_contact_law *law, const restitute_contact_rates *rates, size_t n,
                                const restitute_contact_motion *motions, double *states, size_t stride,
                                restitute_contact_force *forces, int *statuses, restitute_error *error)
{
    int first = RESTITUTE_OK;
    restitute_error its;
    int status = check_rates(law, rates, error);
    if (!status && n > 0) status = check_places(motions, states, forces, "s", error);
    if (!status) status = RST_CHECK_ARRAY(contact_motion, motions, n, "motions", error);
    if (status) return status;
    if (stride < law->size)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "stride = %zu: must be at least the size of a state, %zu",
                          stride, law->size);
    for (size_t i = 0; i < n; i++) {
        const int one = advance(law, rates, rst_at(motions, i), states + i * stride, &forces[i], &its);
        if (statuses) statuses[i] = one;
        if (one && !first) first = rst_report(error, one, "motions[%zu]: %.220s", i, its.message);
    }
    return first ? first : rst_done(error);
}

int restitute_contact_peek(const restitute_contact_law *law, const double normal[3], const double *state,
                           restitute_contact_force *force, restitute_error *error)
{
    int status = check_state(law, state, force, "force", error);
    if (!status) status = check_unit(normal, "normal", error);
    if (status) return status;
    restitute_contact_force found;
    rst_law_force(normal, state, &found);
    if (!is_finite(&found)) return refuse_corrupt(error);
    *force = found;
    return rst_done(error);
}

int restitute_contact_energies_get(const restitute_contact_law *law, double radius, const double *state,
                                   restitute_contact_energies *energies, restitute_error *error)
{
    int status = check_state(law, state, energies, "energies", error);
    if (!status) status = RST_CHECK(contact_energies, energies, error);
    if (status) return status;
    if (!law->kernel.accounts)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "law: was made without energies");
    if (!(radius >= least_radius && radius <= largest_radius))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "radius = %.17g m: must be in [%g, %g]", radius, least_radius,
                          largest_radius);
    const double *account = state + law->size - 2, stored = rst_law_stored(&law->kernel, radius, state);
    const restitute_contact_energies found = {
        .struct_size = sizeof found,
        .stored = stored,
        .friction = account[1],
        .viscous = account[0] - stored - account[1],
    };
    RST_GIVE(&found, energies);
    return rst_done(error);
}

int restitute_contact_turn(const restitute_contact_law *law, const double from[3], const double to[3], double *state,
                           restitute_error *error)
{
    int status = check_state(law, state, law, "law", error);
    if (!status) status = check_unit(from, "from", error);
    if (!status) status = check_unit(to, "to", error);
    if (status) return status;
    rst_law_turn(from, to, state);
    return rst_done(error);
}
