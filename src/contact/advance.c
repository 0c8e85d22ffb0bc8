/* One step of LANES contacts (docs/contact.md): vectors over the elements of a contact for what
 * there is one of an element, over the lanes for what there is one of a contact. Branches are
 * selections, and no sum runs across lanes, so that a contact has the same bits in every lane,
 * batch and width of vectors.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/details.h"
#include "contact/normal.h"
#include "contact/tangential.h"

/* The heads of the states. The first tangential axis turns with the bodies about the normal and is
 * brought back into the tangential plane. */
INLINE void open_states(const struct call c, struct work *s)
{
    EACH_LANE
    {
        const double nx = c.in->normal[0][l], ny = c.in->normal[1][l], nz = c.in->normal[2][l];
        const double ax = c.in->axis[0][l], ay = c.in->axis[1][l], az = c.in->axis[2][l];
        const double out = nx * ax + ny * ay + nz * az, turn = c.step * c.in->spin[l];
        const double x = ax - out * nx + turn * (ny * az - nz * ay);
        const double y = ay - out * ny + turn * (nz * ax - nx * az);
        const double z = az - out * nz + turn * (nx * ay - ny * ax);
        const double per = 1 / sqrt(x * x + y * y + z * z);
        s->axis[0][l] = per * x;
        s->axis[1][l] = per * y;
        s->axis[2][l] = per * z;
        s->other[0][l] = ny * s->axis[2][l] - nz * s->axis[1][l];
        s->other[1][l] = nz * s->axis[0][l] - nx * s->axis[2][l];
        s->other[2][l] = nx * s->axis[1][l] - ny * s->axis[0][l];
        s->scale[l] = c.in->width[l] * c.in->width[l] / c.in->radius[l];
        s->approach[l] = nx * c.in->velocity[0][l] + ny * c.in->velocity[1][l] + nz * c.in->velocity[2][l];
    }
}

INLINE void close_states(const struct call c, struct work *s)
{
    for (int l = 0; l < LANES; l++) {
        double *const state = c.in->state[l];
        if (c.at.details) keep_details(c, l, s);
        state[at_overlap] = c.in->overlap[l];
        state[at_force] = s->force[l];
        for (int d = 0; d < 2; d++)
            state[at_force + 1 + d] = s->total[d][l];
        for (int i = 0; i < 3; i++)
            state[at_axis + i] = s->axis[i][l];
    }
    EACH_LANE
    {
        c.in->force[0][l] = s->force[l];
        for (int i = 0; i < 3; i++)
            c.in->force[1 + i][l] = -(s->total[0][l] * s->axis[i][l] + s->total[1][l] * s->other[i][l]);
    }
}

INLINE void advance(const struct call c)
{
    struct work s;
    for (int k = 0; k < c.at.terms; k++)
        for (int i = 0; i < c.at.n; i++) {
            s.even[k].decay[i] = c.r->decay[k];
            s.even[k].gain[i] = c.r->gain[k];
        }
    open_states(c, &s);
    press(c, &s);
    if (c.at.slips)
        shear(c, &s);
    else
        EACH_LANE s.total[0][l] = s.total[1][l] = s.move[0][l] = s.move[1][l] = s.slipped[l] = 0;
    close_states(c, &s);
}

/* A usual shape is compiled on its own. */
#ifndef RST_ONE_SHAPE
#define RST_ONE_SHAPE 0
#endif
INLINE bool advance_usual(struct call c, int terms, int surface, int turns)
{
    const struct rst_shape usual = {8, terms, surface, 1, turns, 0};
    if (RST_ONE_SHAPE || memcmp(&usual, &c.at, sizeof usual)) return false;
    c.at = usual;
    advance(c);
    return true;
}

/* Usual are eight elements with friction: elastic, standard solid, three terms, Kelvin-Voigt, the
 * first two also with a turning point. */
void NAME(const struct rst_law *restrict law, const struct rst_rates *restrict rates, double step,
          struct rst_batch *restrict batch)
{
    const struct call c = {law, rates, batch, step, law->at};
    if (!(advance_usual(c, 0, 0, 0) || advance_usual(c, 1, 0, 0) || advance_usual(c, 3, 0, 0) ||
          advance_usual(c, 0, 1, 0) || advance_usual(c, 0, 0, 1) || advance_usual(c, 1, 0, 1)))
        advance(c);
}
