/* SPDX-License-Identifier: BSD-3-Clause
 * A box of two hundred rubber spheres of two sizes that fly, spin and hit one another and the walls: an event-driven
 * simulation whose impacts take both restitutions, of the normal speed and of the angle, from a table.
 *
 *   start      one table for the material; it serves large, small and wall by restitute_table_contact_of
 *   event      the next impact of all: fly there, look the pair (ez, ex) up, apply two impulses, predict anew
 *   accounts   momentum against what the walls took; kinetic energy against what (ez, ex) say that impacts cost
 *
 * No cut-off against inelastic collapse is needed: slow impacts of a viscoelastic solid are nearly elastic. */
#include <math.h>
#include <restitute/table.h>
#include <stdint.h>
#include <stdio.h>

enum { SPHERES = 200, IMPACTS = 5000, LARGE = 0, SMALL = 1, WALL = 2 }; /* kinds of bodies */

static const double RADIUS[] = {0.01, 0.006, INFINITY}; /* m */
static const double DENSITY = 1100, FRICTION = 0.4;     /* kg/m^3 */
static const double SIDE = 0.2, SPEED = 1.0;            /* of the box, m; of a sphere at the start, m/s */

struct sphere {
    int kind;
    double x[3], v[3], w[3]; /* m, m/s, rad/s */
    double when;             /* s, of its next impact */
    int partner;             /* with whom: a sphere, or SPHERES + 2 axis + (1 if the far wall) */
};

struct box {
    struct sphere sphere[SPHERES];
    const restitute_table *table;
    restitute_table_contact contact[2][3]; /* of a kind with a kind */
    double now;                            /* s */
    double wall_impulse[3];                /* kg m/s, given by the walls so far */
    double cost;                           /* J, of all impacts so far as the pairs say */
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

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1], c[1] = a[2] * b[0] - a[0] * b[2], c[2] = a[0] * b[1] - a[1] * b[0];
}

static double uniform(uint64_t *state) /* in [0, 1): splitmix64, so that every machine makes the same box */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

/* ------------------------------------------------------------------------------------------------------ the table */

static int prepare_table(struct box *box, const restitute_material *rubber, restitute_table **table,
                         restitute_error *error)
{
    restitute_table_family family;
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = rubber, scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM, scene.friction = FRICTION;
    scene.radius1 = scene.radius2 = RADIUS[LARGE], scene.mass1 = scene.mass2 = mass(LARGE);
    restitute_table_family_init(&family);
    family.scene = &scene, family.speed[0] = 1e-5, family.speed[1] = 10; /* m/s */
    if (restitute_table_build(&family, NULL, table, error) < 0) return -1;
    for (int a = LARGE; a <= SMALL; ++a)
        for (int b = LARGE; b <= WALL; ++b) {
            scene.radius1 = RADIUS[a], scene.mass1 = mass(a);
            scene.radius2 = RADIUS[b], scene.mass2 = b == WALL ? INFINITY : mass(b);
            scene.deformable = b == WALL ? RESTITUTE_ONE_BODY_DEFORMS : RESTITUTE_BOTH_BODIES_DEFORM;
            restitute_table_contact_init(&box->contact[a][b]);
            if (restitute_table_contact_of(*table, &scene, &box->contact[a][b], error) < 0) return -1;
        }
    box->table = *table;
    return 0;
}

/* ----------------------------------------------------------------------------------------------------- one impact */

/* Sphere a hits b, or with b NULL a wall. n: unit normal, from a towards its partner. */
static int hit(struct box *box, struct sphere *a, struct sphere *b, const double *n)
{
    const double ra = RADIUS[a->kind], rb = b ? RADIUS[b->kind] : 0;
    const double ja = inertia(a->kind), jb = b ? inertia(b->kind) : INFINITY;
    const double ma = mass(a->kind), mb = b ? mass(b->kind) : INFINITY;
    const double normal_mass = 1 / (1 / ma + 1 / mb);
    const double tangent_mass = 1 / (1 / normal_mass + ra * ra / ja + rb * rb / jb);
    double u[3], turn[3], t[3], tangent[3], moment[3]; /* u: of the centres, a minus b; t: sliding at the contact */
    for (int k = 0; k < 3; ++k) {
        u[k] = a->v[k] - (b ? b->v[k] : 0);
        turn[k] = ra * a->w[k] + (b ? rb * b->w[k] : 0);
    }
    cross(turn, n, t);
    const double vn = dot(u, n);
    for (int k = 0; k < 3; ++k)
        t[k] += u[k] - vn * n[k];
    const double vt = sqrt(dot(t, t));

    restitute_table_value pair;
    const restitute_table_contact *contact = &box->contact[a->kind][b ? b->kind : WALL];
    if (restitute_table_pair_of(box->table, contact, vn, vt, &pair, NULL) < 0) return -1;
    for (int k = 0; k < 3; ++k)
        tangent[k] = -(1 + pair.ex) * tangent_mass * t[k];
    cross(n, tangent, moment); /* over the radius; it turns both spheres the same way */
    for (int k = 0; k < 3; ++k) {
        const double p = tangent[k] - (1 + pair.ez) * normal_mass * vn * n[k]; /* impulse on a */
        a->v[k] += p / ma, a->w[k] += ra * moment[k] / ja;
        if (b)
            b->v[k] -= p / mb, b->w[k] += rb * moment[k] / jb;
        else
            box->wall_impulse[k] += p;
    }
    box->cost += 0.5 * normal_mass * (1 - pair.ez * pair.ez) * vn * vn;
    box->cost += 0.5 * tangent_mass * (1 - pair.ex * pair.ex) * vt * vt;
    return 0;
}

