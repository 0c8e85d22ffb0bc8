/* Files that a reader must refuse: those without an end or a beginning, and those larger than it
 * takes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_ODD_FILES_H
#define TEST_ODD_FILES_H

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include "check.h"

/* Without O_NONBLOCK, open() waits for a writer. */
static inline void make_fifo(const char *path)
{
    unlink(path);
    CHECK(mkfifo(path, 0600) == 0, "cannot make the FIFO %s", path);
}

/* A sparse file of `size` zero bytes; 0: not possible here. */
static inline int make_sparse(const char *path, off_t size)
{
    unlink(path);
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL, "cannot write %s", path);
    const int made = ftruncate(fileno(file), size) == 0;
    fclose(file);
    return made;
}

#endif
