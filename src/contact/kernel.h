/* The contact law in lanes: what a step works on.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_KERNEL_H
#define RST_CONTACT_KERNEL_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

enum { rst_most_nodes = 32, rst_most_terms = 8, rst_lanes = 8 };

/* What a law has: elements and Maxwell arms; the others are 1 or 0. */
struct rst_shape {
    int n, terms;
    int surface; /* the free surface is a state (dashpot or no equilibrium modulus) */
    int slips;   /* there are tangential states */
    int turns;   /* with a turning point */
    int details; /* energies and radii are kept */
};

/* An immutable law. Moduli are those of the effective solid; the grid is in units of its width. */
struct rst_law {
    struct rst_shape at;
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

/* Header of a state: width of the grid (0: virgin contact), first tangential axis, overlap after
 * the last step, last force (normal, two tangential components). Then the arrays w[3][terms][n],
 * of the normal direction and, with slip, of two tangential ones, and u likewise, which the normal
 * direction has only with a surface; the turning point; details. */
enum { at_width, at_axis, at_overlap = at_axis + 3, at_force, at_arrays = at_force + 3 };

/* A turning point: where the slip annulus began when slip turned to stick. Its y in that of the
 * grid, 0: none; the tangential force density there then; u and w[2][terms] as of an element. */
enum { turn_y, turn_q, turn_u = turn_q + 2, turn_w = turn_u + 2 };

/* Details: work, friction, viscous, their powers, contact and stick radius. */
enum { rst_details = 7 };

/* int p dx from x1 to x2 if p is linear in x^2, 1 at x1 and 0 at x2, whichever is larger. */
static inline double rst_weight_of(double x1, double x2)
{
    return fabs(x2 - x1) * (2 * x2 + x1) / fmax(3 * (x1 + x2), DBL_MIN);
}

static inline int rst_at_u(struct rst_shape at)
{
    return at_arrays + at.n * at.terms * (1 + 2 * at.slips);
}
static inline int rst_at_turn(struct rst_shape at)
{
    return rst_at_u(at) + at.n * (at.surface + 2 * at.slips);
}
static inline int rst_at_details(struct rst_shape at)
{
    return rst_at_turn(at) + (turn_w + 2 * at.terms) * at.turns;
}

/* Up to rst_lanes contacts and their motion in a step, checked: none begins, outgrows its grid or
 * turns too far. The first members are those of restitute_contact_motion, the next ones those of a
 * state, in their order. */
struct rst_batch {
    double overlap[rst_lanes], normal[3][rst_lanes], velocity[3][rst_lanes], spin[rst_lanes];
    double inverse_mass[2][rst_lanes]; /* normal, tangential */
    double radius[rst_lanes], friction[rst_lanes];
    double width[rst_lanes], axis[3][rst_lanes], before[rst_lanes]; /* overlap before the step */
    double *state[rst_lanes];
    double force[4][rst_lanes]; /* on body 1: normal and tangential */
};

typedef void rst_kernel(const struct rst_law *law, const struct rst_rates *rates, double step, struct rst_batch *batch);

rst_kernel rst_step_one, rst_step_lanes, rst_step_one_avx2, rst_step_lanes_avx2;

/* One contact and rst_lanes of them, for the widest vectors of this machine. All kernels give the
 * same bits. */
static inline void rst_choose_kernels(rst_kernel **one, rst_kernel **lanes)
{
    *one = rst_step_one;
    *lanes = rst_step_lanes;
#ifdef RST_HAS_AVX2
    if (__builtin_cpu_supports("avx2")) {
        *one = rst_step_one_avx2;
        *lanes = rst_step_lanes_avx2;
    }
#endif
}

#endif
