/* Other contacts that a table covers.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/column.h"

#include <stdlib.h>

/* Both are what the core computes from its material. */
static int alike(double a, double b)
{
    const double rounding = 1e-12;
    return a == b || fabs(a - b) <= rounding * fmax(fabs(a), fabs(b));
}

/* Ratio of the times and of the moduli of a material to those of the table. */
struct shift {
    double time, modulus;
};

/* All moduli of `m` over the table's, and all times; 0: not one factor, -1: out of memory. */
static int find_shift(const restitute_table_data *d, const restitute_material *m, struct shift *shift)
{
    double g_inf, eta;
    const size_t n = (size_t)d->terms;
    if (n != restitute_material_terms(m) || !alike(d->poisson_ratio, restitute_material_poisson_ratio(m))) return 0;
    double *term = malloc(2 * (n + 1) * sizeof *term);
    if (!term) return -1;
    restitute_material_series(m, &g_inf, &eta, term, term + n, NULL);
    shift->modulus = d->equilibrium_modulus > 0 ? g_inf / d->equilibrium_modulus : n > 0 ? term[n] / d->modulus[0] : 1;
    shift->time = n > 0 ? term[0] / d->relaxation_time[0]
                  : d->parallel_viscosity > 0 ? eta / d->parallel_viscosity / shift->modulus
                                              : 1;
    int same = shift->modulus > 0 && shift->time > 0 && alike(g_inf, shift->modulus * d->equilibrium_modulus) &&
               alike(eta, shift->modulus * shift->time * d->parallel_viscosity);
    for (size_t k = 0; k < n && same; k++)
        same = alike(term[k], shift->time * d->relaxation_time[k]) && alike(term[n + k], shift->modulus * d->modulus[k]);
    free(term);
    return same;
}

/* e^x within what times a strain neither overflows nor vanishes. */
static double bounded_exp(double x)
{
    const double most = 230;
    return exp(fmax(-most, fmin(most, x)));
}

/* What strains the model over that of the table, at speeds that are `ratio`^5 of this contact's:
 * T v is d0, a_el/R is sqrt(d0/R), and v/c_s goes with v sqrt(density/G). */
static void set_strains(const restitute_table_data *d, const restitute_numbers *n, struct shift shift, double ratio,
                        restitute_table_contact *found)
{
    const double time = log(n->time / d->duration), depth = time - 4 * log(ratio);
    found->strain_factors[0] =
        bounded_exp(0.5 * (log(n->density) - log(d->density) - log(shift.modulus)) - 5 * log(ratio));
    found->strain_factors[1] = found->strain_factors[2] = bounded_exp(0.5 * (depth + log(d->radius / n->radius)));
    found->strain_factors[3] = bounded_exp(time + log(ratio) - log(shift.time));
    found->dundurs_beta = n->dundurs_beta;
}

/* The result depends on the relaxation times over T, and T is proportional to v^(-1/5). So a
 * contact that is f times as long is that at f^-5 times the speed. Relaxation times that are f
 * times as long have the same effect as a contact time shorter by f. */
static int bind(const restitute_table *t, const struct rst_contact *c, restitute_table_contact *found,
                restitute_error *error)
{
    const double largest_ratio = 1e40; /* its fifth power times a speed neither overflows nor vanishes */
    const restitute_table_data *d = &t->d;
    struct shift shift;
    const int same = find_shift(d, c->scene.material, &shift);
    if (same < 0) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (!same)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "scene.material: must be the one the table is for; its times may be longer by one factor and "
                          "its moduli larger by one");
    if (d->friction > 0 && c->friction > 0 && !rst_same_chi(c->numbers.chi, d->chi))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %.17g of the scene: must be the table's, %.17g",
                          c->numbers.chi, d->chi);
    if ((d->friction <= 0 || isinf(d->friction)) && c->friction != d->friction && c->friction > 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "friction = %g: must be %g, the only one of this table",
                          c->friction, d->friction);
    const double ratio = c->timeless ? 1 : d->duration * shift.time / c->numbers.time;
    if (!(ratio <= largest_ratio && ratio >= 1 / largest_ratio))
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "speed_factor = %g^5 of the scene: must be in [%g, %g]^5; it is too far from the table's contact", ratio,
            1 / largest_ratio, largest_ratio);
    found->speed_factor = ratio * ratio * ratio * ratio * ratio;
    found->psi_factor = rst_psi_factor(c);
    found->radius = c->numbers.radius;
    found->mass = c->numbers.mass;
    set_strains(d, &c->numbers, shift, ratio, found);
    return RESTITUTE_OK;
}

int restitute_table_contact_set(const restitute_table *table, const restitute_scene *scene,
                                restitute_table_contact *contact, restitute_error *error)
{
    struct rst_contact c;
    restitute_table_contact found;
    if (!table || !scene || !contact)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", !table ? "table" : !scene ? "scene" : "contact");
    int status = RST_TAKE(table_contact, &found, contact, error);
    if (!status) status = rst_contact_set(scene, &c, error);
    if (status) return status;
    status = bind(table, &c, &found, error);
    if (status) return status;
    RST_GIVE(&found, contact);
    return rst_done(error);
}
