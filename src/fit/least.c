/* Least squares by GSL: a trust region, and singular values.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit/least.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/status.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int inside;
static gsl_error_handler_t *callers;

void rst_fit_gsl_begin(void)
{
    pthread_mutex_lock(&lock);
    if (inside++ == 0) callers = gsl_set_error_handler_off();
    pthread_mutex_unlock(&lock);
}

void rst_fit_gsl_end(void)
{
    pthread_mutex_lock(&lock);
    if (--inside == 0) gsl_set_error_handler(callers);
    pthread_mutex_unlock(&lock);
}

/* A round ends after this many trial steps in a row without improvement. The trust region is then
 * 1/32 of its size before. */
enum { REJECTED = 5 };

struct bridge {
    const struct rst_least *least;
    double *origin;        /* unknowns are counted from the start: the first trust region is 0.3 then */
    double *x, *f;         /* latest point, its residuals */
    double *at, *f_at, *j; /* likewise of the latest Jacobian */
    double start;          /* sum of squares at the beginning of a round */
    int known, rejected, status;
};

/* Vectors and matrices of a workspace have no gaps. */
static int residuals(const gsl_vector *x, void *own, gsl_vector *f)
{
    struct bridge *b = own;
    if (b->least->rounds && b->rejected++ == REJECTED) return GSL_EBADFUNC;
    for (size_t k = 0; k < x->size; k++)
        b->x[k] = b->origin[k] + x->data[k];
    b->status = b->least->residuals(b->least->own, b->x, f->data);
    memcpy(b->f, f->data, f->size * sizeof *b->f);
    return b->status < 0 ? GSL_EBADFUNC : GSL_SUCCESS;
}

/* Broyden's update: the smallest change of the Jacobian that is consistent with the latest step. */
static void update(struct bridge *b)
{
    const size_t p = b->least->unknowns;
    double square = 0;
    for (size_t k = 0; k < p; k++)
        b->at[k] = b->x[k] - b->at[k], square += b->at[k] * b->at[k];
    for (size_t i = 0; i < b->least->rows && square > 0; i++) {
        double missed = b->f[i] - b->f_at[i];
        for (size_t k = 0; k < p; k++)
            missed -= b->j[i * p + k] * b->at[k];
        for (size_t k = 0; k < p; k++)
            b->j[i * p + k] += missed / square * b->at[k];
    }
}

/* GSL asks for it at the latest point alone. */
static int jacobian(const gsl_vector *x, void *own, gsl_matrix *matrix)
{
    struct bridge *b = own;
    const size_t n = b->least->rows, p = x->size;
    b->rejected = 0;
    if (b->known && b->least->rounds)
        update(b);
    else
        b->status = b->least->jacobian(b->least->own, b->x, b->f, b->j);
    b->known = 1;
    memcpy(b->at, b->x, p * sizeof *b->x);
    memcpy(b->f_at, b->f, n * sizeof *b->f);
    memcpy(matrix->data, b->j, n * p * sizeof *b->j);
    return b->status < 0 ? GSL_EBADFUNC : GSL_SUCCESS;
}

static double square(const gsl_vector *f)
{
    double sum = 0;
    for (size_t i = 0; i < f->size; i++)
        sum += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    return sum;
}

/* A round from x, with a new Jacobian. It ends at a step without improvement (GSL: no progress).
 * The criterion is the sum of squares and not the step, since along a flat valley the constants
 * would never stop. */
static int iterate(gsl_multifit_nlinear_workspace *w, struct bridge *b, double *x, double *sum, int *converged)
{
    const struct rst_least *least = b->least;
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .df = jacobian, .n = least->rows, .p = least->unknowns, .params = b};
    memcpy(b->origin, x, least->unknowns * sizeof *x);
    memset(x, 0, least->unknowns * sizeof *x);
    b->known = b->rejected = 0;
    gsl_vector_const_view start = gsl_vector_const_view_array(x, least->unknowns);
    int status = gsl_multifit_nlinear_init(&start.vector, &fdf, w), still = 0;
    *sum = b->start = square(gsl_multifit_nlinear_residual(w));
    *converged = 0;
    for (int i = 0; i < least->most && !status && !*converged; i++) {
        status = gsl_multifit_nlinear_iterate(w);
        const double now = square(gsl_multifit_nlinear_residual(w));
        still = *sum - now <= least->settled * *sum ? still + 1 : 0;
        *sum = now;
        *converged = status == GSL_ENOPROG || status == GSL_EBADFUNC || still == 2 || now < least->exact;
    }
    for (size_t i = 0; i < least->unknowns; i++)
        x[i] = b->origin[i] + gsl_vector_get(gsl_multifit_nlinear_position(w), i);
    return b->status < 0 ? b->status : status == GSL_ENOMEM ? RESTITUTE_ERROR_MEMORY : RESTITUTE_OK;
}

int rst_fit_minimise(const struct rst_least *least, double *x, double *sum, int *converged)
{
    const size_t n = least->rows, p = least->unknowns;
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    parameters.scale = gsl_multifit_nlinear_scale_levenberg; /* unknowns are logarithms: of one scale */
    /* QR accepts a Jacobian without full rank. GSL's SVD does, too, but it crashes if memory runs
     * out within a step. */
    parameters.solver = least->full_rank ? gsl_multifit_nlinear_solver_cholesky : gsl_multifit_nlinear_solver_qr;
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p);
    double *memory = malloc((n * p + 2 * n + 3 * p) * sizeof *memory);
    struct bridge b = {.least = least, .j = memory};
    int status = w && memory ? RESTITUTE_OK : RESTITUTE_ERROR_MEMORY, round = 0;
    if (memory) b.f = b.j + n * p, b.f_at = b.f + n, b.x = b.f_at + n, b.at = b.x + p, b.origin = b.at + p;
    while (status >= 0) {
        status = iterate(w, &b, x, sum, converged);
        const int settled = *sum < least->exact || b.start - *sum <= least->settled * *sum;
        if (!settled && ++round < least->rounds) continue;
        if (least->rounds > 1) *converged = settled;
        break;
    }
    if (w) gsl_multifit_nlinear_free(w);
    free(memory);
    return status;
}

int rst_fit_singular(size_t rows, size_t unknowns, const double *j, double *values, double *v)
{
    /* GSL needs at least as many rows as columns: rows of zeros change nothing */
    const size_t n = rows > unknowns ? rows : unknowns, p = unknowns;
    double *memory = calloc(n * p + p * p, sizeof *memory);
    if (!memory) return RESTITUTE_ERROR_MEMORY;
    memcpy(memory, j, rows * p * sizeof *memory);
    gsl_matrix_view a = gsl_matrix_view_array(memory, n, p), right = gsl_matrix_view_array(memory + n * p, p, p);
    gsl_vector_view s = gsl_vector_view_array(values, p);
    const int failed = /* takes no memory */
        gsl_linalg_SV_decomp_jacobi(&a.matrix, &right.matrix, &s.vector);
    for (size_t k = 0; !failed && k < p; k++)
        for (size_t i = 0; i < p; i++)
            v[k * p + i] = gsl_matrix_get(&right.matrix, i, k);
    free(memory);
    return failed ? RESTITUTE_ERROR_INTERNAL : RESTITUTE_OK;
}
