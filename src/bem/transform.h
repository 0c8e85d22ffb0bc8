/* Convolutions with the influence coefficients on grids of several sizes, by fast cosine
 * transforms.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_TRANSFORM_H
#define BEM_TRANSFORM_H

#include "bem/kernels.h"

/* A two-dimensional cosine transform of length n of m x m values: plans and room. */
struct bem_cosine {
    int64_t m, n, line; /* line: distance of lines in the room, in complex numbers */
    fftw_complex *twiddles, *scratch;
    fftw_complex *rows, *rows_after, *columns, *columns_after; /* out of place is faster */
    fftw_plan row_forward, row_backward, column_forward, column_backward;
};

/* All that belongs to one size m: a quarter of a grid of 2m x 2m cells. Spectra are for unit
 * spacing. */
struct bem_transform {
    int64_t m;
    struct bem_cosine padded, plain;
    double *spectrum[2], *inverse[2]; /* of BEM_NORMAL and BEM_SHEAR: times n^-2; 1/spectrum of the unpadded grid */
};

/* A new transform; NULL: out of memory. m: even. */
struct bem_transform *rst_bem_transform_create(int64_t m);
void rst_bem_transform_destroy(struct bem_transform *transform);

/* u = K x without images; x and u are m x m in lines of length ld, may be the same. */
void rst_bem_convolve(struct bem_transform *transform, enum bem_kind kind, int64_t ld, const double *x, double *u);

/* z: nearly K^-1 r. */
void rst_bem_precondition(struct bem_transform *transform, enum bem_kind kind, int64_t ld, const double *r, double *z);

#endif
