/* The calls of contact.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/contact.h>

#include "caller.h"

enum { CONTACTS = 3, STATE = 64, STEPS = 20 };

static void law_says(const restitute_contact_law *law)
{
    double equilibrium, viscosity, times[8], moduli[8], bound;
    size_t terms;
    SHOW((double)restitute_contact_law_state_size(law), restitute_contact_law_hash(law) != 0);
    DONE(restitute_contact_law_series(law, &equilibrium, &viscosity, &terms, times, moduli, &bound, &error));
    SHOW(equilibrium, viscosity, (double)terms, times[0], moduli[0], bound);
}

void call_contact(void)
{
    const double up[3] = {0, 0, 1}, tilted[3] = {0, 0.6, 0.8};
    double step, scale, states[CONTACTS][STATE] = {{0}}, *places[] = {states[1], states[2]};
    int statuses[CONTACTS];
    restitute_contact_force forces[CONTACTS];
    restitute_contact_law *law;
    restitute_material *material = rubber();
    ONE(contact_law_options, options);
    ONE(contact_rates, rates);
    ONE(contact_details, details);
    MANY(contact_motion, motions, CONTACTS);
    options->details = 1;
    DONE(restitute_contact_law_create(material, options, &law, &error));
    law_says(law);
    DONE(restitute_contact_time_scale(law, 4e-3, 0.01, 0.2, &scale, &error));
    DONE(restitute_contact_time_step_limit(law, 4e-3, 0.01, 0.2, &step, &error));
    SHOW(scale, step);
    step /= 4;
    DONE(restitute_contact_rates_set(law, step, rates, &error));
    for (int i = 0; i < CONTACTS; i++) {
        motions[i].normal[2] = 1, motions[i].velocity[0] = 0.05 * i, motions[i].velocity[2] = 0.2;
        motions[i].spin = 10 * i, motions[i].inverse_mass = 100 * i, motions[i].inverse_tangential_mass = 350 * i;
        motions[i].radius = 0.01 + 0.001 * i, motions[i].friction = 0.3;
    }
    for (int s = 1; s <= STEPS; s++) {
        for (int i = 0; i < CONTACTS; i++)
            motions[i].overlap = 0.2 * step * s;
        if (s < STEPS)
            restitute_contact_step(law, rates, motions, states[0], forces, &error);
        else
            DONE(restitute_contact_step(law, rates, motions, states[0], forces, &error));
    }
    SHOW(forces[0].normal, forces[0].tangential[0]);
    for (int s = 1; s <= STEPS; s++) {
        for (int i = 1; i < CONTACTS; i++)
            motions[i].overlap = 0.2 * step * s;
        restitute_contact_step_many(law, rates, CONTACTS - 1, motions + 1, places, forces + 1, statuses,
                                    &error);
    }
    motions[1].overlap = motions[2].overlap += 0.2 * step;
    DONE(restitute_contact_step_many(law, rates, CONTACTS - 1, motions + 1, places, forces + 1, statuses,
                                     &error));
    SHOW(forces[1].normal, forces[1].tangential[0], forces[2].normal, forces[2].tangential[0]);
    DONE(restitute_contact_peek(law, up, states[2], forces, &error));
    DONE(restitute_contact_details_get(law, 0.012, states[2], details, &error));
    SHOW(forces[0].normal, details->contact_radius, details->stick_radius, details->work, details->stored);
    SHOW(details->friction, details->viscous, details->friction_power, details->viscous_power);
    DONE(restitute_contact_turn(law, up, tilted, states[2], &error));
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}
