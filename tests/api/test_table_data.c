/* Tables of two axes from plain numbers: odd ones that are accepted, and smooth ones for which the answer is known.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <fenv.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "../support/table.h"

enum { places = 64 };

struct form {
    double low, high, chi, psi_factor;
    int64_t parts, stick_cells, slip_cells;
};

/* ez and ex at the nodes, as they are kept. */
struct numbers {
    double *ez, *ex;
    int64_t speeds, psis;
};

static restitute_table_data data_of(const struct form *form, struct numbers *n)
{
    restitute_table_data d;
    restitute_error error;
    int64_t nodes[4];
    restitute_table_data_init(&d);
    d.of_contact = 1;
    d.parts[0] = form->parts;
    d.range[0][0] = d.low[0] = form->low;
    d.range[0][1] = d.high[0] = form->high;
    d.range[1][0] = d.range[1][1] = d.low[1] = d.high[1] = d.own_gamma = d.own_delta1 = 1;
    d.range[2][0] = d.range[2][1] = d.chi_low = d.chi_high = d.own_chi = form->chi;
    d.stick_cells = form->stick_cells;
    d.slip_cells = form->slip_cells;
    d.psi_factor = form->psi_factor;
    d.duration = d.friction = d.radius = d.mass = d.modulus_factor = d.equilibrium_modulus = 1;
    CHECK(restitute_table_data_nodes(&d, nodes, &error) == RESTITUTE_OK, "%s", error.message);
    n->speeds = nodes[0];
    n->psis = nodes[3];
    n->ez = malloc((size_t)nodes[0] * sizeof *n->ez);
    n->ex = malloc((size_t)(nodes[0] * nodes[3]) * sizeof *n->ex);
    CHECK(n->ez && n->ex, "memory");
    d.ez = n->ez;
    d.ex = n->ex;
    return d;
}

static restitute_table *make(const restitute_table_data *d, struct numbers *n)
{
    restitute_table *table = NULL;
    restitute_error error;
    CHECK(restitute_table_from_data(d, &table, &error) == RESTITUTE_OK, "%s", error.message);
    free(n->ez);
    free(n->ex);
    return table;
}

static int whole(uint64_t *random, int count)
{
    return (int)random_in(random, 0, count - 1e-9);
}

/* From the least to the largest that a lookup takes. */
static double odd_speed(uint64_t *random, const struct form *form)
{
    const double odd[] = {0,         DBL_TRUE_MIN, DBL_MIN, 1e100, form->low, nextafter(form->low, 0),
                          form->high, nextafter(form->high, 0), nextafter(form->high, DBL_MAX)};
    enum { count = sizeof odd / sizeof *odd };
    const int which = whole(random, 2 * count);
    return which < count ? odd[which] : random_log(random, form->low, form->high);
}

static struct form odd_form(uint64_t *random)
{
    static const double chi[] = {0.5 + DBL_EPSILON, 0.7, 7.0 / 6, 2, 2 + 4 * DBL_EPSILON, 1e6};
    static const double factor[] = {0, 1e-300, 1, 3, 1e300, HUGE_VAL};
    struct form form = {.low = ldexp(1, whole(random, 40) - 20),
                        .chi = chi[whole(random, 6)],
                        .psi_factor = factor[whole(random, 6)],
                        .parts = (int64_t)1 << whole(random, 4),
                        .stick_cells = whole(random, 3) ? 1 + whole(random, 255) : 255,
                        .slip_cells = whole(random, 3) ? 1 + whole(random, 255) : 255};
    form.high = form.low * 4;
    return form;
}

static double odd_sliding(uint64_t *random, const struct form *form, double v_n)
{
    const int anywhere = whole(random, 3) > 0;
    const double psi = anywhere ? random_in(random, 0, 2 * form->chi + 2) : random_in(random, 1 - 1e-7, 1 + 1e-7);
    if (whole(random, 6) == 0) return odd_speed(random, form);
    const double v_t = form->psi_factor > 0 && form->psi_factor <= DBL_MAX ? psi * (v_n / form->psi_factor) : psi;
    return fmin(v_t, 1e100) * (whole(random, 2) ? 1 : -1);
}

static void look_up_odd(const restitute_table *table, const struct form *form, uint64_t *random)
{
    double v_n[places], v_t[places], ez[places], ex[places];
    for (int i = 0; i < places; i++) {
        v_n[i] = odd_speed(random, form);
        v_t[i] = odd_sliding(random, form, v_n[i]);
    }
    assert_int_equal(restitute_table_pairs(table, NULL, places, v_n, v_t, ez, ex), RESTITUTE_OK);
    for (int i = 0; i < places; i++) {
        restitute_table_value one, other;
        restitute_table_slope slope;
        assert_int_equal(restitute_table_pair(table, v_n[i], v_t[i], &one), RESTITUTE_OK);
        assert_int_equal(restitute_table_pair_of(table, NULL, v_n[i], v_t[i], &other, &slope), RESTITUTE_OK);
        CHECK(one.ez >= 0 && one.ez <= 1 && fabs(one.ex) <= 1, "ez %.17g, ex %.17g", one.ez, one.ex);
        CHECK(form->psi_factor <= DBL_MAX || one.ex == -1, "without friction, v_n %g: ex %.17g", v_n[i], one.ex);
        CHECK(one.ez == ez[i] && one.ex == ex[i] && one.ez == other.ez && one.ex == other.ex,
              "chi %.17g, v_n %.17g, v_t %.17g: one %.17g %.17g, many %.17g %.17g", form->chi, v_n[i], v_t[i], one.ez,
              one.ex, ez[i], ex[i]);
    }
}

