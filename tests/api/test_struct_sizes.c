/* A struct of an older version is smaller: every function looks at struct_size before it reads any
 * other member. Each struct here is 8 bytes at the end of a page, and the page behind it cannot be
 * read.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE /* MAP_ANONYMOUS */

#include <math.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <restitute/restitute.h>
#ifdef RESTITUTE_WITH_BEM
#include <restitute/bem.h>
#endif
#ifdef RESTITUTE_WITH_CONTACT
#include <restitute/contact.h>
#endif
#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif
#ifdef RESTITUTE_WITH_FILES
#include <restitute/files.h>
#endif
#ifdef RESTITUTE_WITH_FIT
#include <restitute/fit.h>
#endif
#ifdef RESTITUTE_WITH_TABLE
#include <restitute/table.h>
#endif

#include "../support/check.h"

/* The struct, and what the calls need that are about it. */
static struct {
    void *old;
    restitute_material *material;
    restitute_scene scene;
    restitute_impact impact;
    restitute_result result;
    restitute_solver *solver;
    restitute_error error;
} with;

static int begin(void **state)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), size = sizeof size;
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    (void)state;
    assert_true(pages != MAP_FAILED && mprotect(pages + page, page, PROT_NONE) == 0);
    with.old = pages + page - size;
    memcpy(with.old, &size, size);
    assert_int_equal(restitute_material_standard_solid(1e6, 3e6, 300, 0.5, &with.material, NULL), RESTITUTE_OK);
    assert_int_equal(restitute_solver_create(NULL, &with.solver, NULL), RESTITUTE_OK);
    restitute_scene_init(&with.scene);
    with.scene.material = with.material, with.scene.radius1 = 0.005, with.scene.mass1 = 0.004;
    with.scene.friction = 0.3, with.scene.normal_speed = 1;
    restitute_impact_init(&with.impact);
    restitute_result_init(&with.result);
    return 0;
}

static int end(void **state)
{
    (void)state;
    restitute_solver_destroy(with.solver);
    restitute_material_destroy(with.material);
    return 0;
}

