/* One impact of two bodies in space, looked up.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include "base/two_bodies.h"

/* Times a speed it does not overflow. */
static const double largest_factor = 1e200;

static int check_chi(const restitute_table *t, const restitute_table_contact *c, double mass, const restitute_body *a,
                     const restitute_body *b, restitute_error *error)
{
    const double nu = t->d.poisson_ratio, chi = (1 - nu) / (2 - nu) * mass * (mobility_of(a) + mobility_of(b));
    if (isinf(c->psi_factor) || rst_same_chi(chi, t->d.chi)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %.17g of the bodies: must be the table's, %.17g", chi,
                      t->d.chi);
}

/* `a` can move. T^5 goes with mass^2/radius, so that a size is a factor on the speed. */
static int collide(const restitute_table *t, const restitute_table_contact *c, restitute_body *a, restitute_body *b,
                   restitute_table_value *pair, restitute_error *error)
{
    const struct frame f = frame_of(a, b);
    int status = check_approach(&f, c->touch_gap, error);
    const double mass = 1 / (1 / a->mass + (is_plane(b) ? 0 : 1 / b->mass));
    if (!status) status = check_chi(t, c, mass, a, b, error);
    if (status) return status;
    const double radius = 1 / (1 / a->radius + (is_plane(b) ? 0 : 1 / b->radius)), ratio = c->mass / mass;
    restitute_table_contact own = *c;
    own.speed_factor *= ratio * ratio * (radius / c->radius);
    if (!(own.speed_factor > 0 && own.speed_factor <= largest_factor))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "speed_factor = %g of the bodies: must be in (0, %g]; they are too far from the table's contact, "
                          "or contact is not one of restitute_table_contact_of",
                          own.speed_factor, largest_factor);
    status = restitute_table_pair_of(t, &own, f.approach, f.sliding, pair, NULL);
    if (status) return rst_report(error, status, "contact: not one of restitute_table_contact_of");
    part_with(pair->ez, pair->ex, &f, a, b);
    const double speed = f.approach * own.speed_factor;
    if (speed >= t->d.low && speed <= t->d.high) return rst_done(error);
    return rst_report(error, RESTITUTE_OK,
                      "normal speed in the table = %g m/s (speed_factor %g of the bodies): the table has %g to %g; its end "
                      "is taken",
                      speed, own.speed_factor, t->d.low, t->d.high);
}

int restitute_table_collide(const restitute_table *table, const restitute_table_contact *contact,
                            restitute_body *first, restitute_body *second, restitute_table_value *pair,
                            restitute_error *error)
{
    restitute_table_value own;
    if (!table || !first || !second)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !table   ? "table"
                          : !first ? "first"
                                   : "second");
    const restitute_table_contact *c = contact ? contact : &table->own;
    int status = rst_check_size(c->struct_size, sizeof *c, "restitute_table_contact", error);
    if (!status) status = rst_check_range(c->touch_gap, 0, 1, "touch_gap", error);
    if (!status) status = check_bodies(first, second, error);
    if (status) return status;
    const int first_moves = !is_plane(first) && !isinf(first->mass);
    status = first_moves ? collide(table, c, first, second, &own, error) : collide(table, c, second, first, &own, error);
    if (!status && pair) *pair = own;
    return status;
}
