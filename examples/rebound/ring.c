/* SPDX-License-Identifier: BSD-3-Clause
 * Saturn's rings with REBOUND: ice boulders in a patch in orbit, whose impacts take their
 * restitution from a table. REBOUND gets it as a function of speed, from its callback
 * `coefficient_of_restitution`.
 *
 *   ring [ORBITS]          default 40, some ten seconds
 *
 *   check      two boulders hit each other at many speeds and angles; the speed after over before is the table's ez to
 *              rounding
 *   ring       the boulders settle where the impacts take as much energy as the shear of the orbits brings
 *
 * Exit status 1 if the first fails. */
#include <math.h>
#include <rebound.h>
#include <restitute/table.h>
#include <stdio.h>
#include <stdlib.h>

static const double RADIUS = 1, DENSITY = 900, TURN = 1.3143527e-4; /* m, kg/m^3, 1/s at 1.3e8 m from Saturn */
static const double PATCH = 50, OPTICAL_DEPTH = 0.3;                /* m; area of the boulders over that of the patch */

struct impacts {
    const restitute_table *table;
    double count, sum_ez, energy, energy_ez2; /* energy: sum of v^2 */
};

/* The callback of REBOUND. Its speed is negative for approaching bodies. The pointer `extras` of
 * the simulation is our table. */
static double restitution(const struct reb_simulation *const r, double v)
{
    struct impacts *impacts = r->extras;
    double ez;
    if (restitute_table_pair(impacts->table, NULL, fabs(v), 0, &ez, NULL, NULL) < 0) return NAN; /* v is not finite */
    impacts->count += 1, impacts->sum_ez += ez;
    impacts->energy += v * v, impacts->energy_ez2 += v * v * ez * ez;
    return ez;
}

static double boulder_mass(void)
{
    return 4.0 / 3 * acos(-1.0) * DENSITY * RADIUS * RADIUS * RADIUS;
}

/* REBOUND's spheres have no spin and its callback no tangential part: a table of ez alone, without
 * friction. */
static int build_table(restitute_table **table, restitute_error *error)
{
    restitute_material *ice = NULL;
    restitute_scene scene;
    restitute_table_options options;
    /* E = 9 GPa; with this viscosity ez falls to 0.6 at some mm/s, as for frosty ice */
    int status = restitute_material_kelvin_voigt(3.4e9, 1e7, 0.33, &ice, error);
    restitute_scene_init(&scene);
    scene.material = ice, scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    scene.radius1 = scene.radius2 = RADIUS, scene.mass1 = scene.mass2 = boulder_mass();
    restitute_table_options_init(&options);
    options.speed[0] = 1e-7, options.speed[1] = 1; /* m/s */
    if (status >= 0) status = restitute_table_build(&scene, &options, table, error);
    restitute_material_destroy(ice); /* the table no longer needs it */
    return status;
}

static struct reb_simulation *simulation(struct impacts *impacts)
{
    struct reb_simulation *r = reb_simulation_create();
    r->gravity = REB_GRAVITY_NONE;
    r->collision_resolve = reb_collision_resolve_hardsphere;
    r->coefficient_of_restitution = restitution;
    r->extras = impacts;
    r->rand_seed = 2017;
    return r;
}

/* ---- two spheres */

/* Component along the line of two spheres at which the second leaves the first. */
static double opening(const struct reb_particle *a, const struct reb_particle *b, double vx, double vy, double vz)
{
    const double x = b->x - a->x, y = b->y - a->y, z = b->z - a->z;
    return (x * vx + y * vy + z * vz) / sqrt(x * x + y * y + z * z);
}

/* Two boulders touch, approach at the speed v along their line, in any direction, and slide at v
 * past each other. Sets `before` and `after` to the speeds along the line where REBOUND saw them
 * collide. */
static void collide_pair(struct impacts *impacts, double v, double longitude, double height, double *before,
                         double *after)
{
    struct reb_simulation *r = simulation(impacts);
    const double flat = sqrt(1 - height * height);
    const double n[3] = {flat * cos(longitude), flat * sin(longitude), height},
                 t[3] = {-sin(longitude), cos(longitude), 0};
    struct reb_particle a = {.m = boulder_mass(), .r = RADIUS}, b = a;
    b.x = 2 * RADIUS * n[0], b.y = 2 * RADIUS * n[1], b.z = 2 * RADIUS * n[2];
    a.vx = v * (n[0] + t[0]), a.vy = v * (n[1] + t[1]), a.vz = v * (n[2] + t[2]);
    reb_simulation_add(r, a);
    reb_simulation_add(r, b);
    reb_simulation_set_integrator(r, "leapfrog");
    r->collision = REB_COLLISION_DIRECT;
    r->dt = 1e-10 * RADIUS / v; /* they overlap by little, but by more than rounding */
    reb_simulation_steps(r, 1); /* moves them, then lets them collide: the positions are those of the impact */
    const struct reb_particle *p = r->particles;
    *before = -opening(&p[0], &p[1], -a.vx, -a.vy, -a.vz);
    *after = opening(&p[0], &p[1], p[1].vx - p[0].vx, p[1].vy - p[0].vy, p[1].vz - p[0].vz);
    reb_simulation_free(r);
}

