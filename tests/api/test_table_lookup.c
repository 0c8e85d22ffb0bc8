/* What the header of tables promises of a lookup: limits, seams, bounds, derivatives, other sizes,
 * refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <fenv.h>
#include <string.h>

#include "../support/sized.h"
#include "../support/sync.h"
#include "../support/table.h"

static restitute_material *material;
static restitute_scene scene;
static restitute_table *table;
static const double chi = 7.0 / 6;

static int set_up(void **state)
{
    (void)state;
    scene = ball_on(1, &material);
    table = table_of(&scene, 1e-3, 10, 1e-4);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    return 0;
}

static double ex_at(double v_n, double psi)
{
    return look_up(table, v_n, psi * v_n / PSI_FACTOR).ex;
}

static void limits(void **state)
{
    struct pair pair = look_up(table, 0, 1);
    (void)state;
    CHECK(pair.ex == -1, "v_n = 0: %.17g", pair.ex);
    CHECK(look_up(table, 0, 0).ex == look_up(table, 1e-9, 0).ex, "no sliding, v_n = 0: the no-slip value");
    CHECK(look_up(table, 1e-300, 1e100).ex == -1, "psi beyond all bounds");
    CHECK(look_up(table, 1e-9, 0).ez == look_up(table, 1e-3, 0).ez, "below the lowest: as at it");
    CHECK(look_up(table, 1e9, 0).ez == look_up(table, 10, 0).ez, "above the highest: as at it");
    CHECK(look_up(table, 1, 0.3).ex == look_up(table, 1, -0.3).ex, "the sign of v_t");
    CHECK(look_up(table, 1, -0.0).ex == look_up(table, 1, 0).ex, "the sign of 0");
    /* 10^-3: two steps of psi of 1e-9 are below rounding of the table's own slope times them */
    CHECK_NEAR(ex_at(1, 1e-9), ex_at(1, 0), 1e-7, "psi -> 0");
}

/* Places of speeds round up and down: from this lowest speed on, some of the next ones lie a hair
 * below its node. Slopes times 20 ulps are rounding. */
static void just_above_the_lowest(void **state)
{
    const double low = 0.00047995159222933681;
    (void)state;
    restitute_table *from_low = table_of(&scene, low, 10 * low, 1e-3);
    const struct pair first = look_up(from_low, low, low);
    double v = low;
    for (int i = 0; i < 20; i++) {
        v = nextafter(v, 1);
        CHECK_NEAR(look_up(from_low, v, v).ez, first.ez, 1e-12, "v_n = %.17g", v);
        CHECK_NEAR(look_up(from_low, v, v).ex, first.ex, 1e-12, "v_n = %.17g", v);
    }
    restitute_table_destroy(from_low);
}

/* On both sides of a seam, closer than any slope could tell: slopes by psi are below 10, so 1e-12
 * of psi changes ex by 1e-11. */
static void continuous(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < 2000; i++) {
        const double v = random_log(&random, 1e-3, 10), critical = restitute_critical_psi(chi, look_up(table, v, 0).ez);
        CHECK_NEAR(ex_at(v, 1 + 1e-12), ex_at(v, 1 - 1e-12), 1e-10, "psi = 1, v_n = %g", v);
        CHECK_NEAR(ex_at(v, critical * (1 + 1e-12)), ex_at(v, critical * (1 - 1e-12)), 1e-10, "psi_c, v_n = %g", v);
        CHECK_NEAR(ex_at(v, critical * 1.0000001), 2 * chi * (1 + look_up(table, v, 0).ez) / (critical * 1.0000001) - 1,
                   1e-12, "the closed form beyond psi_c, v_n = %g", v);
    }
    /* cells of speed: no jump is larger than a slope of 10 by log2(v) makes it */
    for (int i = 0; i < 50000; i++) {
        const double v = 1e-3 * pow(10, 4 * i / 50000.0), next = v * pow(10, 4 / 50000.0);
        for (double psi = 0; psi < 4; psi += 0.9) {
            CHECK_NEAR(ex_at(next, psi), ex_at(v, psi), 3e-3, "v_n = %g, psi = %g", v, psi);
            CHECK_NEAR(look_up(table, next, 0).ez, look_up(table, v, 0).ez, 3e-3, "v_n = %g", v);
        }
    }
    /* cells of psi: no jump is larger than a slope of 10 makes it */
    for (int i = 0; i < 200000; i++) {
        const double psi = i * 1.5e-5;
        CHECK_NEAR(ex_at(0.7, psi + 1.5e-5), ex_at(0.7, psi), 1.5e-4, "psi = %g", psi);
    }
}

