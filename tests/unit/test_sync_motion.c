/* The normal motion that a plan or a batch keeps: when a run of the method sync is kept, and when
 * it is solved again.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/check.h"
#include "sync/motion.h"

#include <math.h>

enum { halvings = 3 };

static double modulus[2] = {1, 0.5}, relaxation[2] = {1, 0.1};

static struct rst_problem problem_of(double g_inf, double eta, int n_terms, double tolerance, double psi)
{
    return (struct rst_problem){
        .chi = 7.0 / 6,
        .psi = psi,
        .shear_speed = psi,
        .mode = psi > 1 ? RST_GROSS_SLIP : RST_PARTIAL_SLIP,
        .solid = {.g_inf = g_inf, .eta = eta, .n_terms = n_terms, .g = modulus, .tau = relaxation},
        .tolerance = tolerance};
}

static const struct rst_run *begin(struct rst_motion *motion, struct rst_problem problem, int keep)
{
    CHECK(rst_motion_begin(motion, &problem, 1, keep) == 0, "memory");
    const struct rst_run *run = rst_motion_run(motion, halvings, 1000);
    CHECK(run && (run->found == RST_REBOUNDS || run->found == RST_STOPS), "no run");
    return run;
}

/* Whether the run for a problem is the one that is there: that gets a mark which no run makes. */
static int stays(struct rst_motion *motion, const struct rst_run *run, struct rst_problem problem, int keep)
{
    const double mark = -17;
    run->normal.panel[0].force[0] = mark;
    return begin(motion, problem, keep)->normal.panel[0].force[0] == mark;
}

static void a_run_stays_for_impacts_on_its_solid(void **state)
{
    (void)state;
    struct rst_workspace workspace = {0};
    struct rst_motion *motion = rst_motion_of(&workspace);
    struct rst_problem other = problem_of(1, 0, 1, 1e-6, 0.1);
    CHECK(motion, "memory");
    const struct rst_run *run = begin(motion, problem_of(1, 0, 1, 1e-6, 0.5), 1);
    other.chi = 3;
    CHECK(stays(motion, run, other, 1), "other chi and psi");
    CHECK(!stays(motion, run, other, 0), "it was not to be kept");
    CHECK(!stays(motion, run, problem_of(1 + 1e-15, 0, 1, 1e-6, 0.5), 1), "another spring");
    CHECK(!stays(motion, run, problem_of(1 + 1e-15, 1e-3, 1, 1e-6, 0.5), 1), "another dashpot");
    CHECK(!stays(motion, run, problem_of(1 + 1e-15, 1e-3, 2, 1e-6, 0.5), 1), "another term");
    relaxation[1] *= 1 + 1e-15;
    CHECK(!stays(motion, run, problem_of(1 + 1e-15, 1e-3, 2, 1e-6, 0.5), 1), "another relaxation time");
    CHECK(stays(motion, run, problem_of(1 + 1e-15, 1e-3, 2, 1e-6, 0.5), 1), "the same");
    rst_workspace_free(&workspace);
}

/* By the stop speed: 0.01 of the tolerance, and psi/(2 chi) of that for small psi (tuning.h). */
static void a_sphere_that_stops_is_followed_anew_for_another_stop_speed(void **state)
{
    (void)state;
    struct rst_workspace workspace = {0};
    struct rst_motion *motion = rst_motion_of(&workspace);
    relaxation[0] = 0.02;
    CHECK(motion, "memory");
    const struct rst_run *run = begin(motion, problem_of(0, 0, 1, 1e-4, 2.5), 1);
    CHECK(run->found == RST_STOPS, "this Maxwell body is to let the sphere sink");
    CHECK(stays(motion, run, problem_of(0, 0, 1, 1e-4, 3), 1), "the same stop speed");
    CHECK(!stays(motion, run, problem_of(0, 0, 1, 1e-4, 0.1), 1), "a lower one");
    CHECK(!stays(motion, run, problem_of(0, 0, 1, 1e-4, 2.5), 1), "a higher one");
    relaxation[0] = 1;
    rst_workspace_free(&workspace);
}

/* Maxwell bodies that rebound ever more slowly: one is sought whose rebound counts at a small
 * tolerance alone. */
static void a_slow_rebound_stays_for_stop_speeds_below_it(void **state)
{
    (void)state;
    struct rst_workspace workspace = {0};
    struct rst_motion *motion = rst_motion_of(&workspace);
    const struct rst_run *run = NULL;
    double rebound = 1, low = 0.02, high = 1;
    CHECK(motion, "memory");
    while (!(rebound > 1e-5 && rebound < 5e-4)) {
        CHECK(high - low > 1e-12, "no slow rebound is found");
        relaxation[0] = 0.5 * (low + high);
        run = begin(motion, problem_of(0, 0, 1, 1e-8, 2.5), 1);
        rebound = run->found == RST_STOPS ? 0 : -run->normal.panel[run->normal.n_panels - 1].velocity[rst_stages];
        *(rebound < 1e-5 ? &low : &high) = relaxation[0];
    }
    CHECK(stays(motion, run, problem_of(0, 0, 1, 1e-8, 0.1), 1), "a lower stop speed");
    CHECK(stays(motion, run, problem_of(0, 0, 1, 50 * rebound, 2.5), 1), "a higher one, half of the rebound");
    CHECK(!stays(motion, run, problem_of(0, 0, 1, 0.1, 2.5), 1) && run->found == RST_STOPS, "one above the rebound");
    CHECK(!stays(motion, run, problem_of(0, 0, 1, 1e-8, 2.5), 1) && run->found == RST_REBOUNDS, "one below it again");
    relaxation[0] = 1;
    rst_workspace_free(&workspace);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_stays_for_impacts_on_its_solid),
        cmocka_unit_test(a_sphere_that_stops_is_followed_anew_for_another_stop_speed),
        cmocka_unit_test(a_slow_rebound_stays_for_stop_speeds_below_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
