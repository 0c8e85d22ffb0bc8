/* Two bodies of unlike materials as one solid: the series of their chains.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/random.h"
#include "../support/solve.h"

enum { most_terms = 6 };

struct chain {
    double g_inf;
    int n;
    double g[most_terms], tau[most_terms];
};

static restitute_material *material_of(const struct chain *c, double nu)
{
    restitute_material *material;
    restitute_error error;
    CHECK(restitute_material_prony(c->g_inf, 0, (size_t)c->n, c->tau, c->g, nu, &material, &error) == RESTITUTE_OK,
          "%s", error.message);
    return material;
}

static restitute_material *pair_of(const restitute_material *a, const restitute_material *b)
{
    restitute_material *pair;
    restitute_error error;
    CHECK(restitute_material_effective(a, b, &pair, &error) == RESTITUTE_OK, "%s", error.message);
    return pair;
}

/* Stress after a step of strain h-linear in time: w <- E w + (tau/h)(1-E) d_strain, exact for
 * it. */
static void respond(const struct chain *c, double h, const double *w, double strain, double *rest, double *stiffness)
{
    *rest = c->g_inf * strain;
    *stiffness = c->g_inf;
    for (int k = 0; k < c->n; k++) {
        double decay = exp(-h / c->tau[k]);
        *rest += c->g[k] * decay * w[k];
        *stiffness += c->g[k] * c->tau[k] / h * (1 - decay);
    }
}

static void update(const struct chain *c, double h, double move, double *w)
{
    for (int k = 0; k < c->n; k++)
        w[k] = exp(-h / c->tau[k]) * w[k] + c->tau[k] / h * (1 - exp(-h / c->tau[k])) * move;
}

/* Direct solution of the Volterra equations: a unit step of the sum of both strains, equal
 * stresses; stress at time t. */
static double relaxation_by_volterra(const struct chain *a, const struct chain *b, double t, int steps)
{
    double wa[most_terms], wb[most_terms], ga = a->g_inf, gb = b->g_inf, h = t / steps, stress = 0;
    for (int k = 0; k < a->n; k++)
        ga += a->g[k];
    for (int k = 0; k < b->n; k++)
        gb += b->g[k];
    double strain_a = gb / (ga + gb), strain_b = ga / (ga + gb);
    for (int k = 0; k < a->n; k++)
        wa[k] = strain_a;
    for (int k = 0; k < b->n; k++)
        wb[k] = strain_b;
    for (int i = 0; i < steps; i++) {
        double rest_a, rest_b, stiffness_a, stiffness_b;
        respond(a, h, wa, strain_a, &rest_a, &stiffness_a);
        respond(b, h, wb, strain_b, &rest_b, &stiffness_b);
        double move = (rest_b - rest_a) / (stiffness_a + stiffness_b); /* what a gains, b loses */
        stress = rest_a + stiffness_a * move;
        strain_a += move;
        strain_b -= move;
        update(a, h, move, wa);
        update(b, h, -move, wb);
    }
    return stress;
}

static struct chain draw(uint64_t *random)
{
    struct chain c = {.g_inf = random_below(random, 3) ? random_log(random, 0.1, 10) : 0};
    c.n = 1 + random_below(random, most_terms);
    for (int k = 0; k < c.n; k++) {
        c.g[k] = random_log(random, 0.1, 10);
        c.tau[k] = random_log(random, 0.03, 30);
    }
    return c;
}

/* The scheme is of second order: one Richardson step on 2000 and 4000 steps leaves some (h/tau)^3 ~
 * 1e-6 of the modulus (tau >= 0.03, and times down to 0.2 with h = 1e-4 there). */
static void relaxation_of_the_pair_is_that_of_the_volterra_equations(void **state)
{
    (void)state;
    uint64_t random = 9;
    for (int i = 0; i < 25; i++) {
        struct chain a = draw(&random), b = draw(&random);
        if (i % 5 == 0) b.tau[0] = a.tau[0]; /* a time that both have */
        restitute_material *ma = material_of(&a, 0.5), *mb = material_of(&b, 0.5), *pair = pair_of(ma, mb);
        CHECK(restitute_material_dundurs(pair) == 0 && restitute_material_poisson_ratio(pair) == 0.5, "incompressible");
        for (double t = 0.2; t < 20; t *= 3) {
            double coarse = relaxation_by_volterra(&a, &b, t, 2000), fine = relaxation_by_volterra(&a, &b, t, 4000);
            double expected = (4 * fine - coarse) / 3;
            CHECK_NEAR(restitute_material_modulus(pair, t), expected, 1e-5 * expected + 1e-9, "pair %d at %g", i, t);
        }
        restitute_material_destroy(ma);
        restitute_material_destroy(mb);
        restitute_material_destroy(pair);
    }
}

