/* Tables with axes of delta1 and gamma from plain numbers: lookups, slopes and places of nodes in cells made by hand, whose functions
 * are known; what no table has is refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/cells.h"

/* With an axis of chi, and without. */
static struct cells cells[2];
static restitute_table *table[2];

/* Rounding of single precision, 6e-8 of coefficients up to 1, whose functions add up to 10 at most. */
static const double single = 1e-6;

static int set_up(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        cells_make(i ? 1 : 1.6, 5, &cells[i]);
        table[i] = cells_table(&cells[i]);
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        restitute_table_destroy(table[i]);
        cells_free(&cells[i]);
    }
    return 0;
}

static void lookups_are_the_functions(void **state)
{
    uint64_t seed = 1;
    (void)state;
    for (int n = 0; n < 40000; n++) {
        const double chi = n % 2 ? 1 : random_in(&seed, 1, 1.6), psi = random_in(&seed, 0, 4);
        const double delta1 = random_log(&seed, 0.6, 3), gamma = random_log(&seed, 0.3, 0.9);
        const restitute_table_value expected = cells_pair(chi, psi, delta1, gamma);
        restitute_table_value pair;
        assert_int_equal(restitute_table_numbers_pair(table[n % 2], chi, psi, delta1, gamma, &pair), RESTITUTE_OK);
        CHECK_NEAR(pair.ez, expected.ez, 1e-12, "delta1 %.17g, gamma %.17g", delta1, gamma); /* place: 4.5e-13 of a root */
        CHECK_NEAR(pair.ex, expected.ex, single, "chi %.17g, psi %.17g, delta1 %.17g, gamma %.17g", chi, psi, delta1,
                   gamma);
    }
}

static void beyond_the_ranges_the_ends_are_taken(void **state)
{
    static const double beyond[][4] = {
        {0.1, 0, 0.6, 0.3}, {1, 0, 0, 0}, {2, 0, 1e9, 1e300}, {INFINITY, 1, INFINITY, INFINITY}, {0.5, 3, 0.1, 100}};
    static const double end[][4] = {
        {1, 0, 0.6, 0.3}, {1, 0, 0.6, 0.3}, {1.6, 0, 3, 0.9}, {1.6, 1, 3, 0.9}, {1, 3, 0.6, 0.9}};
    (void)state;
    for (int i = 0; i < 5; i++) {
        restitute_table_value pair, expected;
        const double *b = beyond[i], *e = end[i];
        assert_int_equal(restitute_table_numbers_pair(table[0], b[0], b[1], b[2], b[3], &pair), RESTITUTE_OK);
        assert_int_equal(restitute_table_numbers_pair(table[0], e[0], e[1], e[2], e[3], &expected), RESTITUTE_OK);
        CHECK(pair.ez == expected.ez && pair.ex == expected.ex, "case %d: %g, %g", i, pair.ez, pair.ex);
    }
    restitute_table_value pair;
    assert_int_equal(restitute_table_numbers_pair(table[0], 1.2, INFINITY, 1, 0.5, &pair), RESTITUTE_OK);
    CHECK(pair.ex == -1, "%g: psi is infinite", pair.ex);
}

/* By v_n and v_t, as a contact of those numbers sees the functions. */
static restitute_table_value by_speeds(const restitute_table_contact *c, double v_n, double v_t)
{
    return cells_pair(c->chi, c->psi_factor * v_t / v_n, c->delta1 * pow(v_n, 0.2), c->gamma);
}

/* Against central differences of the functions: their own error is 1e-9. Polynomials of cells 2^-4 wide have slopes 50 times the rounding of
 * their values. */
