/* Contacts that the tests of tables share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_TABLE_H
#define TEST_TABLE_H

#include <restitute/table.h>

#include "random.h"
#include "solve.h"

/* A steel ball of 5 mm on a standard solid, or with gamma = 0 a Kelvin-Voigt one: delta1 = 0.05 to
 * 0.7 over six decades of speed. */
static inline restitute_scene ball_on(double gamma, restitute_material **material)
{
    restitute_scene scene;
    restitute_error error;
    const int status = gamma > 0 ? restitute_material_standard_solid(1e6, 1e6 / gamma, 300, 0.5, material, &error)
                                 : restitute_material_kelvin_voigt(1e6, 300, 0.5, material, &error);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    restitute_scene_init(&scene);
    scene.material = *material;
    scene.radius1 = 0.005;
    scene.mass1 = 0.004;
    scene.friction = 0.3;
    return scene;
}

static inline restitute_table *table_of(const restitute_scene *scene, double low, double high, double tolerance)
{
    restitute_table_options options;
    restitute_table *table = NULL;
    restitute_error error;
    restitute_table_options_init(&options);
    options.speed[0] = low;
    options.speed[1] = high;
    options.tolerance = tolerance;
    CHECK(restitute_table_build(scene, &options, &table, &error) == RESTITUTE_OK, "%s", error.message);
    return table;
}

static inline restitute_table_value look_up(const restitute_table *table, double v_n, double v_t)
{
    restitute_table_value pair;
    CHECK(restitute_table_pair(table, v_n, v_t, &pair) == RESTITUTE_OK, "%g, %g", v_n, v_t);
    return pair;
}

/* psi v_n/|v_t| of ball_on: (2 - 2 nu)/(2 - nu)/mu with nu = 1/2, mu = 0.3. */
#define PSI_FACTOR (2.0 / 3 / 0.3)

#endif
