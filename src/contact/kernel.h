/* The contact law in lanes: what a step works on.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_KERNEL_H
#define RST_CONTACT_KERNEL_H

#include <stdint.h>

enum { rst_most_nodes = 32, rst_most_terms = 8, rst_lanes = 8 };

/* An immutable law. Moduli are those of the effective solid; the grid is in units of its width. */
struct rst_law {
    int n, n_terms;
    int surface;                   /* 1: the free surface is a state (dashpot or no equilibrium modulus) */
    int slips;                     /* 1: there are tangential states */
    int turns;                     /* 1: with a turning point */
    int details;                   /* 1: energies and radii are kept */
    double g_inf, eta, compliance; /* compliance: 1/g_inf, 0 if there is none */
    double normal, tangential;     /* 4/(1-nu) and 8/(2-nu): both sides of the contact (9) */
    double g[rst_most_terms], tau[rst_most_terms];
    double x[rst_most_nodes + 1];    /* nodes; x[n] = 1, where the next one would be */
    double y[rst_most_nodes + 1];    /* x^2 */
    double weight[rst_most_nodes];   /* of a node within the contact, in both of its cells */
    double outwards[rst_most_nodes]; /* its part in the outer one, from x[j] to x[j + 1] */
    double per_cell[rst_most_nodes]; /* 1/(y[j] - y[j - 1]), 0 for the first */
    double bit[rst_most_nodes];      /* 2^j */
};

/* One Maxwell arm over a step: what is left of its elongation; elongation by a unit displacement
 * even over the step; by a unit change of velocity from the mean of the step to its end. */
struct rst_arm {
    double decay, gain, bend;
};
struct rst_arm rst_arm_of(double step, double tau);

/* What depends on the time step alone: a displacement du, even over the step, makes w <- decay w +
 * gain du. */
struct rst_rates {
    double compliance; /* displacement, even over the step, by a unit force: 1/(G_inf + eta/step + sum g gain) */
    double viscosity;  /* force of a change of velocity until the end of the step: eta + sum g bend */
    double decay[rst_most_terms], gain[rst_most_terms], bend[rst_most_terms];
    double spent[rst_most_terms][3]; /* in the dashpot of an arm: by w^2, w du and du^2 */
};

/* Up to rst_lanes contacts and their motion in a step, checked: none begins, outgrows its grid or
 * turns too far. */
struct rst_batch {
    double overlap[rst_lanes], normal[3][rst_lanes], velocity[3][rst_lanes], turn[rst_lanes];
    double inverse_mass[2][rst_lanes]; /* normal, tangential */
    double radius[rst_lanes], friction[rst_lanes];
    double width[rst_lanes], axis[3][rst_lanes]; /* of the state */
    double *state[rst_lanes];
    double force[rst_lanes], tangential[3][rst_lanes]; /* on body 1 */
};

/* Header of a state: width of the grid (0: virgin contact), overlap after the last step, last force
 * (normal, two tangential components), first tangential axis. Then the arrays. */
enum { at_width, at_overlap, at_force, at_axis = at_force + 3, at_arrays = at_axis + 3 };

/* A turning point: where the slip annulus began when slip turned to stick. Its y in that of the
 * grid, 0: none; the tangential force density there then; u and w[2][terms] as of an element. */
enum { turn_y, turn_q, turn_u = turn_q + 2, turn_w = turn_u + 2 };

/* Where the arrays of a state begin: w_z[terms][n], u[2][n], w[2][terms][n], surface[n]; then the
 * work of the bodies on the contact and what friction took of it. */
static inline int rst_at_u(const struct rst_law *law)
{
    return at_arrays + law->n * law->n_terms;
}
static inline int rst_at_w(const struct rst_law *law)
{
    return rst_at_u(law) + 2 * law->n * law->slips;
}
static inline int rst_at_surface(const struct rst_law *law)
{
    return rst_at_w(law) + 2 * law->n * law->n_terms * law->slips;
}
static inline int rst_at_turn(const struct rst_law *law)
{
    return rst_at_surface(law) + law->n * law->surface;
}
static inline int rst_at_details(const struct rst_law *law)
{
    return rst_at_turn(law) + (turn_w + 2 * law->n_terms) * law->turns;
}

/* How many numbers of details there are: work, friction, viscous, their powers, contact and stick
 * radius. */
enum { rst_details = 7 };

typedef void rst_kernel(const struct rst_law *law, const struct rst_rates *rates, double step, struct rst_batch *batch);

rst_kernel rst_step_one, rst_step_lanes, rst_step_one_avx2, rst_step_lanes_avx2;

/* One contact and rst_lanes of them, for the widest vectors of this machine. All kernels give the
 * same bits. */
void rst_choose_kernels(rst_kernel **one, rst_kernel **lanes);

#endif