static void slopes_are_those_of_the_functions(void **state)
{
    uint64_t seed = 2;
    int kinds[3] = {0, 0, 0};
    (void)state;
    for (int n = 0; n < 20000; n++) {
        restitute_table_contact c;
        restitute_table_contact_init(&c);
        c.chi = n % 2 ? 1 : random_in(&seed, 1, 1.6);
        c.gamma = random_log(&seed, 0.3, 0.9);
        c.delta1 = random_log(&seed, 0.61, 2.9);
        c.psi_factor = 2;
        const double v_n = random_in(&seed, 0.99, 1.01), v_t = random_in(&seed, 0.01, 2), d = 1e-5;
        const double psi = 2 * v_t / v_n, critical = restitute_critical_psi(c.chi, by_speeds(&c, v_n, v_t).ez);
        /* not across the kinks of the functions, and not where slopes of the square root change within a difference */
        if (fabs(psi - 1) < 1e-3 || fabs(psi - critical) < 1e-3) continue;
        restitute_table_value pair;
        restitute_table_slope slope;
        assert_int_equal(restitute_table_pair_of(table[n % 2], &c, v_n, v_t, &pair, &slope), RESTITUTE_OK);
        const restitute_table_value more = by_speeds(&c, v_n + d, v_t), less = by_speeds(&c, v_n - d, v_t);
        const double by_tangent = by_speeds(&c, v_n, v_t + d).ex - by_speeds(&c, v_n, v_t - d).ex;
        CHECK_NEAR(slope.ez_normal, (more.ez - less.ez) / (2 * d), 1e-8, "psi = %.17g", psi);
        CHECK_NEAR(slope.ex_normal, (more.ex - less.ex) / (2 * d), 1e-4, "psi = %.17g", psi);
        CHECK_NEAR(slope.ex_tangential, by_tangent / (2 * d), 1e-4, "psi = %.17g", psi);
        kinds[psi > 1 ? psi > critical ? 2 : 1 : 0]++;
    }
    CHECK(kinds[0] > 1000 && kinds[1] > 1000 && kinds[2] > 1000, "%d, %d, %d of each side", kinds[0], kinds[1],
          kinds[2]);
}

/* The nodes of a cell are where they should be, and a lookup there gives what the cell holds. */
static void a_query_at_a_node_gives_its_value(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        const restitute_table_data *d = &cells[i].data;
        const int64_t n = i ? 50 : 136;
        double node[136][6];
        int64_t place[136][4], tried = 0;
        assert_int_equal(restitute_table_cell_functions(table[i], place), RESTITUTE_OK);
        for (int64_t cell = 0; cell < d->cells; cell++) {
            const int64_t *leaf = cells[i].tangent.leaf[cell];
            assert_int_equal(restitute_table_cell_nodes(table[i], cell, node), RESTITUTE_OK);
            for (int64_t m = 0; m < n; m++) {
                const double *at = node[m], delta1 = at[0], gamma = at[1], chi = at[2], psi = at[3];
                restitute_table_value pair;
                CHECK_NEAR(gamma, cells_leaf_gamma(leaf, (int)place[m][1]), 1e-15, "node %lld", (long long)m);
                CHECK_NEAR(cells_log_w(delta1, fmin(gamma, 0.999)), cells_leaf_log_w(d, leaf, (int)place[m][0]),
                           gamma < 0.999 ? 1e-13 : 1, "node %lld", (long long)m);
                if (delta1 < 0.6 || delta1 > 3 || gamma < 0.3 || gamma > 0.9) continue;
                restitute_table_numbers_pair(table[i], chi, psi, delta1, gamma, &pair);
                CHECK_NEAR(pair.ez, at[4], 1e-12, "cell %lld, node %lld", (long long)cell, (long long)m);
                CHECK_NEAR(pair.ex, at[5], single, "cell %lld, node %lld", (long long)cell, (long long)m);
                tried++;
            }
        }
        CHECK(tried > 10 * d->cells, "%lld nodes in the ranges", (long long)tried);
        assert_int_equal(restitute_table_cell_nodes(table[i], d->cells, node), RESTITUTE_ERROR_DOMAIN);
        assert_int_equal(restitute_table_cell_nodes(table[i], -1, node), RESTITUTE_ERROR_DOMAIN);
    }
    assert_int_equal(restitute_table_cell_nodes(table[0], 0, NULL), RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_table_cell_functions(NULL, NULL), RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_table_nodes(table[0], 0, (double[1]){0}), RESTITUTE_ERROR_DOMAIN); /* it has cells */
}

/* No two coefficients belong to the same function; each to one whose levels (1 for the middle, 2 for the quarters) are 2 at most. */
static void functions_are_those_of_the_interface(void **state)
{
    static const int level[5] = {0, 2, 1, 2, 0};
    int64_t place[136][4], of_ez = 0;
    (void)state;
    assert_int_equal(restitute_table_cell_functions(table[0], place), RESTITUTE_OK);
    for (int m = 0; m < 136; m++) {
        int sum = 0;
        for (int axis = 0; axis < 4; axis++)
            sum += level[place[m][axis]];
        CHECK(sum <= 2, "coefficient %d: level %d", m, sum);
        of_ez += place[m][2] + place[m][3] == 0;
        for (int k = 0; k < m; k++)
            CHECK(memcmp(place[k], place[m], sizeof *place) != 0, "coefficients %d and %d", k, m);
    }
    assert_int_equal(of_ez, 17);
}

