/* Laws of reduced series, and contacts of any law in the documented ranges.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/traps.h"

#include <float.h>

#include "../support/drive.h"

static int reduce(const restitute_material *material, int terms, double shortest, double longest,
                  restitute_contact_law **law, restitute_error *error)
{
    restitute_contact_law_options options;
    restitute_contact_law_options_init(&options);
    options.terms = terms, options.shortest = shortest, options.longest = longest;
    return restitute_contact_law_create(material, &options, law, error);
}

/* The material that a law computes with; `law` is freed. */
static restitute_material *material_of(restitute_contact_law *law, double *bound)
{
    double tau[8], g[8], g_inf, eta;
    size_t n;
    assert_int_equal(restitute_contact_law_series(law, &g_inf, &eta, &n, tau, g, bound, NULL), 0);
    restitute_contact_law_destroy(law);
    return solid_of(g_inf, eta, n, tau, g);
}

static restitute_material *polyisobutylene(void)
{
    double tau[pib_terms], g[pib_terms];
    read_pib(tau, g);
    return solid_of(0, 0, pib_terms, tau, g);
}

/* Times a factor of sqrt(10) apart from a microsecond on, equal moduli, no equilibrium modulus. */
static restitute_material *six_terms(void)
{
    double tau[6], g[6];
    for (int k = 0; k < 6; k++)
        tau[k] = 1e-6 * pow(10, 0.5 * k), g[k] = 1e6;
    return solid_of(0, 0, 6, tau, g);
}

/* G(t) of the law beside that of the material, at times from a micro- to a millisecond. */
static double worst_of_window(const restitute_material *material, int terms, double *bound)
{
    restitute_contact_law *law;
    restitute_error error;
    double worst = 0;
    CHECK(reduce(material, terms, 1e-6, 1e-3, &law, &error) == 0, "%s", error.message);
    restitute_material *reduced = material_of(law, bound);
    for (int i = 0; i <= 777; i++) {
        const double t = 1e-6 * pow(1e3, i / 777.0), exact = restitute_material_modulus(material, t);
        worst = fmax(worst, fabs(restitute_material_modulus(reduced, t) - exact) / exact);
    }
    restitute_material_destroy(reduced);
    return worst;
}

static void long_series_are_reduced_within_their_bound(void **unused)
{
    (void)unused;
    restitute_material *material = polyisobutylene();
    restitute_contact_law *law = NULL;
    restitute_error error;
    double bound, before = 1;
    assert_int_equal(restitute_contact_law_create(material, NULL, &law, &error), RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "shortest") != NULL, "%s", error.message);
    for (int terms = 4; terms <= 8; terms += 2) {
        const double worst = worst_of_window(material, terms, &bound);
        print_message("%d terms: G within %.4f, bound %.4f\n", terms, worst, bound);
        CHECK(worst <= bound, "%d terms: %.4f beyond the bound %.4f", terms, worst, bound);
        CHECK(bound < before / 2, "%d terms: bound %.4f after %.4f", terms, bound, before);
        before = bound;
    }
    CHECK(before < 0.02, "8 terms: bound %.4f", before);
    restitute_material_destroy(material);
}

static void refused(restitute_material *material, int terms, double shortest, double longest, const char *words)
{
    restitute_contact_law *law = NULL;
    restitute_error error;
    const int status = reduce(material, terms, shortest, longest, &law, &error);
    CHECK(status == RESTITUTE_ERROR_DOMAIN && !law, "[%g, %g] s: status %d", shortest, longest, status);
    CHECK(strstr(error.message, words) != NULL, "\"%s\" does not say \"%s\"", error.message, words);
}

