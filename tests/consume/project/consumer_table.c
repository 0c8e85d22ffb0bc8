/* A user's program that builds a table in memory and looks up in it. Exit status 0 if the pair is
 * one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/table.h>

int main(void)
{
    restitute_material *rubber = NULL;
    restitute_scene scene;
    restitute_table_options options;
    restitute_table *table = NULL;
    double ez = 0, ex = 0;
    restitute_error error;
    restitute_scene_init(&scene);
    restitute_table_options_init(&options);
    options.speed[0] = 0.1, options.speed[1] = 1, options.tolerance = 1e-2;
    if (restitute_material_standard_solid(1e6, 1e6, 300, 0.5, &rubber, &error) != RESTITUTE_OK) return 1;
    scene.material = rubber, scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3;
    if (restitute_table_build(&scene, &options, &table, &error) != RESTITUTE_OK ||
        restitute_table_pair(table, NULL, 0.5, 0.2, &ez, &ex, &error) != RESTITUTE_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("ez = %g, ex = %g\n", ez, ex);
    restitute_table_destroy(table);
    restitute_material_destroy(rubber);
    return !(ez > 0 && ez < 1 && ex > -1 && ex < 1);
}
