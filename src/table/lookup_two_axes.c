/* Many places of a table of two axes, speed and psi, at once: step by step for all of a block, so that no place waits
 * for another one and that compilers may take vectors. The same operations as for one place (lookup.c), so the same
 * bits. SPDX-License-Identifier: BSD-3-Clause */
#include "lookup.h"

/* Where the places of a block are. */
struct seats {
    double weight[4][rst_block]; /* along the speed */
    double share[4][rst_block];  /* along psi */
    int64_t cell[rst_block];     /* first node of the speed */
    int64_t node[rst_block];     /* first node of psi */
    double full[rst_block], quotient[rst_block], closed[rst_block], kept[rst_block]; /* kept: 0 beyond psi_c */
};

/* a < b ? a : b and a > b ? a : b, which compilers know how to do for many at once. */
static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* rst_cubic_weights of many. */
static void weights(int n, const double *restrict s, double w[restrict 4][rst_block])
{
    for (int i = 0; i < n; i++) {
        const double a = s[i] - 1, b = s[i] - 2, c = s[i] - 3, ab = s[i] * a, bc = b * c;
        w[0][i] = a * bc * (-1.0 / 6);
        w[1][i] = s[i] * bc * 0.5;
        w[2][i] = ab * c * -0.5;
        w[3][i] = ab * b * (1.0 / 6);
    }
}

static void find_speeds(const restitute_table *t, int n, const double *restrict speed, struct seats *restrict at,
                        double *restrict ez)
{
    double s[rst_block];
    for (int i = 0; i < n; i++)
        s[i] = rst_octaves_find(&t->speed, speed[i], &at->cell[i]);
    weights(n, s, at->weight);
    for (int i = 0; i < n; i++) {
        at->cell[i] *= rst_cubic;
        const double *v = t->ez + at->cell[i];
        ez[i] = (at->weight[0][i] * v[0] + at->weight[1][i] * v[1]) + (at->weight[2][i] * v[2] + at->weight[3][i] * v[3]);
    }
    for (int i = 0; i < n; i++)
        ez[i] = smaller(larger(ez[i], 0), 1);
}

/* rst_psi_find of many: u is the place in cells, of which the stick side begins at 0 and both halves of the slip side
 * too. */
static void find_psi(const restitute_table *t, int n, const double *restrict sliding, const double *restrict v_n,
                     const double *restrict ez, struct seats *restrict at)
{
    double s[rst_block], u[rst_block], upper[rst_block], width[rst_block];
    const double twice_chi = t->chi_low * 2, of_psi = t->psi_cells[0].of_psi, of_root = t->psi_cells[1].of_root;
    for (int i = 0; i < n; i++) {
        at->full[i] = twice_chi * (1 + ez[i]);
        const double share = (twice_chi - 1) * v_n[i], beyond = sliding[i] - v_n[i];
        width[i] = share + share * ez[i];
        const double y = smaller(larger(beyond, 0), width[i]) / (width[i] + rst_least), other = 1 - y;
        const double root = sqrt(smaller(other, y) + rst_soft * rst_soft) - rst_soft;
        at->quotient[i] = smaller(sliding[i], v_n[i]) / (larger(sliding[i], v_n[i]) + rst_least);
        at->closed[i] = sliding[i] > v_n[i] ? 1 : 0;
        upper[i] = other < y ? 1 : 0;
        u[i] = root * of_root * at->closed[i] + at->quotient[i] * of_psi * (1 - at->closed[i]);
    }
    for (int i = 0; i < n; i++)
        at->kept[i] = sliding[i] - v_n[i] > width[i] ? 0 : 1;
    for (int i = 0; i < n; i++) {
        const int32_t cell = (int32_t)u[i];
        s[i] = (u[i] - (double)cell) * rst_cubic;
        at->node[i] = t->start[(int)(at->closed[i] + upper[i])] + (int64_t)cell * rst_cubic;
    }
    weights(n, s, at->share);
}

static void sum_up(const restitute_table *t, int n, const struct seats *restrict at, double *restrict ex)
{
    const int64_t stride = t->n_psi;
    for (int i = 0; i < n; i++) {
        const double *v = t->ex + at->cell[i] * stride + at->node[i];
        const double w0 = at->weight[0][i], w1 = at->weight[1][i], w2 = at->weight[2][i], w3 = at->weight[3][i];
        double c[4];
        for (int j = 0; j < 4; j++)
            c[j] = (w0 * v[j] + w1 * v[stride + j]) + (w2 * v[2 * stride + j] + w3 * v[3 * stride + j]);
        ex[i] = (at->share[0][i] * c[0] + at->share[1][i] * c[1]) + (at->share[2][i] * c[2] + at->share[3][i] * c[3]);
    }
    for (int i = 0; i < n; i++) {
        const double closed = at->closed[i] * (at->full[i] * at->quotient[i] - 1);
        ex[i] = smaller(larger(at->kept[i] * ex[i] + closed, -1), 1);
    }
}

void rst_two_axes_pairs(const restitute_table *t, int n, const double *speed, const double *sliding, const double *v_n,
                        double *ez, double *ex)
{
    struct seats at;
    find_speeds(t, n, speed, &at, ez);
    find_psi(t, n, sliding, v_n, ez, &at);
    sum_up(t, n, &at, ex);
}
