/* What the header promises of batches: the bits of single calls for any number of threads, failures
 * that stop nobody, refusals that touch nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <fenv.h>
#include <string.h>

#include "../support/child.h"
#include "../support/random.h"
#include "../support/solve.h"

enum { MIXED = 2000, FEW = 20 };

static restitute_result fresh_result(void)
{
    restitute_result result;
    memset(&result, 0, sizeof result); /* the padding too: results are compared byte by byte */
    restitute_result_init(&result);
    return result;
}

static void prepare(size_t n, restitute_result *results, int *statuses)
{
    const restitute_result fresh = fresh_result();
    for (size_t i = 0; i < n; i++) {
        memcpy(&results[i], &fresh, sizeof fresh);
        statuses[i] = 99; /* no status has this value */
    }
}

/* Wide and cheap: rough tolerance, and every ninth case is refused. Solids of 0 to 40 terms make a
 * solver's arrays grow. */
static restitute_impact random_impact(const restitute_material *const solids[3], uint64_t *random, int i)
{
    const double gamma = random_log(random, 1e-3, 1e3), delta1 = random_log(random, 1e-3, 100);
    const double psi = random_log(random, 0.05, 10), chi = random_in(random, 0.4, 4);
    restitute_impact impact = impact_of(chi, psi, delta1, gamma);
    if (i % 2 == 0) impact.material = solids[random_below(random, 3)];
    if (i % 9 == 5) impact.psi = i % 18 == 5 ? -1 : NAN;
    return impact;
}

static void one_by_one(const restitute_options *options, size_t n, const restitute_impact *impacts,
                       restitute_result *results, int *statuses)
{
    for (size_t i = 0; i < n; i++) {
        restitute_solver *solver; /* a new one each time, so that no state is kept */
        CHECK(restitute_solver_create(options, &solver, NULL) == RESTITUTE_OK, "solver");
        statuses[i] = restitute_solve(solver, &impacts[i], &results[i], NULL, NULL, NULL);
        restitute_solver_destroy(solver);
    }
}

static void any_number_of_threads_gives_the_bits_of_single_calls(void **state)
{
    (void)state;
    static restitute_impact impacts[MIXED];
    static restitute_result expected[MIXED], results[MIXED];
    static int wanted[MIXED], statuses[MIXED];
    double tau[40], g[40];
    uint64_t random = 11;
    for (int k = 0; k < 40; k++) {
        tau[k] = pow(10, -8 + 0.4 * k);
        g[k] = 1 + k % 3;
    }
    restitute_material *solids[3] = {solid_of(1, 0.1, 3, tau + 18, g), solid_of(0, 0, 1, tau + 16, g),
                                     solid_of(1, 0, 40, tau, g)};
    for (int i = 0; i < MIXED; i++)
        impacts[i] = random_impact((const restitute_material *const *)solids, &random, i);
    restitute_options options = to_tolerance(1e-2);
    options.max_work = 3e-4; /* a few sink for so long that they end with a remark or a refusal */
    prepare(MIXED, expected, wanted);
    one_by_one(&options, MIXED, impacts, expected, wanted);
    int first = 0;
    char name[32];
    while (wanted[first] >= 0)
        first++;
    snprintf(name, sizeof name, "impacts[%d]: ", first);
    const int threads[] = {1, 2, 3, 0, 1024};
    for (int k = 0; k < 5; k++) {
        restitute_error error;
        prepare(MIXED, results, statuses);
        options.threads = threads[k];
        const int status = restitute_solve_many(MIXED, impacts, &options, results, statuses, &error);
        CHECK(status == wanted[first] && strncmp(error.message, name, strlen(name)) == 0, "%d: %s", status,
              error.message);
        CHECK(memcmp(statuses, wanted, sizeof wanted) == 0, "%d threads: other statuses", threads[k]);
        CHECK(memcmp(results, expected, sizeof results) == 0, "%d threads: other bits", threads[k]);
    }
    int sunk = 0, unfinished = 0, refused = 0;
    for (int i = 0; i < MIXED; i++) {
        sunk += wanted[i] == RESTITUTE_NO_REBOUND;
        unfinished += wanted[i] == RESTITUTE_TOLERANCE_NOT_REACHED || wanted[i] == RESTITUTE_ERROR_TOO_MUCH_WORK;
        refused += wanted[i] == RESTITUTE_ERROR_DOMAIN;
    }
    CHECK(sunk > 10 && unfinished > 10 && refused == MIXED / 9, "%d, %d, %d: not the mixture meant", sunk, unfinished,
          refused);
    for (int i = 0; i < 3; i++)
        restitute_material_destroy(solids[i]);
}

