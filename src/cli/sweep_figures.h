/* The figures of `restitute sweep`: which impacts each one has.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_FIGURES_H
#define CLI_SWEEP_FIGURES_H

#include "cases.h"
#include "sweep_draw.h"

enum sweep_kind {
    SWEEP_EZ,          /* ez over delta1, a curve a gamma */
    SWEEP_NO_SLIP,     /* ex without slip, likewise */
    SWEEP_CONTOURS,    /* ex over delta1 and psi */
    SWEEP_PSI_C,       /* psi_c over delta1, a curve a gamma */
    SWEEP_PSI_C_ERROR, /* what simulations of finite resolution differ from (31) by */
    SWEEP_MAXWELL,     /* over tau/T, a curve a psi */
    SWEEP_TEMPERATURE, /* over the speed, a curve a temperature */
    SWEEP_TANGENT,     /* ez over the loss tangent, a curve a rheology */
    SWEEP_FRICTION     /* energy over psi, a curve a delta1 */
};

enum { SWEEP_CURVES = 8 };

struct sweep_figure {
    const char *name, *title;
    enum sweep_kind kind;
    size_t curves, points; /* so many points a curve */
    double curve[SWEEP_CURVES];
    double low, high; /* of the axis */
};

extern const struct sweep_figure sweep_figures[];
extern const size_t sweep_figure_count;

/* NULL: there is none of this name. */
const struct sweep_figure *sweep_figure_named(const char *name);

/* One impact, its place in the figure, and what the dimensionless numbers alone give. */
struct sweep_sample {
    size_t curve;
    struct sweep_numbers numbers; /* those that are aimed at; NaN for a material file */
    struct values values;
    double ez, ex; /* of restitute_solve(); NaN likewise */
};

struct sweep {
    const struct sweep_figure *figure;
    const struct settings *settings; /* solution, seed, output folder */
    const char *folder, *material;   /* where files go; what the figure temperature takes */
    size_t count;
    struct sweep_sample *samples;
};

/* Draw the samples of a figure and solve their dimensionless numbers. */
void sweep_plan(struct sweep *sweep);

/* The samples as cases. */
void sweep_cases(const struct sweep *sweep, struct cases *cases);

/* Solve so many numbers by the method sync at a hundredth of the tolerance: what samples are compared with. One that
 * fails leaves NaN in its pair. */
bool sweep_solve(const struct settings *settings, size_t count, const struct sweep_numbers *numbers,
                 restitute_result *results, struct reason *why);

/* The options of that, and the impact; `solid` is made where the numbers say Maxwell, and is to be destroyed. */
restitute_options sweep_fine_options(const struct settings *settings);
restitute_impact sweep_impact(const struct sweep_numbers *numbers, restitute_material **solid);

/* a_T of polyisobutylene at this temperature in degrees Celsius. */
double sweep_time_shift(double temperature);

/* A place on the axis, part of the way from its low to its high end. */
double sweep_along(const struct sweep_figure *figure, double part);

/* The numbers of curve `curve` at `x` along the axis. */
struct sweep_numbers sweep_numbers_at(const struct sweep_figure *figure, size_t curve, double x, double psi);

#endif
