/* The method `cvode` against the reference impacts of tests/data, its estimate against the true
 * error, and the stiff corner.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../support/cvode.h"
#include "../support/data.h"
#include "../support/sync.h"

/* The file prints ez with 12 decimals and ex with 10. */
static const double printed_ez = 5e-13, printed_ex = 5e-11;

static void check_truth(double tolerance)
{
    static struct truth truth[truth_rows];
    int low = 0, missed = 0;
    read_truth(truth);
    restitute_solver *solver;
    restitute_options options = cvode_to(tolerance);
    restitute_error error;
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    for (int i = 0; i < truth_rows; i++) {
        const struct truth *t = &truth[i];
        restitute_impact impact = impact_of(t->chi, t->psi, t->delta1, t->gamma);
        restitute_result r;
        restitute_result_init(&r);
        const int status = restitute_solve(solver, &impact, &r, NULL, NULL, &error);
        CHECK(status == RESTITUTE_OK, "row %d at %g: %s", i, tolerance, error.message);
        const double z = certain_error(r.ez, t->ez, t->err_ez + printed_ez);
        const double x = certain_error(r.ex, t->ex, t->err_ex + printed_ex);
        low += z > r.error_ez || x > r.error_ex;
        if (z > tolerance || x > tolerance) {
            print_error("row %d at %g: off by %g, %g; estimates %g, %g\n", i, tolerance, z, x, r.error_ez, r.error_ex);
            missed++;
        }
        CHECK_NEAR(r.max_indentation, t->max_indentation, tolerance + 1e-10, "row %d at %g", i, tolerance);
    }
    restitute_solver_destroy(solver);
    CHECK(missed == 0, "%d rows at %g", missed, tolerance);
    CHECK(low <= truth_rows / 20, "%d estimates are below the true error at %g", low, tolerance);
}

/* 1e-3 to 1e-6; at 1e-6 that is ten times closer than the references of the paper need. */
static void truth_rows_meet_every_tolerance(void **state)
{
    (void)state;
    check_truth(1e-3);
    check_truth(1e-4);
    check_truth(1e-5);
    check_truth(1e-6);
}

static void check_prony(const restitute_options *options, restitute_impact impact, double ez, double ex, double known)
{
    const struct solution s = solve_pair(*options, impact);
    CHECK_NEAR(s.result.ez, ez, options->tolerance + known, "ez");
    CHECK_NEAR(s.result.ex, ex, options->tolerance + known, "ex");
}

/* Rows of prony_truth.csv with the errors that it states. */
static void prony_rows_are_met(void **state)
{
    const double maxwell_tau[] = {3}, maxwell_g[] = {1}, tau[] = {0.2, 1.5}, g[] = {0.5, 2};
    (void)state;
    restitute_material *maxwell = solid_of(0, 0, 1, maxwell_tau, maxwell_g), *two = solid_of(1, 0, 2, tau, g);
    const restitute_options options = cvode_to(1e-6);
    check_prony(&options, impact_on(maxwell, 7.0 / 6, 2), 0.651750493, 0.442348560, 2e-7);
    check_prony(&options, impact_on(two, 7.0 / 6, 1.5), 0.685603357, 0.413696092, 1e-7);
    restitute_material_destroy(maxwell);
    restitute_material_destroy(two);
}

/* Thirty terms over twenty decades: psi = 2, for with nu = 0.5 the sliding speed is 3 mu v_z. */
static void polyisobutylene_is_met(void **state)
{
    double tau[pib_terms], g[pib_terms];
    restitute_scene scene;
    (void)state;
    read_pib(tau, g);
    restitute_material *pib = solid_of(0, 0, pib_terms, tau, g);
    restitute_scene_init(&scene);
    scene.material = pib;
    scene.radius1 = 5e-3;
    scene.mass1 = 7800 * 4.0 / 3.0 * 3.14159265358979323846 * 1.25e-7;
    scene.friction = 0.3;
    scene.normal_speed = 1;
    scene.tangential_speed = 0.9;
    const struct solution s = solve_scene(cvode_to(1e-6), &scene);
    CHECK_NEAR(s.result.ez, 0.280916784, 1e-6 + 3e-6, "3e-6: error of the reference");
    CHECK_NEAR(s.result.ex, 0.151295099, 1e-6 + 3e-6, "3e-6: error of the reference");
    restitute_material_destroy(pib);
}

