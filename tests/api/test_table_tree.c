/* Tables with axes of delta1 and gamma: trees of cells, across a line where ex turns sharply.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../support/table.h"

static restitute_table_family across_the_line(void)
{
    restitute_table_family family;
    restitute_table_family_init(&family);
    family.chi[0] = 1, family.chi[1] = 1.4;
    family.delta1[0] = 0.5, family.delta1[1] = 3.5;
    family.gamma[0] = 0.07, family.gamma[1] = 0.4;
    return family;
}

static restitute_table_options options_of(int threads)
{
    restitute_table_options options;
    restitute_table_options_init(&options);
    options.tolerance = 4e-3;
    options.threads = threads;
    return options;
}

static restitute_table *build(int threads)
{
    restitute_table *made = NULL;
    restitute_error error;
    const restitute_table_family family = across_the_line();
    const restitute_table_options options = options_of(threads);
    CHECK(restitute_table_build(&family, &options, &made, &error) == RESTITUTE_OK, "%s", error.message);
    return made;
}

/* One for all tests. */
static restitute_table *table;

static int build_once(void **state)
{
    (void)state;
    table = build(2);
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    restitute_table_destroy(table);
    return 0;
}

static restitute_table_data data_of(const restitute_table *of)
{
    restitute_table_data data;
    restitute_table_data_init(&data);
    assert_int_equal(restitute_table_to_data(of, &data, NULL), RESTITUTE_OK);
    return data;
}

static int same_bits(const restitute_table *a, const restitute_table *b)
{
    const restitute_table_data x = data_of(a), y = data_of(b);
    const size_t n = (size_t)x.rebound_cells * 17, leaf = 7 * sizeof *x.leaves;
    const size_t m = (size_t)(x.nodes[0] * x.nodes[1]);
    return memcmp(x.nodes, y.nodes, sizeof x.nodes) == 0 && x.rebound_cells == y.rebound_cells &&
           x.chain_length == y.chain_length && memcmp(x.chain, y.chain, sizeof x.chain) == 0 &&
           memcmp(x.leaves, y.leaves, (size_t)x.cells * leaf) == 0 &&
           memcmp(x.rebound_leaves, y.rebound_leaves, (size_t)x.rebound_cells * leaf) == 0 &&
           memcmp(x.ez, y.ez, n * sizeof *x.ez) == 0 && memcmp(x.ex_cells, y.ex_cells, m * sizeof *x.ex_cells) == 0 &&
           x.error_ez == y.error_ez && x.error_ex == y.error_ex && x.impacts == y.impacts && x.checks == y.checks;
}

/* Two threads; steps; a journal taken up by another builder. */
static void the_same_bits(void **state)
{
    restitute_table *one = build(1), *stepped = NULL;
    restitute_table_builder *first, *second;
    restitute_error error;
    size_t count;
    (void)state;
    CHECK(same_bits(one, table), "one and two threads");
    const restitute_table_family family = across_the_line();
    const restitute_table_options options = options_of(1);
    assert_int_equal(restitute_table_builder_create(&family, &options, &first, &error), RESTITUTE_OK);
    while (restitute_table_builder_solved(first) < data_of(one).impacts * 2 / 3)
        assert_int_equal(restitute_table_builder_run(first, 777, &stepped, &error), RESTITUTE_OK);
    assert_null(stepped);
    CHECK(restitute_table_builder_expected(first) >= restitute_table_builder_solved(first), "expected");
    assert_int_equal(restitute_table_builder_create(&family, &options, &second, &error), RESTITUTE_OK);
    const double *journal = restitute_table_builder_journal(first, &count);
    assert_int_equal(restitute_table_builder_restore(second, journal, count, &error), RESTITUTE_OK);
    restitute_table_builder_destroy(first);
    while (!stepped)
        assert_int_equal(restitute_table_builder_run(second, 5000, &stepped, &error), RESTITUTE_OK);
    CHECK(same_bits(one, stepped), "in steps and from a journal");
    restitute_table_builder_destroy(second);
    restitute_table_destroy(one);
    restitute_table_destroy(stepped);
}

/* Across every seam that the finest cells may have, most of them between cells of unlike size: what differs is single precision (6e-8
 * of values up to 2, some of them added). */
static void continuous_at_all_seams(void **state)
{
    const restitute_table_data data = data_of(table);
    int64_t divided = 0;
    (void)state;
    for (int64_t i = 0; i < data.cells; i++)
        divided += data.leaves[7 * i + 3] > 0;
    CHECK(divided > 0 && divided < data.cells,
          "%lld of %lld cells are of divided roots: there is no seam of unlike cells", (long long)divided,
          (long long)data.cells);
    for (int seam = 1; seam < 96; seam++)
        for (int k = 0; k < 50; k++) {
            const int octave = seam / 32, by_gamma = k % 2;
            const double start = ldexp(by_gamma ? 0.0625 : 0.5, octave), at = start * (1 + seam % 32 / 32.0);
            const double other = by_gamma ? 0.5 * pow(7, k / 50.0) : 0.07 * pow(5.7, k / 50.0);
            const double chi = 1 + 0.4 * k / 50, psi = 0.07 * k;
            restitute_table_value left, right;
            if (at >= (by_gamma ? 0.4 : 3.5)) continue;
            const double below = nextafter(at, 0);
            restitute_table_numbers_pair(table, chi, psi, by_gamma ? other : below, by_gamma ? below : other, &left);
            restitute_table_numbers_pair(table, chi, psi, by_gamma ? other : at, by_gamma ? at : other, &right);
            CHECK_NEAR(left.ez, right.ez, 1e-12, "%s = %g", by_gamma ? "gamma" : "delta1", at);
            CHECK_NEAR(left.ex, right.ex, 1e-6, "%s = %g, other %g, chi %g, psi %g", by_gamma ? "gamma" : "delta1", at,
                       other, chi, psi);
        }
}

