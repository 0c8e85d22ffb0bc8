/* Impacts with the contact law, 50 steps a contact, give the restitution pair of the library.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/contact.h"
#include "../support/random.h"

/* One random impact: chi, psi and one of the solids below. */
struct drawn {
    double chi, psi, g_inf, theta, tau[3], g[3];
    size_t n_terms;
};

enum { kinds = 6 };
enum kind { ELASTIC, STANDARD, KELVIN_VOIGT, TWO_TERMS, THREE_TERMS, MAXWELL };

/* Solid spheres, psi to 4, delta1 to 30; wide: any sphere that turns and shells, psi to 10, delta1
 * to 100. */
static struct drawn draw(uint64_t *seed, enum kind kind, int wide)
{
    const double delta1 = random_log(seed, 1e-3, wide ? 100 : 30), gamma = random_log(seed, 0.01, 100);
    struct drawn d = {.g_inf = kind == MAXWELL ? 0 : 1};
    d.chi = wide ? random_in(seed, 1.0 / 3, 4) : random_in(seed, 7.0 / 6, 7.0 / 4);
    d.psi = random_in(seed, 0, wide ? 10 : 4);
    if (kind == STANDARD) d.n_terms = 1, d.tau[0] = gamma * THETA_OF_DELTA1 * delta1, d.g[0] = 1 / gamma;
    if (kind == KELVIN_VOIGT) d.theta = THETA_OF_DELTA1 * delta1;
    if (kind == TWO_TERMS || kind == THREE_TERMS) {
        d.n_terms = kind == TWO_TERMS ? 2 : 3;
        for (size_t k = 0; k < d.n_terms; k++)
            d.tau[k] = random_log(seed, 1e-3, 30), d.g[k] = random_log(seed, 0.03, 10);
    }
    if (kind == MAXWELL) d.n_terms = 1, d.tau[0] = random_log(seed, 0.5, 100), d.g[0] = 1; /* below, it sinks */
    return d;
}

/* What the library says; the contact time, in T, and whether there is a rebound. */
static int reference(restitute_solver *solver, const struct drawn *d, restitute_result *result)
{
    restitute_error error;
    restitute_material *solid = solid_of(d->g_inf, d->theta, d->n_terms, d->tau, d->g);
    restitute_impact impact = impact_on(solid, d->chi, d->psi);
    restitute_result_init(result);
    const int status = restitute_solve(solver, &impact, result, NULL, NULL, &error);
    restitute_material_destroy(solid);
    CHECK(status >= 0, "%s", error.message);
    return status != RESTITUTE_NO_REBOUND;
}

static restitute_solver *reference_solver(void)
{
    restitute_options options = to_tolerance(1e-5); /* a thousandth of the error that is counted here */
    restitute_solver *solver;
    options.method = restitute_method_sync();
    assert_int_equal(restitute_solver_create(&options, &solver, NULL), 0);
    return solver;
}

struct tally {
    long count, beyond; /* beyond: an error above 0.01 */
    double largest, sum;
};

/* The DEM impact at four phases of first touch, with steps of the contact time over
 * `per_contact`. */
static void compare(const struct drawn *d, const restitute_result *exact, int elements, double per_contact, int wide,
                    struct tally *tally)
{
    struct dem_impact impact =
        dem_impact_of(dem_material(d->g_inf, d->theta, d->n_terms, d->tau, d->g), d->chi, d->psi);
    const double elastic_time = dem_contact_time(&impact);
    impact.elements = elements;
    impact.angle = 0.3;
    /* strongly damped contacts last long: the limit of the law is then the shorter time */
    impact.time_step = (wide ? elastic_time : fmin(elastic_time, exact->contact_time * depth)) / per_contact;
    for (int phase = 0; phase < 4; phase++) {
        impact.phase = (phase + 0.5) / 4;
        const struct dem_result r = dem_collide(&impact);
        const double error = fmax(fabs(r.ez - exact->ez), fabs(r.ex - exact->ex));
        assert_int_equal(r.status, 0);
        CHECK(r.work <= 1e-12, "chi %.4g psi %.4g: the contact did work %.3g", d->chi, d->psi, r.work);
        CHECK(fabs(r.across) < 1e-12, "chi %.4g psi %.4g: across %.3g", d->chi, d->psi, r.across);
        if (!(error <= tally->largest)) tally->largest = error;
        tally->count++;
        tally->beyond += !(error <= 0.01);
        tally->sum += error;
    }
    restitute_material_destroy(impact.material);
}

