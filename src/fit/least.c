/* Least squares by GSL: a trust region, and singular values.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "least.h"

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

struct bridge {
    const struct rst_least *least;
    int status;
};

/* Vectors and matrices of a workspace have no gaps. */
static int residuals(const gsl_vector *x, void *own, gsl_vector *f)
{
    struct bridge *b = own;
    b->status = b->least->residuals(b->least->own, x->data, f->data);
    return b->status < 0 ? GSL_EBADFUNC : GSL_SUCCESS;
}

static int jacobian(const gsl_vector *x, void *own, gsl_matrix *matrix)
{
    struct bridge *b = own;
    b->status = b->least->jacobian(b->least->own, x->data, matrix->data);
    return b->status < 0 ? GSL_EBADFUNC : GSL_SUCCESS;
}

static double square(const gsl_vector *f)
{
    double sum = 0;
    for (size_t i = 0; i < f->size; i++)
        sum += gsl_vector_get(f, i) * gsl_vector_get(f, i);
    return sum;
}

/* A step that finds nothing better is the end too: GSL calls it no progress. The sum decides, not the step: along a
 * valley whose floor is flat the constants would wander for ever. */
static int iterate(gsl_multifit_nlinear_workspace *w, struct bridge *b, double *x, double *sum, int *converged)
{
    gsl_multifit_nlinear_fdf fdf = {
        .f = residuals, .df = jacobian, .n = b->least->rows, .p = b->least->unknowns, .params = b};
    gsl_vector_const_view start = gsl_vector_const_view_array(x, b->least->unknowns);
    int status = gsl_multifit_nlinear_init(&start.vector, &fdf, w), still = 0;
    *sum = square(gsl_multifit_nlinear_residual(w));
    *converged = 0;
    for (int i = 0; i < b->least->most && !status && !*converged; i++) {
        status = gsl_multifit_nlinear_iterate(w);
        const double now = square(gsl_multifit_nlinear_residual(w));
        still = *sum - now <= b->least->settled * *sum ? still + 1 : 0;
        *sum = now;
        *converged = status == GSL_ENOPROG || still == 2 || now < b->least->exact;
    }
    if (b->status < 0 || status == GSL_ENOMEM) return b->status < 0 ? b->status : RESTITUTE_ERROR_MEMORY;
    for (size_t i = 0; i < b->least->unknowns; i++)
        x[i] = gsl_vector_get(gsl_multifit_nlinear_position(w), i);
    return RESTITUTE_OK;
}

int rst_fit_minimise(const struct rst_least *least, double *x, double *sum, int *converged)
{
    const size_t n = least->rows, p = least->unknowns;
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    parameters.scale = gsl_multifit_nlinear_scale_levenberg; /* unknowns are logarithms: of one scale */
    parameters.solver = least->full_rank ? gsl_multifit_nlinear_solver_cholesky
                                         : gsl_multifit_nlinear_solver_svd; /* takes a Jacobian without full rank */
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p);
    if (!w) return RESTITUTE_ERROR_MEMORY;
    struct bridge bridge = {least, 0};
    const int status = iterate(w, &bridge, x, sum, converged);
    gsl_multifit_nlinear_free(w);
    return status;
}

int rst_fit_singular(size_t rows, size_t unknowns, const double *j, double *values, double *v)
{
    /* GSL wants as many rows as columns: rows of zeros change nothing */
    const size_t n = rows > unknowns ? rows : unknowns, p = unknowns;
    double *memory = calloc(n * p + p * p + p, sizeof *memory);
    if (!memory) return RESTITUTE_ERROR_MEMORY;
    memcpy(memory, j, rows * p * sizeof *memory);
    gsl_matrix_view a = gsl_matrix_view_array(memory, n, p), right = gsl_matrix_view_array(memory + n * p, p, p);
    gsl_vector_view s = gsl_vector_view_array(values, p), work = gsl_vector_view_array(memory + n * p + p * p, p);
    const int failed = gsl_linalg_SV_decomp(&a.matrix, &right.matrix, &s.vector, &work.vector);
    for (size_t k = 0; !failed && k < p; k++)
        for (size_t i = 0; i < p; i++)
            v[k * p + i] = gsl_matrix_get(&right.matrix, i, k);
    free(memory);
    return failed ? RESTITUTE_ERROR_INTERNAL : RESTITUTE_OK;
}
