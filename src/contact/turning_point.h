/* Where slip has turned: one more element, which follows the slip annulus (docs/contact.md).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_TURNING_POINT_H
#define RST_CONTACT_TURNING_POINT_H

#include "contact/lanes.h"

INLINE double size_of(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

/* A place in the cell beyond the element `in`, where the next one or the rim is, the limit there,
 * and the ends of the cell. */
struct place {
    int in;
    double x, y, limit, x_in, y_in, x_out, y_out, q_in[2], q_out[2];
};

INLINE struct place place_of(const struct call c, double y, int l, const struct work *s)
{
    const struct rows *const row = &s->row[l];
    struct place p = {.x = sqrt(larger(y, 0)), .y = y};
    while (p.in + 1 < s->last[l] && c.law->y[p.in + 1] <= y)
        p.in++;
    const bool cut = p.in + 1 == s->last[l];
    const double f_out = cut ? s->at_rim[l] : row->f[p.in + 1];
    p.x_in = c.law->x[p.in];
    p.y_in = c.law->y[p.in];
    p.x_out = cut ? s->edge[l] : c.law->x[p.in + 1];
    p.y_out = p.x_out * p.x_out;
    for (int d = 0; d < 2; d++) {
        p.q_in[d] = row->q[d][p.in];
        p.q_out[d] = cut ? s->rim[d][l] : row->q[d][p.in + 1];
    }
    p.limit =
        s->limit_ratio[l] * (row->f[p.in] + (y - p.y_in) / larger(p.y_out - p.y_in, DBL_MIN) * (f_out - row->f[p.in]));
    return p;
}

/* What an integral of q that is linear from the inner to the outer end of a cell lacks if it bends
 * at p. */
INLINE void bend_at(const struct place *p, const double *q, int l, struct work *s)
{
    const double share = (p->y - p->y_in) / larger(p->y_out - p->y_in, DBL_MIN);
    const double weight = rst_weight_of(p->x, p->x_in) + rst_weight_of(p->x, p->x_out);
    for (int d = 0; d < 2; d++)
        s->total[d][l] += weight * (q[d] - p->q_in[d] - share * (p->q_out[d] - p->q_in[d]));
}

/* Where slip begins beyond a turning point. When slip ended there, the force density q was at the
 * limit between it and the rim, and what sticks has since been displaced alike: so q is at the
 * limit anew where the margin, linear in y from the turning point to the rim, is zero. A limit that
 * has changed by now has changed alike, too. Returns y there, or 0, and the direction of slip. */
INLINE double front_of(const struct place *p, const double *q, const double *then, double edge, double at_edge,
                       double *along)
{
    static const double least = 1e-6; /* of the limit; below, the direction would be of rounding */
    const double x = q[0] - then[0], y = q[1] - then[1], moved = sqrt(x * x + y * y), was = size_of(then);
    if (!(moved > least * p->limit)) return 0;
    along[0] = x / larger(moved, DBL_MIN);
    along[1] = y / larger(moved, DBL_MIN);
    const double cosine = (along[0] * then[0] + along[1] * then[1]) / larger(was, DBL_MIN);
    const double margin = p->limit - (along[0] * q[0] + along[1] * q[1]);
    const double margin_at_edge = at_edge - moved - cosine * (at_edge - (p->limit - was));
    const bool begins = (margin > 0) & (margin_at_edge < 0);
    return begins ? p->y + (edge - p->y) * quotient(margin, margin - margin_at_edge) : 0;
}

/* A turning point is put where slip begins: u and w, as of an element near by with the force
 * density q, are displaced to the limit. */
INLINE void put_turn(const struct call c, const struct place *p, const double *along, const double *q, double *turn)
{
    double stiffness = c.law->g_inf; /* without dashpot: it holds no force */
    for (int k = 0; k < c.at.terms; k++)
        stiffness += c.law->g[k] * c.r->gain[k];
    turn[turn_y] = 0;
    if (!(stiffness * c.r->compliance > 1e-6) || !(p->limit > 1e-100 && p->limit < 1e100))
        return; /* dashpots hold no kink */
    turn[turn_y] = p->y;
    for (int d = 0; d < 2; d++) {
        const double then = turn[turn_q + d] = p->limit * along[d], back = (q[d] - then) / larger(stiffness, DBL_MIN);
        turn[turn_u + d] -= back;
        for (int k = 0; k < c.at.terms; k++)
            turn[turn_w + d * c.at.terms + k] -= c.r->gain[k] * back;
    }
}

/* The turning point over the step, displaced as an element that sticks, and its force density `q`.
 * Returns whether it still holds: the limit there has not changed much, and it does not slip. */