/* Derivatives against differences of 1e-3 of the speed: their own error is some 1e-4 of values near 1. */
static void slopes(void **state)
{
    restitute_material *material;
    restitute_table_contact contact;
    restitute_error error;
    (void)state;
    restitute_table_contact_init(&contact);
    restitute_scene scene = ball_on(0.2, &material);
    CHECK(restitute_table_contact_of(table, &scene, &contact, &error) == RESTITUTE_OK, "%s", error.message);
    contact.delta1 = 1.3;
    for (double v_t = 0.1; v_t < 3; v_t += 0.17) {
        restitute_table_value here, more, less;
        restitute_table_slope slope;
        const double v_n = 1.05, d = 1e-3;
        assert_int_equal(restitute_table_pair_of(table, &contact, v_n, v_t, &here, &slope), RESTITUTE_OK);
        restitute_table_pair_of(table, &contact, v_n + d, v_t, &more, NULL);
        restitute_table_pair_of(table, &contact, v_n - d, v_t, &less, NULL);
        CHECK_NEAR(slope.ez_normal, (more.ez - less.ez) / (2 * d), 1e-3, "v_t = %g", v_t);
        CHECK_NEAR(slope.ex_normal, (more.ex - less.ex) / (2 * d), 5e-3, "v_t = %g", v_t);
    }
    restitute_material_destroy(material);
}

static void data_makes_the_same_table(void **state)
{
    restitute_table *copy = NULL;
    restitute_error error;
    (void)state;
    const restitute_table_data data = data_of(table);
    CHECK(restitute_table_from_data(&data, &copy, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(same_bits(table, copy), "copy");
    restitute_table_destroy(copy);
}

/* However narrow the ranges are, the table is compared within them. */
static void narrow_ranges_are_checked(void **state)
{
    restitute_table_family family;
    restitute_table_info info;
    restitute_table *made = NULL;
    restitute_error error;
    (void)state;
    restitute_table_family_init(&family);
    family.chi[0] = family.chi[1] = 1.1;
    family.delta1[0] = 1, family.delta1[1] = 1.001;
    family.gamma[0] = 1, family.gamma[1] = 1.001;
    const restitute_table_options options = options_of(1);
    CHECK(restitute_table_build(&family, &options, &made, &error) == RESTITUTE_OK, "%s", error.message);
    restitute_table_info_init(&info);
    assert_int_equal(restitute_table_describe(made, &info, NULL), RESTITUTE_OK);
    CHECK(info.checks > 100 && info.error_ex > 0, "%lld checks, error %g", (long long)info.checks, info.error_ex);
    restitute_table_destroy(made);
}

/* A build that may not solve enough impacts gives an error, or a table that was compared; never more impacts. */
static void no_table_without_checks(void **state)
{
    const restitute_table_family family = across_the_line();
    const int64_t needed = data_of(table).impacts;
    int refused = 0, made_some = 0;
    (void)state;
    for (int part = 1; part <= 20; part++) {
        restitute_table_options options = options_of(2);
        restitute_table *made = NULL;
        restitute_error error;
        options.max_impacts = needed * part / 20;
        const int status = restitute_table_build(&family, &options, &made, &error);
        refused += status == RESTITUTE_ERROR_TOO_MUCH_WORK;
        CHECK(status == RESTITUTE_ERROR_TOO_MUCH_WORK || status >= 0, "%s", error.message);
        if (status < 0) continue;
        made_some++;
        const restitute_table_data data = data_of(made);
        CHECK(data.checks > 0 && data.impacts <= options.max_impacts, "%lld checks, %lld of %lld impacts",
              (long long)data.checks, (long long)data.impacts, (long long)options.max_impacts);
        restitute_table_destroy(made);
    }
    CHECK(refused > 0 && made_some > 0, "%d refused, %d made", refused, made_some);
}

/* Where log2 w is no number, and what single precision does not hold. */
static void ranges_that_cannot_be(void **state)
{
    restitute_table_family family = across_the_line();
    restitute_table_options options = options_of(1);
    restitute_table *made = NULL;
    restitute_error error;
    (void)state;
    options.tolerance = 5e-7;
    CHECK(restitute_table_build(&family, &options, &made, &error) == RESTITUTE_ERROR_DOMAIN && !made, "%s",
          error.message);
    options = options_of(1);
    family.delta1[0] = 1e-305, family.delta1[1] = 1e-295;
    family.gamma[0] = 1e-40, family.gamma[1] = 1e-30;
    CHECK(restitute_table_build(&family, &options, &made, &error) == RESTITUTE_ERROR_DOMAIN && !made, "%s",
          error.message);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(narrow_ranges_are_checked),
                                       cmocka_unit_test(no_table_without_checks),
                                       cmocka_unit_test(ranges_that_cannot_be), cmocka_unit_test(the_same_bits), cmocka_unit_test(continuous_at_all_seams),
                                       cmocka_unit_test(slopes), cmocka_unit_test(data_makes_the_same_table)};
    return cmocka_run_group_tests(tests, build_once, destroy);
}
