/* The Fortran procedures that all methods share, and the twins of their derived types; see the
 * folder fortran/common.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_KERNELS_H
#define RST_KERNELS_H

#include <stdint.h>

/* How friction acts: not at all; psi > 1, all slips at first; psi <= 1, the edge slips; all sticks.
 * As in fortran/common/friction_mode.f90. */
enum rst_mode { RST_FRICTIONLESS = 0, RST_GROSS_SLIP = 1, RST_PARTIAL_SLIP = 2, RST_NO_SLIP = 3 };

/* Twin of ledger_type. */
struct rst_ledger {
    double viscous_z, left_z;
    double friction_x, viscous_x, left_x;
};

/* Twin of chain_type. */
struct rst_chain {
    double m_inf, eta;
    int64_t n;
};

/* Force in units of m v/T over int_0^A f dX: 15/8. */
double rst_mass_factor(void);
/* Contact time of an elastic impact over its largest indentation, in units of docs/theory.md,
 * section 2. */
double rst_elastic_contact_time(void);
double rst_relaxation_modulus(double t, double g_inf, int64_t n_terms, const double *g, const double *tau);
void rst_step_coefficients(double h, int64_t n_terms, const double *g, const double *tau, double *decay, double *gain);
double rst_largest_stable_step(double coupling, double g_inf, double eta, int64_t n_terms, const double *g,
                               const double *tau);

double rst_elastic_contact_radius(double m, double r, double speed, double g, double nu);
double rst_tangential_mass_ratio(double m, double inverse_tangential_mass, double nu);
double rst_sliding_ratio(double sliding_speed, double friction, double normal_speed, double nu);
double rst_damping_modulus(double m, double r, double speed, double eta, double nu);
double rst_theta_from_delta1(double delta1);
double rst_critical_psi(double chi, double ez);
double rst_plane_profile(double x, double radius);

void rst_merge_terms(double share, double window, double depth, double allowed, double *g_inf, double *eta,
                     int64_t *n_terms, double *g, double *tau, double *slow_rate, double *fast_bound);
void rst_series_chain(const struct rst_chain *a, const double *m_a, const double *tau_a, const struct rst_chain *b,
                      const double *m_b, const double *tau_b, double *times, int64_t *from_a, int64_t *from_b,
                      struct rst_chain *pair, double *m, double *tau);
void rst_scout_compression(double g_inf, double eta, int64_t n_terms, const double *g, const double *tau,
                           int64_t can_sink, double rest_speed, double *stress, double *depth, double *time,
                           double *force, int64_t *sinks);
double rst_recoverable_energy(double depth, double g_inf, int64_t n_terms, const double *g, const double *stress);
double rst_likely_depth(double g_inf, double eta, int64_t n_terms, const double *g, const double *tau);

#endif
