/* One impact as the input of every method, in the units of docs/theory.md, section 2. Friction,
 * sliding and solid are already decided.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_PROBLEM_H
#define RST_PROBLEM_H

#include <math.h>
#include <stdio.h>

#include <restitute/restitute.h>

#include "base/kernels.h"

/* Dimensionless solid: moduli over G_r, times over T. The arrays live in the solver's workspace. */
struct rst_solid {
    double g_inf, eta;
    int64_t n_terms;
    double *g, *tau;
    int can_sink; /* no equilibrium modulus before merging: the sphere may never rebound */
};

struct rst_problem {
    const restitute_method *method; /* that solves it: one function may serve several methods */
    double chi;
    double psi;         /* for the kernel: 1 without slip, where it is only a scale */
    enum rst_mode mode; /* of the tangential side at first touch */
    struct rst_solid solid;
    double tolerance;
    int64_t elements;      /* 0: chosen by the method */
    double time_step;      /* in T; 0: chosen by the method */
    double time_unit;      /* T in the caller's unit, for messages */
    const char *unit_name; /* of time */
    int64_t max_updates;
    double time_limit;     /* s */
    double (*clock)(void); /* rst_clock(), for methods of other libraries too; NULL: no limit of time */
    double deadline;       /* of clock() */
};

/* Seconds that are left. */
static inline double rst_time_left(const struct rst_problem *problem)
{
    return problem->clock ? problem->deadline - problem->clock() : INFINITY;
}

/* Whether the time left is less than `times` the time spent since `before` seconds were left. */
static inline int rst_lacks_time(const struct rst_problem *problem, double times, double before)
{
    if (!problem->clock) return 0;
    const double left = rst_time_left(problem);
    return left < times * (before - left);
}

/* An exceeded limit, as text for messages. */
struct rst_limit {
    char text[48];
};

static inline struct rst_limit rst_spent(const struct rst_problem *problem, int by_time)
{
    struct rst_limit limit;
    if (by_time)
        snprintf(limit.text, sizeof limit.text, "time_limit = %g s", problem->time_limit);
    else
        snprintf(limit.text, sizeof limit.text, "max_updates = %lld", (long long)problem->max_updates);
    return limit;
}

/* What a method returns, in the same units. Velocities are those after the impact. */
struct rst_outcome {
    double velocity, shear_velocity;
    double error_ez, error_ex;
    double contact_time;  /* infinite if sunk */
    double followed_time; /* to the end of the run */
    double max_indentation, max_contact_radius, max_normal_force;
    double spacing, step;
    int64_t elements, steps, updates;
    struct rst_ledger ledger;
    int sunk;
    int late;         /* sync: the limit of time ended refinement */
    int halvings;     /* sync: those of the run that gave the pair */
    int without_slip; /* sync: slip was left out */
    int64_t walked;   /* sync: elements in a panel, if elements gave it, else 0 */
};

/* Receives samples of the history in the units of the problem; see restitute_history. */
struct rst_sample {
    double time, indentation, contact_radius, stick_radius, normal_force, shear_force, velocity, shear_velocity;
};

struct rst_history {
    size_t capacity, count;
    struct rst_sample *samples;
};

/* Mode of the tangential side by psi; 0: no slip, infinity: no friction. */
void rst_set_sliding(double psi, struct rst_problem *problem);

/* Largest chi that is accepted. */
extern const double rst_largest_chi;

/* The parallel dashpot is not stronger than delta1 may be. */
int rst_check_damping(const struct rst_solid *solid, restitute_error *error);

/* Dimensionless impact -> problem; arrays of `solid` hold at least the terms of the impact's solid,
 * and at least 1. */
int rst_problem_from_impact(const restitute_impact *impact, struct rst_problem *problem, restitute_error *error);

/* Velocity at which the contact point slides before the impact, m/s, with the sign of the scene. */
double rst_sliding_speed(const restitute_scene *scene);

/* Scene -> numbers and problem. */
int rst_problem_from_scene(const restitute_scene *scene, restitute_numbers *numbers, struct rst_problem *problem,
                           restitute_error *error);

#endif
