/* A contact that is driven along a prescribed path, with the work that this takes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_DRIVE_H
#define TEST_DRIVE_H

#include "contact.h"

struct drive {
    restitute_contact_law *law;
    restitute_contact_rates rates;
    restitute_contact_motion motion;
    restitute_contact_force force;
    double state[most_state];
    double work; /* done on the contact so far, by the trapezoid, J */
    /* what that may be off by: where a force bends once in a step, 1/8 of its second difference
     * times the way */
    double trapezoid;
    restitute_contact_force change; /* of the force in the last step */
    double largest_force;           /* so far, N */
};

enum { DETAILS = 1, SLIP_CYCLES = 2 };

static inline restitute_contact_law *law_of(const restitute_material *material, int elements, int with)
{
    restitute_contact_law *law;
    PREPARED(contact_law_options, options);
    restitute_error error;
    options.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    options.elements = elements;
    options.details = with & DETAILS;
    options.slip_cycles = with & SLIP_CYCLES;
    CHECK(restitute_contact_law_create(material, &options, &law, &error) == 0, "%s", error.message);
    return law;
}

static inline void drive_set_step(struct drive *drive, double step)
{
    restitute_error error;
    CHECK(restitute_contact_rates_set(drive->law, step, &drive->rates, &error) == 0, "%s", error.message);
}

/* Radius 1 m; the path prescribes the velocities. */
static inline struct drive drive_of(restitute_contact_law *law, double step, double friction)
{
    struct drive drive = {.law = law};
    restitute_contact_rates_init(&drive.rates);
    drive_set_step(&drive, step);
    restitute_contact_motion_init(&drive.motion);
    drive.motion.radius = 1;
    drive.motion.friction = friction;
    return drive;
}

/* One step: approach by `approach`, slide by (x, y); the normal is z. */
static inline void drive_by(struct drive *d, double approach, double x, double y)
{
    restitute_error error;
    const restitute_contact_force before = d->force;
    restitute_contact_motion *m = &d->motion;
    m->overlap += approach;
    m->velocity[0] = x / d->rates.step, m->velocity[1] = y / d->rates.step, m->velocity[2] = approach / d->rates.step;
    CHECK(restitute_contact_step(d->law, &d->rates, m, d->state, &d->force, &error) == 0, "%s", error.message);
    CHECK(isfinite(d->force.normal) && d->force.normal >= 0, "normal force %g", d->force.normal);
    CHECK(isfinite(d->force.tangential[0]) && isfinite(d->force.tangential[1]), "tangential force");
    d->work +=
        0.5 * (approach * (before.normal + d->force.normal) - x * (before.tangential[0] + d->force.tangential[0]) -
               y * (before.tangential[1] + d->force.tangential[1]));
    const restitute_contact_force change = {
        d->force.normal - before.normal,
        {d->force.tangential[0] - before.tangential[0], d->force.tangential[1] - before.tangential[1], 0}};
    d->trapezoid += 0.125 * (fabs(approach * (change.normal - d->change.normal)) +
                             fabs(x * (change.tangential[0] - d->change.tangential[0])) +
                             fabs(y * (change.tangential[1] - d->change.tangential[1])));
    d->change = change;
    d->largest_force = fmax(d->largest_force, d->force.normal);
}

static inline void drive_steps(struct drive *d, int n, double approach, double x, double y)
{
    for (int i = 0; i < n; i++)
        drive_by(d, approach / n, x / n, y / n);
}

#endif
