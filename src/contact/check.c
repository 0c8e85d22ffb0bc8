/* Checks of motions and states, in words. Within their ranges all motions give finite forces.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/status.h"
#include "contact/law.h"

/* Ranges of a motion, in which the arithmetic does not overflow; far wider than any real radius or
 * mass. */
enum unit { one, radius, per_step, radius_per_step, unit_count };
static const struct range {
    const char *name;
    size_t at; /* of a batch */
    enum unit unit;
    double low, high;
} ranges[] = {{"motion.radius", offsetof(struct rst_batch, radius), one, RST_LEAST_RADIUS, RST_LARGEST_RADIUS},
              {"motion.overlap", offsetof(struct rst_batch, overlap), radius, -1, 1},
              {"motion.velocity[0]", offsetof(struct rst_batch, velocity[0]), radius_per_step, -1, 1},
              {"motion.velocity[1]", offsetof(struct rst_batch, velocity[1]), radius_per_step, -1, 1},
              {"motion.velocity[2]", offsetof(struct rst_batch, velocity[2]), radius_per_step, -1, 1},
              {"motion.spin", offsetof(struct rst_batch, spin), per_step, -1, 1},
              {"motion.inverse_mass", offsetof(struct rst_batch, inverse_mass[0]), per_step, 0, 2e30},
              {"motion.inverse_tangential_mass", offsetof(struct rst_batch, inverse_mass[1]), per_step, 0, 2e30},
              {"motion.friction", offsetof(struct rst_batch, friction), one, 0, 1e6}};

/* The first range that a lane is out of: its value and bounds; NULL if there is none. Comparisons
 * are false for NaN. */
static const struct range *first_bad(double step, const struct rst_batch *b, int l, double found[3])
{
    const double units[unit_count] = {1, b->radius[l], 1 / step, b->radius[l] / step};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const struct range *r = &ranges[i];
        const double value = ((const double *)((const char *)b + r->at))[l], unit = units[r->unit];
        if (value >= r->low * unit && value <= r->high * unit) continue;
        found[0] = value, found[1] = r->low * unit, found[2] = r->high * unit;
        return r;
    }
    return NULL;
}

/* Of the square of the first tangential axis, what must be in the tangential plane: the normal may
 * have turned by 60 degrees towards it. */
static const double least_in_plane = 0.25;

static double in_plane(const struct rst_batch *b, int l)
{
    const double nx = b->normal[0][l], ny = b->normal[1][l], nz = b->normal[2][l], ax = b->axis[0][l],
                 ay = b->axis[1][l], az = b->axis[2][l], out = nx * ax + ny * ay + nz * az;
    return ax * ax + ay * ay + az * az - out * out;
}

static int is_unit(double x, double y, double z)
{
    return fabs(x * x + y * y + z * z - 1) <= 1e-6;
}

/* A new contact has no width. */
int rst_all_good(const restitute_contact_law *law, double step, const struct rst_batch *b, int n)
{
    int good = 1, wide = 0;
    double found[3];
    for (int l = 0; l < n; l++) {
        const double area = b->overlap[l] * b->radius[l];
        good &= (area <= b->width[l] * b->width[l]) & (b->width[l] > 0) & (in_plane(b, l) >= least_in_plane) &
                is_unit(b->normal[0][l], b->normal[1][l], b->normal[2][l]);
        wide |= rst_is_wide(area, b->width[l]);
    }
    for (int l = 0; l < n; l++)
        good &= rst_is_own(law, b->state[l]) && !first_bad(step, b, l, found);
    for (int l = 0; l < n && good && wide; l++)
        good = !rst_contact_may_shrink(&law->kernel, step, b, l);
    return good;
}

int rst_check_contact(const restitute_contact_law *law, double step, const struct rst_batch *b, restitute_error *error)
{
    const double normal[3] = {b->normal[0][0], b->normal[1][0], b->normal[2][0]};
    double found[3];
    const struct range *bad = first_bad(step, b, 0, found);
    if (bad) return rst_check_range(found[0], found[1], found[2], bad->name, error);
    int status = rst_check_unit(normal, "motion.normal", error);
    if (!status) status = rst_check_state(law, b->state[0], error);
    if (status || rst_is_new(b->state[0]) || in_plane(b, 0) >= least_in_plane) return status;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "motion.normal = (%g, %g, %g): has turned too far since the last step; use "
                      "restitute_contact_turn",
                      normal[0], normal[1], normal[2]);
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
    if (is_unit(v[0], v[1], v[2])) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = (%g, %g, %g): must be a unit vector", name, v[0], v[1],
                      v[2]);
}

int rst_give_force(double normal, double x, double y, double z, restitute_contact_force *force, restitute_error *error)
{
    if (!(normal >= 0 && normal + fabs(x) + fabs(y) + fabs(z) <= DBL_MAX))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "state: is corrupt, the force that it gives is negative or not finite");
    *force = (restitute_contact_force){normal, {x, y, z}};
    return RESTITUTE_OK;
}