/* Two equal bodies are half as stiff in every direction. */
static void a_pair_of_one_material_is_half_of_it(void **state)
{
    (void)state;
    struct chain c = {2, 2, {1, 3}, {0.1, 4}};
    restitute_material *m = material_of(&c, 0.3), *pair = pair_of(m, m);
    for (double t = 1e-3; t < 1e3; t *= 7)
        CHECK_NEAR(restitute_material_modulus(pair, t), 0.5 * restitute_material_modulus(m, t), 1e-14, "at %g", t);
    CHECK(restitute_material_terms(pair) == 2 && restitute_material_poisson_ratio(pair) == 0.3, "terms, nu");
    CHECK(restitute_material_dundurs(pair) == 0, "beta");

    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = m;
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    scene.radius1 = scene.radius2 = 1, scene.mass1 = scene.mass2 = 1, scene.friction = 0.2;
    scene.normal_speed = 1, scene.tangential_speed = 0.5;
    struct restitute_result like = solve_scene(default_options(), &scene).result;
    scene.material = pair;
    scene.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    struct restitute_result unlike = solve_scene(default_options(), &scene).result;
    CHECK_NEAR(like.ez, unlike.ez, 1e-12, "rounding of the moduli");
    CHECK_NEAR(like.ex, unlike.ex, 1e-12, "rounding of the moduli");
    restitute_material_destroy(m);
    restitute_material_destroy(pair);
}

/* By hand, E = 2 G (1 + nu) in GPa: steel 210 and 0.3 on glass 70 and 0.25. */
static void steel_on_glass_has_the_usual_constants(void **state)
{
    (void)state;
    restitute_material *steel = NULL, *glass = NULL;
    double gs = 210e9 / 2.6, gg = 70e9 / 2.5;
    CHECK(restitute_material_elastic(gs, 0.3, &steel, NULL) == 0 &&
              restitute_material_elastic(gg, 0.25, &glass, NULL) == 0,
          "materials");
    restitute_material *pair = pair_of(steel, glass);
    double e_star = 1 / ((1 - 0.09) / 210e9 + (1 - 0.0625) / 70e9);
    double g_star = 1 / ((2 - 0.3) / (4 * gs) + (2 - 0.25) / (4 * gg));
    double nu = restitute_material_poisson_ratio(pair), g = restitute_material_modulus(pair, 1);
    CHECK_NEAR(2 * g / (1 - nu), e_star, 1e-13 * e_star, "normal stiffness, rounding");
    CHECK_NEAR(4 * g / (2 - nu), g_star, 1e-13 * g_star, "tangential stiffness, rounding");
    double beta = 0.5 * (0.4 / gs - 0.5 / gg) / (0.7 / gs + 0.75 / gg);
    CHECK_NEAR(restitute_material_dundurs(pair), beta, 1e-14, "Dundurs");
    restitute_material *other = pair_of(glass, steel);
    CHECK_NEAR(restitute_material_dundurs(other), -beta, 1e-14, "beta changes its sign with the order");
    restitute_material_destroy(steel);
    restitute_material_destroy(glass);
    restitute_material_destroy(pair);
    restitute_material_destroy(other);
}

/* A partner 1e6 times stiffer is rigid to that part. */
static void a_hard_partner_is_nearly_rigid(void **state)
{
    (void)state;
    struct chain rubber = {1e6, 2, {2e6, 1e6}, {1e-4, 1e-2}}, hard = {1e12, 0, {0}, {0}};
    restitute_material *soft = material_of(&rubber, 0.5), *steel = material_of(&hard, 0.3),
                       *pair = pair_of(steel, soft);
    for (double t = 1e-6; t < 10; t *= 10) {
        double g = restitute_material_modulus(soft, t);
        CHECK_NEAR(restitute_material_modulus(pair, t), g, 1e-5 * g, "at %g", t);
    }
    CHECK_NEAR(restitute_material_poisson_ratio(pair), 0.5, 1e-5, "nu of the soft one");
    restitute_material_destroy(soft);
    restitute_material_destroy(steel);
    restitute_material_destroy(pair);
}

