/* How fast the errors of `sync` fall when panels are half as wide (docs/sync.md, "Order of each
 * part").
 *
 * Panels that are not smooth are halved until they miss 1/32 of what they missed in the run before.
 * So the errors of a run are below what its polynomials may miss, those of e_z, which rests on
 * smooth functions alone, far below. Twelve impacts a material: the error of a single one may pass
 * through zero, so that the root mean square is looked at.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/random.h"
#include "../support/sync.h"

enum { impacts = 12, runs = 4 };

/* Elements of the first run, and of the reference, whose error is far below that of the last
 * run. */
enum { first_run = 24, reference = 768 };

/* Root mean square errors, one a run. */
struct errors {
    double ez[runs], ex[runs];
};

/* Friction for stick, for partial slip and for gross slip that ends. */
static double some_psi(uint64_t *random)
{
    return random_in(random, 0.1, 2);
}

static struct errors errors_of(const restitute_impact impact[impacts])
{
    struct errors e = {{0}, {0}};
    for (int i = 0; i < impacts; i++) {
        const restitute_result fine = solve_pair(sync_with(reference), impact[i]).result;
        for (int k = 0; k < runs; k++) {
            const restitute_result r = solve_pair(sync_with((int64_t)first_run << k), impact[i]).result;
            e.ez[k] += (r.ez - fine.ez) * (r.ez - fine.ez) / impacts;
            e.ex[k] += (r.ex - fine.ex) * (r.ex - fine.ex) / impacts;
        }
    }
    for (int k = 0; k < runs; k++) {
        e.ez[k] = sqrt(e.ez[k]);
        e.ex[k] = sqrt(e.ex[k]);
    }
    return e;
}

/* What polynomials may miss in the first run: the second of two, 1e-2/32. */
static const double first_roughness = 1e-2 / 32;

/* e_x: a third of it, three times the worst that was measured (1.4e-5, 9e-7, 1.4e-8, 4e-10). e_z:
 * 1/300, as much above 3e-8, 7e-9 and then rounding of some 1e-13. The order of e_x from the first
 * to the last run was 2.9 to 6.6: below 1e-7 what is left comes from the panels in which events
 * are. */
static void check_errors(const restitute_impact impact[impacts], const char *what)
{
    const struct errors e = errors_of(impact);
    double roughness = first_roughness;
    for (int k = 0; k < runs; k++, roughness /= 32) {
        CHECK(e.ez[k] <= roughness / 300 + 1e-12, "%s, run %d: error %.2e of ez", what, k, e.ez[k]);
        CHECK(e.ex[k] <= roughness / 3, "%s, run %d: error %.2e of ex", what, k, e.ex[k]);
    }
    const double order = log2(e.ex[0] / e.ex[runs - 1]) / (runs - 1);
    CHECK(order >= 2.5, "%s: order %.2f of ex (%.1e to %.1e)", what, order, e.ex[0], e.ex[runs - 1]);
}

static void check_standard(double delta1, double gamma, const char *what)
{
    uint64_t random = 4;
    restitute_impact impact[impacts];
    for (int i = 0; i < impacts; i++) {
        const double psi = some_psi(&random), chi = random_in(&random, 0.6, 1.75);
        impact[i] = impact_of(chi, psi, delta1, gamma);
    }
    check_errors(impact, what);
}

static void elastic(void **state)
{
    (void)state;
    check_standard(0, INFINITY, "elastic");
}

static void standard_solid(void **state)
{
    (void)state;
    check_standard(0.3, 0.5, "standard, delta1 = 0.3");
    check_standard(1, 1, "standard, delta1 = 1");
    check_standard(10, 0.1, "standard, delta1 = 10");
    check_standard(100, 1, "standard, delta1 = 100");
}

static void kelvin_voigt(void **state)
{
    (void)state;
    check_standard(0.1, 0, "Kelvin-Voigt, delta1 = 0.1");
    check_standard(1, 0, "Kelvin-Voigt, delta1 = 1");
}

static void strongly_damped_kelvin_voigt(void **state)
{
    (void)state;
    check_standard(10, 0, "Kelvin-Voigt, delta1 = 10");
    check_standard(100, 0, "Kelvin-Voigt, delta1 = 100");
}

/* Relaxation times far below a panel's (1.5e-4 T and 1.5e-3 T), which must act as the dashpots that
 * they nearly are. */
static void stiff_standard_solid(void **state)
{
    (void)state;
    check_standard(1, 1e-4, "stiff, delta1 = 1");
    check_standard(10, 1e-4, "stiff, delta1 = 10");
}

static void check_solid(const restitute_material *solid, const char *what)
{
    uint64_t random = 5;
    restitute_impact impact[impacts];
    for (int i = 0; i < impacts; i++) {
        const double psi = some_psi(&random), chi = random_in(&random, 0.5, 2);
        impact[i] = impact_on(solid, chi, psi);
    }
    check_errors(impact, what);
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
