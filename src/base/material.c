/* Linear-viscoelastic solids: G(t) = G_inf + sum_k G_k exp(-t/tau_k) + eta delta(t)
 * (docs/theory.md, section 1).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/material.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/kernels.h"
#include "base/status.h"

/* The k-th of the times or moduli. */
static int check_term(double value, struct rst_range range, const char *what, size_t k, const char *unit,
                      restitute_error *error)
{
    char name[48];
    if (rst_is_within(value, range, NAN)) return RESTITUTE_OK;
    snprintf(name, sizeof name, "%s[%zu] (%s)", what, k, unit);
    return rst_check_within(value, range, NAN, name, error);
}

static int check_terms(size_t n_terms, const double *tau, const double *g, restitute_error *error)
{
    if (n_terms > 0 && (!tau || !g))
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL with n_terms = %zu",
                          tau ? "modulus" : "relaxation_time", n_terms);
    int status = RESTITUTE_OK;
    for (size_t k = 0; k < n_terms && !status; k++) {
        status = check_term(tau[k], rst_times, "relaxation_time", k, "s", error);
        if (!status) status = check_term(g[k], rst_moduli, "modulus", k, "Pa", error);
    }
    return status;
}

struct term {
    double tau, g;
};

static int by_time(const void *a, const void *b)
{
    double x = ((const struct term *)a)->tau, y = ((const struct term *)b)->tau;
    return (x > y) - (x < y);
}

/* Copy the terms sorted by their times, so that equal times are neighbours. */
static int sort_terms(restitute_material *m, const double *tau, const double *g, restitute_error *error)
{
    if (m->n_terms == 0) return RESTITUTE_OK;
    struct term *terms = malloc(m->n_terms * sizeof *terms);
    if (!terms) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", m->n_terms);
    for (size_t k = 0; k < m->n_terms; k++)
        terms[k] = (struct term){tau[k], g[k]};
    qsort(terms, m->n_terms, sizeof *terms, by_time);
    int status = RESTITUTE_OK;
    for (size_t k = 0; k < m->n_terms; k++) {
        m->tau[k] = terms[k].tau;
        m->g[k] = terms[k].g;
        if (k > 0 && m->tau[k - 1] == m->tau[k])
            status =
                rst_report(error, RESTITUTE_ERROR_DOMAIN,
                           "relaxation_time = %.17g s appears twice: times must differ, add the two moduli", m->tau[k]);
    }
    free(terms);
    return status;
}

int restitute_material_prony(double equilibrium_modulus, double parallel_viscosity, size_t n_terms,
                             const double *relaxation_time, const double *modulus, double poisson_ratio,
                             restitute_material **material, restitute_error *error)
{
    if (!material) return rst_report(error, RESTITUTE_ERROR_NULL, "material is NULL");
    int status = rst_check_within(equilibrium_modulus, rst_moduli, 0, "equilibrium_modulus (Pa)", error);
    if (!status) status = rst_check_within(parallel_viscosity, rst_viscosities, 0, "parallel_viscosity (Pa s)", error);
    if (!status) status = rst_check_range(poisson_ratio, 0, 0.5, "poisson_ratio", error);
    if (!status) status = check_terms(n_terms, relaxation_time, modulus, error);
    if (status) return status;
    if (equilibrium_modulus <= 0 && parallel_viscosity <= 0 && n_terms == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "equilibrium_modulus = 0, parallel_viscosity = 0 and n_terms = 0: one must be > 0");
    if (n_terms > (SIZE_MAX - sizeof(restitute_material)) / (2 * sizeof(double)))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "n_terms = %zu: too many", n_terms);

    restitute_material *m = malloc(sizeof *m + 2 * n_terms * sizeof(double));
    if (!m) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", n_terms);
    m->g_inf = equilibrium_modulus;
    m->eta = parallel_viscosity;
    m->nu = poisson_ratio;
    m->beta = 0;
    m->is_effective = 0;
    m->window[0] = 0;
    m->window[1] = INFINITY;
    m->n_terms = n_terms;
    m->tau = m->values;
    m->g = m->values + n_terms;
    status = sort_terms(m, relaxation_time, modulus, error);
    if (status) {
        free(m);
        return status;
    }
    *material = m;
    return rst_done(error);
}

int restitute_material_elastic(double shear_modulus, double poisson_ratio, restitute_material **material,
                               restitute_error *error)
{
    int status = rst_check_within(shear_modulus, rst_moduli, NAN, "shear_modulus (Pa)", error);
    if (status) return status;
    return restitute_material_prony(shear_modulus, 0, 0, NULL, NULL, poisson_ratio, material, error);
}

