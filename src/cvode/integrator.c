/* CVODE of SUNDIALS 6.4 and 7: context, vectors, a Newton solver with our own linear solver or
 * fixed-point iteration, and messages that are kept and never printed.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#if !defined(SUNDIALS_DOUBLE_PRECISION)
#error "SUNDIALS must be built for double precision"
#endif

enum { TEXT_SIZE = 200 };

/* Vectors of an integrator. CVODE 6.4 takes 25. A version that took more would fail in every
 * call. */
enum { VECTORS = 64 };

struct integrator {
    struct _generic_N_Vector_Ops operations; /* of all vectors; first, so that a vector leads here */
    struct _generic_N_Vector vector[VECTORS];
    struct _N_VectorContent_Serial content[VECTORS];
    double *values;
    int vectors; /* in use */
    struct integrator_system system;
    SUNContext context;
    void *cvode;
    N_Vector y;
    SUNLinearSolver linear;
    SUNNonlinearSolver nonlinear;
    int *direction, *events;
    struct integrator_counts before; /* work up to the last restart */
    char text[TEXT_SIZE];
};

static void keep_text(struct integrator *g, const char *where, const char *message)
{
    snprintf(g->text, sizeof g->text, "%s: %s", where ? where : "CVODE", message ? message : "no message");
}

#if SUNDIALS_VERSION_MAJOR >= 7
static void on_error(int line, const char *function, const char *file, const char *message, SUNErrCode code, void *data,
                     SUNContext context)
{
    (void)line, (void)file, (void)code, (void)context;
    keep_text(data, function, message);
}

static int make_context(struct integrator *g)
{
    if (SUNContext_Create(SUN_COMM_NULL, &g->context)) return 1;
    SUNContext_ClearErrHandlers(g->context); /* the default one prints */
    return SUNContext_PushErrHandler(g->context, on_error, g);
}

static int listen(struct integrator *g)
{
    (void)g;
    return 0;
}
#else
static void on_error(int code, const char *module, const char *function, char *message, void *data)
{
    (void)code, (void)module;
    keep_text(data, function, message);
}

static int make_context(struct integrator *g)
{
    return SUNContext_Create(NULL, &g->context);
}

static int listen(struct integrator *g)
{
    return CVodeSetErrHandlerFn(g->cvode, on_error, g);
}
#endif

static int call_rates(double t, N_Vector y, N_Vector rate, void *data)
{
    const struct integrator *g = data;
    return g->system.rates(g->system.owner, t, NV_DATA_S(y), NV_DATA_S(rate)) ? 1 : 0; /* 1: try a shorter step */
}

static int call_roots(double t, N_Vector y, double *value, void *data)
{
    const struct integrator *g = data;
    g->system.roots(g->system.owner, t, NV_DATA_S(y), value);
    return 0;
}

static int call_weights(N_Vector y, N_Vector weight, void *data)
{
    const struct integrator *g = data;
    g->system.weights(g->system.owner, NV_DATA_S(y), NV_DATA_S(weight));
    return 0;
}

/* If memory runs out, N_VClone writes to the missing vector, and CVodeInit and CVodeFree both
 * destroy the existing ones. So all vectors are allocated at once before CVODE needs them, and are
 * kept until the end. */
static N_Vector clone_vector(N_Vector like)
{
    struct integrator *g = (struct integrator *)like->ops;
    return g->vectors < VECTORS ? &g->vector[g->vectors++] : NULL;
}

static void keep_vector(N_Vector vector)
{
    (void)vector;
}

