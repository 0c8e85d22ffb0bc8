/* The nodes of a contact and the integral over its radius of what is linear in y = x^2 between
 * them: exact for the elastic force, for any number of nodes (docs/contact.md). Their width when a
 * contact begins, when it outgrows them, and when it rests shallow.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "contact/law.h"

static const double least_overlap = 1e-30; /* over the radius: the square of the width is not to underflow */

/* Nodes are half-way between evenly spaced ones and those of sin, which are dense at the edge. */
void rst_law_grid(struct rst_law *law)
{
    const double half_pi = acos(0.0);
    const int n = law->at.n;
    for (int j = 0; j <= n; j++) {
        const double share = (double)j / n;
        law->x[j] = 0.5 * (share + sin(half_pi * share));
        law->y[j] = law->x[j] * law->x[j];
    }
    for (int j = 0; j < n; j++) {
        law->bit[j] = ldexp(1, j);
        law->outwards[j] = rst_weight_of(law->x[j], law->x[j + 1]);
        law->weight[j] = law->outwards[j] + (j > 0 ? rst_weight_of(law->x[j], law->x[j - 1]) : 0);
        law->per_cell[j] = j > 0 ? 1 / (law->y[j] - law->y[j - 1]) : 0;
    }
}

/* The arrays of a state on a grid of `ratio` times the area: linear in y up to the last element
 * before `out`, and from there to zero at y = `edge`. */
static void regrid(const struct rst_law *law, double ratio, int out, double edge, double *state)
{
    const int n = law->at.n;
    double y[rst_most_nodes + 1], old[rst_most_nodes + 1];
    for (int j = 0; j <= n; j++)
        y[j] = j < out ? law->y[j] : edge + (j - out);
    for (double *values = state + at_arrays; values < state + rst_at_turn(law->at); values += n) {
        for (int j = 0; j <= n; j++)
            old[j] = j < out ? values[j] : 0;
        for (int j = 0, i = 0; j < n; j++) {
            const double place = fmin(y[n], ratio * law->y[j]);
            while (i < n - 1 && y[i + 1] < place)
                i++;
            const double share = (place - y[i]) / (y[i + 1] - y[i]);
            values[j] = (1 - share) * old[i] + share * old[i + 1];
        }
    }
    if (law->at.turns) state[rst_at_turn(law->at) + turn_y] /= ratio;
    state[at_width] *= sqrt(ratio);
}

void rst_contact_stretch(const struct rst_law *law, double area, double *state)
{
    static const double step = 1.5; /* of the width; 2 loses resolution, less stretches more often */
    double ratio = 1;
    while (area > ratio * state[at_width] * state[at_width])
        ratio *= step * step;
    regrid(law, ratio, law->at.n, 1, state);
}

/* The first element outside a contact that ends at y = `edge`. */
static int first_outside(const struct rst_law *law, double edge)
{
    int j = 1;
    while (j < law->at.n && law->y[j] < edge)
        j++;
    return j;
}

int rst_contact_may_shrink(const struct rst_law *law, double step, const struct rst_batch *b, int l)
{
    /* Of the change of the overlap in the step over the overlap. An elastic impact of N steps that
     * is as shallow as this changes its overlap by more than 8/N in a step: less than 80 000. */
    static const double slow = 1e-4;
    static const double nothing = 1e-6; /* over the overlap; slip is of friction times it */
    const double overlap = b->overlap[l], width = b->width[l], area = overlap * b->radius[l];
    if (!(rst_is_wide(area, width) && fabs(rst_approach(b, l)) * step < slow * overlap &&
          overlap > least_overlap * b->radius[l]))
        return 0;
    const int out = first_outside(law, area / (width * width));
    const double *end = b->state[l] + rst_at_turn(law->at);
    for (const double *values = b->state[l] + at_arrays; values < end; values += law->at.n)
        for (int j = out; j < law->at.n; j++)
            if (!(fabs(values[j]) <= nothing * overlap)) return 0;
    return 1;
}

/* Linear to zero at the edge: so no energy is gained. */
void rst_contact_shrink(const struct rst_law *law, double area, double *state)
{
    static const double margin = 1.5; /* of width^2: far from outgrown, and from what shrinks */
    const double edge = area / (state[at_width] * state[at_width]);
    regrid(law, margin * edge, first_outside(law, edge), edge, state);
}

int rst_contact_begin(const struct rst_law *law, double step, const struct rst_batch *b, double *state)
{
    static const double margin = 1.02;    /* of the grid over the expected radius */
    static const double least_steps = 10; /* below, the first steps alone may exceed the largest force */
    static const double at_rest = 1e-60;  /* m/s, s/kg: below, energies underflow, masses overflow */
    const double approach = rst_approach(b, 0), radius = b->radius[0], inverse_mass = b->inverse_mass[0][0];
    double overlap = fmax(b->overlap[0], least_overlap * radius);
    if (approach > at_rest && 0.5 * step * inverse_mass > at_rest) {
        overlap = fmax(overlap, rst_law_largest_overlap(law, 1 / inverse_mass, radius, approach));
        if (least_steps * step * approach > RST_ELASTIC_CONTACT_TIME * overlap) return 0;
    }
    int smallest = 0; /* component of the normal: that axis is nearest to the tangential plane */
    for (int i = 1; i < 3; i++)
        if (fabs(b->normal[i][0]) < fabs(b->normal[smallest][0])) smallest = i;
    state[at_width] = margin * sqrt(fmin(overlap, radius) * radius);
    state[at_overlap] = b->overlap[0] - approach * step;
    state[at_axis + smallest] = 1;
    return 1;
}