static void data_comes_back(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        const restitute_table_data *in = &cells[i].data;
        restitute_table_data out;
        restitute_table_info info;
        int64_t nodes[4];
        const int64_t expected[4] = {in->cells, i ? 50 : 136, i ? 1 : 5, 5};
        restitute_table_data_init(&out);
        restitute_table_info_init(&info);
        assert_int_equal(restitute_table_to_data(table[i], &out, NULL), RESTITUTE_OK);
        assert_int_equal(restitute_table_data_nodes(in, nodes, NULL), RESTITUTE_OK);
        assert_int_equal(restitute_table_describe(table[i], &info, NULL), RESTITUTE_OK);
        assert_memory_equal(nodes, expected, sizeof nodes);
        assert_memory_equal(out.nodes, expected, sizeof nodes);
        assert_memory_equal(info.nodes, expected, sizeof nodes);
        assert_int_equal(out.cells, in->cells);
        assert_int_equal(out.rebound_cells, in->rebound_cells);
        CHECK(out.w_width == 1 && out.w_first == -1 && out.w_roots == 3, "roots of w");
        assert_int_equal(out.chain_length, in->chain_length);
        assert_memory_equal(out.chain, in->chain, sizeof in->chain);
        assert_memory_equal(out.leaves, in->leaves, (size_t)in->cells * 7 * sizeof *in->leaves);
        assert_memory_equal(out.rebound_leaves, in->rebound_leaves, (size_t)in->rebound_cells * 7 * sizeof *in->leaves);
        assert_memory_equal(out.ez, in->ez, (size_t)in->rebound_cells * 17 * sizeof *in->ez);
        assert_memory_equal(out.ex_cells, in->ex_cells, (size_t)(in->cells * expected[1]) * sizeof *in->ex_cells);
        const size_t least = (size_t)(in->cells * expected[1]) * sizeof(float);
        CHECK(info.bytes > least && info.bytes < 2 * least + 1000000, "%zu bytes, %zu of them ex", info.bytes, least);
    }
}

static void is_refused(const restitute_table_data *data, const char *what)
{
    restitute_table *none = NULL;
    restitute_error error;
    const int status = restitute_table_from_data(data, &none, &error);
    CHECK(status == RESTITUTE_ERROR_DOMAIN && !none, "%s: status %d", what, status);
}

