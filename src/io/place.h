/* Where an output goes. The rule for library and command:
 *   - symbolic links are followed: the file they lead to is written, and the links stay;
 *   - a regular file, or none yet, is replaced as a whole (new_file.h);
 *   - a device, a pipe, or an open file that /dev/stdout or /proc/self/fd/N names is written
 *     through, never replaced;
 *   - a folder, a socket and a block device are refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_PLACE_H
#define RST_PLACE_H

#include <sys/stat.h>

struct rst_place {
    char *target;   /* the name behind all symbolic links, on the heap */
    int exists;     /* and `status` is its type */
    int through;    /* to be written through */
    int descriptor; /* the open file of this process that the path names; -1: none */
    struct stat status;
};

/* Find out where a path leads. Returns 0 or an errno, and then there is nothing to release. */
int rst_place_find(const char *path, struct rst_place *place);
void rst_place_release(struct rst_place *place);

/* Whether it may be written by us: 0 or an errno. A read-only file is not replaced. */
int rst_place_check(const struct rst_place *place);

/* The folder of a path, with its last slash, on the heap; NULL: no memory. */
char *rst_folder_of(const char *path);

#endif
