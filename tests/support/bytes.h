/* Whole files.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_BYTES_H
#define TEST_BYTES_H

#include "check.h"

static inline void write_bytes(const char *path, const void *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL, "cannot write %s", path);
    CHECK(fwrite(bytes, 1, length, file) == length, "cannot write %s", path);
    CHECK(fclose(file) == 0, "cannot close %s", path);
}

/* The length of a file, and its bytes, of which there must be fewer than `most`. */
static inline size_t read_bytes(const char *path, void *bytes, size_t most)
{
    FILE *file = fopen(path, "rb");
    CHECK(file != NULL, "cannot read %s", path);
    const size_t length = fread(bytes, 1, most, file);
    fclose(file);
    CHECK(length < most, "%s has %zu bytes or more", path, most);
    return length;
}

#endif