/* Each of these numbers alone is another. */
static void what_no_table_has_is_refused(void **state)
{
    const restitute_table_data *good = &cells[0].data;
    restitute_table_data d;
    (void)state;
#define REFUSED(member, value)                                                                                         \
    do {                                                                                                               \
        d = *good;                                                                                                     \
        d.member = (value);                                                                                            \
        is_refused(&d, #member " = " #value);                                                                          \
    } while (0)
    REFUSED(cells, 0);
    REFUSED(cells, -1);
    REFUSED(cells, INT64_MAX);
    REFUSED(rebound_cells, 0);
    REFUSED(rebound_cells, INT64_MAX);
    REFUSED(w_width, 5);
    REFUSED(w_width, -9);
    REFUSED(w_width, INT64_MIN);
    REFUSED(w_first, INT64_MAX);
    REFUSED(w_first, INT64_MIN);
    REFUSED(w_roots, 0);
    REFUSED(w_roots, -3);
    REFUSED(w_roots, 2); /* leaves are in the third */
    REFUSED(w_roots, INT64_MAX);
    REFUSED(w_roots, 2048);
    REFUSED(chain_length, -1);
    REFUSED(chain_length, 33);
    REFUSED(chain_length, 2); /* leaves are deeper */
    REFUSED(chain[1], 3);
    REFUSED(chain[1], -1);
    REFUSED(chi_high, 1);
    REFUSED(of_contact, 1);
    REFUSED(parts[0], 2);
    REFUSED(parts[1], 0);
    REFUSED(high[0], 0x1p1000); /* w would be infinite */
    REFUSED(range[0][0], NAN);
#undef REFUSED
    d = *good;
    d.chain_length = 13;
    memset(d.chain, 0, sizeof d.chain);
    is_refused(&d, "13 halvings along w");
    d = *good;
    d.leaves = NULL;
    assert_int_equal(restitute_table_from_data(&d, &(restitute_table *){NULL}, NULL), RESTITUTE_ERROR_NULL);
}

/* One number of one leaf, or one value. Beyond is whatever no leaf can have; a root as a leaf overlaps those that it was divided into. */
static void wrong_leaves_and_values_are_refused(void **state)
{
    restitute_table_data d = cells[0].data;
    int64_t(*leaf)[7] = malloc((size_t)d.cells * sizeof *leaf);
    float *ex = malloc((size_t)d.cells * 136 * sizeof *ex);
    (void)state;
    memcpy(leaf, d.leaves, (size_t)d.cells * sizeof *leaf);
    memcpy(ex, d.ex_cells, (size_t)d.cells * 136 * sizeof *ex);
    d.leaves = leaf[0];
    d.ex_cells = ex;
    const int64_t last = d.cells - 1;
    static const int64_t beyond[7] = {cells_octaves, cells_roots, cells_sheets, 11, INT64_C(1) << 40, 5, 16};
    for (int member = 0; member < 7; member++)
        for (int side = 0; side < 2; side++) {
            const int64_t kept = leaf[last][member];
            leaf[last][member] = side ? -1 : beyond[member];
            is_refused(&d, "a member of a leaf");
            leaf[last][member] = kept;
        }
    for (int64_t i = 1; i < d.cells; i++) {
        if (leaf[i][3] + leaf[i][5] == 0) continue;
        int64_t kept[7];
        memcpy(kept, leaf[i], sizeof kept);
        memset(&leaf[i][3], 0, 4 * sizeof **leaf);
        is_refused(&d, "a root over its parts");
        memcpy(leaf[i], leaf[i - 1], sizeof kept);
        is_refused(&d, "a leaf that is there twice");
        memcpy(leaf[i], kept, sizeof kept);
        if (i > 200) break;
    }
    ex[77] = NAN;
    is_refused(&d, "NaN");
    ex[77] = 2e4F;
    is_refused(&d, "a value too large");
    free(leaf);
    free(ex);
}

/* Leaves that are not there: lookups take others, and stay in the arrays and in the bounds of pairs. */
static void gaps_do_no_harm(void **state)
{
    struct cells gaps;
    uint64_t seed = 3;
    (void)state;
    cells_make(1.6, 9, &gaps);
    for (int round = 0; round < 3; round++) {
        int64_t kept = 0;
        for (int64_t i = 0; i < gaps.tangent.count; i++)
            if (random_in(&seed, 0, 1) < 0.3 || (kept == 0 && i == gaps.tangent.count - 1))
                memmove(gaps.tangent.leaf[kept++], gaps.tangent.leaf[i], sizeof *gaps.tangent.leaf);
        gaps.data.cells = gaps.tangent.count = kept;
        gaps.data.rebound_cells = 1 + gaps.data.rebound_cells / 3;
        restitute_table *made = cells_table(&gaps);
        for (int n = 0; n < 5000; n++) {
            restitute_table_value pair = {NAN, NAN};
            const double gamma = random_log(&seed, 0.1, 2), delta1 = random_log(&seed, 0.1, 10);
            const double psi = random_in(&seed, 0, 3), chi = random_in(&seed, 0.9, 1.7);
            assert_int_equal(restitute_table_numbers_pair(made, chi, psi, delta1, gamma, &pair), RESTITUTE_OK);
            CHECK(pair.ez >= 0 && pair.ez <= 1 && fabs(pair.ex) <= 1, "%g, %g", pair.ez, pair.ex);
        }
        restitute_table_destroy(made);
    }
    cells_free(&gaps);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lookups_are_the_functions),
                                       cmocka_unit_test(beyond_the_ranges_the_ends_are_taken),
                                       cmocka_unit_test(slopes_are_those_of_the_functions),
                                       cmocka_unit_test(a_query_at_a_node_gives_its_value),
                                       cmocka_unit_test(functions_are_those_of_the_interface),
                                       cmocka_unit_test(data_comes_back),
                                       cmocka_unit_test(what_no_table_has_is_refused),
                                       cmocka_unit_test(wrong_leaves_and_values_are_refused),
                                       cmocka_unit_test(gaps_do_no_harm)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