/* Also if G(t) is 0 at the shortest time already. */
static void windows_beyond_the_relaxation_are_refused(void **unused)
{
    (void)unused;
    restitute_material *six = six_terms();
    const double tau[] = {1e-12, 2.7e-9}, g[] = {400, 1e3};
    restitute_material *fast = solid_of(0, 0, 2, tau, g), *dashpot = solid_of(0, 1, 2, tau, g);
    refused(six, 4, 1e-6, 0.01,
            "options.terms = 4, shortest = 1e-06 s, longest = 0.01 s: the law misses G(t) of the 6 terms");
    refused(six, 4, 1e-6, 0.64, "options.longest = 0.64 s: the 6 terms");
    refused(fast, 1, 4.8e-6, 18.9, "leave no modulus");
    refused(dashpot, 1, 4.8e-6, 18.9, "leave no modulus");
    refused(six, 4, 1e-6, 1e-6, "must rise within [1e-60, 1e+60]");
    refused(six, 4, 1e-320, 1e-13, "must rise within [1e-60, 1e+60]");
    refused(six, 4, 1, 1e308, "must rise within [1e-60, 1e+60]");
    refused(six, 4, NAN, 1, "must rise within [1e-60, 1e+60]");
    restitute_material_destroy(six);
    restitute_material_destroy(fast);
    restitute_material_destroy(dashpot);
}

/* OK, a remark from 20 % on, a refusal beyond 50 %, each with error and reason. */
static void poor_reductions_are_named(void **unused)
{
    (void)unused;
    restitute_material *pib = polyisobutylene();
    int counts[3] = {0};
    for (int terms = 1; terms <= 8; terms++)
        for (double longest = 1e-4; longest < 20; longest *= 10) {
            restitute_contact_law *law = NULL;
            restitute_error error;
            double bound = 1;
            const int status = reduce(pib, terms, 1e-6, longest, &law, &error);
            if (law) restitute_material_destroy(material_of(law, &bound));
            const int kind = status == RESTITUTE_OK ? 0 : status == RESTITUTE_TOLERANCE_NOT_REACHED ? 1 : 2;
            counts[kind]++;
            CHECK(status == error.status && (law != NULL) == (kind < 2), "status %d", status);
            CHECK(kind == (bound <= 0.2 ? 0 : bound <= 0.5 ? 1 : 2), "bound %g, status %d", bound, status);
            char words[80];
            snprintf(words, sizeof words, "options.terms = %d, shortest = 1e-06 s, longest = %g s", terms, longest);
            CHECK((strstr(error.message, words) && strstr(error.message, "more terms or a narrower window")) ==
                      (kind > 0),
                  "bound %g: \"%s\"", bound, error.message);
        }
    for (int i = 0; i < 3; i++)
        CHECK(counts[i] >= 5, "only %d reductions of kind %d", counts[i], i);
    restitute_material_destroy(pib);
}

/* What contact.h says: up to a third of the bound. For impacts whose contact time, and a fiftieth
 * of it, lie in the window. */
static void ez_errs_by_a_part_of_the_bound(void **unused)
{
    (void)unused;
    restitute_material *pib = polyisobutylene();
    restitute_solver *solver;
    double part = 0;
    assert_int_equal(restitute_solver_create(NULL, &solver, NULL), 0);
    for (int terms = 3; terms <= 7; terms++) {
        restitute_contact_law *law;
        restitute_error error;
        double bound;
        if (reduce(pib, terms, 1e-7, 1e-2, &law, &error) < 0) continue;
        restitute_material *reduced = material_of(law, &bound);
        for (int i = 0; i < 24; i++) {
            restitute_scene scene;
            restitute_result whole, few;
            restitute_scene_init(&scene);
            restitute_result_init(&whole);
            restitute_result_init(&few);
            scene.material = pib;
            scene.radius1 = 1e-5 * pow(10, i % 4), scene.mass1 = 5e3 * pow(scene.radius1, 3);
            scene.normal_speed = 0.01 * pow(4, i / 4.0);
            assert_true(restitute_solve_scene(solver, &scene, &whole, NULL, NULL, NULL) >= 0);
            if (whole.contact_time < 50 * 1e-7 || !(whole.contact_time < 1e-2)) continue;
            scene.material = reduced;
            assert_true(restitute_solve_scene(solver, &scene, &few, NULL, NULL, NULL) >= 0);
            part = fmax(part, fabs(whole.ez - few.ez) / bound);
        }
        restitute_material_destroy(reduced);
    }
    print_message("ez errs by up to %.3f of the bound\n", part);
    CHECK(part > 0.05 && part < 1 / 3.0, "%.3f", part);
    restitute_solver_destroy(solver);
    restitute_material_destroy(pib);
}

