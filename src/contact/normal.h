/* The normal problem of a step.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_NORMAL_H
#define RST_CONTACT_NORMAL_H

#include "contact/lanes.h"

/* Elements that were reached within the step: their arms have had only a part of it. */
RARE void enter(const struct rst_law *restrict law, double step, const struct arm *even, const double *gap,
                const double *pressed, struct rows *row)
{
    memcpy(row->own, even, (size_t)law->at.terms * sizeof *even);
    row->arms = row->own;
    for (int i = 0; i < law->at.n; i++) {
        if (!(gap[i] < 0 && pressed[i] > 0)) continue;
        row->touch[i] = larger(1e-9, pressed[i] / (pressed[i] - gap[i]));
        for (int k = 0; k < law->at.terms; k++) {
            const struct rst_arm arm = rst_arm_of(row->touch[i] * step, law->tau[k]);
            row->own[k].decay[i] = arm.decay;
            row->own[k].gain[i] = arm.gain;
        }
    }
}

/* In a sum of bits, counts elements that are reached within the step. */
static const double entry = 0x1p40;

/* The outermost element whose bit is in the sum. */
INLINE int outermost(double bits)
{
    const uint32_t in = (uint32_t)(int64_t)bits;
    return in ? 32 - __builtin_clz(in) : 0;
}

/* Every element follows the sphere or, where that would pull, its own free surface, whichever is
 * larger: entry, exit and re-entry on a surface that has not relaxed are one line. An element
 * enters where the profile reaches its free surface. */
INLINE void follow_profile(const struct call c, int l, struct work *s)
{
    const int n = c.at.n;
    const double scale = s->scale[l], before = c.in->before[l], overlap = c.in->overlap[l];
    const double dashpot = c.at.surface ? c.law->eta * s->approach[l] : 0;
    double *const w = w_of(c, l, 0), *const surface = u_of(c, l, 0);
    struct rows *const row = &s->row[l];
    double u[most_n], held[most_n], pull[most_n], moved[most_n], gap[most_n], f[most_n], part[most_n];
    double *const pressed = row->pressed;
    EACH_ELEMENT held[i] = pull[i] = 0;
    for (int k = 0; k < c.at.terms; k++) {
        const double g = c.law->g[k], later = c.law->g[k] * c.r->decay[k];
        EACH_ELEMENT
        {
            held[i] += g * w[k * n + i];
            pull[i] += later * w[k * n + i];
        }
    }
    EACH_ELEMENT
    {
        const double y = c.law->y[i] * scale, old = before - y;
        u[i] = c.at.surface ? surface[i] : larger(old, -held[i] * c.law->compliance);
        const double loose = -(c.law->g_inf * u[i] + pull[i]) * c.r->compliance;
        gap[i] = old - u[i];
        pressed[i] = overlap - y - u[i] - loose;
        moved[i] = loose + larger(pressed[i], 0);
        row->touch[i] = if_so(pressed[i] > 0);
        part[i] = row->touch[i] * (c.law->bit[i] + entry * if_so(gap[i] < 0));
    }
    row->arms = s->even;
    const double bits = sum_of(part, n);
    if (bits >= entry) enter(c.law, c.step, s->even, gap, pressed, row);
    EACH_ELEMENT f[i] = c.law->g_inf * (u[i] + moved[i]) + dashpot;
    if (c.at.surface) EACH_ELEMENT surface[i] = u[i] + moved[i];
    if (c.at.details) EACH_ELEMENT row->spent[i] = c.law->eta / c.step * moved[i] * moved[i];
    for (int k = 0; k < c.at.terms; k++) {
        const double g = c.law->g[k], *const decay = row->arms[k].decay, *const gain = row->arms[k].gain;
        const double *const spent = c.r->spent[k];
        EACH_ELEMENT
        {
            const double before = w[k * n + i];
            w[k * n + i] = decay[i] * before + gain[i] * moved[i];
            f[i] += g * w[k * n + i];
            if (c.at.details)
                row->spent[i] += spent[0] * before * before + (spent[1] * before + spent[2] * moved[i]) * moved[i];
        }
    }
    if (c.at.details) {
        EACH_ELEMENT part[i] = c.law->weight[i] * row->spent[i];
        s->spent[l] = c.law->normal * c.in->width[l] * sum_of(part, n);
    }
    EACH_ELEMENT
    {
        row->f[i] = larger(f[i], 0) * if_so(pressed[i] > 0);
        part[i] = c.law->weight[i] * row->f[i];
    }
    s->sum[l] = sum_of(part, n);
    s->last[l] = outermost(bits);
}