/* With a large chi sync begins with finer panels. The run at these is another one if a coarser one
 * was made before it. */
static void solids_alike_under_another_chi_share_no_coarser_run(void **state)
{
    (void)state;
    restitute_options options = to_tolerance(1e-2);
    restitute_impact impacts[2];
    restitute_result expected[2], results[2];
    int wanted[2], statuses[2];
    options.method = restitute_method_sync();
    for (int i = 0; i < 2; i++)
        impacts[i] = impact_of(i == 0 ? 1.7 : 229.3, i == 0 ? 1e6 : 2.3e-7, 0.3, 1);
    prepare(2, expected, wanted);
    prepare(2, results, statuses);
    one_by_one(&options, 2, impacts, expected, wanted);
    CHECK(restitute_solve_many(2, impacts, &options, results, statuses, NULL) == RESTITUTE_OK, "status");
    CHECK(memcmp(results, expected, sizeof results) == 0, "ex %.17g, not %.17g", results[1].ex, expected[1].ex);
}

/* The defaults, with so many threads. */
static const restitute_options *by(int threads)
{
    static restitute_options options;
    restitute_options_init(&options);
    options.threads = threads;
    return &options;
}

static restitute_scene scene_of(const restitute_material *material, double speed)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = material;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.friction = 0.3;
    scene.normal_speed = speed;
    scene.tangential_speed = 1;
    return scene;
}

static void scenes_give_the_bits_of_single_calls(void **state)
{
    (void)state;
    const double tau[] = {1e-4, 1e-2}, g[] = {5e6, 1e6};
    restitute_material *rubber = solid_of(1e6, 0, 2, tau, g), *steel = solid_of(8e10, 0, 0, NULL, NULL);
    restitute_scene scenes[FEW];
    restitute_result results[FEW];
    int statuses[FEW];
    for (int i = 0; i < FEW; i++)
        scenes[i] = scene_of(i % 2 ? rubber : steel, 0.1 * (i + 1));
    prepare(FEW, results, statuses);
    for (int threads = 1; threads <= 3; threads++) {
        restitute_error error;
        const int status = restitute_solve_scene_many(FEW, scenes, by(threads), results, statuses, &error);
        CHECK(status == RESTITUTE_OK && error.status == RESTITUTE_OK && !*error.message, "%s", error.message);
        for (int i = 0; i < FEW; i++) {
            restitute_result single = solve_scene(default_options(), &scenes[i]).result;
            CHECK(statuses[i] == RESTITUTE_OK && memcmp(&results[i].ez, &single.ez, sizeof single.ez) == 0 &&
                      memcmp(&results[i].ex, &single.ex, sizeof single.ex) == 0 &&
                      results[i].contact_time == single.contact_time && results[i].work == single.work &&
                      results[i].flags == single.flags,
                  "scene %d with %d threads", i, threads);
        }
    }
    restitute_material_destroy(rubber);
    restitute_material_destroy(steel);
}

static void failures_stop_nobody_and_the_first_is_named(void **state)
{
    (void)state;
    restitute_material *rubber = solid_of(1e6, 200, 0, NULL, NULL);
    restitute_scene scenes[FEW];
    restitute_result results[FEW];
    const restitute_result fresh = fresh_result();
    int statuses[FEW];
    for (int i = 0; i < FEW; i++)
        scenes[i] = scene_of(rubber, 1);
    scenes[12].normal_speed = -2;
    scenes[7].material = NULL;
    for (int threads = 1; threads <= 3; threads++) {
        restitute_error error;
        prepare(FEW, results, statuses);
        const int status = restitute_solve_scene_many(FEW, scenes, by(threads), results, statuses, &error);
        CHECK(status == RESTITUTE_ERROR_NULL && error.status == status, "status %d", status);
        CHECK(strcmp(error.message, "scenes[7]: scene.material is NULL") == 0, "%s", error.message);
        for (int i = 0; i < FEW; i++) {
            const int wanted = i == 7 ? RESTITUTE_ERROR_NULL : i == 12 ? RESTITUTE_ERROR_DOMAIN : RESTITUTE_OK;
            CHECK(statuses[i] == wanted, "case %d: status %d, not %d", i, statuses[i], wanted);
            if (wanted == RESTITUTE_OK)
                CHECK(results[i].ez > 0 && results[i].ez == results[0].ez, "case %d: ez %g", i, results[i].ez);
            else
                CHECK(memcmp(&results[i], &fresh, sizeof fresh) == 0, "case %d: its result was touched", i);
        }
    }
    restitute_material_destroy(rubber);
}

