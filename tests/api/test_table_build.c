/* Building: the same bits for any number of threads, seams, many tables at once, refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../support/child.h"
#include "../support/table.h"

static int same_bits(const restitute_table *a, const restitute_table *b)
{
    const restitute_table_data of_a = data_of(a), of_b = data_of(b), *x = &of_a, *y = &of_b;
    const size_t n = (size_t)x->speeds, size = sizeof(double);
    return x->speeds == y->speeds && places_of(x) == places_of(y) && memcmp(x->speed, y->speed, n * size) == 0 &&
           memcmp(x->ez, y->ez, 2 * n * size) == 0 && memcmp(x->strain, y->strain, 4 * n * size) == 0 &&
           memcmp(x->ex, y->ex, 4 * n * (size_t)places_of(x) * size) == 0 && x->error_ez == y->error_ez &&
           x->error_ex == y->error_ex && x->impacts == y->impacts && x->checks == y->checks;
}

static void threads_give_the_same_bits(void **state)
{
    restitute_material *material;
    (void)state;
    const restitute_scene scene = ball_on(0.3, &material);
    restitute_table *tables[3];
    for (int i = 0; i < 3; i++) {
        const restitute_table_options options = options_of(i + 1);
        tables[i] = built(&scene, &options);
    }
    CHECK(same_bits(tables[0], tables[1]) && same_bits(tables[0], tables[2]), "one, two and three threads");
    for (int i = 0; i < 3; i++)
        restitute_table_destroy(tables[i]);
    restitute_material_destroy(material);
}

struct forked {
    restitute_scene scene;
    restitute_table *table;
};

static int one_thread_gives_the_same(void *of)
{
    const struct forked *known = of;
    const restitute_table_options options = options_of(1);
    restitute_table *table = NULL;
    const int same =
        restitute_table_build(&known->scene, &options, &table, NULL) == RESTITUTE_OK && same_bits(table, known->table);
    restitute_table_destroy(table);
    return same;
}

/* As of batches: the threads of a build are not there in a child of the process. */
static void a_child_goes_on_with_one_thread(void **state)
{
    restitute_material *material;
    const restitute_table_options options = options_of(4);
    (void)state;
    struct forked known = {.scene = ball_on(0.3, &material)};
    known.table = built(&known.scene, &options);
    CHECK(good_in_child(one_thread_gives_the_same, &known), "the child");
    restitute_table_destroy(known.table);
    restitute_material_destroy(material);
}

static void the_material_may_go(void **state)
{
    restitute_material *material;
    const restitute_table_options options = options_of(1);
    (void)state;
    const restitute_scene scene = ball_on(1, &material);
    restitute_table *table = built(&scene, &options);
    restitute_material_destroy(material);
    CHECK(look_up(table, 1, 1).ez > 0, "a lookup without the material");
    restitute_table_destroy(table);
}

/* A range of some ulps is a range: it is built, and every cell in it was compared with impacts. */
static void narrow_ranges(void **state)
{
    static const double low[] = {1e-50, 3e-4, 0.1, 1, 1000};
    restitute_material *material;
    (void)state;
    const restitute_scene scene = ball_on(1, &material);
    for (size_t i = 0; i < sizeof low / sizeof *low; i++)
        for (int wide = 0; wide < 3; wide++) {
            restitute_table_options options = options_of(1);
            options.speed[0] = low[i];
            options.speed[1] = wide ? low[i] * (1 + (wide == 1 ? 1e-12 : 1e-6)) : nextafter(low[i], INFINITY);
            restitute_table *table = built(&scene, &options);
            const restitute_table_info info = describe(table);
            CHECK(info.checks > 0 && info.error_ex > 0 && info.error_ex <= options.tolerance, "from %g on: %g", low[i],
                  info.error_ex);
            CHECK(info.speed[0] == options.speed[0] && info.speed[1] == options.speed[1], "from %g on", low[i]);
            restitute_table_destroy(table);
        }
    restitute_material_destroy(material);
}

