/* Sine and cosine transforms. With X the cosine coefficients (DCT-II) of an even field, S the sine
 * coefficients (DST-II) of an odd one and k, l wave numbers: an even kernel multiplies either by
 * its own spectrum, and the kernel x y/r^3, odd in both, takes each into the other: S = kappa X, X
 * = kappa S, kappa its sine transform (DST-I).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/plane.h"

#include <stdlib.h>
#include <string.h>

#include "bem/kernels.h"
#include "bem/planner.h"

struct bem_plane {
    int64_t m, n;
    double *room, *along, *across; /* n x n; spectra over wave numbers 1 to n, for S */
    fftw_plan even_forward, even_backward, odd_forward, odd_backward;
};

static fftw_plan plan(int n, double *data, fftw_r2r_kind kind)
{
    return fftw_plan_r2r_2d(n, n, data, data, kind, kind, FFTW_ESTIMATE);
}

/* Spectrum of the kernel along y under y: that along x under x with x and y exchanged. */
static int make_along(struct bem_plane *p, double *table)
{
    const int64_t n = p->n;
    rst_bem_lock_planner();
    const fftw_plan transform = plan((int)n + 1, table, FFTW_REDFT00);
    rst_bem_unlock_planner();
    if (!transform) return 1;
    rst_bem_influence_table(BEM_SHEAR, n, table);
    fftw_execute(transform);
    rst_bem_lock_planner();
    fftw_destroy_plan(transform);
    rst_bem_unlock_planner();
    for (int64_t l = 0; l < n; l++)
        for (int64_t k = 0; k < n; k++)
            p->along[l * n + k] = table[(k + 1) * (n + 1) + l + 1] / (double)(4 * n * n);
    return 0;
}

static int make_across(struct bem_plane *p, double *table)
{
    const int64_t n = p->n;
    rst_bem_lock_planner();
    const fftw_plan transform = plan((int)n - 1, p->room, FFTW_RODFT00);
    rst_bem_unlock_planner();
    if (!transform) return 1;
    rst_bem_influence_table(BEM_CROSS, n, table);
    for (int64_t j = 1; j < n; j++)
        memcpy(p->room + (j - 1) * (n - 1), table + j * (n + 1) + 1, (size_t)(n - 1) * sizeof *table);
    fftw_execute(transform);
    rst_bem_lock_planner();
    fftw_destroy_plan(transform);
    rst_bem_unlock_planner();
    for (int64_t l = 0; l < n; l++)
        for (int64_t k = 0; k < n; k++) /* nothing at the wave number n */
            p->across[l * n + k] = l < n - 1 && k < n - 1 ? p->room[l * (n - 1) + k] / (double)(4 * n * n) : 0;
    return 0;
}

struct bem_plane *rst_bem_plane_create(int64_t m)
{
    struct bem_plane *p = calloc(1, sizeof *p);
    const int64_t n = 2 * m;
    double *table = fftw_alloc_real((size_t)((n + 1) * (n + 1)));
    if (!p || !table) {
        free(p);
        fftw_free(table);
        return NULL;
    }
    p->m = m, p->n = n;
    p->room = fftw_alloc_real((size_t)(n * n));
    p->along = fftw_alloc_real((size_t)(n * n));
    p->across = fftw_alloc_real((size_t)(n * n));
    int failed = !p->room || !p->along || !p->across;
    if (!failed) {
        rst_bem_lock_planner();
        p->even_forward = plan((int)n, p->room, FFTW_REDFT10);
        p->even_backward = plan((int)n, p->room, FFTW_REDFT01);
        p->odd_forward = plan((int)n, p->room, FFTW_RODFT10);
        p->odd_backward = plan((int)n, p->room, FFTW_RODFT01);
        rst_bem_unlock_planner();
        failed = !p->even_forward || !p->even_backward || !p->odd_forward || !p->odd_backward || make_along(p, table) ||
                 make_across(p, table);
    }
    fftw_free(table);
    if (!failed) return p;
    rst_bem_plane_destroy(p);
    return NULL;
}

void rst_bem_plane_destroy(struct bem_plane *p)
{
    if (!p) return;
    fftw_plan plans[] = {p->even_forward, p->even_backward, p->odd_forward, p->odd_backward};
    rst_bem_lock_planner();
    for (int i = 0; i < 4; i++)
        if (plans[i]) fftw_destroy_plan(plans[i]);
    rst_bem_unlock_planner();
    fftw_free(p->room);
    fftw_free(p->along);
    fftw_free(p->across);
    free(p);
}

/* Coefficients X of wave numbers 0 to n - 1 become S of 1 to n, or the other way. */
static void exchange(struct bem_plane *p, int to_odd)
{
    const int64_t n = p->n;
    double *a = p->room;
    if (to_odd) {
        for (int64_t l = 0; l < n; l++)
            for (int64_t k = 0; k < n; k++)
                a[l * n + k] = l < n - 1 && k < n - 1 ? p->across[l * n + k] * a[(l + 1) * n + k + 1] : 0;
        return;
    }
    for (int64_t l = n - 1; l >= 0; l--)
        for (int64_t k = n - 1; k >= 0; k--)
            a[l * n + k] = l > 0 && k > 0 ? p->across[(l - 1) * n + k - 1] * a[(l - 1) * n + k - 1] : 0;
}

void rst_bem_plane_convolve(struct bem_plane *p, enum bem_plane_kind kind, int64_t ld, const double *x, double *u)
{
    const int64_t n = p->n, m = p->m;
    memset(p->room, 0, (size_t)(n * n) * sizeof *p->room);
    for (int64_t j = 0; j < m; j++)
        memcpy(p->room + j * n, x + j * ld, (size_t)m * sizeof *x);
    fftw_execute(kind == BEM_Y_FROM_X ? p->even_forward : p->odd_forward);
    if (kind == BEM_Y_FROM_Y)
        for (int64_t i = 0; i < n * n; i++)
            p->room[i] *= p->along[i];
    else
        exchange(p, kind == BEM_Y_FROM_X);
    fftw_execute(kind == BEM_X_FROM_Y ? p->even_backward : p->odd_backward);
    for (int64_t j = 0; j < m; j++)
        memcpy(u + j * ld, p->room + j * n, (size_t)m * sizeof *u);
}
