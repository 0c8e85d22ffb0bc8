/* A panel of psi in one column: even cells, as many as its cubics need (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

#include <stdlib.h>

/* Points of the polynomials that cubics are compared with, and that fill in. */
enum { points = 8 };

void rst_find_stencil(const double *at, int64_t n, int64_t i, struct rst_stencil *s)
{
    const int64_t half = rst_most_points / 2;
    s->n = n < rst_most_points ? (int)n : rst_most_points;
    s->first = i < half ? 0 : i - half;
    if (s->first + s->n > n) s->first = n - s->n;
    const double *x = at + s->first;
    const int here = (int)(i - s->first);
    for (int j = 0; j < s->n; j++) {
        double w = j == here ? 0 : 1 / (x[j] - x[here]);
        for (int k = 0; k < s->n; k++) {
            if (k == here || k == j) continue;
            w = j == here ? w : w * (x[here] - x[k]) / (x[j] - x[k]);
        }
        for (int k = 0; j == here && k < s->n; k++)
            if (k != here) w += 1 / (x[here] - x[k]);
        s->w[j] = w;
    }
}

double rst_even_slope(const double *f, int64_t cells, int64_t i)
{
    static const double place[rst_most_points] = {0, 1, 2, 3, 4, 5, 6};
    const int64_t n = cells + 1 < rst_most_points ? cells + 1 : rst_most_points, half = n / 2;
    const int64_t first = i < half ? 0 : i - half > cells + 1 - n ? cells + 1 - n : i - half;
    struct rst_stencil s;
    double sum = 0;
    rst_find_stencil(place, n, i - first, &s);
    for (int j = 0; j < s.n; j++)
        sum += s.w[j] * f[first + j];
    return sum;
}

/* In the middle of cell i the polynomial through the eight values around it, by Neville's scheme. */
static double middle_of(const double *f, int64_t cells, int64_t i)
{
    const int n = cells + 1 < points ? (int)cells + 1 : points;
    const int64_t first = i < n / 2 - 1 ? 0 : i > cells - n / 2 ? cells + 1 - n : i - (n / 2 - 1);
    const double x = (double)(i - first) + 0.5;
    double p[points];
    memcpy(p, f + first, (size_t)n * sizeof *p);
    for (int k = 1; k < n; k++)
        for (int j = 0; j + k < n; j++)
            p[j] = ((x - j) * p[j + 1] - (x - j - k) * p[j]) / k;
    return p[0];
}

/* By how much the cubic of cell i misses that polynomial. It is nearer to e_x by far, but for kinks, of which both miss
 * alike. */
static double miss_of(const double *f, int64_t cells, int64_t i)
{
    const double rise = rst_even_slope(f, cells, i) - rst_even_slope(f, cells, i + 1);
    return fabs(0.5 * (f[i] + f[i + 1]) + 0.125 * rise - middle_of(f, cells, i));
}

int rst_panel_double(double **g, int64_t *cells, double enough, rst_panel_solve *solve, void *of)
{
    const int64_t n = *cells;
    const double *f = *g;
    int status = RESTITUTE_OK;
    double *finer = malloc((size_t)(2 * n + 1) * sizeof *finer), *miss = calloc((size_t)n + 2, sizeof *miss);
    if (!finer || !miss) status = RESTITUTE_ERROR_MEMORY;
    for (int64_t i = 0; i < n && solve && !status; i++)
        miss[i + 1] = miss_of(f, n, i);
    for (int64_t i = 0; i < n && !status; i++) {
        finer[2 * i] = f[i];
        finer[2 * i + 1] = middle_of(f, n, i);
        if (fmax(fmax(miss[i], miss[i + 1]), miss[i + 2]) > enough)
            status = solve(of, ((double)i + 0.5) / (double)n, &finer[2 * i + 1]);
    }
    free(miss);
    if (status) {
        free(finer);
        return status;
    }
    finer[2 * n] = f[n];
    free(*g);
    *g = finer;
    *cells = 2 * n;
    return RESTITUTE_OK;
}

double rst_panel_error(const double *f, int64_t cells)
{
    double worst = 0;
    for (int64_t i = 0; i < cells; i++)
        worst = fmax(worst, miss_of(f, cells, i));
    return worst;
}
