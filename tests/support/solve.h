/* Short ways to one solved impact.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SOLVE_H
#define TEST_SOLVE_H

#include <string.h>

#include <restitute/restitute.h>

#include "check.h"
#include "prepared.h"

/* sqrt(32/15): theta = this times delta1 (23). */
#define THETA_OF_DELTA1 1.4605934866804429

struct solution {
    int status;
    restitute_result result;
    restitute_ledger ledger;
};

static inline restitute_impact impact_of(double chi, double psi, double delta1, double gamma)
{
    PREPARED(impact, impact);
    impact.chi = chi;
    impact.psi = psi;
    impact.delta1 = delta1;
    impact.gamma = gamma;
    return impact;
}

/* An impact on any solid, in units of its reference modulus and time. */
static inline restitute_impact impact_on(const restitute_material *solid, double chi, double psi)
{
    restitute_impact impact = impact_of(chi, psi, 0, INFINITY);
    impact.material = solid;
    return impact;
}

/* The defaults, but no limit of time: builds with sanitizers are slow. */
static inline restitute_options default_options(void)
{
    PREPARED(options, options);
    options.time_limit = INFINITY;
    return options;
}

static inline restitute_options to_tolerance(double tolerance)
{
    restitute_options options = default_options();
    options.tolerance = tolerance;
    return options;
}

/* Given numbers of elements and step; the tolerance then only decides about the merging of
 * relaxation times. */
static inline restitute_options as_told(int64_t elements, double time_step)
{
    restitute_options options = default_options();
    options.elements = elements;
    options.time_step = time_step;
    return options;
}

static inline restitute_solver *make_solver(const restitute_options *options)
{
    restitute_solver *solver;
    restitute_error error;
    CHECK(restitute_solver_create(options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    return solver;
}

static inline struct solution solve_with(restitute_options options, restitute_impact impact, int keeps_ledger)
{
    restitute_solver *solver = make_solver(&options);
    restitute_error error;
    struct solution s;
    restitute_result_init(&s.result);
    restitute_ledger_init(&s.ledger);
    s.status = restitute_solve(solver, &impact, &s.result, keeps_ledger ? &s.ledger : NULL, NULL, &error);
    restitute_solver_destroy(solver);
    CHECK(s.status >= 0, "chi %.17g psi %.17g delta1 %.17g gamma %.17g: %s", impact.chi, impact.psi, impact.delta1,
          impact.gamma, error.message);
    return s;
}

/* What is said of an impact with little work whose ledger is off for that reason. */
static inline restitute_ledger ledger_with_remark(restitute_options options, restitute_impact impact,
                                                  const char *remark)
{
    restitute_solver *solver = make_solver(&options);
    restitute_error error;
    PREPARED(ledger, ledger);
    const int status = restitute_solve(solver, &impact, NULL, &ledger, NULL, &error);
    CHECK(status == RESTITUTE_OK && strstr(error.message, remark), "%d: %s", status, error.message);
    restitute_solver_destroy(solver);
    return ledger;
}

/* Solve; it must not fail. */
static inline struct solution solve_impact(restitute_options options, restitute_impact impact)
{
    return solve_with(options, impact, 1);
}

/* Without the ledger, which does not change the pair and may take as long as a hundred. */
static inline struct solution solve_pair(restitute_options options, restitute_impact impact)
{
    return solve_with(options, impact, 0);
}

static inline struct solution solve_scene(restitute_options options, const restitute_scene *scene)
{
    restitute_solver *solver = make_solver(&options);
    restitute_error error;
    struct solution s;
    restitute_result_init(&s.result);
    restitute_ledger_init(&s.ledger);
    s.status = restitute_solve_scene(solver, scene, &s.result, &s.ledger, NULL, &error);
    restitute_solver_destroy(solver);
    CHECK(s.status >= 0, "v %.17g m/s: %s", scene->normal_speed, error.message);
    return s;
}

/* A Prony solid that must be valid. */
static inline restitute_material *solid_of(double g_inf, double eta, size_t n_terms, const double *tau, const double *g)
{
    restitute_material *material;
    restitute_error error;
    CHECK(restitute_material_prony(g_inf, eta, n_terms, tau, g, 0.5, &material, &error) == RESTITUTE_OK, "%s",
          error.message);
    return material;
}

/* Like `result`, with elements and step `factor` times finer. */
static inline restitute_options finer(const restitute_result *result, double factor)
{
    return as_told((int64_t)lround((double)result->elements * factor), result->time_step / factor);
}

#endif
