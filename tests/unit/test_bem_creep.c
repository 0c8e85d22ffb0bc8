/* Relaxation to creep: poles interlace, and int_0^t G(t - s) J(s) ds = t.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/check.h"
#include "../support/random.h"
#include "bem/kernels.h"
#include "bem/solid.h"

enum { most = 32 };

struct creep {
    double instantaneous, flow, compliance[most], lambda[most];
    int64_t n;
};

static struct creep creep_of(double g_inf, int64_t n, const double *g, const double *tau)
{
    struct creep c;
    rst_bem_creep_form(g_inf, n, g, tau, &c.instantaneous, &c.flow, &c.n, c.compliance, c.lambda);
    return c;
}

/* int_0^t exp(-(t-s)/a) (1 - exp(-s/b)) ds, without cancellation where t is far below or above a
 * and b. */
static double exponential_pair(double t, double a, double b)
{
    double sum = 0; /* Gauss-Legendre of 3 nodes on cells that grow from both ends: smooth, error below 1e-9 */
    static const double node[] = {-0.7745966692414834, 0, 0.7745966692414834},
                        weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    enum { cells = 4000 };
    for (int i = 0; i < cells; i++)
        for (int k = 0; k < 3; k++) {
            const double z = (i + 0.5 + 0.5 * node[k]) / cells; /* 0 to 1 */
            const double s = t * z * z * (3 - 2 * z), rate = t * 6 * z * (1 - z) / cells;
            sum += weight[k] * rate * exp(-(t - s) / a) * -expm1(-s / b);
        }
    return sum;
}

/* G(t) * J(t): times of elastic, relaxing and flowing parts. */
static double product(double t, double g_inf, int64_t n, const double *g, const double *tau, const struct creep *c)
{
    double sum = g_inf * (c->instantaneous * t + c->flow * t * t / 2);
    for (int64_t j = 0; j < c->n; j++)
        sum += g_inf * c->compliance[j] * (t + c->lambda[j] * expm1(-t / c->lambda[j]));
    for (int64_t i = 0; i < n; i++) {
        const double e = -expm1(-t / tau[i]);
        sum += g[i] * (c->instantaneous * tau[i] * e + c->flow * tau[i] * (t - tau[i] * e));
        for (int64_t j = 0; j < c->n; j++)
            sum += g[i] * c->compliance[j] * exponential_pair(t, tau[i], c->lambda[j]);
    }
    return sum;
}

static void standard_solid_is_known(void **state)
{
    const double g = 3, tau = 0.4;
    const struct creep c = creep_of(2, 1, &g, &tau);
    (void)state;
    assert_int_equal(c.n, 1);
    CHECK_NEAR(c.instantaneous, 1.0 / 5, 1e-16, "1/(G1 + G2)");
    CHECK_NEAR(c.compliance[0], 1.0 / 2 - 1.0 / 5, 1e-15, "1/G1 - 1/(G1 + G2)");
    CHECK_NEAR(c.lambda[0], 0.4 * 3 * 5 / (2.0 * 3), 1e-15, "eta (G1 + G2)/(G1 G2), eta = G2 tau");
    assert_true(c.flow == 0);
}

static void maxwell_flows(void **state)
{
    const double g = 3, tau = 0.4;
    const struct creep c = creep_of(0, 1, &g, &tau);
    (void)state;
    assert_int_equal(c.n, 0);
    CHECK_NEAR(c.instantaneous, 1.0 / 3, 1e-16, "1/G");
    CHECK_NEAR(c.flow, 1 / 1.2, 1e-15, "1/eta");
}

static void poles_interlace_and_product_is_t(void **state)
{
    uint64_t seed = 11;
    (void)state;
    for (int round = 0; round < 40; round++) {
        double g[6], tau[6];
        const int64_t n = 1 + random_below(&seed, 6);
        const double g_inf = round % 4 == 0 ? 0 : random_log(&seed, 0.1, 10);
        for (int64_t k = 0; k < n; k++) {
            tau[k] = random_log(&seed, 1e-2, 1e2); /* wider spectra: next test */
            g[k] = random_log(&seed, 0.01, 10);
        }
        const struct creep c = creep_of(g_inf, n, g, tau);
        assert_int_equal(c.n, g_inf > 0 ? n : n - 1);
        for (int64_t j = 0; j < c.n; j++) {
            int above = 0, below = 0;
            for (int64_t k = 0; k < n; k++)
                above += tau[k] > c.lambda[j], below += tau[k] < c.lambda[j];
            CHECK(c.compliance[j] > 0, "round %d: J = %g", round, c.compliance[j]);
            int larger = 0; /* retardation times above this one: as many as relaxation times above it, or one less */
            for (int64_t i = 0; i < c.n; i++)
                larger += c.lambda[i] > c.lambda[j];
            CHECK(above + below == n && larger == above - (g_inf > 0 ? 0 : 1),
                  "round %d: lambda %g: %d above, %d larger", round, c.lambda[j], above, larger);
        }
        for (double t = 0.05; t < 20; t *= 3)
            CHECK_NEAR(product(t, g_inf, n, g, tau, &c) / t, 1, 1e-7, "round %d, t = %g", round,
                       t); /* the quadrature's */
    }
}

/* Transforms: s G(s) times s J(s) is 1, over twenty decades of relaxation times, as polymers
 * have. */
static void wide_spectrum(void **state)
{
    double g[30], tau[30];
    (void)state;
    for (int k = 0; k < 30; k++) {
        tau[k] = pow(10, -12 + 0.7 * k);
        g[k] = pow(10, 6 - 0.15 * k);
    }
    for (int flows = 0; flows < 2; flows++) {
        const double g_inf = flows ? 0 : 1;
        const struct creep c = creep_of(g_inf, 30, g, tau);
        for (double s = 1e-12; s < 1e14; s *= 7) {
            double modulus = g_inf, compliance = c.instantaneous + c.flow / s;
            for (int k = 0; k < 30; k++)
                modulus += g[k] * s * tau[k] / (1 + s * tau[k]);
            for (int64_t k = 0; k < c.n; k++)
                compliance += c.compliance[k] / (1 + s * c.lambda[k]);
            CHECK_NEAR(modulus * compliance, 1, 1e-12, "flows %d, s = %g", flows, s); /* some ten thousand roundings */
        }
    }
}

/* b of one term after f(t) = t^2 in many small steps, and in the one step that is exact for a
 * line. */
static void recursion_is_exact_for_lines(void **state)
{
    double compliance = 0.7, lambda = 0.3, decay, gain, b = 0;
    struct bem_solid s = {.instantaneous = 0.2,
                          .n_terms = 1,
                          .compliance = &compliance,
                          .lambda = &lambda,
                          .decay = &decay,
                          .gain = &gain};
    (void)state;
    rst_bem_solid_step(0.125, 0, &s);
    for (int i = 0; i < 8; i++)
        b = decay * b + gain * 0.125; /* f = t */
    CHECK_NEAR(b, 0.7 * 0.3 * -expm1(-1 / 0.3), 1e-15, "int_0^1 J exp(-(1-s)/lambda) ds");
    CHECK_NEAR(s.c, 0.2 + 0.7 - gain, 1e-15, "C = J_inf - gain");
    CHECK_NEAR(s.held, gain, 1e-15, "held");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(standard_solid_is_known), cmocka_unit_test(maxwell_flows),
                                       cmocka_unit_test(poles_interlace_and_product_is_t),
                                       cmocka_unit_test(wide_spectrum), cmocka_unit_test(recursion_is_exact_for_lines)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