/* Nonzero: no memory. */
static int make_vectors(struct integrator *g)
{
    const size_t n = (size_t)g->system.n_states;
    N_Vector serial = N_VNewEmpty_Serial(g->system.n_states, g->context);
    g->values = calloc(VECTORS * n, sizeof *g->values);
    if (serial) {
        g->operations = *serial->ops;
        N_VDestroy(serial);
    }
    if (!serial || !g->values) return 1;
    g->operations.nvclone = clone_vector;
    g->operations.nvdestroy = keep_vector;
    for (size_t i = 0; i < VECTORS; i++) {
        g->content[i] = (struct _N_VectorContent_Serial){.length = g->system.n_states, .data = g->values + i * n};
        g->vector[i] =
            (struct _generic_N_Vector){.content = &g->content[i], .ops = &g->operations, .sunctx = g->context};
    }
    g->y = &g->vector[g->vectors++];
    return 0;
}

/* The linear solver. It has its own matrix; CVODE passes gamma and the state. */
static SUNLinearSolver_Type linear_type(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

static SUNLinearSolver_ID linear_id(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_CUSTOM;
}

static int linear_solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, double tolerance)
{
    struct integrator *g = solver->content;
    double t, gamma, rl1;
    N_Vector predicted, now, rate, zn1;
    void *data;
    (void)matrix, (void)tolerance;
    if (CVodeGetNonlinearSystemData(g->cvode, &t, &predicted, &now, &rate, &gamma, &rl1, &zn1, &data)) return -1;
    g->system.newton(g->system.owner, gamma, NV_DATA_S(now), NV_DATA_S(b), NV_DATA_S(x));
    return 0;
}

/* Nonzero: no memory. */
static int make_linear(struct integrator *g)
{
    g->linear = SUNLinSolNewEmpty(g->context);
    if (!g->linear) return 1;
    g->linear->ops->gettype = linear_type;
    g->linear->ops->getid = linear_id;
    g->linear->ops->solve = linear_solve;
    g->linear->content = g;
    return 0;
}

/* A status of CVODE as one of ours. */
static int status_of(int flag)
{
    if (flag == CV_SUCCESS) return RESTITUTE_OK;
    return flag == CV_MEM_FAIL ? RESTITUTE_ERROR_MEMORY : RESTITUTE_ERROR_INTEGRATOR;
}

static int make_solvers(struct integrator *g)
{
    const int adams = g->system.family == INTEGRATOR_ADAMS;
    g->nonlinear = adams ? SUNNonlinSol_FixedPoint(g->y, 0, g->context) : SUNNonlinSol_Newton(g->y, g->context);
    if (!g->nonlinear) return RESTITUTE_ERROR_MEMORY;
    const int status = status_of(CVodeSetNonlinearSolver(g->cvode, g->nonlinear));
    if (status || adams) return status;
    if (make_linear(g)) return RESTITUTE_ERROR_MEMORY;
    const int flag = CVodeSetLinearSolver(g->cvode, g->linear, NULL);
    return flag == CVLS_MEM_FAIL ? RESTITUTE_ERROR_MEMORY : status_of(flag);
}

static int watch_roots(struct integrator *g)
{
    if (g->system.n_roots == 0) return RESTITUTE_OK;
    int status = status_of(CVodeRootInit(g->cvode, (int)g->system.n_roots, call_roots));
    if (!status) status = status_of(CVodeSetRootDirection(g->cvode, g->direction));
    return status ? status : status_of(CVodeSetNoInactiveRootWarn(g->cvode));
}

static int set_up(struct integrator *g, double t)
{
    g->cvode = CVodeCreate(g->system.family == INTEGRATOR_BDF ? CV_BDF : CV_ADAMS, g->context);
    if (!g->cvode) return RESTITUTE_ERROR_MEMORY;
    int status = status_of(listen(g));
    if (!status) status = status_of(CVodeInit(g->cvode, call_rates, t, g->y));
    if (!status) status = status_of(CVodeSetUserData(g->cvode, g));
    if (!status) status = status_of(CVodeSetMaxStep(g->cvode, g->system.longest_step)); /* 0: no limit */
    if (!status) status = status_of(CVodeWFtolerances(g->cvode, call_weights));
    if (!status) status = make_solvers(g);
    return status ? status : watch_roots(g);
}

