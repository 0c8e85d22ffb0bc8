/* What is told of a contact besides its force.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_DETAILS_H
#define RST_CONTACT_DETAILS_H

#include "contact/lanes.h"

/* Radius up to which elements stick: where slip begins behind it, the margin to the limit, linear
 * in y, is zero. */
INLINE double stick_radius(const struct call c, int l, const struct work *s)
{
    const struct rows *const row = &s->row[l];
    const uint32_t stuck = (uint32_t)(int64_t)s->stuck[l];
    double margin[2];
    int j = 0;
    while (j < s->last[l] && stuck >> j & 1)
        j++;
    if (j == 0) return 0;
    if (j == s->last[l]) return c.in->width[l] * (s->front[l] > 0 ? sqrt(larger(s->front[l], 0)) : s->edge[l]);
    for (int i = 0; i < 2; i++)
        margin[i] = s->limit_ratio[l] * row->f[j - 1 + i] - hypot(row->trial[0][j - 1 + i], row->trial[1][j - 1 + i]);
    const double inwards = c.law->y[j - 1], outwards = c.law->y[j]; /* rounding may make any margin zero */
    const double share = larger(margin[0], 0) / larger(larger(margin[0], 0) - margin[1], DBL_MIN);
    double y = inwards + (outwards - inwards) * smaller(share, 1);
    if (s->front[l] > inwards) y = smaller(y, s->front[l]);
    return c.in->width[l] * smaller(s->edge[l], sqrt(y));
}

/* The work of the bodies by the trapezoid, as velocity Verlet has it, and what became of it;
 * `state` is still of before. */
INLINE void keep_details(const struct call c, int l, const struct work *s)
{
    double *const state = c.in->state[l], *const kept = state + rst_at_details(c.at);
    kept[0] += 0.5 * ((c.in->overlap[l] - c.in->before[l]) * (state[at_force] + s->force[l]) +
                      s->move[0][l] * (state[at_force + 1] + s->total[0][l]) +
                      s->move[1][l] * (state[at_force + 2] + s->total[1][l]));
    kept[1] += larger(s->slipped[l], 0);
    kept[2] += s->spent[l];
    kept[3] = larger(s->slipped[l], 0) / c.step;
    kept[4] = s->spent[l] / c.step;
    kept[5] = s->touches[l] * c.in->width[l] * s->edge[l];
    kept[6] = c.at.slips ? stick_radius(c, l, s) : 0;
}

#endif
