/* The Fortran procedures of the contact law; structs as in fortran/contact/types.f90.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_KERNELS_H
#define RST_CONTACT_KERNELS_H

#include <restitute/contact.h>

enum { rst_most_nodes = 32, rst_most_terms = 8 };

struct rst_law {
    int64_t n, n_terms, surface, slips, accounts;
    int64_t layout[4], size; /* of a state in doubles; both set with the grid */
    double g_inf, eta, compliance;
    double normal, tangential;
    double g[rst_most_terms], tau[rst_most_terms];
    double x[rst_most_nodes + 1], y[rst_most_nodes + 1];
    double weight[rst_most_nodes], outwards[rst_most_nodes], per_cell[rst_most_nodes], bit[rst_most_nodes];
};

enum { rst_step_done, rst_step_too_long, rst_normal_jumped };

void rst_law_grid(struct rst_law *law);
void rst_law_rates(const struct rst_law *law, double step, restitute_contact_rates *rates);
double rst_law_contact_time(const struct rst_law *law, double mass, double speed, double radius);
void rst_law_step(const struct rst_law *law, const restitute_contact_rates *rates,
                  const restitute_contact_motion *motion, double *state, restitute_contact_force *force,
                  int64_t *status);
void rst_law_force(const double *normal, const double *state, restitute_contact_force *force);
double rst_law_stored(const struct rst_law *law, double radius, const double *state);
void rst_law_turn(const double *from, const double *to, double *state);

#endif
