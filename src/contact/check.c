/* Checks of motions and states, in words. Within their ranges all motions give finite forces.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/report.h"
#include "base/sized.h"
#include "contact/law.h"

/* Ranges in which the arithmetic does not overflow; far wider than any real radius or mass. */
static const double least_radius = 1e-15, largest_radius = 1e15, largest_mobility = 2e30, largest_friction = 1e6;

/* Of the square of the first tangential axis, what must be in the tangential plane: the normal may
 * have turned by 60 degrees towards it. */
static const double least_in_plane = 0.25;

static int is_unit(const double v[3])
{
    return fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) <= 1e-6;
}

static int may_shrink(const restitute_contact_law *law, double step, const struct rst_batch *b, int l)
{
    double approach = 0;
    for (int i = 0; i < 3; i++)
        approach += b->normal[i][l] * b->velocity[i][l];
    return rst_contact_may_shrink(&law->kernel, approach * step, b->overlap[l], b->radius[l], b->state[l]);
}

/* Comparisons are false for NaN. A new contact has no width. */
int rst_all_good(const restitute_contact_law *law, double step, const struct rst_batch *b, int n)
{
    const double per_step = 1 / step, mobility = largest_mobility * per_step;
    int good = 1, wide = 0;
    for (int l = 0; l < n; l++) {
        const double r = b->radius[l], fastest = r * per_step, nx = b->normal[0][l], ny = b->normal[1][l],
                     nz = b->normal[2][l], ax = b->axis[0][l], ay = b->axis[1][l], az = b->axis[2][l];
        const double unit = nx * nx + ny * ny + nz * nz, out = nx * ax + ny * ay + nz * az;
        good &= (r >= least_radius) & (r <= largest_radius) & (b->overlap[l] >= -r) &
                (b->overlap[l] * r <= b->width[l] * b->width[l]) & (b->width[l] > 0);
        good &= (fabs(b->velocity[0][l]) <= fastest) & (fabs(b->velocity[1][l]) <= fastest) &
                (fabs(b->velocity[2][l]) <= fastest) & (fabs(b->turn[l]) <= per_step);
        good &= (b->inverse_mass[0][l] >= 0) & (b->inverse_mass[0][l] <= mobility) & (b->inverse_mass[1][l] >= 0) &
                (b->inverse_mass[1][l] <= mobility) & (b->friction[l] >= 0) & (b->friction[l] <= largest_friction);
        good &= (fabs(unit - 1) <= 1e-6) & (ax * ax + ay * ay + az * az - out * out >= least_in_plane);
        wide |= rst_is_wide(b->overlap[l] * r, b->width[l]);
    }
    for (int l = 0; l < n; l++)
        good &= rst_is_own(law, b->state[l]);
    for (int l = 0; l < n && good && wide; l++)
        good = !may_shrink(law, step, b, l);
    return good;
}

int rst_check_motion(double step, const restitute_contact_motion *m, restitute_error *error)
{
    const int status = RST_CHECK(contact_motion, m, error);
    if (status) return status;
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

int rst_check_turn(const double n[3], const double *state, restitute_error *error)
{
    const double *a = state + at_axis, out = n[0] * a[0] + n[1] * a[1] + n[2] * a[2];
    if (a[0] * a[0] + a[1] * a[1] + a[2] * a[2] - out * out >= least_in_plane) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "motion.normal = (%g, %g, %g): has turned too far since the last step; use "
                      "restitute_contact_turn",
                      n[0], n[1], n[2]);
}

int rst_check_state(const restitute_contact_law *law, const double *state, restitute_error *error)
{
    if (rst_is_new(state)) return RESTITUTE_OK;
    if (rst_is_own(law, state) && state[at_width] > 0 && isfinite(state[at_width]) && isfinite(state[at_overlap]))
        return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "state[0] = %.17g: is of another law than the one with hash %016llx, or damaged", state[0],
                      (unsigned long long)law->hash);
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
