/* A pair of any contact, with its derivatives on request: the same polynomials as in lookup.c, differentiated.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "slope.h"

#include <float.h>

#include "table_form.h"

/* Weights and their derivatives for nodes s = 0..3, by products without one factor, or without two. */
static void cubic_slopes(double s, double w[4], double dw[4])
{
    for (int k = 0; k <= rst_cubic; k++) {
        double scale = 1, product = 1, sum = 0;
        for (int j = 0; j <= rst_cubic; j++) {
            if (j == k) continue;
            sum = sum * (s - j) + product;
            product *= s - j;
            scale *= k - j;
        }
        w[k] = product / scale;
        dw[k] = sum / scale;
    }
}

/* Place on an axis of octaves with derivatives by the number; they are 0 outside. */
struct directions {
    double w[4], dw[4];
    int64_t node;
    int n;
};

static struct directions find_direction(const struct rst_octaves *axis, double number)
{
    struct directions d = {.w = {1}, .n = 1};
    if (axis->cells == 0) return d;
    int64_t cell;
    const double s = rst_octaves_find(axis, number, &cell);
    d.n = 4;
    d.node = cell * rst_cubic;
    cubic_slopes(s, d.w, d.dw);
    const double width = rst_octaves_node(axis, d.node + rst_cubic) - rst_octaves_node(axis, d.node);
    const int inside = number >= axis->low && number <= axis->high;
    for (int i = 0; i < 4; i++)
        d.dw[i] *= inside ? rst_cubic / width : 0;
    return d;
}

static double sum_ez(const restitute_table *t, const double *by_speed, int n_speed, int64_t row,
                     const struct directions *gamma)
{
    double sum = 0;
    for (int i = 0; i < n_speed; i++)
        for (int j = 0; j < gamma->n; j++)
            sum += by_speed[i] * gamma->w[j] * t->ez[(row + i) * t->n_gamma + gamma->node + j];
    return sum;
}

struct slip_place {
    int64_t node;
    int n;
    double w[4], dw[4]; /* by s */
};

static double sum_ex(const restitute_table *t, const double *by_speed, int n_speed, int64_t row,
                     const struct directions *gamma, const double *chi, int64_t chi_node, const struct slip_place *psi,
                     const double *by_psi)
{
    double sum = 0;
    for (int i = 0; i < n_speed; i++)
        for (int j = 0; j < gamma->n; j++)
            for (int k = 0; k < psi->n; k++)
                for (int64_t l = 0; l < (t->n_chi > 1 ? 4 : 1); l++) {
                    const int64_t corner = (row + i) * t->n_gamma + gamma->node + j;
                    sum += by_speed[i] * gamma->w[j] * by_psi[k] * chi[l] *
                           t->ex[(corner * t->n_psi + psi->node + k) * t->n_chi + chi_node + l];
                }
    return sum;
}

/* d s/d y: s goes with r(y) or r(1 - y). */
static double slip_stretch(const restitute_table *t, double y)
{
    const double u = (y > 0.5 ? 1 - y : y) + rst_soft * rst_soft;
    return (y > 0.5 ? -1 : 1) * rst_cubic * t->psi_cells[1] / (2 * sqrt(u));
}

void rst_table_slope(const restitute_table *t, double speed, double gamma_in, double chi, double psi,
                     struct rst_slope *slope)
{
    const struct directions x = find_direction(&t->speed, speed), gamma = find_direction(&t->gamma, gamma_in);
    const double ez = sum_ez(t, x.w, x.n, x.node, &gamma);
    double chi_w[4] = {1}, s;
    double quotient;
    int64_t chi_node = 0;
    *slope = (struct rst_slope){.ez_speed = ez > 0 && ez < 1 ? sum_ez(t, x.dw, x.n, x.node, &gamma) : 0};
    chi = fmin(fmax(chi, t->chi_low), t->chi_high);
    if (t->n_chi > 1) {
        chi_node = rst_chi_find(t, chi, &s);
        rst_cubic_weights(s, chi_w);
    }
    const double full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    const double full_speed = 2 * chi * slope->ez_speed / psi, full_psi = -full / (psi * psi);
    if (psi >= critical) {
        slope->ex_speed = full_speed;
        slope->ex_psi = full_psi;
        return;
    }
    struct slip_place p = {.n = 1, .w = {1}};
    double stretch = 0, y = 0;
    if (t->stick_cells > 0) {
        y = (psi - 1) / (critical - 1);
        p.node = rst_psi_find(t, psi, 1, critical - 1, &s, &quotient);
        p.n = 4;
        cubic_slopes(s, p.w, p.dw);
        stretch = psi <= 1 ? (double)t->stick_cells * rst_cubic : slip_stretch(t, y) / (critical - 1);
    }
    slope->ex_speed = sum_ex(t, x.dw, x.n, x.node, &gamma, chi_w, chi_node, &p, p.w);
    slope->ex_psi = sum_ex(t, x.w, x.n, x.node, &gamma, chi_w, chi_node, &p, p.dw) * stretch;
    if (t->stick_cells == 0 || psi <= 1) return;
    /* y moves with psi_c, which moves with ez */
    slope->ex_speed += full_speed - slope->ex_psi * y * (2 * chi - 1) * slope->ez_speed;
    slope->ex_psi += full_psi;
}

/* By the speeds themselves: psi = f v_t/v_n. In full slip 1 + ex is 2 chi (1 + ez) v_n/(f v_t), smooth down to v_n = 0. */
static void by_speeds(const restitute_table *t, const restitute_table_contact *c, double v_n, double v_t,
                      restitute_table_slope *slope)
{
    struct rst_slope by;
    const double sliding = c->psi_factor > DBL_MAX ? 0 : c->psi_factor * fabs(v_t);
    const double speed = t->of_contact ? v_n * c->speed_factor : c->delta1 * pow(v_n, 0.2);
    const double rate = t->of_contact ? c->speed_factor : v_n > 0 ? 0.2 * speed / v_n : 0;
    const double psi = c->psi_factor > DBL_MAX ? INFINITY : sliding > 0 ? sliding / v_n : 0;
    rst_table_slope(t, speed, c->gamma, c->chi, psi, &by);
    *slope = (restitute_table_slope){.ez_normal = by.ez_speed * rate, .ex_normal = by.ex_speed * rate};
    if (psi > DBL_MAX) {
        restitute_table_value pair;
        rst_table_evaluate(t, speed, c->gamma, c->chi, psi, &pair);
        const double chi = fmin(fmax(c->chi, t->chi_low), t->chi_high);
        slope->ex_normal = sliding > 0 ? 2 * chi * (1 + pair.ez) / sliding : 0;
        return;
    }
    if (v_n > 0) {
        slope->ex_normal -= by.ex_psi * psi / v_n;
        slope->ex_tangential = by.ex_psi * (c->psi_factor / v_n);
    }
}

int restitute_table_pair_of(const restitute_table *table, const restitute_table_contact *contact, double normal_speed,
                            double tangential_speed, restitute_table_value *pair, restitute_table_slope *slope)
{
    restitute_table_value found;
    if (!pair) return RESTITUTE_ERROR_NULL;
    const int status = restitute_table_pairs(table, contact, 1, &normal_speed, &tangential_speed, &found.ez, &found.ex);
    if (status) return status;
    *pair = found;
    if (slope) by_speeds(table, contact ? contact : &table->own, normal_speed, tangential_speed, slope);
    return RESTITUTE_OK;
}