INLINE bool move_turn(const struct call c, int l, const struct work *s, struct place *p, double *q, double *turn)
{
    static const double most_change = 1; /* of the limit. Impacts are as accurate with 0 to 2, with 10 they are not */
    const double edge = s->edge[l] * s->edge[l],
                 at_edge = s->limit_ratio[l] * s->at_rim[l], *const then = turn + turn_q;
    double along[2] = {0};
    if (!(turn[turn_y] < edge) || s->last[l] == 0) return false;
    *p = place_of(c, turn[turn_y], l, s);
    if (!(fabs(p->limit - size_of(then)) <= most_change * size_of(then))) return false;
    for (int d = 0; d < 2; d++) {
        q[d] = c.law->g_inf * turn[turn_u + d];
        for (int k = 0; k < c.at.terms; k++)
            q[d] += c.law->g[k] * (turn[turn_w + d * c.at.terms + k] *= c.r->decay[k]);
    }
    const bool turns = (q[0] - then[0]) * s->move[0][l] + (q[1] - then[1]) * s->move[1][l] < 0;
    const double front = turns ? front_of(p, q, then, edge, at_edge, along) : 0;
    if (front > 0) { /* slip has turned again */
        *p = place_of(c, front, l, s);
        put_turn(c, p, along, q, turn);
        q[0] = then[0];
        q[1] = then[1];
    }
    for (int d = 0; d < 2; d++) {
        const double move = s->move[d][l], change = s->speed[d][l] - move / c.step;
        turn[turn_u + d] += move;
        q[d] += (c.law->g_inf + c.law->eta / c.step) * move + c.r->viscosity * change;
        for (int k = 0; k < c.at.terms; k++) {
            turn[turn_w + d * c.at.terms + k] += c.r->gain[k] * move + c.r->bend[k] * change;
            q[d] += c.law->g[k] * c.r->gain[k] * move;
        }
    }
    return size_of(q) <= p->limit;
}

/* What slip takes in the cell where it begins, instead of what its outer element tells. Slip is
 * what the displacement exceeds that of the limit by, which grows with the approach. */
INLINE void count_slip(const struct call c, const struct place *p, const double *along, int l, struct work *s)
{
    const struct rows *const row = &s->row[l];
    const int out = p->in + 1;
    const double move = along[0] * s->move[0][l] + along[1] * s->move[1][l];
    const double slip = larger(move - s->limit_ratio[l] * s->approach[l] * c.step, 0);
    const double limit = along[0] * p->q_out[0] + along[1] * p->q_out[1];
    s->slipped[l] += slip * (p->limit * rst_weight_of(p->x, p->x_out) + limit * rst_weight_of(p->x_out, p->x));
    for (int d = 0; d < 2 && out < s->last[l]; d++)
        s->slipped[l] -=
            rst_weight_of(p->x_out, p->x_in) * row->q[d][out] * (row->trial[d][out] - row->q[d][out]) * c.r->compliance;
}

/* q is not linear in y between elements at the turning point, nor where slip begins beyond it. */
INLINE void follow_turn(const struct call c, int l, struct work *s)
{
    double *const turn = c.in->state[l] + rst_at_turn(c.at), q[2] = {0}, along[2] = {0};
    const double at_edge = s->limit_ratio[l] * s->at_rim[l];
    struct place p = {0};
    if (!(turn[turn_y] > 0)) return;
    if (!move_turn(c, l, s, &p, q, turn)) {
        turn[turn_y] = 0;
        return;
    }
    bend_at(&p, q, l, s);
    const double front = front_of(&p, q, turn + turn_q, s->edge[l] * s->edge[l], at_edge, along);
    if (!(front > 0)) return;
    struct place f = place_of(c, front, l, s);
    const bool at_rim = f.in + 1 == s->last[l];
    const uint32_t sticks = (uint32_t)(int64_t)s->stuck[l] >> f.in & 3;
    if (!(sticks & 1) || (sticks & 2 && !at_rim)) return; /* elements have another past than the turning point */
    s->known[l] = 1 + f.in;
    s->front[l] = front;
    const double slips[2] = {f.limit * along[0], f.limit * along[1]};
    for (int d = 0; d < 2 && at_rim; d++) {
        f.q_out[d] = at_edge * along[d];
        s->total[d][l] += s->outer[l] * (f.q_out[d] - s->rim[d][l]);
    }
    if (c.at.details) count_slip(c, &f, along, l, s);
    if (p.in == f.in) { /* the turning point is the inner end of what bends again */
        f.x_in = p.x;
        f.y_in = p.y;
        f.q_in[0] = q[0];
        f.q_in[1] = q[1];
    }
    bend_at(&f, slips, l, s);
}

/* Where slip begins and no turning point is yet, one is put: slip may turn there. */
INLINE void keep_turn(const struct call c, int l, struct work *s)
{
    double *const turn = c.in->state[l] + rst_at_turn(c.at);
    if (turn[turn_y] > 0 || !(s->front[l] > 0)) return;
    const double along[2] = {s->front_along[0][l], s->front_along[1][l]};
    const struct place p = place_of(c, s->front[l], l, s);
    if (c.at.details) count_slip(c, &p, along, l, s);
    for (int d = 0; d < 2; d++) {
        turn[turn_u + d] = u_of(c, l, 1 + d)[p.in];
        for (int k = 0; k < c.at.terms; k++)
            turn[turn_w + d * c.at.terms + k] = w_of(c, l, 1 + d)[k * c.at.n + p.in];
    }
    put_turn(c, &p, along, p.q_in, turn);
}

#endif
