/* One impact of two bodies in space, looked up.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include "base/two_bodies.h"

/* Times a speed it does not overflow. */
static const double largest_factor = 1e200;

static int check_chi(const restitute_table *t, const restitute_table_contact *c, double mass, const restitute_body *a,
                     const restitute_body *b, restitute_error *error)
{
    const double nu = t->d.poisson_ratio, chi = (1 - nu) / (2 - nu) * mass * (rst_mobility_of(a) + rst_mobility_of(b));
    if (isinf(c->psi_factor) || rst_same_chi(chi, t->d.chi)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %.17g of the bodies: must be the table's, %.17g", chi,
                      t->d.chi);
}

/* `a` can move. T^5 goes with mass^2/radius, so that a size is a factor on the speed. */
static int collide(const restitute_table *t, restitute_table_contact *c, restitute_body *a, restitute_body *b,
                   double *ez, double *ex, restitute_error *error)
{
    const struct rst_frame f = rst_frame_of(a, b);
    int status = rst_check_approach(&f, c->touch_gap, error);
    const double mass = 1 / (1 / a->mass + (rst_is_plane(b) ? 0 : 1 / b->mass));
    if (!status) status = check_chi(t, c, mass, a, b, error);
    if (status) return status;
    const double radius = 1 / (1 / a->radius + (rst_is_plane(b) ? 0 : 1 / b->radius)), ratio = c->mass / mass;
    c->speed_factor *= ratio * ratio * (radius / c->radius);
    if (!(c->speed_factor > 0 && c->speed_factor <= largest_factor))
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "speed_factor = %g of the bodies: must be in (0, %g]; they are too far from the table's contact, "
            "or contact is not one of restitute_table_contact_set",
            c->speed_factor, largest_factor);
    status = restitute_table_pair(t, c, f.approach, f.sliding, ez, ex, error);
    if (status) return status;
    rst_part_with(*ez, *ex, &f, a, b);
    const double speed = f.approach * c->speed_factor;
    const double factor = fmax(c->speed_factor, 1 / largest_factor); /* to divide by */
    if (speed >= t->d.low && speed <= t->d.high) return rst_done(error);
    return rst_report(
        error, RESTITUTE_OK,
        "normal speed = %g m/s: for bodies of this size the table has %g to %g m/s (its own speeds over %g); its end "
        "is taken",
        f.approach, t->d.low / factor, t->d.high / factor, factor);
}

int restitute_table_collide(const restitute_table *table, const restitute_table_contact *contact, restitute_body *first,
                            restitute_body *second, double *ez, double *ex, restitute_error *error)
{
    double own_ez, own_ex;
    if (!table || !first || !second)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !table   ? "table"
                          : !first ? "first"
                                   : "second");
    restitute_table_contact c = table->own;
    int status = contact ? rst_check_other_contact(contact, error) : RESTITUTE_OK;
    if (!status && contact) status = RST_TAKE(table_contact, &c, contact, error);
    if (status) return status;
    status = rst_check_range(c.touch_gap, 0, 1, "touch_gap", error);
    if (!status) status = rst_check_bodies(first, second, error);
    if (status) return status;
    const int first_moves = !rst_is_plane(first) && !isinf(first->mass);
    restitute_body *a = first_moves ? first : second, *b = first_moves ? second : first;
    status = collide(table, &c, a, b, &own_ez, &own_ex, error);
    if (status) return status;
    if (ez) *ez = own_ez;
    if (ex) *ex = own_ex;
    return RESTITUTE_OK;
}
