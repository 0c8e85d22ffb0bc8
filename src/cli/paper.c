/* The paper's algorithm, (5), (8)-(17), as published: positions first, then the forces of all elements, the inner
 * displacements by backward Euler, velocities last; fixed step, fixed elements. Every element is stepped in both
 * directions in every step, (12),(13) outside of the contact. In slip the force has the sign of the force of the step
 * before (16), which is none for an element that slips in its first step: such an element bears no force until it has
 * stuck once.
 *
 * In dimensionless form, f = G_inf u + sum g_k w_k + eta u' and w_k' = u' - w_k/tau_k, an element that moves by du has
 * the force
 *
 *     f = b + s du,   b = G_inf u + sum g_k w_k/(1 + h/tau_k),   s = G_inf + eta/h + sum g_k/(1 + h/tau_k).
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include "paper.h"

#include <math.h>
#include <stdlib.h>

/* One direction of one element is its displacement, then the elongations of its Maxwell springs. */
struct foundation {
    const struct paper_problem *problem;
    size_t n_elements, stride;
    double *kept;     /* per term: 1/(1 + h/tau_k) */
    double stiffness; /* s */
    double *normal;   /* per element: u_z, w_z1, w_z2, ... */
    double *tangential;
    double *force;   /* f_x of the step before */
    double *profile; /* X^2 (8) */
    int trial_sign;
    int64_t sticking;
};

struct sphere {
    double depth, velocity, acceleration;
    double shear_velocity, shear_acceleration;
};

/* Sums over the contact, and how many elements are in it. */
struct forces {
    double normal, tangential;
    size_t touching;
};

static int foundation_make(const struct paper_problem *problem, const struct paper_settings *settings,
                           struct foundation *f)
{
    const size_t n = (size_t)settings->elements, terms = problem->n_terms;
    *f = (struct foundation){
        .problem = problem, .n_elements = n, .stride = 1 + terms, .trial_sign = settings->trial_sign};
    f->kept = calloc(terms + 2 * n + 2 * n * f->stride, sizeof *f->kept);
    if (!f->kept) return 1;
    f->force = f->kept + terms;
    f->profile = f->force + n;
    f->normal = f->profile + n;
    f->tangential = f->normal + n * f->stride;
    f->stiffness = problem->g_inf + problem->eta / settings->step;
    for (size_t k = 0; k < terms; k++) {
        f->kept[k] = 1 / (1 + settings->step / problem->tau[k]);
        f->stiffness += problem->g[k] * f->kept[k];
    }
    for (size_t i = 0; i < n; i++) {
        const double x = ((double)i + 0.5) * settings->spacing;
        f->profile[i] = x * x;
    }
    return 0;
}

/* b: the force of an element that does not move in this step. */
static double force_at_rest(const struct foundation *f, const double *element)
{
    double force = f->problem->g_inf * element[0];
    for (size_t k = 0; k < f->problem->n_terms; k++)
        force += f->problem->g[k] * f->kept[k] * element[1 + k];
    return force;
}

static void move(const struct foundation *f, double distance, double *element)
{
    element[0] += distance;
    for (size_t k = 0; k < f->problem->n_terms; k++)
        element[1 + k] = f->kept[k] * (element[1 + k] + distance);
}

static double sign_of(double value)
{
    return (value > 0) - (value < 0);
}

/* Element i under a sphere at this depth whose contact point has moved by `shear`. */
static void step_element(struct foundation *f, size_t i, double depth, double shear, struct forces *sum)
{
    double *z = f->normal + i * f->stride, *x = f->tangential + i * f->stride;
    const double rest_z = force_at_rest(f, z), rest_x = force_at_rest(f, x);
    const double press = depth - f->profile[i] - z[0], fz = rest_z + f->stiffness * press;
    if (fz <=
        0) { /* the free surface lies below the profile: no contact, or no longer; it relaxes without force (12),(13) */
        move(f, -rest_z / f->stiffness, z);
        move(f, -rest_x / f->stiffness, x);
        f->force[i] = 0;
        return;
    }
    double fx = rest_x + f->stiffness * shear;
    if (fabs(fx) > fz)
        fx = sign_of(f->trial_sign ? fx : f->force[i]) * fz; /* (14)-(16) */
    else
        f->sticking++;
    move(f, press, z);
    move(f, (fx - rest_x) / f->stiffness, x); /* the whole shear in stick, what the force allows in slip (17) */
    f->force[i] = fx;
    sum->normal += fz;
    sum->tangential += fx;
    sum->touching++;
}

static struct forces step_foundation(struct foundation *f, double depth, double shear)
{
    struct forces sum = {0, 0, 0};
    for (size_t i = 0; i < f->n_elements; i++)
        step_element(f, i, depth, shear, &sum);
    return sum;
}

/* Velocity after a step h, from the accelerations before and after it. */
static double advance(enum paper_motion motion, double h, double velocity, double before, double after)
{
    switch (motion) {
    case PAPER_VERLET:
        return velocity + 0.5 * h * (before + after);
    case PAPER_FORWARD:
        return velocity + h * before;
    default:
        return velocity + h * after;
    }
}

/* One step; returns the number of elements in contact. The force is zero at first touch and after the contact, so
 * Verlet goes through the same positions as Euler with half a step's velocity, and ends with the same velocity. */
static size_t step_sphere(struct foundation *f, const struct paper_settings *settings, struct sphere *s)
{
    const double h = settings->step, half = settings->motion == PAPER_VERLET ? 0.5 * h * h : 0;
    const double before = s->acceleration, shear_before = s->shear_acceleration;
    s->depth += h * s->velocity + half * before;
    const struct forces sum = step_foundation(f, s->depth, h * s->shear_velocity + half * shear_before);
    s->acceleration = -15.0 / 8.0 * settings->spacing * sum.normal;
    s->shear_acceleration = -15.0 / 4.0 * f->problem->chi * settings->spacing * sum.tangential;
    s->velocity = advance(settings->motion, h, s->velocity, before, s->acceleration);
    s->shear_velocity = advance(settings->motion, h, s->shear_velocity, shear_before, s->shear_acceleration);
    return sum.touching;
}

enum paper_end paper_solve(const struct paper_problem *problem, const struct paper_settings *settings,
                           struct paper_result *result)
{
    struct foundation f;
    struct sphere s = {.velocity = 1, .shear_velocity = problem->psi};
    enum paper_end end = PAPER_UNSTABLE;
    int64_t steps = 0;
    if (foundation_make(problem, settings, &f)) return PAPER_NO_MEMORY;
    while (end == PAPER_UNSTABLE && steps < settings->max_steps && isfinite(s.velocity + s.shear_velocity)) {
        const size_t touching = step_sphere(&f, settings, &s);
        steps++;
        if (touching == 0 && s.velocity < 0) end = PAPER_SEPARATED;
    }
    free(f.kept);
    if (end == PAPER_SEPARATED)
        *result = (struct paper_result){-s.velocity, -s.shear_velocity / problem->psi, steps,
                                        steps * settings->elements * (int64_t)(1 + problem->n_terms), f.sticking};
    return end;
}
