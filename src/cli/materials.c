/* The materials of a run.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "materials.h"

#include <jansson.h>
#include <search.h>
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

static int by_path(const void *left, const void *right)
{
    return strcmp(((const struct material_entry *)left)->path, ((const struct material_entry *)right)->path);
}

static int by_members(const void *left, const void *right)
{
    const struct material_pair *a = left, *b = right;
    const int order = strcmp(a->first->path, b->first->path);
    return order ? order : strcmp(a->second->path, b->second->path);
}

/* What the tree has under this key; NULL: nothing. */
static void *known(const void *key, void **tree, int (*order)(const void *, const void *))
{
    void **node = tfind(key, tree, order);
    return node ? *node : NULL;
}

static void keep(const void *item, void **tree, int (*order)(const void *, const void *))
{
    if (!tsearch(item, tree, order)) out_of_memory();
}

static struct material_entry *read_entry(const char *path)
{
    struct material_entry *entry = allocate(1, sizeof *entry);
    restitute_error error;
    entry->path = copy_of(path);
    restitute_material_info_init(&entry->info);
    if (restitute_material_read(path, &entry->material, &entry->info, &error) < 0) {
        entry->material = NULL;
        refuse(&entry->why, "%s", error.message);
    }
    entry->series = series_of(path);
    return entry;
}

const struct material_entry *materials_get(struct materials *materials, const char *path, struct reason *why)
{
    const struct material_entry key = {.path = (char *)path};
    struct material_entry *entry = known(&key, &materials->by_path, by_path);
    if (!entry) {
        entry = read_entry(path);
        entry->next = materials->first;
        materials->first = entry;
        keep(entry, &materials->by_path, by_path);
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
    const struct material_pair key = {.first = entry, .second = second};
    struct material_pair *pair = known(&key, &materials->by_members, by_members);
    if (pair) return pair->material;
    pair = allocate(1, sizeof *pair);
    restitute_error error;
    if (restitute_material_effective(entry->material, second->material, &pair->material, &error) < 0) {
        free(pair);
        refuse(why, "%.100s with %.100s: %s", entry->path, partner, error.message);
        return NULL;
    }
    pair->first = entry;
    pair->second = second;
    pair->next = materials->pairs;
    materials->pairs = pair;
    keep(pair, &materials->by_members, by_members);
    return pair->material;
}

static int shift_times(const struct solid_numbers *numbers, restitute_material **material, restitute_error *error)
{
    const restitute_material *base = numbers->base->material;
    const size_t terms = restitute_material_terms(base);
    double *tau = allocate(2 * terms, sizeof *tau), equilibrium, viscosity;
    restitute_material_series(base, &equilibrium, &viscosity, tau, tau + terms, NULL);
    for (size_t i = 0; i < terms; i++)
        tau[i] *= numbers->shift;
    const int status = restitute_material_prony(equilibrium, viscosity * numbers->shift, terms, tau, tau + terms,
                                                restitute_material_poisson_ratio(base), material, error);
    free(tau);
    return status;
}

static int make_solid(const struct solid_numbers *n, restitute_material **material, restitute_error *error)
{
    const double viscosity = n->viscosity * n->shift;
    if (n->base) return shift_times(n, material, error);
    if (viscosity == 0) return restitute_material_elastic(n->modulus1, n->poisson, material, error);
    if (n->modulus1 == 0) return restitute_material_maxwell(n->modulus2, viscosity, n->poisson, material, error);
    if (n->modulus2 > 1e300)
        return restitute_material_kelvin_voigt(n->modulus1, viscosity, n->poisson, material, error);
    return restitute_material_standard_solid(n->modulus1, n->modulus2, viscosity, n->poisson, material, error);
}

/* Rows that follow each other often have the same solid; of those made the latest alone is looked at. */
const struct material_entry *materials_make(struct materials *materials, const struct solid_numbers *numbers,
                                            struct reason *why)
{
    restitute_error error;
    struct material_made *made = materials->made;
    if (made && memcmp(&made->numbers, numbers, sizeof *numbers) == 0) return &made->entry;
    made = allocate(1, sizeof *made);
    if (make_solid(numbers, &made->entry.material, &error) < 0) {
        free(made);
        refuse(why, "%s", error.message);
        return NULL;
    }
    restitute_material_info_init(&made->entry.info);
    if (numbers->base)
        made->entry.info = numbers->base->info;
    else
        strcpy(made->entry.info.name, "Solid of given moduli");
    made->numbers = *numbers;
    made->next = materials->made;
    materials->made = made;
    return &made->entry;
}

void materials_release(struct materials *materials)
{
    while (materials->made) {
        struct material_made *made = materials->made;
        materials->made = made->next;
        restitute_material_destroy(made->entry.material);
        free(made);
    }
    while (materials->pairs) {
        struct material_pair *pair = materials->pairs;
        materials->pairs = pair->next;
        tdelete(pair, &materials->by_members, by_members);
        restitute_material_destroy(pair->material);
        free(pair);
    }
    while (materials->first) {
        struct material_entry *entry = materials->first;
        materials->first = entry->next;
        tdelete(entry, &materials->by_path, by_path);
        restitute_material_destroy(entry->material);
        free(entry->path);
        free(entry->series);
        free(entry);
    }
}