/* Numbers that make no sense but are in their ranges, in all directions of rounding: bounds hold, one and many give the
 * same, and the sanitizers watch that nothing else is read. */
static void odd_numbers(void **state)
{
    static const int direction[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    uint64_t random = 11;
    (void)state;
    errno = 0;
    for (int i = 0; i < 400; i++) {
        struct numbers n;
        const struct form form = odd_form(&random);
        const restitute_table_data d = data_of(&form, &n);
        for (int64_t j = 0; j < n.speeds; j++)
            n.ez[j] = whole(&random, 4) ? random_in(&random, -0.5, 1.5) : 1.5;
        for (int64_t j = 0; j < n.speeds * n.psis; j++)
            n.ex[j] = random_in(&random, -1e4, 1e4) * (i % 2 ? 1 : 1e-4);
        restitute_table *table = make(&d, &n);
        for (int k = 0; k < 4; k++) {
            fesetround(direction[k]);
            look_up_odd(table, &form, &random);
            fesetround(FE_TONEAREST);
        }
        restitute_table_destroy(table);
    }
    CHECK(errno == 0, "errno = %d", errno);
}

/* ez and, for psi <= 1, ex of a smooth solid. */
static double smooth_ez(double v)
{
    return 0.6 + 0.2 * sin(log(v));
}

static double smooth_ex(double v, double psi)
{
    return 0.3 + 0.1 * sin(3 * psi) * cos(log(v));
}

/* r(y) at a node of half the slip side; the inverse of r(y) = sqrt(y + c^2) - c. */
static double y_of_node(int64_t i, int64_t cells)
{
    const double r = (double)i / (double)(3 * cells) * 0.6916543936097672;
    return fmin(r * (r + 2.0 / 64), 0.5);
}

/* Four octaves of 16 cells. Beyond psi = 1 what exceeds the closed form goes to 0 with y. */
static restitute_table *smooth_table(double chi)
{
    const struct form form = {0.25, 4, chi, 1, 16, 8, 8};
    struct numbers n;
    const restitute_table_data d = data_of(&form, &n);
    for (int64_t i = 0; i < n.speeds; i++) {
        const double v = ldexp(1 + (double)(i % 48) / 48, (int)(i / 48) - 2);
        n.ez[i] = smooth_ez(v);
        for (int64_t j = 0; j < n.psis; j++) {
            const int64_t half = (j - 25) % 25;
            const double y = j < 50 ? y_of_node(half, 8) : 1 - y_of_node(half, 8);
            n.ex[i * n.psis + j] = j < 25 ? smooth_ex(v, (double)j / 24)
                                          : (1 - y) * fmax(smooth_ex(v, 1) - (2 * chi * (1 + n.ez[i]) - 1), -1e4);
        }
    }
    return make(&d, &n);
}

/* A cubic through nodes that are h apart is off by h^4/24 of the fourth derivative: v/48 and at most 3/v^4 for ez, so
 * 2.4e-8; 1/24 and 8.1 for ex along psi, so 1.0e-6. What chi multiplies must not come on top of that. At seams of the
 * speed values agree but for rounding. */
static void errors_do_not_grow_with_chi(void **state)
{
    static const double chi[] = {7.0 / 6, 2, 2 + 4 * DBL_EPSILON, 1000};
    (void)state;
    for (int k = 0; k < 4; k++) {
        restitute_table *table = smooth_table(chi[k]);
        for (double v = 0.26; v < 3.9; v *= 1.0037)
            for (double psi = 0; psi < 1; psi += 0.0513) {
                const restitute_table_value pair = look_up(table, v, psi * v);
                CHECK_NEAR(pair.ez, smooth_ez(v), 2.4e-8, "chi %g, v %g", chi[k], v);
                CHECK_NEAR(pair.ex, smooth_ex(v, psi), 1.2e-6, "chi %g, v %g, psi %g", chi[k], v, psi);
            }
        for (int i = 1; i < 64; i++) {
            const double v = ldexp(1 + (i % 16) / 16.0, i / 16 - 2), below = nextafter(v, 0);
            const restitute_table_value here = look_up(table, v, 0.7 * v), there = look_up(table, below, 0.7 * below);
            CHECK_NEAR(here.ex, there.ex, 1e-13, "chi %g, v %g", chi[k], v);
        }
        restitute_table_destroy(table);
    }
}

/* Speeds above the table's are taken as its end, however large they are: the same but for rounding. */
static void enormous_speeds(void **state)
{
    static const double chi[] = {7.0 / 6, 1000};
    (void)state;
    for (int k = 0; k < 2; k++) {
        restitute_table *table = smooth_table(chi[k]);
        for (double psi = 0.1; psi < 4; psi += 0.3) {
            const restitute_table_value end = look_up(table, 8, psi * 8), far = look_up(table, 2e99, psi * 2e99);
            CHECK_NEAR(far.ex, end.ex, 1e-13, "chi %g, psi %g", chi[k], psi);
        }
        restitute_table_destroy(table);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(odd_numbers), cmocka_unit_test(errors_do_not_grow_with_chi),
                                       cmocka_unit_test(enormous_speeds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
