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

#endif
