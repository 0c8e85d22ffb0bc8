/* The materials of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The other file that was read for this one: the library tells a fingerprint, but no name. */
static char *series_of(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return NULL; /* a pipe can be read once */
    json_t *root = json_load_file(path, 0, NULL);
    const char *name = json_string_value(json_object_get(root, "prony_csv")), *slash = strrchr(path, '/');
    char *series = NULL;
    if (name) {
        const size_t folder = slash && *name != '/' ? (size_t)(slash - path) + 1 : 0;
        series = allocate(folder + strlen(name) + 1, 1);
        memcpy(series, path, folder);
        strcpy(series + folder, name);
    }
    json_decref(root);
    return series;
}

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
    entry->series = series_of(path);
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

const restitute_material *materials_pair(struct materials *materials, const struct material_entry *entry,
                                         const char *partner, struct reason *why)
{
    const struct material_entry *second = materials_get(materials, partner, why);
    if (!second) return NULL;
    for (struct material_pair *known = materials->pairs; known; known = known->next)
        if (known->first == entry && known->second == second) return known->material;
    struct material_pair *pair = allocate(1, sizeof *pair);
    restitute_error error;
    if (restitute_material_pair(entry->material, second->material, &pair->material, &error) < 0) {
        free(pair);
        refuse(why, "%.100s with %.100s: %s", entry->path, partner, error.message);
        return NULL;
    }
    pair->first = entry;
    pair->second = second;
    pair->next = materials->pairs;
    materials->pairs = pair;
    return pair->material;
}

void materials_release(struct materials *materials)
{
    while (materials->pairs) {
        struct material_pair *pair = materials->pairs;
        materials->pairs = pair->next;
        restitute_material_destroy(pair->material);
        free(pair);
    }
    while (materials->first) {
        struct material_entry *entry = materials->first;
        materials->first = entry->next;
        restitute_material_destroy(entry->material);
        free(entry->path);
        free(entry->series);
        free(entry);
    }
}
