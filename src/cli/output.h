/* Files that appear whole or not at all: written beside their place, flushed to the disk, then renamed.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

#include <stdio.h>

#include "message.h"

struct output {
    FILE *stream;
    char *place;     /* final name; NULL: standard output */
    char *temporary; /* name while it is written */
};

/* True for NULL and "-". */
bool output_is_standard(const char *path);

/* Refuse a place that could not be written: a folder, a device, a folder that is missing or closed to us. */
bool output_check(const char *path, const char *option, struct reason *why);

/* Refuse to replace `input`, by whatever name; NULL: no such input. */
bool output_spares(const char *path, const char *option, const char *input, struct reason *why);

/* Whether two places are one: the same name in the same folder, however it is written, or standard output twice. */
bool output_same(const char *path, const char *other);

/* Open for writing under a temporary name, or standard output. */
bool output_open(const char *path, struct output *output, struct reason *why);

/* All is written: flush, and give the file its name. On failure nothing is left under the final name. */
bool output_finish(struct output *output, struct reason *why);

/* Give up: remove what was written. */
void output_abandon(struct output *output);

/* Flush an open file to the disk and rename it. Closes the stream in any case. */
bool output_rename(FILE *stream, const char *temporary, const char *place, struct reason *why);

/* `path` with `suffix` behind it, on the heap. */
char *path_with_suffix(const char *path, const char *suffix);

#endif