static void bounded(void **state)
{
    uint64_t random = 4;
    (void)state;
    feclearexcept(FE_ALL_EXCEPT);
    errno = 0;
    for (int i = 0; i < 200000; i++) {
        const double v_t = random_log(&random, 1e-12, 1e12), v_n = random_log(&random, 1e-12, 1e12);
        const struct pair p = look_up(table, v_n, v_t);
        CHECK(p.ez >= 0 && p.ez <= 1 && fabs(p.ex) <= 1, "ez = %.17g, ex = %.17g", p.ez, p.ex);
    }
    look_up(table, 0, 0);
    look_up(table, 0, 1);
    CHECK(errno == 0, "errno = %d", errno);
    CHECK(!fetestexcept(FE_DIVBYZERO | FE_INVALID), "a lookup divided by 0 or made a NaN");
}

static void many_at_once(void **state)
{
    enum { n = 1000 };
    double v[n], u[n], ez[n], ex[n];
    restitute_error error;
    uint64_t random = 6;
    (void)state;
    feclearexcept(FE_ALL_EXCEPT);
    for (int count = n; count > 0; count -= 37) {
        for (int i = 0; i < count; i++) {
            v[i] = i % 50 ? random_log(&random, 1e-6, 1e4) : 0;
            u[i] = i % 70 ? random_in(&random, -2, 2) * v[i] : 1e3;
            if (i % 90 == 1) u[i] = 0;
            if (i % 110 == 1) v[i] = 1e100;
        }
        assert_int_equal(restitute_table_pair_many(table, NULL, (size_t)count, v, u, ez, ex, NULL), RESTITUTE_OK);
        for (int i = 0; i < count; i++) {
            const struct pair p = look_up(table, v[i], u[i]);
            CHECK(p.ez == ez[i] && p.ex == ex[i], "impact %d of %d: %.17g, %.17g", i, count, v[i], u[i]);
        }
    }
    CHECK(!fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), "a lookup divided by 0, made a NaN or overflowed");
    assert_int_equal(restitute_table_pair_many(table, NULL, n, v, u, ez, ex, NULL), RESTITUTE_OK);
    assert_int_equal(restitute_table_pair_many(table, NULL, n, v, u, v, u, NULL), RESTITUTE_OK);
    for (int i = 0; i < n; i++)
        CHECK(v[i] == ez[i] && u[i] == ex[i], "impact %d, written over its speeds", i);
    assert_int_equal(restitute_table_pair_many(table, NULL, n, v, u, NULL, ex, NULL), RESTITUTE_OK);
    ez[0] = 7;
    v[n - 1] = NAN;
    assert_int_equal(restitute_table_pair_many(table, NULL, n, v, u, ez, NULL, &error), RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "normal_speeds[999]"), "%s", error.message);
    CHECK(ez[0] == 7, "a refused call has written");
    assert_int_equal(restitute_table_pair_many(table, NULL, 0, NULL, NULL, NULL, NULL, NULL), RESTITUTE_OK);
}

/* The pair of another contact, at a speed that is 0.3 m/s to the table, is that of the impact by
 * itself: 1e-4 is the table's tolerance, the rest the impact's own. */