/* psi_c is 1 within rounding: there is no panel of slip, and e_x stays continuous. */
static void hardly_any_partial_slip(void **state)
{
    restitute_material *material;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-5);
    const restitute_table_options options = options_of(1);
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, NULL), RESTITUTE_OK);
    for (int i = 0; i < 3; i++) {
        const double share = i == 0 ? 0 : i == 1 ? 1e-13 : 1e-8; /* 2 chi - 1 */
        scene.inertia1 = scene.mass1 * scene.radius1 * scene.radius1 / (1.5 * (1 + share) - 1);
        restitute_table *table = built(&scene, &options);
        CHECK(describe(table).slip_cells == 1 || share > 1e-9, "%lld cells", (long long)describe(table).slip_cells);
        for (int k = -3; k <= 3; k++) {
            restitute_result r;
            restitute_result_init(&r);
            scene.normal_speed = 0.3, scene.tangential_speed = (1 + 1e-8 * k) * 0.3 / PSI_FACTOR;
            assert_int_equal(restitute_solve_scene(solver, &scene, &r, NULL, NULL, NULL), RESTITUTE_OK);
            CHECK_NEAR(look_up(table, 0.3, scene.tangential_speed).ex, r.ex, options.tolerance + r.error_ex,
                       "2 chi - 1 = %g, %d", share, k);
        }
        restitute_table_destroy(table);
    }
    restitute_solver_destroy(solver);
    restitute_material_destroy(material);
}

/* The numbers of a table make the same table; others are refused, and named. */
static void data_makes_the_same_table(void **state)
{
    restitute_material *material;
    restitute_error error;
    const restitute_table_options options = options_of(1);
    (void)state;
    const restitute_scene scene = ball_on(1, &material);
    restitute_table *table = built(&scene, &options), *copy = NULL;
    const restitute_table_data good = data_of(table);
    CHECK(restitute_table_create(&good, &copy, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(same_bits(table, copy), "the copy");
    static const char *const words[] = {"speeds = 1: must be in [2, 32768]",
                                        "stick_cells = 0",
                                        "slip_cells = 1048576",
                                        "terms = -1",
                                        "chi = nan: must be in [0.3, 1000]",
                                        "psi_factor = -1",
                                        "low = 0",
                                        "speed[1] = ",
                                        "ez[0] = nan",
                                        "to 10: must rise, and cover 0.01 to 11",
                                        "data.ex is NULL",
                                        "data.modulus is NULL",
                                        "duration = 0: must be in [1e-120",
                                        "relaxation_time[0] = 0: must be in [1e-30"};
    for (int i = 0; i < 14; i++) {
        restitute_table_data d = good;
        restitute_table *none = NULL;
        double turned[2] = {good.speed[1], good.speed[0]}, wild[2] = {NAN, 0};
        if (i == 0) d.speeds = 1;
        if (i == 1) d.stick_cells = 0;
        if (i == 2) d.slip_cells = 1 << 20;
        if (i == 3) d.terms = -1;
        if (i == 4) d.chi = NAN;
        if (i == 5) d.psi_factor = -1;
        if (i == 6) d.low = 0;
        if (i == 7) d.speeds = 2, d.speed = turned;
        if (i == 8) d.ez = wild;
        if (i == 9) d.high = 11;
        if (i == 10) d.ex = NULL;
        if (i == 11) d.modulus = NULL;
        if (i == 12) d.duration = 0;
        if (i == 13) d.relaxation_time = wild + 1;
        const int expected = i != 10 && i != 11 ? RESTITUTE_ERROR_DOMAIN : RESTITUTE_ERROR_NULL;
        CHECK(restitute_table_create(&d, &none, &error) == expected && !none, "%d: %s", i, error.message);
        CHECK(strstr(error.message, words[i]), "\"%s\" does not say \"%s\"", error.message, words[i]);
    }
    const size_t count = 4 * (size_t)good.speeds * (size_t)places_of(&good), size = count * sizeof(double);
    double *ex = malloc(size);
    restitute_table_data last = good;
    memcpy(ex, good.ex, size);
    ex[count - 1] = NAN, last.ex = ex;
    restitute_table *none = NULL;
    CHECK(restitute_table_create(&last, &none, &error) == RESTITUTE_ERROR_DOMAIN && !none, "%s", error.message);
    CHECK(strstr(error.message, "ex[") && strstr(error.message, "nan"), "%s", error.message);
    free(ex);
    restitute_table_destroy(table);
    restitute_table_destroy(copy);
    restitute_material_destroy(material);
}

/* A Maxwell body: below some speed the sphere sinks. There e_z = 0, above it e_z rises from 0, and
 * the table says where. */
static void rebound_begins_at_a_seam(void **state)
{
    restitute_material *maxwell;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-4);
    restitute_table_options options = options_of(1);
    restitute_error error;
    (void)state;
    restitute_scene scene = ball_on(1, &maxwell);
    restitute_material_destroy(maxwell);
    assert_int_equal(restitute_material_maxwell(1e6, 600, 0.5, &maxwell, &error), RESTITUTE_OK);
    scene.material = maxwell;
    options.speed[0] = 1e-3, options.speed[1] = 100, options.tolerance = 1e-2;
    restitute_table *table = built(&scene, &options);
    const restitute_table_info info = describe(table);
    CHECK(info.rebound_speed > 2e-3 && info.rebound_speed < 50, "rebound from %g m/s on", info.rebound_speed);
    CHECK(look_up(table, 0.9 * info.rebound_speed, 0).ez == 0, "below it");
    CHECK(look_up(table, 4 * info.rebound_speed, 0).ez > 0, "above it");
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, &error), RESTITUTE_OK);
    for (int i = 0; i < 2; i++) { /* of the impacts themselves one sinks, one rebounds */
        restitute_result result;
        restitute_result_init(&result);
        scene.normal_speed = (i ? 2 : 0.5) * info.rebound_speed;
        const int status = restitute_solve_scene(solver, &scene, &result, NULL, NULL, &error);
        CHECK(i ? result.ez > 0 : status == RESTITUTE_NO_REBOUND, "%g m/s: status %d", scene.normal_speed, status);
    }
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(maxwell);
}

