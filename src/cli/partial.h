/* Rows of an unfinished run in OUT.partial, and beside it OUT.partial.json with its settings, to be
 * compared before going on.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_PARTIAL_H
#define CLI_PARTIAL_H

#include "rows.h"
#include "unfinished.h"

struct partial {
    struct unfinished rows;
    char *settings_path;
};

/* Open OUT.partial and put the header down, or with --resume read the rows that are done: `done` counts them. */
bool partial_begin(const char *path, const struct cases *cases, const struct settings *settings,
                   const json_t *settings_object, struct partial *partial, struct row *rows, size_t *done,
                   struct reason *why);

/* Read the rows of a finished shard, which are those from number `first` on; `count` counts them. */
bool partial_join(const char *path, const struct cases *cases, const struct settings *settings,
                  const json_t *settings_object, struct row *rows, size_t first, size_t *count, struct reason *why);

/* Give the rows their final name, if they are as many. */
bool partial_commit(struct partial *partial, const char *path, size_t rows, struct reason *why);

/* Remove both files. */
void partial_remove(struct partial *partial);

/* Leave both files for --resume. */
void partial_leave(struct partial *partial);

#endif
