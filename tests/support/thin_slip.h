/* Slip that the solver leaves out: just below an eighth of the tolerance in psi (docs/theory.md,
 * section 4).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_THIN_SLIP_H
#define TEST_THIN_SLIP_H

#include "sync.h"

/* An impact, its ledger, and the largest tangential force and first tangential velocity of its
 * history. */
struct thin_slip {
    restitute_result result;
    restitute_ledger ledger;
    double force, velocity;
};

static inline struct thin_slip solve_thin_slip(restitute_options options, const restitute_impact *impact,
                                               const restitute_scene *scene)
{
    enum { samples = 65 };
    struct thin_slip s = {.force = 0};
    double force[samples], velocity[samples];
    PREPARED(history, history);
    restitute_solver *solver = make_solver(&options);
    restitute_error error;
    restitute_result_init(&s.result);
    restitute_ledger_init(&s.ledger);
    history.capacity = samples;
    history.tangential_force = force;
    history.tangential_velocity = velocity;
    const int status = scene ? restitute_solve_scene(solver, scene, &s.result, &s.ledger, &history, &error)
                             : restitute_solve(solver, impact, &s.result, &s.ledger, &history, &error);
    restitute_solver_destroy(solver);
    CHECK(status == RESTITUTE_OK, "%s at %g: %s", restitute_method_name(options.method), options.tolerance,
          error.message);
    for (size_t i = 0; i < history.count; i++)
        s.force = fmax(s.force, fabs(force[i]));
    s.velocity = velocity[0];
    return s;
}

/* The method without slip against sync, which follows it at a fiftieth of the tolerance. Forces: 65
 * samples and the error of the method miss the peak by a part of it, `rough`; a forgotten unit is
 * off by 1/psi. */
static inline void compare_thin_slip(restitute_options options, const restitute_impact *impact,
                                     const restitute_scene *scene, double rough)
{
    const struct thin_slip s = solve_thin_slip(options, impact, scene);
    const struct thin_slip truth = solve_thin_slip(sync_to(options.tolerance / 50), impact, scene);
    const char *name = restitute_method_name(options.method);
    CHECK(s.result.error_ex <= options.tolerance, "%s: estimate %g", name, s.result.error_ex);
    CHECK_NEAR(s.result.ex, truth.result.ex, s.result.error_ex + truth.result.error_ex, "%s", name);
    CHECK_NEAR(s.ledger.rebound_x, truth.ledger.rebound_x, 3 * s.result.error_ex, "%s: ledger", name);
    CHECK_NEAR(s.ledger.friction_x, 0, 0, "%s: nothing slips", name);
    CHECK_NEAR(s.force / truth.force, 1, rough, "%s: tangential force", name);
    CHECK_NEAR(s.velocity / truth.velocity, 1, 1e-14, "%s: tangential velocity at first touch", name);
}

static inline void check_thin_slip(restitute_options options, double rough)
{
    const double chis[] = {0.5, 7.0 / 6, 4}, psi = 0.124 * options.tolerance;
    for (int i = 0; i < 3; i++)
        for (int standard = 0; standard < 2; standard++) {
            const restitute_impact impact = impact_of(chis[i], psi, standard, 1);
            compare_thin_slip(options, &impact, NULL, rough);
        }
    restitute_material *rubber;
    PREPARED(scene, scene);
    CHECK(restitute_material_standard_solid(1e6, 3e6, 100, 0.5, &rubber, NULL) == RESTITUTE_OK, "rubber");
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 0.005;
    scene.normal_speed = 1;
    scene.tangential_speed = 1.5 * psi; /* nu = 1/2: psi = 2/3 of it */
    scene.friction = 1;
    compare_thin_slip(options, NULL, &scene, rough);
    restitute_material_destroy(rubber);
}

#endif