/* With chi < 1/2 friction cannot stop it. */
static void what_sinks_may_slide_on(void **state)
{
    restitute_material *maxwell;
    restitute_solver *solver;
    restitute_options precise = to_tolerance(1e-6);
    restitute_table_options options = options_of(1);
    restitute_error error;
    double least = 0;
    (void)state;
    restitute_scene scene = ball_on(1, &maxwell);
    restitute_material_destroy(maxwell);
    assert_int_equal(restitute_material_maxwell(1e6, 0.2, 0.5, &maxwell, &error), RESTITUTE_OK);
    scene.material = maxwell;
    scene.rotation_blocked = 1;
    options.speed[0] = 1e-3, options.speed[1] = 1, options.tolerance = 1e-3;
    restitute_table *table = built(&scene, &options);
    const restitute_table_info info = describe(table);
    precise.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&precise, &solver, &error), RESTITUTE_OK);
    for (int i = 1; i < 20; i++) {
        restitute_result result;
        restitute_result_init(&result);
        scene.normal_speed = 0.1, scene.tangential_speed = 0.01 * i;
        CHECK(restitute_solve_scene(solver, &scene, &result, NULL, NULL, &error) == RESTITUTE_NO_REBOUND, "%s",
              error.message);
        const struct pair pair = look_up(table, scene.normal_speed, scene.tangential_speed);
        CHECK(pair.ez == 0, "ez %g", pair.ez);
        CHECK_NEAR(pair.ex, result.ex, info.error_ex, "ex at %g m/s", scene.tangential_speed);
        least = fmin(least, pair.ex);
    }
    CHECK(least < -0.1, "ex is at least %g", least);
    restitute_solver_destroy(solver);
    restitute_table_destroy(table);
    restitute_material_destroy(maxwell);
}

