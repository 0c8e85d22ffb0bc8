/* The tangential problem of a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_TANGENTIAL_H
#define RST_CONTACT_TANGENTIAL_H

#include "contact/kinks.h"

/* Elements if all stick: displaced by the step. */
INLINE void stick(const struct call c, double per_step, int l, struct work *s)
{
    const int n = c.at.n;
    struct rows *const row = &s->row[l];
    if (c.at.details) EACH_ELEMENT row->at_rest[i] = row->by_move[0][i] = row->by_move[1][i] = 0;
    for (int d = 0; d < 2; d++) {
        double *const u = u_of(c, l, 1 + d), *const w = w_of(c, l, 1 + d), *const trial = row->trial[d];
        const double move = s->move[d][l], dashpot = c.law->eta * per_step * move;
        if (c.at.details) EACH_ELEMENT row->held[d][i] = c.law->g_inf * u[i];
        EACH_ELEMENT
        {
            u[i] += row->touch[i] * move;
            trial[i] = c.law->g_inf * u[i] + if_so(row->touch[i] > 0) * dashpot;
        }
        for (int k = 0; k < c.at.terms; k++) {
            const double g = c.law->g[k], *const decay = row->arms[k].decay, *const gain = row->arms[k].gain;
            EACH_ELEMENT
            {
                const double before = w[k * n + i];
                w[k * n + i] = decay[i] * before + gain[i] * (row->touch[i] * move);
                trial[i] += g * w[k * n + i];
                if (c.at.details) row->at_rest[i] += c.r->spent[k][0] * before * before;
                if (c.at.details) row->by_move[d][i] += c.r->spent[k][1] * before;
                if (c.at.details) row->held[d][i] += g * before;
            }
        }
    }
}

/* The velocity of the end of the step differs by `change`. */
INLINE void feel_end_slide(const struct call c, const double *change, int l, struct work *s)
{
    const int n = c.at.n;
    struct rows *const row = &s->row[l];
    for (int d = 0; d < 2; d++) {
        double *const w = w_of(c, l, 1 + d);
        EACH_ELEMENT row->trial[d][i] += c.r->viscosity * change[d] * row->touch[i];
        for (int k = 0; k < c.at.terms; k++)
            EACH_ELEMENT w[k * n + i] += c.r->bend[k] * change[d] * row->touch[i];
    }
}

/* Forces within the limit of friction, radially, and their integral up to the last element. */
INLINE void cut_to_limit(const struct call c, int viscous, int l, struct work *s)
{
    const int n = c.at.n;
    struct rows *const row = &s->row[l];
    const double ratio = s->limit_ratio[l];
    double x[most_n], y[most_n], bits[most_n], part[most_n];
    EACH_ELEMENT
    {
        const double tx = row->trial[0][i], ty = row->trial[1][i];
        const double limit = ratio * row->f[i], size = sqrt(tx * tx + ty * ty);
        const double kept = limit / larger(larger(size, limit), DBL_MIN), sticks = if_so(size <= limit);
        row->q[0][i] = tx * kept;
        row->q[1][i] = ty * kept;
        x[i] = c.law->weight[i] * row->q[0][i];
        y[i] = c.law->weight[i] * row->q[1][i];
        bits[i] = c.law->bit[i] * sticks;
        part[i] = viscous ? c.law->weight[i] * sticks * if_so(row->touch[i] > 0) : 0;
    }
    s->total[0][l] = sum_of(x, n);
    s->total[1][l] = sum_of(y, n);
    s->stuck[l] = sum_of(bits, n);
    if (viscous) s->sticking[l] = sum_of(part, n);
}

