/* Published curves: ice that no linear solid follows, a golf ball that a drop test hardly
 * determines, polyisobutylene back from its own storage and loss modulus.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "../support/fit.h"

/* e = 0.34 v^(-0.234), v in cm/s: Bridges, Hatzes and Lin, Nature 309, 1984; a sphere of 2.75 cm on
 * ice. G = 3.5 GPa. */
static restitute_fit_result fit_ice(int model, double from)
{
    enum { N = 20 };
    static const double known[] = {3.5e9, NAN, NAN};
    restitute_scene scenes[N];
    restitute_fit_point points[N];
    restitute_fit_options options = fit_options(model);
    drops(N, from / 100, 0.05, scenes, points);
    for (int i = 0; i < N; i++) {
        scenes[i].radius1 = 0.0275, scenes[i].mass1 = 0.0799;
        scenes[i].deformable = RESTITUTE_BOTH_BODIES_DEFORM;
        points[i].ez = 0.34 * pow(100 * scenes[i].normal_speed, -0.234);
    }
    options.known = known, options.poisson_ratio = 0.33;
    return fitted(N, points, &options);
}

/* Damping in proportion to the rate is the steepest that a linear solid has, and the law is steeper
 * at low speeds: the standard solid becomes Kelvin-Voigt's. From 0.8 cm/s on both are within the
 * scatter of the measurement, about 0.02. */
static void ice(void **state)
{
    (void)state;
    restitute_fit_result kv = fit_ice(RESTITUTE_FIT_MODEL_KELVIN_VOIGT, 0.05);
    CHECK(kv.flags & RESTITUTE_FIT_FLAG_MISFIT && kv.rms > 0.05, "rms %g: %s", kv.rms, kv.remarks);
    restitute_fit_result solid = fit_ice(RESTITUTE_FIT_MODEL_STANDARD_SOLID, 0.05);
    CHECK(solid.flags & RESTITUTE_FIT_FLAG_MISFIT, "%s", solid.remarks);
    CHECK_NEAR(solid.rms, kv.rms, 1e-3, "the standard solid is no better");
    restitute_fit_result upper = fit_ice(RESTITUTE_FIT_MODEL_KELVIN_VOIGT, 0.8);
    CHECK(upper.rms < 0.015, "rms %g from 0.8 cm/s on", upper.rms);
    restitute_material_destroy(kv.material);
    restitute_material_destroy(solid.material);
    restitute_material_destroy(upper.material);
}

/* Mean rebounds of a golf ball (41.5 g, 42 mm) from marble: Ali, Broggi, Cantarini, Misura del
 * coefficiente di restituzione, a students' report in the public repository
 * giiulia/LabI-Dynamics-Thermodynamics. Means of ten drops. */
static void golf_ball(void **state)
{
    static const double drop[] = {0.80, 0.90, 1.00, 1.10}, rebound[] = {0.6383, 0.7198, 0.7902, 0.8677},
                        sigma[] = {0.00148, 0.00135, 0.00232, 0.00205};
    restitute_scene scenes[4];
    restitute_fit_point points[4];
    (void)state;
    drops(4, 1, 1, scenes, points);
    for (int i = 0; i < 4; i++) {
        scenes[i].radius1 = 0.021, scenes[i].mass1 = 0.0415;
        scenes[i].normal_speed = sqrt(2 * 9.80665 * drop[i]);
        points[i].ez = sqrt(rebound[i] / drop[i]);
        points[i].sigma_ez = 0.5 * points[i].ez * sigma[i] / rebound[i];
    }
    restitute_fit_options options = fit_options(RESTITUTE_FIT_MODEL_KELVIN_VOIGT);
    const double known[] = {1e8, NAN};
    options.known = known;
    restitute_fit_result r = fitted(4, points, &options);
    CHECK(!(r.flags & (RESTITUTE_FIT_FLAG_MISFIT | RESTITUTE_FIT_FLAG_UNDETERMINED)), "%s", r.remarks);
    CHECK(r.high[1] < 1.15 * r.low[1], "eta in [%g, %g]", r.low[1], r.high[1]);
    CHECK(r.flags & RESTITUTE_FIT_FLAG_LIMITS, "a ball of 100 MPa is flattened: %s", r.remarks);
    restitute_material_destroy(r.material);
    options.noise_known = 1; /* the standard errors of the means are half of what the four values scatter */
    r = fitted(4, points, &options);
    CHECK(r.flags & RESTITUTE_FIT_FLAG_MISFIT, "%s", r.remarks);
    restitute_material_destroy(r.material);
    options = fit_options(RESTITUTE_FIT_MODEL_STANDARD_SOLID);
    options.noise_known = 1;
    r = fitted(4, points, &options);
    CHECK(r.rank == 1 && r.flags & RESTITUTE_FIT_FLAG_UNDETERMINED, "four speeds within 17 %%: %s", r.remarks);
    restitute_material_destroy(r.material);
}

