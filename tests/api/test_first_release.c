/* A program that was compiled with the headers of the first release: its structs end where theirs
 * did. Each struct here ends at the end of a page, and the page behind it can be neither read nor
 * written. A program that was compiled with later headers is refused.
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
#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

#include "../support/check.h"

/* X(struct, the last member that it had in the first release, its last member now) */
#define CORE_STRUCTS(X)                                                                                                \
    X(impact, material, material)                                                                                      \
    X(scene, wave_density, wave_density)                                                                               \
    X(numbers, dundurs_beta, dundurs_beta)                                                                             \
    X(options, dundurs_limit, dundurs_limit)                                                                           \
    X(result, method, method)                                                                                          \
    X(ledger, residual_x, residual_x)                                                                                  \
    X(history, tangential_velocity, tangential_velocity)                                                               \
    X(body, normal, normal)                                                                                            \
    X(collision, wave_density, wave_density)
#ifdef RESTITUTE_WITH_BEM
#define BEM_STRUCTS(X) X(bem_snapshot, stick, stick)
#else
#define BEM_STRUCTS(X)
#endif
#ifdef RESTITUTE_WITH_CVODE
#define CVODE_STRUCTS(X) X(cvode_events, event, event) X(cvode_work, stiff, stiff)
#else
#define CVODE_STRUCTS(X)
#endif
#define STRUCTS(X) CORE_STRUCTS(X) BEM_STRUCTS(X) CVODE_STRUCTS(X)

#define UP_TO(type, member) (offsetof(restitute_##type, member) + sizeof(((restitute_##type *)0)->member))