/* What the rim needs of the last element. */
INLINE void look_at_last_slide(const struct call c, int l, struct work *s)
{
    const int n = c.at.n, last = s->last[l], j = last > 0 ? last - 1 : 0, before = j > 0 ? j - 1 : 0;
    const struct rows *const row = &s->row[l];
    for (int d = 0; d < 2; d++) {
        const double *const w = w_of(c, l, 1 + d);
        const double back = (row->trial[d][j] - row->q[d][j]) * c.r->compliance;
        s->q_last[d][l] = row->q[d][j];
        s->q_before[d][l] = row->q[d][before];
        s->back[d][l] = back;
        for (int k = 0; k < c.at.terms; k++)
            s->wt_last[d][k][l] = w[k * n + j] - c.r->gain[k] * back;
    }
    const uint32_t stuck = (uint32_t)(int64_t)s->stuck[l];
    s->last_sticks[l] = stuck >> j & 1;
    s->both_stick[l] = last > 1 ? stuck >> j & stuck >> before & 1 : 0;
}

/* The force density at the rim: where w rises from zero there (close_rim), that of the last element
 * by as much; else the same part of the limit. */
INLINE void hold_rim(const struct call c, struct work *s)
{
    lanes x, y, rises;
    EACH_LANE
    {
        x[l] = c.law->eta * s->speed[0][l];
        y[l] = c.law->eta * s->speed[1][l];
        rises[l] = if_so(c.law->eta > 0);
    }
    if (c.at.terms) EACH_LANE rises[l] = larger(rises[l], if_so(s->ratio[0][l] > 0));
    for (int k = 0; k < c.at.terms; k++) {
        const double g = c.law->g[k];
        EACH_LANE
        {
            x[l] += g * s->ratio[k][l] * s->wt_last[0][k][l];
            y[l] += g * s->ratio[k][l] * s->wt_last[1][k][l];
        }
    }
    EACH_LANE
    {
        const double part = s->at_rim[l] / larger(s->f_last[l], DBL_MIN);
        const double x_as_last = part * s->q_last[0][l], y_as_last = part * s->q_last[1][l];
        const double rim_x = rises[l] > 0 ? x[l] : x_as_last, rim_y = rises[l] > 0 ? y[l] : y_as_last;
        const double limit = s->limit_ratio[l] * s->at_rim[l], size = sqrt(rim_x * rim_x + rim_y * rim_y);
        const double kept = limit / larger(larger(size, limit), DBL_MIN);
        s->rim[0][l] = rim_x * kept;
        s->rim[1][l] = rim_y * kept;
        s->total[0][l] += s->inner[l] * s->q_last[0][l] + s->outer[l] * s->rim[0][l];
        s->total[1][l] += s->inner[l] * s->q_last[1][l] + s->outer[l] * s->rim[1][l];
    }
}

/* What is beyond the limit springs back. Outside the contact the limit is zero: the same line lets
 * the springs relax. */
INLINE void spring_back(const struct call c, int l, struct work *s)
{
    const int n = c.at.n;
    struct rows *const row = &s->row[l];
    double back[most_n], slipped[most_n], by_square = c.law->eta / c.step;
    for (int k = 0; k < c.at.terms; k++)
        by_square += c.r->spent[k][2];
    /* The trapezoidal rule, as for the work. What a dashpot held before the step is not known. */
    const double half = c.law->eta > 0 ? 0 : 0.5;
    if (c.at.details) EACH_ELEMENT slipped[i] = 0;
    for (int d = 0; d < 2; d++) {
        double *const u = u_of(c, l, 1 + d), *const w = w_of(c, l, 1 + d);
        EACH_ELEMENT
        {
            back[i] = (row->trial[d][i] - row->q[d][i]) * c.r->compliance;
            u[i] -= back[i];
        }
        for (int k = 0; k < c.at.terms; k++) {
            const double gain = c.r->gain[k];
            EACH_ELEMENT w[k * n + i] -= gain * back[i];
        }
        if (c.at.details) EACH_ELEMENT
            {
                const double moved = row->touch[i] * s->move[d][l] - back[i];
                row->at_rest[i] += (row->by_move[d][i] + by_square * moved) * moved;
                const double mean = row->q[d][i] + half * (row->held[d][i] - row->q[d][i]);
                slipped[i] += mean * back[i];
            }
    }
    if (!c.at.details) return;
    EACH_ELEMENT slipped[i] = c.law->weight[i] * larger(slipped[i], 0);
    s->slipped[l] = sum_of(slipped, n);
    EACH_ELEMENT slipped[i] = c.law->weight[i] * row->at_rest[i];
    s->spent[l] += c.law->tangential * c.in->width[l] * sum_of(slipped, n);
}