#define REFUSED(call)                                                                                                  \
    do {                                                                                                               \
        const int status = (call);                                                                                     \
        CHECK(status == RESTITUTE_ERROR_STRUCT_SIZE, "%s: %d", #call, status);                                         \
    } while (0)

static void single_impacts(void **state)
{
    restitute_solver *solver = with.solver;
    restitute_numbers numbers;
    restitute_error *e = &with.error;
    double ez, ex;
    (void)state;
    restitute_numbers_init(&numbers);
    REFUSED(restitute_solver_create(with.old, &solver, e));
    REFUSED(restitute_solve(with.solver, with.old, &with.result, NULL, NULL, e));
    REFUSED(restitute_solve(with.solver, &with.impact, with.old, NULL, NULL, e));
    REFUSED(restitute_solve(with.solver, &with.impact, &with.result, with.old, NULL, e));
    REFUSED(restitute_solve(with.solver, &with.impact, &with.result, NULL, with.old, e));
    REFUSED(restitute_solve_scene(with.solver, with.old, &with.result, NULL, NULL, e));
    REFUSED(restitute_solve_scene(with.solver, &with.scene, with.old, NULL, NULL, e));
    REFUSED(restitute_scene_pair(with.old, &ez, &ex, e));
    REFUSED(restitute_scene_numbers(with.old, &numbers, e));
    REFUSED(restitute_scene_numbers(&with.scene, with.old, e));
}

static void many_impacts(void **state)
{
    restitute_plan *plan = NULL;
    restitute_error *e = &with.error;
    (void)state;
    REFUSED(restitute_solve_many(1, &with.impact, with.old, &with.result, NULL, e));
    REFUSED(restitute_solve_many(1, with.old, NULL, &with.result, NULL, e));
    REFUSED(restitute_solve_many(1, &with.impact, NULL, with.old, NULL, e));
    REFUSED(restitute_solve_scene_many(1, &with.scene, with.old, &with.result, NULL, e));
    REFUSED(restitute_solve_scene_many(1, with.old, NULL, &with.result, NULL, e));
    REFUSED(restitute_solve_scene_many(1, &with.scene, NULL, with.old, NULL, e));
    REFUSED(restitute_plan_create(&with.impact, with.old, &plan, e));
    REFUSED(restitute_plan_create(with.old, NULL, &plan, e));
    REFUSED(restitute_plan_create_scene(&with.scene, with.old, &plan, e));
    REFUSED(restitute_plan_create_scene(with.old, NULL, &plan, e));
    assert_int_equal(restitute_plan_create(&with.impact, NULL, &plan, e), RESTITUTE_OK);
    REFUSED(restitute_plan_solve(plan, 1, with.old, NULL, NULL, e));
    REFUSED(restitute_plan_solve(plan, 1, &with.result, with.old, NULL, e));
    REFUSED(restitute_plan_solve(plan, 1, &with.result, NULL, with.old, e));
    restitute_plan_destroy(plan);
}

/* A sphere above a plane, on its way to it. */
static void set_bodies(restitute_body *sphere, restitute_body *plane)
{
    restitute_body_init(sphere);
    restitute_body_init(plane);
    sphere->radius = 0.01, sphere->mass = 4e-3, sphere->position[2] = 0.01, sphere->velocity[2] = -2;
    plane->radius = INFINITY, plane->normal[2] = 1;
}

static void bodies(void **state)
{
    restitute_body sphere, plane;
    restitute_collision collision;
    restitute_error *e = &with.error;
    (void)state;
    set_bodies(&sphere, &plane);
    restitute_collision_init(&collision);
    collision.material = with.material, collision.friction = 0.3;
    REFUSED(restitute_collide(with.solver, with.old, &sphere, &plane, NULL, e));
    REFUSED(restitute_collide(with.solver, &collision, with.old, &plane, NULL, e));
    REFUSED(restitute_collide(with.solver, &collision, &sphere, with.old, NULL, e));
    REFUSED(restitute_collide(with.solver, &collision, &sphere, &plane, with.old, e));
}

#ifdef RESTITUTE_WITH_BEM
static void snapshots(void **state)
{
    restitute_bem_recorder *recorder;
    (void)state;
    assert_int_equal(restitute_bem_recorder_create(3, &recorder, NULL), RESTITUTE_OK);
    REFUSED(restitute_bem_recorder_get(recorder, 0, with.old, &with.error));
    restitute_bem_recorder_destroy(recorder);
}
#endif

#ifdef RESTITUTE_WITH_CONTACT
static void the_contact_law(void **state)
{
    restitute_contact_law *law = NULL;
    restitute_contact_rates rates;
    restitute_contact_motion motion;
    restitute_contact_force force;
    restitute_error *e = &with.error;
    double law_state[256] = {0}, *states[] = {law_state};
    (void)state;
    REFUSED(restitute_contact_law_create(with.material, with.old, &law, e));
    assert_int_equal(restitute_contact_law_create(with.material, NULL, &law, e), RESTITUTE_OK);
    restitute_contact_rates_init(&rates);
    restitute_contact_motion_init(&motion);
    REFUSED(restitute_contact_rates_set(law, 1e-6, with.old, e));
    assert_int_equal(restitute_contact_rates_set(law, 1e-6, &rates, e), RESTITUTE_OK);
    REFUSED(restitute_contact_step(law, with.old, &motion, law_state, &force, e));
    REFUSED(restitute_contact_step(law, &rates, with.old, law_state, &force, e));
    REFUSED(restitute_contact_step_many(law, &rates, 1, with.old, states, &force, NULL, e));
    REFUSED(restitute_contact_details_get(law, 1, law_state, with.old, e));
    restitute_contact_law_destroy(law);
}
#endif

#ifdef RESTITUTE_WITH_CVODE
static void the_method_cvode(void **state)
{
    restitute_cvode_recorder *recorder;
    restitute_options options;
    restitute_solver *solver;
    restitute_error *e = &with.error;
    (void)state;
    assert_int_equal(restitute_cvode_recorder_create(NULL, &recorder, e), RESTITUTE_OK);
    restitute_options_init(&options);
    options.method = restitute_cvode_recorder_method(recorder);
    assert_int_equal(restitute_solver_create(&options, &solver, e), RESTITUTE_OK);
    assert_int_equal(restitute_solve(solver, &with.impact, NULL, NULL, NULL, e), RESTITUTE_OK);
    REFUSED(restitute_cvode_recorder_events(recorder, with.old, e));
    REFUSED(restitute_cvode_recorder_work(recorder, with.old, e));
    restitute_solver_destroy(solver);
    restitute_cvode_recorder_destroy(recorder);
}
#endif

#ifdef RESTITUTE_WITH_FILES
static void files(void **state)
{
    restitute_material *material = NULL;
    (void)state;
    REFUSED(restitute_material_read(RESTITUTE_SOURCE_DIR "/src/materials/steel.json", &material, with.old,
                                    &with.error));
}
#endif

#ifdef RESTITUTE_WITH_FIT
static void measured_impacts(void **state)
{
    restitute_scene scenes[4];
    restitute_fit_point points[4];
    restitute_fit_result result;
    restitute_fitter *fitter = NULL;
    restitute_error *e = &with.error;
    double done = 0;
    (void)state;
    for (int i = 0; i < 4; i++) {
        restitute_fit_point_init(&points[i]);
        scenes[i] = with.scene, scenes[i].material = NULL, scenes[i].normal_speed = 1 + i;
        points[i].scene = &scenes[i], points[i].ez = 0.9 - 0.1 * i;
    }
    restitute_fit_result_init(&result);
    REFUSED(restitute_fit(1, with.old, NULL, &result, e));
    REFUSED(restitute_fit(4, points, with.old, &result, e));
    REFUSED(restitute_fit(4, points, NULL, with.old, e));
    REFUSED(restitute_fitter_create(1, with.old, NULL, &fitter, e));
    REFUSED(restitute_fitter_create(4, points, with.old, &fitter, e));
    assert_int_equal(restitute_fitter_create(4, points, NULL, &fitter, e), RESTITUTE_OK);
    while (done < 1)
        assert_int_equal(restitute_fitter_run(fitter, &done, e), RESTITUTE_OK);
    REFUSED(restitute_fitter_result(fitter, with.old, e));
    restitute_fitter_destroy(fitter);
}

static void a_dma_curve(void **state)
{
    static const double f[] = {1, 10, 100, 1000}, moduli[] = {1e6, 2e6, 3e6, 4e6};
    restitute_dma_result result;
    (void)state;
    restitute_dma_result_init(&result);
    REFUSED(restitute_dma_fit(4, f, moduli, moduli, NULL, with.old, &result, &with.error));
    REFUSED(restitute_dma_fit(4, f, moduli, moduli, NULL, NULL, with.old, &with.error));
}
#endif

#ifdef RESTITUTE_WITH_TABLE
static void tables(void **state)
{
    const restitute_material *materials[] = {with.material};
    const double speed = 1;
    double ez, ex;
    restitute_table_options options;
    restitute_table_contact contact;
    restitute_table *table = NULL, *none = NULL;
    restitute_body sphere, plane;
    restitute_error *e = &with.error;
    (void)state;
    set_bodies(&sphere, &plane);
    restitute_table_contact_init(&contact);
    restitute_table_options_init(&options);
    options.tolerance = 1e-2;
    REFUSED(restitute_table_build(with.old, &options, &table, e));
    REFUSED(restitute_table_build(&with.scene, with.old, &table, e));
    REFUSED(restitute_table_build_many(1, materials, with.old, &options, NULL, NULL, &table, e));
    REFUSED(restitute_table_build_many(1, materials, &with.scene, with.old, NULL, NULL, &table, e));
    assert_int_equal(restitute_table_build(&with.scene, &options, &table, e), RESTITUTE_OK);
    REFUSED(restitute_table_contact_set(table, with.old, &contact, e));
    REFUSED(restitute_table_contact_set(table, &with.scene, with.old, e));
    REFUSED(restitute_table_pair(table, with.old, 1, 1, &ez, &ex, e));
    REFUSED(restitute_table_pair_many(table, with.old, 1, &speed, &speed, &ez, &ex, e));
    REFUSED(restitute_table_collide(table, with.old, &sphere, &plane, &ez, &ex, e));
    REFUSED(restitute_table_collide(table, NULL, with.old, &plane, &ez, &ex, e));
    REFUSED(restitute_table_collide(table, NULL, &sphere, with.old, &ez, &ex, e));
    REFUSED(restitute_table_describe(table, with.old, e));
    REFUSED(restitute_table_data_get(table, with.old, e));
    REFUSED(restitute_table_create(with.old, &none, e));
    restitute_table_destroy(table);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_impacts),
        cmocka_unit_test(many_impacts),
        cmocka_unit_test(bodies),
#ifdef RESTITUTE_WITH_BEM
        cmocka_unit_test(snapshots),
#endif
#ifdef RESTITUTE_WITH_CONTACT
        cmocka_unit_test(the_contact_law),
#endif
#ifdef RESTITUTE_WITH_CVODE
        cmocka_unit_test(the_method_cvode),
#endif
#ifdef RESTITUTE_WITH_FILES
        cmocka_unit_test(files),
#endif
#ifdef RESTITUTE_WITH_FIT
        cmocka_unit_test(measured_impacts),
        cmocka_unit_test(a_dma_curve),
#endif
#ifdef RESTITUTE_WITH_TABLE
        cmocka_unit_test(tables),
#endif
    };
    return cmocka_run_group_tests(tests, begin, end);
}
