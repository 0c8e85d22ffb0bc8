/* Threads use at once what they may share: a material, a table, a contact law and its rates. Each
 * has solvers of its own, of every method; a plan goes from hand to hand. All get the bits that one
 * thread alone gets. Under ThreadSanitizer (tests/memory/run tsan) this shows races.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "../support/solve.h"
#include <restitute/bem.h>
#include <restitute/contact.h>
#include <restitute/cvode.h>
#include <restitute/fit.h>
#include <restitute/table.h>

enum { threads = 6, rounds = 3, most_numbers = 4096 };

/* What all threads share. */
static struct {
    pthread_barrier_t begin;
    pthread_mutex_t lock; /* of the plan, which one thread at a time may use */
    restitute_material *rubber;
    restitute_scene scene;
    restitute_plan *plan;
    restitute_contact_law *law;
    restitute_contact_rates rates;
    restitute_table *table;
} shared;

/* cmocka fails in its own thread alone: a job keeps its worst status. */
struct job {
    size_t count;
    double number[most_numbers];
    int worst;
    restitute_error error, why;
};

static void give(struct job *job, double number)
{
    if (job->count < most_numbers) job->number[job->count++] = number;
}

static void must(struct job *job, int status)
{
    if (status < job->worst) job->worst = status, job->why = job->error;
}

static void solve_by(struct job *job, const restitute_method *method, double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    restitute_solver *solver = NULL;
    restitute_result result;
    restitute_ledger ledger;
    options.method = method;
    restitute_result_init(&result);
    restitute_ledger_init(&ledger);
    must(job, restitute_solver_create(&options, &solver, &job->error));
    for (int i = 0; i < 2 && solver; i++) {
        must(job, restitute_solve_scene(solver, &shared.scene, &result, &ledger, NULL, &job->error));
        give(job, result.ez);
        give(job, result.ex);
    }
    restitute_solver_destroy(solver);
}

static void core(struct job *job)
{
    restitute_impact impacts[5];
    restitute_result results[5], result;
    restitute_options options = to_tolerance(1e-3);
    solve_by(job, restitute_method_euler(), 1e-3);
    solve_by(job, restitute_method_sync(), 1e-5);
    options.threads = 2; /* OpenMP within a thread of POSIX */
    for (int i = 0; i < 5; i++) {
        impacts[i] = impact_of(7.0 / 6, 0.3 * i, 1, 1);
        restitute_result_init(&results[i]);
    }
    must(job, restitute_solve_many(5, impacts, &options, results, NULL, &job->error));
    give(job, results[4].ex);
    restitute_result_init(&result);
    pthread_mutex_lock(&shared.lock);
    must(job, restitute_plan_solve(shared.plan, 0.4, &result, NULL, NULL, &job->error));
    pthread_mutex_unlock(&shared.lock);
    give(job, result.ex);
}

static void contact_and_table(struct job *job)
{
#ifdef RESTITUTE_WITH_CONTACT
    double state[48] = {0};
    restitute_contact_motion motion;
    restitute_contact_force force;
    restitute_contact_motion_init(&motion);
    motion.radius = 0.01;
    motion.friction = 0.3;
    motion.velocity[0] = motion.velocity[2] = 1e-2;
    for (int i = 1; i <= 40; i++) {
        motion.overlap = 1e-7 * i;
        must(job, restitute_contact_step(shared.law, &shared.rates, &motion, state, &force, &job->error));
        give(job, force.normal + force.tangential[0]);
    }
#endif
#ifdef RESTITUTE_WITH_TABLE
    restitute_table *own = NULL;
    restitute_table_options options;
    double ez, ex;
    for (int i = 1; i <= 40; i++) {
        must(job, restitute_table_pair(shared.table, NULL, 0.003 * i, 0.01 * i, &ez, &ex, &job->error));
        give(job, ez + ex);
    }
    restitute_table_options_init(&options);
    options.speed[0] = options.speed[1] = 0.1;
    options.tolerance = 1e-2;
    options.threads = 2;
    must(job, restitute_table_build(&shared.scene, &options, &own, &job->error));
    must(job, restitute_table_pair(own, NULL, 0.1, 0.1, &ez, &ex, &job->error));
    give(job, ez + ex);
    restitute_table_destroy(own);
#endif
    (void)job;
}