/* A solid with a dashpot in parallel to its terms has no row; the method sync is independent of
 * this one. */
static void prony_with_dashpot_agrees_with_sync(void **state)
{
    const double tau[] = {0.05, 0.4, 3}, g[] = {1, 0.7, 0.5}, psi[] = {0, 0.01, 0.6, 1.4};
    (void)state;
    restitute_material *solid = solid_of(0.5, 0.1, 3, tau, g);
    for (int i = 0; i < 4; i++) {
        const struct solution a = solve_pair(cvode_to(1e-6), impact_on(solid, 7.0 / 6, psi[i]));
        const struct solution b = solve_pair(sync_to(1e-8), impact_on(solid, 7.0 / 6, psi[i]));
        CHECK_NEAR(a.result.ez, b.result.ez, 1.01e-6, "psi %g: both tolerances", psi[i]);
        CHECK_NEAR(a.result.ex, b.result.ex, 1.01e-6, "psi %g: both tolerances", psi[i]);
    }
    restitute_material_destroy(solid);
}

/* gamma = 1e-6: relaxation within 1e-12 or 1e-3 of the scale of time. The normal problem is that of
 * sync, without elements, and for the weak damping that of the limit 1 - 1.891706 theta (theta =
 * 1.5e-6, the next term is of the order of its square). */
static void stiff_corner_agrees_with_sync(void **state)
{
    const double delta1[] = {1e-6, 1e3};
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            const double psi = k ? 1.5 : 0.5, theta = THETA_OF_DELTA1 * delta1[i];
            const struct solution s = solve_pair(cvode_to(1e-6), impact_of(7.0 / 6, psi, delta1[i], 1e-6));
            const struct solution r = solve_pair(sync_to(1e-6), impact_of(7.0 / 6, psi, delta1[i], 1e-6));
            CHECK_NEAR(s.result.ez, r.result.ez, 2e-6, "delta1 %g psi %g: both tolerances", delta1[i], psi);
            if (i == 0) CHECK_NEAR(s.result.ez, 1 - 1.891706 * theta, 1e-6, "delta1 %g: the tolerance", delta1[i]);
            CHECK_NEAR(s.result.ex, r.result.ex, 2e-6, "delta1 %g psi %g: both tolerances", delta1[i], psi);
        }
}

/* Coarse elements agree by chance where slip is narrow (psi << 1). At large chi the sphere
 * vibrates: errors of time and of the normal velocity, at which gross slip ends, are larger in e_x
 * (psi > 1). These impacts of docs/records/extremes.md were off by 3 to 15 estimates, and by more
 * than their tolerances. */
static void loose_tolerances_hold(void **state)
{
    const double cases[][5] = {
        {0.01, 12.39, 1.743e-3, 0, 1},
        {0.005, 6.56673044665317, 1.478458884341126e-3, 13812807.21515963, 8.766899032469829e-05},
        {0.01, 6.531842819867593, 8.64387353440795e-3, 13799233.282993942, 6.311062559492143e-05},
        {0.01, 730.5767728574320, 1.208011401384566, 0, 1},
        {0.1, 470.3531295039139, 1.334739043642375, 4.145102290283063e-9, 21035.321006124799},
        {0.005, 782.2133409756458, 1.381025220824539, 2.775662320058409e-11, 0},
        {0.001, 1.1940065569488072, 2.250785620871402e-3, 7402.753198128546, 2.7897289691536684e-7}};
    (void)state;
    for (int i = 0; i < 7; i++) {
        const double *c = cases[i];
        restitute_options options = cvode_to(c[0]);
        options.max_work = 1;
        const restitute_impact impact = impact_of(c[1], c[2], c[3], c[4]);
        const struct solution s = solve_pair(options, impact), r = solve_pair(sync_to(1e-4), impact);
        CHECK(s.status == RESTITUTE_OK && r.status == RESTITUTE_OK, "case %d: %d, %d", i, s.status, r.status);
        CHECK_NEAR(s.result.ex, r.result.ex, c[0] + r.result.error_ex, "case %d: both tolerances", i);
    }
}