/* Elements of a contact within the limit of friction; `viscous`: the velocity of the end of the
 * step is still to be felt. */
INLINE void slide(const struct call c, int viscous, int l, struct work *s)
{
    cut_to_limit(c, viscous, l, s);
    look_at_last_slide(c, l, s);
    if (!viscous) spring_back(c, l, s);
}

INLINE void shear(const struct call c, struct work *s)
{
    const double per_step = 1 / c.step, normal_over_tangential = c.law->normal / c.law->tangential;
    EACH_LANE
    {
        const double x = c.in->velocity[0][l], y = c.in->velocity[1][l], z = c.in->velocity[2][l];
        s->speed[0][l] = s->axis[0][l] * x + s->axis[1][l] * y + s->axis[2][l] * z;
        s->speed[1][l] = s->other[0][l] * x + s->other[1][l] * y + s->other[2][l] * z;
        s->move[0][l] = c.step * s->speed[0][l];
        s->move[1][l] = c.step * s->speed[1][l];
        s->limit_ratio[l] = c.in->friction[l] * normal_over_tangential;
    }
    const int viscous = c.at.terms + c.at.surface > 0 && c.r->viscosity > 0;
    for (int l = 0; l < LANES; l++) {
        stick(c, per_step, l, s);
        slide(c, viscous, l, s);
    }
    if (viscous) { /* the velocity answers to a force without kinks, which are a small part of it */
        hold_rim(c, s);
        lanes change[2];
        EACH_LANE
        {
            const double scale = c.law->tangential * c.in->width[l];
            const double sticking = s->sticking[l] + s->last_sticks[l] * (s->inner[l] + s->outer[l]);
            const double response =
                scale * velocity_response(0.5 * c.step * c.in->inverse_mass[1][l], scale * sticking * c.r->viscosity);
            const double x = -response * s->total[0][l], y = -response * s->total[1][l];
            const double kept = s->touches[l] * fastest / larger(fastest, larger(fabs(x), fabs(y)));
            change[0][l] = kept * x;
            change[1][l] = kept * y;
            s->speed[0][l] += change[0][l];
            s->speed[1][l] += change[1][l];
        }
        for (int l = 0; l < LANES; l++) {
            feel_end_slide(c, (const double[]){change[0][l], change[1][l]}, l, s);
            slide(c, 0, l, s);
        }
    }
    hold_rim(c, s);
    for (int l = 0; l < LANES; l++) {
        s->front[l] = s->front_along[0][l] = s->front_along[1][l] = s->known[l] = 0;
        if (c.at.turns) follow_turn(c, l, s);
        add_kinks(c, l, s);
    }
    add_kink_at_rim(s);
    for (int l = 0; l < LANES && c.at.turns; l++)
        keep_turn(c, l, s);
    EACH_LANE /* the kinks may have taken the force beyond Coulomb's limit; its square may underflow */
    {
        const double scale = c.law->tangential * c.in->width[l], limit = c.in->friction[l] * s->force[l];
        const double x = scale * s->total[0][l], y = scale * s->total[1][l];
        const double one = larger(larger(fabs(x), fabs(y)), DBL_MIN), px = x / one, py = y / one;
        const double kept = limit / larger(larger(limit, one * sqrt(px * px + py * py)), DBL_MIN);
        s->total[0][l] = x * kept;
        s->total[1][l] = y * kept;
    }
    if (!c.at.details) return;
    EACH_LANE
    {
        s->slipped[l] += (s->inner[l] * s->q_last[0][l] + s->outer[l] * s->rim[0][l]) * s->back[0][l] +
                         (s->inner[l] * s->q_last[1][l] + s->outer[l] * s->rim[1][l]) * s->back[1][l];
        s->slipped[l] *= c.law->tangential * c.in->width[l] * s->touches[l];
    }
}

#endif
