/* The nodes of a contact and the integral over its radius of what is linear in y = x^2 between
 * them: exact for the elastic force, for any number of nodes (docs/contact.md). Their width when a
 * contact begins, when it outgrows them, and when it rests shallow.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "contact/kernel.h"
#include "contact/law.h"

static const double least_overlap = 1e-30; /* over the radius: the square of the width is not to underflow */

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

/* Values at places `ratio` times y of the grid, from those of `old` at `from`, linear in y; beyond:
 * 0. */
static void resample(const struct rst_law *law, const double *from, const double *old, double ratio, double *values)
{
    const int n = law->n;
    for (int j = 0, i = 0; j < n; j++) {
        const double place = fmin(from[n], ratio * law->y[j]);
        while (i < n - 1 && from[i + 1] < place)
            i++;
        const double outer = i < n - 1 ? old[i + 1] : 0, share = (place - from[i]) / (from[i + 1] - from[i]);
        values[j] = (1 - share) * old[i] + share * outer;
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
        resample(law, law->y, values, ratio * ratio, values); /* reads at or behind j */
    if (law->turns) state[rst_at_turn(law) + turn_y] /= ratio * ratio;
    state[at_width] = ratio * width;
}

/* The first element outside a contact that ends at y = `edge`. */
static int first_outside(const struct rst_law *law, double edge)
{
    int j = 1;
    while (j < law->n && law->y[j] < edge)
        j++;
    return j;
}

/* `change`: of the overlap in the step. An elastic impact of N steps that is as shallow as this
 * changes its overlap by more than 8/N in a step. */
int rst_contact_may_shrink(const struct rst_law *law, double change, double overlap, double radius, const double *state)
{
    static const double slow = 1e-4;    /* over the overlap; impacts have less than 80 000 steps */
    static const double nothing = 1e-6; /* over the overlap; slip is of friction times it */
    const double width = state[at_width], area = overlap * radius;
    if (!(rst_is_wide(area, width) && fabs(change) < slow * overlap && overlap > least_overlap * radius)) return 0;
    const int out = first_outside(law, area / (width * width));
    for (const double *values = state + at_arrays; values < state + rst_at_turn(law); values += law->n)
        for (int j = out; j < law->n; j++)
            if (!(fabs(values[j]) <= nothing * overlap)) return 0;
    return 1;
}

/* Values are linear in y up to the last element in contact, and from there to zero at the edge: so
 * no energy is gained. */
void rst_contact_shrink(const struct rst_law *law, double area, double *state)
{
    static const double margin = 1.5; /* of width^2: far from outgrown, and from what shrinks */
    const double width = state[at_width], edge = area / (width * width), ratio = margin * edge;
    const int out = first_outside(law, edge);
    double y[rst_most_nodes + 1], old[rst_most_nodes];
    for (int j = 0; j <= law->n; j++)
        y[j] = j < out ? law->y[j] : edge + (j - out);
    for (double *values = state + at_arrays; values < state + rst_at_turn(law); values += law->n) {
        for (int j = 0; j < law->n; j++)
            old[j] = j < out ? values[j] : 0;
        resample(law, y, old, ratio, values);
    }
    if (law->turns) state[rst_at_turn(law) + turn_y] /= ratio;
    state[at_width] = sqrt(margin * area);
}

int rst_contact_begin(const struct rst_law *law, double step, const restitute_contact_motion *m, double *state)
{
    static const double margin = 1.02;    /* of the grid over the expected radius */
    static const double least_steps = 10; /* below, the first steps alone may exceed the largest force */
    static const double at_rest = 1e-60;  /* m/s, s/kg: below, energies underflow, masses overflow */
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
