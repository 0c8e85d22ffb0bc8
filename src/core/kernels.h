/* The Fortran procedures that C calls, and the twins of their derived types; see fortran/c_interfaces.f90.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_KERNELS_H
#define RST_KERNELS_H

#include <stdint.h>

/* Phases and modes of fortran/euler.f90. */
enum rst_phase {
    RST_COMPRESSION = 0,
    RST_RESTITUTION = 1,
    RST_DONE = 2,
    RST_SUNK = 3,
    RST_OVERFLOW = 4,
    RST_STALLED = 5
};
enum rst_mode { RST_FRICTIONLESS = 0, RST_GROSS_SLIP = 1, RST_PARTIAL_SLIP = 2, RST_NO_SLIP = 3 };

/* Twin of ledger_type. */
struct euler_ledger {
    double viscous_z, left_z;
    double friction_x, viscous_x, left_x;
};

/* Twin of scene_type. */
struct euler_scene {
    double chi, psi;
    double g_inf, eta;
    double step, spacing;
    double rest_speed;
    int64_t n_terms, capacity;
    int64_t can_sink, keep_ledger, mode;
};

/* Twin of state_type. */
struct euler_state {
    double time, depth, velocity, shift, shear_velocity;
    double force, shear_force, true_edge_force, true_edge_shear, centre_force, leave_time;
    double max_depth, max_force, max_time;
    int64_t n_contact, max_contact, phase, mode, n_steps, n_updates, n_stalled;
    struct euler_ledger ledger;
};

/* Twin of chain_type. */
struct rst_chain {
    double m_inf, eta;
    int64_t n;
};

/* Twins of grid_type, level_type and node_type of fortran/sync_grid.f90. */
struct sync_grid {
    double radius, start, turn;
};
struct sync_level {
    double time, step, depth, velocity, force, fresh, missing, weight[4];
};
struct sync_node {
    double radius, width;
};

/* Twin of trace_type of fortran/sync_dense.f90. */
struct sync_trace {
    double memory, loading, fade, decay, from_start, from_end, from_bend;
};

/* Twins of scene_type and shear_type of fortran/sync_elements.f90. */
struct sync_scene {
    double chi, psi, g_inf, eta;
    int64_t n_terms, n, capacity;
    int64_t no_slip, stepped; /* stepped: with elements from the start; 0: if slip does not stay behind one front */
};
struct sync_shear {
    double time, shift, velocity, force, step_before[2], force_before[2], normal_before[3], slope;
    double passive_weight, passive_alpha;
    int64_t known, level, first, front, updates;
};

/* Twin of term_type of fortran/sync_elements.f90. */
struct sync_term {
    double decay, from_start, from_end, from_bend, stress, next_stress;
    double beta_sum, faded_sum, age_before, age;
};

/* Twin of knot_type of fortran/sync_record.f90. */
struct sync_knot {
    double time, velocity, force, stick;
};

/* Twin of loss_type of fortran/sync_ledger.f90. */
struct sync_loss {
    int64_t fast;
    double h, g, tau, keep[3], from_start[3], from_end[3], once[4], twice[4];
};

/* What fortran/sync_ledger.f90 is told of the tangential side. */
enum sync_sliding { RST_HAS_NO_FRICTION = 0, RST_SLIPS_TO_THE_END = 1, RST_STICKS = 2 };

/* The loop over elements, which only Fortran calls, and the layout of its arrays. */
struct sync_step;
struct sync_sums;
enum { rst_sync_lanes = 8, rst_sync_columns = 4 };

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

void rst_merge_terms(double chi, double window, double depth, double allowed, double *g_inf, double *eta,
                     int64_t *n_terms, double *g, double *tau, double *slow_rate, double *fast_bound);
void rst_series_chain(const struct rst_chain *a, const double *m_a, const double *tau_a, const struct rst_chain *b,
                      const double *m_b, const double *tau_b, double *times, int64_t *from_a, int64_t *from_b,
                      struct rst_chain *pair, double *m, double *tau);
void rst_scout_compression(double g_inf, double eta, int64_t n_terms, const double *g, const double *tau,
                           int64_t can_sink, double rest_speed, double *stress, double *depth, double *time,
                           double *force, int64_t *sinks);

void rst_start_impact(const struct euler_scene *scene, struct euler_state *state, double *x2);
void rst_advance_impact(const struct euler_scene *scene, const double *g, const double *tau, const double *decay,
                        const double *gain, const double *x2, double *f, double *yz, double *u, double *yx, double *q,
                        double *slip, double *move, double *q_before, int64_t n_steps, struct euler_state *state);

double rst_likely_depth(double g_inf, double eta, int64_t n_terms, const double *g, const double *tau);
void rst_choose_grid(double g_inf, double eta, int64_t n_terms, const double *g, const double *tau,
                     struct sync_grid *grid);
void rst_thin_levels(int64_t n_terms, int64_t n, const struct sync_level *level, const struct sync_trace *trace,
                     const struct sync_node *node, struct sync_level *thin_level, struct sync_trace *thin_trace,
                     struct sync_node *thin_node);

struct rst_sample;
void rst_normal_levels(const struct sync_grid *grid, double g_inf, double eta, int64_t n_terms,
                                const double *g, const double *tau, int64_t n, double closeness, int64_t guessed,
                                struct sync_level *level, double *memory, double *loading, struct sync_node *node,
                                int64_t *failed);
void rst_double_levels(int64_t n, struct sync_level *level);
void rst_dense_levels(const struct sync_grid *grid, double g_inf, double eta, int64_t n_terms, const double *g,
                               const double *tau, int64_t n, int64_t r, const struct sync_level *coarse,
                               struct sync_level *level, struct sync_trace *trace, struct sync_node *node,
                               int64_t *failed);
void rst_finish_levels(double g_inf, int64_t n_terms, int64_t n, const struct sync_trace *trace,
                                const struct sync_node *node, struct sync_level *level);
void rst_follow_shear(const struct sync_scene *scene, const double *g, const double *tau,
                               const struct sync_level *level, const struct sync_trace *trace,
                               const struct sync_node *node, double *body, double *beta, double *faded,
                               struct sync_term *term, struct sync_shear *state);
void rst_trace_shear(const struct sync_scene *scene, const double *g, const double *tau,
                     const struct sync_level *level, const struct sync_trace *trace, const struct sync_node *node,
                     double *body, double *beta, double *faded, struct sync_term *term, int64_t *n_knots,
                     struct sync_knot *knot);
void rst_edge_rates(const struct sync_scene *scene, const double *g, const double *tau, const struct sync_level *level,
                    const struct sync_trace *trace, double *rate);
void rst_sample_impact(const struct sync_scene *scene, int64_t slides, const struct sync_level *level,
                       const struct sync_node *node, const double *rate, int64_t n_knots, const struct sync_knot *knot,
                       int64_t l, int64_t i, double time, struct rst_sample *sample);
void rst_keep_ledger(const struct sync_scene *scene, int64_t kind, const double *g,
                     const double *tau, const struct sync_level *level, const struct sync_trace *trace,
                     const struct sync_node *node, double *body, double *beta, double *faded, struct sync_term *term,
                     double *before, struct sync_term *now, struct sync_loss *loss, struct euler_ledger *ledger);

#endif
