/* The calls of restitute.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "caller.h"

enum { MANY_CASES = 3, SAMPLES = 5 };

static void materials(void)
{
    const double tau[] = {1e-4, 1e-2}, g[] = {5e6, 1e6};
    double equilibrium, viscosity, times[2], moduli[2];
    restitute_material *prony, *elastic, *kelvin_voigt, *maxwell, *effective, *shifted;
    DONE(restitute_material_prony(1e6, 0, 2, tau, g, 0.4, &prony, &error));
    DONE(restitute_material_elastic(1e9, 0.3, &elastic, &error));
    DONE(restitute_material_kelvin_voigt(1e6, 50, 0.5, &kelvin_voigt, &error));
    DONE(restitute_material_maxwell(1e6, 50, 0.5, &maxwell, &error));
    DONE(restitute_material_effective(prony, elastic, &effective, &error));
    DONE(restitute_material_series(prony, &equilibrium, &viscosity, times, moduli, &error));
    SHOW(equilibrium, viscosity, times[0], moduli[1], (double)restitute_material_terms(prony));
    SHOW(restitute_material_dundurs(effective), restitute_material_poisson_ratio(effective));
    SHOW(restitute_material_modulus(kelvin_voigt, 1e-3), restitute_material_modulus(maxwell, 1e-3));
    DONE(restitute_material_set_window(prony, 1e-4, 1, &error));
    DONE(restitute_material_shifted(prony, 10, &shifted, &error));
    DONE(restitute_material_window(shifted, &times[0], &times[1], &error));
    SHOW(times[0], times[1], restitute_material_modulus(shifted, 1e-3));
    restitute_material_destroy(shifted);
    restitute_material_destroy(prony);
    restitute_material_destroy(elastic);
    restitute_material_destroy(kelvin_voigt);
    restitute_material_destroy(maxwell);
    restitute_material_destroy(effective);
}

static void single(restitute_solver *solver, const restitute_scene *scene)
{
    double force[SAMPLES], ez, ex;
    ONE(impact, impact);
    ONE(numbers, numbers);
    ONE(result, result);
    ONE(ledger, ledger);
    ONE(history, history);
    history->capacity = SAMPLES, history->normal_force = force;
    impact->psi = 2, impact->delta1 = 1, impact->gamma = 1;
    DONE(restitute_solve(solver, impact, result, ledger, history, &error));
    SHOW(result->ez, result->ex, result->contact_time, result->work, ledger->viscous_z, ledger->residual_x);
    SHOW((double)history->count, force[1], (double)result->flags);
    TEXT(result->method);
    DONE(restitute_solve_scene(solver, scene, result, ledger, history, &error));
    SHOW(result->ez, result->ex, result->contact_time, result->speed_ratio, ledger->friction_x, force[1]);
    DONE(restitute_scene_numbers(scene, numbers, &error));
    SHOW(numbers->chi, numbers->psi, numbers->delta1, numbers->gamma, numbers->force);
    DONE(restitute_pair(7.0 / 6, 2, 1, 1, &ez, &ex, &error));
    SHOW(ez, ex, restitute_critical_psi(7.0 / 6, ez));
    DONE(restitute_scene_pair(scene, &ez, &ex, &error));
    SHOW(ez, ex);
}

static void many(const restitute_options *options, const restitute_material *material)
{
    int statuses[MANY_CASES];
    MANY(impact, impacts, MANY_CASES);
    MANY(scene, scenes, MANY_CASES);
    MANY(result, results, MANY_CASES);
    for (int i = 0; i < MANY_CASES; i++) {
        impacts[i].psi = 0.5 + i, impacts[i].delta1 = 0.3 * i, impacts[i].gamma = 1;
        ball(&scenes[i], material);
        scenes[i].normal_speed = 0.1 + 0.1 * i;
    }
    DONE(restitute_solve_many(MANY_CASES, impacts, options, results, statuses, &error));
    for (int i = 0; i < MANY_CASES; i++)
        SHOW(statuses[i], results[i].ez, results[i].ex);
    DONE(restitute_solve_scene_many(MANY_CASES, scenes, options, results, statuses, &error));
    for (int i = 0; i < MANY_CASES; i++)
        SHOW(statuses[i], results[i].ez, results[i].ex);
}

static void plans(const restitute_options *options, const restitute_scene *scene)
{
    restitute_plan *plan;
    ONE(impact, impact);
    ONE(result, result);
    ONE(ledger, ledger);
    impact->delta1 = 1, impact->gamma = 1;
    DONE(restitute_plan_create(impact, options, &plan, &error));
    DONE(restitute_plan_solve(plan, 0.5, result, ledger, NULL, &error));
    SHOW(result->ez, result->ex, ledger->left_x);
    restitute_plan_destroy(plan);
    DONE(restitute_plan_create_scene(scene, options, &plan, &error));
    DONE(restitute_plan_solve(plan, 0.5, result, NULL, NULL, &error));
    SHOW(result->ez, result->ex);
    restitute_plan_destroy(plan);
}

static void two_bodies(restitute_solver *solver, const restitute_material *material)
{
    ONE(body, first);
    ONE(body, second);
    ONE(collision, collision);
    ONE(result, result);
    second->radius = INFINITY, second->normal[2] = 1;
    first->radius = 0.01, first->mass = 4e-3, first->position[2] = 0.01;
    first->velocity[0] = 0.1, first->velocity[2] = -0.2;
    collision->material = material, collision->friction = 0.3;
    DONE(restitute_collide(solver, collision, first, second, result, &error));
    SHOW(first->velocity[0], first->velocity[2], first->spin[1], result->ez);
}

void call_core(void)
{
    restitute_material *material = rubber();
    restitute_solver *solver;
    ONE(options, options);
    ONE(scene, scene);
    ball(scene, material);
    TEXT(restitute_version());
    TEXT(restitute_status_text(RESTITUTE_ERROR_DOMAIN));
    TEXT(restitute_flag_text(RESTITUTE_FLAG_FAST));
    TEXT(restitute_method_name(restitute_method_euler()));
    materials();
    options->method = restitute_method_sync(), options->time_limit = INFINITY;
    DONE(restitute_solver_create(options, &solver, &error));
    single(solver, scene);
    two_bodies(solver, material);
    many(options, material);
    plans(options, scene);
    restitute_solver_destroy(solver);
    restitute_material_destroy(material);
}
