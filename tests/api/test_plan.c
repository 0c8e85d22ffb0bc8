/* What the header promises of plans: the bits of single calls in any order, for every kind of
 * solid; what a single call refuses is refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/random.h"
#include "../support/solids.h"

enum { samples = 15, most_terms = 30 };

/* All outputs of a call, padding set, so that they can be compared byte by byte. */
struct outputs {
    int status;
    restitute_result result;
    restitute_ledger ledger;
    restitute_history history;
    double array[3][samples];
    restitute_error error;
};

static void prepare(struct outputs *o)
{
    memset(o, 0, sizeof *o);
    restitute_result_init(&o->result);
    restitute_ledger_init(&o->ledger);
    restitute_history_init(&o->history);
    o->history.capacity = samples;
    o->history.stick_radius = o->array[0];
    o->history.tangential_velocity = o->array[1];
    o->history.normal_force = o->array[2];
}

/* Histories point to arrays of their own, and the message behind its end is nobody's. */
static int alike(struct outputs *a, struct outputs *b)
{
    return a->status == b->status && a->history.count == b->history.count && a->error.status == b->error.status &&
           strcmp(a->error.message, b->error.message) == 0 && memcmp(&a->result, &b->result, sizeof a->result) == 0 &&
           memcmp(&a->ledger, &b->ledger, sizeof a->ledger) == 0 && memcmp(a->array, b->array, sizeof a->array) == 0;
}

static restitute_options with_sync(double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = restitute_method_sync();
    return options;
}