/* Neighbouring rates, and a partner that is rigid to rounding: no term is lost, and the pair is
 * half of the solid, or the soft one. 1e-12: rounding of a sum of a few terms. */
static void no_term_is_lost_at_neighbouring_rates_or_extreme_ratios(void **state)
{
    (void)state;
    const double steps[] = {0, 2.3e-16, 1e-15, 1e-14, 1e-12, 1e-9};
    for (int i = 0; i < 6; i++) {
        struct chain first = {1e4, 1, {1e6}, {3e-3}}, second = {1e4, 1, {1e6}, {3e-3 * (1 + steps[i])}};
        restitute_material *a = material_of(&first, 0.5), *b = material_of(&second, 0.5), *pair = pair_of(a, b);
        for (double t = 1e-5; t < 1; t *= 10) {
            double half = 0.5 * restitute_material_modulus(a, t);
            CHECK_NEAR(restitute_material_modulus(pair, t), half, (1e-12 + 10 * steps[i] * t / 3e-3) * half,
                       "step %g at %g", steps[i], t);
        }
        restitute_material_destroy(a);
        restitute_material_destroy(b);
        restitute_material_destroy(pair);
    }
    for (double ratio = 1e10; ratio < 1e31; ratio *= 1e5) {
        struct chain polymer = {1e-6, 3, {1e-2, 1e-4, 1e-5}, {1e-6, 1e-3, 1e-1}}, hard = {1e-2 * ratio, 0, {0}, {0}};
        restitute_material *a = material_of(&polymer, 0.5), *b = material_of(&hard, 0.5), *pair = pair_of(a, b);
        for (double t = 1e-8; t < 1e3; t *= 10) {
            double soft = restitute_material_modulus(a, t);
            CHECK_NEAR(restitute_material_modulus(pair, t), soft, (1e-12 + 10 / ratio) * soft, "ratio %g at %g", ratio,
                       t);
        }
        restitute_material_destroy(a);
        restitute_material_destroy(b);
        restitute_material_destroy(pair);
    }
}

/* A pair is refused as one of the materials of a pair. */
static void a_pair_is_not_halved_or_paired_again(void **state)
{
    (void)state;
    struct chain c = {1e6, 0, {0}, {0}};
    restitute_material *m = material_of(&c, 0.3), *pair = pair_of(m, m), *again = NULL;
    restitute_error error;
    restitute_scene scene;
    double ez, ex;
    CHECK(restitute_material_effective(pair, m, &again, &error) == RESTITUTE_ERROR_DOMAIN && again == NULL,
          "pair of a pair");
    restitute_scene_init(&scene);
    scene.material = pair;
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    scene.radius1 = scene.mass1 = scene.normal_speed = 1;
    CHECK(restitute_scene_pair(&scene, &ez, &ex, &error) == RESTITUTE_ERROR_DOMAIN, "both deform");
    restitute_material_destroy(m);
    restitute_material_destroy(pair);
}

