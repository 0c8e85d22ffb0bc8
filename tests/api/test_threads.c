/* Threads use at once what they may share: a material, a table, a contact law and its rates. Each
 * has solvers of its own, of every method; a plan goes from hand to hand. All get the bits that one
 * thread alone gets. Under ThreadSanitizer (tests/memory/run tsan) this shows races.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "../support/fit.h"
#include "../support/table.h"
#include <restitute/bem.h>
#include <restitute/contact.h>
#include <restitute/cvode.h>

enum { threads = 6, rounds = 3, most_numbers = 1024 };

/* What all threads share. */
static struct {
    pthread_barrier_t begin;
    pthread_mutex_t lock; /* of the plan, which one thread at a time may use */
    restitute_scene scene;
    restitute_plan *plan;
    restitute_contact_law *law;
    restitute_contact_rates rates;
    restitute_table *table;
} shared;

/* What a thread computed. A check that fails in it ends the program. */
struct job {
    size_t count;
    double number[most_numbers];
};

static _Thread_local restitute_error error;
#define MUST(call) CHECK((call) >= 0, "%s", error.message)

static void give(struct job *job, double number)
{
    CHECK(job->count < most_numbers, "too many numbers");
    job->number[job->count++] = number;
}

static void solve_by(struct job *job, const restitute_method *method, double tolerance)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = method;
    const struct solution s = solve_scene(options, &shared.scene);
    give(job, s.result.ez);
    give(job, s.result.ex);
}

static void core(struct job *job)
{
    restitute_impact impacts[5];
    restitute_result results[5];
    PREPARED(result, result);
    restitute_options options = to_tolerance(1e-3);
    solve_by(job, restitute_method_euler(), 1e-3);
    solve_by(job, restitute_method_sync(), 1e-5);
    options.threads = 2; /* OpenMP within a thread of POSIX */
    for (int i = 0; i < 5; i++) {
        impacts[i] = impact_of(7.0 / 6, 0.3 * i, 1, 1);
        restitute_result_init(&results[i]);
    }
    MUST(restitute_solve_many(5, impacts, &options, results, NULL, &error));
    give(job, results[4].ex);
    pthread_mutex_lock(&shared.lock);
    MUST(restitute_plan_solve(shared.plan, 0.4, &result, NULL, NULL, &error));
    pthread_mutex_unlock(&shared.lock);
    give(job, result.ex);
}

#ifdef RESTITUTE_WITH_TABLE
static restitute_table *build_table(double low, double high, double tolerance)
{
    restitute_table_options options = options_of(2);
    options.speed[0] = low, options.speed[1] = high, options.tolerance = tolerance;
    return built(&shared.scene, &options);
}
#endif

static void components(struct job *job)
{
    (void)job;
#ifdef RESTITUTE_WITH_CONTACT
    double state[48] = {0};
    PREPARED(contact_motion, motion);
    restitute_contact_force force;
    motion.radius = 0.01;
    motion.friction = 0.3;
    motion.velocity[0] = motion.velocity[2] = 1e-2;
    for (int i = 1; i <= 40; i++) {
        motion.overlap = 1e-7 * i;
        MUST(restitute_contact_step(shared.law, &shared.rates, &motion, state, &force, &error));
        give(job, force.normal + force.tangential[0]);
    }
#endif
#ifdef RESTITUTE_WITH_TABLE
    for (int i = 1; i <= 40; i++) {
        const struct pair pair = look_up(shared.table, 0.003 * i, 0.01 * i);
        give(job, pair.ez + pair.ex);
    }
    restitute_table *own = build_table(0.1, 0.1, 1e-2);
    give(job, look_up(own, 0.1, 0.1).ex);
    restitute_table_destroy(own);
#endif
#ifdef RESTITUTE_WITH_CVODE
    solve_by(job, restitute_method_cvode(), 1e-2);
#endif
#ifdef RESTITUTE_WITH_BEM
    solve_by(job, restitute_method_bem(), 1e-2);
#endif
#ifdef RESTITUTE_WITH_FIT
    restitute_fit_point points[3];
    restitute_fit_options fit = fit_options(RESTITUTE_FIT_MODEL_KELVIN_VOIGT);
    restitute_scene scenes[3];
    drops(3, 0.1, 0.3, scenes, points);
    for (int i = 0; i < 3; i++) {
        points[i].ez = 0.9 - 0.05 * i;
        points[i].contact_time = 1e-3 * (3 - 0.3 * i);
    }
    fit.starts = 1;
    fit.threads = 2;
    const restitute_fit_result result = fitted(3, points, &fit);
    give(job, result.value[0]);
    restitute_material_destroy(result.material);
#endif
}

static void *work(void *data)
{
    pthread_barrier_wait(&shared.begin);
    for (int i = 0; i < rounds; i++) {
        components(data);
        core(data);
    }
    return NULL;
}

/* A job for each of n threads that begin at once. */
static void work_by(int n, struct job *jobs)
{
    pthread_t thread[threads];
    pthread_barrier_init(&shared.begin, NULL, (unsigned)n);
    for (int i = 0; i < n; i++)
        CHECK(pthread_create(&thread[i], NULL, work, &jobs[i]) == 0, "thread %d", i);
    for (int i = 0; i < n; i++)
        pthread_join(thread[i], NULL);
    pthread_barrier_destroy(&shared.begin);
}

static void threads_share_what_they_may(void **state)
{
    static struct job alone, jobs[threads];
    restitute_options options = to_tolerance(1e-4);
    restitute_material *rubber;
    (void)state;
    shared.scene = ball_on(1.0 / 3, &rubber);
    shared.scene.normal_speed = shared.scene.tangential_speed = 0.1;
    options.method = restitute_method_sync();
    MUST(restitute_plan_create_scene(&shared.scene, &options, &shared.plan, &error));
#ifdef RESTITUTE_WITH_CONTACT
    MUST(restitute_contact_law_create(rubber, NULL, &shared.law, &error));
    restitute_contact_rates_init(&shared.rates);
    MUST(restitute_contact_rates_set(shared.law, 1e-5, &shared.rates, &error));
#endif
#ifdef RESTITUTE_WITH_TABLE
    shared.table = build_table(0.01, 0.1, 1e-3);
#endif
    pthread_mutex_init(&shared.lock, NULL);
    work_by(1, &alone);
    work_by(threads, jobs);
    for (int i = 0; i < threads; i++)
        CHECK(alone.count > 3 && memcmp(&jobs[i], &alone, sizeof alone) == 0, "thread %d differs", i);
    pthread_mutex_destroy(&shared.lock);
#ifdef RESTITUTE_WITH_TABLE
    restitute_table_destroy(shared.table);
#endif
#ifdef RESTITUTE_WITH_CONTACT
    restitute_contact_law_destroy(shared.law);
#endif
    restitute_plan_destroy(shared.plan);
    restitute_material_destroy(rubber);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_share_what_they_may)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
