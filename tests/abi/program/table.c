/* The calls of table.h and of table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/table.h>

#include "caller.h"
#ifdef RESTITUTE_WITH_TABLE_FILES
#include <restitute/table_files.h>
#endif

enum { PAIRS = 2 };

static void finished(void *data, size_t done, size_t count)
{
    (void)count;
    *(size_t *)data = done;
}

static restitute_table *build(const restitute_material *material)
{
    restitute_table *table, *same;
    size_t progress = 0;
    ONE(scene, scene);
    ONE(table_options, options);
    ball(scene, material);
    options->tolerance = 1e-2, options->time_limit = INFINITY, options->speed[0] = 0.01, options->speed[1] = 1;
    DONE(restitute_table_build(scene, options, &table, &error));
    DONE(restitute_table_build_many(1, &material, scene, options, finished, &progress, &same, &error));
    SHOW((double)progress);
    restitute_table_destroy(same);
    return table;
}

static void look_up(const restitute_table *table, const restitute_material *material)
{
    const double normal[PAIRS] = {0.1, 0.2}, tangential[PAIRS] = {0.05, 0.3};
    double ez[PAIRS], ex[PAIRS];
    int flags;
    ONE(scene, scene);
    ONE(table_contact, contact);
    ONE(body, first);
    ONE(body, second);
    ball(scene, material);
    scene->friction = 0.2;
    DONE(restitute_table_contact_set(table, scene, contact, &error));
    SHOW(contact->speed_factor, contact->psi_factor, contact->radius, contact->mass);
    DONE(restitute_table_pair(table, contact, 0.1, 0.05, ez, ex, &error));
    SHOW(ez[0], ex[0]);
    DONE(restitute_table_pair_many(table, contact, PAIRS, normal, tangential, ez, ex, &error));
    SHOW(ez[0], ex[0], ez[1], ex[1]);
    second->radius = INFINITY, second->normal[2] = 1;
    first->radius = 0.01, first->mass = 4e-3, first->position[2] = 0.01;
    first->velocity[0] = 0.1, first->velocity[2] = -0.2;
    DONE(restitute_table_collide(table, contact, first, second, ez, ex, &error));
    SHOW(ez[0], ex[0], first->velocity[0], first->velocity[2], first->spin[1]);
    DONE(restitute_table_flags(table, contact, 0.1, 0.05, &flags, &error));
    SHOW(flags);
}

static void describe(const restitute_table *table)
{
    double ez, ex;
    restitute_table *copy;
    ONE(table_info, info);
    ONE(table_data, data);
    DONE(restitute_table_describe(table, info, &error));
    SHOW(info->speed[1], info->chi, info->delta1[0], (double)info->impacts, (double)info->slip_cells);
    TEXT(info->version);
    DONE(restitute_table_data_get(table, data, &error));
    SHOW(data->low, data->psi_factor, data->relaxation_time[0], data->ex[0]);
    DONE(restitute_table_create(data, &copy, &error));
    DONE(restitute_table_pair(copy, NULL, 0.1, 0.05, &ez, &ex, &error));
    SHOW(ez, ex);
    restitute_table_destroy(copy);
}

void call_table(void)
{
    restitute_material *material = rubber();
    restitute_table *table = build(material);
    look_up(table, material);
    describe(table);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

#ifdef RESTITUTE_WITH_TABLE_FILES
void call_table_files(void)
{
    double ez, ex;
    restitute_material *material = rubber();
    restitute_table *table = build(material), *copy;
    DONE(restitute_table_write(table, "old_program.h5", &error));
    DONE(restitute_table_read("old_program.h5", &copy, &error));
    DONE(restitute_table_pair(copy, NULL, 0.1, 0.05, &ez, &ex, &error));
    SHOW(ez, ex);
    restitute_table_destroy(copy);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}
#endif
