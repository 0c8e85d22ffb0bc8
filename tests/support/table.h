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
    PREPARED(scene, scene);
    restitute_error error;
    const int status = gamma > 0 ? restitute_material_standard_solid(1e6, 1e6 / gamma, 300, 0.5, material, &error)
                                 : restitute_material_kelvin_voigt(1e6, 300, 0.5, material, &error);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    scene.material = *material;
    scene.radius1 = 0.005;
    scene.mass1 = 0.004;
    scene.friction = 0.3;
    return scene;
}

static inline restitute_table *table_of(const restitute_scene *scene, double low, double high, double tolerance)
{
    PREPARED(table_options, options);
    restitute_table *table = NULL;
    restitute_error error;
    options.speed[0] = low;
    options.speed[1] = high;
    options.tolerance = tolerance;
    CHECK(restitute_table_build(scene, &options, &table, &error) == RESTITUTE_OK, "%s", error.message);
    return table;
}

/* 0.01 to 10 m/s, to 1e-4. */
static inline restitute_table_options options_of(int threads)
{
    PREPARED(table_options, options);
    options.speed[0] = 1e-2, options.speed[1] = 10;
    options.tolerance = 1e-4;
    options.threads = threads;
    return options;
}

static inline restitute_table *built(const restitute_scene *scene, const restitute_table_options *options)
{
    restitute_table *table = NULL;
    restitute_error error;
    CHECK(restitute_table_build(scene, options, &table, &error) >= 0, "%s", error.message);
    return table;
}

static inline restitute_table_info describe(const restitute_table *table)
{
    PREPARED(table_info, info);
    CHECK(restitute_table_describe(table, &info, NULL) == RESTITUTE_OK, "info");
    return info;
}

struct pair {
    double ez, ex;
};

/* Of a contact; NULL: the table's own. */
static inline struct pair look_up_for(const restitute_table *table, const restitute_table_contact *contact, double v_n,
                                      double v_t)
{
    struct pair pair;
    restitute_error error;
    CHECK(restitute_table_pair(table, contact, v_n, v_t, &pair.ez, &pair.ex, &error) == RESTITUTE_OK, "%s",
          error.message);
    return pair;
}

static inline struct pair look_up(const restitute_table *table, double v_n, double v_t)
{
    return look_up_for(table, NULL, v_n, v_t);
}

static inline restitute_table_data data_of(const restitute_table *table)
{
    PREPARED(table_data, data);
    CHECK(restitute_table_data_get(table, &data, NULL) == RESTITUTE_OK, "data");
    return data;
}

/* Places of psi: both panels have their own at psi = 1. */
static inline int64_t places_of(const restitute_table_data *d)
{
    return d->stick_cells + d->slip_cells + 2;
}

/* psi v_n/|v_t| of ball_on: (2 - 2 nu)/(2 - nu)/mu with nu = 1/2, mu = 0.3. */
#define PSI_FACTOR (2.0 / 3 / 0.3)

#endif
