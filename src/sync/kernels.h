/* The Fortran procedures of the method `sync`, and the twins of their derived types; see
 * fortran/sync/interface.f90 and fortran/sync/walk/elements.f90.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_KERNELS_H
#define RST_SYNC_KERNELS_H

#include "base/kernels.h"

/* Points of a panel beside its start. */
enum { rst_stages = 6, rst_points = rst_stages + 1 };

/* Values of an element at the edge, and of an arm of it: of_touch and of_arm. */
enum { rst_values = 4 };

/* Twin of panel_type. */
struct sync_panel {
    double from, to; /* edge angle */
    double radius[rst_points], time[rst_points], depth[rst_points], velocity[rst_points], force[rst_points],
        pace[rst_points];
};

/* Twin of normal_control_type. */
struct sync_normal_control {
    double roughness, stop_speed;
    int64_t halvings, capacity, n_coarse, n_coarse_compression;
    const struct sync_panel *coarse;
};

/* Twin of normal_arrays_type. */
struct sync_normal {
    double eta, scale, closeness, residual_speed;
    int64_t n_arms, n_compression, n_panels;
    double *g, *rate;
    struct sync_panel *panel;
    double *memory, *loading, *kernel, *entry;
};

/* Twin of contact_type. */
struct sync_contact {
    double chi, psi, roughness, noise, closeness, stress;
    int64_t mode;
};

/* Twin of record_type. */
struct sync_record {
    double from, to;
    double touch[rst_points][rst_values];
};

/* Twin of piece_type. */
struct sync_piece {
    int64_t panel, rooted;
    double from, to;
    double shear_velocity[rst_points], shear_force[rst_points], stick_radius[rst_points];
};

/* Twin of store_arrays_type. */
struct sync_store {
    int64_t capacity, n_records, n_pieces, n_trials; /* n_trials: pieces that may still be tried */
    struct sync_record *record;
    struct sync_piece *piece;
    double *corrective, *room; /* room: (rst_stages + 3) rst_points n_arms */
};

/* What rst_follow_normal and rst_follow_contact found. */
enum { RST_REBOUNDS = 0, RST_STOPS = 1, RST_LACKS_ROOM = 2, RST_DOES_NOT_CONVERGE = 3 };
enum { RST_SOLVED = 0, RST_STICKS_AGAIN = 1, RST_LACKS_PIECES = 2 };

void rst_follow_normal(const struct sync_normal_control *control, struct sync_normal *normal, int64_t *found);
void rst_follow_contact(const struct sync_normal *normal, const struct sync_contact *contact, struct sync_store *store,
                        double *velocity, int64_t *found);
void rst_sync_find_velocity(const struct sync_normal *normal, double velocity, double *angle, int64_t *returning);
void rst_sync_weights_at(double x, double *weight);

/* Twin of walk_type. */
struct walk {
    int64_t n, n_terms, capacity, start, end, mode, prescribed, divides;
    double chi, psi, g_inf, eta;
};

/* Twin of walk_level_type. */
struct walk_level {
    double step, radius, depth, velocity, force;
};

/* Twin of walk_shear_type. */
struct walk_shear {
    double velocity, force;
};

/* Twin of walk_term_type. */
struct walk_term {
    double g, decay, from_start, from_end, normal;
};

enum { walk_columns = 8, walk_lanes = 8 };

/* Sizes: level and shear 2 n + 1, memory (2 n + 1) n_terms, term 2 (n_terms + 1), body capacity
 * walk_columns, stress 2 capacity (n_terms + 1). */
void rst_follow_elements(const struct walk *walk, const double *g, const double *tau, const struct walk_level *level,
                         const double *memory, struct walk_shear *shear, struct walk_term *term, double *body,
                         double *stress, struct rst_ledger *ledger);

/* What the polynomial through the points of a panel is where these are the weights. */
static inline double rst_value_of(const double *weight, const double *y)
{
    double sum = 0;
    for (int j = 0; j < rst_points; j++)
        sum += weight[j] * y[j];
    return sum;
}

#endif
