/* Scaling, omissions and units: the library, which solves dimensionless and leaves out what it can,
 * agrees with a naive Euler in SI units at equal elements and steps.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "si_euler.h"

#include "../support/random.h"
#include "../support/solve.h"

enum { scenes = 200, elements = 40 };

struct drawn {
    restitute_material *material;
    restitute_scene scene;
    struct si_scene si;
};

/* G_inf and up to four terms whose times a contact of some `time` feels; every third solid has a
 * dashpot. */
static void draw_solid(uint64_t *random, double modulus, double time, struct drawn *d)
{
    struct si_scene *s = &d->si;
    s->g_inf = modulus;
    s->eta = random_below(random, 3) == 0 ? modulus * time * random_log(random, 1e-2, 3) : 0;
    s->n_terms = random_below(random, si_terms + 1);
    double tau = time * 0.02;
    for (int k = 0; k < s->n_terms; k++) {
        tau *= random_log(random, 1.5, 6);
        s->tau[k] = tau;
        s->g[k] = modulus * random_log(random, 0.1, 10);
    }
    s->nu = random_in(random, 0, 0.5);
    restitute_error error;
    CHECK(restitute_material_prony(s->g_inf, s->eta, (size_t)s->n_terms, s->tau, s->g, s->nu, &d->material, &error) ==
              RESTITUTE_OK,
          "%s", error.message);
}

/* Spheres: a wall or a second sphere, inertias about the solid one, sometimes no rotation. */
static void draw_bodies(uint64_t *random, double radius, restitute_scene *scene)
{
    scene->radius1 = radius;
    scene->mass1 = 4.18879 * radius * radius * radius * random_log(random, 1e3, 1e4);
    scene->rotation_blocked = random_below(random, 6) == 0;
    if (random_below(random, 2)) scene->inertia1 = 0.4 * scene->mass1 * radius * radius * random_in(random, 0.6, 1.6);
    scene->deformable = random_below(random, 2) ? RESTITUTE_BOTH_BODIES_DEFORM : RESTITUTE_ONE_BODY_DEFORMS;
    if (random_below(random, 2)) return;
    scene->radius2 = radius * random_log(random, 0.2, 5);
    scene->mass2 = scene->mass1 * random_log(random, 0.1, 10);
    if (random_below(random, 2))
        scene->inertia2 = 0.4 * scene->mass2 * scene->radius2 * scene->radius2 * random_in(random, 0.6, 1.6);
}

static double mobility(double mass, double radius, double inertia, int blocked)
{
    if (isinf(mass)) return 0;
    if (blocked || isinf(radius)) return 1 / mass;
    return 1 / mass + radius * radius / (inertia > 0 ? inertia : 0.4 * mass * radius * radius);
}

/* Speeds so that psi is between 0.05 and 8, shared out to translation and spins, of either sign. */
static void draw_speeds(uint64_t *random, struct drawn *d)
{
    restitute_scene *scene = &d->scene;
    double sliding = scene->normal_speed * random_log(random, 0.05, 8);
    int kind = random_below(random, 8);
    scene->friction = kind == 0 ? 0 : kind == 1 ? INFINITY : random_log(random, 0.05, 1.5);
    if (kind > 1) sliding *= scene->friction * (2 - d->si.nu) / (2 - 2 * d->si.nu);
    if (random_below(random, 2)) sliding = -sliding;
    double share = random_in(random, 0, 1);
    scene->tangential_speed = share * sliding;
    scene->spin1 = (1 - share) * sliding / scene->radius1;
    if (isfinite(scene->radius2)) {
        scene->spin1 *= 0.5;
        scene->spin2 = 0.5 * (1 - share) * sliding / scene->radius2;
    }
    d->si.sliding = sliding;
}

static struct drawn draw(uint64_t *random)
{
    struct drawn d = {0};
    restitute_scene *scene = &d.scene;
    restitute_scene_init(scene);
    double radius = random_log(random, 1e-5, 1), modulus = random_log(random, 1e4, 1e11);
    draw_bodies(random, radius, scene);
    scene->normal_speed = random_log(random, 1e-3, 10);
    /* Hertz: contact time of some 3 (m^2/(G^2 R v))^(1/5) */
    double time = 3 * pow(scene->mass1 * scene->mass1 / (modulus * modulus * radius * scene->normal_speed), 0.2);
    draw_solid(random, modulus, time, &d);
    scene->material = d.material;
    draw_speeds(random, &d);

    double factor = scene->deformable == RESTITUTE_BOTH_BODIES_DEFORM ? 0.5 : 1;
    d.si.g_inf *= factor;
    d.si.eta *= factor;
    for (int k = 0; k < d.si.n_terms; k++)
        d.si.g[k] *= factor;
    d.si.mass = isinf(scene->mass2) ? scene->mass1 : scene->mass1 * scene->mass2 / (scene->mass1 + scene->mass2);
    d.si.radius = isinf(scene->radius2) ? radius : radius * scene->radius2 / (radius + scene->radius2);
    d.si.mobility = mobility(scene->mass1, radius, scene->inertia1, scene->rotation_blocked) +
                    mobility(scene->mass2, scene->radius2, scene->inertia2, scene->rotation_blocked);
    d.si.friction = scene->friction;
    d.si.speed = scene->normal_speed;
    return d;
}

/* Both do the same arithmetic in another order: rounding, 1e-16 in each of some 1e3 steps,
 * amplified by at most a few digits where elements switch from stick to slip. */
static const double rounding = 1e-10;

static void two_hundred_scenes_agree_at_equal_elements_and_steps(void **state)
{
    (void)state;
    uint64_t random = 2017;
    int gross = 0, partial = 0, none = 0, frictionless = 0;
    restitute_options options = as_told(elements, 0);
    options.tolerance = 1e-8; /* so that no term is merged */
    for (int i = 0; i < scenes; i++) {
        struct drawn d = draw(&random);
        struct restitute_result r = solve_scene(options, &d.scene).result;
        CHECK(r.terms_merged == 0, "scene %d merged %d terms", i, (int)r.terms_merged);
        d.si.spacing = r.element_spacing;
        d.si.step = r.time_step;
        struct si_result si = si_euler(&d.si, 2 * elements);
        CHECK(si.steps == r.steps, "scene %d: %ld steps, library %ld", i, si.steps, (long)r.steps);
        CHECK_NEAR(r.ez, fmin(1, si.ez), rounding, "scene %d", i);
        CHECK_NEAR(r.ex, si.ex, rounding, "scene %d", i);

        restitute_numbers numbers;
        restitute_numbers_init(&numbers);
        CHECK(restitute_scene_numbers(&d.scene, &numbers, NULL) == RESTITUTE_OK, "scene %d", i);
        frictionless += isinf(numbers.psi);
        none += numbers.psi == 0;
        partial += numbers.psi > 0 && numbers.psi <= 1;
        gross += numbers.psi > 1 && !isinf(numbers.psi);
        restitute_material_destroy(d.material);
    }
    print_message("gross slip first %d, partial slip %d, no slip %d, frictionless %d\n", gross, partial, none,
                  frictionless);
    CHECK(gross >= 40 && partial >= 40 && none >= 10 && frictionless >= 10, "%d %d %d %d", gross, partial, none,
          frictionless);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_hundred_scenes_agree_at_equal_elements_and_steps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
