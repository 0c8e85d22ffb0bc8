/* From dimensionless input (22)-(25) to the problem of a method.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/material.h"
#include "base/problem.h"
#include "base/sized.h"
#include "base/status.h"

/* Largest chi. A body with J = 0 would have chi = infinity. Spheres that rotate have less than
 * this, and the number of steps grows with chi. */
const double rst_largest_chi = 1000;
static const struct rst_range numbers = {0, 1e12}; /* psi, delta1 */

RST_DEFAULTS(impact, .chi = 7.0 / 6.0, .psi = INFINITY, .gamma = INFINITY)

static int check_impact(const restitute_impact *impact, restitute_error *error)
{
    /* 1/3 is possible (nu = 1/2, blocked rotation), but input is rounded */
    int status = rst_check_range(impact->chi, 1.0 / 3.0 - 1e-9, rst_largest_chi, "chi", error);
    if (!status) status = rst_check_within(impact->psi, numbers, INFINITY, "psi", error);
    if (!status && !impact->material) status = rst_check_within(impact->delta1, numbers, NAN, "delta1", error);
    if (!status && !impact->material) status = rst_check_range(impact->gamma, 0, INFINITY, "gamma", error);
    return status;
}

/* Standard solid with moduli over G1: g = 1/gamma, tau = gamma theta (theory.md, 2), and its
 * limits. Beyond 1e-50 and 1e50 the limit is taken, so that g and tau stay within ranges.h. It
 * differs by less than 1e-20: the dashpot by gamma theta^2 (see rst_merge_terms), the elastic solid
 * by theta or 1/gamma. */
static void standard_solid(double delta1, double gamma, struct rst_solid *solid)
{
    const double small = 1e-50, theta = rst_theta_from_delta1(delta1);
    solid->g_inf = 1;
    solid->eta = 0;
    solid->n_terms = 0;
    solid->can_sink = 0;
    if (delta1 < small || gamma > 1 / small) return;
    if (gamma < small) {
        solid->eta = theta;
        return;
    }
    solid->n_terms = 1;
    solid->g[0] = 1 / gamma;
    solid->tau[0] = gamma * theta;
}

void rst_solid_of(const restitute_material *material, double factor, double time, struct rst_solid *solid)
{
    solid->g_inf = material->g_inf * factor;
    solid->eta = material->eta * factor / time;
    solid->n_terms = (int64_t)material->n_terms;
    solid->can_sink = material->g_inf <= 0;
    for (size_t k = 0; k < material->n_terms; k++) {
        solid->g[k] = material->g[k] * factor;
        solid->tau[k] = material->tau[k] / time;
    }
}

/* A psi this close to 0 or 1 is set to that value. So rounding of the input, some 1e-15, does not
 * decide how a contact begins. And the end of gross slip, 1 - D' = (psi - 1)/(2 chi - 1), is not
 * lost in the rounding of D' (chi <= 1000). e_x changes by less than any tolerance:
 * |de_x/dpsi| <= 2 on both sides of 1. */
static const double psi_rounding = 1e-12;

void rst_set_sliding(double given, struct rst_problem *problem)
{
    const double psi = fabs(given - 1) <= psi_rounding ? 1 : given <= psi_rounding ? 0 : given;
    problem->psi = psi;
    problem->mode = isinf(psi) ? RST_FRICTIONLESS : psi > 1 ? RST_GROSS_SLIP : psi > 0 ? RST_PARTIAL_SLIP : RST_NO_SLIP;
    problem->shear_speed = problem->mode == RST_FRICTIONLESS || problem->mode == RST_NO_SLIP ? 1 : psi;
    problem->shear_scale = 1;
    problem->slip_bound = 0;
}

int rst_check_damping(const struct rst_solid *solid, restitute_error *error)
{
    const double damping = solid->eta / rst_theta_from_delta1(1);
    if (damping <= numbers.high) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "delta1 = %g of the parallel viscosity: must be <= %g; no rebound of such damping is found",
                      damping, numbers.high);
}

int rst_problem_from_impact(const restitute_impact *impact, struct rst_problem *problem, restitute_error *error)
{
    int status = check_impact(impact, error);
    if (status) return status;
    problem->chi = impact->chi;
    rst_set_sliding(impact->psi, problem);
    problem->time_unit = 1;
    problem->unit_name = "T";
    if (impact->material)
        rst_solid_of(impact->material, 1, 1, &problem->solid);
    else
        standard_solid(impact->delta1, impact->gamma, &problem->solid);
    return impact->material ? rst_check_damping(&problem->solid, error) : RESTITUTE_OK;
}
