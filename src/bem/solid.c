/* The recursion over time. With E_k = exp(-h/lambda_k), phi_k = (1 - E_k) lambda_k/h, f changing
 * linearly in the step:
 *   b_k' = E_k b_k + J_k phi_k (f' - f),   u' = J_inf f' - sum b_k'.
 * With u = 0 the recursion itself oscillates: f' = -r f. For terms that are slow in comparison with
 * the step r = (h/2 sum J_k/lambda_k - J_0)/(h/2 sum J_k/lambda_k + J_0). As in the trapezoidal
 * rule, r is near 1 if the instantaneous compliance is very small. The paper's steps have phi_k =
 * 1. Terms much faster or slower than the impact are exact limits of it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/solid.h"

#include <math.h>

#include "bem/kernels.h"

void rst_bem_solid_creep(const struct rst_solid *relaxation, struct bem_solid *creep)
{
    rst_bem_creep_form(relaxation->g_inf, relaxation->n_terms, relaxation->g, relaxation->tau, &creep->instantaneous,
                       &creep->flow, &creep->n_terms, creep->compliance, creep->lambda);
}

/* A term relaxes by J_k (1 - exp(-t/lambda_k)): with lambda_k far below the duration it is J_k but
 * for about J_k lambda_k/t of the time, far above it at most J_k t/lambda_k. Both kinds are left
 * out if this is below the given share of the compliance. */
static const double negligible = 1e-6;

void rst_bem_solid_prune(double shortest, double longest, struct bem_solid *s)
{
    double compliance = s->instantaneous + s->flow * shortest;
    int64_t kept = 0;
    for (int64_t k = 0; k < s->n_terms; k++)
        compliance += s->compliance[k] * -expm1(-shortest / s->lambda[k]);
    for (int64_t k = 0; k < s->n_terms; k++) {
        const double share = negligible * compliance / s->compliance[k];
        const int fast = s->lambda[k] < shortest && s->lambda[k] / shortest < share;
        const int slow = s->lambda[k] >= longest && longest / s->lambda[k] <= share;
        if (fast) {
            s->instantaneous += s->compliance[k];
        } else if (!slow) {
            s->compliance[kept] = s->compliance[k];
            s->lambda[kept++] = s->lambda[k];
        }
    }
    s->n_terms = kept;
}

void rst_bem_solid_step(double h, int jumps, struct bem_solid *s)
{
    s->half_flow = s->flow * h / 2;
    s->c = s->instantaneous + s->half_flow;
    s->held = s->half_flow;
    double slow = s->half_flow; /* contribution to c of terms that are slow in comparison with the step */
    for (int64_t k = 0; k < s->n_terms; k++) {
        const double x = h / s->lambda[k];
        const double phi = jumps || x < 1e-9 ? 1 : -expm1(-x) / x;
        s->decay[k] = exp(-x);
        s->gain[k] = s->compliance[k] * phi;
        s->held += s->gain[k];
        /* J_k - gain_k, without the difference of two large numbers when the term is slow */
        s->c += jumps ? 0 : s->compliance[k] * (x < 1e-4 ? x / 2 - x * x / 6 : 1 - phi);
        slow += s->compliance[k] * (x < 1e-4 ? x / 2 - x * x / 6 : 1 - phi) * exp(-x * x);
    }
    s->ringing = jumps ? 0 : slow / s->c;
}
