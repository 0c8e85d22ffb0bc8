/* Synthetic drop tests for the tests of the component fit.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_FIT_H
#define TEST_FIT_H

#include <restitute/fit.h>
#include <string.h>

#include "random.h"
#include "check.h"
#include "prepared.h"

/* A steel ball of 10 mm at speeds even in the logarithm, not yet measured. */
static inline void drops(size_t n, double low, double high, restitute_scene *scenes, restitute_fit_point *points)
{
    for (size_t i = 0; i < n; i++) {
        restitute_fit_point_init(&points[i]);
        restitute_scene_init(&scenes[i]);
        points[i].scene = &scenes[i];
        scenes[i].radius1 = 0.005, scenes[i].mass1 = 0.004;
        scenes[i].normal_speed = low * pow(high / low, n > 1 ? (double)i / (double)(n - 1) : 0);
    }
}

static inline double gauss(uint64_t *state)
{
    const double u = random_in(state, 1e-300, 1), v = random_in(state, 0, 1);
    return sqrt(-2 * log(u)) * cos(6.283185307179586 * v);
}

/* What the material gives, ten times as precise as the fit solves; noise is absolute in e, relative
 * in time. */
static inline void measure(const restitute_material *material, size_t n, restitute_fit_point *points, double noise,
                           int with_time, int with_ex, uint64_t seed)
{
    PREPARED(options, options);
    restitute_solver *solver;
    options.method = restitute_method_sync(), options.tolerance = 1e-7;
    assert_int_equal(restitute_solver_create(&options, &solver, NULL), RESTITUTE_OK);
    for (size_t i = 0; i < n; i++) {
        restitute_scene scene = *points[i].scene;
        PREPARED(result, r);
        restitute_material *pair = NULL;
        if (scene.material) restitute_material_effective(material, scene.material, &pair, NULL);
        scene.material = pair ? pair : material;
        if (isnan(scene.friction)) scene.friction = 0.3;
        assert_true(restitute_solve_scene(solver, &scene, &r, NULL, NULL, NULL) >= 0);
        restitute_material_destroy(pair);
        points[i].ez = fmin(1, fmax(0, r.ez + noise * gauss(&seed)));
        if (with_time) points[i].contact_time = r.contact_time * (1 + noise * gauss(&seed));
        if (with_ex) points[i].ex = fmin(1, fmax(-1, r.ex + noise * gauss(&seed)));
    }
    restitute_solver_destroy(solver);
}

static inline restitute_material *standard_solid(double g1, double g2, double eta)
{
    restitute_material *material = NULL;
    assert_int_equal(restitute_material_standard_solid(g1, g2, eta, 0.5, &material, NULL), RESTITUTE_OK);
    return material;
}

static inline restitute_material *kelvin_voigt(double g1, double eta)
{
    restitute_material *material = NULL;
    assert_int_equal(restitute_material_kelvin_voigt(g1, eta, 0.5, &material, NULL), RESTITUTE_OK);
    return material;
}

static inline restitute_fit_options fit_options(int model)
{
    PREPARED(fit_options, options);
    options.model = model;
    return options;
}

/* A fit that must be done; its solid is the caller's. */
static inline restitute_fit_result fitted(size_t n, const restitute_fit_point *points,
                                          const restitute_fit_options *options)
{
    PREPARED(fit_result, result);
    restitute_error error;
    CHECK(restitute_fit(n, points, options, &result, &error) == RESTITUTE_OK, "%s", error.message);
    return result;
}

#endif
