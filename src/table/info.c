/* Information about a table, and the limits of the model that an impact exceeds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include <float.h>

RST_DEFAULTS(table_info, 0)

enum strain { FAST, LARGE, SLIDE, TIME, STRAINS };

/* Lowest speed at which a ratio of the nodes exceeds its limit, linear in logarithms between them.
 * Where the sphere sinks ratios have no meaning. */
static double from_speed(const restitute_table_data *d, enum strain which, double limit, double rebound)
{
    for (int64_t i = 0; i < d->speeds; i++) {
        const double here = d->strain[STRAINS * i + which];
        if (d->speed[i] < rebound || !(here > limit)) continue;
        if (i == 0 || d->speed[i - 1] < rebound) return fmax(d->speed[i], d->low);
        const double before = d->strain[STRAINS * (i - 1) + which], ratio = d->speed[i] / d->speed[i - 1];
        if (!(ratio > 1) || !(before > 0) || !(limit > 0) || isinf(here)) return d->speed[i];
        return d->speed[i - 1] * pow(ratio, log(limit / before) / log(here / before));
    }
    return INFINITY;
}

/* Upper end of the lowest speeds at which e_z is 0. */
static double rebound_speed(const restitute_table_data *d)
{
    double speed = 0;
    for (int64_t i = 0; i + 1 < d->speeds && d->ez[2 * i] <= 0 && d->ez[2 * i + 2] <= 0; i++)
        speed = d->speed[i + 1];
    return speed;
}

int restitute_table_describe(const restitute_table *table, restitute_table_info *info, restitute_error *error)
{
    if (!table || !info) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "info" : "table");
    const int status = RST_CHECK(table_info, info, error);
    if (status) return status;
    const restitute_table_data *d = &table->d;
    const double rebound = rebound_speed(d);
    restitute_table_info all = {.struct_size = sizeof all,
                                .speed = {d->low, d->high},
                                .chi = d->chi,
                                .gamma = d->gamma,
                                .delta1 = {d->delta1 * pow(d->low, 0.2), d->delta1 * pow(d->high, 0.2)},
                                .friction = d->friction,
                                .radius = d->radius,
                                .mass = d->mass,
                                .tolerance = d->tolerance,
                                .error_ez = d->error_ez,
                                .error_ex = d->error_ex,
                                .rebound_speed = rebound,
                                .fast_speed = from_speed(d, FAST, d->speed_limit, rebound),
                                .large_contact_speed = from_speed(d, LARGE, d->radius_limit, rebound),
                                .long_slide_speed = from_speed(d, SLIDE, d->displacement_limit, rebound),
                                .impacts = d->impacts,
                                .checks = d->checks,
                                .speeds = d->speeds,
                                .stick_cells = d->stick_cells,
                                .slip_cells = d->slip_cells,
                                .bytes = table->bytes};
    memcpy(all.version, d->version, sizeof all.version);
    RST_GIVE(&all, info);
    return rst_done(error);
}

/* Numbers of a contact at a speed of its own. They are nearly powers of the speed between nodes. */
static void strains_at(const restitute_table *table, const restitute_table_contact *c, double normal_speed,
                       double at[STRAINS])
{
    const restitute_table_data *d = &table->d;
    const double v = fmin(fmax(normal_speed * c->speed_factor, d->low), d->high), place = rst_axis_place(v, NULL);
    int64_t i = 0;
    while (i + 2 < d->speeds && d->speed[i + 1] <= v)
        i++;
    const double u = (place - table->node[i].at) * table->node[i].inverse_width;
    for (int k = 0; k < STRAINS; k++) {
        const double low = d->strain[STRAINS * i + k], high = d->strain[STRAINS * (i + 1) + k];
        const double here = low > 0 && fmax(low, high) <= DBL_MAX ? low * pow(high / low, u) : fmax(low, high);
        at[k] = here * c->strain_factors[k];
    }
}

int restitute_table_flags(const restitute_table *table, const restitute_table_contact *contact, double normal_speed,
                          double sliding_speed, int *flags, restitute_error *error)
{
    if (!table || !flags) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "flags" : "table");
    int status = contact ? rst_check_other_contact(contact, error) : RESTITUTE_OK;
    if (!status) status = rst_check_speeds(normal_speed, sliding_speed, "", error);
    if (status) return status;
    const restitute_table_contact *c = contact ? contact : &table->own;
    const restitute_table_data *d = &table->d;
    double at[STRAINS];
    strains_at(table, c, normal_speed, at);
    const double slide = fmin(at[SLIDE], 1e200) * fabs(sliding_speed); /* what sinks may slide on: infinite */
    *flags = (at[FAST] > d->speed_limit ? RESTITUTE_FLAG_FAST : 0) |
             (at[LARGE] > d->radius_limit ? RESTITUTE_FLAG_LARGE_CONTACT : 0) |
             (slide > d->displacement_limit * fmax(normal_speed, rst_least) ? RESTITUTE_FLAG_LONG_SLIDE : 0) |
             (c->psi_factor <= DBL_MAX && fabs(c->dundurs_beta) > d->dundurs_limit ? RESTITUTE_FLAG_COUPLED : 0) |
             (at[TIME] < d->shortest || at[TIME] > d->longest ? RESTITUTE_FLAG_UNMEASURED : 0);
    return rst_done(error);
}
