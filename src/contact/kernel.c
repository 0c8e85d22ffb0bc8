/* One step of LANES contacts (docs/contact.md): vectors over the elements of a contact for what there is one of an element, over
 * the lanes for what there is one of a contact. Branches are selections, and no sum runs across lanes, so that a contact has the
 * same bits in every lane, batch and width of vectors.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/kernel.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))
#define RARE static __attribute__((noinline, cold))
#define SIMD _Pragma("omp simd")
#define EACH_LANE SIMD for (int l = 0; l < LANES; l++)
#define EACH_ELEMENT SIMD for (int i = 0; i < n; i++)

enum { most_n = rst_most_nodes, most_k = rst_most_terms };
static const double beyond = 1e30;  /* in y of the grid: no rim is there */
static const double fastest = 1e80; /* m/s: squares of viscous forces are not to overflow */

typedef double lanes[LANES];

/* What a compiler is to know of a law. */
struct shape {
    int n, terms, surface, slips, turns, details;
};

/* What a step is of. */
struct call {
    const struct rst_law *law;
    const struct rst_rates *r;
    struct rst_batch *in;
    double step;
    struct shape at;
};

/* Of each Maxwell arm over the step; an element that enters has less time. */
struct arms {
    double decay[most_k][most_n], gain[most_k][most_n];
};