enum { MOST = 400 };

struct curve {
    size_t n, terms;
    double tau[40], g[40], f[MOST], storage[MOST], loss[MOST], temperature[MOST];
};

/* tests/data/pib_prony.csv, which names its source. */
static void read_series(struct curve *c)
{
    char line[200];
    FILE *file = fopen(RESTITUTE_SOURCE_DIR "/tests/data/pib_prony.csv", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        if (sscanf(line, "%lf,%lf", &c->tau[c->terms], &c->g[c->terms]) == 2) c->terms++;
    fclose(file);
    assert_int_equal(c->terms, 30);
}

static void add_row(struct curve *c, double omega, double shift, double noise, uint64_t *seed)
{
    double storage = 0, loss = 0;
    for (size_t k = 0; k < c->terms; k++) {
        const double x = omega * shift * c->tau[k];
        storage += c->g[k] * x * x / (1 + x * x), loss += c->g[k] * x / (1 + x * x);
    }
    c->f[c->n] = omega / 6.283185307179586;
    c->storage[c->n] = storage * (1 + noise * gauss(seed));
    c->loss[c->n++] = loss * (1 + noise * gauss(seed));
}

static double worst_difference(const struct curve *c, const restitute_dma_result *r, double from, double to)
{
    double worst = 0;
    for (double t = from; t < to; t *= 1.1) {
        double truth = 0, found = r->equilibrium_modulus;
        for (size_t k = 0; k < c->terms; k++)
            truth += c->g[k] * exp(-t / c->tau[k]);
        for (size_t k = 0; k < r->terms; k++)
            found += r->modulus[k] * exp(-t / r->relaxation_time[k]);
        worst = fmax(worst, fabs(found / truth - 1));
    }
    return worst;
}

static restitute_dma_result fit_curve(const struct curve *c, const double *temperature,
                                      const restitute_dma_options *options)
{
    restitute_dma_result r;
    restitute_error error;
    restitute_dma_result_init(&r);
    CHECK(restitute_dma_fit(c->n, c->f, c->storage, c->loss, temperature, options, &r, &error) == RESTITUTE_OK, "%s",
          error.message);
    for (size_t k = 0; k < r.terms; k++)
        CHECK(r.modulus[k] > 0, "term %zu", k);
    return r;
}

/* Within 2 % over eighteen decades, with fewer terms; the two of 0.1 Pa at 1e6 s and beyond cannot
 * be seen. */
static void polyisobutylene(void **state)
{
    struct curve c = {0};
    uint64_t seed = 1;
    (void)state;
    read_series(&c);
    for (int i = 0; i <= 168; i++)
        add_row(&c, pow(10, -8 + i / 8.0), 1, 0, &seed);
    restitute_dma_result r = fit_curve(&c, NULL, NULL);
    CHECK(r.terms <= 30, "%zu terms", r.terms);
    CHECK(r.equilibrium_modulus == 0, "it has none: %g", r.equilibrium_modulus);
    const double worst = worst_difference(&c, &r, 1e-12, 1e6);
    CHECK(worst < 0.02, "%zu terms, off by %g", r.terms, worst);
    restitute_material_destroy(r.material);
    restitute_dma_options options;
    restitute_dma_options_init(&options);
    options.tension = 1; /* the moduli taken for those of tension: G = E/3 */
    r = fit_curve(&c, NULL, &options);
    CHECK_NEAR(3 * r.modulus[r.terms - 1], c.g[27], 0.05 * c.g[27], "a third");
    restitute_material_destroy(r.material);
}

/* Nine temperatures, three decades of frequency each, 1 % noise: shifts come back, and the
 * constants that made them. */
static void master_curve(void **state)
{
    static const double temperatures[] = {-60, -50, -40, -25, -10, 5, 25, 45, 65};
    struct curve c = {0};
    uint64_t seed = 3;
    restitute_dma_options options;
    (void)state;
    read_series(&c);
    for (int k = 0; k < 9; k++)
        for (int i = 0; i < 16; i++) {
            const double difference = temperatures[k] - 25;
            c.temperature[c.n] = temperatures[k];
            add_row(&c, 0.6 * pow(10, 0.2 * i), pow(10, -8.61 * difference / (200.4 + difference)), 0.01, &seed);
        }
    restitute_dma_options_init(&options);
    options.reference_temperature = 25;
    restitute_dma_result r = fit_curve(&c, c.temperature, &options);
    assert_int_equal(r.temperatures, 9);
    for (size_t k = 0; k < 9; k++) { /* 1 % of 32 moduli on a slope of at least 0.1 a decade: some per cent of a_T */
        const double difference = r.temperature[k] - 25;
        CHECK_NEAR(log10(r.shift[k]), -8.61 * difference / (200.4 + difference), 0.03, "%g C", r.temperature[k]);
    }
    CHECK_NEAR(r.wlf_c1, 8.61, 0.2, "C1");
    CHECK_NEAR(r.wlf_c2, 200.4, 4, "C2");
    CHECK(!r.flags, "%s", r.remarks);
    restitute_material_destroy(r.material);
    for (size_t i = 0; i < c.n; i++) /* moduli that no shift of time explains */
        if (c.temperature[i] > 30) c.storage[i] *= 2;
    r = fit_curve(&c, c.temperature, &options);
    CHECK(r.flags & RESTITUTE_FIT_FLAG_MISFIT, "rms %g", r.rms);
    restitute_material_destroy(r.material);
    struct curve gap = {0}; /* a decade each, six decades apart */
    read_series(&gap);
    for (int i = 0; i < 12; i++) {
        gap.temperature[gap.n] = i < 6 ? 25 : -60;
        add_row(&gap, pow(10, 0.2 * (i % 6)), i < 6 ? 1 : 2e6, 0, &seed);
    }
    r = fit_curve(&gap, gap.temperature, NULL);
    CHECK(r.flags & RESTITUTE_FIT_FLAG_UNDETERMINED && strstr(r.remarks, "do not overlap"), "%s", r.remarks);
    restitute_material_destroy(r.material);
}

/* Three rows carry six unknowns, of which the grid of the first fit has more. */
static void few_rows(void **state)
{
    const double f[] = {1, 2, 3}, storage[] = {2, 3, 4}, loss[] = {3, 4, 5};
    restitute_dma_result r;
    (void)state;
    restitute_dma_result_init(&r);
    assert_int_equal(restitute_dma_fit(3, f, storage, loss, NULL, NULL, &r, NULL), RESTITUTE_OK);
    CHECK(2 * r.terms + (r.equilibrium_modulus > 0) <= 6, "%zu terms", r.terms);
    CHECK(r.flags & RESTITUTE_FIT_FLAG_UNDETERMINED && strstr(r.remarks, "relaxation times"), "half a decade: %s",
          r.remarks);
    CHECK(r.rms < 0.03, "rms %g", r.rms); /* slopes of 0.6 and 0.5 a decade of both: two terms come near */
    restitute_material_destroy(r.material);
}

static void curve_refusals(void **state)
{
    const double f[] = {1, 10, 100}, storage[] = {1e6, 2e6, 3e6}, loss[] = {1e5, -1, 1e5};
    restitute_dma_result r;
    restitute_error error;
    (void)state;
    restitute_dma_result_init(&r);
    assert_int_equal(restitute_dma_fit(3, f, storage, loss, NULL, NULL, &r, &error), RESTITUTE_ERROR_DOMAIN);
    assert_non_null(strstr(error.message, "row[1]: loss = -1"));
    assert_int_equal(restitute_dma_fit(2, f, storage, storage, NULL, NULL, &r, &error), RESTITUTE_ERROR_DOMAIN);
    assert_int_equal(restitute_dma_fit(3, f, storage, NULL, NULL, NULL, &r, &error), RESTITUTE_ERROR_NULL);
    assert_int_equal(r.terms, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ice), cmocka_unit_test(golf_ball),
                                       cmocka_unit_test(polyisobutylene), cmocka_unit_test(master_curve),
                                       cmocka_unit_test(few_rows), cmocka_unit_test(curve_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