/* --------------------------------------------------------------------------------------------------------- events */

/* Time until two spheres touch; infinity if they do not approach or pass by. */
static double time_to_sphere(const struct sphere *a, const struct sphere *b)
{
    double x[3], v[3];
    for (int k = 0; k < 3; ++k)
        x[k] = b->x[k] - a->x[k], v[k] = b->v[k] - a->v[k];
    const double reach = RADIUS[a->kind] + RADIUS[b->kind], approach = -dot(x, v);
    const double gap = dot(x, x) - reach * reach; /* of the squares */
    const double root = approach * approach - dot(v, v) * gap;
    if (approach <= 0 || root < 0) return INFINITY;
    return gap > 0 ? gap / (approach + sqrt(root)) : 0; /* this form does not cancel */
}

/* The next impact of sphere i. Others learn of it if it comes before theirs. */
static void predict(struct box *box, int i)
{
    struct sphere *a = &box->sphere[i];
    a->when = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const double far = a->v[k] > 0 ? SIDE - RADIUS[a->kind] : RADIUS[a->kind];
        const double t = a->v[k] == 0 ? INFINITY : box->now + fmax(0, (far - a->x[k]) / a->v[k]);
        if (t < a->when) a->when = t, a->partner = SPHERES + 2 * k + (a->v[k] > 0);
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
            box->sphere[i].x[k] += flight * box->sphere[i].v[k];

    double n[3] = {0};
    if (b)
        for (int k = 0; k < 3; ++k)
            n[k] = (b->x[k] - a->x[k]) / (RADIUS[a->kind] + RADIUS[b->kind]);
    else
        n[(partner - SPHERES) / 2] = partner % 2 == SPHERES % 2 ? -1 : 1;
    const double length = sqrt(dot(n, n)); /* 1 but for rounding, which would not conserve energy */
    for (int k = 0; k < 3; ++k)
        n[k] /= length;
    if (hit(box, a, b, n) < 0) return -1;

    predict(box, first);
    if (b) predict(box, partner);
    for (int i = 0; i < SPHERES; ++i) /* whoever was to meet one of them meets someone else */
        if (i != first && i != partner && (box->sphere[i].partner == first || (b && box->sphere[i].partner == partner)))
            predict(box, i);
    return 0;
}

/* ------------------------------------------------------------------------------------------------ box and accounts */

static void fill(struct box *box)
{
    uint64_t random = 2017;
    for (int i = 0; i < SPHERES; ++i) { /* on a grid of 6 x 6 x 6 */
        struct sphere *a = &box->sphere[i];
        a->kind = i % 2;
        for (int k = 0, cell = i; k < 3; ++k, cell /= 6) {
            a->x[k] = (cell % 6 + 0.5) * SIDE / 6;
            a->v[k] = SPEED * (2 * uniform(&random) - 1);
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
        *moving += 0.5 * mass(a->kind) * dot(a->v, a->v), *spinning += 0.5 * inertia(a->kind) * dot(a->w, a->w);
        for (int k = 0; k < 3; ++k)
            momentum[k] += mass(a->kind) * a->v[k] - box->wall_impulse[k] / SPHERES;
        for (int j = 0; j < i; ++j) {
            double x[3];
            for (int k = 0; k < 3; ++k)
                x[k] = box->sphere[j].x[k] - a->x[k];
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
    /* 5000 impacts, each good to some 1e-16 of what there is: 1e-12 holds if nothing but rounding is lost. */
    const int sane = energy_error < 1e-12 && momentum_error < 1e-12 && overlap < 1e-12;
    printf("energy, momentum and room add up to rounding: %s\n", sane ? "yes" : "NO");
    if (!sane) printf("off by %.1e, %.1e, %.1e\n", energy_error, momentum_error, overlap);
    restitute_table_destroy(table);
    restitute_material_destroy(rubber);
    return !sane;
}
