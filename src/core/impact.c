/* Dimensionless input (22)-(25) and what it means to a method.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "material.h"
#include "problem.h"
#include "status.h"

/* A body with J = 0 would have chi = infinity; no sphere that turns has more than this, and the steps grow with it. */
const double rst_largest_chi = 1000;
static const double largest_number = 1e12;

void restitute_impact_init(restitute_impact *impact)
{
    if (!impact) return;
    *impact = (restitute_impact){
        .struct_size = sizeof *impact, .chi = 7.0 / 6.0, .psi = 0, .delta1 = 0, .gamma = INFINITY, .solid = NULL};
}

static int check_impact(const restitute_impact *impact, restitute_error *error)
{
    int status = rst_check_size(impact->struct_size, sizeof *impact, "restitute_impact", error);
    /* 1/3 is exact physics (nu = 1/2, blocked rotation), but reaches us rounded */
    if (!status) status = rst_check_range(impact->chi, 1.0 / 3.0 - 1e-9, rst_largest_chi, "chi", error);
    if (!status) status = rst_check_range(impact->psi, 0, largest_number, "psi", error);
    if (!status && !impact->solid) status = rst_check_range(impact->delta1, 0, largest_number, "delta1", error);
    if (!status && !impact->solid) status = rst_check_range(impact->gamma, 0, INFINITY, "gamma", error);
    return status;
}

/* Standard solid with moduli over G1: g = 1/gamma, tau = gamma theta (THEORY 3), and its limits. */
static void standard_solid(double delta1, double gamma, struct rst_solid *solid)
{
    double theta = rst_theta_from_delta1(delta1), g = 1 / gamma, tau = gamma * theta;
    solid->g_inf = 1;
    solid->eta = 0;
    solid->n_terms = 0;
    solid->can_sink = 0;
    if (delta1 <= 0 || isinf(gamma)) return;
    if (gamma <= 0 || isinf(g) || tau <= 0) {
        solid->eta = theta;
        return;
    }
    if (isinf(tau)) { /* a spring that never relaxes; its modulus g is then below 1e-290 */
        solid->g_inf += g;
        return;
    }
    solid->n_terms = 1;
    solid->g[0] = g;
    solid->tau[0] = tau;
}

static void given_solid(const restitute_material *material, struct rst_solid *solid)
{
    solid->g_inf = material->g_inf;
    solid->eta = material->eta;
    solid->n_terms = (int64_t)material->n_terms;
    solid->can_sink = material->g_inf <= 0;
    for (size_t k = 0; k < material->n_terms; k++) {
        solid->g[k] = material->g[k];
        solid->tau[k] = material->tau[k];
    }
}

void rst_set_sliding(double psi, struct rst_problem *problem)
{
    const double sticking = 1e-12; /* a slip annulus so thin changes e_x by less than any tolerance */
    problem->psi = psi > sticking && !isinf(psi) ? psi : 1;
    problem->mode = isinf(psi)       ? RST_FRICTIONLESS
                    : psi > 1        ? RST_GROSS_SLIP
                    : psi > sticking ? RST_PARTIAL_SLIP
                                     : RST_NO_SLIP;
}

int rst_problem_from_impact(const restitute_impact *impact, struct rst_problem *problem, restitute_error *error)
{
    int status = check_impact(impact, error);
    if (status) return status;
    problem->chi = impact->chi;
    rst_set_sliding(impact->psi, problem);
    problem->time_unit = 1;
    problem->unit_name = "T";
    if (impact->solid)
        given_solid(impact->solid, &problem->solid);
    else
        standard_solid(impact->delta1, impact->gamma, &problem->solid);
    return RESTITUTE_OK;
}