/* Elements of a contact. Force densities in units of law.normal and law.tangential. */
struct rows {
    const struct arms *arms;
    struct arms own;
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
    struct arms even;
    struct rows row[LANES];
    int last[LANES]; /* outermost element in contact, counted from 1; 0: none */
    lanes scale;     /* width^2/radius */
    lanes width, before, approach, sum, force;
    /* the rim: places of the last element, f and w there; edge: contact radius in grid widths; weights of the last, cut cell: of
     * the last element, beside its own, and of the rim; f at the rim, and w there over w of the last element */
    lanes x, y, y_before, next, per_cell, outwards, f_last, f_before, virgin, meets, touches;
    lanes w_last[most_k], ratio[most_k], edge, inner, outer, at_rim;
    /* tangential: the frame, displacement and velocity at the end of the step, integrals over the contact radius in widths */
    lanes axis[3], other[3], move[2], speed[2], limit_ratio, total[2], sticking, slipped, spent, back[2], rim[2];
    lanes q_last[2], q_before[2], wt_last[2][most_k], stuck, last_sticks, both_stick;
    /* where slip begins beyond all that sticks: y, direction; that element, counted from 1, if it is known from a turning point */
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

/* The sum over elements, in an order that suits every width of vectors. */
INLINE double sum_of(const double *p, int n)
{
    double sum = 0;
    for (const double *q = p; q < p + n; q += 8)
        sum += ((q[0] + q[4]) + (q[2] + q[6])) + ((q[1] + q[5]) + (q[3] + q[7]));
    return sum;
}

/* exp(x) for -700 <= x <= 0 within 2e-16 relative, in lanes: x = k ln 2 + r, and Taylor's series of r. */
INLINE double exp_of(double x)
{
    const double shift = 0x1.8p52 + 1023, t = x * 1.4426950408889634 + shift, k = t - shift;
    const double r = (x - k * 0x1.62e42fee00000p-1) - k * 0x1.a39ef35793c76p-33;
    double p = 1, scale;
    for (int i = 13; i > 0; i--)
        p = p * r * (1.0 / i) + 1;
    uint64_t bits;
    memcpy(&bits, &t, sizeof bits);
    bits <<= 52;
    memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

/* Change of the velocity until the end of the step by a unit force that holds it back, with a damping of that force over velocity.
 * Such that a mere dashpot decays by exp(-damping dt/m) in a velocity-Verlet step, however strong it is. */
INLINE double velocity_response(double half_step_over_mass, double damping)
{
    const double z = 2 * half_step_over_mass * damping, safe = smaller(larger(z, 1e-3), 700);
    const double share = z < 1e-3 ? 0.5 + z / 12 : 1 / (1 - exp_of(-safe)) - 1 / larger(z, 1e-3);
    return 2 * half_step_over_mass * share / (1 + z * share);
}

/* ------------------------------------------------------------------------------------------------- normal problem */

/* Elements that were reached within the step: their arms have had only a part of it. */
RARE void enter(const struct rst_law *restrict law, double step, const struct arms *even, const double *gap,
                const double *pressed, struct rows *row)
{
    for (int k = 0; k < law->n_terms; k++) {
        memcpy(row->own.decay[k], even->decay[k], (size_t)law->n * sizeof(double));
        memcpy(row->own.gain[k], even->gain[k], (size_t)law->n * sizeof(double));
    }
    row->arms = &row->own;
    for (int i = 0; i < law->n; i++) {
        if (!(gap[i] < 0 && pressed[i] > 0)) continue;
        row->touch[i] = larger(1e-9, pressed[i] / (pressed[i] - gap[i]));
        for (int k = 0; k < law->n_terms; k++) {
            const struct rst_arm arm = rst_arm_of(row->touch[i] * step, law->tau[k]);
            row->own.decay[k][i] = arm.decay;
            row->own.gain[k][i] = arm.gain;
        }
    }
}

/* The outermost element whose bit is in the sum. */
INLINE int outermost(double bits)
{
    const uint32_t in = (uint32_t)(int64_t)bits;
    return in ? 32 - __builtin_clz(in) : 0;
}

/* Every element follows the sphere or, where that would pull, its own free surface, whichever is larger: entry, exit and re-entry on
 * a surface that has not relaxed are one line. An element enters where the profile reaches its free surface. */
INLINE void follow_profile(const struct call c, int l, struct work *s)
{
    const int n = c.at.n;
    const double scale = s->scale[l], before = s->before[l], overlap = c.in->overlap[l];
    const double dashpot = c.at.surface ? c.law->eta * s->approach[l] : 0;
    double *const w = c.in->state[l] + at_arrays, *const surface = c.in->state[l] + rst_at_surface(c.law);
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
        part[i] = row->touch[i] * smaller(gap[i], 0);
    }
    row->arms = &s->even;
    if (sum_of(part, n) < 0) enter(c.law, c.step, &s->even, gap, pressed, row);
    EACH_ELEMENT f[i] = c.law->g_inf * (u[i] + moved[i]) + dashpot;
    if (c.at.surface) EACH_ELEMENT surface[i] = u[i] + moved[i];
    if (c.at.details) EACH_ELEMENT row->spent[i] = c.law->eta / c.step * moved[i] * moved[i];
    for (int k = 0; k < c.at.terms; k++) {
        const double g = c.law->g[k], *const decay = row->arms->decay[k], *const gain = row->arms->gain[k];
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
        s->spent[l] = c.law->normal * s->width[l] * sum_of(part, n);
    }
    EACH_ELEMENT
    {
        row->f[i] = larger(f[i], 0) * if_so(pressed[i] > 0);
        part[i] = c.law->weight[i] * row->f[i];
    }
    s->sum[l] = sum_of(part, n);
    EACH_ELEMENT part[i] = c.law->bit[i] * if_so(pressed[i] > 0);
    s->last[l] = outermost(sum_of(part, n));
}

/* What the rim needs of the last element of a contact, and whether the next one has ever been touched. */
INLINE void look_at_last(const struct call c, int l, struct work *s)
{
    const int n = c.at.n, last = s->last[l], j = last > 0 ? last - 1 : 0, before = j > 0 ? j - 1 : 0;
    const double *const state = c.in->state[l], *const w = state + at_arrays;
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
    if (c.at.surface) virgin &= last == n || state[rst_at_surface(c.law) + last] == 0;
    s->virgin[l] = if_so(virgin);
    s->meets[l] = beyond;
    if (!c.at.surface || last == n) return;
    const double *const pressed = s->row[l].pressed,
                        out = last + 1 < n ? pressed[last + 1] : c.in->overlap[l] - s->scale[l];
    const double fall = pressed[last] - out;
    const bool apart = (pressed[last] < 0) & (fall > 0);
    const double meets = c.law->y[last] + pressed[last] * (c.law->y[last + 1] - c.law->y[last]) / (apart ? fall : 1);
    if (apart) s->meets[l] = larger(s->y[l], meets);
}

/* Where the contact ends beyond its last element, f there, and the whole force. A contact that grows over virgin elements ends where
 * the sphere does. Behind its rim elongations rise within tau times the velocity, which may be less than a cell: w ~ 1 - exp(-z), z
 * from the rim in tau v. The value at the rim is the one whose linear interpolation has the integral of that over the cell,
 * 2/(1 - exp(-z)) - 2/z - 1 of w at the last element, within 0.007; z is known from w there, the part q = (1 - exp(-z))/z of the
 * cell. Any other contact ends where f, extrapolated, is zero. */
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
        const double divisor = ends ? fall : 1, reached = y + f / divisor, place = ends ? reached : free;
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
        s->force[l] = c.law->normal * s->width[l] * (s->sum[l] + s->inner[l] * f + s->outer[l] * s->at_rim[l]);
    }
}

