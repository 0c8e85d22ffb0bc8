/* Random impacts over the domain: as they are met in use, wide, and at the ends of all ranges.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_DOMAIN_H
#define TEST_DOMAIN_H

#include "random.h"
#include "solve.h"

enum reach { USUAL, WIDE, EXTREME, REACHES };

/* A scene or a dimensionless impact, on a material that free_drawn destroys. */
struct drawn {
    restitute_material *material;
    int is_scene;
    restitute_scene scene;
    restitute_impact impact;
    char text[240];
};

/* Within 1/extent to extent; of extreme ones half at the ends. */
static inline double draw_number(uint64_t *random, enum reach reach, double extent)
{
    const int end = reach == EXTREME ? random_below(random, 4) : 3;
    const double between = random_log(random, 1 / extent, extent);
    return end == 0 ? 1 / extent : end == 1 ? extent : between;
}

/* Of moduli `scale` and times `time`. Every fourth solid has no equilibrium modulus, every third a
 * dashpot. */
static inline restitute_material *draw_material(uint64_t *random, enum reach reach, double scale, double time)
{
    static const double moduli[] = {10, 1e6, 1e30}, times[] = {1e3, 1e12, 1e30}, dashpots[] = {10, 10, 1e60};
    double tau[4], g[4];
    const int terms = random_below(random, 5), flows = terms > 0 && random_below(random, 4) == 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = time * draw_number(random, reach, times[reach]) * (1 + 1e-9 * k); /* no two alike */
        g[k] = scale * draw_number(random, reach, moduli[reach]);
    }
    const double g_inf =
        scale * draw_number(random, reach, moduli[reach] > 10 && reach != EXTREME ? 10 : moduli[reach]);
    const double eta = scale * time * draw_number(random, reach, dashpots[reach]);
    const double nu = random_below(random, 2) ? 0.5 : random_in(random, 0, 0.5);
    restitute_material *material = NULL;
    restitute_material_prony(flows ? 0 : g_inf, random_below(random, 3) ? 0 : eta, (size_t)terms, tau, g, nu, &material,
                             NULL); /* 1e30 (1 + 1e-9) is refused */
    return material;
}

static inline void draw_scene(uint64_t *random, enum reach reach, restitute_scene *s)
{
    static const double sizes[] = {30, 1e6, 1e50};
    const double extent = sizes[reach];
    restitute_scene_init(s);
    s->radius1 = draw_number(random, reach, extent);
    s->mass1 = draw_number(random, reach, extent);
    if (random_below(random, 2)) s->radius2 = draw_number(random, reach, extent);
    if (random_below(random, 2)) s->mass2 = draw_number(random, reach, extent);
    if (random_below(random, 2)) s->deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    s->normal_speed = draw_number(random, reach, extent);
    const double sliding = random_log(random, 1e-3, 3), any = draw_number(random, reach, extent);
    s->tangential_speed = random_below(random, 2) ? sliding * s->normal_speed : random_below(random, 4) ? -any : 0;
    if (random_below(random, 3) == 0) s->spin1 = s->normal_speed * random_in(random, -3, 3) / s->radius1;
    const double friction = reach == EXTREME ? random_log(random, 1e-30, 1e300) : random_log(random, 0.01, 2);
    const int kind = random_below(random, 5);
    s->friction = kind == 0 ? 0 : kind == 1 ? INFINITY : friction;
    s->rotation_blocked = random_below(random, 6) == 0;
    if (random_below(random, 4) == 0) s->wave_density = draw_number(random, reach, extent);
}

static inline void draw_impact(uint64_t *random, enum reach reach, restitute_impact *i)
{
    static const double chi[] = {4, 20, 1000}, psi[][2] = {{1e-3, 10}, {1e-3, 10}, {1e-13, 1e12}};
    static const double delta1[][2] = {{1e-3, 1e2}, {1e-9, 1e4}, {1e-60, 1e12}}, gamma[] = {1e3, 1e9, 1e60};
    restitute_impact_init(i);
    i->chi = random_below(random, 5) ? random_log(random, 1.0 / 3, 4) : chi[reach];
    i->psi = random_below(random, 6) ? random_log(random, psi[reach][0], psi[reach][1]) : 0;
    i->delta1 = random_below(random, 6) ? random_log(random, delta1[reach][0], delta1[reach][1]) : 0;
    i->gamma = random_log(random, 1 / gamma[reach], gamma[reach]);
    if (random_below(random, 5) == 0) i->gamma = random_below(random, 2) ? 0 : INFINITY;
}

static inline struct drawn draw_case(uint64_t *random, enum reach reach, int number)
{
    struct drawn d = {.is_scene = random_below(random, 2)};
    const int si = d.is_scene && reach == USUAL;
    d.material = draw_material(random, reach, si ? 1e6 : 1, si ? 1e-4 : 1);
    draw_scene(random, reach, &d.scene);
    draw_impact(random, reach, &d.impact);
    d.scene.material = d.material;
    if (random_below(random, 2)) d.impact.material = d.material;
    if (!d.material) d.is_scene = 0;
    if (d.is_scene)
        snprintf(d.text, sizeof d.text, "case %d: R %g %g, m %g %g, mu %g, v %.17g %.17g, spin %g", number,
                 d.scene.radius1, d.scene.radius2, d.scene.mass1, d.scene.mass2, d.scene.friction, d.scene.normal_speed,
                 d.scene.tangential_speed, d.scene.spin1);
    else
        snprintf(d.text, sizeof d.text, "case %d: chi %.17g, psi %.17g, delta1 %.17g, gamma %.17g%s", number,
                 d.impact.chi, d.impact.psi, d.impact.delta1, d.impact.gamma, d.impact.material ? ", a solid" : "");
    return d;
}

#endif