static void init_names_the_size_of_the_callers_struct(void **state)
{
    (void)state;
#define SETS_OWN_SIZE(type, first, last)                                                                               \
    {                                                                                                                  \
        restitute_##type value;                                                                                        \
        restitute_##type##_init(&value);                                                                               \
        CHECK(value.struct_size == sizeof value, "%s", #type);                                                         \
    }
    STRUCTS(SETS_OWN_SIZE)
}

/* A later member would begin within the size that older callers have. */
static void no_struct_has_padding_at_its_tail(void **state)
{
    (void)state;
#define ENDS_WITH_ITS_LAST(type, first, last)                                                                          \
    CHECK(UP_TO(type, last) == sizeof(restitute_##type), "%s ends at %zu of %zu", #type, UP_TO(type, last),            \
          sizeof(restitute_##type));
    STRUCTS(ENDS_WITH_ITS_LAST)
}

/* Room that ends where the readable page does. */
static void *at_the_end(size_t size)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(pages != MAP_FAILED && mprotect(pages + page, page, PROT_NONE) == 0);
    return pages + page - size;
}

static struct {
#define MEMBER(type, first, last) restitute_##type *type;
    STRUCTS(MEMBER)
} old, later;

static restitute_material *rubber;
static double samples[4];

/* Old: of the first release. Later: one more member than ours. */
static int make_structs(void **state)
{
    (void)state;
#define MAKE(type, first, last)                                                                                        \
    old.type = at_the_end(UP_TO(type, first));                                                                         \
    restitute_##type##_init_sized(old.type, UP_TO(type, first));                                                       \
    later.type = at_the_end(sizeof *later.type + sizeof(double));                                                      \
    restitute_##type##_init_sized(later.type, sizeof *later.type + sizeof(double));
    STRUCTS(MAKE)
    assert_int_equal(restitute_material_standard_solid(1e6, 3e6, 300, 0.5, &rubber, NULL), RESTITUTE_OK);
    old.impact->psi = 0.5, old.impact->delta1 = 1, old.impact->gamma = 1;
    old.scene->material = rubber, old.scene->radius1 = 0.005, old.scene->mass1 = 0.004;
    old.scene->friction = 0.3, old.scene->normal_speed = 1, old.scene->tangential_speed = 0.5;
    old.history->capacity = 4, old.history->time = samples;
    old.collision->material = rubber, old.collision->friction = 0.3;
    old.body->radius = 0.01, old.body->mass = 4e-3, old.body->position[2] = 0.01, old.body->velocity[2] = -2;
    return 0;
}

static int release(void **state)
{
    (void)state;
    restitute_material_destroy(rubber);
    return 0;
}

#define DONE(call)                                                                                                     \
    do {                                                                                                               \
        const int status_ = (call);                                                                                    \
        CHECK(status_ == RESTITUTE_OK, "%s: %d", #call, status_);                                                      \
    } while (0)

static void sizes_stay(void)
{
#define STAYS(type, first, last) CHECK(old.type->struct_size == UP_TO(type, first), "%s", #type);
    STRUCTS(STAYS)
}

static void an_old_program_is_served(void **state)
{
    restitute_solver *solver;
    restitute_plan *plan;
    restitute_body plane;
    (void)state;
    restitute_body_init(&plane);
    plane.radius = INFINITY, plane.normal[2] = 1;
    DONE(restitute_solver_create(old.options, &solver, NULL));
    DONE(restitute_scene_numbers(old.scene, old.numbers, NULL));
    CHECK(old.numbers->radius == 0.005 && old.numbers->force > 0, "numbers");
    DONE(restitute_solve(solver, old.impact, old.result, old.ledger, old.history, NULL));
    CHECK(old.result->ez > 0 && strcmp(old.result->method, "euler") == 0, "%g", old.result->ez);
    CHECK(old.ledger->rebound_z > 0 && old.ledger->left_x != 0, "ledger");
    CHECK(old.history->count == 4 && samples[3] == old.result->contact_time, "%zu samples", old.history->count);
    DONE(restitute_solve_scene(solver, old.scene, old.result, NULL, NULL, NULL));
    DONE(restitute_solve_many(1, old.impact, old.options, old.result, NULL, NULL));
    DONE(restitute_solve_scene_many(1, old.scene, old.options, old.result, NULL, NULL));
    DONE(restitute_plan_create(old.impact, old.options, &plan, NULL));
    DONE(restitute_plan_solve(plan, 1, old.result, old.ledger, old.history, NULL));
    restitute_plan_destroy(plan);
    DONE(restitute_plan_create_scene(old.scene, old.options, &plan, NULL));
    restitute_plan_destroy(plan);
    DONE(restitute_collide(solver, old.collision, old.body, &plane, old.result, NULL));
    CHECK(old.body->velocity[2] > 0, "%g", old.body->velocity[2]);
    restitute_solver_destroy(solver);
    sizes_stay();
}

static void refused(const char *call, int status, const restitute_error *error)
{
    CHECK(status == RESTITUTE_ERROR_STRUCT_SIZE, "%s: %d", call, status);
    CHECK(strstr(error->message, "compiled with later headers"), "%s: %s", call, error->message);
}

#define REFUSED(call) refused(#call, call, &e)

static void a_later_program_is_refused(void **state)
{
    restitute_error e;
    restitute_solver *solver, *none = NULL;
    restitute_plan *plan = NULL;
    restitute_body plane;
    (void)state;
    restitute_body_init(&plane);
    plane.radius = INFINITY, plane.normal[2] = 1;
    CHECK(later.options->tolerance == 1e-3, "what both know has its default: cleaning up is safe");
    DONE(restitute_solver_create(NULL, &solver, NULL));
    REFUSED(restitute_solver_create(later.options, &none, &e));
    REFUSED(restitute_scene_numbers(later.scene, old.numbers, &e));
    REFUSED(restitute_scene_numbers(old.scene, later.numbers, &e));
    REFUSED(restitute_solve(solver, later.impact, old.result, NULL, NULL, &e));
    REFUSED(restitute_solve(solver, old.impact, later.result, NULL, NULL, &e));
    REFUSED(restitute_solve(solver, old.impact, old.result, later.ledger, NULL, &e));
    REFUSED(restitute_solve(solver, old.impact, old.result, NULL, later.history, &e));
    REFUSED(restitute_solve_scene(solver, later.scene, old.result, NULL, NULL, &e));
    REFUSED(restitute_solve_many(1, later.impact, old.options, old.result, NULL, &e));
    REFUSED(restitute_solve_many(1, old.impact, later.options, old.result, NULL, &e));
    REFUSED(restitute_solve_many(1, old.impact, old.options, later.result, NULL, &e));
    REFUSED(restitute_solve_scene_many(1, later.scene, old.options, old.result, NULL, &e));
    REFUSED(restitute_plan_create(later.impact, NULL, &plan, &e));
    REFUSED(restitute_plan_create(old.impact, later.options, &plan, &e));
    REFUSED(restitute_plan_create_scene(later.scene, NULL, &plan, &e));
    REFUSED(restitute_collide(solver, later.collision, old.body, &plane, NULL, &e));
    REFUSED(restitute_collide(solver, old.collision, later.body, &plane, NULL, &e));
    REFUSED(restitute_collide(solver, old.collision, old.body, later.body, NULL, &e));
    REFUSED(restitute_collide(solver, old.collision, old.body, &plane, later.result, &e));
    CHECK(!none && !plan, "an output was touched");
    restitute_solver_destroy(solver);
}

#ifdef RESTITUTE_WITH_BEM
static void an_old_program_gets_snapshots(void **state)
{
    restitute_bem_recorder *recorder;
    restitute_solver *solver;
    restitute_options options;
    restitute_error e;
    (void)state;
    restitute_options_init(&options);
    DONE(restitute_bem_recorder_create(1, &recorder, NULL));
    options.method = restitute_bem_recorder_method(recorder);
    options.elements = 8, options.tolerance = 0.1;
    DONE(restitute_solver_create(&options, &solver, NULL));
    DONE(restitute_solve(solver, old.impact, NULL, NULL, old.history, NULL));
    DONE(restitute_bem_recorder_get(recorder, 0, old.bem_snapshot, NULL));
    CHECK(old.bem_snapshot->cells > 0 && old.bem_snapshot->stick, "%zu cells", old.bem_snapshot->cells);
    REFUSED(restitute_bem_recorder_get(recorder, 0, later.bem_snapshot, &e));
    restitute_solver_destroy(solver);
    restitute_bem_recorder_destroy(recorder);
    sizes_stay();
}
#endif

#ifdef RESTITUTE_WITH_CVODE
static void an_old_program_gets_events_and_work(void **state)
{
    restitute_cvode_recorder *recorder;
    restitute_solver *solver;
    restitute_options options;
    restitute_cvode_event list[2] = {{0}};
    restitute_error e;
    (void)state;
    restitute_options_init(&options);
    DONE(restitute_cvode_recorder_create(NULL, &recorder, NULL));
    options.method = restitute_cvode_recorder_method(recorder);
    DONE(restitute_solver_create(&options, &solver, NULL));
    DONE(restitute_solve(solver, old.impact, NULL, NULL, NULL, NULL));
    old.cvode_events->capacity = 1, old.cvode_events->event = list;
    DONE(restitute_cvode_recorder_events(recorder, old.cvode_events, NULL));
    DONE(restitute_cvode_recorder_work(recorder, old.cvode_work, NULL));
    CHECK(old.cvode_events->count > 1 && list[0].kind && !list[1].kind && old.cvode_work->steps > 0, "%zu events",
          old.cvode_events->count);
    REFUSED(restitute_cvode_recorder_events(recorder, later.cvode_events, &e));
    REFUSED(restitute_cvode_recorder_work(recorder, later.cvode_work, &e));
    restitute_solver_destroy(solver);
    restitute_cvode_recorder_destroy(recorder);
    sizes_stay();
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(init_names_the_size_of_the_callers_struct),
        cmocka_unit_test(no_struct_has_padding_at_its_tail),
        cmocka_unit_test(an_old_program_is_served),
        cmocka_unit_test(a_later_program_is_refused),
#ifdef RESTITUTE_WITH_BEM
        cmocka_unit_test(an_old_program_gets_snapshots),
#endif
#ifdef RESTITUTE_WITH_CVODE
        cmocka_unit_test(an_old_program_gets_events_and_work),
#endif
    };
    return cmocka_run_group_tests(tests, make_structs, release);
}
