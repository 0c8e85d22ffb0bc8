/* From a method's outcome to the public structs, in the caller's units.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "solver/output.h"

#include <math.h>

#include "base/method.h"
#include "base/sized.h"

RST_DEFAULTS(result, .method = "")
RST_DEFAULTS(ledger, 0)
RST_DEFAULTS(history, 0)

/* Dimensionless: U' is psi at first touch, and 1 without slip or friction. */
static struct rst_units own_units(const struct rst_problem *problem)
{
    return (struct rst_units){.time = 1,
                              .length_z = 1,
                              .length_x = 1,
                              .force = 1,
                              .velocity = 1,
                              .shear_velocity = problem->shear_speed,
                              .shear_force = 1};
}

struct rst_units rst_units_of(const struct rst_problem *problem, const restitute_scene *scene,
                              const restitute_numbers *numbers)
{
    if (!scene) return own_units(problem);
    double nu = restitute_material_poisson_ratio(scene->material);
    double sliding = fabs(rst_sliding_speed(scene));
    /* q of the kernel is in units of mu f; mu is eliminated by psi (22), so that mu = infinity is
     * no exception */
    double shear_force = 2 * numbers->mass * (1 - nu) / (2 - nu) * sliding / problem->shear_speed / numbers->time;
    return (struct rst_units){.time = numbers->time,
                              .length_z = numbers->length_z,
                              .length_x = numbers->length_x,
                              .force = numbers->force,
                              .velocity = scene->normal_speed,
                              .shear_velocity = sliding,
                              .shear_force = problem->mode == RST_FRICTIONLESS ? 0 : shear_force};
}

static double clamp(double value, double low, double high)
{
    return fmin(high, fmax(low, value));
}

/* e_z in [0, 1] and |e_x| <= 1 follow from the energy (theory.md, 8); the method's error may be on
 * the wrong side. */
void rst_write_result(const struct rst_problem *problem, const struct rst_outcome *outcome, int64_t terms_merged,
                      double merging_bound, restitute_result *result)
{
    const struct rst_units *units = &problem->units;
    result->ez = clamp(-outcome->velocity, 0, 1) + 0.0; /* + 0.0: no negative zero */
    result->ex = clamp(-outcome->shear_velocity / problem->shear_speed, -1, 1) + 0.0;
    result->error_ez = outcome->error_ez + merging_bound;
    result->error_ex =
        outcome->error_ex + problem->slip_bound + (problem->mode == RST_FRICTIONLESS ? 0 : merging_bound);
    result->contact_time = outcome->contact_time * units->time;
    result->max_indentation = outcome->max_indentation * units->length_z;
    result->max_contact_radius = outcome->max_contact_radius * units->length_x;
    result->max_normal_force = rst_mass_factor() * outcome->max_normal_force * units->force;
    result->merging_bound = merging_bound;
    result->terms_merged = terms_merged;
    result->elements = outcome->elements;
    result->steps = outcome->steps;
    result->element_spacing = outcome->spacing * units->length_x;
    result->time_step = outcome->step * units->time;
    result->work = (double)outcome->updates / problem->method->updates_per_second;
    result->method = problem->method->name;
}

void rst_write_ledger(const struct rst_problem *problem, const struct rst_outcome *outcome, restitute_ledger *ledger)
{
    const struct rst_ledger *l = &outcome->ledger;
    double energy_x = problem->shear_speed * problem->shear_speed;
    ledger->rebound_z = outcome->velocity * outcome->velocity;
    ledger->viscous_z = l->viscous_z;
    ledger->left_z = l->left_z;
    ledger->residual_z = 1 - ledger->rebound_z - ledger->viscous_z - ledger->left_z;
    ledger->rebound_x = outcome->shear_velocity * outcome->shear_velocity / energy_x;
    ledger->friction_x = l->friction_x / energy_x;
    ledger->viscous_x = l->viscous_x / energy_x;
    ledger->left_x = l->left_x / energy_x;
    ledger->residual_x = 1 - ledger->rebound_x - ledger->friction_x - ledger->viscous_x - ledger->left_x;
}

void rst_write_history(const struct rst_history *samples, const struct rst_units *units, restitute_history *history)
{
    history->count = samples->count;
    for (size_t i = 0; i < samples->count; i++) {
        const struct rst_sample *s = &samples->samples[i];
        if (history->time) history->time[i] = s->time * units->time;
        if (history->indentation) history->indentation[i] = s->indentation * units->length_z;
        if (history->contact_radius) history->contact_radius[i] = s->contact_radius * units->length_x;
        if (history->stick_radius) history->stick_radius[i] = s->stick_radius * units->length_x;
        if (history->normal_force) history->normal_force[i] = rst_mass_factor() * s->normal_force * units->force;
        if (history->tangential_force)
            history->tangential_force[i] = rst_mass_factor() * s->shear_force * units->shear_force;
        if (history->normal_velocity) history->normal_velocity[i] = s->velocity * units->velocity;
        if (history->tangential_velocity) history->tangential_velocity[i] = s->shear_velocity * units->shear_velocity;
    }
}
