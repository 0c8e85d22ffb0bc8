/* Slip and stick: full slip, the exact critical psi, and how contacts begin.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "../support/solve.h"

/* A solid of the tests: standard ones by delta1 and gamma, others by their Prony series. */
struct solid {
    const char *name;
    double delta1, gamma;
    restitute_material *prony;
};

enum { n_solids = 6, capacity = 200000 };

static struct solid solids[n_solids] = {
    {"elastic", 0, INFINITY, NULL}, {"Kelvin-Voigt", 0.3, 0, NULL}, {"stiff Kelvin-Voigt", 10, 0, NULL},
    {"standard solid", 1, 1, NULL}, {"Maxwell", 0, 0, NULL},        {"Prony with dashpot", 0, 0, NULL},
};

static const double chis[] = {1.0 / 3, 0.45, 0.5, 0.6, 7.0 / 6, 2, 4};
enum { n_chis = sizeof chis / sizeof *chis };

static int make_solids(void **state)
{
    (void)state;
    solids[4].prony = solid_of(0, 0, 1, (double[]){3}, (double[]){1});
    solids[5].prony = solid_of(0.6, 0.1, 2, (double[]){0.2, 1.5}, (double[]){0.5, 2});
    return 0;
}

static int destroy_solids(void **state)
{
    (void)state;
    for (int i = 0; i < n_solids; i++)
        restitute_material_destroy(solids[i].prony);
    return 0;
}

static restitute_impact impact_with(const struct solid *solid, double chi, double psi)
{
    restitute_impact impact = impact_of(chi, psi, solid->delta1, solid->gamma);
    impact.material = solid->prony;
    return impact;
}

/* Radii of a contact over its time, one sample a step. */
struct record {
    restitute_result result;
    size_t count;
    double *contact, *stick;
};

static struct record record_of(const struct solid *solid, double chi, double psi)
{
    struct record r;
    restitute_options options = as_told(48, 0);
    restitute_impact impact = impact_with(solid, chi, psi);
    restitute_solver *solver;
    restitute_history history;
    restitute_error error;
    restitute_result_init(&r.result);
    restitute_history_init(&history);
    history.capacity = capacity;
    history.contact_radius = r.contact = malloc(capacity * sizeof(double));
    history.stick_radius = r.stick = malloc(capacity * sizeof(double));
    assert_non_null(r.contact);
    assert_non_null(r.stick);
    assert_int_equal(restitute_solver_create(&options, &solver, &error), RESTITUTE_OK);
    int status = restitute_solve(solver, &impact, &r.result, NULL, &history, &error);
    CHECK(status >= 0, "%s", error.message);
    CHECK(history.count == (size_t)r.result.steps + 1, "%zu samples of %d steps", history.count, (int)r.result.steps);
    restitute_solver_destroy(solver);
    r.count = history.count;
    return r;
}

static void forget(struct record *r)
{
    free(r->contact);
    free(r->stick);
}

/* Any stick while in contact. */
static int ever_sticks(const struct record *r)
{
    for (size_t i = 0; i < r->count; i++)
        if (r->contact[i] > 0 && r->stick[i] > 0) return 1;
    return 0;
}

/* Stick at the first sample that is in contact. */
static int begins_in_stick(const struct record *r)
{
    for (size_t i = 1; i < r->count; i++)
        if (r->contact[i] > 0) return r->stick[i] > 0;
    return 0;
}

static double ez_by(const struct solid *solid)
{
    return solve_pair(as_told(48, 0), impact_with(solid, 7.0 / 6, 2)).result.ez;
}

/* (27) holds in the discrete model too: U' and D' change by the same force. Only rounding is left:
 * half a unit in the last place of about psi in each of the steps, relative to psi. (e_z is cut off
 * at 1, by no more than its error.) */
static void full_slip_has_ex_of_27(void **state)
{
    (void)state;
    for (int k = 0; k < n_solids; k++)
        for (int i = 0; i < n_chis; i++) {
            double critical = restitute_critical_psi(chis[i], ez_by(&solids[k]));
            for (double factor = 1.05; factor < 50; factor *= 3) {
                double psi = critical * factor;
                struct restitute_result r =
                    solve_pair(default_options(), impact_with(&solids[k], chis[i], psi)).result;
                double cut = r.ez >= 1 ? 2 * chis[i] / psi * r.error_ez : 0;
                CHECK_NEAR(r.ex, 2 * chis[i] * (1 + r.ez) / psi - 1, cut + 1.2e-16 * (double)r.steps,
                           "%s, chi %g, psi %g", solids[k].name, chis[i], psi);
            }
        }
}

/* psi_c is where stick just fails to appear before the contact ends. In the last steps D' changes
 * little: a sphere at psi_c (1 - 1e-4) begins to stick when the velocity is within 1e-4 psi_c of
 * its last value, several steps early. */
static void slip_persists_to_the_end_from_psi_c_on(void **state)
{
    (void)state;
    for (int k = 0; k < n_solids; k++)
        for (int i = 0; i < n_chis; i++) {
            double chi = chis[i], critical = restitute_critical_psi(chi, ez_by(&solids[k]));
            struct record above = record_of(&solids[k], chi, critical * (1 + 1e-6));
            struct record below = record_of(&solids[k], chi, critical * (1 - 1e-4));
            CHECK(!ever_sticks(&above), "%s, chi %g: sticks above psi_c = %.6f", solids[k].name, chi, critical);
            CHECK(ever_sticks(&below), "%s, chi %g: slips below psi_c = %.6f", solids[k].name, chi, critical);
            forget(&above);
            forget(&below);
        }
}

