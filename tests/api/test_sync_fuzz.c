/* Histories and ledgers of the method `sync` over the whole domain that it accepts: what has a pair
 * has them too, all numbers of them make sense, and the sanitizers see no other fault. More than
 * the suite runs:  test_sync_fuzz COUNT SEED
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../support/history.h"
#include "../support/random.h"
#include "../support/sync.h"

enum { most_terms = 12, capacity = 50 };

static long count = 1000;
static uint64_t seed = 1;

static int one_in(uint64_t *random, int n)
{
    return random_below(random, n) == 0;
}

/* Any Prony solid in any unit; NULL: a standard one is taken. */
static restitute_material *random_solid(uint64_t *random)
{
    double tau[most_terms], g[most_terms];
    const int terms = one_in(random, 3) ? random_below(random, most_terms + 1) : random_below(random, 3);
    const double modulus = one_in(random, 2) ? 1 : random_log(random, 1e-20, 1e20), time = pow(modulus, -0.4);
    const double eta = one_in(random, 4) ? modulus * time * random_log(random, 1e-6, 1e2) : 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = time * random_log(random, 1e-6, 1e6);
        g[k] = modulus * random_log(random, 1e-3, 1e3);
    }
    const int fluid = terms + (eta > 0) > 0 && one_in(random, 3);
    return solid_of(fluid ? 0 : modulus, eta, (size_t)terms, tau, g);
}

/* From 0 to infinity, with both. */
static double random_number(uint64_t *random, double low, double high)
{
    const int kind = random_below(random, 12);
    return kind == 0 ? 0 : kind == 1 ? 1e-300 : kind == 2 ? 1e12 : random_log(random, low, high);
}

static restitute_impact random_impact(uint64_t *random)
{
    restitute_impact impact = impact_of(random_log(random, 1.0 / 3, one_in(random, 4) ? 1000 : 4), 0, 0, INFINITY);
    const int kind = random_below(random, 8);
    impact.psi = kind == 0 ? 0 : kind == 1 ? random_log(random, 1e-13, 1e-2) : random_log(random, 1e-2, 10);
    if (one_in(random, 2)) {
        impact.material = random_solid(random);
    } else {
        impact.delta1 = random_number(random, 1e-6, 1e4);
        impact.gamma = one_in(random, 12) ? INFINITY : random_number(random, 1e-6, 1e6);
    }
    return impact;
}

/* Little work: no impact takes long. */
static restitute_solver *random_solver(uint64_t *random)
{
    restitute_options options = sync_to(random_log(random, one_in(random, 4) ? 1e-8 : 1e-5, 0.1));
    options.max_work = one_in(random, 4) ? 1e-4 : 3e-2;
    if (one_in(random, 4)) options.elements = 4 + random_below(random, 200);
    return make_solver(&options);
}

static void check_history(long i, const restitute_history *h, const restitute_result *r)
{
    CHECK(h->count == (isfinite(r->contact_time) ? h->capacity : 1), "impact %ld: %zu samples", i, h->count);
    for (size_t k = 0; k < h->count; k++) {
        const double f = h->normal_force[k], q = h->tangential_force[k], a = h->contact_radius[k];
        const double all[] = {h->time[k],
                              f,
                              q,
                              a,
                              h->stick_radius[k],
                              h->indentation[k],
                              h->normal_velocity[k],
                              h->tangential_velocity[k]};
        for (size_t j = 0; j < sizeof all / sizeof *all; j++)
            CHECK(isfinite(all[j]), "impact %ld, sample %zu: number %zu is %g", i, k, j, all[j]);
        CHECK(k == 0 || h->time[k] > h->time[k - 1], "impact %ld: time %g after %g", i, h->time[k], h->time[k - 1]);
        CHECK(f >= 0 && a >= 0, "impact %ld, sample %zu: force %g, radius %g", i, k, f, a);
        CHECK(h->indentation[k] <= 1.01 * r->max_indentation, "impact %ld: %g in, at most %g", i, h->indentation[k],
              r->max_indentation); /* between its points the motion is known to the tolerance */
        CHECK(h->stick_radius[k] >= 0 && h->stick_radius[k] <= a, "impact %ld: stick %g of %g", i, h->stick_radius[k],
              a);
    }
}

static void check_ledger(long i, const restitute_ledger *l)
{
    const double all[] = {l->rebound_z,  l->viscous_z, l->left_z, l->residual_z, l->rebound_x,
                          l->friction_x, l->viscous_x, l->left_x, l->residual_x};
    for (size_t j = 0; j < sizeof all / sizeof *all; j++)
        CHECK(isfinite(all[j]), "impact %ld: account %zu is %g", i, j, all[j]);
}

/* The same bits with and without what else is asked for. */
static int solve_twice(long i, restitute_solver *solver, const restitute_impact *impact, size_t samples)
{
    static double array[8][capacity];
    PREPARED(result, pair);
    PREPARED(result, result);
    PREPARED(ledger, ledger);
    PREPARED(history, history);
    restitute_error error;
    set_columns(&history, capacity, array[0], all_columns);
    history.capacity = samples;
    const int status = restitute_solve(solver, impact, &pair, NULL, NULL, &error);
    const int again = restitute_solve(solver, impact, &result, &ledger, &history, &error);
    CHECK(again == status, "impact %ld: status %d, with history and ledger %d: %s", i, status, again, error.message);
    CHECK(memcmp(&pair, &result, sizeof pair) == 0, "impact %ld: ez %.17g and %.17g, ex %.17g and %.17g", i, pair.ez,
          result.ez, pair.ex, result.ex);
    if (status < 0) return 0;
    CHECK(isfinite(pair.ez) && isfinite(pair.ex) && pair.error_ez > 0 && pair.error_ex >= 0, "impact %ld", i);
    check_history(i, &history, &result);
    check_ledger(i, &ledger);
    return 1;
}

static void what_has_a_pair_has_history_and_ledger(void **state)
{
    uint64_t random = seed;
    restitute_solver *solver = NULL;
    long solved = 0;
    (void)state;
    for (long i = 0; i < count; i++) {
        if (i % 16 == 0) {
            restitute_solver_destroy(solver);
            solver = random_solver(&random);
        }
        const restitute_impact impact = random_impact(&random);
        const size_t samples = 2 + (size_t)random_below(&random, capacity - 1);
        solved += solve_twice(i, solver, &impact, samples);
        restitute_material_destroy((restitute_material *)impact.material);
    }
    restitute_solver_destroy(solver);
    print_message("%ld of %ld have a pair\n", solved, count);
    CHECK(solved > count / 2, "%ld of %ld have a pair", solved, count);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_has_a_pair_has_history_and_ledger)};
    if (argc > 1) count = atol(argv[1]);
    if (argc > 2) seed = strtoull(argv[2], NULL, 10);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
