/* One impact as a DEM code computes it: velocity Verlet with the contact law, in the units of an
 * impact (docs/theory.md).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CONTACT_H
#define TEST_CONTACT_H

#include <restitute/contact.h>
#include <stdlib.h>
#include <string.h>

#include "solve.h"

enum { most_state = 1024 };

/* The scene of a dimensionless impact: radius and reference modulus 1, speed 1, largest elastic
 * overlap `depth`. */
static const double depth = 1e-4, impact_friction = 0.3, impact_nu = 0.5;

struct dem_impact {
    restitute_material *material;
    double mass, tangential_mass; /* of the contact point */
    double psi;
    double time_step;
    double phase; /* of the first step before touch, in [0, 1) */
    double angle; /* of the sliding direction in the tangential plane */
    int elements, details;
};

struct dem_result {
    int status;
    double ez, ex, across;           /* across: velocity across the sliding direction over the incoming one */
    double work;                     /* of the contact on the sphere, over the kinetic energy */
    restitute_contact_details spent; /* with details: in units of the kinetic energy */
    long steps;
};

/* The material of an impact: moduli in units of G_r = 1, times in units of T = depth. */
static inline restitute_material *dem_material(double g_inf, double theta, size_t n, const double *tau, const double *g)
{
    double times[8];
    restitute_material *material;
    restitute_error error;
    for (size_t k = 0; k < n; k++)
        times[k] = tau[k] * depth;
    CHECK(restitute_material_prony(g_inf, theta * depth, n, times, g, impact_nu, &material, &error) == 0, "%s",
          error.message);
    return material;
}

static inline struct dem_impact dem_impact_of(restitute_material *material, double chi, double psi)
{
    const double mass = 32 * depth * depth * sqrt(depth) / (15 * (1 - impact_nu));
    return (struct dem_impact){.material = material,
                               .mass = mass,
                               .tangential_mass = mass * (1 - impact_nu) / ((2 - impact_nu) * chi),
                               .psi = psi,
                               .elements = 8};
}

static inline restitute_contact_law *dem_law(const struct dem_impact *impact)
{
    restitute_contact_law *law;
    PREPARED(contact_law_options, options);
    restitute_error error;
    options.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    options.elements = impact->elements;
    options.details = impact->details;
    CHECK(restitute_contact_law_create(impact->material, &options, &law, &error) == 0, "%s", error.message);
    return law;
}

/* The contact time that the limit of the law names, at speed 1. */
static inline double dem_contact_time(const struct dem_impact *impact)
{
    restitute_contact_law *law = dem_law(impact);
    double limit;
    restitute_error error;
    CHECK(restitute_contact_time_step_limit(law, impact->mass, 1, 1, &limit, &error) == 0, "%s", error.message);
    restitute_contact_law_destroy(law);
    return 50 * limit;
}

static inline struct dem_result dem_collide(const struct dem_impact *impact)
{
    restitute_contact_law *law = dem_law(impact);
    PREPARED(contact_rates, rates);
    PREPARED(contact_motion, motion);
    restitute_contact_force force = {0};
    restitute_error error;
    double state[most_state] = {0};
    const double h = impact->time_step,
                 incoming = impact->psi * impact_friction * (2 - impact_nu) / (2 - 2 * impact_nu);
    const double along[2] = {cos(impact->angle), sin(impact->angle)};
    double v[3] = {incoming * along[0], incoming * along[1], 1}, half[3];
    const double mass[3] = {impact->tangential_mass, impact->tangential_mass, impact->mass};
    struct dem_result result = {0};
    CHECK(restitute_contact_rates_set(law, h, &rates, &error) == 0, "%s", error.message);
    motion.overlap = -impact->phase * h;
    motion.inverse_mass = 1 / impact->mass;
    motion.inverse_tangential_mass = 1 / impact->tangential_mass;
    motion.radius = 1;
    motion.friction = impact_friction;
    for (; result.steps < 1000000; result.steps++) {
        const double before[3] = {force.tangential[0], force.tangential[1], -force.normal};
        for (int i = 0; i < 3; i++)
            half[i] = v[i] + h / (2 * mass[i]) * before[i];
        motion.overlap += h * half[2];
        memcpy(motion.velocity, half, sizeof half);
        if (motion.overlap <= 0 && half[2] < 0) break;
        result.status = restitute_contact_step(law, &rates, &motion, state, &force, &error);
        if (result.status) break;
        const double after[3] = {force.tangential[0], force.tangential[1], -force.normal};
        for (int i = 0; i < 3; i++) {
            v[i] = half[i] + h / (2 * mass[i]) * after[i];
            result.work += 0.5 * (before[i] + after[i]) * half[i] * h;
        }
        if (!(force.normal > 0) && v[2] < 0) break;
    }
    if (motion.overlap <= 0)
        for (int i = 0; i < 3; i++)
            v[i] = half[i];
    result.ez = -v[2];
    if (incoming > 0) {
        result.ex = -(v[0] * along[0] + v[1] * along[1]) / incoming;
        result.across = (v[1] * along[0] - v[0] * along[1]) / incoming;
    }
    const double energy = 0.5 * impact->mass + 0.5 * impact->tangential_mass * incoming * incoming;
    result.work /= energy;
    if (impact->details) {
        restitute_contact_details_init(&result.spent);
        CHECK(restitute_contact_details_get(law, 1, state, &result.spent, &error) == 0, "%s", error.message);
        result.spent.work /= energy, result.spent.stored /= energy;
        result.spent.friction /= energy, result.spent.viscous /= energy;
    }
    restitute_contact_law_destroy(law);
    return result;
}

#endif
