/* The fixed scenes of the report, with their reference values.
 *
 *   truth   the rows of impact_truth.csv, named truth-1, truth-2, ... in their order
 *   prony   the rows of prony_truth.csv; the physical one is put into dimensionless form
 *   stiff   gamma = 1e-6 (all but Kelvin-Voigt), delta1 = 1e-6, 1e-3, 1, 1e3, chi = 7/6, psi = 0.5 and 1.5; reference:
 *           computed in the run by the finest method there is
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_SCENES_H
#define BENCH_SCENES_H

#include <restitute/restitute.h>

#include "paper.h"

enum bench_set { BENCH_TRUTH = 1, BENCH_STIFF = 2, BENCH_PRONY = 4 };

enum { BENCH_SETS = 3, BENCH_TERMS = 32 };

/* Names of the sets, the bits in order. */
extern const char *const bench_set_names[BENCH_SETS];

struct bench_scene {
    char name[48];
    enum bench_set set;
    double chi, psi;
    double delta1, gamma;      /* NaN for the set prony */
    restitute_material *solid; /* of the set prony, dimensionless; else NULL */
    double g_inf, eta;         /* the solid as the paper's algorithm takes it, in units of G_r and T */
    size_t n_terms;
    double g[BENCH_TERMS], tau[BENCH_TERMS];
    int has_reference; /* the four values below are known */
    double ez, ex;
    double error_ez, error_ex;    /* of the reference itself */
    char reference[64];           /* where it is from */
    const char *reference_method; /* name, if it was computed in this run; else NULL */
    double reference_tolerance;
    double radius, contact_time; /* a_el and T: the largest contact radius, which the paper's algorithm is told */
};

struct bench_scenes {
    struct bench_scene *scenes;
    size_t count;
};

/* All scenes of the sets; quick: five rows of truth, two of stiff, one of prony. On failure nothing is left behind. */
int bench_scenes_create(unsigned sets, int quick, struct bench_scenes *scenes, restitute_error *error);
void bench_scenes_destroy(struct bench_scenes *scenes);

/* A scene of (chi, psi, delta1, gamma) without reference. */
void bench_scene_make(const char *name, enum bench_set set, double chi, double psi, double delta1, double gamma,
                      struct bench_scene *scene);

/* Solve once for radius and contact time, and for the reference if the scene has none. `tolerance` is that of the
 * reference; `max_work` what it may cost. Negative status: refused, no reference. */
int bench_scene_complete(struct bench_scene *scene, double tolerance, double max_work, restitute_error *error);

restitute_impact bench_scene_impact(const struct bench_scene *scene);
struct paper_problem bench_scene_paper(const struct bench_scene *scene);

/* The larger of the errors of the reference itself. */
double bench_scene_uncertainty(const struct bench_scene *scene);

#endif