static restitute_solver *new_solver(const restitute_options *options)
{
    restitute_solver *solver;
    restitute_error error;
    CHECK(restitute_solver_create(options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    return solver;
}

static restitute_plan *plan_for(const restitute_options *options, const restitute_impact *impact)
{
    restitute_plan *plan;
    restitute_error error;
    CHECK(restitute_plan_create(impact, options, &plan, &error) == RESTITUTE_OK && !*error.message, "%s",
          error.message);
    return plan;
}

/* Limits, and places on either side of each: no slip, slip so small that it is left out, gross slip
 * at first, its end at the turning point (2 chi), gross slip to the end. */
static double random_psi(uint64_t *random, double chi)
{
    switch (random_below(random, 8)) {
    case 0:
        return 0;
    case 1:
        return random_log(random, 1e-13, 1e-2);
    case 2:
        return 1;
    case 3:
        return 2 * chi;
    case 4:
        return random_in(random, 1, 2 * chi + 1);
    case 5:
        return random_log(random, 10, 1e12);
    default:
        return random_in(random, 0, 1);
    }
}

/* A new solver each time, so that no state is kept. */
static void compare(const restitute_options *options, restitute_impact impact, restitute_plan *plan, double psi,
                    int all, const char *name)
{
    static struct outputs wanted, given;
    restitute_solver *solver = new_solver(options);
    prepare(&wanted);
    prepare(&given);
    impact.psi = psi;
    wanted.status = restitute_solve(solver, &impact, &wanted.result, all ? &wanted.ledger : NULL,
                                    all ? &wanted.history : NULL, &wanted.error);
    given.status = restitute_plan_solve(plan, psi, &given.result, all ? &given.ledger : NULL,
                                        all ? &given.history : NULL, &given.error);
    CHECK(alike(&wanted, &given), "%s, chi %.17g, psi %.17g: ez %.17g %.17g, ex %.17g %.17g, status %d %d", name,
          impact.chi, psi, wanted.result.ez, given.result.ez, wanted.result.ex, given.result.ex, wanted.status,
          given.status);
    restitute_solver_destroy(solver);
}

static void compare_many(const restitute_options *options, const struct solid *solid, int n)
{
    static const double chis[] = {7.0 / 6, 0.4, 3};
    uint64_t random = 5;
    for (int k = 0; k < 3; k++) {
        const restitute_impact impact = impact_with(solid, chis[k], 17); /* its psi is not used */
        restitute_plan *plan = plan_for(options, &impact);
        for (int i = 0; i < n; i++)
            compare(options, impact, plan, random_psi(&random, chis[k]), i % 8 == 0, solid->name);
        restitute_plan_destroy(plan);
    }
}

static void every_solid_gives_the_bits_of_single_calls(void **state)
{
    (void)state;
    struct solid all[solids];
    make_solids(all);
    for (int i = 0; i < solids; i++)
        for (double tolerance = 1e-2; tolerance > 1e-6; tolerance *= 1e-3) {
            const restitute_options options = with_sync(tolerance);
            compare_many(&options, &all[i], 20);
        }
    free_solids(all);
}

/* Bodies that creep for ever; some count as stopped: the limit of speed depends on psi. */
static void spheres_that_sink_give_the_bits_of_single_calls(void **state)
{
    (void)state;
    uint64_t random = 3;
    int sunk = 0, rebounds = 0;
    for (int i = 0; i < 12; i++) {
        const double tau[] = {random_log(&random, 0.1, 2)}, g[] = {1};
        const struct solid maxwell = {"Maxwell", 0, 0, solid_of(0, 0, 1, tau, g)};
        const restitute_options options = with_sync(1e-4);
        compare_many(&options, &maxwell, 20);
        const struct solution s = solve_impact(options, impact_on(maxwell.material, 7.0 / 6, 0));
        *(s.status == RESTITUTE_NO_REBOUND ? &sunk : &rebounds) += 1;
        restitute_material_destroy(maxwell.material);
    }
    CHECK(sunk > 2 && rebounds > 2, "%d sink, %d rebound: not the mixture meant", sunk, rebounds);
}

/* Twenty decades of relaxation times, slow ones of which the contact feels the more the longer it
 * lasts. */
static void many_terms_give_the_bits_of_single_calls(void **state)
{
    (void)state;
    double tau[most_terms], g[most_terms];
    for (int k = 0; k < most_terms; k++) {
        tau[k] = pow(10, -10 + 2 * k / 3.0);
        g[k] = pow(10, 1 - k / 3.0);
    }
    const struct solid polymer = {"30 terms", 0, 0, solid_of(1e-3, 0, most_terms, tau, g)};
    const struct solid creeping = {"30 terms, no spring", 0, 0, solid_of(0, 0, most_terms, tau, g)};
    const restitute_options options = with_sync(1e-5);
    compare_many(&options, &polymer, 10);
    compare_many(&options, &creeping, 10);
    restitute_material_destroy(polymer.material);
    restitute_material_destroy(creeping.material);
}

static void other_methods_and_given_elements_give_the_bits_of_single_calls(void **state)
{
    (void)state;
    const struct solid standard = {"standard", 1, 1, NULL};
    restitute_options options = to_tolerance(1e-2);
    compare_many(&options, &standard, 10);
    options = sync_at(64);
    compare_many(&options, &standard, 10);
}

static restitute_scene rubber_ball(const restitute_material *rubber)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.normal_speed = 2;
    return scene;
}

static void compare_scene(const restitute_options *options, restitute_scene scene, restitute_plan *plan, double sliding)
{
    static struct outputs wanted, given;
    restitute_solver *solver = new_solver(options);
    prepare(&wanted);
    prepare(&given);
    scene.tangential_speed = sliding;
    wanted.status = restitute_solve_scene(solver, &scene, &wanted.result, &wanted.ledger, &wanted.history, &wanted.error);
    given.status = restitute_plan_solve(plan, sliding, &given.result, &given.ledger, &given.history, &given.error);
    CHECK(alike(&wanted, &given), "friction %g, sliding %.17g: ex %.17g %.17g", scene.friction, sliding,
          wanted.result.ex, given.result.ex);
    restitute_solver_destroy(solver);
}

static void scenes_give_the_bits_of_single_calls(void **state)
{
    (void)state;
    const double tau[] = {1e-4, 1e-2}, g[] = {5e6, 1e6}, frictions[] = {0, 0.3, INFINITY};
    restitute_material *rubber = solid_of(1e6, 0, 2, tau, g);
    restitute_scene scene = rubber_ball(rubber);
    const restitute_options options = with_sync(1e-5);
    uint64_t random = 9;
    for (int k = 0; k < 3; k++) {
        restitute_plan *plan;
        restitute_error error;
        scene.friction = frictions[k];
        scene.tangential_speed = NAN; /* these two are not used */
        scene.spin1 = 1e200;
        CHECK(restitute_plan_create_scene(&scene, &options, &plan, &error) == RESTITUTE_OK, "%s", error.message);
        scene.tangential_speed = scene.spin1 = 0;
        for (int i = 0; i < 30; i++)
            compare_scene(&options, scene, plan, i ? random_in(&random, -4, 4) : 0);
        compare_scene(&options, scene, plan, 1e4); /* slides far: remarks are the same */
        restitute_plan_destroy(plan);
    }
    restitute_material_destroy(rubber);
}

/* A spin is what it adds to the sliding of the contact point. */
static void spins_are_part_of_the_sliding_speed(void **state)
{
    (void)state;
    restitute_material *rubber = solid_of(1e6, 0, 0, NULL, NULL);
    restitute_scene scene = rubber_ball(rubber);
    const restitute_options options = with_sync(1e-5);
    restitute_plan *plan;
    restitute_result result;
    scene.friction = 0.3;
    CHECK(restitute_plan_create_scene(&scene, &options, &plan, NULL) == RESTITUTE_OK, "plan");
    restitute_result_init(&result);
    CHECK(restitute_plan_solve(plan, 1.5, &result, NULL, NULL, NULL) == RESTITUTE_OK, "solve");
    scene.tangential_speed = 1;
    scene.spin1 = 50;
    const struct solution wanted = solve_scene(options, &scene);
    CHECK(result.ex == wanted.result.ex && result.displacement_ratio == wanted.result.displacement_ratio,
          "%.17g, not %.17g", result.ex, wanted.result.ex);
    restitute_plan_destroy(plan);
    restitute_material_destroy(rubber);
}

#define REFUSED(call, wanted, text)                                                                                    \
    do {                                                                                                               \
        const int status_ = (call);                                                                                    \
        CHECK(status_ == (wanted) && error.status == (wanted) && strstr(error.message, text), "%d: %s", status_,       \
              error.message);                                                                                          \
    } while (0)

static void a_plan_without_options_is_by_sync(void **state)
{
    const restitute_impact impact = impact_of(7.0 / 6, 1, 1, 1);
    restitute_plan *plan = plan_for(NULL, &impact);
    restitute_result result;
    (void)state;
    restitute_result_init(&result);
    CHECK(restitute_plan_solve(plan, INFINITY, &result, NULL, NULL, NULL) == RESTITUTE_OK && result.ex == -1,
          "no friction");
    CHECK(strcmp(result.method, "sync") == 0, "%s", result.method);
    restitute_plan_destroy(plan);
}

static void refused_plans_leave_all_untouched(void **state)
{
    (void)state;
    restitute_material *dashpot = solid_of(1, 1e13, 0, NULL, NULL);
    restitute_options options = with_sync(1e-5);
    restitute_impact impact = impact_of(7.0 / 6, 1, 1, 1), wrong = impact;
    restitute_scene scene;
    restitute_error error;
    restitute_plan *const nothing = (restitute_plan *)&wrong, *plan = nothing;
    restitute_scene_init(&scene);
    REFUSED(restitute_plan_create(NULL, &options, &plan, &error), RESTITUTE_ERROR_NULL, "impact is NULL");
    REFUSED(restitute_plan_create(&impact, &options, NULL, &error), RESTITUTE_ERROR_NULL, "plan is NULL");
    REFUSED(restitute_plan_create_scene(NULL, &options, &plan, &error), RESTITUTE_ERROR_NULL, "scene is NULL");
    REFUSED(restitute_plan_create_scene(&scene, &options, NULL, &error), RESTITUTE_ERROR_NULL, "plan is NULL");
    REFUSED(restitute_plan_create_scene(&scene, &options, &plan, &error), RESTITUTE_ERROR_NULL,
            "scene.material is NULL");
    scene.material = dashpot;
    REFUSED(restitute_plan_create_scene(&scene, &options, &plan, &error), RESTITUTE_ERROR_DOMAIN, "radius1");
    scene.struct_size = 0;
    REFUSED(restitute_plan_create_scene(&scene, &options, &plan, &error), RESTITUTE_ERROR_STRUCT_SIZE,
            "restitute_scene");
    wrong.struct_size++;
    REFUSED(restitute_plan_create(&wrong, &options, &plan, &error), RESTITUTE_ERROR_STRUCT_SIZE, "restitute_impact");
    wrong = impact;
    wrong.chi = 0.1;
    REFUSED(restitute_plan_create(&wrong, &options, &plan, &error), RESTITUTE_ERROR_DOMAIN, "chi = 0.1");
    wrong = impact_on(dashpot, 7.0 / 6, 1);
    REFUSED(restitute_plan_create(&wrong, &options, &plan, &error), RESTITUTE_ERROR_DOMAIN, "parallel viscosity");
    options.tolerance = 1;
    REFUSED(restitute_plan_create(&impact, &options, &plan, &error), RESTITUTE_ERROR_DOMAIN, "tolerance = 1");
    CHECK(plan == nothing, "a refused call gave a plan");
    restitute_plan_destroy(NULL);
    restitute_material_destroy(dashpot);
}

static void refused_calls_leave_outputs_and_plan_as_they_were(void **state)
{
    (void)state;
    static struct outputs o, fresh;
    const restitute_options options = with_sync(1e-5);
    const restitute_impact impact = impact_of(7.0 / 6, 0, 1, 1);
    restitute_plan *plan = plan_for(&options, &impact);
    restitute_error error;
    prepare(&o);
    fresh = o;
    REFUSED(restitute_plan_solve(NULL, 1, &o.result, &o.ledger, &o.history, &error), RESTITUTE_ERROR_NULL, "plan is NULL");
    REFUSED(restitute_plan_solve(plan, -1, &o.result, &o.ledger, &o.history, &error), RESTITUTE_ERROR_DOMAIN, "psi = -1");
    REFUSED(restitute_plan_solve(plan, NAN, &o.result, &o.ledger, &o.history, &error), RESTITUTE_ERROR_DOMAIN, "psi = nan");
    CHECK(memcmp(&o, &fresh, sizeof o) == 0, "outputs touched");
    o.result.struct_size = 8;
    REFUSED(restitute_plan_solve(plan, 1, &o.result, NULL, NULL, &error), RESTITUTE_ERROR_STRUCT_SIZE, "restitute_result");
    CHECK(restitute_plan_solve(plan, 1, NULL, NULL, NULL, NULL) == RESTITUTE_OK, "no outputs at all");
    compare(&options, impact, plan, 0.5, 1, "after refusals");
    restitute_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_solid_gives_the_bits_of_single_calls),
        cmocka_unit_test(spheres_that_sink_give_the_bits_of_single_calls),
        cmocka_unit_test(many_terms_give_the_bits_of_single_calls),
        cmocka_unit_test(other_methods_and_given_elements_give_the_bits_of_single_calls),
        cmocka_unit_test(scenes_give_the_bits_of_single_calls),
        cmocka_unit_test(spins_are_part_of_the_sliding_speed),
        cmocka_unit_test(a_plan_without_options_is_by_sync),
        cmocka_unit_test(refused_plans_leave_all_untouched),
        cmocka_unit_test(refused_calls_leave_outputs_and_plan_as_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