/* A remark is reported if there is no failure; a later failure replaces it. */
static void remarks_are_told_after_failures(void **state)
{
    (void)state;
    restitute_material *maxwell;
    CHECK(restitute_material_maxwell(1, 0.01, 0.5, &maxwell, NULL) == RESTITUTE_OK, "Maxwell");
    restitute_impact impacts[FEW];
    for (int i = 0; i < FEW; i++)
        impacts[i] = impact_of(7.0 / 6, 0.1 * i, 0.1, 1);
    impacts[3] = impacts[9] = impact_on(maxwell, 7.0 / 6, 1);
    for (int threads = 1; threads <= 3; threads++) {
        restitute_error error;
        impacts[14].psi = 1;
        int status = restitute_solve_many(FEW, impacts, by(threads), NULL, NULL, &error);
        CHECK(status == RESTITUTE_NO_REBOUND && strncmp(error.message, "impacts[3]: ", 12) == 0, "%d: %s", status,
              error.message);
        impacts[14].psi = -1;
        status = restitute_solve_many(FEW, impacts, by(threads), NULL, NULL, NULL);
        CHECK(status == RESTITUTE_ERROR_DOMAIN, "%d", status);
    }
    restitute_material_destroy(maxwell);
}

static void refused_calls_touch_nothing(void **state)
{
    (void)state;
    restitute_impact impacts[3];
    restitute_scene scene;
    restitute_result results[3];
    const restitute_result fresh = fresh_result();
    restitute_options options = default_options();
    restitute_error error;
    int statuses[3];
    for (int i = 0; i < 3; i++)
        impacts[i] = impact_of(7.0 / 6, 1, 0.1, 1);
    prepare(3, results, statuses);
    restitute_scene_init(&scene);
    CHECK(restitute_solve_many(3, NULL, NULL, results, statuses, &error) == RESTITUTE_ERROR_NULL, "impacts");
    CHECK(strcmp(error.message, "impacts is NULL") == 0, "%s", error.message);
    CHECK(restitute_solve_scene_many(3, NULL, NULL, results, statuses, &error) == RESTITUTE_ERROR_NULL, "scenes");
    CHECK(strcmp(error.message, "scenes is NULL") == 0, "%s", error.message);
    for (int threads = -1; threads <= 1025; threads += 1026) {
        CHECK(restitute_solve_many(3, impacts, by(threads), results, statuses, &error) == RESTITUTE_ERROR_DOMAIN,
              "%d threads", threads);
        CHECK(strstr(error.message, "must be in [0, 1024]"), "%s", error.message);
    }
    options.tolerance = 1;
    options.threads = 2;
    CHECK(restitute_solve_many(3, impacts, &options, results, statuses, &error) == RESTITUTE_ERROR_DOMAIN, "options");
    CHECK(strncmp(error.message, "tolerance = 1", 13) == 0, "%s", error.message);
    impacts[0].struct_size = 0; /* not prepared, or of another version: where is impacts[1]? */
    CHECK(restitute_solve_many(3, impacts, NULL, results, statuses, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "size");
    CHECK(strncmp(error.message, "restitute_impact.struct_size = 0", 32) == 0, "%s", error.message);
    scene.struct_size++;
    CHECK(restitute_solve_scene_many(1, &scene, NULL, results, statuses, &error) == RESTITUTE_ERROR_STRUCT_SIZE,
          "size");
    impacts[0].struct_size = sizeof impacts[0];
    impacts[2].struct_size += 8;
    CHECK(restitute_solve_many(3, impacts, NULL, results, statuses, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "size");
    CHECK(strncmp(error.message, "impacts[2].struct_size = ", 25) == 0, "%s", error.message);
    impacts[2].struct_size -= 8;
    for (int i = 0; i < 3; i++)
        CHECK(statuses[i] == 99 && memcmp(&results[i], &fresh, sizeof fresh) == 0, "output %d was touched", i);
    results[1].struct_size += 16; /* it would be written over the next */
    CHECK(restitute_solve_many(3, impacts, NULL, results, statuses, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "size");
    CHECK(strncmp(error.message, "results[1].struct_size = ", 25) == 0, "%s", error.message);
    CHECK(memcmp(&results[2], &fresh, sizeof fresh) == 0, "the next result was touched");
    results[1].struct_size -= 16;
    results[0].struct_size = 1;
    CHECK(restitute_solve_many(3, impacts, NULL, results, statuses, &error) == RESTITUTE_ERROR_STRUCT_SIZE, "size");
    CHECK(statuses[0] == 99 && statuses[2] == 99, "statuses were touched");
}

enum { FORKED = 64 };

struct forked {
    restitute_impact impacts[FORKED];
    restitute_result results[FORKED];
};

static int one_thread_gives_the_same(void *of)
{
    const struct forked *known = of;
    static restitute_result results[FORKED];
    const restitute_options options = to_tolerance(1e-2);
    for (int i = 0; i < FORKED; i++)
        results[i] = fresh_result();
    return restitute_solve_many(FORKED, known->impacts, &options, results, NULL, NULL) == RESTITUTE_OK &&
           memcmp(results, known->results, sizeof results) == 0;
}

/* OpenMP's threads do not exist in a child of the process, which would wait for them for ever; with
 * one thread there is no wait. */
static void a_child_goes_on_with_one_thread(void **state)
{
    (void)state;
    static struct forked known;
    restitute_options options = to_tolerance(1e-2);
    options.threads = 4;
    for (int i = 0; i < FORKED; i++) {
        known.impacts[i] = impact_of(7.0 / 6, 0.05 * i, 1, 1);
        known.results[i] = fresh_result();
    }
    CHECK(restitute_solve_many(FORKED, known.impacts, &options, known.results, NULL, NULL) == RESTITUTE_OK, "batch");
    CHECK(good_in_child(one_thread_gives_the_same, &known), "the child");
}

static void no_cases_are_done_at_once(void **state)
{
    (void)state;
    restitute_options options = default_options();
    restitute_error error;
    options.threads = 3;
    CHECK(restitute_solve_many(0, NULL, by(0), NULL, NULL, &error) == RESTITUTE_OK && !*error.message, "impacts");
    CHECK(restitute_solve_scene_many(0, NULL, &options, NULL, NULL, NULL) == RESTITUTE_OK, "scenes");
    options.elements = 1; /* a wrong option is told all the same */
    CHECK(restitute_solve_scene_many(0, NULL, &options, NULL, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "options");
}

#ifdef FE_UPWARD
/* Threads of a pool were made while rounding was to nearest; the caller's rounding now is
 * another. */
static void threads_round_as_the_caller_does(void **state)
{
    (void)state;
    restitute_impact impacts[FEW];
    restitute_result nearest[FEW], alone[FEW], results[FEW];
    int statuses[FEW];
    for (int i = 0; i < FEW; i++)
        impacts[i] = impact_of(7.0 / 6, 0.1 + 0.3 * i, 0.1, 1);
    prepare(FEW, nearest, statuses);
    prepare(FEW, alone, statuses);
    prepare(FEW, results, statuses);
    CHECK(restitute_solve_many(FEW, impacts, by(3), nearest, NULL, NULL) == RESTITUTE_OK, "to nearest");
    CHECK(fesetround(FE_UPWARD) == 0, "rounding");
    const int one = restitute_solve_many(FEW, impacts, NULL, alone, NULL, NULL);
    const int three = restitute_solve_many(FEW, impacts, by(3), results, NULL, NULL);
    fesetround(FE_TONEAREST);
    CHECK(one == RESTITUTE_OK && three == RESTITUTE_OK, "%d %d", one, three);
    CHECK(memcmp(alone, results, sizeof alone) == 0, "the threads do not round as the caller does");
    CHECK(memcmp(alone, nearest, sizeof alone) != 0, "rounding changes nothing: the check above could not fail");
    prepare(FEW, results, statuses);
    CHECK(restitute_solve_many(FEW, impacts, by(3), results, NULL, NULL) == RESTITUTE_OK, "to nearest again");
    CHECK(memcmp(nearest, results, sizeof nearest) == 0, "the threads keep a rounding that was not theirs");
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_alike_under_another_chi_share_no_coarser_run),
        cmocka_unit_test(any_number_of_threads_gives_the_bits_of_single_calls),
        cmocka_unit_test(scenes_give_the_bits_of_single_calls),
        cmocka_unit_test(failures_stop_nobody_and_the_first_is_named),
        cmocka_unit_test(remarks_are_told_after_failures),
        cmocka_unit_test(refused_calls_touch_nothing),
        cmocka_unit_test(a_child_goes_on_with_one_thread),
        cmocka_unit_test(no_cases_are_done_at_once),
#ifdef FE_UPWARD
        cmocka_unit_test(threads_round_as_the_caller_does),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