static void check_contact(const restitute_table *of, restitute_scene other, const char *what)
{
    restitute_error error;
    PREPARED(table_contact, contact);
    CHECK(restitute_table_contact_set(of, &other, &contact, &error) == RESTITUTE_OK, "%s", error.message);
    other.normal_speed = 0.3 / contact.speed_factor, other.tangential_speed = 0.2 / contact.speed_factor;
    const restitute_result result = solve_scene(sync_to(1e-5), &other).result;
    const struct pair pair = look_up_for(of, &contact, other.normal_speed, other.tangential_speed);
    CHECK_NEAR(pair.ez, result.ez, 1.1e-4, "%s", what);
    CHECK_NEAR(pair.ex, result.ex, 1.1e-4, "%s", what);
}

static void other_sizes(void **state)
{
    (void)state;
    restitute_scene smaller = scene, two = scene, both = scene;
    smaller.radius1 = both.radius1 = 0.004, smaller.mass1 = both.mass1 = 0.0025;
    two.radius2 = 0.003, two.mass2 = 0.002;
    both.deformable = RESTITUTE_BOTH_BODIES_DEFORM, both.friction = 0.6;
    check_contact(table, smaller, "a smaller sphere");
    check_contact(table, two, "two spheres");
    check_contact(table, both, "both of the material, rougher");
}

/* A Kelvin-Voigt solid and one that flows, softer than 1 Pa, by tables of stiffer and faster ones:
 * a factor of all moduli and one of all times. */
static void other_materials_of_one_shape(void **state)
{
    (void)state;
    for (int flows = 0; flows < 2; flows++) {
        restitute_material *of_table, *other;
        const double tau[] = {1e-3, 2e-2}, slow[] = {0.3, 6}, g[] = {2e5, 1e5}, soft[] = {0.2, 0.1};
        restitute_scene impact = scene;
        of_table = flows ? solid_of(0, 0, 2, tau, g) : solid_of(1e6, 300, 0, NULL, NULL);
        other = flows ? solid_of(0, 0, 2, slow, soft) : solid_of(0.5, 0.03, 0, NULL, NULL);
        impact.material = of_table;
        restitute_table *one = table_of(&impact, 0.01, 10, 1e-4);
        impact.material = other;
        check_contact(one, impact, flows ? "flows" : "Kelvin-Voigt");
        restitute_table_destroy(one);
        restitute_material_destroy(of_table);
        restitute_material_destroy(other);
    }
}

static void other_contacts_are_refused(void **state)
{
    PREPARED(table_contact, contact);
    restitute_error error;
    restitute_scene other = scene;
    restitute_material *soft;
    (void)state;
    contact.speed_factor = 5;
    other.inertia1 = 1e-8;
    assert_int_equal(restitute_table_contact_set(table, &other, &contact, &error), RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "chi"), "%s", error.message);
    restitute_material_elastic(1e5, 0.5, &soft, NULL);
    other = scene;
    other.material = soft;
    assert_int_equal(restitute_table_contact_set(table, &other, &contact, &error), RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "material"), "%s", error.message);
    CHECK(contact.speed_factor == 5, "a refused call has written");
    restitute_material_destroy(soft);
}

/* The material at another temperature. */
static void shifted_times(void **state)
{
    restitute_scene other = scene;
    double g_inf, eta, tau, g;
    (void)state;
    restitute_material_series(material, &g_inf, &eta, &tau, &g, NULL);
    tau *= 1.7, g_inf *= 0.8, g *= 0.8;
    restitute_material *warm = solid_of(g_inf, eta, 1, &tau, &g);
    other.material = warm, other.radius1 = 0.004;
    check_contact(table, other, "another temperature");
    restitute_material_destroy(warm);
}

