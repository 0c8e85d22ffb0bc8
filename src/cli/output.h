/* Outputs of the command: files that appear whole or not at all, and streams. Where and how files
 * are written is decided in src/io.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

#include <stdio.h>

#include "io/new_file.h"
#include "message.h"

struct output {
    FILE *stream; /* into memory: what is written is one piece, and one call can fail */
    char *bytes;
    size_t size;
    char *path;   /* NULL: standard output */
    bool written; /* under the temporary name `file` */
    struct rst_new_file file;
};

/* True for NULL and "-". */
bool output_is_standard(const char *path);

/* True for standard output and whatever else is written through: no file stands beside it, and none
 * can be continued. */
bool output_is_stream(const char *path);

/* Refuse a place that could not be written: a folder, a missing folder, what is closed to us. */
bool output_check(const char *path, const char *option, struct reason *why);

/* Begin an output; write to its stream. */
bool output_open(const char *path, struct output *output, struct reason *why);

/* Open an output that is a stream, for what comes piece by piece. Returns the descriptor, or -1. */
int output_open_stream(const char *path, struct reason *why);

/* Send what was written to an open file, whose name is for messages, and release the output. */
bool output_send(struct output *output, int descriptor, const char *name, struct reason *why);

/* All is written: all outputs get their names, or none. Those without a stream are passed over. */
bool outputs_finish(struct output *outputs, size_t count, struct reason *why);
bool output_finish(struct output *output, struct reason *why);

/* The two halves of that: what may fail for want of room, and giving the names. */
bool outputs_write(struct output *outputs, size_t count, struct reason *why);
bool outputs_commit(struct output *outputs, size_t count, struct reason *why);

/* Give up: remove what was written. */
void outputs_abandon(struct output *outputs, size_t count);

/* `path` with `suffix` behind it, on the heap. */
char *path_with_suffix(const char *path, const char *suffix);

/* Likewise, beside the file that the path leads to. */
char *path_beside(const char *path, const char *suffix);

#endif
