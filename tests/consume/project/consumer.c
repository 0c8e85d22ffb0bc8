/* A user's program: one impact by every call that a user needs. Exit status 0 if the pair is what
 * it should be.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>

#include <restitute/restitute.h>

enum { SAMPLES = 20, BATCH = 8 };

/* An elastic no-slip impact of a solid incompressible sphere rebounds with ex = 0.10397 (no-slip
 * limit of the literature); the default tolerance is 1e-3. */
static int no_slip_is_right(void)
{
    double ez = 0, ex = 0;
    int status = restitute_pair(7.0 / 6, 0.0, 0.0, INFINITY, &ez, &ex, NULL);
    printf("restitute %s, elastic without slip: ez = %.5f, ex = %.5f\n", restitute_version(), ez, ex);
    return status == RESTITUTE_OK && fabs(ez - 1) < 1e-3 && fabs(ex - 0.10397) < 1e-3;
}

/* The long way, with every output and a refused scene, so that a memory checker sees all of it. */
static int rubber_ball_rebounds(restitute_material *rubber, restitute_solver *solver)
{
    double time[SAMPLES], force[SAMPLES];
    restitute_error error;
    restitute_scene scene;
    restitute_result result;
    restitute_ledger ledger;
    restitute_history history;
    restitute_scene_init(&scene);
    restitute_result_init(&result);
    restitute_ledger_init(&ledger);
    restitute_history_init(&history);
    history.capacity = SAMPLES;
    history.time = time;
    history.normal_force = force;
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.friction = 0.3;
    scene.tangential_speed = 1.0;
    scene.normal_speed = -2.0;
    if (restitute_solve_scene(solver, &scene, &result, NULL, NULL, &error) != RESTITUTE_ERROR_DOMAIN)
        return 0;
    printf("refused: %s\n", error.message);
    scene.normal_speed = 2.0;
    if (restitute_solve_scene(solver, &scene, &result, &ledger, &history, &error) != RESTITUTE_OK) {
        printf("failed: %s\n", error.message);
        return 0;
    }
    printf("rubber ball: ez = %.4f, ex = %.4f, %zu samples\n", result.ez, result.ex, history.count);
    return result.ez > 0 && result.ez < 1 && fabs(result.ex) < 1 && history.count == SAMPLES;
}

/* Two threads, so that a static library's user must link what they need; the angles are told
 * apart. */
static int batch_is_solved(void)
{
    restitute_impact impacts[BATCH];
    restitute_result results[BATCH];
    restitute_options options;
    restitute_error error;
    restitute_options_init(&options);
    options.threads = 2;
    for (int i = 0; i < BATCH; i++) {
        restitute_impact_init(&impacts[i]);
        restitute_result_init(&results[i]);
        impacts[i].psi = 3.0 + i;
    }
    if (restitute_solve_many(BATCH, impacts, &options, results, NULL, &error) != RESTITUTE_OK) {
        printf("failed: %s\n", error.message);
        return 0;
    }
    printf("batch: ex = %.4f to %.4f\n", results[0].ex, results[BATCH - 1].ex);
    for (int i = 1; i < BATCH; i++)
        if (!(results[i].ex < results[i - 1].ex)) return 0;
    return 1;
}

/* Two sliding speeds of one impact. */
static int plan_is_solved(void)
{
    restitute_impact impact;
    restitute_result result[2];
    restitute_plan *plan = NULL;
    restitute_impact_init(&impact);
    int good = restitute_plan_create(&impact, NULL, &plan, NULL) == RESTITUTE_OK;
    for (int i = 0; i < 2 && good; i++) {
        restitute_result_init(&result[i]);
        good = restitute_plan_solve(plan, i, &result[i], NULL, NULL, NULL) == RESTITUTE_OK;
    }
    restitute_plan_destroy(plan);
    return good && fabs(result[0].ex - 0.10397) < 1e-3 && result[1].ex > result[0].ex;
}

int main(void)
{
    restitute_material *rubber = NULL;
    restitute_solver *solver = NULL;
    int good = no_slip_is_right() && batch_is_solved() && plan_is_solved();
    if (restitute_material_standard_solid(1e6, 2e6, 50.0, 0.5, &rubber, NULL) == RESTITUTE_OK &&
        restitute_solver_create(NULL, &solver, NULL) == RESTITUTE_OK)
        good = rubber_ball_rebounds(rubber, solver) && good;
    else
        good = 0;
    restitute_solver_destroy(solver);
    restitute_material_destroy(rubber);
    return good ? 0 : 1;
}