/* Factors that a caller has put there. */
static void factors_out_of_range(void **state)
{
    PREPARED(table_contact, contact);
    restitute_error error;
    (void)state;
    CHECK(restitute_table_pair(table, &contact, 1, 1, NULL, NULL, &error) == RESTITUTE_ERROR_DOMAIN, "not set");
    CHECK(strstr(error.message, "not set: restitute_table_contact_set"), "%s", error.message);
    assert_int_equal(restitute_table_contact_set(table, &scene, &contact, &error), RESTITUTE_OK);
    CHECK_NEAR(contact.speed_factor, 1, 1e-15, "the own contact");
    for (int i = 0; i < 2; i++) {
        contact.psi_factor = i ? 1 : NAN, contact.speed_factor = i ? NAN : 1;
        const double v = 1;
        double ez = 7;
        assert_int_equal(restitute_table_pair(table, &contact, v, v, &ez, NULL, &error), RESTITUTE_ERROR_DOMAIN);
        CHECK(strstr(error.message, i ? "speed_factor = nan" : "psi_factor = nan"), "%s", error.message);
        assert_int_equal(restitute_table_pair_many(table, &contact, 1, &v, &v, &ez, NULL, NULL),
                         RESTITUTE_ERROR_DOMAIN);
        CHECK(ez == 7, "a refused call has written");
    }
}

static void bad_speeds_are_refused(void **state)
{
    static const double bad[][2] = {{-1, 0},       {NAN, 0}, {1.01e100, 0}, {INFINITY, 0},
                                    {1, 1.01e100}, {1, NAN}, {1, INFINITY}, {1, -INFINITY}};
    restitute_error error;
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const char *name = i < 4 ? "normal_speed (m/s) = " : "sliding_speed (m/s) = ";
        double ez = 5, ex = 6;
        int flags = 7;
        CHECK(restitute_table_pair(table, NULL, bad[i][0], bad[i][1], &ez, &ex, &error) == RESTITUTE_ERROR_DOMAIN,
              "%g, %g", bad[i][0], bad[i][1]);
        CHECK(ez == 5 && ex == 6, "a refused call has written");
        CHECK(strstr(error.message, name) && strstr(error.message, "1e+100"), "%s", error.message);
        CHECK(restitute_table_flags(table, NULL, bad[i][0], bad[i][1], &flags, &error) == RESTITUTE_ERROR_DOMAIN &&
                  flags == 7,
              "%g, %g", bad[i][0], bad[i][1]);
    }
    const double one = 1;
    assert_int_equal(restitute_table_pair(NULL, NULL, 1, 1, NULL, NULL, NULL), RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_table_pair_many(table, NULL, 1, &one, NULL, NULL, NULL, &error), RESTITUTE_ERROR_NULL);
    assert_string_equal(error.message, "sliding_speeds is NULL");
    assert_int_equal(restitute_table_contact_set(table, &scene, NULL, &error), RESTITUTE_ERROR_NULL);
    assert_string_equal(error.message, "contact is NULL");
}

/* Either output may be left out, and the error of a call that is done is empty. */
static void one_of_the_pair(void **state)
{
    const struct pair both = look_up(table, 0.7, 0.2);
    double ez, ex;
    restitute_error error = {1, "before"};
    (void)state;
    assert_int_equal(restitute_table_pair(table, NULL, 0.7, 0.2, &ez, NULL, &error), RESTITUTE_OK);
    assert_int_equal(restitute_table_pair(table, NULL, 0.7, 0.2, NULL, &ex, NULL), RESTITUTE_OK);
    CHECK(ez == both.ez && ex == both.ex, "%.17g, %.17g", ez, ex);
    CHECK(error.status == 0 && !error.message[0], "%s", error.message);
}

static void structs_of_other_sizes_are_refused(void **state)
{
    static _Alignas(double) unsigned char place[guarded_bytes];
    const void *given = place;
    const restitute_material *materials[] = {material};
    const double v = 1;
    int flags = 7;
    double ez = 7, ex = 7;
    restitute_body ball, floor;
    restitute_table *none = NULL;
    restitute_error e;
    (void)state;
    restitute_body_init(&ball);
    restitute_body_init(&floor);
    CHECK_SIZES(table_options, interrupted_data, place, &e, restitute_table_build(&scene, given, &none, &e));
    CHECK_SIZES(table_options, interrupted_data, place, &e,
                restitute_table_build_many(1, materials, &scene, given, NULL, NULL, &none, &e));
    CHECK_SIZES(table_contact, touch_gap, place, &e, restitute_table_contact_set(table, &scene, (void *)place, &e));
    CHECK_SIZES(table_contact, touch_gap, place, &e, restitute_table_pair(table, given, v, v, &ez, &ex, &e));
    CHECK_SIZES(table_contact, touch_gap, place, &e, restitute_table_pair_many(table, given, 1, &v, &v, &ez, &ex, &e));
    CHECK_SIZES(table_contact, touch_gap, place, &e,
                restitute_table_collide(table, given, &ball, &floor, &ez, &ex, &e));
    CHECK_SIZES(table_contact, touch_gap, place, &e, restitute_table_flags(table, given, v, v, &flags, &e));
    CHECK_SIZES(table_info, version, place, &e, restitute_table_describe(table, (void *)place, &e));
    CHECK_SIZES(table_data, ex, place, &e, restitute_table_data_get(table, (void *)place, &e));
    CHECK_SIZES(table_data, ex, place, &e, restitute_table_create(given, &none, &e));
    CHECK(!none && flags == 7 && ez == 7 && ex == 7, "a refused call has written");
}

