/* Two bodies of unlike materials as one solid (docs/theory.md, section 10).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>

#include "base/kernels.h"
#include "base/material.h"
#include "base/status.h"

/* Workspace of the series and its result, in one block. */
struct scratch {
    double *m_a, *m_b, *times, *m, *tau;
    int64_t *from_a, *from_b;
};

static int allocate(size_t n, struct scratch *s)
{
    double *block = malloc((4 * n + 3) * sizeof *block);
    int64_t *origins = malloc((2 * n + 1) * sizeof *origins);
    if (!block || !origins) {
        free(block);
        free(origins);
        return 1;
    }
    s->m_a = block; /* both chains' moduli need n values together */
    s->times = block + n;
    s->m = block + 2 * n;
    s->tau = block + 3 * n + 1;
    s->from_a = origins;
    s->from_b = origins + n;
    return 0;
}

/* Plane-strain moduli E* = 2 G/(1-nu), which the normal force is proportional to. */
static struct rst_chain plane_chain(const restitute_material *material, double *m)
{
    double factor = 2 / (1 - material->nu);
    for (size_t k = 0; k < material->n_terms; k++)
        m[k] = factor * material->g[k];
    return (struct rst_chain){factor * material->g_inf, factor * material->eta, (int64_t)material->n_terms};
}

/* 1/G(0+): a dashpot is rigid at first. */
static double instantaneous_compliance(const restitute_material *material)
{
    double modulus = material->g_inf;
    if (material->eta > 0) return 0;
    for (size_t k = 0; k < material->n_terms; k++)
        modulus += material->g[k];
    return 1 / modulus;
}

/* Poisson ratio and Dundurs' beta of the pair. Of two dashpots each has the share of the compliance
 * that follows from its viscosity. */
static void elastic_constants(const restitute_material *a, const restitute_material *b, double *nu, double *beta)
{
    double ja = instantaneous_compliance(a), jb = instantaneous_compliance(b);
    if (ja + jb <= 0) {
        ja = 1 / a->eta;
        jb = 1 / b->eta;
    }
    double normal = (1 - a->nu) * ja + (1 - b->nu) * jb, tangential = (2 - a->nu) * ja + (2 - b->nu) * jb;
    double ratio = 2 * normal / tangential; /* G_star/E_star = 2(1-nu)/(2-nu) */
    *nu = a->nu == b->nu ? a->nu : fmin(0.5, fmax(0, (2 - 2 * ratio) / (2 - ratio)));
    *beta = ((1 - 2 * a->nu) * ja - (1 - 2 * b->nu) * jb) / (2 * normal);
}

/* Leave out terms with moduli below the allowed range, which a rigid partner produces near each of
 * its rates. Merge terms whose rates differ by less than rounding. */
static void tidy_terms(double factor, struct rst_chain *pair, double *m, double *tau)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < pair->n; k++) {
        if (factor * m[k] < rst_moduli.low) continue;
        if (kept > 0 && tau[kept - 1] == tau[k]) {
            m[kept - 1] += m[k];
            continue;
        }
        m[kept] = m[k];
        tau[kept++] = tau[k];
    }
    pair->n = kept;
}

/* Check: the instantaneous modulus of the pair is that of two springs in series, so a lost term
 * would be noticed. 1e-9: rounding of the sum, with a margin. */
static int check_sound(const struct rst_chain *a, const double *m_a, const struct rst_chain *b, const double *m_b,
                       const struct rst_chain *pair, const double *m, restitute_error *error)
{
    double first_a = a->m_inf, first_b = b->m_inf, first = pair->m_inf;
    for (int64_t k = 0; k < a->n; k++)
        first_a += m_a[k];
    for (int64_t k = 0; k < b->n; k++)
        first_b += m_b[k];
    for (int64_t k = 0; k < pair->n; k++)
        first += m[k];
    if (a->eta > 0 && b->eta > 0) return RESTITUTE_OK; /* rigid; the viscosities are in series by construction */
    double expected = a->eta > 0 ? first_b : b->eta > 0 ? first_a : first_a / (first_a + first_b) * first_b;
    if (fabs(first - expected) <= 1e-9 * expected) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "terms have moduli below %g Pa, which no material has",
                      rst_moduli.low);
}

int restitute_material_effective(const restitute_material *material1, const restitute_material *material2,
                                 restitute_material **effective, restitute_error *error)
{
    if (!material1 || !material2 || !effective)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !material1   ? "material1"
                          : !material2 ? "material2"
                                       : "effective");
    if (material1->is_effective || material2->is_effective)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s is the effective solid of two bodies already",
                          material1->is_effective ? "material1" : "material2");
    struct scratch s;
    struct rst_chain chain;
    double nu, beta;
    size_t n = material1->n_terms + material2->n_terms;
    if (allocate(n, &s)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", n);
    s.m_b = s.m_a + material1->n_terms;
    struct rst_chain a = plane_chain(material1, s.m_a), b = plane_chain(material2, s.m_b);
    rst_series_chain(&a, s.m_a, material1->tau, &b, s.m_b, material2->tau, s.times, s.from_a, s.from_b, &chain, s.m,
                     s.tau);
    elastic_constants(material1, material2, &nu, &beta);
    const double factor = (1 - nu) / 2;
    restitute_material *made;
    restitute_error why;
    tidy_terms(factor, &chain, s.m, s.tau);
    int status = check_sound(&a, s.m_a, &b, s.m_b, &chain, s.m, &why);
    for (int64_t k = 0; k < chain.n; k++)
        s.m[k] *= factor;
    if (!status)
        status = restitute_material_prony(factor * chain.m_inf, factor * chain.eta, (size_t)chain.n, s.tau, s.m, nu,
                                          &made, &why);
    free(s.m_a);
    free(s.from_a);
    if (status) return rst_report(error, status, "effective solid of material1 and material2: %s", why.message);
    made->beta = beta;
    made->is_effective = 1;
    made->window[0] = fmax(material1->window[0], material2->window[0]);
    made->window[1] = fmin(material1->window[1], material2->window[1]);
    *effective = made;
    return rst_done(error);
}

double restitute_material_dundurs(const restitute_material *material)
{
    return material ? material->beta : NAN;
}