/* Both families of formulas are one problem. */
static void families_agree(void **state)
{
    restitute_options bdf = cvode_to(1e-6), adams = bdf;
    (void)state;
    bdf.method = restitute_method_cvode_bdf();
    adams.method = restitute_method_cvode_adams();
    for (int i = 0; i < 3; i++) {
        const restitute_impact impact = impact_of(7.0 / 6, 0.5 + 0.6 * i, 0.5, 1);
        const struct solution a = solve_pair(bdf, impact), b = solve_pair(adams, impact);
        CHECK_NEAR(a.result.ez, b.result.ez, 2e-6, "both tolerances");
        CHECK_NEAR(a.result.ex, b.result.ex, 2e-6, "both tolerances");
    }
}

/* The accounts are kept by the trapezoidal rule over steps and over at least 256 elements: the
 * residual is theirs, not the pair's. */
static void energy_is_accounted_for(void **state)
{
    const double cases[][3] = {{0.5, 0, 1}, {2, 1, 1}, {0.7, 0.3, 0}, {5, 1, 1}, {0.7, 1, 0.01}, {1.3, 0.05, 2}};
    (void)state;
    for (int i = 0; i < 6; i++) {
        const struct solution s =
            solve_impact(cvode_to(1e-5), impact_of(7.0 / 6, cases[i][0], cases[i][1], cases[i][2]));
        const restitute_ledger *l = &s.ledger;
        CHECK_NEAR(l->residual_z, 0, 2e-3, "case %d", i);
        CHECK_NEAR(l->residual_x, 0, 1e-2, "case %d", i);
        CHECK(l->viscous_z >= 0 && l->viscous_x >= 0 && l->friction_x >= 0, "case %d: %g %g %g", i, l->viscous_z,
              l->viscous_x, l->friction_x);
    }
}

/* The last three slip in an annulus narrower than an element. In the last the solid relaxes
 * meanwhile: friction takes 0.25 then, and 0.64 with the 256 elements that sync begins with. */
static void parts_of_the_ledger_are_those_of_sync(void **state)
{
    const double cases[][4] = {{7.0 / 6, 0.05, 0, 1},
                               {7.0 / 6, 0.3, 0.3, 1},
                               {2.13889, 0.07024, 0.00278, 0.98664},
                               {3, 2, 1, 1},
                               {39.387, 1.1373e-3, 26.778, 36.531},
                               {55.663, 2.198e-3, 0.02194, 1.257},
                               {1.3211, 3.573e-3, 1.73e-3, 5.466e-3},
                               {15.728, 1.377e-3, 1.08e-4, 0},
                               {81.716, 8.383e-3, 8.592e-4, 3.048e-3}};
    (void)state;
    for (int i = 0; i < 9; i++) {
        const restitute_impact impact = impact_of(cases[i][0], cases[i][1], cases[i][2], cases[i][3]);
        const restitute_ledger l = solve_impact(cvode_to(1e-3), impact).ledger,
                               r = solve_impact(sync_to(1e-5), impact).ledger;
        CHECK_NEAR(l.friction_x, r.friction_x, 0.02, "case %d", i);
        CHECK_NEAR(l.left_x, r.left_x, 0.02, "case %d", i);
        CHECK_NEAR(l.viscous_x, r.viscous_x, 0.02, "case %d", i);
        CHECK_NEAR(l.residual_x, 0, 0.005, "case %d", i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_rows_meet_every_tolerance),
        cmocka_unit_test(prony_rows_are_met),
        cmocka_unit_test(polyisobutylene_is_met),
        cmocka_unit_test(prony_with_dashpot_agrees_with_sync),
        cmocka_unit_test(stiff_corner_agrees_with_sync),
        cmocka_unit_test(loose_tolerances_hold),
        cmocka_unit_test(families_agree),
        cmocka_unit_test(energy_is_accounted_for),
        cmocka_unit_test(parts_of_the_ledger_are_those_of_sync),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
