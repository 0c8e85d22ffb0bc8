/* The nodes of a contact and the integral over its radius of what is linear in y = x^2 between them:
 * exact for the elastic force, for any number of nodes (docs/contact.md). Their width when a contact
 * begins, and when it outgrows them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "contact/kernel.h"
#include "contact/law.h"

static double weight_of(double x1, double x2)
{
    return x1 + x2 > 0 ? fabs(x2 - x1) * (2 * x2 + x1) / (3 * (x1 + x2)) : 0;
}

/* Nodes are half-way between evenly spaced ones and those of sin, which are dense at the edge. */
void rst_law_grid(struct rst_law *law)
{
    const double half_pi = acos(0.0);
    const int n = law->n;
    for (int j = 0; j <= n; j++) {
        const double share = (double)j / n;
        law->x[j] = 0.5 * (share + sin(half_pi * share));
        law->y[j] = law->x[j] * law->x[j];
    }
    for (int j = 0; j < n; j++) {
        law->bit[j] = ldexp(1, j);
        law->outwards[j] = weight_of(law->x[j], law->x[j + 1]);
        law->weight[j] = law->outwards[j] + (j > 0 ? weight_of(law->x[j], law->x[j - 1]) : 0);
        law->per_cell[j] = j > 0 ? 1 / (law->y[j] - law->y[j - 1]) : 0;
    }
}

/* Values on a grid that is sqrt(ratio) times as wide, linear in y; beyond the old one: 0. */
static void resample(int n, const double *y, double ratio, double *values)
{
    for (int j = 0, i = 0; j < n; j++) { /* the values read lie at or behind j: ratio > 1 */
        const double place = fmin(1, ratio * y[j]);
        while (i < n - 1 && y[i + 1] < place)
            i++;
        const double outer = i < n - 1 ? values[i + 1] : 0, share = (place - y[i]) / (y[i + 1] - y[i]);
        values[j] = (1 - share) * values[i] + share * outer;
    }
}

void rst_contact_stretch(const struct rst_law *law, double area, double *state)
{
    static const double step = 1.5; /* 2 loses resolution, less stretches more often */
    const double width = state[at_width];
    double ratio = 1;
    while (area > ratio * width * (ratio * width))
        ratio *= step;
    for (double *values = state + at_arrays; values < state + rst_at_turn(law); values += law->n)
        resample(law->n, law->y, ratio * ratio, values);
    if (law->turns) state[rst_at_turn(law) + turn_y] /= ratio * ratio;
    state[at_width] = ratio * width;
}

int rst_contact_begin(const struct rst_law *law, double step, const restitute_contact_motion *m, double *state)
{
    static const double margin = 1.02;         /* of the grid over the expected radius */
    static const double least_overlap = 1e-30; /* over the radius: the square of the width is not to underflow */
    static const double least_steps = 10;      /* below, the first steps alone may exceed the largest force */
    static const double at_rest = 1e-60;       /* m/s, s/kg: below, energies underflow, masses overflow */
    const double *n = m->normal, *v = m->velocity, approach = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    double overlap = fmax(m->overlap, least_overlap * m->radius);
    if (approach > at_rest && 0.5 * step * m->inverse_mass > at_rest) {
        overlap = fmax(overlap, rst_law_largest_overlap(law, 1 / m->inverse_mass, m->radius, approach));
        if (least_steps * step * approach > RST_ELASTIC_CONTACT_TIME * overlap) return 0;
    }
    int smallest = 0; /* component of the normal: that axis is nearest to the tangential plane */
    for (int i = 1; i < 3; i++)
        if (fabs(n[i]) < fabs(n[smallest])) smallest = i;
    state[at_width] = margin * sqrt(fmin(overlap, m->radius) * m->radius);
    state[at_overlap] = m->overlap - approach * step;
    state[at_axis + smallest] = 1;
    return 1;
}