int restitute_material_standard_solid(double modulus1, double modulus2, double viscosity, double poisson_ratio,
                                      restitute_material **material, restitute_error *error)
{
    int status = rst_check_within(modulus1, rst_moduli, NAN, "modulus1 (Pa)", error);
    if (!status) status = rst_check_within(modulus2, rst_moduli, NAN, "modulus2 (Pa)", error);
    if (!status) status = rst_check_within(viscosity, rst_viscosities, NAN, "viscosity (Pa s)", error);
    if (status) return status;
    double tau = viscosity / modulus2;
    return restitute_material_prony(modulus1, 0, 1, &tau, &modulus2, poisson_ratio, material, error);
}

int restitute_material_kelvin_voigt(double modulus1, double viscosity, double poisson_ratio,
                                    restitute_material **material, restitute_error *error)
{
    int status = rst_check_within(modulus1, rst_moduli, NAN, "modulus1 (Pa)", error);
    if (!status) status = rst_check_within(viscosity, rst_viscosities, NAN, "viscosity (Pa s)", error);
    if (status) return status;
    return restitute_material_prony(modulus1, viscosity, 0, NULL, NULL, poisson_ratio, material, error);
}

int restitute_material_maxwell(double modulus, double viscosity, double poisson_ratio, restitute_material **material,
                               restitute_error *error)
{
    int status = rst_check_within(modulus, rst_moduli, NAN, "modulus (Pa)", error);
    if (!status) status = rst_check_within(viscosity, rst_viscosities, NAN, "viscosity (Pa s)", error);
    if (status) return status;
    double tau = viscosity / modulus;
    return restitute_material_prony(0, 0, 1, &tau, &modulus, poisson_ratio, material, error);
}

void restitute_material_destroy(restitute_material *material)
{
    free(material);
}

double restitute_material_modulus(const restitute_material *material, double time)
{
    if (!material || !(time > 0)) return NAN;
    return rst_relaxation_modulus(time, material->g_inf, (int64_t)material->n_terms, material->g, material->tau);
}

double restitute_material_poisson_ratio(const restitute_material *material)
{
    return material ? material->nu : NAN;
}

size_t restitute_material_terms(const restitute_material *material)
{
    return material ? material->n_terms : 0;
}

int restitute_material_series(const restitute_material *material, double *equilibrium_modulus,
                              double *parallel_viscosity, double *relaxation_time, double *modulus,
                              restitute_error *error)
{
    if (!material) return rst_report(error, RESTITUTE_ERROR_NULL, "material is NULL");
    if (equilibrium_modulus) *equilibrium_modulus = material->g_inf;
    if (parallel_viscosity) *parallel_viscosity = material->eta;
    for (size_t k = 0; k < material->n_terms; k++) {
        if (relaxation_time) relaxation_time[k] = material->tau[k];
        if (modulus) modulus[k] = material->g[k];
    }
    return rst_done(error);
}

int restitute_material_set_window(restitute_material *material, double shortest, double longest, restitute_error *error)
{
    if (!material) return rst_report(error, RESTITUTE_ERROR_NULL, "material is NULL");
    if (!(shortest >= 0 && longest > shortest))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "window from %g to %g s: must begin at >= 0 and end later than it begins", shortest, longest);
    material->window[0] = shortest;
    material->window[1] = longest;
    return rst_done(error);
}

int restitute_material_window(const restitute_material *material, double *shortest, double *longest,
                              restitute_error *error)
{
    if (!material) return rst_report(error, RESTITUTE_ERROR_NULL, "material is NULL");
    if (shortest) *shortest = material->window[0];
    if (longest) *longest = material->window[1];
    return rst_done(error);
}

int restitute_material_shifted(const restitute_material *material, double time_shift, restitute_material **shifted,
                               restitute_error *error)
{
    if (!material || !shifted)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", material ? "shifted" : "material");
    int status = rst_check_range(time_shift, 1e-100, 1e100, "time_shift", error);
    if (status) return status;
    double *tau = malloc((material->n_terms + 1) * sizeof *tau);
    if (!tau) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", material->n_terms);
    for (size_t k = 0; k < material->n_terms; k++)
        tau[k] = time_shift * material->tau[k];
    restitute_material *made;
    restitute_error why;
    status = restitute_material_prony(material->g_inf, time_shift * material->eta, material->n_terms, tau, material->g,
                                      material->nu, &made, &why);
    free(tau);
    if (status) return rst_report(error, status, "with time_shift = %g: %s", time_shift, why.message);
    made->beta = material->beta;
    made->is_effective = material->is_effective;
    const double most = DBL_MAX / fmax(time_shift, 1); /* of a window, which has no range */
    for (int i = 0; i < 2; i++)
        made->window[i] = material->window[i] > most ? (double)INFINITY : time_shift * material->window[i];
    *shifted = made;
    return rst_done(error);
}
