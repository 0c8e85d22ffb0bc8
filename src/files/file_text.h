/* What the readers of this component share: a whole file as text, its fingerprint, and errors.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RESTITUTE_FILE_TEXT_H
#define RESTITUTE_FILE_TEXT_H

#include <restitute/restitute.h>

/* A file in memory; `bytes` has a NUL behind its `length` bytes. */
struct file_text {
    char *bytes;
    size_t length;
};

/* Read all of the regular file `path` of up to 64 MiB, a million of terms. The caller frees
 * text->bytes. */
int rst_file_text_read(const char *path, struct file_text *text, restitute_error *error);

/* FNV-1a over the text. */
uint64_t rst_file_text_fingerprint(const struct file_text *text);

/* The path, or only its end if it would crowd the rest out of a message. */
const char *rst_file_name_for_message(const char *path);

#endif
