/* The materials of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

#include <stdlib.h>
#include <string.h>

static struct material_entry *read_entry(const char *path)
{
    struct material_entry *entry = allocate(1, sizeof *entry);
    restitute_error error;
    entry->path = copy_of(path);
    restitute_material_info_init(&entry->info);
    if (restitute_material_read_info(path, &entry->material, &entry->info, &error) < 0) {
        entry->material = NULL;
        refuse(&entry->why, "%s", error.message);
    }
    return entry;
}

const struct material_entry *materials_get(struct materials *materials, const char *path, struct reason *why)
{
    struct material_entry *entry = materials->first;
    while (entry && strcmp(entry->path, path) != 0)
        entry = entry->next;
    if (!entry) {
        entry = read_entry(path);
        entry->next = materials->first;
        materials->first = entry;
    }
    if (entry->material) return entry;
    *why = entry->why;
    return NULL;
}

void materials_release(struct materials *materials)
{
    while (materials->first) {
        struct material_entry *entry = materials->first;
        materials->first = entry->next;
        restitute_material_destroy(entry->material);
        free(entry->path);
        free(entry);
    }
}