static size_t calls;

static void count_calls(void *data, size_t done, size_t count)
{
    CHECK(data == &calls && done == calls + 1 && count == 3, "%zu of %zu", done, count);
    calls = done;
}

static void many_tables_at_once(void **state)
{
    restitute_material *rubber, *other, *unlike;
    restitute_table *tables[3] = {NULL, NULL, NULL};
    restitute_error error;
    const restitute_table_options options = options_of(2), alone = options_of(1);
    (void)state;
    restitute_scene scene = ball_on(1, &rubber);
    ball_on(0, &other);
    const restitute_material *materials[2] = {rubber, other};
    calls = 0;
    CHECK(restitute_table_build_many(2, materials, &scene, &options, count_calls, &calls, tables, &error) ==
              RESTITUTE_OK,
          "%s", error.message);
    assert_int_equal(calls, 3);
    assert_int_equal(restitute_material_effective(rubber, other, &unlike, NULL), RESTITUTE_OK);
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    restitute_table *first = built(&scene, &alone);
    scene.deformable = RESTITUTE_ONE_BODY_DEFORMS, scene.material = unlike;
    restitute_table *second = built(&scene, &alone);
    CHECK(same_bits(tables[0], first) && same_bits(tables[1], second), "tables one by one");
    for (int i = 0; i < 3; i++)
        restitute_table_destroy(tables[i]);
    tables[0] = NULL;
    scene.radius1 = -1;
    calls = 0; /* the first fails; others are not begun */
    assert_int_equal(restitute_table_build_many(2, materials, &scene, &alone, count_calls, &calls, tables, &error),
                     RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "materials[0] and [0]: ") && strstr(error.message, "radius1"), "%s", error.message);
    assert_null(tables[0]);
    assert_int_equal(calls, 1);
    assert_int_equal(restitute_table_build_many(0, materials, &scene, &options, NULL, NULL, tables, &error),
                     RESTITUTE_ERROR_DOMAIN);
    for (int i = 1; i >= 0; i--) {
        materials[i] = NULL;
        assert_int_equal(restitute_table_build_many(2, materials, &scene, &options, NULL, NULL, tables, &error),
                         RESTITUTE_ERROR_NULL);
        CHECK(strstr(error.message, i ? "materials[1]" : "materials[0]"), "%s", error.message);
    }
    restitute_table_destroy(first);
    restitute_table_destroy(second);
    restitute_material_destroy(unlike);
    restitute_material_destroy(rubber);
    restitute_material_destroy(other);
}

