/* Materials by name: files in one folder, that of the installation or of an environment variable.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE /* dladdr */
#include <dirent.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/files.h>

#include "base/report.h"

#ifndef RESTITUTE_LIBRARY_TO_MATERIALS /* the build says it where folders have other names */
#define RESTITUTE_LIBRARY_TO_MATERIALS "../share/restitute/materials"
#endif

enum { LONGEST_PATH = 4096, LONGEST_NAME = 64 };

/* The folder beside this library, wherever the installed tree was moved to. In a static library it
 * is that beside the program. */
static int installed_folder(char *folder, size_t size)
{
    Dl_info place;
    if (!dladdr((const void *)(uintptr_t)&restitute_material_by_name, &place) || !place.dli_fname) return 0;
    const char *slash = strrchr(place.dli_fname, '/');
    const int length = slash ? (int)(slash - place.dli_fname) : 1;
    const int written =
        snprintf(folder, size, "%.*s/%s", length, slash ? place.dli_fname : ".", RESTITUTE_LIBRARY_TO_MATERIALS);
    return written > 0 && (size_t)written < size;
}

static int find_folder(char *folder, size_t size, restitute_error *error)
{
    const char *given = getenv("RESTITUTE_MATERIALS");
    if (given && *given) {
        const int written = snprintf(folder, size, "%s", given);
        if (written > 0 && (size_t)written < size) return RESTITUTE_OK;
        return rst_report(error, RESTITUTE_ERROR_FILE, "RESTITUTE_MATERIALS: its %zu bytes are too many for a path",
                          strlen(given));
    }
    if (installed_folder(folder, size)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_FILE,
                      "the folder of the materials is not known: set the environment variable RESTITUTE_MATERIALS");
}

static int is_control(char letter)
{
    return (unsigned char)letter < ' ' || letter == 127;
}

static int has_controls(const char *text)
{
    while (*text && !is_control(*text))
        text++;
    return *text != '\0';
}

/* The name of a material that a file stands for; 0: it is none. */
static int name_of_file(const char *file, char name[LONGEST_NAME])
{
    const char *dot = strrchr(file, '.');
    if (has_controls(file) || !dot || dot == file || strcmp(dot, ".json") != 0 || dot - file >= LONGEST_NAME) return 0;
    memcpy(name, file, (size_t)(dot - file));
    name[dot - file] = '\0';
    return 1;
}

static int by_text(const void *a, const void *b)
{
    return strcmp(a, b);
}

struct names {
    char (*name)[LONGEST_NAME];
    size_t count;
};

/* All names in a folder, sorted; the caller frees them. */
static int list_names(const char *folder, struct names *names, restitute_error *error)
{
    *names = (struct names){NULL, 0};
    DIR *open = opendir(folder);
    if (!open)
        return rst_report(error, RESTITUTE_ERROR_FILE,
                          "no folder of materials at %.96s: the environment variable RESTITUTE_MATERIALS can name one",
                          folder);
    char name[LONGEST_NAME];
    for (const struct dirent *entry = readdir(open); entry; entry = readdir(open)) {
        if (!name_of_file(entry->d_name, name)) continue;
        char(*more)[LONGEST_NAME] = realloc(names->name, (names->count + 1) * sizeof *more);
        if (!more) {
            closedir(open);
            free(names->name);
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "no memory for the names of materials");
        }
        names->name = more;
        memcpy(names->name[names->count++], name, sizeof name);
    }
    closedir(open);
    if (names->count) qsort(names->name, names->count, sizeof *names->name, by_text);
    return RESTITUTE_OK;
}

/* How many letters must be changed, added or left out (Levenshtein), of the first LONGEST_NAME. */
static size_t distance(const char *a, const char *b)
{
    size_t row[LONGEST_NAME + 1];
    const size_t length = strnlen(b, LONGEST_NAME);
    for (size_t j = 0; j <= length; j++)
        row[j] = j;
    for (size_t i = 1; i <= strnlen(a, LONGEST_NAME); i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= length; j++) {
            const size_t changed = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            const size_t one_more = 1 + (row[j] < row[j - 1] ? row[j] : row[j - 1]);
            row[j] = changed < one_more ? changed : one_more;
        }
    }
    return row[length];
}

/* The name that up to a third of its letters make of `word`; NULL: none. */
static const char *nearest(const struct names *names, const char *word)
{
    const char *found = NULL;
    size_t least = strnlen(word, LONGEST_NAME) / 3 + 1;
    for (size_t i = 0; i < names->count; i++)
        if (distance(word, names->name[i]) < least) {
            found = names->name[i];
            least = distance(word, found);
        }
    return found;
}

/* No file that is listed has such a name. */
static int refuse_odd_name(const char *name, restitute_error *error)
{
    char shown[41];
    snprintf(shown, sizeof shown, "%s", name);
    for (char *letter = shown; *letter; letter++)
        if (is_control(*letter)) *letter = '?';
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "material = \"%s%s\": must have 1 to %d bytes, none of them a control character", shown,
                      strlen(name) < sizeof shown ? "" : "..", LONGEST_NAME - 1);
}

/* As many of the known names as the message has room for. */
static int refuse_name(const struct names *names, const char *name, restitute_error *error)
{
    char text[sizeof error->message];
    const char *near = nearest(names, name);
    size_t length = (size_t)snprintf(text, sizeof text, "material = \"%s\": %s%s%smust be one of", name,
                                     near ? "did you mean " : "", near ? near : "", near ? "? " : "");
    for (size_t i = 0; i < names->count; i++) {
        const size_t more = strlen(names->name[i]) + strlen(" ,");
        const int fits = length + more + strlen(" ..") < sizeof text;
        snprintf(text + length, sizeof text - length, " %s%s", fits ? names->name[i] : "..",
                 fits && i + 1 < names->count ? "," : "");
        if (!fits) break;
        length = strlen(text);
    }
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s", text);
}

int restitute_material_by_name(const char *name, restitute_material **material, restitute_material_info *info,
                               restitute_error *error)
{
    char folder[LONGEST_PATH], path[LONGEST_PATH + LONGEST_NAME + 8];
    struct names names;
    if (!name || !material) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", name ? "material" : "name");
    if (strlen(name) >= LONGEST_NAME || has_controls(name)) return refuse_odd_name(name, error);
    int status = find_folder(folder, sizeof folder, error);
    if (status == RESTITUTE_OK) status = list_names(folder, &names, error);
    if (status != RESTITUTE_OK) return status;
    size_t at = 0;
    while (at < names.count && strcmp(names.name[at], name) != 0)
        at++;
    if (at == names.count) {
        status = refuse_name(&names, name, error);
    } else {
        snprintf(path, sizeof path, "%s/%s.json", folder, names.name[at]);
        status = restitute_material_read(path, material, info, error);
    }
    free(names.name);
    return status;
}