/* Axes that a contact does not need are not there, and its limits are those of the impact. */
static void axes_collapse(void **state)
{
    restitute_material *steel;
    restitute_scene ball = scene;
    PREPARED(table_info, info);
    (void)state;
    restitute_material_elastic(8e10, 0.3, &steel, NULL);
    ball.material = steel;
    restitute_table *elastic = table_of(&ball, 1e-3, 10, 1e-4);
    restitute_table_describe(elastic, &info, NULL);
    CHECK(info.speeds == 2 && info.slip_cells > 1, "elastic: %lld speeds", (long long)info.speeds);
    CHECK_NEAR(look_up(elastic, 1, 0.1).ez, 1, 1e-4, "elastic");
    restitute_table_destroy(elastic);
    ball = scene;
    ball.friction = 0;
    restitute_table *smooth = table_of(&ball, 1e-3, 10, 1e-4);
    restitute_table_describe(smooth, &info, NULL);
    CHECK(info.stick_cells == 1 && info.slip_cells == 1, "no friction: %lld cells", (long long)info.slip_cells);
    CHECK(info.checks < info.impacts, "%lld checks of %lld impacts", (long long)info.checks, (long long)info.impacts);
    CHECK(look_up(smooth, 1, 0).ex == -1 && look_up(smooth, 1, 5).ex == -1 && look_up(smooth, 0, 0).ex == -1, "mu = 0");
    CHECK_NEAR(look_up(smooth, 1, 0).ez, look_up(table, 1, 0).ez, 2e-4, "ez does not know of friction");
    PREPARED(table_contact, contact);
    restitute_error error;
    assert_int_equal(restitute_table_contact_set(smooth, &scene, &contact, &error), RESTITUTE_ERROR_DOMAIN);
    CHECK(strstr(error.message, "must be 0, the only one of this table"), "%s", error.message);
    restitute_table_destroy(smooth);
    ball.friction = INFINITY;
    restitute_table *rough = table_of(&ball, 1e-3, 10, 1e-4);
    CHECK_NEAR(look_up(rough, 1, 5).ex, look_up(table, 1, 0).ex, 2e-4, "mu = infinity: the no-slip value");
    CHECK(look_up(rough, 0, 5).ex == look_up(rough, 0, 0).ex, "mu = infinity, v_n = 0");
    restitute_table_destroy(rough);
    restitute_material_destroy(steel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(limits),
                                       cmocka_unit_test(just_above_the_lowest),
                                       cmocka_unit_test(continuous),
                                       cmocka_unit_test(bounded),
                                       cmocka_unit_test(many_at_once),
                                       cmocka_unit_test(other_sizes),
                                       cmocka_unit_test(other_materials_of_one_shape),
                                       cmocka_unit_test(other_contacts_are_refused),
                                       cmocka_unit_test(shifted_times),
                                       cmocka_unit_test(factors_out_of_range),
                                       cmocka_unit_test(structs_of_other_sizes_are_refused),
                                       cmocka_unit_test(bad_speeds_are_refused),
                                       cmocka_unit_test(one_of_the_pair),
                                       cmocka_unit_test(axes_collapse)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
