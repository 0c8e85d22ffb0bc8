/* Derivatives of the pair from a table of two axes: of the polynomials that a lookup takes (lookup_two_axes.c).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "slope.h"

#include "table_form.h"

/* A place along the speed, in [1, 2), with 1/(1 + ez) and its derivative by it. */
struct speed_place {
    int64_t cell;
    double x, per_speed; /* per_speed: derivative of x; 0 where the speed is taken as an end */
    double inverse, inverse_x;
};

static struct speed_place find_speed(const restitute_table *t, double speed)
{
    struct speed_place p;
    p.x = 1 + rst_octaves_find(&t->speed, speed, &p.cell) / rst_cubic;
    const double *a = t->inverse[p.cell], x = p.x;
    const double width = rst_octaves_node(&t->speed, (p.cell + 1) * rst_cubic) -
                         rst_octaves_node(&t->speed, p.cell * rst_cubic);
    const double inverse = (a[0] + a[2] * x) + x * x * (a[1] + a[3] * x);
    p.inverse = rst_clamp(inverse, 0.5, 1);
    p.inverse_x = p.inverse == inverse ? a[2] + x * (2 * a[1] + 3 * a[3] * x) : 0;
    p.per_speed = speed >= t->speed.low && speed <= t->speed.high ? 1 / width : 0;
    return p;
}

/* A place along psi, in [1, 2), with its derivatives by psi and by x. */
struct psi_place {
    double (*patch)[4];
    double y, y_psi, y_x;
};

static struct psi_place find_psi(const restitute_table *t, const struct speed_place *speed, double psi)
{
    const int slips = psi > 1;
    const struct rst_psi_cells *cells = &t->psi_cells[slips];
    const double per_psi = cells->square[0] * speed->inverse / (2 * t->chi_low - 1);
    const double along = slips ? rst_smaller(per_psi * (psi - 1), cells->square[0]) : 0;
    const double up = cells->soft[0] + along, down = cells->total[0] - along, root = sqrt(rst_smaller(up, down));
    const double u = root + (cells->begin + (slips ? 0 : psi * cells->of_psi));
    const double stretch = slips ? (up > down ? -0.5 : 0.5) / root : 0;
    const int64_t cell = rst_psi_cell(u);
    const int64_t first = t->first_cell[slips + (up > down)];
    return (struct psi_place){.patch = t->patch[speed->cell * t->cells_of_psi + first + cell],
                              .y = u - (rst_cells_begin + (double)cell) + 1,
                              .y_psi = slips ? stretch * per_psi : cells->of_psi,
                              .y_x = stretch * along * (speed->inverse_x / speed->inverse)};
}

void rst_two_axes_slope(const restitute_table *t, double speed, double psi, struct rst_slope *slope)
{
    const struct speed_place s = find_speed(t, speed);
    const double twice_chi = 2 * t->chi_low, full = twice_chi / s.inverse, full_x = -full * s.inverse_x / s.inverse;
    *slope = (struct rst_slope){.ez_speed = full_x / twice_chi * s.per_speed};
    if (psi >= 1 + (twice_chi - 1) / s.inverse) { /* psi^2 could overflow */
        slope->ex_speed = full_x / psi * s.per_speed;
        slope->ex_psi = -full / psi / psi;
        return;
    }
    const struct psi_place p = find_psi(t, &s, psi);
    const double x[4] = {1, s.x, s.x * s.x, s.x * s.x * s.x}, x_x[4] = {0, 1, 2 * s.x, 3 * s.x * s.x};
    const double y[4] = {1, p.y, p.y * p.y, p.y * p.y * p.y}, y_y[4] = {0, 1, 2 * p.y, 3 * p.y * p.y};
    double by_x = 0, by_y = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            by_x += p.patch[i][j] * x_x[i] * y[j];
            by_y += p.patch[i][j] * x[i] * y_y[j];
        }
    slope->ex_speed = (by_x + by_y * p.y_x + full_x / (psi > 1 ? psi : 1)) * s.per_speed;
    slope->ex_psi = by_y * p.y_psi - (psi > 1 ? full / (psi * psi) : 0);
}
