/* Every allocation of every call of the core fails in turn: ERROR_MEMORY, outputs untouched, and
 * the same objects give the right result afterwards, bit by bit, and leak nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/outputs.h"
#include "../support/solve.h"

enum { terms = 12, cases = 3 };

static restitute_material *rubber, *glue; /* live for the whole program */
static restitute_solver *solver;
static restitute_options options;
static restitute_error error;

/* ---- materials */

static void give_material(restitute_material *material, struct given *given)
{
    give(given, restitute_material_modulus(material, 1e-3));
    give(given, restitute_material_poisson_ratio(material));
    give(given, (double)restitute_material_terms(material));
    restitute_material_destroy(material);
}

#define MATERIAL(name, ...)                                                                                            \
    MAKES(material, name, restitute_material_##name(__VA_ARGS__, &made, &error), give_material(made, given))

static const double three_times[] = {1e-2, 1e-4, 1e-3}, three_moduli[] = {1e6, 2e6, 3e6};
MATERIAL(prony, 1e6, 10, 3, three_times, three_moduli, 0.4)
MATERIAL(elastic, 1e6, 0.4)
MATERIAL(standard_solid, 1e6, 2e6, 50, 0.4)
MATERIAL(kelvin_voigt, 1e6, 50, 0.4)
MATERIAL(maxwell, 1e6, 50, 0.4)
MATERIAL(effective, rubber, glue)

static void materials(void **state)
{
    (void)state;
    FAIL_EACH({"prony", .call = prony}, {"elastic", .call = elastic}, {"standard solid", .call = standard_solid},
              {"Kelvin-Voigt", .call = kelvin_voigt}, {"Maxwell", .call = maxwell},
              {"effective solid", .call = effective});
}

/* ---- solvers */

static void create_solver(void)
{
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
}

static void destroy_solver(void)
{
    restitute_solver_destroy(solver);
    solver = NULL;
}

MAKES(solver, solver_create, restitute_solver_create(&options, &made, &error), restitute_solver_destroy(made))

/* What the solver solves: a scene on rubber, sticking or slipping at first, or a dimensionless
 * impact. */
static restitute_scene scene;
static restitute_impact impact;
SOLVES(solve_scene_once, restitute_solve_scene(solver, &scene, &o.result, WANTED(ledger), WANTED(history), &error))
SOLVES(solve_impact_once, restitute_solve(solver, &impact, &o.result, WANTED(ledger), WANTED(history), &error))

/* Plans for the same scene and impact. */
static restitute_plan *plan;

MAKES(plan, plan_create, restitute_plan_create_scene(&scene, &options, &made, &error), restitute_plan_destroy(made))

static void begin_plan(void)
{
    CHECK(restitute_plan_create_scene(&scene, &options, &plan, &error) == RESTITUTE_OK, "%s", error.message);
}

static void end_plan(void)
{
    restitute_plan_destroy(plan);
    plan = NULL;
}

SOLVES(plan_solve, restitute_plan_solve(plan, 0.6, &o.result, WANTED(ledger), WANTED(history), &error))

/* A ball that flies against one at rest. */
static int collide(struct given *given)
{
    PREPARED(body, ball);
    PREPARED(collision, collision);
    PREPARED(result, result);
    int status;
    ball.radius = 0.01;
    ball.mass = 4e-3;
    restitute_body other = ball;
    other.position[0] = 0.02;
    ball.velocity[0] = 2;
    ball.velocity[1] = 1;
    collision.material = rubber;
    collision.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    collision.friction = 0.3;
    const restitute_body before = ball;
    ARMED(status, restitute_collide(solver, &collision, &ball, &other, &result, &error));
    CHECK(status >= 0 || memcmp(&before, &ball, sizeof ball) == 0, "body touched");
    for (int i = 0; i < 3; i++) {
        give(given, ball.velocity[i]);
        give(given, other.velocity[i]);
        give(given, other.spin[i]);
    }
    give(given, result.ex);
    return status;
}

static void with_method(const restitute_method *method, double tolerance)
{
    options = to_tolerance(tolerance);
    options.method = method;
    FAIL_EACH({"solver_create", .call = solver_create}, {"plan_create_scene", .call = plan_create},
              {"collide", collide, create_solver, destroy_solver, .settles = 1});
    for (all_outputs = 0; all_outputs < 2; all_outputs++) {
        impact = impact_of(8.7442, 1.406e-3, 6.438e-5, 16.97); /* the ledger is a run of its own */
        FAIL_EACH({"solve, short slip", solve_impact_once, create_solver, destroy_solver, .settles = 1});
        impact = impact_of(7.0 / 6, 0.7, 1, 1);
        FAIL_EACH({"solve", solve_impact_once, create_solver, destroy_solver, .settles = 1},
                  {"plan_solve", plan_solve, begin_plan, end_plan, .settles = 1});
        for (scene.tangential_speed = 0.5; scene.tangential_speed < 3; scene.tangential_speed += 1.5)
            FAIL_EACH({"solve_scene", solve_scene_once, create_solver, destroy_solver, .settles = 1});
    }
}

static void method_euler(void **state)
{
    (void)state;
    with_method(restitute_method_euler(), 2e-2);
}

static void method_sync(void **state)
{
    (void)state;
    with_method(restitute_method_sync(), 1e-4);
    with_method(restitute_method_sync(), 1e-6);
}

/* ---- one call, many impacts */

#define PAIR(name, function, ...)                                                                                      \
    static int name(struct given *given)                                                                               \
    {                                                                                                                  \
        int status;                                                                                                    \
        double ez = 7, ex = 7;                                                                                         \
        ARMED(status, function(__VA_ARGS__, &ez, &ex, &error));                                                        \
        CHECK(status >= 0 || (ez == 7 && ex == 7), "pair touched");                                                    \
        give(given, ez);                                                                                               \
        give(given, ex);                                                                                               \
        return status;                                                                                                 \
    }
PAIR(one_pair, restitute_pair, 7.0 / 6, 2, 1, 1)
PAIR(one_scene_pair, restitute_scene_pair, &scene)

/* A case that failed has its status, or the call was refused as a whole; the others are right. */
static int give_cases(int status, int of_scenes, const restitute_result *results, const int *statuses,
                      struct given *given)
{
    static double right[4][cases]; /* of the first call, in which nothing fails */
    static int known[4];
    restitute_result fresh;
    restitute_result_init(&fresh);
    const int which = 2 * of_scenes + (options.method == restitute_method_sync());
    for (int i = 0; i < cases; i++) {
        CHECK((statuses[i] == 99) == (statuses[0] == 99), "refused as a whole, but for case %d", i);
        CHECK(statuses[i] == RESTITUTE_OK || memcmp(&results[i], &fresh, sizeof fresh) == 0, "case %d touched", i);
        if (known[which] && statuses[i] == RESTITUTE_OK)
            CHECK(results[i].ex == right[which][i], "case %d beside one that failed", i);
        if (status >= 0) give(given, right[which][i] = results[i].ex);
    }
    known[which] |= status >= 0;
    return status;
}

static int many_impacts(struct given *given)
{
    int status, statuses[cases];
    restitute_impact impacts[cases];
    restitute_result results[cases];
    for (int i = 0; i < cases; i++) {
        impacts[i] = impact_of(7.0 / 6, 0.4 + i, 1, 1);
        restitute_result_init(&results[i]);
        statuses[i] = 99;
    }
    impacts[1].material = rubber;
    ARMED(status, restitute_solve_many(cases, impacts, &options, results, statuses, &error));
    return give_cases(status, 0, results, statuses, given);
}

static int many_scenes(struct given *given)
{
    int status, statuses[cases];
    restitute_scene scenes[cases];
    restitute_result results[cases];
    for (int i = 0; i < cases; i++) {
        scenes[i] = scene;
        scenes[i].tangential_speed = 0.4 + i;
        restitute_result_init(&results[i]);
        statuses[i] = 99;
    }
    scenes[1].material = glue;
    ARMED(status, restitute_solve_scene_many(cases, scenes, &options, results, statuses, &error));
    return give_cases(status, 1, results, statuses, given);
}

static void single_calls_and_batches(void **state)
{
    (void)state;
    FAIL_EACH({"pair", .call = one_pair}, {"scene_pair", .call = one_scene_pair});
    for (int i = 0; i < 2; i++) {
        options = to_tolerance(2e-2);
        if (i) options.method = restitute_method_sync();
        FAIL_EACH({"solve_many", .call = many_impacts}, {"solve_scenes", .call = many_scenes});
    }
}

/* ---- the checker itself */

/* It loses a block whenever it fails, and says that all is well. */
static int leaky(struct given *given)
{
    int status;
    void *volatile lost = malloc(8), *volatile other;
    ARMED(status, (other = malloc(8)) ? RESTITUTE_OK : RESTITUTE_ERROR_MEMORY);
    give(given, 1);
    if (!other) return status;
    free(other);
    free(lost);
    return status;
}

static void failures_and_losses_are_seen(void **state)
{
    struct given given;
    (void)state;
    const struct subject s = {"leaky", .call = leaky};
    const long live = allocator.live;
    CHECK(subject_call(&s, 1, &given) == RESTITUTE_ERROR_MEMORY && allocator.count == 1, "the allocation failed");
    CHECK(allocator.live == live + 1, "%ld blocks lost, not one", allocator.live - live);
    CHECK(subject_call(&s, 2, &given) == RESTITUTE_OK && allocator.live == live + 1, "this one did not");
    allocator.count = 0;
    CHECK(elastic(&given) == RESTITUTE_OK && allocator.count > 0, "no allocation of the library is seen");
}

static int set_up(void **state)
{
    double tau[terms], g[terms];
    (void)state;
    for (int k = 0; k < terms; k++) {
        tau[k] = pow(10, -6 + 0.5 * k);
        g[k] = 1e6 / (1 + k % 3);
    }
    rubber = solid_of(1e6, 0, terms, tau, g);
    glue = solid_of(2e6, 0, 5, tau + 1, g);
    restitute_scene_init(&scene);
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.friction = 0.3;
    scene.normal_speed = 2;
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    restitute_material_destroy(rubber);
    restitute_material_destroy(glue);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(failures_and_losses_are_seen), cmocka_unit_test(materials),
                                       cmocka_unit_test(method_euler), cmocka_unit_test(method_sync),
                                       cmocka_unit_test(single_calls_and_batches)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, set_up, tear_down));
}
