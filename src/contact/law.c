/* Contact laws: made from a material, then immutable.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/law.h"

#include <stdlib.h>

#include "base/sized.h"
#include "base/status.h"

RST_DEFAULTS(contact_law_options, .deformable = RESTITUTE_ONE_BODY_DEFORMS, .elements = 8, .terms = 4)

RST_DEFAULTS(contact_rates, 0)

static int check_options(const restitute_contact_law_options *o, restitute_error *error)
{
    if (o->deformable != RESTITUTE_ONE_BODY_DEFORMS && o->deformable != RESTITUTE_BOTH_BODIES_DEFORM)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "options.deformable = %d: must be 1 or 2 bodies",
                          o->deformable);
    if (o->elements < 8 || o->elements > rst_most_nodes || o->elements % 8)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "options.elements = %d: must be 8, 16, 24 or 32", o->elements);
    return rst_check_range(o->terms, 1, rst_most_terms, "options.terms", error);
}

/* Times, masses, radii and speeds: no product of a few of them overflows. */
static const double least = 1e-60, largest = 1e60;

static int check_times(const restitute_contact_law_options *o, size_t n_terms, restitute_error *error)
{
    if (o->shortest >= least && o->longest > o->shortest && o->longest <= largest) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "options.shortest = %g s, longest = %g s: must rise within [%g, %g], to reduce the %zu terms of "
                      "the material to %d",
                      o->shortest, o->longest, least, largest, n_terms, o->terms);
}

/* Of the bound on the relative error of G(t). The error of ez is up to a third of it
 * (docs/contact.md). */
static const double remarkable_error = 0.2, largest_error = 0.5;

static int judge_reduction(const restitute_contact_law_options *o, size_t n_terms, double bound, restitute_error *error)
{
    if (bound <= remarkable_error) return RESTITUTE_OK;
    if (!isfinite(bound))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "options.longest = %g s: the %zu terms of the material have relaxed long before and leave no "
                          "modulus; take a shorter time",
                          o->longest, n_terms);
    const int poor = bound <= largest_error;
    return rst_report(
        error, poor ? RESTITUTE_TOLERANCE_NOT_REACHED : RESTITUTE_ERROR_DOMAIN,
        "options.terms = %d, shortest = %g s, longest = %g s: the law misses G(t) of the %zu terms of the "
        "material by up to %.0f %%%s; take more terms or a narrower window",
        o->terms, o->shortest, o->longest, n_terms, 100 * bound, poor ? "" : ", at most 50 % are allowed");
}

/* The series of the material, complete or reduced. */
static int take_series(const restitute_material *material, const restitute_contact_law_options *options,
                       restitute_contact_law *law, restitute_error *error)
{
    struct rst_law *k = &law->kernel;
    const size_t n = restitute_material_terms(material);
    if (n <= (size_t)options->terms) {
        k->at.terms = (int)n;
        restitute_material_series(material, &k->g_inf, &k->eta, k->tau, k->g, NULL);
        return RESTITUTE_OK;
    }
    const int status = check_times(options, n, error);
    if (status) return status;
    double *tau = malloc(2 * n * sizeof *tau);
    if (!tau) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", n);
    struct rst_series series = {.n_terms = n, .tau = tau, .g = tau + n};
    restitute_material_series(material, &series.g_inf, &series.eta, tau, tau + n, NULL);
    rst_reduce_series(&series, options->terms, options->shortest, options->longest, k, &law->error_bound);
    free(tau);
    return judge_reduction(options, n, law->error_bound, error);
}

/* FNV-1a. The lowest 24 bits mark states: never all zero, which is a new contact. */
static uint64_t hash_of(const struct rst_law *kernel)
{
    const unsigned char *bytes = (const unsigned char *)kernel;
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < sizeof *kernel; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash | 1;
}

