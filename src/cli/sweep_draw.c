/* Impacts drawn at random.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_draw.h"

#include <math.h>

#include "random.h"

static const double pi = 3.14159265358979323846;

static void give(struct values *values, enum field field, double number)
{
    values->given[field] = true;
    values->number[field] = number;
}

/* Two bodies as one: 1/m, 1/R and the compliances add. */
struct effective {
    double mass, radius, modulus; /* of the solid over that of the material: 1/2 if both bodies are of it */
};

/* A solid or hollow sphere: J = k m R^2. */
static void draw_sphere(uint64_t *state, enum field radius, enum field mass, enum field inertia, double k,
                        struct values *values)
{
    const double r = random_log(state, 1e-4, 0.1), density = random_log(state, 500, 1e4);
    const double m = 4.0 / 3.0 * pi * r * r * r * density;
    give(values, radius, r);
    give(values, mass, m);
    give(values, inertia, k * m * r * r);
}

/* k of both spheres makes chi = (1-nu)/(2-nu) (1 + 1/k) (22). */
static struct effective draw_bodies(uint64_t *state, double chi, double nu, struct values *values)
{
    const double k = 1 / (chi * (2 - nu) / (1 - nu) - 1), *number = values->number;
    draw_sphere(state, FIELD_RADIUS1, FIELD_MASS1, FIELD_INERTIA1, k, values);
    if (random_below(state, 2) == 0) return (struct effective){number[FIELD_MASS1], number[FIELD_RADIUS1], 1};
    draw_sphere(state, FIELD_RADIUS2, FIELD_MASS2, FIELD_INERTIA2, k, values);
    values->deformable = random_below(state, 2) ? RESTITUTE_BOTH_BODIES_DEFORM : RESTITUTE_ONE_BODY_DEFORMS;
    return (struct effective){1 / (1 / number[FIELD_MASS1] + 1 / number[FIELD_MASS2]),
                              1 / (1 / number[FIELD_RADIUS1] + 1 / number[FIELD_RADIUS2]),
                              values->deformable == RESTITUTE_BOTH_BODIES_DEFORM ? 0.5 : 1};
}

/* eta from delta1 (23), tau/T or nothing; a_el and T = a_el^2/(R v_z0) from (24). */
static void choose_solid(const struct sweep_numbers *numbers, const struct effective *e, double modulus, double nu,
                         double speed, struct values *values)
{
    const double g = e->modulus * modulus;
    const double a_el = pow(15 * e->mass * speed * speed * e->radius * e->radius * (1 - nu) / (32 * g), 0.2);
    give(values, FIELD_POISSON, nu);
    give(values, FIELD_MODULUS1, numbers->relaxation > 0 ? 0 : modulus);
    if (numbers->relaxation > 0) {
        give(values, FIELD_MODULUS2, modulus);
        give(values, FIELD_VISCOSITY, modulus * numbers->relaxation * a_el * a_el / (e->radius * speed));
    } else if (numbers->delta1 > 0) {
        give(values, FIELD_VISCOSITY, numbers->delta1 / sqrt(a_el / (g * e->mass * (1 - nu))) / e->modulus);
        if (numbers->gamma > 0) give(values, FIELD_MODULUS2, modulus / numbers->gamma);
    }
}

void sweep_draw(uint64_t *state, const struct sweep_numbers *numbers, struct values *values)
{
    *values = values_none();
    /* 2/5 <= k <= 2/3 of spheres, solid to shells, within these at chi = 7/6 */
    const double nu = random_in(state, 0.13, 0.5), modulus = random_log(state, 1e6, 1e11);
    const double speed = random_log(state, 1e-4, 0.1), friction = random_log(state, 0.05, 1);
    const double share = random_in(state, 0, 1);
    const struct effective e = draw_bodies(state, numbers->chi, nu, values);
    choose_solid(numbers, &e, modulus, nu, speed, values);
    /* (22) solved for the sliding speed, of which a share is the centre's and the rest the spin's */
    const double psi = numbers->psi > 0 ? numbers->psi : 1;
    const double sliding = psi * friction * speed * (2 - nu) / (2 - 2 * nu);
    give(values, FIELD_FRICTION, numbers->psi > 0 ? friction : INFINITY);
    give(values, FIELD_SPEED, hypot(speed, share * sliding));
    give(values, FIELD_ANGLE, atan2(share * sliding, speed) * 180 / pi);
    give(values, FIELD_SPIN1, (1 - share) * sliding / values->number[FIELD_RADIUS1]);
}
