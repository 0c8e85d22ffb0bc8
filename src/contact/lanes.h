/* What a step of LANES contacts works on, and arithmetic in lanes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_LANES_H
#define RST_CONTACT_LANES_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "contact/kernel.h"

#define INLINE static inline __attribute__((always_inline))
#define RARE static __attribute__((noinline, cold))
#define SIMD _Pragma("omp simd")
#define EACH_LANE SIMD for (int l = 0; l < LANES; l++)
#define EACH_ELEMENT SIMD for (int i = 0; i < n; i++)

enum { most_n = rst_most_nodes, most_k = rst_most_terms };
static const double beyond = 1e30;  /* in y of the grid: no rim is there */
static const double fastest = 1e80; /* m/s: squares of viscous forces are not to overflow */

typedef double lanes[LANES];

/* What a step is of; `at`: what the compiler knows of the law. */
struct call {
    const struct rst_law *law;
    const struct rst_rates *r;
    struct rst_batch *in;
    double step;
    struct rst_shape at;
};

/* Elongations of the arms and displacements of elements, in the normal direction (0) and the
 * tangential ones (1, 2). */
INLINE double *w_of(const struct call c, int l, int d)
{
    return c.in->state[l] + at_arrays + d * c.at.terms * c.at.n;
}
INLINE double *u_of(const struct call c, int l, int d)
{
    return c.in->state[l] + rst_at_u(c.at) + (d > 0 ? d - 1 + c.at.surface : 0) * c.at.n;
}

/* Of a Maxwell arm over the step; an element that enters has less time. */
struct arm {
    double decay[most_n], gain[most_n];
};

/* Elements of a contact. Force densities in units of law.normal and law.tangential. */
struct rows {
    const struct arm *arms;
    struct arm own[most_k];
    double touch[most_n];                       /* part of the step in contact, 0 outside */
    double f[most_n];                           /* normal */
    double pressed[most_n];                     /* beyond the free surface, negative outside */
    double trial[2][most_n];                    /* tangential, if all sticks */
    double q[2][most_n];                        /* within the limit of friction */
    double spent[most_n];                       /* by dashpots in the step, normal */
    double at_rest[most_n], by_move[2][most_n]; /* likewise tangential: without displacement, by a unit of it */
    double held[2][most_n];                     /* by the springs before the step, tangential */
};

struct work {
    struct arm even[most_k];
    struct rows row[LANES];
    int last[LANES]; /* outermost element in contact, counted from 1; 0: none */
    lanes scale;     /* width^2/radius */
    lanes approach, sum, force;
    /* the rim: places of the last element, f and w there; edge: contact radius in grid widths;
     * weights of the last, cut cell: of the last element, beside its own, and of the rim; f at the
     * rim, and w there over w of the last element */
    lanes x, y, y_before, next, per_cell, outwards, f_last, f_before, virgin, meets, touches;
    lanes w_last[most_k], ratio[most_k], edge, inner, outer, at_rim;
    /* tangential: the frame, displacement and velocity at the end of the step, integrals over the
     * contact radius in widths */
    lanes axis[3], other[3], move[2], speed[2], limit_ratio, total[2], sticking, slipped, spent, back[2], rim[2];
    lanes q_last[2], q_before[2], wt_last[2][most_k], stuck, last_sticks, both_stick;
    /* where slip begins beyond all that sticks: y, direction; that element, counted from 1, if it
     * is known from a turning point */
    lanes front, front_along[2], known;
};

INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}

INLINE double smaller(double a, double b)
{
    return a < b ? a : b;
}

INLINE double if_so(bool is)
{
    return is ? 1.0 : 0.0;
}

/* a/b where b > 0 and a/b < 1e16, elsewhere anything finite. A selected divisor would not do: of it
 * compilers make a selection between quotients, and so divide by 0 in vain: hosts trap that. */
INLINE double quotient(double a, double b)
{
    return a / larger(b, 1e-16 * fabs(a) + DBL_MIN);
}

/* The sum over elements, in an order that suits every width of vectors. */
INLINE double sum_of(const double *p, int n)
{
    double sum = 0;
    for (const double *q = p; q < p + n; q += 8)
        sum += ((q[0] + q[4]) + (q[2] + q[6])) + ((q[1] + q[5]) + (q[3] + q[7]));
    return sum;
}

/* exp(x) for -700 <= x <= 0 within 2e-16 relative: x = k ln 2 + r, and Taylor's series of r. It is
 * written out since compilers make no vectors of a loop in lanes. */
INLINE double exp_of(double x)
{
    const double shift = 0x1.8p52 + 1023, t = x * 1.4426950408889634 + shift, k = t - shift;
    const double r = (x - k * 0x1.62e42fee00000p-1) - k * 0x1.a39ef35793c76p-33;
    const double end = 1 / 3628800. + r * (1 / 39916800. + r * (1 / 479001600. + r * (1 / 6227020800.)));
    const double middle = 1 / 720. + r * (1 / 5040. + r * (1 / 40320. + r * (1 / 362880. + r * end)));
    double scale;
    uint64_t bits;
    memcpy(&bits, &t, sizeof bits);
    bits <<= 52;
    memcpy(&scale, &bits, sizeof scale);
    return scale * (1 + r * (1 + r * (1 / 2. + r * (1 / 6. + r * (1 / 24. + r * (1 / 120. + r * middle))))));
}

/* Change of the velocity until the end of the step by a unit force that holds it back, with a
 * damping of that force over velocity. Such that a mere dashpot decays by exp(-damping dt/m) in a
 * velocity-Verlet step, however strong it is. */
INLINE double velocity_response(double half_step_over_mass, double damping)
{
    const double z = 2 * half_step_over_mass * damping, safe = smaller(larger(z, 1e-3), 700);
    const double share = z < 1e-3 ? 0.5 + z / 12 : 1 / (1 - exp_of(-safe)) - 1 / larger(z, 1e-3);
    return 2 * half_step_over_mass * share / (1 + z * share);
}

#endif