int restitute_contact_law_create(const restitute_material *material, const restitute_contact_law_options *options,
                                 restitute_contact_law **law, restitute_error *error)
{
    restitute_contact_law_options own;
    if (!material || !law) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", material ? "law" : "material");
    int status = RST_TAKE(contact_law_options, &own, options, error);
    if (!status) status = check_options(&own, error);
    if (status) return status;
    restitute_contact_law *made = calloc(1, sizeof *made);
    if (!made) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a contact law");
    status = take_series(material, &own, made, error);
    if (status < 0) {
        free(made);
        return status;
    }
    struct rst_law *k = &made->kernel;
    const double nu = restitute_material_poisson_ratio(material);
    k->at.n = own.elements;
    k->at.surface = k->eta > 0 || !(k->g_inf > 0);
    k->at.slips = !own.frictionless;
    k->at.turns = k->at.slips && own.slip_cycles;
    k->at.details = own.details != 0;
    k->normal = 4 / (1 - nu);
    k->tangential = 8 / (2 - nu);
    made->halved = own.deformable == RESTITUTE_BOTH_BODIES_DEFORM;
    const double share = made->halved ? 0.5 : 1; /* in series, each with its own modulus */
    k->g_inf *= share;
    k->eta *= share;
    for (int i = 0; i < k->at.terms; i++)
        k->g[i] *= share;
    k->compliance = k->g_inf > 0 ? 1 / k->g_inf : 0;
    rst_law_grid(k);
    made->hash = hash_of(k);
    rst_choose_kernels(&made->step_one, &made->step_lanes);
    *law = made;
    return status ? status : rst_done(error);
}

void restitute_contact_law_destroy(restitute_contact_law *law)
{
    free(law);
}

size_t restitute_contact_law_state_size(const restitute_contact_law *law)
{
    return law ? (size_t)(rst_at_details(law->kernel.at) + rst_details * law->kernel.at.details) : 0;
}

uint64_t restitute_contact_law_hash(const restitute_contact_law *law)
{
    return law ? law->hash : 0;
}

int restitute_contact_law_series(const restitute_contact_law *law, double *equilibrium_modulus,
                                 double *parallel_viscosity, size_t *n_terms, double *relaxation_time, double *modulus,
                                 double *error_bound, restitute_error *error)
{
    if (!law) return rst_report(error, RESTITUTE_ERROR_NULL, "law is NULL");
    const struct rst_law *k = &law->kernel;
    const double whole = law->halved ? 2 : 1;
    if (equilibrium_modulus) *equilibrium_modulus = whole * k->g_inf;
    if (parallel_viscosity) *parallel_viscosity = whole * k->eta;
    if (n_terms) *n_terms = (size_t)k->at.terms;
    for (int i = 0; i < k->at.terms; i++) {
        if (relaxation_time) relaxation_time[i] = k->tau[i];
        if (modulus) modulus[i] = whole * k->g[i];
    }
    if (error_bound) *error_bound = law->error_bound;
    return rst_done(error);
}

int restitute_contact_rates_set(const restitute_contact_law *law, double step, restitute_contact_rates *rates,
                                restitute_error *error)
{
    restitute_contact_rates made;
    if (!law || !rates) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", law ? "rates" : "law");
    int status = RST_CHECK(contact_rates, rates, error);
    if (!status) status = rst_check_range(step, least, largest, "step (s)", error);
    if (status) return status;
    restitute_contact_rates_init(&made);
    rst_law_rates(&law->kernel, step, (struct rst_rates *)made.values);
    made.step = step;
    made.law = law->hash;
    RST_GIVE(&made, rates);
    return rst_done(error);
}

int restitute_contact_time_scale(const restitute_contact_law *law, double mass, double radius, double speed,
                                 double *scale, restitute_error *error)
{
    if (!law || !scale) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", law ? "scale" : "law");
    int status = rst_check_range(mass, least, largest, "mass (kg)", error);
    if (!status) status = rst_check_range(radius, least, largest, "radius (m)", error);
    if (!status) status = rst_check_range(speed, least, largest, "speed (m/s)", error);
    if (status) return status;
    *scale = rst_law_largest_overlap(&law->kernel, mass, radius, speed) / speed;
    return rst_done(error);
}

int restitute_contact_time_step_limit(const restitute_contact_law *law, double mass, double radius, double speed,
                                      double *limit, restitute_error *error)
{
    double scale;
    if (!law || !limit) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", law ? "limit" : "law");
    const int status = restitute_contact_time_scale(law, mass, radius, speed, &scale, error);
    if (!status) *limit = RST_ELASTIC_CONTACT_TIME * scale / 50;
    return status;
}