int rst_integrator_create(const struct integrator_system *system, double t, const double *y,
                          struct integrator **integrator, char *text, int text_size)
{
    const size_t roots = system->n_roots > 0 ? (size_t)system->n_roots : 1;
    struct integrator *g = calloc(1, sizeof *g);
    int status = RESTITUTE_ERROR_MEMORY;
    *integrator = NULL;
    if (!g) {
        snprintf(text, (size_t)text_size, "out of memory for CVODE");
        return status;
    }
    g->system = *system;
    g->direction = malloc(roots * sizeof *g->direction);
    g->events = calloc(roots, sizeof *g->events);
    if (g->direction && g->events && make_context(g) == 0 && make_vectors(g) == 0) {
        memcpy(NV_DATA_S(g->y), y, (size_t)system->n_states * sizeof *y);
        for (size_t i = 0; i < roots; i++)
            g->direction[i] = -1;
        status = set_up(g, t);
    }
    if (status == RESTITUTE_OK)
        *integrator = g;
    else {
        snprintf(text, (size_t)text_size, "%s",
                 status == RESTITUTE_ERROR_MEMORY ? "out of memory for CVODE" : rst_integrator_text(g));
        rst_integrator_destroy(g);
    }
    return status;
}

void rst_integrator_destroy(struct integrator *g)
{
    if (!g) return;
    if (g->cvode) CVodeFree(&g->cvode);
    if (g->nonlinear) SUNNonlinSolFree(g->nonlinear);
    if (g->linear) SUNLinSolFreeEmpty(g->linear);
    if (g->context) SUNContext_Free(&g->context);
    free(g->values);
    free(g->direction);
    free(g->events);
    free(g);
}

enum integrator_return rst_integrator_advance(struct integrator *g, double *t, double *y)
{
    const int status = CVode(g->cvode, g->system.horizon + *t, g->y, t, CV_ONE_STEP);
    if (status < 0) return INTEGRATOR_FAILED;
    memcpy(y, NV_DATA_S(g->y), (size_t)g->system.n_states * sizeof *y);
    return status == CV_ROOT_RETURN ? INTEGRATOR_EVENT : INTEGRATOR_STEP;
}

const int *rst_integrator_events(struct integrator *g)
{
    if (CVodeGetRootInfo(g->cvode, g->events)) memset(g->events, 0, (size_t)g->system.n_roots * sizeof *g->events);
    return g->events;
}

int rst_integrator_look(struct integrator *g, double t, double *y)
{
    if (CVodeGetDky(g->cvode, t, 0, g->y)) return 1;
    memcpy(y, NV_DATA_S(g->y), (size_t)g->system.n_states * sizeof *y);
    return 0;
}

double rst_integrator_reached(struct integrator *g)
{
    double t = 0;
    CVodeGetCurrentTime(g->cvode, &t);
    return t;
}

int rst_integrator_restart(struct integrator *g, double t, const double *y)
{
    g->before = rst_integrator_work(g);
    g->before.restarts++;
    memcpy(NV_DATA_S(g->y), y, (size_t)g->system.n_states * sizeof *y);
    return CVodeReInit(g->cvode, t, g->y);
}

struct integrator_counts rst_integrator_work(struct integrator *g)
{
    struct integrator_counts work = g->before;
    long steps = 0, rates = 0, roots = 0;
    CVodeGetNumSteps(g->cvode, &steps);
    CVodeGetNumRhsEvals(g->cvode, &rates);
    CVodeGetNumGEvals(g->cvode, &roots);
    work.steps += steps;
    work.rates += rates;
    work.roots += roots;
    return work;
}

const char *rst_integrator_text(const struct integrator *g)
{
    return g->text[0] ? g->text : "no message";
}

const char *rst_integrator_version(void)
{
    return SUNDIALS_VERSION;
}