/* The viscous force at the velocity of the end of the step. An element that this would make pull springs back at once. */
INLINE void feel_end_velocity(const struct call c, double change, int l, struct work *s)
{
    const int n = c.at.n;
    double *const w = c.in->state[l] + at_arrays, *const surface = c.in->state[l] + rst_at_surface(c.law);
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
        const double rim = s->width[l] * s->edge[l];
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

/* --------------------------------------------------------------------------------------------- tangential problem */

/* Elements if all stick: displaced by the step. */
INLINE void stick(const struct call c, double per_step, int l, struct work *s)
{
    const int n = c.at.n;
    struct rows *const row = &s->row[l];
    if (c.at.details) EACH_ELEMENT row->at_rest[i] = row->by_move[0][i] = row->by_move[1][i] = 0;
    for (int d = 0; d < 2; d++) {
        double *const u = c.in->state[l] + rst_at_u(c.law) + d * n, *const w = c.in->state[l] + rst_at_w(c.law) +
                                                                               d * c.at.terms * n;
        double *const trial = row->trial[d];
        const double move = s->move[d][l], dashpot = c.law->eta * per_step * move;
        if (c.at.details) EACH_ELEMENT row->held[d][i] = c.law->g_inf * u[i];
        EACH_ELEMENT
        {
            u[i] += row->touch[i] * move;
            trial[i] = c.law->g_inf * u[i] + if_so(row->touch[i] > 0) * dashpot;
        }
        for (int k = 0; k < c.at.terms; k++) {
            const double g = c.law->g[k], *const decay = row->arms->decay[k], *const gain = row->arms->gain[k];
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
        double *const w = c.in->state[l] + rst_at_w(c.law) + d * c.at.terms * n;
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
        const double *const w = c.in->state[l] + rst_at_w(c.law) + d * c.at.terms * n;
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

/* The force density at the rim: where w rises from zero there (close_rim), that of the last element by as much; else the same part
 * of the limit. */
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

/* int p dx from x1 to x2 if p is linear in x^2, 1 at x1 and 0 at x2, whichever is larger. */
INLINE double weight_of(double x1, double x2)
{
    return fabs(x2 - x1) * (2 * x2 + x1) / larger(3 * (x1 + x2), DBL_MIN);
}

INLINE double size_of(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

/* A place in the cell beyond the element `in`, where the next one or the rim is, the limit there, and the ends of the cell. */
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

/* What an integral of q that is linear from the inner to the outer end of a cell lacks if it bends at p. */
INLINE void bend_at(const struct place *p, const double *q, int l, struct work *s)
{
    const double share = (p->y - p->y_in) / larger(p->y_out - p->y_in, DBL_MIN);
    const double weight = weight_of(p->x, p->x_in) + weight_of(p->x, p->x_out);
    for (int d = 0; d < 2; d++)
        s->total[d][l] += weight * (q[d] - p->q_in[d] - share * (p->q_out[d] - p->q_in[d]));
}

/* Where slip begins beyond a turning point. When slip ended there, the force density q was at the limit between it and the rim, and
 * what sticks has since been displaced alike: so q is at the limit anew where the margin, linear in y from the turning point to the
 * rim, is zero. A limit that has changed by now has changed alike, too. Returns y there, or 0, and the direction of slip. */
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
    return begins ? p->y + (edge - p->y) * margin / (begins ? margin - margin_at_edge : 1) : 0;
}

/* A turning point is put where slip begins: u and w, as of an element near by with the force density q, are displaced to the limit. */
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

/* The turning point over the step, displaced as an element that sticks, and its force density `q`. Returns whether it still holds:
 * the limit there has not changed much, and it does not slip. */
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

/* What slip takes in the cell where it begins, instead of what its outer element tells. Slip is what the displacement exceeds that of
 * the limit by, which grows with the approach. */
INLINE void count_slip(const struct call c, const struct place *p, const double *along, int l, struct work *s)
{
    const struct rows *const row = &s->row[l];
    const int out = p->in + 1;
    const double move = along[0] * s->move[0][l] + along[1] * s->move[1][l];
    const double slip = larger(move - s->limit_ratio[l] * s->approach[l] * c.step, 0);
    const double limit = along[0] * p->q_out[0] + along[1] * p->q_out[1];
    s->slipped[l] += slip * (p->limit * weight_of(p->x, p->x_out) + limit * weight_of(p->x_out, p->x));
    for (int d = 0; d < 2 && out < s->last[l]; d++)
        s->slipped[l] -=
            weight_of(p->x_out, p->x_in) * row->q[d][out] * (row->trial[d][out] - row->q[d][out]) * c.r->compliance;
}

/* q is not linear in y between elements at the turning point, nor where slip begins beyond it. */
INLINE void follow_turn(const struct call c, int l, struct work *s)
{
    double *const turn = c.in->state[l] + rst_at_turn(c.law), q[2] = {0}, along[2] = {0};
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
    double *const state = c.in->state[l], *const turn = state + rst_at_turn(c.law);
    if (turn[turn_y] > 0 || !(s->front[l] > 0)) return;
    const double along[2] = {s->front_along[0][l], s->front_along[1][l]};
    const struct place p = place_of(c, s->front[l], l, s);
    if (c.at.details) count_slip(c, &p, along, l, s);
    for (int d = 0; d < 2; d++) {
        turn[turn_u + d] = state[rst_at_u(c.law) + d * c.at.n + p.in];
        for (int k = 0; k < c.at.terms; k++)
            turn[turn_w + d * c.at.terms + k] = state[rst_at_w(c.law) + (d * c.at.terms + k) * c.at.n + p.in];
    }
    put_turn(c, &p, along, p.q_in, turn);
}

/* Slip begins between an element that sticks, at y_in, as the one behind does, at y_behind, and y_out, where it slips: there the
 * margin to the limit, extrapolated from the sticking side, is zero. The quadrature took it to fall to zero at y_out with the weight
 * `weight`. Returns what it lacks. */
INLINE double lacking(double margin, double behind, double x_in, double y_in, double y_behind, double y_out,
                      double weight, double *front)
{
    const double change = behind - margin;
    const bool extrapolates = (margin > 0) & (change > 0);
    const double divisor = extrapolates ? change : 1, y = y_in + margin * (y_in - y_behind) / divisor;
    const double kept = if_so(extrapolates) * if_so((y_out - y) * (y_out - y_in) > 0) * if_so(y > 0);
    *front = kept * y;
    return kept * margin * (weight - weight_of(x_in, sqrt(larger(y, 0))));
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
        const double length = slips ? size : 1, x = bx / length, y = by / length;
        const double margin = s->limit_ratio[l] * s->f_last[l] - (x * qx + y * qy);
        const double behind = s->limit_ratio[l] * s->f_before[l] - (x * px + y * py);
        double front;
        const double lacks =
            lacking(margin, behind, s->x[l], y_in, s->y_before[l], edge, s->inner[l] + s->outwards[l], &front);
        const double more = larger(lacks, 0) * if_so(slips), outer = s->outer[l] * if_so(more > 0);
        s->total[0][l] += more * x + outer * (limit * x - s->rim[0][l]);
        s->total[1][l] += more * y + outer * (limit * y - s->rim[1][l]);
        s->front[l] = more > 0 ? front : (s->last_sticks[l] > 0) & (s->known[l] == 0) ? 0 : s->front[l];
        s->front_along[0][l] = more > 0 ? x : s->front_along[0][l];
        s->front_along[1][l] = more > 0 ? y : s->front_along[1][l];
    }
}

/* What is beyond the limit springs back. Outside the contact the limit is zero: the same line lets the springs relax. */
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
        double *const u = c.in->state[l] + rst_at_u(c.law) + d * n, *const w = c.in->state[l] + rst_at_w(c.law) +
                                                                               d * c.at.terms * n;
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
    s->spent[l] += c.law->tangential * s->width[l] * sum_of(slipped, n);
}

/* Elements of a contact within the limit of friction; `viscous`: the velocity of the end of the step is still to be felt. */
INLINE void slide(const struct call c, int viscous, int l, struct work *s)
{
    cut_to_limit(c, viscous, l, s);
    look_at_last_slide(c, l, s);
    if (!viscous) spring_back(c, l, s);
}

/* The integral over the contact radius. */
INLINE void close_slide(const struct call c, int viscous, struct work *s)
{
    hold_rim(c, s);
    for (int l = 0; l < LANES; l++) {
        s->front[l] = s->known[l] = 0;
        if (c.at.turns && !viscous) follow_turn(c, l, s);
        add_kinks(c, l, s);
    }
    add_kink_at_rim(s);
    for (int l = 0; l < LANES && c.at.turns && !viscous; l++)
        keep_turn(c, l, s);
}

INLINE void shear(const struct call c, struct work *s)
{
    const double per_step = 1 / c.step, normal_over_tangential = c.law->normal / c.law->tangential;
    EACH_LANE
    {
        for (int d = 0; d < 2; d++) {
            const double *const e[3] = {d ? s->other[0] : s->axis[0], d ? s->other[1] : s->axis[1],
                                        d ? s->other[2] : s->axis[2]};
            s->speed[d][l] =
                e[0][l] * c.in->velocity[0][l] + e[1][l] * c.in->velocity[1][l] + e[2][l] * c.in->velocity[2][l];
            s->move[d][l] = c.step * s->speed[d][l];
        }
        s->limit_ratio[l] = c.in->friction[l] * normal_over_tangential;
    }
    const int viscous = c.at.terms + c.at.surface > 0 && c.r->viscosity > 0;
    for (int l = 0; l < LANES; l++) {
        stick(c, per_step, l, s);
        slide(c, viscous, l, s);
    }
    close_slide(c, viscous, s);
    if (viscous) {
        lanes change[2];
        EACH_LANE
        {
            const double scale = c.law->tangential * s->width[l];
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
        close_slide(c, 0, s);
    }
    EACH_LANE /* the kinks may have taken the force beyond Coulomb's limit; its square may underflow */
    {
        const double scale = c.law->tangential * s->width[l], limit = c.in->friction[l] * s->force[l];
        const double x = scale * s->total[0][l], y = scale * s->total[1][l], one = larger(fabs(x), fabs(y));
        const double safe = one > 0 ? one : 1, px = x / safe, py = y / safe, size = one * sqrt(px * px + py * py);
        const double most = larger(size, limit), kept = limit / (most > 0 ? most : 1);
        s->total[0][l] = x * kept;
        s->total[1][l] = y * kept;
        s->slipped[l] += (s->inner[l] * s->q_last[0][l] + s->outer[l] * s->rim[0][l]) * s->back[0][l] +
                         (s->inner[l] * s->q_last[1][l] + s->outer[l] * s->rim[1][l]) * s->back[1][l];
        s->slipped[l] *= scale * s->touches[l];
    }
}

/* -------------------------------------------------------------------------------------------------------- a step */

/* The heads of the states. The first tangential axis turns with the bodies about the normal and is brought back into the tangential
 * plane. */
INLINE void open_states(const struct call c, struct work *s)
{
    for (int l = 0; l < LANES; l++)
        s->before[l] = c.in->state[l][at_overlap];
    EACH_LANE
    {
        const double nx = c.in->normal[0][l], ny = c.in->normal[1][l], nz = c.in->normal[2][l],
                     turn = c.step * c.in->turn[l];
        double ax = c.in->axis[0][l], ay = c.in->axis[1][l], az = c.in->axis[2][l];
        const double bx = ny * az - nz * ay, by = nz * ax - nx * az, bz = nx * ay - ny * ax;
        ax += turn * bx;
        ay += turn * by;
        az += turn * bz;
        const double out = nx * ax + ny * ay + nz * az;
        ax -= out * nx;
        ay -= out * ny;
        az -= out * nz;
        const double per = 1 / sqrt(ax * ax + ay * ay + az * az);
        s->axis[0][l] = ax * per;
        s->axis[1][l] = ay * per;
        s->axis[2][l] = az * per;
        s->other[0][l] = ny * s->axis[2][l] - nz * s->axis[1][l];
        s->other[1][l] = nz * s->axis[0][l] - nx * s->axis[2][l];
        s->other[2][l] = nx * s->axis[1][l] - ny * s->axis[0][l];
        s->width[l] = c.in->width[l];
        s->scale[l] = s->width[l] * s->width[l] / c.in->radius[l];
        s->approach[l] = nx * c.in->velocity[0][l] + ny * c.in->velocity[1][l] + nz * c.in->velocity[2][l];
    }
}

/* Radius up to which elements stick: where slip begins behind it, the margin to the limit, linear in y, is zero. */
INLINE double stick_radius(const struct call c, int l, const struct work *s)
{
    const struct rows *const row = &s->row[l];
    const uint32_t stuck = (uint32_t)(int64_t)s->stuck[l];
    double margin[2];
    int j = 0;
    while (j < s->last[l] && stuck >> j & 1)
        j++;
    if (j == 0) return 0;
    if (j == s->last[l]) return s->width[l] * (s->front[l] > 0 ? sqrt(larger(s->front[l], 0)) : s->edge[l]);
    for (int i = 0; i < 2; i++)
        margin[i] = s->limit_ratio[l] * row->f[j - 1 + i] - hypot(row->trial[0][j - 1 + i], row->trial[1][j - 1 + i]);
    const double inwards = c.law->y[j - 1], outwards = c.law->y[j]; /* rounding may make any margin zero */
    const double share = larger(margin[0], 0) / larger(larger(margin[0], 0) - margin[1], DBL_MIN);
    double y = inwards + (outwards - inwards) * smaller(share, 1);
    if (s->front[l] > inwards) y = smaller(y, s->front[l]);
    return s->width[l] * smaller(s->edge[l], sqrt(y));
}

/* The work of the bodies by the trapezoid, as velocity Verlet has it, and what became of it; `state` is still of before. */
INLINE void keep_details(const struct call c, int l, const struct work *s)
{
    double *const state = c.in->state[l], *const kept = state + rst_at_details(c.law);
    kept[0] += 0.5 * ((c.in->overlap[l] - s->before[l]) * (state[at_force] + s->force[l]) +
                      s->move[0][l] * (state[at_force + 1] + s->total[0][l]) +
                      s->move[1][l] * (state[at_force + 2] + s->total[1][l]));
    kept[1] += larger(s->slipped[l], 0);
    kept[2] += s->spent[l];
    kept[3] = larger(s->slipped[l], 0) / c.step;
    kept[4] = s->spent[l] / c.step;
    kept[5] = s->touches[l] * s->width[l] * s->edge[l];
    kept[6] = c.law->slips ? stick_radius(c, l, s) : 0;
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
        c.in->force[l] = s->force[l];
        for (int i = 0; i < 3; i++)
            c.in->tangential[i][l] = -(s->total[0][l] * s->axis[i][l] + s->total[1][l] * s->other[i][l]);
    }
}

INLINE void advance(const struct call c)
{
    struct work s;
    for (int k = 0; k < c.at.terms; k++)
        for (int i = 0; i < c.at.n; i++) {
            s.even.decay[k][i] = c.r->decay[k];
            s.even.gain[k][i] = c.r->gain[k];
        }
    open_states(c, &s);
    press(c, &s);
    if (c.at.slips)
        shear(c, &s);
    else
        EACH_LANE s.total[0][l] = s.total[1][l] = s.move[0][l] = s.move[1][l] = s.slipped[l] = 0;
    close_states(c, &s);
}

/* The usual shapes are compiled on their own. */
void NAME(const struct rst_law *restrict law, const struct rst_rates *restrict rates, double step,
          struct rst_batch *restrict batch)
{
    struct call c = {law, rates, batch, step, {law->n, law->n_terms, law->surface, law->slips, law->turns, law->details}};
    const int kind = c.at.n == 8 && c.at.slips && !c.at.turns && !c.at.details ? 10 * c.at.surface + c.at.terms : -1;
    if (kind == 0)
        advance((struct call){law, rates, batch, step, {8, 0, 0, 1, 0, 0}});
    else if (kind == 10)
        advance((struct call){law, rates, batch, step, {8, 0, 1, 1, 0, 0}});
    else if (kind == 1)
        advance((struct call){law, rates, batch, step, {8, 1, 0, 1, 0, 0}});
    else if (kind == 3)
        advance((struct call){law, rates, batch, step, {8, 3, 0, 1, 0, 0}});
    else
        advance(c);
}