static struct tally run(int sets, int elements, double per_contact, int wide)
{
    restitute_solver *solver = reference_solver();
    struct tally all = {0};
    uint64_t seed = 2017;
    for (int i = 0; i < sets; i++) {
        const struct drawn d = draw(&seed, (enum kind)(i % kinds), wide);
        restitute_result exact;
        if (reference(solver, &d, &exact)) compare(&d, &exact, elements, per_contact, wide, &all);
    }
    restitute_solver_destroy(solver);
    print_message("%d elements, %g steps: %ld impacts, %ld beyond 0.01, largest %.4f, mean %.5f\n", elements,
                  per_contact, all.count, all.beyond, all.largest, all.sum / (double)all.count);
    return all;
}

/* Errors of 99.5 % of all impacts with solid spheres are within 0.01, and none is above 0.03. */
static void pairs_agree_with_the_library(void **unused)
{
    (void)unused;
    const struct tally all = run(2000, 8, 50, 0);
    CHECK(all.count > 7500, "only %ld impacts rebound", all.count);
    CHECK((double)all.beyond <= 0.005 * (double)all.count, "%ld of %ld beyond 0.01", all.beyond, all.count);
    CHECK(all.largest <= 0.03, "largest error %.4f", all.largest);
}

static void pairs_agree_in_the_wide_domain(void **unused)
{
    (void)unused;
    const struct tally all = run(1000, 8, 50, 1);
    CHECK((double)all.beyond <= 0.01 * (double)all.count, "%ld of %ld beyond 0.01", all.beyond, all.count);
}

/* Steps and elements are refined in turn: with the other fine enough, halving each must halve the
 * mean error. */
static void errors_fall_with_the_step(void **unused)
{
    (void)unused;
    const struct tally coarse = run(240, 32, 25, 0), fine = run(240, 32, 100, 0);
    CHECK(fine.sum <= coarse.sum / 4, "mean error %.3g after %.3g", fine.sum, coarse.sum);
}

static void errors_fall_with_elements(void **unused)
{
    (void)unused;
    const struct tally coarse = run(240, 8, 800, 0), fine = run(240, 32, 800, 0);
    CHECK(fine.sum <= coarse.sum / 4, "mean error %.3g after %.3g", fine.sum, coarse.sum);
}

/* What an impact loses is in the three energies: of 2000 impacts the worst one, of a Kelvin-Voigt
 * solid, misses 3.5 % of the kinetic energy, with 8 elements. */
static void lost_energy_is_accounted_for(void **unused)
{
    (void)unused;
    uint64_t seed = 7;
    double worst = 0, mean = 0;
    for (int i = 0; i < 2000; i++) {
        const enum kind kind = (enum kind)(i % kinds);
        const struct drawn d = draw(&seed, kind, 0);
        struct dem_impact impact = dem_impact_of(dem_material(d.g_inf, d.theta, d.n_terms, d.tau, d.g), d.chi, d.psi);
        impact.time_step = dem_contact_time(&impact) / 50;
        impact.details = 1;
        const struct dem_result r = dem_collide(&impact);
        const double masses = impact.tangential_mass / impact.mass,
                     vx = d.psi * impact_friction * (2 - impact_nu) / (2 - 2 * impact_nu);
        const double before = 1 + masses * vx * vx, after = r.ez * r.ez + masses * vx * vx * r.ex * r.ex;
        const double lost = 1 - after / before, found = r.spent.stored + r.spent.friction + r.spent.viscous;
        CHECK_NEAR(r.spent.work, -r.work, 1e-10, "impact %d: work", i); /* thousands of sums */
        if (kind == ELASTIC) CHECK(r.spent.viscous <= 0, "impact %d: viscous %g", i, r.spent.viscous);
        worst = fmax(worst, fabs(found - lost));
        mean += fabs(found - lost) / 2000;
        restitute_material_destroy(impact.material);
    }
    print_message("energies beside the loss: off by at most %.4f of the kinetic energy, mean %.5f\n", worst, mean);
    CHECK(worst < 0.045 && mean < 0.004, "energies are off by up to %.4f, mean %.5f", worst, mean);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_agree_with_the_library), cmocka_unit_test(pairs_agree_in_the_wide_domain),
        cmocka_unit_test(errors_fall_with_the_step),    cmocka_unit_test(errors_fall_with_elements),
        cmocka_unit_test(lost_energy_is_accounted_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
