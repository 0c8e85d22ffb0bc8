/* The tangential problem with tractions along x and y. The iteration alternates: tau_x with the
 * friction limit that tau_y leaves, then tau_y, until it converges. In cells that slip tau_y/p =
 * v_y/v, where v is the slip in the step. With v from the iteration before, v_y = (v/p) tau_y is a
 * linear resistance. The solver adds it to the diagonal of K.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>
#include <math.h>

#include "bem/plane.h"
#include "bem/stepper.h"

/* Iterations end when no tau_y changes by more than this share of the largest pressure. */
static const double closeness = 1e-6, settled = 1e-4;
enum { most_turns = 12 };

static double beside(double limit, double other)
{
    return sqrt(fmax(0, limit * limit - other * other));
}

static double largest(const struct bem_fields *f, const double *x)
{
    double value = 0;
    for (int64_t i = 0; i < f->m * f->m; i++)
        value = fmax(value, x[i]);
    return value;
}

static int solve_x(struct bem_stepper *s, int no_slip, double residual)
{
    struct bem_fields *f = &s->f;
    const int64_t cells = f->m * f->m;
    rst_bem_plane_convolve(s->near->plane, BEM_X_FROM_Y, f->m, f->tau_y, f->cross);
    for (int64_t i = 0; i < cells; i++) {
        f->high[i] = no_slip && f->p_new[i] > 0 ? DBL_MAX : beside(f->p_new[i], f->tau_y[i]);
        f->low[i] = -f->high[i];
        f->target[i] = f->full_x[i] - f->cross[i];
    }
    if (rst_bem_solve_target(s, BEM_SHEAR, NULL, residual, f->tau_new)) return 1;
    for (int64_t i = 0; i < cells; i++) {
        f->total_x[i] = f->f_new[i] + f->cross[i];
        f->slips[i] = f->p_new[i] > 0 && (f->tau_new[i] >= f->high[i] || f->tau_new[i] <= f->low[i]); /* slips */
    }
    return 0;
}

/* Returns the largest change of tau_y, negative if it was not found. */
static double solve_y(struct bem_stepper *s, int no_slip, double residual)
{
    struct bem_fields *f = &s->f;
    const int64_t cells = f->m * f->m;
    double change = 0;
    rst_bem_plane_convolve(s->near->plane, BEM_Y_FROM_X, f->m, f->tau_new, f->cross);
    for (int64_t i = 0; i < cells; i++) {
        const double v_x = f->full_x[i] - f->total_x[i], v_y = f->full_y[i] - f->total_y[i], v = hypot(v_x, v_y);
        f->high[i] = no_slip && f->p_new[i] > 0 ? DBL_MAX
                     : f->slips[i] > 0          ? f->p_new[i]
                                                : beside(f->p_new[i], f->tau_new[i]);
        f->low[i] = -f->high[i];
        f->resistance[i] = f->slips[i] > 0 ? v / f->p_new[i] : 0;
        f->target[i] = f->full_y[i] - f->cross[i];
        f->total_y[i] = f->tau_y[i]; /* for the change */
    }
    if (rst_bem_solve_target(s, (enum bem_kind)BEM_SHEAR_Y, f->resistance, residual, f->tau_y)) return -1;
    for (int64_t i = 0; i < cells; i++) {
        change = fmax(change, fabs(f->tau_y[i] - f->total_y[i]));
        f->total_y[i] = f->f_new[i] - f->resistance[i] * f->tau_y[i] + f->cross[i];
    }
    return change;
}

/* tau_y that slipped keeps its direction as the pressure changes. */
static void start(struct bem_stepper *s)
{
    struct bem_fields *f = &s->f;
    for (int64_t i = 0; i < f->m * f->m; i++)
        f->tau_y[i] = f->p_new[i] > 0 && f->p[i] > 0 ? f->tau_y[i] * fmin(1, f->p_new[i] / f->p[i]) : 0;
}

static void finish(struct bem_stepper *s, double shift)
{
    struct bem_fields *f = &s->f;
    const struct bem_solid *solid = s->solid;
    const int64_t m = f->m;
    double sum, stick, work, unused[3];
    for (int64_t i = 0; i < m * m; i++) { /* slip is that of x: tau_y has no bounds of its own here */
        f->high[i] = f->slips[i] > 0 ? -DBL_MAX : DBL_MAX;
        f->low[i] = -DBL_MAX;
    }
    rst_bem_settle(m, m, m, 0, solid->c, f->h_y, f->total_y, f->p_new, f->tau_y, f->tau_y, f->low, f->high, f->anchor_y,
                   f->s_y, f->s_y_before, &unused[0], &unused[1], &work);
    s->run->work.friction += work * s->cell;
    rst_bem_settle(m, m, m, shift, solid->c, f->h, f->total_x, f->p_new, f->tau, f->tau_new, f->low, f->high, f->anchor,
                   f->s, f->s_before, &sum, &stick, &work);
    s->run->work.friction += work * s->cell;
    rst_bem_remember(m, m, solid->n_terms, solid->decay, solid->gain, solid->half_flow, f->total_x, f->b_x, f->drift_x,
                     f->f_x);
    rst_bem_remember(m, m, solid->n_terms, solid->decay, solid->gain, solid->half_flow, f->total_y, f->b_y, f->drift_y,
                     f->f_y);
    s->motion.shear_force = sum * s->cell;
    s->motion.stick = stick * s->cell * s->setup->spacing;
}

enum bem_end rst_bem_solve_both(struct bem_stepper *s, double shift)
{
    struct bem_fields *f = &s->f;
    const struct bem_solid *solid = s->solid;
    const int64_t m = f->m;
    const int no_slip = s->setup->problem->mode == RST_NO_SLIP;
    const double residual = closeness * fmin(1, s->setup->problem->psi) / solid->c;
    if (!s->near->plane && !(s->near->plane = rst_bem_plane_create(m))) return BEM_NO_MEMORY;
    rst_bem_recall(m, m, solid->n_terms, solid->decay, f->b_x, solid->held, f->drift_x, f->f_x, f->h);
    rst_bem_recall(m, m, solid->n_terms, solid->decay, f->b_y, solid->held, f->drift_y, f->f_y, f->h_y);
    rst_bem_shear_target(m, m, shift, solid->c, f->anchor, f->h, f->full_x);
    rst_bem_shear_target(m, m, 0, solid->c, f->anchor_y, f->h_y, f->full_y);
    rst_bem_shear_bounds(m, m, no_slip, f->p_new, f->low, f->high);
    rst_bem_start_shear(m, m, f->p, f->tau, f->tau_before, f->high, f->tau_new);
    start(s);
    for (int64_t i = 0; i < m * m; i++)
        f->total_y[i] = f->f_y[i];
    for (int turn = 0; turn < most_turns; turn++) {
        if (solve_x(s, no_slip, residual)) return BEM_UNSETTLED;
        const double change = solve_y(s, no_slip, residual);
        if (change < 0) return BEM_UNSETTLED;
        if (change <= settled * largest(f, f->p_new)) break;
    }
    finish(s, shift);
    return BEM_REBOUND;
}