/* What the rim needs of the last element of a contact, and whether the next one has ever been
 * touched. */
INLINE void look_at_last(const struct call c, int l, struct work *s)
{
    const int n = c.at.n, last = s->last[l], j = last > 0 ? last - 1 : 0, before = j > 0 ? j - 1 : 0;
    const double *const w = w_of(c, l, 0);
    s->touches[l] = if_so(last > 0);
    s->x[l] = c.law->x[j];
    s->y[l] = c.law->y[j];
    s->y_before[l] = c.law->y[before];
    s->next[l] = last < n ? c.law->y[j + 1] : beyond;
    s->per_cell[l] = c.law->per_cell[j];
    s->outwards[l] = c.law->outwards[j];
    s->f_last[l] = s->row[l].f[j];
    s->f_before[l] = s->row[l].f[before];
    bool virgin = true;
    for (int k = 0; k < c.at.terms; k++) {
        s->w_last[k][l] = w[k * n + j];
        virgin &= last == n || w[k * n + last] == 0;
    }
    if (c.at.surface) virgin &= last == n || u_of(c, l, 0)[last] == 0;
    s->virgin[l] = if_so(virgin);
    s->meets[l] = beyond;
    if (!c.at.surface || virgin) return;
    const double *const pressed = s->row[l].pressed,
                        out = last + 1 < n ? pressed[last + 1] : c.in->overlap[l] - s->scale[l];
    const double fall = pressed[last] - out;
    const double meets = c.law->y[last] + quotient(pressed[last], fall) * (c.law->y[last + 1] - c.law->y[last]);
    if (pressed[last] < 0 && fall > 0) s->meets[l] = larger(s->y[l], meets);
}

/* Where the contact ends beyond its last element, f there, and the whole force. A contact that
 * grows over virgin elements ends where the sphere does. Behind its rim elongations rise within tau
 * times the velocity, which may be less than a cell: w ~ 1 - exp(-z), z from the rim in tau v. The
 * value at the rim is the one whose linear interpolation has the integral of that over the cell,
 * 2/(1 - exp(-z)) - 2/z - 1 of w at the last element, within 0.007; z is known from w there, the
 * part q = (1 - exp(-z))/z of the cell. Any other contact ends where f, extrapolated, is zero. */