/* ---- any law, any contact */

/* A call in the ranges of its arguments, refused or not. */
#define NEVER_TRAPS(status, call, number)                                                                              \
    do {                                                                                                               \
        feclearexcept(FE_ALL_EXCEPT);                                                                                  \
        (status) = (call);                                                                                             \
        const int raised_ = fetestexcept(TRAPPED);                                                                     \
        CHECK(!raised_, "case %d: " #call " (status %d) raises %#x", number, status, (unsigned)raised_);               \
    } while (0)

/* Within 1/extent to extent, in part at the ends. */
static double draw_any(uint64_t *random, double extent)
{
    const double low = (1 + 1e-15) / extent; /* 1/1e30 may be rounded below 1e-30 */
    const int kind = random_below(random, 8);
    if (kind < 2) return kind == 0 ? low : extent;
    return kind < 5 ? fmin(fmax(random_log(random, low, extent), low), extent) : random_log(random, 0.1, 10);
}

/* Now and then one that is no more than zero. */
static double or_next_to_nothing(uint64_t *random, double value)
{
    static const double tiny[] = {5e-324, 1e-310, 1e-200, 1e-80};
    const int i = random_below(random, 60);
    return i < 4 ? tiny[i] : value;
}

/* Up to 12 terms and a window, as far apart as they may be. */
static int draw_law(uint64_t *random, int number, restitute_contact_law **law)
{
    static const double spreads[] = {1e3, 1e12, 1e30};
    const double spread = spreads[number % 3], window = number % 2 ? 1e60 : 1e6;
    double tau[12], g[12];
    restitute_material *material = NULL;
    restitute_contact_law_options o;
    const int n = 1 + random_below(random, 12), flows = random_below(random, 2), creeps = random_below(random, 3) == 0;
    for (int k = 0; k < n; k++) {
        tau[k] = random_log(random, 2 / spread, spread / 2);
        g[k] = draw_any(random, number % 2 ? 1e30 : 10);
    }
    const double g_inf = draw_any(random, 1e30), eta = draw_any(random, 1e60);
    restitute_error error;
    CHECK(restitute_material_prony(flows ? 0 : g_inf, creeps ? eta : 0, (size_t)n, tau, g, 0.3, &material, &error) == 0,
          "%s", error.message);
    restitute_contact_law_options_init(&o);
    o.deformable = number % 2 ? RESTITUTE_ONE_BODY_DEFORMS : RESTITUTE_BOTH_BODIES_DEFORM;
    o.terms = 1 + random_below(random, 8);
    o.shortest = draw_any(random, window);
    o.longest = random_below(random, 2) ? draw_any(random, window) : 1e3 * o.shortest;
    o.details = random_below(random, 2);
    o.slip_cycles = random_below(random, 2);
    int status;
    NEVER_TRAPS(status, restitute_contact_law_create(material, &o, law, NULL), number);
    restitute_material_destroy(material);
    return status;
}

/* Finite forces within Coulomb's law, whose bound is rounded like the force itself: 4 rounding
 * errors of each. */
static void check_force(const restitute_contact_force *f, double friction, int number)
{
    const double *t = f->tangential, size = hypot(hypot(t[0], t[1]), t[2]), limit = friction * f->normal;
    CHECK(isfinite(f->normal) && f->normal >= 0 && isfinite(size), "case %d: force %g, %g", number, f->normal, size);
    CHECK(f->normal > 0 || size == 0, "case %d: tangential force %g beside no normal force", number, size);
    CHECK(friction > 0 || size == 0, "case %d: tangential force %g without friction", number, size);
    CHECK(size <= limit * (1 + 4 * DBL_EPSILON) + 4 * 5e-324, "case %d: tangential force %g beyond %g", number, size,
          limit);
}

/* Eight copies of a contact in a batch. */
static void step_side_by_side(const restitute_contact_law *law, const restitute_contact_rates *rates,
                              const restitute_contact_motion *motion, const double *state, int number)
{
    enum { n = 8 };
    static double states[n][most_state];
    restitute_contact_motion motions[n];
    restitute_contact_force forces[n];
    double *places[n];
    int status;
    for (int i = 0; i < n; i++) {
        memcpy(places[i] = states[i], state, sizeof states[i]);
        motions[i] = *motion;
    }
    NEVER_TRAPS(status, restitute_contact_step_many(law, rates, n, motions, places, forces, NULL, NULL), number);
}

static void press_and_rub(uint64_t *random, const restitute_contact_law *law, int number)
{
    restitute_contact_rates rates;
    restitute_contact_motion m;
    restitute_contact_details details;
    restitute_contact_force force;
    double state[most_state] = {0};
    const double step = draw_any(random, 1e60);
    int status;
    restitute_contact_rates_init(&rates);
    restitute_contact_details_init(&details);
    NEVER_TRAPS(status, restitute_contact_rates_set(law, step, &rates, NULL), number);
    assert_int_equal(status, 0);
    restitute_contact_motion_init(&m);
    m.radius = draw_any(random, 1e15);
    m.friction = random_below(random, 4) ? or_next_to_nothing(random, random_log(random, 1e-30, 1e6)) : 0;
    m.inverse_mass = random_below(random, 4) ? or_next_to_nothing(random, 2 * draw_any(random, 1e30) / step) : 0;
    m.inverse_tangential_mass = random_below(random, 4) ? or_next_to_nothing(random, 2 * draw_any(random, 1e30) / step) : 0;
    const double depth = m.radius * random_log(random, 1e-6, 1),
                 slide = random_log(random, random_below(random, 3) ? 1e-3 : 1e-200, 1);
    for (int i = 0; i < 12; i++) { /* in, out, and in again */
        const double before = m.overlap;
        m.overlap = or_next_to_nothing(random, depth * sin(0.8 * (i + 1)));
        m.spin = or_next_to_nothing(random, random_in(random, -1, 1) / step);
        m.velocity[2] = or_next_to_nothing(random, 0.5 * (m.overlap - before) / step);
        for (int k = 0; k < 2; k++)
            m.velocity[k] = or_next_to_nothing(random, m.radius * slide * random_in(random, -1, 1) / step);
        step_side_by_side(law, &rates, &m, state, number);
        NEVER_TRAPS(status, restitute_contact_step(law, &rates, &m, state, &force, NULL), number);
        if (status) return; /* a step too long */
        check_force(&force, m.friction, number);
        NEVER_TRAPS(status, restitute_contact_details_get(law, m.radius, state, &details, NULL), number);
        CHECK(status || (isfinite(details.stored) && isfinite(details.viscous) && isfinite(details.viscous_power)),
              "case %d: %g J, %g J, %g W", number, details.stored, details.viscous, details.viscous_power);
    }
}

static void nothing_traps_or_breaks_coulombs_law(void **unused)
{
    (void)unused;
    enum { laws = 150 };
    uint64_t random = 36;
    int made = 0;
    for (int number = 0; number < laws; number++) {
        restitute_contact_law *law;
        if (draw_law(&random, number, &law) < 0) continue;
        made++;
        for (int i = 0; i < 20; i++) {
            const double mass = draw_any(&random, 1e60), radius = draw_any(&random, 1e60),
                         speed = draw_any(&random, 1e60);
            double limit = 0;
            int status;
            NEVER_TRAPS(status, restitute_contact_time_step_limit(law, mass, radius, speed, &limit, NULL), number);
            CHECK(status == 0 && limit > 0 && isfinite(limit), "case %d: m %g, R %g, v %g: %g", number, mass, radius,
                  speed, limit);
            press_and_rub(&random, law, number);
        }
        restitute_contact_law_destroy(law);
    }
    CHECK(3 * made > laws, "only %d of %d laws", made, laws);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_series_are_reduced_within_their_bound),
        cmocka_unit_test(windows_beyond_the_relaxation_are_refused),
        cmocka_unit_test(poor_reductions_are_named),
        cmocka_unit_test(ez_errs_by_a_part_of_the_bound),
        cmocka_unit_test(nothing_traps_or_breaks_coulombs_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