static int check(const restitute_table *table)
{
    struct impacts impacts = {.table = table};
    double worst = 0;
    const int pairs = 600;
    for (int i = 0; i < pairs; ++i) {
        double before, after, ez;
        collide_pair(&impacts, 1e-6 * pow(10, i * 6.0 / pairs), 0.1 * i, sin(i), &before, &after);
        if (restitute_table_pair(table, NULL, before, 0, &ez, NULL, NULL) < 0) return -1;
        worst = fmax(worst, fabs(after / before - ez));
    }
    /* REBOUND rotates the line to an axis and back, by two angles: about ten roundings of 1e-16. */
    const int good = impacts.count == pairs && worst < 1e-14;
    printf("%d pairs: speed after over before is the table's ez to rounding: %s\n", pairs, good ? "yes" : "NO");
    if (!good) printf("%.0f impacts, off by up to %.1e\n", impacts.count, worst);
    return good ? 0 : -1;
}

/* ---- ring */

static struct reb_simulation *ring(struct impacts *impacts)
{
    struct reb_simulation *r = simulation(impacts);
    const int boulders = (int)(OPTICAL_DEPTH * PATCH * PATCH / (acos(-1.0) * RADIUS * RADIUS));
    reb_simulation_set_integrator(r, "sei"); /* of a patch that turns */
    r->OMEGA = TURN;
    r->dt = 1e-3 * 2 * acos(-1.0) / TURN;
    r->boundary = REB_BOUNDARY_SHEAR;
    r->collision = REB_COLLISION_TREE;
    r->root_size = PATCH;
    r->N_ghost_x = r->N_ghost_y = 1;
    for (int i = 0; i < boulders; ++i) {
        struct reb_particle p = {.m = boulder_mass(), .r = RADIUS};
        p.x = reb_random_uniform(r, -PATCH / 2, PATCH / 2);
        p.y = reb_random_uniform(r, -PATCH / 2, PATCH / 2);
        p.z = reb_random_normal(r, 4);
        p.vy = -1.5 * p.x * TURN; /* Kepler's shear */
        reb_simulation_add(r, p);
    }
    return r;
}

/* Rms of a component of the velocities beside the shear, over TURN RADIUS. */
static double dispersion(const struct reb_simulation *r)
{
    double sum = 0;
    for (size_t i = 0; i < r->N; ++i) {
        const struct reb_particle *p = &r->particles[i];
        const double vy = p->vy + 1.5 * p->x * r->OMEGA;
        sum += p->vx * p->vx + vy * vy + p->vz * p->vz;
    }
    return sqrt(sum / (3 * (double)r->N)) / (r->OMEGA * RADIUS);
}

static void settle(const restitute_table *table, int orbits)
{
    struct impacts impacts = {.table = table};
    struct reb_simulation *r = ring(&impacts);
    printf("%zu boulders\n%6s %12s %8s %8s\n", r->N, "orbits", "dispersion", "mean ez", "rms ez");
    for (int orbit = 1; orbit <= orbits; ++orbit) {
        impacts = (struct impacts){.table = table};
        reb_simulation_integrate(r, orbit * 2 * acos(-1.0) / TURN);
        if (orbit != 1 && orbit % 5 && orbit != orbits) continue;
        const double mean = impacts.sum_ez / impacts.count, rms = sqrt(impacts.energy_ez2 / impacts.energy);
        printf("%6d %12.2f %8.3f %8.3f\n", orbit, dispersion(r), mean, rms); /* rms: by energy */
    }
    reb_simulation_free(r);
}

int main(int argc, char **argv)
{
    const int orbits = argc > 1 ? atoi(argv[1]) : 40;
    restitute_table *table = NULL;
    restitute_error error = {0};
    if (argc > 2 || orbits < 1) {
        fprintf(stderr, "usage: ring [ORBITS], at least 1\n");
        return 2;
    }
    if (build_table(&table, &error) < 0) {
        fprintf(stderr, "ring: %s\n", error.message);
        return 1;
    }
    const int status = check(table);
    settle(table, orbits);
    restitute_table_destroy(table);
    return status ? 1 : 0;
}
