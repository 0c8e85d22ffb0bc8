/* The contact problems of a step. Residuals are displacements over the displacement of the sphere.
 * A stick condition is stored as an anchor and not as an increment, so that residuals do not
 * accumulate from step to step.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/stepper.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double closeness = 1e-6;
enum { most_iterations = 200 };

/* K x = f->target with what is in f->low, f->high, f->p_new or f->tau_new; K x into f->f_new.
 * Nonzero: not settled. */
static int solve_target(struct bem_stepper *s, enum bem_kind kind, double residual, double *x)
{
    struct bem_fields *f = &s->f;
    struct bem_bounded b = {.transform = s->near,
                            .kind = kind,
                            .ld = f->m,
                            .low = f->low,
                            .high = f->high,
                            .rhs = f->target,
                            .x = x,
                            .u = f->f_new,
                            .free = f->free,
                            .r = f->r,
                            .z = f->z,
                            .d = f->d,
                            .kd = f->kd,
                            .closeness = residual,
                            .most_iterations = most_iterations};
    const int failed = rst_bem_solve_bounded(&b);
    s->run->iterations += b.iterations;
    s->run->convolutions += b.convolutions;
    s->run->updates += b.convolutions * 4 * s->near->m * s->near->m;
    return failed;
}

/* The memory of the solid needs displacements where contact will be. */
static void spread(struct bem_stepper *s, enum bem_kind kind, const double *x)
{
    if (s->all == s->near) return;
    rst_bem_convolve(s->all, kind, s->f.m, x, s->f.f_new);
    s->run->convolutions++;
    s->run->updates += 4 * s->all->m * s->all->m;
}

/* Whether a cell at the border of the present part of the grid is in contact. */
static int touches_side(const struct bem_stepper *s)
{
    const int64_t m = s->near->m, ld = s->f.m;
    return s->f.p_new[m - 1] > 0 || s->f.p_new[(m - 1) * ld] > 0;
}

enum bem_end rst_bem_solve_normal(struct bem_stepper *s, double depth, double shift)
{
    struct bem_fields *f = &s->f;
    const struct bem_solid *solid = s->solid;
    const int64_t ld = f->m, m = s->all->m;
    const int naive = s->setup->variant.explicit_euler;
    double sum, cells;
    rst_bem_recall(ld, m, solid->n_terms, solid->decay, f->b_z, solid->held, f->drift_z, f->f_z, f->h);
    rst_bem_normal_target(ld, m, s->setup->spacing, depth, solid->c, f->h, f->target);
    rst_bem_start_normal(ld, s->near->m, f->p, f->p_before, f->p_new, f->low, f->high);
    if (solve_target(s, BEM_NORMAL, closeness * depth / solid->c, f->p_new)) return BEM_UNSETTLED;
    if (touches_side(s)) return BEM_OUTGREW;
    spread(s, BEM_NORMAL, f->p_new);
    const double first_ratio = !(s->run->max_force > 0) && !naive ? shift / depth : -1;
    rst_bem_enter(ld, s->near->m, s->setup->spacing, first_ratio, f->p_new, f->p, f->gap,
                  naive ? f->gap : f->gap_before, f->s, f->s_before, f->anchor);
    rst_bem_measure(ld, m, s->near->m, solid->c, f->f_new, f->target, f->p_new, f->gap, f->gap_before, &sum, &cells);
    rst_bem_remember(ld, m, solid->n_terms, solid->decay, solid->gain, solid->half_flow, f->f_new, f->b_z, f->drift_z,
                     f->f_z);
    s->motion.force = sum * s->cell;
    s->motion.contact = cells * s->cell * s->setup->spacing;
    return BEM_REBOUND;
}

/* Fix cells of the sticking set that exceed the limit at the limit. Returns their number. */
static int64_t shrink_stick_set(struct bem_stepper *s)
{
    struct bem_fields *f = &s->f;
    int64_t moved = 0;
    for (int64_t j = 0; j < s->near->m; j++)
        for (int64_t i = j * f->m; i < j * f->m + s->near->m; i++) {
            if (!(f->p_new[i] > 0) || f->low[i] >= f->high[i] || fabs(f->tau_new[i]) <= f->p_new[i]) continue;
            f->tau_new[i] = f->low[i] = f->high[i] = copysign(f->p_new[i], f->tau_new[i]);
            moved++;
        }
    return moved;
}

