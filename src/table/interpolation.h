/* Twins of interpolation.f90: rows are contiguous, row[i*n + j]; arrays are a[before][n][after].
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_INTERPOLATION_H
#define RST_TABLE_INTERPOLATION_H

#include <stdint.h>

void rst_table_nodes(int64_t n, double *x);
void rst_table_weights(int64_t n, double point, double *row);
void rst_table_spectrum(int64_t n, double *row);
void rst_table_last(int64_t n, double *row);
void rst_table_along(int64_t after, int64_t n, int64_t m, int64_t before, const double *row, const double *a,
                     double *b);

#endif
