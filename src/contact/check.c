/* Checks of motions and states, in words. Within their ranges all motions give finite forces.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/report.h"
#include "base/sized.h"
#include "contact/law.h"

/* Ranges in which the arithmetic does not overflow; far wider than any real radius or mass. */
static const double least_radius = 1e-15, largest_radius = 1e15, largest_mobility = 2e30, largest_friction = 1e6;
static const double least_step = 1e-60, largest_step = 1e60;

static int is_unit(const double v[3])
{
    return fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) <= 1e-6;
}

/* One test for all: comparisons are false for NaN. Motions and rates are read in place, since those
 * of every caller have what a step needs. */
static int is_good(double step, const restitute_contact_motion *m)
{
    if (!RST_IS_SIZED(contact_motion, m)) return 0;
    const double *v = m->velocity, r = m->radius, fastest = r / step, mobility = largest_mobility / step;
    return r >= least_radius && r <= largest_radius && fabs(m->overlap) <= r && fabs(v[0]) <= fastest &&
           fabs(v[1]) <= fastest && fabs(v[2]) <= fastest && fabs(m->spin) <= 1 / step && m->inverse_mass >= 0 &&
           m->inverse_mass <= mobility && m->inverse_tangential_mass >= 0 && m->inverse_tangential_mass <= mobility &&
           m->friction >= 0 && m->friction <= largest_friction && is_unit(m->normal);
}

/* The first wrong value of a motion that failed the test. */
static int refuse(double step, const restitute_contact_motion *m, restitute_error *error)
{
    const int status = RST_CHECK(contact_motion, m, error);
    if (status) return status;
    if (!(step >= least_step && step <= largest_step))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "rates.step = %g s: must be in [%g, %g]; restitute_contact_rates_set fills rates", step,
                          least_step, largest_step);
    const double r = m->radius, fastest = r / step, mobility = largest_mobility / step, *v = m->velocity;
    const struct {
        const char *name;
        double value, low, high;
    } numbers[] = {{"radius", r, least_radius, largest_radius},
                   {"overlap", m->overlap, -r, r},
                   {"velocity[0]", v[0], -fastest, fastest},
                   {"velocity[1]", v[1], -fastest, fastest},
                   {"velocity[2]", v[2], -fastest, fastest},
                   {"spin", m->spin, -1 / step, 1 / step},
                   {"inverse_mass", m->inverse_mass, 0, mobility},
                   {"inverse_tangential_mass", m->inverse_tangential_mass, 0, mobility},
                   {"friction", m->friction, 0, largest_friction}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!(numbers[i].value >= numbers[i].low && numbers[i].value <= numbers[i].high))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN, "motion.%s = %.17g: must be in [%g, %g]", numbers[i].name,
                              numbers[i].value, numbers[i].low, numbers[i].high);
    return rst_check_unit(m->normal, "motion.normal", error);
}

int rst_check_motion(const restitute_contact_rates *rates, const restitute_contact_motion *motion,
                     restitute_error *error)
{
    return is_good(rates->step, motion) ? RESTITUTE_OK : refuse(rates->step, motion, error);
}

int rst_check_state(const restitute_contact_law *law, const double *state, restitute_error *error)
{
    if (rst_is_own(law, state)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "state[0] = %.17g: is of another law than the one with hash %016llx, or has lost digits",
                      state[0], (unsigned long long)law->hash);
}

int rst_check_unit(const double *v, const char *name, restitute_error *error)
{
    if (!v) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", name);
    if (is_unit(v)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = (%g, %g, %g): must be a unit vector", name, v[0], v[1],
                      v[2]);
}

int rst_check_radius(double radius, const char *name, restitute_error *error)
{
    if (radius >= least_radius && radius <= largest_radius) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g m: must be in [%g, %g]", name, radius, least_radius,
                      largest_radius);
}
