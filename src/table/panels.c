/* The points of an axis: Chebyshev points in each of its panels. Panels of speed and gamma are halved where checks
 * fail, since ex has lines across which its second derivative jumps (docs/table.md); the other axes have one panel.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"
#include "interpolation.h"

void rst_panels_one(int64_t n, struct rst_panels *p)
{
    *p = (struct rst_panels){.count = 1, .edge = {0, 1}, .n = {n}};
}

int64_t rst_panels_points(const struct rst_panels *p)
{
    int64_t total = 1;
    for (int i = 0; i < p->count; i++)
        total += p->n[i] - 1;
    return total;
}

/* The same place has the same bits whatever the other panels are. */
static double place_in(const struct rst_panels *p, int panel, double x)
{
    if (x <= 0) return p->edge[panel];
    if (x >= 1) return p->edge[panel + 1];
    return p->edge[panel] + (p->edge[panel + 1] - p->edge[panel]) * x;
}

void rst_panels_nodes(const struct rst_panels *p, double *x)
{
    double own[rst_most_points];
    int64_t at = 0;
    for (int i = 0; i < p->count; i++) {
        rst_table_nodes(p->n[i], own);
        for (int64_t j = 0; j < p->n[i]; j++)
            x[at + j] = place_in(p, i, own[j]);
        at += p->n[i] - 1;
    }
}

/* Half way between the points, which is where a polynomial through them is worst. Returns how many; 1 without an axis.
 * */
int64_t rst_panels_half_ways(const struct rst_panels *p, double *x)
{
    double fine[2 * rst_most_points];
    int64_t count = 0;
    for (int i = 0; i < p->count; i++) {
        rst_table_nodes(2 * p->n[i] - 1, fine);
        for (int64_t j = 0; j + 1 < p->n[i]; j++)
            x[count++] = place_in(p, i, fine[2 * j + 1]);
    }
    if (count == 0) x[count++] = 0.5;
    return count;
}

int rst_panels_find(const struct rst_panels *p, double x)
{
    int panel = 0;
    while (panel + 1 < p->count && x > p->edge[panel + 1])
        panel++;
    return panel;
}

/* Rows that take the values at all points to those at `place`; zero outside the panel of the place. */
void rst_panels_rows(const struct rst_panels *p, int64_t m, const double *place, double *row)
{
    const int64_t n = rst_panels_points(p);
    for (int64_t i = 0; i < m; i++) {
        const int panel = rst_panels_find(p, place[i]);
        int64_t first = 0;
        for (int k = 0; k < panel; k++)
            first += p->n[k] - 1;
        const double low = p->edge[panel], width = p->edge[panel + 1] - low;
        const double own = fmin(1, fmax(0, (place[i] - low) / width));
        for (int64_t j = 0; j < n; j++)
            row[i * n + j] = 0;
        rst_table_weights(p->n[panel], own, row + i * n + first);
    }
}

/* Rows that give the last two coefficients in a panel. */
void rst_panels_last(const struct rst_panels *p, int panel, double *row)
{
    const int64_t n = rst_panels_points(p), own = p->n[panel];
    int64_t first = 0;
    double all[rst_most_points * 2];
    for (int k = 0; k < panel; k++)
        first += p->n[k] - 1;
    for (int64_t j = 0; j < 2 * n; j++)
        row[j] = 0;
    rst_table_last(own, all);
    for (int64_t j = 0; j < own; j++) {
        row[first + j] = all[j];
        row[n + first + j] = all[own + j];
    }
}

/* Nonzero if there is no more room. */
int rst_panels_halve(struct rst_panels *p, int panel)
{
    const int64_t n = p->n[panel], half = n > 9 ? (2 * n + 2) / 3 : n;
    if (p->count == rst_most_panels || rst_panels_points(p) + 2 * half - n > rst_most_points) return 1;
    for (int i = p->count; i > panel; i--) {
        p->edge[i + 1] = p->edge[i];
        p->n[i] = p->n[i - 1];
    }
    p->edge[panel + 1] = 0.5 * (p->edge[panel] + p->edge[panel + 2]);
    p->n[panel] = p->n[panel + 1] = half < 9 ? 9 : half;
    p->count++;
    return 0;
}
