/* A solver keeps memory of the last impact. Results do not depend on it: for any order of the
 * impacts they have the bits of new solvers. So have refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/random.h"
#include "../support/sync.h"

enum { OF_EACH = 20, KINDS = 10, ALL = OF_EACH * KINDS };

struct answer {
    restitute_result result;
    int status;
};

/* Solids of all kinds, one that hardly rebounds among them. Grouped by solid, and within the group
 * by chi for half of them, as in a table. psi: stick, slip first, slip to the end and none. */
static void make_impacts(const restitute_material *prony, restitute_impact impacts[ALL])
{
    static const double delta1[KINDS] = {0, 0.01, 0.3, 1, 10, 20, 0.1, 0.5, 5, 0};
    static const double gamma[KINDS] = {1, 1, 0.2, 1, 0.05, 1e-3, 0, 0, 0, 0};
    uint64_t random = 17;
    for (int k = 0; k < KINDS; k++)
        for (int i = 0; i < OF_EACH; i++) {
            const double chi = i < OF_EACH / 2 ? 0.6 + 0.12 * i : random_in(&random, 1.0 / 3, 4);
            const double psi = i % 9 == 8 ? 0 : random_log(&random, 0.02, 8);
            impacts[k * OF_EACH + i] =
                k == KINDS - 1 ? impact_on(prony, chi, psi) : impact_of(chi, psi, delta1[k], gamma[k]);
        }
}

static void answer(restitute_solver *solver, const restitute_impact *impact, struct answer *answer)
{
    memset(answer, 0, sizeof *answer); /* the padding too: answers are compared byte by byte */
    restitute_result_init(&answer->result);
    answer->status = restitute_solve(solver, impact, &answer->result, NULL, NULL, NULL);
}

/* The i-th of all: as they are, backwards, every seventh (7 has no factor in common with their
 * number), each twice. */
static int place(int order, int i)
{
    switch (order) {
    case 0:
        return i;
    case 1:
        return ALL - 1 - i;
    case 2:
        return 7 * i % ALL;
    default:
        return i - i % 2;
    }
}

static void check_orders(const restitute_options *options, const restitute_impact impacts[ALL], int refused[2])
{
    static struct answer alone[ALL];
    restitute_solver *solver;
    for (int i = 0; i < ALL; i++) {
        CHECK(restitute_solver_create(options, &solver, NULL) == RESTITUTE_OK, "solver");
        answer(solver, &impacts[i], &alone[i]);
        restitute_solver_destroy(solver);
        refused[0] += alone[i].status < 0;
        refused[1] += alone[i].status > 0;
    }
    CHECK(restitute_solver_create(options, &solver, NULL) == RESTITUTE_OK, "solver");
    for (int order = 0; order < 4; order++)
        for (int i = 0; i < ALL; i++) {
            const int k = place(order, i);
            struct answer now;
            restitute_ledger ledger;
            restitute_ledger_init(&ledger);
            answer(solver, &impacts[k], &now);
            CHECK(memcmp(&now, &alone[k], sizeof now) == 0,
                  "tolerance %g, order %d, impact %d: status %d, not %d; ez %.17g, not %.17g; ex %.17g, not %.17g",
                  options->tolerance, order, k, now.status, alone[k].status, now.result.ez, alone[k].result.ez,
                  now.result.ex, alone[k].result.ex);
            if (i % 15 == 7) restitute_solve(solver, &impacts[k], NULL, &ledger, NULL, NULL); /* other room */
        }
    restitute_solver_destroy(solver);
}

static void no_order_is_seen_in_the_results(void **state)
{
    (void)state;
    static restitute_impact impacts[ALL];
    static const double times[] = {0.05, 0.4, 3}, moduli[] = {1, 0.7, 0.5};
    restitute_material *prony = solid_of(0.5, 0.1, 3, times, moduli);
    int refused[2] = {0};
    make_impacts(prony, impacts);
    for (double tolerance = 1e-2; tolerance > 5e-6; tolerance /= 10) {
        restitute_options options = sync_to(tolerance);
        check_orders(&options, impacts, refused);
    }
    CHECK(refused[0] == 0 && refused[1] == 0, "%d refused, %d with a remark", refused[0], refused[1]);
    restitute_material_destroy(prony);
}

/* With so few updates some are refused, and some end short of the tolerance: with elements given
 * too. */
static void neither_is_it_in_refusals(void **state)
{
    (void)state;
    static restitute_impact impacts[ALL];
    static const double times[] = {0.05, 0.4, 3}, moduli[] = {1, 0.7, 0.5};
    restitute_material *prony = solid_of(0.5, 0.1, 3, times, moduli);
    make_impacts(prony, impacts);
    int refused[2] = {0};
    for (int64_t elements = 0; elements <= 24; elements += 24) {
        restitute_options options = sync_to(1e-6);
        options.elements = elements;
        options.max_work = 7e-5;
        check_orders(&options, impacts, refused);
    }
    CHECK(refused[0] > 20 && refused[1] > 20 && refused[0] + refused[1] < 2 * ALL,
          "%d refused, %d with a remark: not the mixture meant", refused[0], refused[1]);
    restitute_material_destroy(prony);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_order_is_seen_in_the_results),
        cmocka_unit_test(neither_is_it_in_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
