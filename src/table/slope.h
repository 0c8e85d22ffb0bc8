/* Derivatives of a pair by the table's own numbers.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_SLOPE_H
#define RST_TABLE_SLOPE_H

#include <restitute/table.h>

struct rst_slope {
    double ez_speed, ex_speed, ex_psi; /* at constant psi; at constant speed */
};

void rst_table_slope(const restitute_table *t, double speed, double gamma, double chi, double psi,
                     struct rst_slope *slope);

/* The same for a table with cells. */
void rst_cell_slope(const restitute_table *t, double delta1, double gamma, double chi, double psi,
                    struct rst_slope *slope);

/* For a table of two axes. */
void rst_two_axes_slope(const restitute_table *t, double speed, double psi, struct rst_slope *slope);

/* Weights of nodes s = 0..3 and their derivatives: products without one factor, or without two. */
void rst_cubic_slopes(double s, double w[4], double dw[4]);

#endif
