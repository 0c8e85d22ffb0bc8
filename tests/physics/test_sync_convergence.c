/* The orders of `sync`: fourth in e_z, third in e_x, seen by doubling the number of levels.
 *
 * Twelve impacts a material. A single impact has no clean order: parts of its error (the kink where stick begins, between two
 * nodes) have either sign from level to level, so that the error of one resolution may pass through zero. The order is that of the
 * root mean square over the impacts: its logarithm falls along a line, whose slope over all resolutions is measured.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/random.h"
#include "../support/sync.h"

enum { impacts = 12, most_runs = 5 };

/* Levels of the runs, from the coarsest on, and of the reference: its error is (last/reference)^3 of that of the last run. */
struct grid {
    int first, runs, reference;
};

/* Root mean square errors, one a run. */
struct errors {
    double ez[most_runs], ex[most_runs];
};

/* Friction for stick, for partial slip and for gross slip that ends. */
static double some_psi(uint64_t *random)
{
    return random_in(random, 0.1, 2);
}

static struct errors errors_of(const restitute_impact impact[impacts], struct grid grid)
{
    struct errors e = {{0}, {0}};
    for (int i = 0; i < impacts; i++) {
        const restitute_result fine = solve_impact(sync_with(grid.reference), impact[i]).result;
        for (int k = 0; k < grid.runs; k++) {
            const restitute_result r = solve_impact(sync_with((int64_t)grid.first << k), impact[i]).result;
            e.ez[k] += (r.ez - fine.ez) * (r.ez - fine.ez) / impacts;
            e.ex[k] += (r.ex - fine.ex) * (r.ex - fine.ex) / impacts;
        }
    }
    for (int k = 0; k < grid.runs; k++) {
        e.ez[k] = sqrt(e.ez[k]);
        e.ex[k] = sqrt(e.ex[k]);
    }
    return e;
}

/* Slope of the regression line of -log2(error) over the run. */
static double order_of(const double *error, int runs)
{
    double weighted = 0, weights = 0;
    for (int k = 0; k < runs; k++) {
        const double place = k - 0.5 * (runs - 1);
        weighted -= place * log2(error[k]);
        weights += place * place;
    }
    return weighted / weights;
}

/* Below this an error is that of iterations and of rounding, some 1e-12 a level. */
static const double rounding = 3e-10;

/* Runs whose error still comes from the number of levels. Errors that are small from the beginning have no order to be seen,
 * nor have those that fall to rounding with the first doubling. */
static int runs_with_an_order(const double *error, struct grid grid, const char *what)
{
    int runs = 0;
    if (error[0] < 1e-7) return 0;
    while (runs < grid.runs && error[runs] > rounding)
        runs++;
    if (runs >= 2) return runs;
    CHECK(error[0] < 3e-6, "%s: no order can be seen from an error of %.1e", what, error[0]);
    return 0;
}

/* Orders from `least` to 5 for e_x, whose smooth parts are of fourth order and whose kinks of third. e_z is extrapolated from fourth order, what is left falls at least as fast. Half an order: a part of the next order that is as large as the first one on the coarsest of four grids and an
 * eighth of it on the finest would bend the line by that; above, cancellation may let errors fall faster. */
static void check_orders(const restitute_impact impact[impacts], struct grid grid, double least, const char *what)
{
    const struct errors e = errors_of(impact, grid);
    const int runs_z = runs_with_an_order(e.ez, grid, what), runs_x = runs_with_an_order(e.ex, grid, what);
    const double z = runs_z ? order_of(e.ez, runs_z) : 4, x = runs_x ? order_of(e.ex, runs_x) : 3;
    CHECK(z >= 3.5 && z <= 9, "%s: order %.2f of ez (%.1e to %.1e)", what, z, e.ez[0], e.ez[grid.runs - 1]);
    CHECK(x >= least && x <= 5, "%s: order %.2f of ex (%.1e to %.1e)", what, x, e.ex[0], e.ex[grid.runs - 1]);
}

static const struct grid usual = {32, 4, 1024};

static const double usual_order = 2.5;

static void check_standard(double delta1, double gamma, struct grid grid, double least, const char *what)
{
    uint64_t random = 4;
    restitute_impact impact[impacts];
    for (int i = 0; i < impacts; i++) {
        const double psi = some_psi(&random), chi = random_in(&random, 0.6, 1.75);
        impact[i] = impact_of(chi, psi, delta1, gamma);
    }
    check_orders(impact, grid, least, what);
}

static void elastic(void **state)
{
    (void)state;
    check_standard(0, INFINITY, usual, usual_order, "elastic");
}

static void standard_solid(void **state)
{
    (void)state;
    check_standard(0.3, 0.5, usual, usual_order, "standard, delta1 = 0.3");
    check_standard(1, 1, usual, usual_order, "standard, delta1 = 1");
    check_standard(10, 0.1, usual, usual_order, "standard, delta1 = 10");
    check_standard(100, 1, usual, usual_order, "standard, delta1 = 100");
}

static void kelvin_voigt(void **state)
{
    (void)state;
    check_standard(0.1, 0, usual, usual_order, "Kelvin-Voigt, delta1 = 0.1");
    check_standard(1, 0, usual, usual_order, "Kelvin-Voigt, delta1 = 1");
}

/* The contact shrinks to a small part of its size at once: more levels are needed before an order is seen. */
static void strongly_damped_kelvin_voigt(void **state)
{
    (void)state;
    check_standard(10, 0, (struct grid){64, 4, 1024}, usual_order, "Kelvin-Voigt, delta1 = 10");
    check_standard(100, 0, (struct grid){256, 4, 4096}, usual_order, "Kelvin-Voigt, delta1 = 100");
}

/* A relaxation time below every step (1.5e-4 T), which must act as the dashpot that it is; and one (1.5e-3 T) that is so on the
 * coarser grids but not on the finest ones, between which an order is lost. */
static void stiff_standard_solid(void **state)
{
    (void)state;
    check_standard(1, 1e-4, usual, usual_order, "stiff, delta1 = 1");
    check_standard(10, 1e-4, (struct grid){128, 4, 2048}, 2, "stiff, delta1 = 10");
}

static void check_solid(const restitute_material *solid, const char *what)
{
    uint64_t random = 5;
    restitute_impact impact[impacts];
    for (int i = 0; i < impacts; i++) {
        const double psi = some_psi(&random), chi = random_in(&random, 0.5, 2);
        impact[i] = impact_on(solid, chi, psi);
    }
    check_orders(impact, usual, usual_order, what);
}

static void maxwell_body_that_rebounds(void **state)
{
    const double tau[] = {3}, g[] = {1};
    restitute_material *solid = solid_of(0, 0, 1, tau, g);
    (void)state;
    check_solid(solid, "Maxwell");
    restitute_material_destroy(solid);
}

static void two_terms(void **state)
{
    const double tau[] = {0.2, 1.5}, g[] = {0.5, 2};
    restitute_material *solid = solid_of(1, 0, 2, tau, g), *damped = solid_of(1, 0.3, 2, tau, g);
    (void)state;
    check_solid(solid, "two terms");
    check_solid(damped, "two terms and a dashpot");
    restitute_material_destroy(solid);
    restitute_material_destroy(damped);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic),
        cmocka_unit_test(standard_solid),
        cmocka_unit_test(kelvin_voigt),
        cmocka_unit_test(strongly_damped_kelvin_voigt),
        cmocka_unit_test(stiff_standard_solid),
        cmocka_unit_test(maxwell_body_that_rebounds),
        cmocka_unit_test(two_terms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