static void psi_c_is_2_chi_1_plus_ez_minus_ez(void **state)
{
    (void)state;
    CHECK_NEAR(restitute_critical_psi(7.0 / 6, 1), 11.0 / 3, 1e-15, "elastic solid sphere");
    CHECK_NEAR(restitute_critical_psi(7.0 / 6, 0), 7.0 / 3, 1e-15, "no rebound");
    CHECK_NEAR(restitute_critical_psi(0.5, 0.3), 1, 1e-15, "2 chi = 1");
    CHECK_NEAR(restitute_critical_psi(1.0 / 3, 0.3), 1, 0, "2 chi < 1");
}

/* Exact, with a dashpot in parallel too: at first touch q/f is U'/D' = psi. */
static void contact_begins_in_stick_if_and_only_if_psi_is_at_most_1(void **state)
{
    (void)state;
    const double psis[] = {0, 0.05, 0.5, 0.9, 0.999, 1, 1.001, 1.1, 2, 10};
    for (int k = 0; k < n_solids; k++)
        for (int i = 0; i < n_chis; i++)
            for (size_t j = 0; j < sizeof psis / sizeof *psis; j++) {
                struct record r = record_of(&solids[k], chis[i], psis[j]);
                CHECK(begins_in_stick(&r) == (psis[j] <= 1), "%s, chi %g, psi %g", solids[k].name, chis[i], psis[j]);
                forget(&r);
            }
}

/* 1 < psi < psi_c: stick begins when D' = (2 chi - psi)/(2 chi - 1), everywhere at once: the sample
 * before has no stick radius, the sample after has the whole contact. The instant is seen to within
 * one step, in which D' changes by at most the largest force times the step. */
static void gross_slip_ends_everywhere_at_once(void **state)
{
    (void)state;
    for (int k = 0; k < n_solids; k++)
        for (int i = 0; i < 2 * n_chis; i++) {
            double chi = chis[i / 2], critical = restitute_critical_psi(chi, ez_by(&solids[k])),
                   psi = 1 + (i % 2 ? 0.9999 : 0.4) * (critical - 1);
            if (critical <= 1.01) continue;
            restitute_options options = as_told(48, 0);
            restitute_impact impact = impact_with(&solids[k], chi, psi);
            restitute_solver *solver;
            restitute_history history;
            restitute_result result;
            static double velocity[capacity], stick[capacity], contact[capacity];
            restitute_history_init(&history);
            restitute_result_init(&result);
            history.capacity = capacity;
            history.normal_velocity = velocity;
            history.stick_radius = stick;
            history.contact_radius = contact;
            assert_int_equal(restitute_solver_create(&options, &solver, NULL), RESTITUTE_OK);
            assert_true(restitute_solve(solver, &impact, &result, NULL, &history, NULL) >= 0);
            restitute_solver_destroy(solver);
            size_t first = 1;
            while (first < history.count && stick[first] <= 0)
                first++;
            CHECK(first < history.count, "%s, chi %g: never sticks", solids[k].name, chi);
            CHECK(stick[first] == contact[first], "%s, chi %g: %g of %g sticks at first", solids[k].name, chi,
                  stick[first], contact[first]);
            /* the switch is made at the end of a step and seen in the next one */
            const double end = (2 * chi - psi) / (2 * chi - 1);
            CHECK(velocity[first - 1] <= end + 1e-9 && (first < 2 || velocity[first - 2] > end - 1e-9),
                  "%s, chi %g: seen after %g, not %g", solids[k].name, chi, velocity[first - 1], end);
        }
}

/* Rounding of the caller does not decide on how a contact begins: psi within 1e-12 of 1 is 1, to
 * the bit. */
static void psi_within_rounding_of_1_is_1(void **state)
{
    (void)state;
    const double eps = 2.220446049250313e-16, off[] = {-9e-13, -eps, eps, 5 * eps, 20 * eps, 9e-13};
    restitute_options options[] = {as_told(16, 0), to_tolerance(1e-5)};
    options[1].method = restitute_method_sync();
    for (int m = 0; m < 2; m++)
        for (int k = 0; k < n_solids; k++)
            for (int i = 0; i < n_chis; i++) {
                const double ex = solve_pair(options[m], impact_with(&solids[k], chis[i], 1)).result.ex;
                for (size_t j = 0; j < sizeof off / sizeof *off; j++) {
                    const restitute_impact next = impact_with(&solids[k], chis[i], 1 + off[j]);
                    const double found = solve_pair(options[m], next).result.ex;
                    CHECK(found == ex, "%s, chi %g, psi - 1 = %g: %.17g, not %.17g", solids[k].name, chis[i], off[j],
                          found, ex);
                }
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_slip_has_ex_of_27),
        cmocka_unit_test(slip_persists_to_the_end_from_psi_c_on),
        cmocka_unit_test(psi_c_is_2_chi_1_plus_ez_minus_ez),
        cmocka_unit_test(contact_begins_in_stick_if_and_only_if_psi_is_at_most_1),
        cmocka_unit_test(gross_slip_ends_everywhere_at_once),
        cmocka_unit_test(psi_within_rounding_of_1_is_1),
    };
    return cmocka_run_group_tests(tests, make_solids, destroy_solids);
}
