/* A solid in creep form, and its coefficients for one time step (19),(20).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_SOLID_H
#define BEM_SOLID_H

#include <stdint.h>

#include "base/problem.h"

/* J(t) = instantaneous + sum_k compliance_k (1 - exp(-t/lambda_k)) + flow t, over 1/G_r. */
struct bem_solid {
    double instantaneous, flow;
    int64_t n_terms;
    double *compliance, *lambda;
    double *decay, *gain;      /* of a step: b_k = decay_k b_k + gain_k df */
    double ringing;            /* of a step: 1 - J_0/c if terms are slow in comparison, 0 if they are fast */
    double c, held, half_flow; /* u = c f - sum decay_k b_k + held f_before + drift */
};

static inline int rst_bem_is_elastic(const struct bem_solid *solid)
{
    return solid->n_terms == 0 && !(solid->flow > 0);
}

/* The arrays of `creep` hold at least the terms of the solid, and at least 1. */
void rst_bem_solid_creep(const struct rst_solid *relaxation, struct bem_solid *creep);

/* Leave out terms that act as a spring, or not at all, in impacts of a duration from `shortest` to
 * `longest`. */
void rst_bem_solid_prune(double shortest, double longest, struct bem_solid *creep);

/* For steps of h in which f changes linearly, or (jumps) at their beginning, as in the paper. */
void rst_bem_solid_step(double h, int jumps, struct bem_solid *creep);

#endif