static void other_methods(struct job *job)
{
#ifdef RESTITUTE_WITH_CVODE
    solve_by(job, restitute_method_cvode(), 1e-2);
#endif
#ifdef RESTITUTE_WITH_BEM
    solve_by(job, restitute_method_bem(), 1e-2);
#endif
#ifdef RESTITUTE_WITH_FIT
    restitute_fit_point points[3];
    restitute_fit_options options;
    restitute_fit_result result;
    restitute_scene scenes[3];
    restitute_fit_options_init(&options);
    restitute_fit_result_init(&result);
    options.model = RESTITUTE_FIT_MODEL_KELVIN_VOIGT;
    options.starts = 1;
    options.threads = 2;
    for (int i = 0; i < 3; i++) {
        restitute_fit_point_init(&points[i]);
        scenes[i] = shared.scene;
        scenes[i].material = NULL;
        scenes[i].tangential_speed = 0;
        scenes[i].normal_speed = 0.1 * (i + 1);
        points[i].scene = &scenes[i];
        points[i].ez = 0.9 - 0.05 * i;
        points[i].contact_time = 1e-3 * (3 - 0.3 * i);
    }
    must(job, restitute_fit(3, points, &options, &result, &job->error));
    give(job, result.value[0]);
    restitute_material_destroy(result.material);
#endif
    (void)job;
}

static void *work(void *data)
{
    struct job *job = data;
    pthread_barrier_wait(&shared.begin);
    for (int i = 0; i < rounds; i++) {
        core(job);
        contact_and_table(job);
        if (i == 0) other_methods(job);
    }
    return NULL;
}

static void share(void)
{
    restitute_error error;
    restitute_options options = to_tolerance(1e-4);
    CHECK(restitute_material_standard_solid(1e6, 3e6, 300, 0.5, &shared.rubber, &error) == 0, "%s", error.message);
    restitute_scene_init(&shared.scene);
    shared.scene.material = shared.rubber;
    shared.scene.radius1 = 0.005;
    shared.scene.mass1 = 0.004;
    shared.scene.friction = 0.3;
    shared.scene.normal_speed = shared.scene.tangential_speed = 0.1;
    options.method = restitute_method_sync();
    CHECK(restitute_plan_create_scene(&shared.scene, &options, &shared.plan, &error) == 0, "%s", error.message);
#ifdef RESTITUTE_WITH_CONTACT
    CHECK(restitute_contact_law_create(shared.rubber, NULL, &shared.law, &error) == 0, "%s", error.message);
    assert_int_equal(restitute_contact_law_state_size(shared.law), 48);
    restitute_contact_rates_init(&shared.rates);
    CHECK(restitute_contact_rates_set(shared.law, 1e-5, &shared.rates, &error) == 0, "%s", error.message);
#endif
#ifdef RESTITUTE_WITH_TABLE
    restitute_table_options of_table;
    restitute_table_options_init(&of_table);
    of_table.speed[0] = 0.01;
    of_table.speed[1] = 0.1;
    of_table.tolerance = 1e-3;
    of_table.threads = 2;
    CHECK(restitute_table_build(&shared.scene, &of_table, &shared.table, &error) == 0, "%s", error.message);
#endif
}

static void threads_share_what_they_may(void **state)
{
    static struct job alone, job[threads];
    pthread_t thread[threads];
    (void)state;
    share();
    pthread_mutex_init(&shared.lock, NULL);
    pthread_barrier_init(&shared.begin, NULL, 1);
    work(&alone);
    pthread_barrier_destroy(&shared.begin);
    CHECK(alone.worst == 0, "alone: %s", alone.why.message);
    CHECK(alone.count > 3 && alone.count < most_numbers, "%zu numbers", alone.count);
    pthread_barrier_init(&shared.begin, NULL, threads);
    for (int i = 0; i < threads; i++)
        CHECK(pthread_create(&thread[i], NULL, work, &job[i]) == 0, "thread %d", i);
    for (int i = 0; i < threads; i++)
        pthread_join(thread[i], NULL);
    pthread_barrier_destroy(&shared.begin);
    pthread_mutex_destroy(&shared.lock);
    for (int i = 0; i < threads; i++) {
        CHECK(job[i].worst == 0, "thread %d: %s", i, job[i].why.message);
        CHECK(job[i].count == alone.count && memcmp(job[i].number, alone.number, sizeof alone.number) == 0,
              "thread %d differs", i);
    }
#ifdef RESTITUTE_WITH_TABLE
    restitute_table_destroy(shared.table);
#endif
#ifdef RESTITUTE_WITH_CONTACT
    restitute_contact_law_destroy(shared.law);
#endif
    restitute_plan_destroy(shared.plan);
    restitute_material_destroy(shared.rubber);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_share_what_they_may)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
