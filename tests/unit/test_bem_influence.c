/* Influence coefficients against quadrature, and the convolution by cosine transforms against the
 * plain sum.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "../support/check.h"
#include "../support/random.h"
#include "bem/transform.h"

static const double pi = 3.14159265358979323846;

static double kernel(enum bem_kind kind, double x, double y)
{
    const double r = hypot(x, y);
    if (kind == BEM_NORMAL) return 1 / r / (4 * pi);
    return (1 / r + x * x / (r * r * r)) / (4 * pi);
}

/* Gauss-Legendre of 10 nodes in each direction: its error is far below 1e-9 for cells that do not
 * touch the point. */
static double by_quadrature(enum bem_kind kind, int i, int j)
{
    static const double node[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                  0.9739065285171717};
    static const double weight[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                    0.0666713443086881};
    double sum = 0;
    for (int a = 0; a < 10; a++)
        for (int b = 0; b < 10; b++) {
            const double x = i + 0.5 * (a < 5 ? node[a] : -node[a - 5]), y = j + 0.5 * (b < 5 ? node[b] : -node[b - 5]);
            sum += 0.25 * weight[a % 5] * weight[b % 5] * kernel(kind, x, y);
        }
    return sum;
}

static void coefficients_are_the_integrals(void **state)
{
    enum { n = 12 };
    double table[(n + 1) * (n + 1)];
    (void)state;
    for (enum bem_kind kind = BEM_NORMAL; kind <= BEM_SHEAR; kind++) {
        rst_bem_influence_table(kind, n, table);
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++) {
                if (i * i + j * j < 4) continue; /* the point is too near for this quadrature */
                CHECK_NEAR(table[j * (n + 1) + i], by_quadrature(kind, i, j), 1e-9, "kind %d at %d, %d", kind, i, j);
            }
    }
}

/* int 1/r over the unit square about its centre is 4 ln(1 + sqrt 2); that of x^2/r^3 is half of it,
 * by symmetry. */
static void own_cell(void **state)
{
    double table[4];
    const double exact = 4 * log(1 + sqrt(2)) / (4 * pi);
    (void)state;
    rst_bem_influence_table(BEM_NORMAL, 1, table);
    CHECK_NEAR(table[0], exact, 1e-15, "normal");
    rst_bem_influence_table(BEM_SHEAR, 1, table);
    CHECK_NEAR(table[0], 1.5 * exact, 1e-15, "shear");
}

/* K x at cell (i, j) of the quarter, x even in both directions, by the sum over all four
 * quarters. */
static double by_sum(const double *table, int n, int m, int ld, const double *x, int i, int j)
{
    double sum = 0;
    for (int l = -m; l < m; l++)
        for (int k = -m; k < m; k++) {
            const int di = abs(i - k), dj = abs(j - l);
            sum += table[dj * (n + 1) + di] * x[(l < 0 ? -l - 1 : l) * ld + (k < 0 ? -k - 1 : k)];
        }
    return sum;
}

static void convolution_is_the_sum(void **state)
{
    (void)state;
    for (int m = 4; m <= 18; m += 2) {
        const int n = 2 * m, ld = m + 3;
        double *table = malloc(sizeof *table * (size_t)((n + 1) * (n + 1)));
        double *x = malloc(sizeof *x * (size_t)(ld * m)), *u = calloc((size_t)(ld * m), sizeof *u);
        struct bem_transform *t = rst_bem_transform_create(m);
        uint64_t seed = 7;
        assert_non_null(t);
        for (int i = 0; i < ld * m; i++)
            x[i] = random_in(&seed, -1, 1);
        for (enum bem_kind kind = BEM_NORMAL; kind <= BEM_SHEAR; kind++) {
            rst_bem_influence_table(kind, n, table);
            rst_bem_convolve(t, kind, ld, x, u);
            for (int j = 0; j < m; j++)
                for (int i = 0; i < m; i++) /* sums of some hundred terms of order 0.1 */
                    CHECK_NEAR(u[j * ld + i], by_sum(table, n, m, ld, x, i, j), 1e-13, "m %d kind %d at %d, %d", m,
                               kind, i, j);
        }
        rst_bem_transform_destroy(t);
        free(table);
        free(x);
        free(u);
    }
}

/* The preconditioner returns what was convolved, but for images and the rim: a smooth bump far from
 * the side within a few percent. */
static void preconditioner_inverts(void **state)
{
    enum { m = 32 };
    static double x[m * m], u[m * m], z[m * m];
    struct bem_transform *t = rst_bem_transform_create(m);
    (void)state;
    assert_non_null(t);
    for (enum bem_kind kind = BEM_NORMAL; kind <= BEM_SHEAR; kind++) {
        double error = 0, size = 0;
        for (int j = 0; j < m; j++)
            for (int i = 0; i < m; i++)
                x[j * m + i] = exp(-((i + 0.5) * (i + 0.5) + (j + 0.5) * (j + 0.5)) / 40.0);
        rst_bem_convolve(t, kind, m, x, u);
        rst_bem_precondition(t, kind, m, u, z);
        for (int i = 0; i < m * m; i++) {
            error += (z[i] - x[i]) * (z[i] - x[i]);
            size += x[i] * x[i];
        }
        CHECK(error < 0.05 * 0.05 * size, "kind %d: off by %g of it", kind, sqrt(error / size));
    }
    rst_bem_transform_destroy(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(coefficients_are_the_integrals), cmocka_unit_test(own_cell),
                                       cmocka_unit_test(convolution_is_the_sum),
                                       cmocka_unit_test(preconditioner_inverts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
