/* SPDX-License-Identifier: BSD-3-Clause
 * DSMC of a homogeneous gas, see gas.h.
 *
 *   rate       two spheres collide at the rate |g|/N (l = 1), g their relative velocity. Pairs are drawn at the rate
 *              g_max/N and kept with probability |g|/g_max (no time counter): exact while no |g| passes g_max
 *   direction  the normal k has the density g.k on the half sphere g.k > 0: k = (g/|g| + u)/|g/|g| + u|, u uniform on the
 *              unit sphere
 *   impact     by restitute_table_collide; with a constant ez and no friction p = -(1 + ez) (g.k) k/2 is the impulse on the first */
#include "gas.h"

#include <math.h>
#include <stdlib.h>

/* In units of the rms of a component of g. Of Maxwell's pairs one of 1e6 is faster, and collides
 * slightly too seldom. */
static const double FASTEST = 5.5;

/* splitmix64: small, and the same on every machine. Uniform in [0, 1). */
static double uniform(struct gas *gas)
{
    uint64_t z = gas->random += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* Uniform on the unit sphere, by Marsaglia: a point of the unit disc folded onto it. */
static void direction(struct gas *gas, double *u)
{
    double a, b, r;
    do {
        a = 2 * uniform(gas) - 1, b = 2 * uniform(gas) - 1;
        r = a * a + b * b;
    } while (r >= 1);
    const double root = 2 * sqrt(1 - r);
    u[0] = a * root, u[1] = b * root, u[2] = 1 - 2 * r;
}

static double normal_deviate(struct gas *gas)
{
    double a, b, r;
    do {
        a = 2 * uniform(gas) - 1, b = 2 * uniform(gas) - 1;
        r = a * a + b * b;
    } while (r >= 1 || r == 0);
    return a * sqrt(-2 * log(r) / r);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct gas_pair gas_pair(const struct gas_law *law, double normal_speed, double tangential_speed)
{
    struct gas_pair pair = law->constant;
    if (law->table)
        restitute_table_pair(law->table, NULL, normal_speed, tangential_speed, &pair.ez, &pair.ex,
                             NULL); /* takes all finite speeds */
    return pair;
}

static double energy(const struct gas *gas, size_t i)
{
    return 0.5 * (dot(gas->v[i], gas->v[i]) + GAS_INERTIA * dot(gas->s[i], gas->s[i]));
}

/* Sphere i as a body at `side` k; its mass is that of the contact of the table, and s is R times
 * its spin. */
static restitute_body body_of(const struct gas *gas, size_t i, double side, const double *k)
{
    restitute_body body;
    restitute_body_init(&body);
    body.radius = gas->law.radius, body.mass = gas->law.mass;
    for (int c = 0; c < 3; ++c) {
        body.position[c] = side * gas->law.radius * k[c];
        body.velocity[c] = gas->v[i][c], body.spin[c] = gas->s[i][c] / gas->law.radius;
    }
    return body;
}

static void take_back(struct gas *gas, size_t i, const restitute_body *body)
{
    for (int c = 0; c < 3; ++c)
        gas->v[i][c] = body->velocity[c], gas->s[i][c] = gas->law.radius * body->spin[c];
}

/* The spheres i and j collide; k: unit normal from i to j. Returns the energy lost. */
static double collide(struct gas *gas, size_t i, size_t j, const double *g, const double *k)
{
    const double before = energy(gas, i) + energy(gas, j);
    ++gas->impacts;
    if (gas->law.table) {
        restitute_body first = body_of(gas, i, -1, k), second = body_of(gas, j, 1, k);
        restitute_table_collide(gas->law.table, NULL, &first, &second, NULL, NULL, NULL); /* they touch and approach */
        take_back(gas, i, &first);
        take_back(gas, j, &second);
    } else
        for (int c = 0; c < 3; ++c) {
            const double p = 0.5 * (1 + gas->law.constant.ez) * dot(g, k) * k[c];
            gas->v[i][c] -= p, gas->v[j][c] += p;
        }
    return before - energy(gas, i) - energy(gas, j);
}

void gas_step(struct gas *gas)
{
    const size_t draws = (gas->n + 7) / 8;
    const double g_max = FASTEST * sqrt(2 * gas_translational(gas));
    double cost = 0;
    for (size_t draw = 0; draw < draws; ++draw) {
        const size_t i = (size_t)(uniform(gas) * (double)gas->n);
        size_t j = (size_t)(uniform(gas) * (double)(gas->n - 1));
        if (j >= i) ++j;
        double g[3], k[3];
        for (int c = 0; c < 3; ++c)
            g[c] = gas->v[i][c] - gas->v[j][c];
        const double speed = sqrt(dot(g, g));
        if (uniform(gas) * g_max >= speed) continue;
        direction(gas, k);
        for (int c = 0; c < 3; ++c)
            k[c] += g[c] / speed;
        const double length = sqrt(dot(k, k));
        if (length == 0) continue; /* u = -g/|g|: one of 1e16 */
        for (int c = 0; c < 3; ++c)
            k[c] /= length;
        cost += collide(gas, i, j, g, k);
    }
    gas->cost += cost;
    gas->time +=
        2 * (double)draws / ((double)(gas->n - 1) * g_max); /* N (N - 1)/2 pairs, each drawn at the rate g_max/N */
}

static double mean_square(size_t n, double (*a)[3])
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += dot(a[i], a[i]);
    return sum / (double)n;
}

double gas_translational(const struct gas *gas)
{
    return mean_square(gas->n, gas->v) / 3;
}

double gas_rotational(const struct gas *gas)
{
    return GAS_INERTIA * mean_square(gas->n, gas->s) / 3;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_square(double *scratch, size_t n, double (*a)[3])
{
    for (size_t i = 0; i < n; ++i)
        scratch[i] = dot(a[i], a[i]);
    qsort(scratch, n, sizeof *scratch, ascending);
    return scratch[n / 2];
}

double gas_median_spin(const struct gas *gas)
{
    double *scratch = malloc(gas->n * sizeof *scratch);
    if (!scratch) return NAN;
    const double ratio = sqrt(median_square(scratch, gas->n, gas->s) / median_square(scratch, gas->n, gas->v));
    free(scratch);
    return ratio;
}

/* Random components, shifted to the mean 0 and scaled to the mean square. */
static void maxwell(struct gas *gas, double (*a)[3], double square)
{
    double mean[3] = {0};
    for (size_t i = 0; i < gas->n; ++i)
        for (int c = 0; c < 3; ++c)
            a[i][c] = normal_deviate(gas), mean[c] += a[i][c] / (double)gas->n;
    for (size_t i = 0; i < gas->n; ++i)
        for (int c = 0; c < 3; ++c)
            a[i][c] -= mean[c];
    const double factor = sqrt(square / mean_square(gas->n, a));
    for (size_t i = 0; i < gas->n; ++i)
        for (int c = 0; c < 3; ++c)
            a[i][c] *= factor;
}

int gas_create(struct gas *gas, const struct gas_law *law, size_t n, double translational, double rotational,
               uint64_t seed)
{
    *gas = (struct gas){.law = *law, .n = n, .random = seed};
    gas->v = malloc(n * sizeof *gas->v), gas->s = malloc(n * sizeof *gas->s);
    if (!gas->v || !gas->s) {
        gas_destroy(gas);
        return -1;
    }
    maxwell(gas, gas->v, 3 * translational);
    maxwell(gas, gas->s, 3 * rotational / GAS_INERTIA);
    return 0;
}

void gas_destroy(struct gas *gas)
{
    free(gas->v);
    free(gas->s);
    gas->v = gas->s = NULL;
}
