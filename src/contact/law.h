/* Inside of a contact law.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_LAW_H
#define RST_CONTACT_LAW_H

#include "contact/kernels.h"

struct restitute_contact_law {
    struct rst_law kernel;
    size_t size; /* doubles of a state */
    uint64_t hash;
    int halved; /* both bodies deform */
    double error_bound;
};

/* A relaxation modulus. */
struct rst_series {
    double g_inf, eta;
    size_t n_terms;
    const double *tau, *g;
};

/* Fit at most `terms` terms to a longer series, for times from `shortest` to `longest`. Sets g_inf,
 * eta, n_terms, tau and g of the law and the bound on the relative error of G(t): infinite if G is
 * 0 at `longest`; then no law is set. */
void rst_reduce_series(const struct rst_series *series, int terms, double shortest, double longest, struct rst_law *law,
                       double *error_bound);

#endif
