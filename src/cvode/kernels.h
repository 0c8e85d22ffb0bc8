/* The Fortran procedures of the method cvode, and the twins of their derived types; see the folder
 * fortran/cvode.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_KERNELS_H
#define RST_CVODE_KERNELS_H

#include <stdint.h>

/* What an element does. */
enum cvode_motion { RST_ELEMENT_STICKS = 0, RST_ELEMENT_SLIPS_FORWARD = 1, RST_ELEMENT_SLIPS_BACKWARD = -1 };

/* Twin of scene_type. */
struct cvode_scene {
    double chi, g_inf, eta, reference, step_start;
    int64_t n_terms, n_modes, n_states, n_knots, n_nodes, n_entered, restitution, mode;
};

/* Twin of contact_type. */
struct cvode_contact {
    double square, radius, force;
};

/* Twin of shear_sums_type. */
struct cvode_sums {
    double force, stick, backward;
    int64_t n_contact;
};

/* Twin of energy_type. */
struct element_energy {
    double f, q, viscous_z, viscous_x, held_z, held_x;
    int64_t motion;
};

void rst_cvode_normal_rates(const struct cvode_scene *scene, const double *g, const double *tau, const double *knot,
                            const double *memory, int64_t *near, double t, const double *y, double *rate,
                            struct cvode_contact *contact);
/* Hermite's cubic through depth and velocity at two knots (time, depth, velocity), and its
 * slope. */
void rst_cvode_hermite(const double *before, const double *after, double t, double *depth, double *slope);
void rst_cvode_past(const struct cvode_scene *scene, const double *knot, const double *memory, double t, double *past);
void rst_cvode_recovery_modes(int64_t n_terms, int64_t n_modes, double g_inf, double eta, const double *g,
                              const double *tau, double *matrix, double *rate, double *u, double *v, double *from_u,
                              double *from_v);
void rst_cvode_margins(const struct cvode_scene *scene, const double *g, const double *tau,
                       const struct cvode_contact *contact, const double *x, const double *entry, const double *past,
                       const double *shift, const double *c, const double *b, const double *layer_weight,
                       const double *start_y, const double *start_rate, double t, const double *y, int64_t *n_contact,
                       double *d, double *f, double *layer);
void rst_cvode_shear_rates(const struct cvode_scene *scene, const double *g, const double *tau,
                           const struct cvode_contact *contact, const double *x, const double *entry,
                           const int64_t *motion, int64_t n_contact, const double *d, const double *f,
                           const double *layer, double t, const double *y, double *rate, struct cvode_sums *sums);
void rst_cvode_force_by_rule(const struct cvode_scene *scene, const double *tau, const struct cvode_contact *contact,
                             const double *x, const double *entry, const double *past, const double *c,
                             const double *layer_weight, int64_t n_contact, const double *f, double t, const double *y,
                             double *force);
void rst_cvode_layer_weights(const struct cvode_scene *scene, const double *tau, const double *entry,
                             double *layer_weight);
void rst_cvode_slip_rates(const struct cvode_scene *scene, const int64_t *motion, int64_t n_contact,
                          const double *rate_of, const double *u_of, const double *amplitude, double least_stress,
                          double least_velocity, const double *d, const double *f, double t, const double *y,
                          double *value);
void rst_cvode_fade(const struct cvode_scene *scene, const double *tau, const double *rate_of, double time, double *c,
                    double *b, double *amplitude);
void rst_cvode_enter_element(const struct cvode_scene *scene, const double *tau, int64_t i, double entry,
                             const double *past, const double *y, int64_t *motion, double *shift, double *c, double *b,
                             double *amplitude);
void rst_cvode_begin_slip(const struct cvode_scene *scene, const double *g, const double *x, int64_t i, const double *d,
                          const double *f, const double *from_u, const double *from_v, const double *shift,
                          const double *c, const double *b, const double *y, int64_t *motion, double *amplitude);
void rst_cvode_begin_stick(const struct cvode_scene *scene, const double *g, const double *x, int64_t i,
                           const double *u_of, const double *v_of, double *shift, const double *c, double *b,
                           const double *y, int64_t *motion, const double *amplitude);
void rst_cvode_solve_newton(const struct cvode_scene *scene, const double *g, const double *tau,
                            const struct cvode_contact *contact, const struct cvode_sums *sums, double gamma,
                            const double *y, const double *b, double *x);
void rst_cvode_element_energies(const struct cvode_scene *scene, const double *g, const double *tau, const double *x,
                                const double *entry, const double *past, const int64_t *motion, const double *shift,
                                const double *c, const double *b, const double *rate_of, const double *u_of,
                                const double *v_of, const double *amplitude, int64_t shears, int64_t n_last, double t,
                                const double *y, struct element_energy *energy);

#endif
