/* Two bodies in space: from positions, velocities and spins to the plane of the impact and back
 * (docs/theory.md, section 10). For calls that solve an impact and calls that look it up in a
 * table.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TWO_BODIES_H
#define RST_TWO_BODIES_H

#include <math.h>

#include <restitute/restitute.h>

typedef struct {
    double x[3];
} rst_vector;

/* Frame of the impact: n from `a` into `b`, t along the sliding of a's surface on b's. `a` can
 * move. */
struct rst_frame {
    rst_vector n, t;
    double gap, reach;     /* m: distance of the surfaces, and what it is compared with */
    double approach;       /* m/s: normal speed at which they close */
    double sliding;        /* m/s: of the contact point, along t, >= 0 */
    double translation;    /* the part from the centres, along t; the rest comes from the spins */
    double spin_a, spin_b; /* rad/s: along n x t, with the sign of restitute_scene */
};

static inline int rst_is_plane(const restitute_body *body)
{
    return isinf(body->radius);
}

/* All members are in their ranges, and one of the bodies can move. */
int rst_check_bodies(const restitute_body *a, const restitute_body *b, restitute_error *error);

struct rst_frame rst_frame_of(const restitute_body *a, const restitute_body *b);

/* They touch and approach. */
int rst_check_approach(const struct rst_frame *f, double touch_gap, restitute_error *error);

/* Mobility of the contact point along t. */
double rst_mobility_of(const restitute_body *body);

/* The bodies part with the pair (ez, ex). `a` can move. */
void rst_part_with(double ez, double ex, const struct rst_frame *f, restitute_body *a, restitute_body *b);

#endif
