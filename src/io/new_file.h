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

/* Remove it. */
void rst_new_file_drop(struct rst_new_file *file);

/* Open what is written through. Returns the descriptor, or -1 with errno. */
int rst_open_through(const struct rst_place *place);

/* Write to an open file. Returns 0 or the errno of the write that failed. */
int rst_write_all(int descriptor, const char *bytes, size_t size);

/* Make a file that is not there yet, for reading and writing, with the mode and owner of what is at
 * `place`. Returns the descriptor, or -1 with errno. */
int rst_create(const char *name, const struct rst_place *place);

/* Lock an open file as long as it is open. Returns 0; EWOULDBLOCK: another process has locked it;
 * ESTALE: it no longer has this name; another errno: the file system has no locks. */
int rst_lock(int descriptor, const char *name);

/* Give a flushed file its final name, and flush that. Returns 0 or an errno. */
int rst_rename(const char *name, const char *target);

#endif
