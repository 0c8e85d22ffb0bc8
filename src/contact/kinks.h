/* Where stick turns to slip between two elements.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_KINKS_H
#define RST_CONTACT_KINKS_H

#include "contact/turning_point.h"

/* Slip begins between an element that sticks, at y_in, as the one behind does, at y_behind, and
 * y_out, where it slips: there the margin to the limit, extrapolated from the sticking side, is
 * zero. The quadrature took it to fall to zero at y_out with the weight `weight`. Returns what it
 * lacks. */
INLINE double lacking(double margin, double behind, double x_in, double y_in, double y_behind, double y_out,
                      double weight, double *front)
{
    const double change = behind - margin;
    const bool extrapolates = (margin > 0) & (change > 0);
    const double y = y_in + quotient(margin, change) * (y_in - y_behind);
    const double kept = if_so(extrapolates) * if_so((y_out - y) * (y_out - y_in) > 0) * if_so(y > 0);
    *front = kept * y;
    return kept * margin * (weight - rst_weight_of(x_in, sqrt(larger(y, 0))));
}

/* What the integral lacks where stick turns to slip between two elements. */
INLINE void add_kinks(const struct call c, int l, struct work *s)
{
    const struct rows *const row = &s->row[l];
    const uint32_t stuck = (uint32_t)(int64_t)s->stuck[l];
    const int last = s->last[l];
    const uint32_t before_last = last > 0 ? (1u << (last - 1)) - 1 : 0;
    for (uint32_t turns = (stuck ^ stuck >> 1) & before_last; turns; turns &= turns - 1) {
        const int j = __builtin_ctz(turns), inwards = !(stuck >> j & 1); /* 1: slip within, stick without */
        const int in = j + inwards, out = j + !inwards, behind = 2 * in - out;
        if (behind < 0 || behind >= last || !(stuck >> behind & 1) || (c.at.turns && s->known[l] == in + 1)) continue;
        const double *const f = row->f, *const qx = row->q[0], *const qy = row->q[1], ratio = s->limit_ratio[l];
        const double limit = ratio * f[out];
        if (!(limit > 0)) continue;
        const double x = qx[out] / limit, y = qy[out] / limit;
        const double weight = inwards ? c.law->weight[in] - c.law->outwards[in] : c.law->outwards[in];
        double front;
        const double more =
            lacking(ratio * f[in] - (x * qx[in] + y * qy[in]), ratio * f[behind] - (x * qx[behind] + y * qy[behind]),
                    c.law->x[in], c.law->y[in], c.law->y[behind], c.law->y[out], weight, &front);
        s->total[0][l] += more * x;
        s->total[1][l] += more * y;
        s->front[l] = inwards ? 0 : front;
        s->front_along[0][l] = x;
        s->front_along[1][l] = y;
    }
}

/* Likewise if the last elements stick and slip begins between them and the rim. */
INLINE void add_kink_at_rim(struct work *s)
{
    EACH_LANE
    {
        const double limit = s->limit_ratio[l] * s->at_rim[l], edge = s->edge[l] * s->edge[l], y_in = s->y[l];
        const double reach = (edge - y_in) * s->per_cell[l];
        const double qx = s->q_last[0][l], qy = s->q_last[1][l], px = s->q_before[0][l], py = s->q_before[1][l];
        const double bx = qx + reach * (qx - px), by = qy + reach * (qy - py), size = sqrt(bx * bx + by * by);
        const bool slips = (s->both_stick[l] > 0) & (reach > 0) & (size > limit) & (s->known[l] == 0);
        const double x = quotient(bx, size), y = quotient(by, size);
        const double margin = s->limit_ratio[l] * s->f_last[l] - (x * qx + y * qy);
        const double behind = s->limit_ratio[l] * s->f_before[l] - (x * px + y * py);
        double front;
        const double lacks =
            lacking(margin, behind, s->x[l], y_in, s->y_before[l], edge, s->inner[l] + s->outwards[l], &front);
        const double more = larger(lacks, 0) * if_so(slips), outer = s->outer[l] * if_so(more > 0);
        s->total[0][l] += more * x + outer * (limit * x - s->rim[0][l]);
        s->total[1][l] += more * y + outer * (limit * y - s->rim[1][l]);
        /* arithmetic: selections between what is in memory are no vectors without AVX2 */
        const double begins = if_so(more > 0), known = if_so(s->known[l] > 0), last_slips = 1 - s->last_sticks[l];
        s->front[l] = begins * front + (1 - begins) * larger(known, last_slips) * s->front[l];
        s->front_along[0][l] += begins * (x - s->front_along[0][l]);
        s->front_along[1][l] += begins * (y - s->front_along[1][l]);
    }
}

#endif