/* A table that impacts do not suffice for is honest about it. */
static void few_impacts_give_an_honest_table(void **state)
{
    restitute_material *material;
    restitute_table *table = NULL;
    restitute_error error;
    restitute_table_options options = options_of(1);
    (void)state;
    const restitute_scene scene = ball_on(0.05, &material);
    options.speed[0] = 1e-4, options.speed[1] = 100;
    options.tolerance = 1e-6, options.max_impacts = 1000;
    assert_int_equal(restitute_table_build(&scene, &options, &table, &error), RESTITUTE_TOLERANCE_NOT_REACHED);
    const restitute_table_info info = describe(table);
    CHECK(info.error_ex > 1e-6 && strstr(error.message, "tolerance = 1e-06"), "%s", error.message);
    CHECK(info.impacts < 1500, "%lld impacts", (long long)info.impacts);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

/* What the tolerance takes, and a quarter for other rounding: columns and cells of psi that are not
 * needed cost more, and cells of psi that are missing cannot be made up for by columns. */
static void no_table_costs_more_than_it_needs(void **state)
{
    static const struct {
        int elastic; /* a spring alone, with nu = 0; or the Kelvin-Voigt solid of ball_on */
        double tolerance;
        long long impacts;
    } cases[] = {{1, 1e-5, 197}, {0, 1e-4, 634}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        restitute_material *material;
        restitute_scene scene = ball_on(0, &material);
        if (cases[i].elastic) {
            restitute_material_destroy(material);
            restitute_material_elastic(1e6, 0, &material, NULL);
            scene.material = material;
        }
        restitute_table *table = table_of(&scene, 0.01, 10, cases[i].tolerance);
        const long long impacts = describe(table).impacts;
        CHECK(4 * impacts <= 5 * cases[i].impacts, "%zu: %lld impacts", i, impacts);
        restitute_table_destroy(table);
        restitute_material_destroy(material);
    }
}

/* Where a sphere hardly rebounds, an impact may fail: its cell stays as wide as it is. */
static void a_column_without_a_solution_is_left_out(void **state)
{
    restitute_material *material;
    restitute_table *table = NULL;
    restitute_error error;
    restitute_table_options options = options_of(1);
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    restitute_material_destroy(material);
    restitute_material_standard_solid(10, 1e6, 100 * sqrt(10), 0.5, &material, NULL);
    scene.material = material;
    options.max_impacts = 1000;
    CHECK(restitute_table_build(&scene, &options, &table, &error) >= 0, "%s", error.message);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

/* With chi = 50, where 20 s do not suffice, the build ends after a second or so. Ten: machines are
 * slow, and its last checks cannot be cut short. Sanitizers take up to ten times as long (16 s were
 * seen), and so does a build without limit. */
#ifdef RESTITUTE_SANITIZED
enum { most_seconds = 100 };
#else
enum { most_seconds = 10 };
#endif

static void a_limit_of_time_is_kept(void **state)
{
    restitute_material *material;
    restitute_table *table = NULL;
    restitute_error error;
    restitute_table_options options;
    (void)state;
    restitute_scene scene = ball_on(0.05, &material);
    restitute_table_options_init(&options);
    options.time_limit = 1;
    scene.inertia1 = scene.mass1 * scene.radius1 * scene.radius1 / 149;
    const clock_t start = clock();
    assert_int_equal(restitute_table_build(&scene, &options, &table, &error), RESTITUTE_TOLERANCE_NOT_REACHED);
    const double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
    CHECK(taken < most_seconds, "%g s", taken);
    CHECK(describe(table).error_ex > 1e-5 && strstr(error.message, "time_limit = 1 s"), "%s", error.message);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

static void refuse(const restitute_scene *scene, const restitute_table_options *options, int status, const char *text)
{
    restitute_table *table = NULL;
    restitute_error error;
    CHECK(restitute_table_build(scene, options, &table, &error) == status, "%s: %s", text, error.message);
    CHECK(strstr(error.message, text) && !table, "\"%s\" does not say \"%s\"", error.message, text);
}

/* Relaxation times over four decades. */
static restitute_material *series_of(size_t terms)
{
    double tau[300], g[300];
    restitute_material *series;
    for (size_t i = 0; i < terms; i++)
        tau[i] = 1e-5 * pow(1e4, (double)i / (double)terms), g[i] = 1e6 / (double)terms;
    assert_int_equal(restitute_material_prony(1e5, 0, terms, tau, g, 0.5, &series, NULL), RESTITUTE_OK);
    return series;
}

static void many_terms_may_take_more_work(void **state)
{
    restitute_material *material, *const series = series_of(300);
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    scene.material = series;
    restitute_table *const table = table_of(&scene, 0.1, 0.1, 1e-4);
    CHECK(data_of(table).error_ex <= 1e-4, "%g", data_of(table).error_ex);
    restitute_table_destroy(table);
    restitute_material_destroy(series);
    restitute_material_destroy(material);
}

static void refusals(void **state)
{
    restitute_material *material;
    (void)state;
    restitute_scene scene = ball_on(0, &material);
    const restitute_table_options good = options_of(1);
    restitute_table_options options = good;
    options.speed[0] = 0;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = 0");
    options.speed[0] = NAN;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = nan");
    options.speed[0] = 20;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "speed (m/s) = 20 to 10");
    options.speed[0] = 1e-15;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "highest over lowest must be <= 1e+15");
    options = good, options.max_impacts = 0;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "max_impacts = 0");
    options = good, options.tolerance = 1e-9;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "tolerance");
    options = good, options.threads = -1;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "threads");
    options = good, options.time_limit = 0;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "time_limit (s) = 0");
    options = good, options.radius_limit = NAN;
    refuse(&scene, &options, RESTITUTE_ERROR_DOMAIN, "radius_limit");
    options = good, options.max_impacts = 100;
    refuse(&scene, &options, RESTITUTE_ERROR_TOO_MUCH_WORK, "max_impacts = 100");
    scene.inertia1 = 1e-11; /* of 4e-8 */
    refuse(&scene, &good, RESTITUTE_ERROR_DOMAIN, "chi = 3");
    scene.inertia1 = 0;
    options = good, options.struct_size = 8;
    refuse(&scene, &options, RESTITUTE_ERROR_STRUCT_SIZE, "struct_size");
    scene.friction = -0.1;
    refuse(&scene, &good, RESTITUTE_ERROR_DOMAIN, "friction");
    scene.friction = 0.3, scene.radius1 = NAN;
    refuse(&scene, &good, RESTITUTE_ERROR_DOMAIN, "radius1");
    refuse(NULL, &good, RESTITUTE_ERROR_NULL, "scene");
    /* each impact is dearer than one of a table may be: no column is there, and so no table */
    restitute_material *const series = series_of(30);
    options = good, options.tolerance = 1e-7;
    scene.radius1 = 0.005, scene.material = series, scene.inertia1 = 4e-9;
    refuse(&scene, &options, RESTITUTE_ERROR_TOO_MUCH_WORK, "too much work");
    restitute_material_destroy(series);
    restitute_error error;
    const restitute_material *const materials[] = {material};
    assert_int_equal(restitute_table_build_many(1, materials, &scene, &good, NULL, NULL, NULL, &error),
                     RESTITUTE_ERROR_NULL);
    assert_string_equal(error.message, "tables is NULL");
    restitute_material_destroy(material);
}