static void dashpots_and_bad_arguments(void **state)
{
    (void)state;
    restitute_material *voigt, *maxwell, *untouched = NULL;
    restitute_error error;
    CHECK(restitute_material_kelvin_voigt(3, 2, 0.5, &voigt, NULL) == 0, "voigt");
    CHECK(restitute_material_maxwell(5, 1, 0.5, &maxwell, NULL) == 0, "maxwell");
    restitute_material *both = pair_of(voigt, voigt), *mixed = pair_of(voigt, maxwell);
    /* two equal Kelvin-Voigt bodies are one; in series with a Maxwell body there is no equilibrium
     * modulus */
    CHECK(restitute_material_terms(both) == 0 && restitute_material_modulus(both, 1) == 1.5, "Kelvin-Voigt pair");
    CHECK(restitute_material_terms(mixed) == 2 && restitute_material_modulus(mixed, 1e9) == 0, "mixed pair");
    /* at first the dashpot is rigid */
    CHECK_NEAR(restitute_material_modulus(mixed, 1e-9), 5, 1e-7, "instantaneous modulus");
    CHECK(restitute_material_effective(NULL, voigt, &untouched, &error) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_material_effective(voigt, voigt, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL output");
    CHECK(untouched == NULL && isnan(restitute_material_dundurs(NULL)), "outputs");
    restitute_material_destroy(voigt);
    restitute_material_destroy(maxwell);
    restitute_material_destroy(both);
    restitute_material_destroy(mixed);
}

/* Two dashpots are rigid at first, and share their compliance by their viscosities: as two springs
 * of such moduli would. */
static void two_dashpots_share_by_their_viscosities(void **state)
{
    (void)state;
    restitute_material *a = NULL, *b = NULL, *c = NULL, *d = NULL;
    CHECK(restitute_material_kelvin_voigt(3, 2, 0.2, &a, NULL) == 0 &&
              restitute_material_kelvin_voigt(1, 6, 0.45, &b, NULL) == 0 &&
              restitute_material_elastic(2, 0.2, &c, NULL) == 0 && restitute_material_elastic(6, 0.45, &d, NULL) == 0,
          "materials");
    restitute_material *dashpots = pair_of(a, b), *springs = pair_of(c, d);
    CHECK_NEAR(restitute_material_poisson_ratio(dashpots), restitute_material_poisson_ratio(springs), 1e-15, "nu");
    CHECK_NEAR(restitute_material_dundurs(dashpots), restitute_material_dundurs(springs), 1e-15, "beta");
    restitute_material *all[] = {a, b, c, d, dashpots, springs};
    for (int i = 0; i < 6; i++)
        restitute_material_destroy(all[i]);
}

/* Rates of the pair that are the same to rounding are one; the ratio of two like Poisson ratios is
 * not above 1/2. */
static void pairs_to_the_last_bit(void **state)
{
    (void)state;
    struct chain soft = {4e6, 2, {1, 1e-11}, {1, 8e27}}, hard = {1e30, 3, {5e25, 1e4, 20}, {1e-30, 1, 1e-20}};
    restitute_material *a = material_of(&hard, 0.15), *b = material_of(&soft, 0.27), *pair = pair_of(a, b);
    CHECK_NEAR(restitute_material_modulus(pair, 1e-3), restitute_material_modulus(b, 1e-3), 4, "next to a rigid one");
    restitute_material_destroy(a);
    restitute_material_destroy(b);
    restitute_material_destroy(pair);
    struct chain one = {1, 0, {0}, {0}};
    for (int i = 1; i < 2000; i++) {
        struct chain other = {0.3 * i, 0, {0}, {0}};
        a = material_of(&one, 0.5), b = material_of(&other, 0.5 - i * 0x1p-54), pair = pair_of(a, b);
        CHECK(restitute_material_poisson_ratio(pair) <= 0.5, "case %d", i);
        restitute_material_destroy(a);
        restitute_material_destroy(b);
        restitute_material_destroy(pair);
    }
}

struct drawn {
    restitute_material *material;
    double g_inf, eta, nu, tau[3], g[3];
    int n;
};

/* A solid of moduli and times within `decades` of 1, or at the ends. */
static struct drawn draw_any(uint64_t *random, double decades, int at_ends)
{
    struct drawn m = {.n = random_below(random, 4), .nu = random_below(random, 3) ? random_in(random, 0, 0.5) : 0.5};
    const double low = pow(10, -decades), high = pow(10, decades);
    restitute_error error;
    for (int i = 0; i < 2 * m.n + 2; i++) {
        const int end = at_ends ? random_below(random, 4) : 3;
        const double value = end == 0 ? low : end == 1 ? high : random_log(random, low, high);
        double *const place[] = {&m.g_inf, &m.eta, &m.tau[0], &m.g[0], &m.tau[1], &m.g[1], &m.tau[2], &m.g[2]};
        *place[i] = value;
    }
    if (random_below(random, 3) == 0 && m.n > 0) m.g_inf = 0;
    if (random_below(random, 2)) m.eta = 0;
    if (m.eta > 0 && at_ends) m.eta = fmin(1e60, fmax(1e-60, m.eta * m.eta));
    const int status = restitute_material_prony(m.g_inf, m.eta, (size_t)m.n, m.tau, m.g, m.nu, &m.material, &error);
    CHECK(status == RESTITUTE_OK || strstr(error.message, "appears twice"), "%s", error.message);
    if (status) m.material = NULL;
    return m;
}

/* E* at a rate s: 2/(1 - nu) (G_inf + sum G_k s/(s + 1/tau_k) + eta s) */
static double plane_modulus(const restitute_material *m, double s)
{
    double g_inf, eta, tau[2 * most_terms], g[2 * most_terms], sum;
    restitute_material_series(m, &g_inf, &eta, tau, g, NULL);
    sum = g_inf + eta * s;
    for (size_t k = 0; k < restitute_material_terms(m); k++)
        sum += g[k] * (s * tau[k] / (1 + s * tau[k]));
    return 2 * sum / (1 - restitute_material_poisson_ratio(m));
}

/* 1/E* = 1/E_1* + 1/E_2* at any rate, over 16 decades of each. 1e-9: rates of the pair are good to
 * rounding, 1e-16, beside rates that are some 1e-7 apart. */
static void compliances_add_at_all_rates(void **state)
{
    (void)state;
    uint64_t random = 23;
    for (int n = 0; n < 2000; n++) {
        const struct drawn a = draw_any(&random, 8, 0), b = draw_any(&random, 8, 0);
        restitute_material *pair = pair_of(a.material, b.material);
        for (double s = 1e-12; s < 1e13; s *= 10) {
            const double expected = 1 / (1 / plane_modulus(a.material, s) + 1 / plane_modulus(b.material, s));
            CHECK_NEAR(plane_modulus(pair, s), expected, 1e-9 * expected, "pair %d at %g", n, s);
        }
        restitute_material_destroy(a.material);
        restitute_material_destroy(b.material);
        restitute_material_destroy(pair);
    }
}

/* Over the whole ranges and at their ends: a pair, or a refusal that says what it would be. Nothing
 * is without end. */
static void pairs_over_the_whole_ranges(void **state)
{
    (void)state;
    uint64_t random = 5;
    int made = 0, refused = 0;
    for (int n = 0; n < 20000; n++) {
        const struct drawn a = draw_any(&random, 30, 1), b = draw_any(&random, 30, 1);
        restitute_material *pair = NULL;
        restitute_error error;
        const int status = a.material && b.material
                               ? restitute_material_effective(a.material, b.material, &pair, &error)
                               : RESTITUTE_ERROR_NULL;
        if (status == RESTITUTE_OK) {
            const double beta = restitute_material_dundurs(pair), nu = restitute_material_poisson_ratio(pair);
            CHECK(fabs(beta) <= 0.5 && nu >= 0 && nu <= 0.5, "%d: beta %g, nu %g", n, beta, nu);
            made++;
        } else if (a.material && b.material) {
            CHECK(status == RESTITUTE_ERROR_DOMAIN && strncmp(error.message, "effective solid of material1", 28) == 0 &&
                      !pair,
                  "%d: %d %s", n, status, error.message);
            refused++;
        }
        restitute_material_destroy(a.material);
        restitute_material_destroy(b.material);
        restitute_material_destroy(pair);
    }
    CHECK(made > 2000 && refused > 2000, "%d made, %d refused", made, refused);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relaxation_of_the_pair_is_that_of_the_volterra_equations),
        cmocka_unit_test(a_pair_of_one_material_is_half_of_it),
        cmocka_unit_test(steel_on_glass_has_the_usual_constants),
        cmocka_unit_test(a_hard_partner_is_nearly_rigid),
        cmocka_unit_test(no_term_is_lost_at_neighbouring_rates_or_extreme_ratios),
        cmocka_unit_test(a_pair_is_not_halved_or_paired_again),
        cmocka_unit_test(dashpots_and_bad_arguments),
        cmocka_unit_test(two_dashpots_share_by_their_viscosities),
        cmocka_unit_test(pairs_to_the_last_bit),
        cmocka_unit_test(compliances_add_at_all_rates),
        cmocka_unit_test(pairs_over_the_whole_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
