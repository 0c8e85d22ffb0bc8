/* How an output is written: beside its place as OUT.restitute-N.tmp, locked, flushed to the disk,
 * then renamed. It has the mode of the replaced file, and its owner if that is allowed. A killed
 * process leaves an unlocked temporary file. The next output to the same place removes it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_NEW_FILE_H
#define RST_NEW_FILE_H

#include <stddef.h>

#include "io/place.h"

struct rst_new_file {
    struct rst_place place;
    int descriptor;
    char *temporary; /* NULL: written through */
};

/* Write the content, not yet under the final name. (A file that is written through is then
 * complete.) Returns 0 or an errno, and then nothing is left of it. */
int rst_new_file_write(const char *path, const void *bytes, size_t size, struct rst_new_file *file);

/* Give it its name. Returns 0 or an errno, and then nothing is left of it. */
int rst_new_file_commit(struct rst_new_file *file);

#endif
