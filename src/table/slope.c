/* A pair of any contact, with its derivatives on request: the same polynomials as in lookup.c, differentiated. Cells
 * and two axes have files of their own.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "slope.h"

#include <float.h>

#include "table_form.h"

void rst_cubic_slopes(double s, double w[4], double dw[4])
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

/* Place along delta1 or the speed, or along gamma, with derivatives by the number; they are 0 outside. */
struct direction {
    double w[4], dw[4];
    int64_t node;
    int n;
};

struct directions {
    struct direction speed, gamma;
};

static struct direction find_direction(const struct rst_octaves *axis, double number)
{
    struct direction d = {.w = {1}, .n = 1};
    if (axis->cells == 0) return d;
    int64_t cell;
    const double s = rst_octaves_find(axis, number, &cell);
    d.node = cell * rst_cubic;
    d.n = 4;
    rst_cubic_slopes(s, d.w, d.dw);
    const double width = rst_octaves_node(axis, d.node + rst_cubic) - rst_octaves_node(axis, d.node);
    const int inside = number >= axis->low && number <= axis->high;
    for (int i = 0; i < 4; i++)
        d.dw[i] *= inside ? rst_cubic / width : 0;
    return d;
}

/* Which of the ez is at a node. */
static int64_t corner_of(const restitute_table *t, const struct directions *d, int i, int j)
{
    return (d->speed.node + i) * t->n_gamma + d->gamma.node + j;
}

static double ex_at(const restitute_table *t, const struct directions *d, int i, int j, int64_t psi, int64_t chi)
{
    return t->ex[(corner_of(t, d, i, j) * t->n_psi + psi) * t->n_chi + chi];
}

static double sum_ez(const restitute_table *t, const struct directions *d, const double *by_speed)
{
    double sum = 0;
    for (int i = 0; i < d->speed.n; i++)
        for (int j = 0; j < d->gamma.n; j++)
            sum += by_speed[i] * d->gamma.w[j] * t->ez[corner_of(t, d, i, j)];
    return sum;
}

struct slip_place {
    int64_t node;
    int n;
    double w[4], dw[4]; /* by s */
};

static double sum_ex(const restitute_table *t, const struct directions *d, const double *by_speed, const double *chi,
                     int64_t chi_node, const struct slip_place *psi, const double *by_psi)
{
    double sum = 0;
    for (int i = 0; i < d->speed.n; i++)
        for (int j = 0; j < d->gamma.n; j++)
            for (int k = 0; k < psi->n; k++)
                for (int64_t l = 0; l < (t->n_chi > 1 ? 4 : 1); l++)
                    sum += by_speed[i] * d->gamma.w[j] * by_psi[k] * chi[l] *
                           ex_at(t, d, i, j, psi->node + k, chi_node + l);
    return sum;
}

/* d s/d y: s goes with r(y) or r(1 - y). */
static double slip_stretch(const restitute_table *t, double y)
{
    const double u = (y > 0.5 ? 1 - y : y) + rst_soft * rst_soft;
    return (y > 0.5 ? -1 : 1) * rst_cubic * t->psi_cells[1].of_root / (2 * sqrt(u));
}

