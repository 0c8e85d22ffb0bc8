/* One impact as the input of every method, in the units of docs/theory.md, section 2. Friction,
 * sliding and solid are already decided.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_PROBLEM_H
#define RST_PROBLEM_H

#include <math.h>

#include <restitute/restitute.h>

#include "base/kernels.h"
#include "base/report.h"

/* Dimensionless solid: moduli over G_r, times over T. The arrays live in the solver's workspace. */
struct rst_solid {
    double g_inf, eta;
    int64_t n_terms;
    double *g, *tau;
    int can_sink; /* no equilibrium modulus before merging: the sphere may never rebound */
};

/* Factors from the units of the problem to the caller's. */
struct rst_units {
    double time, length_z, length_x, force, velocity;
    double shear_velocity; /* of -ex, that is of U'/shear_speed */
    double shear_force;
};

struct rst_problem {
    const restitute_method *method; /* that solves it: one function may serve several methods */
    double chi;
    enum rst_mode mode; /* how friction acts: set here, changed only where the solver leaves out slip */
    double psi;         /* (22), however friction acts: 0 without slip, infinite without friction */
    double shear_speed; /* U' at first touch: psi, or 1 without slip or friction, where U may have any unit */
    double shear_scale; /* caller's tangential unit / ours: 1, or psi if slip was left out */
    double slip_bound;  /* bound on the change of e_x by slip that was left out */
    struct rst_solid solid;
    double tolerance;      /* for the method to meet */
    double asked;          /* the caller's, for messages: larger where slip is left out */
    int64_t elements;      /* 0: chosen by the method */
    double time_step;      /* in T; 0: chosen by the method */
    struct rst_units units;
    double time_unit;      /* T in the caller's unit, for messages */
    const char *unit_name; /* of time */
    double max_work;       /* nominal seconds, as messages name it */
    int64_t max_updates;   /* the same in the unit in which the method counts */
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
        rst_print(limit.text, sizeof limit.text, "time_limit = %g s", problem->time_limit);
    else
        rst_print(limit.text, sizeof limit.text, "max_work = %g", problem->max_work);
    return limit;
}

/* What a method returns, in the same units. Velocities, D' and U', are those after the impact. */
struct rst_outcome {
    double velocity, shear_velocity;
    double error_ez, error_ex;
    double contact_time;  /* infinite if sunk */
    double followed_time; /* to the end of the run */
    double max_indentation, max_contact_radius, max_normal_force; /* forces: int_0^A f dX */
    double spacing, step;
    int64_t elements, steps, updates;
    struct rst_ledger ledger;
    int sunk;
    int coarse;       /* euler: the steps of the ledger are longer than slip lasts */
    int late;         /* sync: the limit of time ended refinement */
    int halvings;     /* sync: those of the run that gave the pair */
    int64_t walked;   /* sync: elements in a panel, if elements gave it, else 0 */
};

/* Receives samples of the history; see restitute_history. Forces are int_0^A f dX and int_0^A q dX,
 * U' is over shear_speed. */
struct rst_sample {
    double time, indentation, contact_radius, stick_radius, normal_force, shear_force, velocity, shear_velocity;
};

struct rst_history {
    size_t capacity, count;
    struct rst_sample *samples;
};

/* How friction acts, by psi; 0: no slip, infinity: no friction. */
void rst_set_sliding(double psi, struct rst_problem *problem);

/* e_x differs from that without slip by less than this times psi: elastic 0.4 at chi = 7/6 and less
 * at larger chi, not proven (docs/records/accuracy.md). */
static const double rst_change_by_slip = 2;

/* Largest chi that is accepted. */
extern const double rst_largest_chi;

/* A material: moduli are multiplied by `factor`, times are divided by `time`. */
void rst_solid_of(const restitute_material *material, double factor, double time, struct rst_solid *solid);

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
