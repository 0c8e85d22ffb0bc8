/* SPDX-License-Identifier: BSD-3-Clause
 * A box of two hundred rubber spheres of two sizes that fly, spin and hit one another and the
 * walls: an event-driven simulation whose impacts take both restitutions, of the normal speed and
 * of the angle, from a table.
 *
 *   start      one table for the material; it serves large and small, and the walls by restitute_table_contact_set
 *   event      the next impact of all: fly there, let the two collide by the table, predict anew
 *   accounts   momentum against what the walls took; no impact gains energy
 *
 * No cut-off against inelastic collapse is needed: slow impacts of a viscoelastic solid are nearly
 * elastic. */
#include <math.h>
#include <restitute/table.h>
#include <stdint.h>
#include <stdio.h>

enum { SPHERES = 200, IMPACTS = 5000, LARGE = 0, SMALL = 1, WALL = 2 }; /* kinds of bodies */

static const double RADIUS[] = {0.01, 0.006, INFINITY}; /* m */
static const double DENSITY = 1100, FRICTION = 0.4;     /* kg/m^3 */
static const double SIDE = 0.2, SPEED = 0.02;           /* of the box, m; of a sphere at the start, m/s */

struct sphere {
    int kind;
    restitute_body body; /* m, m/s, rad/s */
    double when;         /* s, of its next impact */
    int partner;         /* a sphere, or SPHERES + 2 axis + (1 if the far wall) */
};

struct box {
    struct sphere sphere[SPHERES];
    const restitute_table *table;
    restitute_table_contact with_wall; /* the walls are rigid; the table was built for two spheres */
    double now;                        /* s */
    double wall_impulse[3];            /* kg m/s, given by the walls so far */
    double cost, least;                /* J, lost in all impacts so far; the least loss of one */
};

static double mass(int kind)
{
    return 4.0 / 3 * acos(-1.0) * DENSITY * pow(RADIUS[kind], 3);
}

static double inertia(int kind)
{
    return 0.4 * mass(kind) * RADIUS[kind] * RADIUS[kind];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double uniform(uint64_t *state) /* in [0, 1): splitmix64, so that every machine makes the same box */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* ---- the table */

static int prepare_table(struct box *box, const restitute_material *rubber, restitute_table **table,
                         restitute_error *error)
{
    restitute_table_options options;
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = rubber, scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM, scene.friction = FRICTION;
    scene.radius1 = scene.radius2 = RADIUS[LARGE], scene.mass1 = scene.mass2 = mass(LARGE);
    restitute_table_options_init(&options);
    options.speed[0] = 1e-5, options.speed[1] = 10; /* m/s */
    if (restitute_table_build(&scene, &options, table, error) < 0) return -1;
    scene.radius2 = scene.mass2 = INFINITY, scene.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    restitute_table_contact_init(&box->with_wall);
    if (restitute_table_contact_set(*table, &scene, &box->with_wall, error) < 0) return -1;
    box->table = *table;
    return 0;
}

/* ---- one impact */

static double energy(const struct sphere *a)
{
    return 0.5 * a->body.mass * dot(a->body.velocity, a->body.velocity) +
           0.5 * inertia(a->kind) * dot(a->body.spin, a->body.spin);
}

/* Sphere a hits b, or with b NULL a wall whose normal points at it. */
static int hit(struct box *box, struct sphere *a, struct sphere *b, const double *normal)
{
    const double before = energy(a) + (b ? energy(b) : 0);
    restitute_body wall;
    restitute_body_init(&wall);
    wall.radius = INFINITY;
    for (int k = 0; k < 3; ++k) {
        wall.normal[k] = normal[k];
        wall.position[k] = a->body.position[k] - a->body.radius * normal[k];
        box->wall_impulse[k] -= b ? 0 : a->body.mass * a->body.velocity[k];
    }
    if (restitute_table_collide(box->table, b ? NULL : &box->with_wall, &a->body, b ? &b->body : &wall, NULL, NULL,
                                NULL) < 0)
        return -1;
    for (int k = 0; k < 3; ++k)
        box->wall_impulse[k] += b ? 0 : a->body.mass * a->body.velocity[k];
    const double lost = before - energy(a) - (b ? energy(b) : 0);
    box->cost += lost;
    box->least = fmin(box->least, lost);
    return 0;
}

/* ---- events */

/* Time until two spheres touch; infinity if they do not approach or pass by. */
static double time_to_sphere(const struct sphere *a, const struct sphere *b)
{
    double x[3], v[3];
    for (int k = 0; k < 3; ++k)
        x[k] = b->body.position[k] - a->body.position[k], v[k] = b->body.velocity[k] - a->body.velocity[k];
    const double reach = RADIUS[a->kind] + RADIUS[b->kind], approach = -dot(x, v);
    const double gap = dot(x, x) - reach * reach; /* of the squares */
    const double root = approach * approach - dot(v, v) * gap;
    if (approach <= 0 || root < 0) return INFINITY;
    return gap > 0 ? gap / (approach + sqrt(root)) : 0; /* this form has no cancellation */
}

/* The next impact of sphere i. It replaces that of its partner if it comes earlier. */
static void predict(struct box *box, int i)
{
    struct sphere *a = &box->sphere[i];
    a->when = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const double far = a->body.velocity[k] > 0 ? SIDE - RADIUS[a->kind] : RADIUS[a->kind];
        const double t = a->body.velocity[k] == 0 ? INFINITY : box->now + fmax(0, (far - a->body.position[k]) / a->body.velocity[k]);
        if (t < a->when) a->when = t, a->partner = SPHERES + 2 * k + (a->body.velocity[k] > 0);
    }
    for (int j = 0; j < SPHERES; ++j) {
        struct sphere *b = &box->sphere[j];
        const double t = j == i ? INFINITY : box->now + time_to_sphere(a, b);
        if (t < a->when) a->when = t, a->partner = j;
        if (t < b->when) b->when = t, b->partner = i;
    }
}

