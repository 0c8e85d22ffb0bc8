/* Least squares by GSL: a trust region for nonlinear problems, an active set for nonnegative linear ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "least.h"

#include <float.h>
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
    double *x, *r, *j;
    int status;
};

static void take_x(struct bridge *b, const gsl_vector *x)
{
    for (size_t i = 0; i < b->least->unknowns; i++)
        b->x[i] = gsl_vector_get(x, i);
}

static int residuals(const gsl_vector *x, void *own, gsl_vector *f)
{
    struct bridge *b = own;
    take_x(b, x);
    b->status = b->least->residuals(b->least->own, b->x, b->r);
    for (size_t i = 0; i < b->least->rows; i++)
        gsl_vector_set(f, i, b->r[i]);
    return b->status < 0 ? GSL_EBADFUNC : GSL_SUCCESS;
}

static int jacobian(const gsl_vector *x, void *own, gsl_matrix *matrix)
{
    struct bridge *b = own;
    take_x(b, x);
    b->status = b->least->jacobian(b->least->own, b->x, b->j);
    for (size_t i = 0; i < b->least->rows; i++)
        for (size_t k = 0; k < b->least->unknowns; k++)
            gsl_matrix_set(matrix, i, k, b->j[i * b->least->unknowns + k]);
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
    double *memory = calloc(p + n + n * p, sizeof *memory);
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    parameters.scale = gsl_multifit_nlinear_scale_levenberg; /* unknowns are logarithms: of one scale */
    parameters.solver = least->full_rank ? gsl_multifit_nlinear_solver_cholesky
                                         : gsl_multifit_nlinear_solver_svd; /* takes a Jacobian without full rank */
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p);
    int status = RESTITUTE_ERROR_MEMORY;
    if (memory && w) {
        struct bridge bridge = {least, memory, memory + p, memory + p + n, 0};
        status = iterate(w, &bridge, x, sum, converged);
    }
    if (w) gsl_multifit_nlinear_free(w);
    free(memory);
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

struct active {
    size_t rows, unknowns, count, *set;
    const double *a, *b;
    double *q, *tau, *z, *r; /* QR of the passive columns, its solution, residual of x */
    char *passive;
};

/* Least squares in the columns of the set. */
static int solve_set(struct active *s)
{
    gsl_matrix_view q = gsl_matrix_view_array(s->q, s->rows, s->count);
    gsl_vector_view tau = gsl_vector_view_array(s->tau, s->count), z = gsl_vector_view_array(s->z, s->count);
    gsl_vector_view r = gsl_vector_view_array(s->r, s->rows);
    gsl_vector_const_view b = gsl_vector_const_view_array(s->b, s->rows);
    for (size_t i = 0; i < s->rows; i++)
        for (size_t k = 0; k < s->count; k++)
            s->q[i * s->count + k] = s->a[i * s->unknowns + s->set[k]];
    if (gsl_linalg_QR_decomp(&q.matrix, &tau.vector)) return RESTITUTE_ERROR_INTERNAL;
    return gsl_linalg_QR_lssolve(&q.matrix, &tau.vector, &b.vector, &z.vector, &r.vector) ? RESTITUTE_ERROR_INTERNAL
                                                                                          : RESTITUTE_OK;
}

static void list_set(struct active *s)
{
    s->count = 0;
    for (size_t j = 0; j < s->unknowns; j++)
        if (s->passive[j]) s->set[s->count++] = j;
}

/* The column that would reduce the residual most; unknowns if none does. */
static size_t best_column(struct active *s, const double *x)
{
    size_t best = s->unknowns;
    double steepest = 1e-10;
    for (size_t i = 0; i < s->rows; i++) {
        s->r[i] = s->b[i];
        for (size_t j = 0; j < s->unknowns; j++)
            if (x[j] > 0) s->r[i] -= s->a[i * s->unknowns + j] * x[j];
    }
    for (size_t j = 0; j < s->unknowns; j++) {
        double slope = 0, square = DBL_MIN;
        for (size_t i = 0; i < s->rows; i++) {
            const double a = s->a[i * s->unknowns + j];
            slope += a * s->r[i], square += a * a;
        }
        if (!s->passive[j] && slope / sqrt(square) > steepest) steepest = slope / sqrt(square), best = j;
    }
    return best;
}

/* Move x towards the solution z of the set, until one of it meets 0 and leaves. Returns whether all of z was taken. */
static int move(struct active *s, double *x)
{
    double step = 1;
    for (size_t k = 0; k < s->count; k++)
        if (s->z[k] <= 0) step = fmin(step, x[s->set[k]] / (x[s->set[k]] - s->z[k]));
    for (size_t k = 0; k < s->count; k++) {
        double *value = &x[s->set[k]];
        *value += step * (s->z[k] - *value);
        if (s->z[k] <= 0 && *value <= 1e-12 * fabs(s->z[k])) *value = 0, s->passive[s->set[k]] = 0;
    }
    return step == 1;
}

static int run_active(struct active *s, double *x)
{
    memset(x, 0, s->unknowns * sizeof *x);
    for (size_t turn = 0; turn < 3 * s->unknowns; turn++) {
        const size_t next = best_column(s, x);
        if (next == s->unknowns || s->count >= s->rows) break;
        s->passive[next] = 1;
        for (int whole = 0; !whole;) {
            list_set(s);
            const int status = s->count ? solve_set(s) : RESTITUTE_OK;
            if (status) return status;
            whole = s->count ? move(s, x) : 1;
        }
        if (!(x[next] > 0)) break; /* rounding: no column helps any more */
    }
    return RESTITUTE_OK;
}

int rst_fit_nonnegative(size_t rows, size_t unknowns, const double *a, const double *b, double *x)
{
    const size_t most = rows < unknowns ? rows : unknowns;
    double *memory = calloc(rows * unknowns + unknowns + unknowns + rows, sizeof *memory);
    size_t *set = calloc(unknowns, sizeof *set);
    char *passive = calloc(unknowns, 1);
    int status = RESTITUTE_ERROR_MEMORY;
    if (memory && set && passive && most) {
        double *q = memory, *tau = q + rows * unknowns, *z = tau + unknowns;
        struct active s = {rows, unknowns, 0, set, a, b, q, tau, z, z + unknowns, passive};
        status = run_active(&s, x);
    }
    free(memory);
    free(set);
    free(passive);
    return status;
}
