/* The impacts that are solved for a set of constants, and the values of all points from them. For
 * one solid e_z and the contact time over T depend on T alone, the time scale of the impact
 * (docs/theory.md, section 2). So for many points without e_x, impacts equally spaced in log T are
 * solved, and the points are interpolated.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/report.h"
#include "fit/model.h"

/* Polynomials through six impacts. A relaxation changes e_z over y = log T like 1/(1 + exp(2 y)),
 * which has poles at i pi/2: its sixth derivative is about 6!/(pi/2)^6 = 50, so the error is 0.005
 * x 50 STEP^6 = 2e-7, as that of the impacts. Where e falls to 0 it is some 1e-5
 * (tests/api/test_fit_impacts.c). Twice the step has 64 times that error. */
static const double STEP = 0.1;

/* Number of own impacts that suffices to find the minimum of a few constants. Half of it may miss
 * one; twice only takes longer. */
enum { ENOUGH = 100 };

/* The contact time grows without bound where e falls to 0. There it is not interpolated. */
static const double LEAST_EZ = 0.3;

static int may_lie_between(const restitute_fit_point *p)
{
    return isnan(p->ex) && (isnan(p->contact_time) || p->ez >= LEAST_EZ);
}

/* T of every point, apart from a factor of its group: with the same modulus for all. The core
 * checks the scene. */
static int find_times(struct rst_fit_data *d, restitute_error *error)
{
    restitute_material *any = NULL;
    restitute_numbers numbers;
    restitute_error inner;
    int status = restitute_material_elastic(1, 0.5, &any, error);
    restitute_numbers_init(&numbers);
    for (size_t i = 0; i < d->n && status >= 0; i++) {
        restitute_scene scene = d->scene[i];
        scene.material = any;
        if (isnan(scene.friction)) scene.friction = 0.5;
        status = restitute_scene_numbers(&scene, &numbers, &inner);
        if (status < 0) rst_report(error, status, "points[%zu]: %s", i, inner.message);
        d->place[i].time = numbers.time;
    }
    restitute_material_destroy(any);
    return status;
}

static void add_impact(struct rst_fit_data *d, size_t point, double time, int own)
{
    const restitute_fit_point *p = &d->points[point];
    struct rst_fit_impact *impact = &d->impact[d->needed++];
    *impact = (struct rst_fit_impact){d->scene[point], d->group[point], own, time};
    impact->scene.normal_speed *= pow(time / d->place[point].time, -5); /* T ~ v^(-1/5) */
    if (isnan(p->ex)) impact->scene.friction = 0;                       /* saves the tangential problem */
}

/* Lagrange's weights of the impacts around a point; the first of them all is two steps below
 * `low`. */
static void set_between(struct rst_fit_place *place, size_t first, double low)
{
    const double steps = log(place->time / low) / STEP, u = 2 + steps - floor(steps);
    place->first = first + (size_t)steps;
    place->count = RST_FIT_STENCIL;
    for (int j = 0; j < RST_FIT_STENCIL; j++) {
        place->weight[j] = 1;
        for (int k = 0; k < RST_FIT_STENCIL; k++)
            if (k != j) place->weight[j] *= (u - k) / (j - k);
    }
}

/* Points without e_x lie between impacts, if that halves the impacts; the others, and slow rebounds
 * whose time was measured, have their own. These come in the order of T: equal speeds at several
 * angles share their normal motion then. */
static void impacts_of_group(struct rst_fit_data *d, size_t group, const size_t *order)
{
    const size_t first = d->needed;
    double low = INFINITY, high = 0;
    size_t members = 0, some = 0;
    for (size_t i = 0; i < d->n; i++)
        if (d->group[i] == group && may_lie_between(&d->points[i]))
            low = fmin(low, d->place[i].time), high = fmax(high, d->place[i].time), some = i, members++;
    size_t nodes = members ? (size_t)(log(high / low) / STEP) + RST_FIT_STENCIL : 0;
    if (2 * nodes > members) nodes = 0;
    for (size_t k = 0; k < nodes; k++)
        add_impact(d, some, low * exp(STEP * ((double)k - 2)), 0);
    for (size_t k = 0; k < d->n; k++) {
        const size_t i = order[k];
        if (d->group[i] != group) continue;
        if (nodes && may_lie_between(&d->points[i])) {
            set_between(&d->place[i], first, low);
            continue;
        }
        d->place[i].first = d->needed, d->place[i].count = 1, d->place[i].weight[0] = 1;
        add_impact(d, i, d->place[i].time, 1);
    }
}

int rst_fit_impacts(struct rst_fit_data *d, restitute_error *error)
{
    d->impact = malloc(d->n * sizeof *d->impact);
    d->place = malloc(d->n * sizeof *d->place);
    size_t *order = calloc(d->n, sizeof *order);
    const int status = d->impact && d->place && order
                           ? find_times(d, error)
                           : rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu points", d->n);
    if (status >= 0) gsl_sort_index(order, &d->place->time, sizeof *d->place / sizeof(double), d->n);
    for (size_t g = 0; g < d->groups && status >= 0; g++)
        impacts_of_group(d, g, order);
    free(order);
    return status;
}

/* By the golden section: with a constant stride the same angle could be taken at each speed. */
int rst_fit_passed_over(const struct rst_fit_data *d, size_t impact)
{
    return d->impact[impact].own && fmod(0.6180339887498949 * (double)impact, 1) * (double)d->stride >= 1;
}

void rst_fit_thin(struct rst_fit_data *d, int thin)
{
    size_t own = 0;
    for (size_t k = 0; k < d->needed; k++)
        own += d->impact[k].own != 0;
    d->stride = thin && own > ENOUGH ? own / ENOUGH : 1;
}

void rst_fit_values(const struct rst_fit_data *d, const restitute_result *solved, struct rst_fit_values *values)
{
    for (size_t i = 0; i < d->n; i++) {
        const struct rst_fit_place *place = &d->place[i];
        values[i] = (struct rst_fit_values){{0}};
        for (size_t j = 0; j < place->count; j++) {
            const restitute_result *r = &solved[place->first + j];
            values[i].of[RST_FIT_EZ] += place->weight[j] * r->ez;
            values[i].of[RST_FIT_EX] += place->weight[j] * r->ex;
            values[i].of[RST_FIT_TIME] +=
                place->weight[j] * r->contact_time * place->time / d->impact[place->first + j].time;
        }
    }
}
