/* The sixteen solids that tables are measured on.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_TABLE_SOLIDS_H
#define TEST_TABLE_SOLIDS_H
#include <math.h>
#include <restitute/table.h>
#include <stdio.h>
#include <stdlib.h>

#include "prepared.h"

enum { table_solids = 16 };

struct table_solid {
    const char *name;
    double nu;
    double gamma; /* of a standard solid; G1 = 1 MPa */
    int kind;     /* 0 elastic, 1 standard, 2 Kelvin-Voigt, 3 Maxwell, 4 two terms, 5 polyisobutylene */
};

static const struct table_solid table_solid[table_solids] = {
    {"elastic", 0.3, 0, 0},         {"elastic", 0.5, 0, 0},
    {"standard", 0.3, 0.01, 1},     {"standard", 0.5, 0.01, 1},
    {"standard", 0.3, 0.0825, 1},   {"standard", 0.5, 0.0825, 1},
    {"standard", 0.3, 1, 1},        {"standard", 0.5, 1, 1},
    {"standard", 0.3, 10, 1},       {"standard", 0.5, 10, 1},
    {"Kelvin-Voigt", 0.3, 0, 2},    {"Kelvin-Voigt", 0.5, 0, 2},
    {"Maxwell", 0.5, 0, 3},           {"two terms", 0.3, 0, 4},
    {"two terms", 0.5, 0, 4},       {"polyisobutylene", 0.5, 0, 5},
};

/* Relaxation times (s) and moduli (Pa) of polyisobutylene are read from `path`, lines
 * tau_s,G_Pa. */
static inline int table_solid_pib(const char *path, restitute_material **m, restitute_error *e)
{
    double tau[64], g[64], a, b;
    size_t n = 0;
    char line[200];
    FILE *f = fopen(path, "r");
    if (!f) return -1;
    while (fgets(line, sizeof line, f) && n < 64)
        if (sscanf(line, "%lf,%lf", &a, &b) == 2) tau[n] = a, g[n++] = b;
    fclose(f);
    return restitute_material_prony(0, 0, n, tau, g, 0.5, m, e);
}

/* A ball of 5 mm and 4 g. At 0.1 m/s delta1 is 1, or a relaxation time is like the impact's. With
 * gamma = 0.01 delta1 is 2: over six decades of speed it then passes 4.2, where e_x turns
 * sharply. */
static inline restitute_scene table_solid_scene(const struct table_solid *s, const char *pib, restitute_material **m)
{
    PREPARED(scene, scene);
    PREPARED(numbers, n);
    restitute_error e = {0};
    restitute_material *elastic = NULL;
    restitute_material_elastic(1e6, s->nu, &elastic, &e);
    scene.material = elastic;
    scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3, scene.normal_speed = 0.1;
    restitute_scene_numbers(&scene, &n, &e);
    const double delta1 = s->kind == 1 && s->gamma < 0.05 ? 2 : 1, eta = delta1 * sqrt(32.0 / 15) * 1e6 * n.time;
    int status = 0;
    *m = elastic;
    if (s->kind == 1) status = restitute_material_standard_solid(1e6, 1e6 / s->gamma, eta, s->nu, m, &e);
    if (s->kind == 2) status = restitute_material_kelvin_voigt(1e6, eta, s->nu, m, &e);
    if (s->kind == 3) status = restitute_material_maxwell(1e6, 0.3 * 1e6 * n.time, s->nu, m, &e);
    const double tau[2] = {0.1 * n.time, 2 * n.time}, g[2] = {2e6, 1e6};
    if (s->kind == 4) status = restitute_material_prony(1e6, 0, 2, tau, g, s->nu, m, &e);
    if (s->kind == 5) status = table_solid_pib(pib, m, &e);
    if (status < 0) fprintf(stderr, "%s: %s\n", s->name, e.message), exit(1);
    if (*m != elastic) restitute_material_destroy(elastic);
    scene.material = *m;
    return scene;
}
/* The same ball of a standard solid, delta1 at a speed. Returns the material, the caller's. */
static inline restitute_material *table_solid_standard(restitute_scene *scene, double nu, double gamma, double delta1,
                                                       double speed)
{
    PREPARED(numbers, n);
    restitute_error e = {0};
    restitute_material *m = NULL;
    restitute_material_elastic(1e6, nu, &m, &e);
    restitute_scene_init(scene);
    scene->material = m;
    scene->radius1 = 0.005, scene->mass1 = 0.004, scene->friction = 0.3, scene->normal_speed = speed;
    restitute_scene_numbers(scene, &n, &e);
    restitute_material_destroy(m);
    restitute_material_standard_solid(1e6, 1e6 / gamma, delta1 * sqrt(32.0 / 15) * 1e6 * n.time, nu, &m, &e);
    scene->material = m;
    return m;
}

#endif
