/* A plan: one normal motion for many sliding speeds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "base/sized.h"
#include "base/status.h"
#include "solver/solver.h"

/* Only the one in use has a struct_size other than 0. */
struct restitute_plan {
    restitute_solver *solver;
    restitute_impact impact;
    restitute_scene scene;
};

/* Take the options and check the input, which the plan has. */
static int begin(const restitute_options *options, struct restitute_plan *p, restitute_error *error)
{
    restitute_options own;
    restitute_options_init(&own);
    own.method = restitute_method_sync();
    int status = restitute_solver_create(options ? options : &own, &p->solver, error);
    if (status) return status;
    rst_solver_keep_motion(p->solver);
    return rst_solver_check(p->solver, p->impact.struct_size ? &p->impact : NULL,
                            p->scene.struct_size ? &p->scene : NULL, error);
}

static int create(const struct restitute_plan *input, const restitute_options *options, restitute_plan **plan,
                  restitute_error *error)
{
    struct restitute_plan *p = malloc(sizeof *p);
    if (!p) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a plan");
    *p = *input;
    const int status = begin(options, p, error);
    if (status) {
        restitute_plan_destroy(p);
        return status;
    }
    *plan = p;
    return rst_done(error);
}

int restitute_plan_create(const restitute_impact *impact, const restitute_options *options, restitute_plan **plan,
                          restitute_error *error)
{
    if (!impact || !plan) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", impact ? "plan" : "impact");
    struct restitute_plan input = {0};
    const int status = RST_TAKE(impact, &input.impact, impact, error);
    if (status) return status;
    input.impact.psi = 0;
    return create(&input, options, plan, error);
}

int restitute_plan_create_scene(const restitute_scene *scene, const restitute_options *options, restitute_plan **plan,
                                restitute_error *error)
{
    if (!scene || !plan) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", scene ? "plan" : "scene");
    struct restitute_plan input = {0};
    const int status = RST_TAKE(scene, &input.scene, scene, error);
    if (status) return status;
    if (!input.scene.material) return rst_report(error, RESTITUTE_ERROR_NULL, "scene.material is NULL");
    input.scene.tangential_speed = input.scene.spin1 = input.scene.spin2 = 0;
    return create(&input, options, plan, error);
}

int restitute_plan_solve(restitute_plan *plan, double sliding, restitute_result *result, restitute_ledger *ledger,
                         restitute_history *history, restitute_error *error)
{
    if (!plan) return rst_report(error, RESTITUTE_ERROR_NULL, "plan is NULL");
    if (plan->scene.struct_size) {
        plan->scene.tangential_speed = sliding;
        return restitute_solve_scene(plan->solver, &plan->scene, result, ledger, history, error);
    }
    plan->impact.psi = sliding;
    return restitute_solve(plan->solver, &plan->impact, result, ledger, history, error);
}

void restitute_plan_destroy(restitute_plan *plan)
{
    if (!plan) return;
    restitute_solver_destroy(plan->solver);
    free(plan);
}