/* The scheme of the paper: all cells stick at first, without a limit. */
static int solve_by_stick_sets(struct bem_stepper *s, double residual)
{
    struct bem_fields *f = &s->f;
    const int64_t m = s->near->m;
    rst_bem_shear_bounds(f->m, m, RST_NO_SLIP, f->p_new, f->low, f->high);
    do {
        if (solve_target(s, BEM_SHEAR, residual, f->tau_new)) return 1;
    } while (s->setup->problem->mode != RST_NO_SLIP && shrink_stick_set(s) > 0);
    rst_bem_shear_bounds(f->m, m, s->setup->problem->mode, f->p_new, f->low, f->high);
    return 0;
}

enum bem_end rst_bem_solve_shear(struct bem_stepper *s, double shift)
{
    struct bem_fields *f = &s->f;
    const struct bem_solid *solid = s->solid;
    const int64_t ld = f->m, m = s->all->m, near = s->near->m;
    const double residual = closeness * fmin(1, s->setup->problem->shear_speed) / solid->c;
    double sum, stick, work;
    rst_bem_recall(ld, m, solid->n_terms, solid->decay, f->b_x, solid->held, f->drift_x, f->f_x, f->h);
    rst_bem_shear_bounds(ld, near, s->setup->problem->mode, f->p_new, f->low, f->high);
    rst_bem_shear_target(ld, near, shift, solid->c, f->anchor, f->h, f->target);
    rst_bem_start_shear(ld, near, f->p, f->tau, f->tau_before, f->high, f->tau_new);
    if (s->setup->variant.stick_sets ? solve_by_stick_sets(s, residual)
                                     : solve_target(s, BEM_SHEAR, residual, f->tau_new))
        return BEM_UNSETTLED;
    spread(s, BEM_SHEAR, f->tau_new);
    rst_bem_settle(ld, m, near, shift, solid->c, f->h, f->f_new, f->p_new, f->tau, f->tau_new, f->low, f->high,
                   f->anchor, f->s, f->s_before, &sum, &stick, &work);
    rst_bem_remember(ld, m, solid->n_terms, solid->decay, solid->gain, solid->half_flow, f->f_new, f->b_x, f->drift_x,
                     f->f_x);
    s->motion.shear_force = sum * s->cell;
    s->motion.stick = stick * s->cell * s->setup->spacing;
    s->run->work.friction += work * s->cell;
    return BEM_REBOUND;
}

/* Half the sum over terms of b (K^-1 b)/J: a Kelvin element of a solid without load is stretched by
 * -b. */
static double energy_of_terms(struct bem_stepper *s, enum bem_kind kind, const double *b, double *x)
{
    struct bem_fields *f = &s->f;
    const int64_t cells = f->m * f->m;
    double energy = 0;
    for (int64_t i = 0; i < cells; i++) {
        f->high[i] = f->touched[i] > 0 ? DBL_MAX : 0;
        f->low[i] = -f->high[i];
    }
    for (int64_t k = 0; k < s->solid->n_terms; k++) {
        double largest = 0;
        memcpy(f->target, b + k * cells, (size_t)cells * sizeof *b);
        memset(x, 0, (size_t)cells * sizeof *x);
        for (int64_t i = 0; i < cells; i++)
            largest = fmax(largest, fabs(f->target[i]));
        if (!(largest > 0) || solve_target(s, kind, 1e-3 * largest, x)) continue;
        for (int64_t i = 0; i < cells; i++)
            energy += 0.5 * x[i] * f->target[i] / s->solid->compliance[k];
    }
    return energy * s->cell;
}

void rst_bem_find_left(struct bem_stepper *s)
{
    const int64_t updates = s->run->updates; /* those of the impact alone, with a ledger or without */
    s->near = s->all = rst_bem_memory_transform(s->memory, s->f.m); /* allocated since the run began */
    s->run->work.left_normal = energy_of_terms(s, BEM_NORMAL, s->f.b_z, s->f.p_new);
    if (!s->setup->normal_only) s->run->work.left_shear = energy_of_terms(s, BEM_SHEAR, s->f.b_x, s->f.tau_new);
    s->run->updates = updates;
}
