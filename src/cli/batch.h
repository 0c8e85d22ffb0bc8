/* Many impacts: `restitute pair --input` and `--grid`.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_BATCH_H
#define CLI_BATCH_H

#include <jansson.h>

#include "rows.h"

/* Who makes other cases than those of a file or a grid, and what is done with the rows when they have their file. */
struct batch_maker {
    bool (*make)(void *context, struct cases *cases, struct reason *why);
    int (*finish)(void *context, const struct cases *cases, const struct row *rows, json_t *record); /* exit status */
    void *context;
};

/* maker: NULL for --input and --grid. Returns the exit status. */
int batch_run(const struct settings *settings, const struct batch_maker *maker);

/* A signal asked the program to stop. */
bool batch_interrupted(void);

#endif
