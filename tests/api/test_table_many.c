/* Many lookups at once have the bits of one after the other, from tables of all kinds; what one refuses, many refuse
 * before anything is written.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <fenv.h>

#include "../support/cells.h"
#include "../support/table.h"

enum { most = 1000, with_cells = 3, tables = 5 };

/* With cells, and an axis of chi, or none, or with nothing but roots; with cubics along delta1, chi and psi; with one delta1,
 * along chi and psi. */
static struct cells cells[with_cells];
static restitute_table *table[tables];

struct numbers {
    double chi[most], psi[most], delta1[most], gamma[most];
};

struct pairs {
    double ez[most], ex[most];
};

static restitute_table *table_of_ranges(double lowest, double highest, double gamma)
{
    restitute_table_family family;
    restitute_table_options options;
    restitute_table *made = NULL;
    restitute_error error;
    restitute_table_family_init(&family);
    restitute_table_options_init(&options);
    family.chi[0] = 1, family.chi[1] = 1.5;
    family.delta1[0] = lowest, family.delta1[1] = highest;
    family.gamma[0] = family.gamma[1] = gamma;
    options.tolerance = 1e-2;
    CHECK(restitute_table_build(&family, &options, &made, &error) == RESTITUTE_OK, "%s", error.message);
    return made;
}

static int set_up(void **state)
{
    (void)state;
    for (int i = 0; i < with_cells; i++) {
        cells_make(i == 1 ? 1 : 1.6, i == 2 ? 0 : 9, &cells[i]);
        table[i] = cells_table(&cells[i]);
    }
    table[3] = table_of_ranges(0.1, 0.2, 1);
    table[4] = table_of_ranges(0, 0, 1);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    for (int i = 0; i < tables; i++)
        restitute_table_destroy(table[i]);
    for (int i = 0; i < with_cells; i++)
        cells_free(&cells[i]);
    return 0;
}

/* Within the ranges and beyond; at the sides of psi = 1 and psi_c, and at the ends of what a number may be. */
static void draw(const restitute_table *t, uint64_t *seed, struct numbers *at)
{
    static const double ends[] = {0, 5e-324, 1e-310, 1, 1e300, INFINITY};
    for (int i = 0; i < most; i++) {
        double *const number[] = {&at->chi[i], &at->psi[i], &at->delta1[i], &at->gamma[i]};
        restitute_table_value pair;
        at->chi[i] = random_in(seed, 0.4, 2);
        at->psi[i] = random_in(seed, 0, 5);
        at->delta1[i] = random_log(seed, 0.05, 10);
        at->gamma[i] = random_log(seed, 0.1, 3);
        const int kind = (int)random_in(seed, 0, 10);
        if (kind == 0) at->psi[i] = 1 + 0x1p-52 * ((int)random_in(seed, 0, 3) - 1);
        if (kind == 1) *number[(int)random_in(seed, 0, 4)] = ends[(int)random_in(seed, 0, 6)];
        if (kind != 2) continue;
        restitute_table_numbers_pair(t, at->chi[i], 0, at->delta1[i], at->gamma[i], &pair);
        at->psi[i] = restitute_critical_psi(at->chi[i], pair.ez) * (1 + 0x1p-52 * ((int)random_in(seed, 0, 5) - 2));
    }
}

static int many(const restitute_table *t, size_t n, const struct numbers *at, double *ez, double *ex)
{
    return restitute_table_numbers_pairs(t, n, at->chi, at->psi, at->delta1, at->gamma, ez, ex);
}

static void numbers_have_the_bits_of_one(void **state)
{
    static const size_t sizes[] = {1, 2, 31, 32, 33, 64, 257, most};
    static struct numbers at;
    static struct pairs found;
    uint64_t seed = 1;
    (void)state;
    feclearexcept(FE_ALL_EXCEPT);
    for (int k = 0; k < tables * 8 * 4; k++) {
        const restitute_table *t = table[k % tables];
        const size_t n = sizes[k / tables % 8];
        draw(t, &seed, &at);
        found.ez[n % most] = found.ex[n % most] = 7;
        assert_int_equal(many(t, n, &at, found.ez, found.ex), RESTITUTE_OK);
        CHECK(n == most || (found.ez[n] == 7 && found.ex[n] == 7), "written behind %zu places", n);
        for (size_t i = 0; i < n; i++) {
            restitute_table_value p;
            restitute_table_numbers_pair(t, at.chi[i], at.psi[i], at.delta1[i], at.gamma[i], &p);
            CHECK(p.ez == found.ez[i] && p.ex == found.ex[i],
                  "table %d, chi %.17g, psi %.17g, delta1 %.17g, gamma %.17g", k % tables, at.chi[i], at.psi[i],
                  at.delta1[i], at.gamma[i]);
        }
    }
    CHECK(!fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), "a lookup divided by 0, made a NaN or overflowed");
}