static int next_impact(struct box *box)
{
    int first = 0;
    for (int i = 1; i < SPHERES; ++i)
        if (box->sphere[i].when < box->sphere[first].when) first = i;
    struct sphere *a = &box->sphere[first];
    const int partner = a->partner;
    struct sphere *b = partner < SPHERES ? &box->sphere[partner] : NULL;
    const double flight = a->when - box->now;
    box->now = a->when;
    for (int i = 0; i < SPHERES; ++i)
        for (int k = 0; k < 3; ++k)
            box->sphere[i].body.position[k] += flight * box->sphere[i].body.velocity[k];

    double n[3] = {0}; /* of a wall */
    if (!b) n[(partner - SPHERES) / 2] = partner % 2 == SPHERES % 2 ? 1 : -1;
    if (hit(box, a, b, n) < 0) return -1;

    predict(box, first);
    if (b) predict(box, partner);
    for (int i = 0; i < SPHERES; ++i) /* spheres that were to hit one of them need a new impact */
        if (i != first && i != partner && (box->sphere[i].partner == first || (b && box->sphere[i].partner == partner)))
            predict(box, i);
    return 0;
}

/* ---- box and accounts */

static void fill(struct box *box)
{
    uint64_t random = 2017;
    for (int i = 0; i < SPHERES; ++i) { /* on a grid of 6 x 6 x 6 */
        struct sphere *a = &box->sphere[i];
        a->kind = i % 2;
        restitute_body_init(&a->body);
        a->body.radius = RADIUS[a->kind], a->body.mass = mass(a->kind);
        for (int k = 0, cell = i; k < 3; ++k, cell /= 6) {
            a->body.position[k] = (cell % 6 + 0.5) * SIDE / 6;
            a->body.velocity[k] = SPEED * (2 * uniform(&random) - 1);
        }
    }
    for (int i = 0; i < SPHERES; ++i)
        box->sphere[i].when = INFINITY;
    for (int i = 0; i < SPHERES; ++i)
        predict(box, i);
}

static void measure(const struct box *box, double *moving, double *spinning, double *momentum, double *overlap)
{
    *moving = *spinning = *overlap = 0;
    momentum[0] = momentum[1] = momentum[2] = 0;
    for (int i = 0; i < SPHERES; ++i) {
        const struct sphere *a = &box->sphere[i];
        *moving += 0.5 * mass(a->kind) * dot(a->body.velocity, a->body.velocity), *spinning += 0.5 * inertia(a->kind) * dot(a->body.spin, a->body.spin);
        for (int k = 0; k < 3; ++k)
            momentum[k] += mass(a->kind) * a->body.velocity[k] - box->wall_impulse[k] / SPHERES;
        for (int j = 0; j < i; ++j) {
            double x[3];
            for (int k = 0; k < 3; ++k)
                x[k] = box->sphere[j].body.position[k] - a->body.position[k];
            const double reach = RADIUS[a->kind] + RADIUS[box->sphere[j].kind];
            *overlap = fmax(*overlap, 1 - sqrt(dot(x, x)) / reach);
        }
    }
}

int main(void)
{
    static struct box box;
    restitute_material *rubber = NULL;
    restitute_table *table = NULL;
    restitute_error error = {0};
    double start, moving, spinning, before[3], momentum[3], overlap;
    if (restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, &error) < 0 || /* G1, G2, eta, nu */
        prepare_table(&box, rubber, &table, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    fill(&box);
    measure(&box, &start, &spinning, before, &overlap);
    printf("%8s %8s %12s %12s %12s\n", "impacts", "time, s", "moving, J", "spinning, J", "lost, J");
    for (int i = 1; i <= IMPACTS; ++i) {
        if (next_impact(&box) < 0) return 1;
        if (i & (i - 1) && i != IMPACTS) continue; /* at powers of two */
        measure(&box, &moving, &spinning, momentum, &overlap);
        if (i >= 64) printf("%8d %8.3f %12.3e %12.3e %12.3e\n", i, box.now, moving, spinning, box.cost);
    }
    const double energy_error = fabs(start - moving - spinning - box.cost) / start;
    double momentum_error = 0;
    for (int k = 0; k < 3; ++k)
        momentum_error = fmax(momentum_error, fabs(momentum[k] - before[k]) / (SPHERES * mass(LARGE) * SPEED));
    /* 5000 impacts, each with a rounding error of some 1e-16 of the total: 1e-12 is enough for
     * rounding alone. */
    const int sane = energy_error < 1e-12 && momentum_error < 1e-12 && overlap < 1e-12 && box.least >= -1e-16 * start;
    printf("energy, momentum and room add up to rounding: %s\n", sane ? "yes" : "NO");
    if (!sane) printf("off by %.1e, %.1e, %.1e, %.1e\n", energy_error, momentum_error, overlap, box.least / start);
    restitute_table_destroy(table);
    restitute_material_destroy(rubber);
    return !sane;
}
