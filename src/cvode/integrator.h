/* CVODE with its vectors and solvers behind five calls; the only file that knows its versions is
 * integrator.c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_INTEGRATOR_H
#define RST_CVODE_INTEGRATOR_H

#include <restitute/status.h>
#include <stdint.h>

enum integrator_family { INTEGRATOR_ADAMS, INTEGRATOR_BDF };

/* What is integrated. Functions return 0, or nonzero if a value is not finite. */
struct integrator_system {
    int64_t n_states, n_roots;
    enum integrator_family family;
    double horizon;      /* order of the time to be covered: the first step is small against it */
    double longest_step; /* 0: any */
    int (*rates)(void *owner, double t, const double *y, double *rate);
    void (*roots)(void *owner, double t, const double *y, double *value); /* an event where a value falls through 0 */
    void (*newton)(void *owner, double gamma, const double *y, const double *b,
                   double *x);                                     /* (1 - gamma J) x = b; BDF */
    void (*weights)(void *owner, const double *y, double *weight); /* 1/(error allowed) */
    void *owner;
};

/* Result of a step. */
enum integrator_return { INTEGRATOR_STEP, INTEGRATOR_EVENT, INTEGRATOR_FAILED };

struct integrator_counts {
    int64_t steps, restarts, rates, roots;
};

struct integrator;

/* OK, ERROR_MEMORY or ERROR_INTEGRATOR; if it failed *integrator is NULL and `text` says why. y:
 * the states at t, copied. */
int rst_integrator_create(const struct integrator_system *system, double t, const double *y,
                          struct integrator **integrator, char *text, int text_size);
void rst_integrator_destroy(struct integrator *integrator);

/* One step, or the rest of one up to the next event: t and y, in: where it is, out: where that
 * ends. */
enum integrator_return rst_integrator_advance(struct integrator *integrator, double *t, double *y);

/* After EVENT: nonzero entries are the functions that fell through 0. */
const int *rst_integrator_events(struct integrator *integrator);

/* The states at a time within the last step. Nonzero: it is not in there. */
int rst_integrator_look(struct integrator *integrator, double t, double *y);

/* Where the last step of CVODE itself ends; an event may lie before that. */
double rst_integrator_reached(struct integrator *integrator);

/* Restart at t, with another right-hand side. Nonzero: failed. */
int rst_integrator_restart(struct integrator *integrator, double t, const double *y);

/* Work since creation. */
struct integrator_counts rst_integrator_work(struct integrator *integrator);

/* The last error text of CVODE. */
const char *rst_integrator_text(const struct integrator *integrator);

/* Version of SUNDIALS in use. */
const char *rst_integrator_version(void);

#endif