static void what_is_not_wanted_may_be_null(void **state)
{
    static struct numbers at;
    static struct pairs both, one;
    uint64_t seed = 2;
    (void)state;
    for (int k = 0; k < tables; k++) {
        draw(table[k], &seed, &at);
        assert_int_equal(many(table[k], most, &at, both.ez, both.ex), RESTITUTE_OK);
        assert_int_equal(many(table[k], most, &at, one.ez, NULL), RESTITUTE_OK);
        assert_int_equal(many(table[k], most, &at, NULL, one.ex), RESTITUTE_OK);
        assert_int_equal(many(table[k], most, &at, NULL, NULL), RESTITUTE_OK);
        assert_memory_equal(&both, &one, sizeof both);
    }
}

static void what_one_refuses_many_refuse(void **state)
{
    static struct numbers at;
    struct pairs found = {.ez = {7}, .ex = {7}};
    restitute_material *material;
    uint64_t seed = 3;
    (void)state;
    draw(table[0], &seed, &at);
    double *const number[] = {at.chi, at.psi, at.delta1, at.gamma};
    for (int k = 0; k < 8; k++) {
        double *last = &number[k / 2][most - 1], good = *last;
        *last = k % 2 ? NAN : -1;
        assert_int_equal(many(table[0], most, &at, found.ez, found.ex), RESTITUTE_ERROR_DOMAIN);
        *last = good;
    }
    for (int k = 0; k < 4; k++) {
        const double *in[] = {at.chi, at.psi, at.delta1, at.gamma};
        in[k] = NULL;
        assert_int_equal(restitute_table_numbers_pairs(table[0], 3, in[0], in[1], in[2], in[3], found.ez, found.ex),
                         RESTITUTE_ERROR_NULL);
    }
    assert_int_equal(many(NULL, 1, &at, found.ez, found.ex), RESTITUTE_ERROR_NULL);
    const restitute_scene scene = ball_on(1, &material);
    restitute_table *of_contact = table_of(&scene, 0.1, 1, 1e-2);
    assert_int_equal(many(of_contact, 1, &at, found.ez, found.ex), RESTITUTE_ERROR_DOMAIN);
    CHECK(found.ez[0] == 7 && found.ex[0] == 7, "a refused call has written");
    assert_int_equal(restitute_table_numbers_pairs(table[0], 0, NULL, NULL, NULL, NULL, NULL, NULL), RESTITUTE_OK);
    restitute_table_destroy(of_contact);
    restitute_material_destroy(material);
}

/* By speeds, from tables with cells: blocks of them and single ones. */
static void speeds_have_the_bits_of_one(void **state)
{
    static double v[most], u[most];
    static struct pairs found;
    uint64_t seed = 4;
    (void)state;
    for (int k = 0; k < with_cells * 20; k++) {
        const restitute_table *t = table[k % with_cells];
        restitute_table_contact c;
        restitute_table_contact_init(&c);
        c.chi = random_in(&seed, 0.9, 1.7);
        c.gamma = random_log(&seed, 0.2, 1);
        c.delta1 = random_log(&seed, 0.3, 4);
        c.psi_factor = k % 10 == 8 ? 0 : k % 10 == 9 ? INFINITY : 2;
        for (int i = 0; i < most; i++) {
            v[i] = i % 50 ? random_log(&seed, 1e-4, 100) : 0;
            u[i] = i % 70 ? random_in(&seed, -2, 2) * (v[i] + (i % 60 == 0)) : 0;
        }
        assert_int_equal(restitute_table_pairs(t, &c, most, v, u, found.ez, found.ex), RESTITUTE_OK);
        for (int i = 0; i < most; i++) {
            restitute_table_value p;
            assert_int_equal(restitute_table_pair_of(t, &c, v[i], u[i], &p, NULL), RESTITUTE_OK);
            CHECK(p.ez == found.ez[i] && p.ex == found.ex[i], "%.17g, %.17g", v[i], u[i]);
            if (!(v[i] > 0) || c.psi_factor > 2) continue;
            restitute_table_numbers_pair(t, c.chi, c.psi_factor * fabs(u[i]) / v[i], c.delta1 * pow(v[i], 0.2), c.gamma,
                                         &p);
            CHECK(p.ez == found.ez[i], "%.17g, %.17g", v[i], u[i]);
            CHECK_NEAR(p.ex, found.ex[i], 1e-6, "%.17g, %.17g", v[i], u[i]); /* psi is rounded; single precision */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_have_the_bits_of_one), cmocka_unit_test(what_is_not_wanted_may_be_null),
        cmocka_unit_test(what_one_refuses_many_refuse), cmocka_unit_test(speeds_have_the_bits_of_one)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
