/* What a run reads and what it writes: nothing that it reads may be what it writes, and no two
 * outputs may be one. Places are compared by what they are, not by name; those that do not exist
 * yet by folder and name.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_PLACES_H
#define CLI_PLACES_H

#include "options.h"

struct places {
    struct place_item *items;
    size_t count, capacity;
};

/* An input, "-" for standard input; NULL: none. `name` is how the user calls it: "--input",
 * "material". */
void places_read(struct places *places, const char *name, const char *path);

/* The materials of a run, with the series that they name. */
void places_read_materials(struct places *places, const struct materials *materials);

/* An output; NULL or "-" for standard output. */
void places_write(struct places *places, const char *option, const char *path);

/* What is written beside an output that is a file, under its name with this suffix. */
void places_write_beside(struct places *places, const char *option, const char *path, const char *suffix);

/* Refuse what would be overwritten. Releases the places in any case. */
bool places_check(struct places *places, struct reason *why);

/* All of that for `pair` and `history`. */
bool places_check_settings(const struct settings *settings, const struct materials *materials, struct reason *why);

#endif