void rst_table_slope(const restitute_table *t, double speed, double gamma, double chi, double psi,
                     struct rst_slope *slope)
{
    if (t->n_cells > 0) {
        rst_cell_slope(t, speed, gamma, chi, psi, slope);
        return;
    }
    if (t->two_axes) {
        rst_two_axes_slope(t, speed, psi, slope);
        return;
    }
    const struct directions d = {find_direction(&t->speed, speed), find_direction(&t->gamma, gamma)};
    const double ez = sum_ez(t, &d, d.speed.w);
    double chi_w[4] = {1}, s;
    double quotient, closed;
    int64_t chi_node = 0;
    *slope = (struct rst_slope){.ez_speed = ez > 0 && ez < 1 ? sum_ez(t, &d, d.speed.dw) : 0};
    chi = fmin(fmax(chi, t->chi_low), t->chi_high);
    if (t->n_chi > 1) {
        chi_node = rst_chi_find(t, chi, &s);
        rst_cubic_weights(s, chi_w);
    }
    const double full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    if (psi >= critical) { /* psi^2 could overflow */
        slope->ex_speed = 2 * chi * slope->ez_speed / psi;
        slope->ex_psi = -full / psi / psi;
        return;
    }
    struct slip_place p = {.n = 1, .w = {1}};
    double stretch = 0, y = 0;
    if (t->stick_cells > 0) {
        y = (psi - 1) / (critical - 1);
        p.node = rst_psi_find(t, psi, 1, critical - 1, &s, &quotient, &closed);
        p.n = 4;
        rst_cubic_slopes(s, p.w, p.dw);
        stretch = psi <= 1 ? (double)t->stick_cells * rst_cubic : slip_stretch(t, y) / (critical - 1);
    }
    slope->ex_speed = sum_ex(t, &d, d.speed.dw, chi_w, chi_node, &p, p.w);
    slope->ex_psi = sum_ex(t, &d, d.speed.w, chi_w, chi_node, &p, p.dw) * stretch;
    if (t->stick_cells == 0 || psi <= 1) return;
    /* y moves with psi_c, which moves with ez */
    slope->ex_speed += 2 * chi * slope->ez_speed / psi - slope->ex_psi * y * (2 * chi - 1) * slope->ez_speed;
    slope->ex_psi -= full / (psi * psi);
}

/* In full slip 1 + ex is 2 chi (1 + ez) v_n/(f v_t): by v_n and v_t it is smooth down to v_n = 0, where psi is
 * infinite. */
static void full_slip_by_speeds(double chi, double ez, double ez_normal, double factor, double v_n, double v_t,
                                restitute_table_slope *slope)
{
    const double sliding = factor * v_t;
    slope->ex_normal = 2 * chi * ((1 + ez) + ez_normal * v_n) / sliding;
    slope->ex_tangential = -2 * chi * (1 + ez) * (v_n / v_t) / sliding;
}

/* By the speeds themselves: psi = f v_t/v_n. Where ex would exceed its bounds and is kept at them, slopes are 0. Below
 * 1e-100 m/s speeds count as 0: slopes go with their inverse. */
static void by_speeds(const restitute_table *t, const restitute_table_contact *c, double normal_speed,
                      double tangential_speed, const restitute_table_value *pair, restitute_table_slope *slope)
{
    struct rst_slope by;
    const double v_n = normal_speed < 1 / rst_largest_speed ? 0 : normal_speed;
    const double v_t = fabs(tangential_speed) < 1 / rst_largest_speed ? 0 : fabs(tangential_speed);
    const double sliding = c->psi_factor > DBL_MAX ? 0 : c->psi_factor * v_t;
    const double speed = t->of_contact ? v_n * c->speed_factor : c->delta1 * pow(v_n, 0.2);
    const double rate = t->of_contact ? c->speed_factor : v_n > 0 ? 0.2 * speed / v_n : 0;
    const double psi = c->psi_factor > DBL_MAX ? INFINITY : !(sliding > 0) ? 0 : v_n > 0 ? sliding / v_n : INFINITY;
    const double chi = fmin(fmax(c->chi, t->chi_low), t->chi_high);
    rst_table_slope(t, speed, c->gamma, c->chi, psi, &by);
    *slope = (restitute_table_slope){.ez_normal = by.ez_speed * rate};
    if (psi >= restitute_critical_psi(chi, pair->ez)) {
        if (sliding > 0) full_slip_by_speeds(chi, pair->ez, slope->ez_normal, c->psi_factor, v_n, v_t, slope);
        return;
    }
    if (fabs(pair->ex) >= 1) return;
    slope->ex_normal = by.ex_speed * rate;
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
    if (slope) by_speeds(table, contact ? contact : &table->own, normal_speed, tangential_speed, pair, slope);
    return RESTITUTE_OK;
}
