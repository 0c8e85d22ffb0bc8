/* A panel of psi in one column: equal cells, as many as its cubics need (builder.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

/* Points of the polynomials that fill midpoints. */
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

double rst_psi_at(const struct rst_builder *b, int panel, double x, double ez)
{
    return panel ? 1 + rst_panel_y(x) * rst_share(b->contact.numbers.chi) * (1 + ez) : x;
}

int rst_panel_solve(const struct rst_panel *p, double x, double *g)
{
    struct rst_column *c = &p->task->column;
    const double psi = rst_psi_at(p->b, p->panel, x, c->normal.ez);
    double ex, error;
    const int status = rst_column_solve(p->solver, psi, &ex, &error, &p->task->why);
    if (status < 0) return status;
    c->impacts++;
    c->solver = fmax(c->solver, error);
    *g = p->panel ? psi * ex - rst_panel_y(x) * c->normal.ez : ex;
    return RESTITUTE_OK;
}

/* In the middle of cell i the polynomial through the eight values around it, by Neville's
 * scheme. */
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

/* The cubic in the middle of cell i. */
static double cubic_of(const double *f, int64_t cells, int64_t i)
{
    const double rise = rst_even_slope(f, cells, i) - rst_even_slope(f, cells, i + 1);
    return 0.5 * (f[i] + f[i + 1]) + 0.125 * rise;
}

/* Cells whose midpoint may be solved. The mark is infinite beside a cell with too large an error,
 * and -1 for a solved one. */
struct middle {
    double value, mark;
    double miss; /* error of cubic or polynomial, if it is too large; else 0 */
};

/* A fold was found in cell i of n: its halves are doubtful as well. */
static int has_fold(const struct middle *m, int64_t n, int64_t i)
{
    return m[i].miss > 0 && (i == 0 || m[i].miss >= m[i - 1].miss) && (i == n - 1 || m[i].miss >= m[i + 1].miss);
}

/* The most doubtful cell. */
static int64_t most_doubtful(const struct middle *m, int64_t n)
{
    int64_t most = 0;
    for (int64_t i = 1; i < n; i++)
        if (m[i].mark > m[most].mark) most = i;
    return most;
}

/* How much cubic and polynomial differ in cell i. */
static double differ(const double *f, int64_t n, int64_t i)
{
    return fabs(middle_of(f, n, i) - cubic_of(f, n, i));
}

/* The same in cell i and beside it: with a kink at its midpoint both agree there, but not beside
 * it. At the ends of a panel slopes and polynomials are one-sided, and show less of their error. */
static double doubt(const double *f, int64_t n, int64_t i)
{
    const double one_sided = 10;
    if (i == 0 || i == n - 1) return one_sided * differ(f, n, i);
    return differ(f, n, i) + (i > 1 ? differ(f, n, i - 1) : 0) + (i < n - 2 ? differ(f, n, i + 1) : 0);
}

/* g over e_x in the middle of cell i of n. */
static double weight(const struct rst_panel *p, int64_t i, int64_t n)
{
    return p->panel ? rst_psi_at(p->b, 1, ((double)i + 0.5) / (double)n, p->task->column.normal.ez) : 1;
}

/* Values and marks before any midpoint is solved. `before`: the cells that were halved, or NULL. */
static void prepare(const double *f, int64_t n, const struct middle *before, const struct rst_panel *p, struct middle *m)
{
    for (int64_t i = 0; i < n; i++) {
        const int fold = before && has_fold(before, n / 2, i / 2);
        m[i] = (struct middle){middle_of(f, n, i), fold ? INFINITY : doubt(f, n, i) / weight(p, i, n), 0};
    }
}

/* Solve a limited number of midpoints until the cubics agree with the most doubtful ones. At a
 * kink, the error of cubic and polynomial is much larger than their difference. So the difference
 * alone is not enough. */
static int probe(const double *f, int64_t n, struct middle *m, int64_t most, struct rst_panel *p, int *met)
{
    const double beside_good = 0.1; /* other folds come first */
    const double enough = rst_part_of_axis * p->b->options.tolerance;
    int good = 0, status = RESTITUTE_OK;
    p->missed = 0;
    *met = 1;
    for (int64_t tries = 0; tries < most && !status; tries++) {
        const int64_t i = most_doubtful(m, n);
        if (good >= rst_probes && !isinf(m[i].mark)) break;
        const double polynomial = m[i].value, cubic = cubic_of(f, n, i), psi = weight(p, i, n);
        status = rst_panel_solve(p, ((double)i + 0.5) / (double)n, &m[i].value);
        const double by_cubic = fabs(m[i].value - cubic) / psi, by_polynomial = fabs(m[i].value - polynomial) / psi;
        const double miss = fmax(by_cubic, by_polynomial);
        p->missed = fmax(p->missed, by_cubic);
        m[i].mark = -1;
        good = miss <= enough ? good + 1 : 0;
        if (!good) m[i].miss = miss, *met = 0;
        for (int64_t k = i > 0 ? i - 1 : 0; k < n && k <= i + 1; k++)
            if (m[k].mark >= 0) m[k].mark = good ? beside_good * m[k].mark : INFINITY;
    }
    return status;
}

/* Halve all cells. */
static int join(double **g, int64_t *cells, const struct middle *m)
{
    const int64_t n = *cells;
    double *finer = malloc((size_t)(2 * n + 1) * sizeof *finer);
    if (!finer) return RESTITUTE_ERROR_MEMORY;
    for (int64_t i = 0; i < n; i++) {
        finer[2 * i] = (*g)[i];
        finer[2 * i + 1] = m ? m[i].value : middle_of(*g, n, i);
    }
    finer[2 * n] = (*g)[n];
    free(*g);
    *g = finer;
    *cells = 2 * n;
    return RESTITUTE_OK;
}

int rst_panel_fill(double **g, int64_t *cells)
{
    return join(g, cells, NULL);
}

int rst_panel_refine(struct rst_panel *p)
{
    int64_t *cells = &p->task->column.cells[p->panel];
    double **g = &p->task->column.g[p->panel];
    const int64_t most = rst_finest * *cells;
    struct middle *before = NULL;
    int done = 0, met, status = RESTITUTE_OK;
    while (!done && !status) {
        const int last = 2 * *cells > most;
        struct middle *m = malloc((size_t)*cells * sizeof *m);
        if (m) prepare(*g, *cells, before, p, m);
        free(before);
        before = m;
        if (!m) return RESTITUTE_ERROR_MEMORY;
        status = probe(*g, *cells, m, last ? rst_last_probes : *cells, p, &met);
        done = met || last;
        if (!done && !status) status = join(g, cells, m);
    }
    free(before);
    return status;
}
