/* Convolutions of tractions and displacements in the plane, along x (even in x and y) and along y
 * (odd in both). Slower than those of transform.h: FFTW's own real transforms.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_PLANE_H
#define BEM_PLANE_H

#include <stdint.h>

struct bem_plane;

enum bem_plane_kind { BEM_Y_FROM_Y, BEM_Y_FROM_X, BEM_X_FROM_Y };

/* For a quarter of m x m cells; NULL: out of memory. */
struct bem_plane *rst_bem_plane_create(int64_t m);
void rst_bem_plane_destroy(struct bem_plane *plane);

/* Displacement of one direction under the traction of another, for unit spacing. */
void rst_bem_plane_convolve(struct bem_plane *plane, enum bem_plane_kind kind, int64_t ld, const double *x, double *u);

#endif
