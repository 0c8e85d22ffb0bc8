/* A plain explicit Euler of the paper's foundation in SI units, (5), (9)-(17): every element, both
 * directions, every step. It uses no code of the library, scales nothing and omits nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SI_EULER_H
#define TEST_SI_EULER_H

#include <math.h>
#include <stdlib.h>

enum { si_terms = 4 };

/* Sphere and half-space, to which two bodies have been reduced. */
struct si_scene {
    double mass, radius;   /* kg, m: of the pair */
    double mobility;       /* 1/kg: sum of 1/m + R^2/J */
    double g_inf, eta, nu; /* Pa, Pa s: of the pair */
    int n_terms;
    double g[si_terms], tau[si_terms];
    double friction;
    double speed, sliding; /* m/s */
    double spacing, step;  /* m, s */
};

struct si_element {
    double profile; /* x^2/R */
    int touching, gone;
    double shift;                      /* u_x */
    double wz[si_terms], wx[si_terms]; /* elongations of the Maxwell springs (10) */
};

struct si_result {
    double ez, ex;
    long steps;
};

/* (12): backward Euler of w' = u' - w/tau. */
static void si_relax(const struct si_scene *s, double move, double w[si_terms])
{
    for (int k = 0; k < s->n_terms; k++)
        w[k] = (w[k] + move) / (1 + s->step / s->tau[k]);
}

/* (9) without its factor: stress of displacement, dashpot and springs. */
static double si_stress(const struct si_scene *s, double displacement, double move, const double w[si_terms])
{
    double stress = s->g_inf * displacement + s->eta * move / s->step;
    for (int k = 0; k < s->n_terms; k++)
        stress += s->g[k] * w[k];
    return stress;
}

/* (14)-(17) with the direction of the trial force. */
static double si_friction(const struct si_scene *s, double factor, double trial, double bound, struct si_element *e)
{
    if (fabs(trial) <= bound) return trial;
    double stiffness = s->g_inf + s->eta / s->step;
    for (int k = 0; k < s->n_terms; k++)
        stiffness += s->g[k] / (1 + s->step / s->tau[k]);
    double held = copysign(bound, trial), slip = (trial - held) / (factor * stiffness);
    e->shift -= slip;
    for (int k = 0; k < s->n_terms; k++)
        e->wx[k] -= slip / (1 + s->step / s->tau[k]);
    return held;
}

/* Moves one element with the sphere; adds its forces. An element reached within the step moves by
 * what is left of it. */
static void si_step_element(const struct si_scene *s, double depth, double vz, double vx, int loading,
                            struct si_element *e, double *normal, double *tangential)
{
    double uz = depth - e->profile, move = s->step * vz, part = 1;
    if (!e->touching) {
        if (e->gone || !loading || uz <= 0) return;
        e->touching = 1;
        part = uz / move;
        move = uz;
    }
    double shear_move = s->step * vx * part;
    si_relax(s, move, e->wz);
    double fz = 2 * s->spacing / (1 - s->nu) * si_stress(s, uz, move, e->wz);
    if (fz <= 0) {
        e->touching = 0;
        e->gone = 1;
        return;
    }
    e->shift += shear_move;
    si_relax(s, shear_move, e->wx);
    double factor = 4 * s->spacing / (2 - s->nu), trial = factor * si_stress(s, e->shift, shear_move, e->wx);
    *normal += fz;
    *tangential += isinf(s->friction) ? trial : si_friction(s, factor, trial, s->friction * fz, e);
}

static struct si_result si_euler(const struct si_scene *s, long elements)
{
    struct si_element *e = calloc((size_t)elements, sizeof *e);
    double depth = 0, vz = s->speed, vx = s->sliding;
    long steps = 0;
    int loading = 1, touching = 1;
    for (long i = 0; i < elements; i++) {
        double x = ((double)i + 0.5) * s->spacing;
        e[i].profile = x * x / s->radius;
    }
    while ((loading || touching) && steps < 10000000) {
        double normal = 0, tangential = 0;
        touching = 0;
        depth += s->step * vz;
        for (long i = 0; i < elements; i++) {
            si_step_element(s, depth, vz, vx, loading, &e[i], &normal, &tangential);
            touching |= e[i].touching;
        }
        vz -= s->step * 2 * normal / s->mass; /* both halves of the foundation */
        vx -= s->step * 2 * tangential * s->mobility;
        loading = loading && vz > 0;
        steps++;
    }
    free(e);
    return (struct si_result){-vz / s->speed, -vx / s->sliding, steps};
}

#endif