INLINE void close_rim(const struct call c, const double *approach, struct work *s)
{
    lanes cell, per, rise;
    EACH_LANE
    {
        cell[l] = c.in->overlap[l] - s->y[l] * s->scale[l];
        per[l] = 1 / larger(cell[l], DBL_MIN);
        rise[l] = c.law->eta * approach[l];
    }
    for (int k = 0; k < c.at.terms; k++) {
        const double g = c.law->g[k];
        EACH_LANE
        {
            const double w = s->w_last[k][l], q = larger(0, smaller(w, cell[l])) * per[l];
            const double grows = if_so(s->approach[l] > 0) * s->virgin[l] * s->touches[l];
            const double ratio = grows * (1 - q) / (1 + q * (1 + q * (2.83 - 1.83 * q)));
            s->ratio[k][l] = ratio;
            rise[l] += g * w * ratio;
        }
    }
    EACH_LANE
    {
        const double y = s->y[l], x = s->x[l], f = s->f_last[l], next = s->next[l], touches = s->touches[l];
        const double slope = (s->f_before[l] - f) * s->per_cell[l], soft = c.law->g_inf * s->scale[l];
        const bool enters = (s->approach[l] > 0) & (s->virgin[l] == 0);
        const double at_rest = c.in->overlap[l] / s->scale[l], free = enters ? smaller(at_rest, s->meets[l]) : at_rest;
        const double several = if_so(s->per_cell[l] > 0);
        const bool grows = (s->approach[l] > 0) & (s->virgin[l] > 0);
        const double fall = slope > 0 ? slope : soft;
        const bool ends = (f < fall * (free - y)) & !grows;
        const double place = ends ? y + quotient(f, fall) : free;
        const double risen = larger(0, rise[l]), held = larger(0, f - slope * (free - y)) * several * if_so(!ends);
        const double here = grows ? risen : held,
                     there = larger(0, f - slope * (next - y)) * several * if_so(place > next);
        const double at_rim = here > 0 ? here : there;
        const double edge = sqrt(larger(smaller(place, next), y));
        const double third = larger(edge - x, 0) / (3 * larger(edge + x, DBL_MIN));
        s->at_rim[l] = touches * at_rim;
        s->edge[l] = edge;
        s->inner[l] = touches * (third * (2 * edge + x) - s->outwards[l]);
        s->outer[l] = touches * third * (2 * x + edge);
        s->force[l] = c.law->normal * c.in->width[l] * (s->sum[l] + s->inner[l] * f + s->outer[l] * s->at_rim[l]);
    }
}

/* The viscous force at the velocity of the end of the step. An element that this would make pull
 * springs back at once. */
INLINE void feel_end_velocity(const struct call c, double change, int l, struct work *s)
{
    const int n = c.at.n;
    double *const w = w_of(c, l, 0), *const surface = u_of(c, l, 0);
    struct rows *const row = &s->row[l];
    double back[most_n], moved[most_n], part[most_n], bits[most_n];
    EACH_ELEMENT
    {
        moved[i] = if_so(row->touch[i] > 0) * change;
        const double f = row->f[i] + c.r->viscosity * moved[i], pushes = larger(f, 0), stays = if_so(f > 0);
        back[i] = (pushes - f) * c.r->compliance;
        row->touch[i] = stays * row->touch[i];
        row->f[i] = pushes;
        part[i] = c.law->weight[i] * pushes;
        bits[i] = c.law->bit[i] * stays;
    }
    if (c.at.surface) EACH_ELEMENT surface[i] += back[i];
    for (int k = 0; k < c.at.terms; k++) {
        const double bend = c.r->bend[k], gain = c.r->gain[k];
        EACH_ELEMENT w[k * n + i] += bend * moved[i] + gain * back[i];
    }
    s->sum[l] = sum_of(part, n);
    s->last[l] = outermost(sum_of(bits, n));
}

INLINE void press(const struct call c, struct work *s)
{
    for (int l = 0; l < LANES; l++) {
        follow_profile(c, l, s);
        look_at_last(c, l, s);
    }
    close_rim(c, s->approach, s);
    if (c.at.terms + c.at.surface == 0 || !(c.r->viscosity > 0)) return;
    lanes change, later;
    EACH_LANE
    {
        /* The equilibrium spring carries what does not accelerate, such as a weight at rest. */
        const double rim = c.in->width[l] * s->edge[l];
        const double carried =
            c.law->normal * c.law->g_inf * rim * (c.in->overlap[l] - rim * rim / (3 * c.in->radius[l]));
        const double response =
            velocity_response(0.5 * c.step * c.in->inverse_mass[0][l], c.law->normal * rim * c.r->viscosity);
        change[l] = -s->touches[l] * response * (s->force[l] - carried);
        later[l] = s->approach[l] + change[l];
    }
    for (int l = 0; l < LANES; l++) {
        feel_end_velocity(c, change[l], l, s);
        look_at_last(c, l, s);
    }
    close_rim(c, later, s);
}

#endif
