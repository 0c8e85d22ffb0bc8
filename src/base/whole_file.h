/* Read a whole file into memory. Only regular files of a bounded size: a FIFO or a device would
 * block the reader or fill its memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_WHOLE_FILE_H
#define RST_WHOLE_FILE_H

#include <restitute/restitute.h>

/* All of it, with a NUL behind; `name` stands for it in messages. The caller frees *bytes. */
int rst_read_whole(const char *path, const char *name, uint64_t most, char **bytes, size_t *size,
                   restitute_error *error);

#endif
