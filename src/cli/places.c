/* What a run reads and writes.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "places.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "output.h"

struct place_item {
    char *name, *path; /* for messages */
    bool written;
    bool known; /* false: there can be no such file, and whoever opens it says why */
    struct rst_place place;
    struct stat folder; /* of what does not exist */
};

static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void find_standard(struct place_item *item)
{
    item->place = (struct rst_place){.descriptor = item->written ? STDOUT_FILENO : STDIN_FILENO};
    item->known = fstat(item->place.descriptor, &item->place.status) == 0;
    item->place.exists = item->known;
}

static void find_file(struct place_item *item, const char *path)
{
    if (rst_place_find(path, &item->place) != 0) return;
    char *folder = item->place.exists ? NULL : rst_folder_of(item->place.target);
    item->known = item->place.exists || (folder && stat(folder, &item->folder) == 0);
    free(folder);
}

static void add(struct places *places, const char *name, const char *path, bool written)
{
    if (places->count == places->capacity) {
        const size_t capacity = 2 * places->capacity + 16;
        struct place_item *larger = allocate(capacity, sizeof *larger);
        if (places->count) memcpy(larger, places->items, places->count * sizeof *larger);
        free(places->items);
        places->items = larger;
        places->capacity = capacity;
    }
    struct place_item *item = &places->items[places->count++];
    memset(item, 0, sizeof *item);
    item->name = copy_of(name);
    item->path = copy_of(path ? path : "-");
    item->written = written;
    if (output_is_standard(path))
        find_standard(item);
    else
        find_file(item, path);
}

void places_read(struct places *places, const char *name, const char *path)
{
    if (path) add(places, name, path, false);
}

void places_read_materials(struct places *places, const struct materials *materials)
{
    for (const struct material_entry *entry = materials->first; entry; entry = entry->next) {
        places_read(places, "material", entry->path);
        places_read(places, "prony_csv", entry->series);
    }
}

void places_write(struct places *places, const char *option, const char *path)
{
    add(places, option, path, true);
}

void places_write_beside(struct places *places, const char *option, const char *path, const char *suffix)
{
    char name[64];
    if (output_is_stream(path)) return;
    char *file = path_beside(path, suffix);
    snprintf(name, sizeof name, "%s (%s)", option, suffix);
    add(places, name, file, true);
    free(file);
}

static bool same(const struct place_item *a, const struct place_item *b)
{
    if (!a->known || !b->known || a->place.exists != b->place.exists) return false;
    if (a->place.descriptor >= 0 && a->place.descriptor == b->place.descriptor) return true;
    const struct stat *one = a->place.exists ? &a->place.status : &a->folder;
    const struct stat *two = b->place.exists ? &b->place.status : &b->folder;
    if (one->st_dev != two->st_dev || one->st_ino != two->st_ino) return false;
    return a->place.exists ? S_ISREG(one->st_mode) : strcmp(base_of(a->place.target), base_of(b->place.target)) == 0;
}

static bool refuse_pair(const struct place_item *output, const struct place_item *other, struct reason *why)
{
    if (!other->written)
        return refuse(why, "%s = %.120s: is an input of this run, %s %.120s, and would be overwritten", output->name,
                      output->path, other->name, other->path);
    if (output->place.descriptor == STDOUT_FILENO && other->place.descriptor == STDOUT_FILENO)
        return refuse(why, "%s and %s are both standard output: at most one can be", output->name, other->name);
    return refuse(why, "%s and %s are the same file, %.200s", output->name, other->name, output->path);
}

bool places_check(struct places *places, struct reason *why)
{
    bool good = true;
    for (size_t i = 0; i < places->count; i++)
        for (size_t k = 0; k < places->count && good; k++) {
            const struct place_item *output = &places->items[i], *other = &places->items[k];
            if (output->written && (k < i || !other->written) && same(output, other))
                good = refuse_pair(output, other, why);
        }
    for (size_t i = 0; i < places->count; i++) {
        free(places->items[i].name);
        free(places->items[i].path);
        rst_place_release(&places->items[i].place);
    }
    free(places->items);
    memset(places, 0, sizeof *places);
    return good;
}

bool places_check_settings(const struct settings *settings, const struct materials *materials, struct reason *why)
{
    struct places places = {0};
    char *const *text = settings->text;
    places_read(&places, "--input", text[TEXT_INPUT]);
    places_read(&places, "--material", text[TEXT_MATERIAL]);
    places_read(&places, "--partner", settings->values.partner);
    places_read_materials(&places, materials);
    char *list = text[TEXT_JOIN] ? copy_of(text[TEXT_JOIN]) : NULL, *rest = NULL;
    for (char *path = list ? strtok_r(list, ",", &rest) : NULL; path; path = strtok_r(NULL, ",", &rest))
        places_read(&places, "--join", path);
    free(list);
    places_write(&places, "--output", text[TEXT_OUTPUT]);
    places_write_beside(&places, "--output", text[TEXT_OUTPUT], ".meta.json");
    if (text[TEXT_INPUT] || text[TEXT_GRID]) {
        places_write_beside(&places, "--output", text[TEXT_OUTPUT], ".partial");
        places_write_beside(&places, "--output", text[TEXT_OUTPUT], ".partial.json");
    }
    if (text[TEXT_EVENTS]) {
        places_write(&places, "--events", text[TEXT_EVENTS]);
        places_write_beside(&places, "--events", text[TEXT_EVENTS], ".meta.json");
    }
    if (text[TEXT_FIGURE]) places_write(&places, "--figure", text[TEXT_FIGURE]);
    if (text[TEXT_FIELDS]) places_write(&places, "--fields", text[TEXT_FIELDS]);
    return places_check(&places, why);
}