/* Nonzero once it was asked so often. */
static int asked_enough(void *data)
{
    int *left = data;
    return --*left <= 0;
}

static void an_interrupted_build_ends_at_once(void **state)
{
    restitute_material *material;
    restitute_error error;
    restitute_table_options options = options_of(1);
    (void)state;
    restitute_scene scene = ball_on(0.05, &material);
    options.interrupted = asked_enough;
    for (int often = 1; often < 20; often = 3 * often) { /* at the start, in refinement */
        restitute_table *table = NULL;
        int left = often;
        options.interrupted_data = &left;
        assert_int_equal(restitute_table_build(&scene, &options, &table, &error), RESTITUTE_ERROR_INTERRUPTED);
        CHECK(!table && strstr(error.message, "interrupted"), "%s", error.message);
    }
    restitute_material_destroy(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(an_interrupted_build_ends_at_once),
                                       cmocka_unit_test(threads_give_the_same_bits),
                                       cmocka_unit_test(a_child_goes_on_with_one_thread),
                                       cmocka_unit_test(the_material_may_go),
                                       cmocka_unit_test(narrow_ranges),
                                       cmocka_unit_test(hardly_any_partial_slip),
                                       cmocka_unit_test(data_makes_the_same_table),
                                       cmocka_unit_test(rebound_begins_at_a_seam),
                                       cmocka_unit_test(what_sinks_may_slide_on),
                                       cmocka_unit_test(many_tables_at_once),
                                       cmocka_unit_test(few_impacts_give_an_honest_table),
                                       cmocka_unit_test(a_column_without_a_solution_is_left_out),
                                       cmocka_unit_test(no_table_costs_more_than_it_needs),
                                       cmocka_unit_test(a_limit_of_time_is_kept),
                                       cmocka_unit_test(many_terms_may_take_more_work),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
