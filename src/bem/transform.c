/* DC-FFT (Liu, Wang & Liu 2000) on a quarter of a doubly even field: zero padding removes the
 * images of the periodic convolution.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/transform.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

/* FFTW's planner is not thread-safe; solvers of several threads plan one after the other. Executing
 * needs no lock. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* Lines of a power of two of complex numbers would fall into the same few places of the cache. */
enum { line_gap = 4 };

static fftw_plan plan_lines(int64_t n, int64_t count, int64_t line, fftw_complex *from, fftw_complex *to, int sign)
{
    const int length = (int)n;
    /* ESTIMATE: the same plan, and so the same bits, each time */
    return fftw_plan_many_dft(1, &length, (int)count, from, NULL, 1, (int)line, to, NULL, 1, (int)line, sign,
                              FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
}

static int cosine_create(int64_t m, int64_t n, struct bem_cosine *c)
{
    c->m = m;
    c->n = n;
    c->line = n + line_gap;
    c->twiddles = fftw_alloc_complex((size_t)n);
    c->scratch = fftw_alloc_complex((size_t)n);
    c->rows = fftw_alloc_complex((size_t)(c->line * m / 2));
    c->columns = fftw_alloc_complex((size_t)(c->line * n / 2));
    c->rows_after = fftw_alloc_complex((size_t)(c->line * m / 2));
    c->columns_after = fftw_alloc_complex((size_t)(c->line * n / 2));
    if (!c->twiddles || !c->scratch || !c->rows || !c->columns || !c->rows_after || !c->columns_after) return 1;
    rst_bem_set_twiddles(n, c->twiddles);
    pthread_mutex_lock(&planner);
    c->row_forward = plan_lines(n, m / 2, c->line, c->rows, c->rows_after, FFTW_FORWARD);
    c->row_backward = plan_lines(n, m / 2, c->line, c->rows, c->rows_after, FFTW_BACKWARD);
    c->column_forward = plan_lines(n, n / 2, c->line, c->columns, c->columns_after, FFTW_FORWARD);
    c->column_backward = plan_lines(n, n / 2, c->line, c->columns_after, c->columns, FFTW_BACKWARD);
    pthread_mutex_unlock(&planner);
    return !c->row_forward || !c->row_backward || !c->column_forward || !c->column_backward;
}

static void cosine_release(struct bem_cosine *c)
{
    fftw_plan plans[] = {c->row_forward, c->row_backward, c->column_forward, c->column_backward};
    pthread_mutex_lock(&planner);
    for (int i = 0; i < 4; i++)
        if (plans[i]) fftw_destroy_plan(plans[i]);
    pthread_mutex_unlock(&planner);
    fftw_free(c->twiddles);
    fftw_free(c->scratch);
    fftw_free(c->rows);
    fftw_free(c->columns);
    fftw_free(c->rows_after);
    fftw_free(c->columns_after);
}

static void apply(const struct bem_cosine *c, const double *factor, int64_t ld, const double *x, double *u)
{
    rst_bem_lay_rows(ld, c->m, c->n, x, c->line, c->rows);
    fftw_execute(c->row_forward);
    rst_bem_turn(c->m, c->n, c->twiddles, c->line, c->rows_after, c->columns, c->scratch);
    fftw_execute(c->column_forward);
    rst_bem_filter(c->n, c->twiddles, factor, c->line, c->columns_after);
    fftw_execute(c->column_backward);
    rst_bem_turn_back(c->m, c->n, c->twiddles, c->line, c->columns, c->rows, c->scratch);
    fftw_execute(c->row_backward);
    rst_bem_take_rows(ld, c->m, c->n, c->line, c->rows_after, u);
}

/* The even transform (DCT-I) of the coefficients is the spectrum of the periodic kernel. */
static int transform_table(enum bem_kind kind, int64_t n, double *table)
{
    rst_bem_influence_table(kind, n, table);
    pthread_mutex_lock(&planner);
    fftw_plan plan = fftw_plan_r2r_2d((int)n + 1, (int)n + 1, table, table, FFTW_REDFT00, FFTW_REDFT00, FFTW_ESTIMATE);
    pthread_mutex_unlock(&planner);
    if (!plan) return 1;
    fftw_execute(plan);
    pthread_mutex_lock(&planner);
    fftw_destroy_plan(plan);
    pthread_mutex_unlock(&planner);
    return 0;
}

/* In the order that the filter takes: pairs of wave numbers along x. */
static double *make_factor(enum bem_kind kind, int64_t n, int invert)
{
    double *table = fftw_alloc_real((size_t)((n + 1) * (n + 1))), *factor = fftw_alloc_real((size_t)(n * n));
    if (!table || !factor || transform_table(kind, n, table)) {
        fftw_free(table);
        fftw_free(factor);
        return NULL;
    }
    const double scale = 1 / (double)(n * n);
    for (int64_t k = 0; k < n; k++)
        for (int64_t l = 0; l < n; l++) {
            const double value = table[l * (n + 1) + k];
            factor[(k / 2 * n + l) * 2 + k % 2] = scale * (invert ? 1 / value : value);
        }
    fftw_free(table);
    return factor;
}

struct bem_transform *rst_bem_transform_create(int64_t m)
{
    struct bem_transform *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->m = m;
    int failed = cosine_create(m, 2 * m, &t->padded) || cosine_create(m, m, &t->plain);
    for (int kind = BEM_NORMAL; kind <= BEM_SHEAR && !failed; kind++) {
        t->spectrum[kind] = make_factor(kind, 2 * m, 0);
        t->inverse[kind] = make_factor(kind, m, 1);
        failed = !t->spectrum[kind] || !t->inverse[kind];
    }
    if (!failed) return t;
    rst_bem_transform_destroy(t);
    return NULL;
}

void rst_bem_transform_destroy(struct bem_transform *t)
{
    if (!t) return;
    cosine_release(&t->padded);
    cosine_release(&t->plain);
    for (int kind = 0; kind < 2; kind++) {
        fftw_free(t->spectrum[kind]);
        fftw_free(t->inverse[kind]);
    }
    free(t);
}

void rst_bem_convolve(struct bem_transform *t, enum bem_kind kind, int64_t ld, const double *x, double *u)
{
    apply(&t->padded, t->spectrum[kind], ld, x, u);
}

void rst_bem_precondition(struct bem_transform *t, enum bem_kind kind, int64_t ld, const double *r, double *z)
{
    apply(&t->plain, t->inverse[kind], ld, r, z);
}
