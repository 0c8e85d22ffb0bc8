/* A whole file as text, and its fingerprint.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/file_text.h"

#include <string.h>

#include "base/whole_file.h"

const char *rst_file_name_for_message(const char *path)
{
    const size_t longest = 96;
    const size_t length = strlen(path);
    return length > longest ? path + (length - longest) : path;
}

int rst_file_text_read(const char *path, struct file_text *text, restitute_error *error)
{
    return rst_read_whole(path, rst_file_name_for_message(path), UINT64_C(1) << 26, &text->bytes, &text->length, error);
}

uint64_t rst_file_text_fingerprint(const struct file_text *text)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < text->length; i++)
        hash = (hash ^ (unsigned char)text->bytes[i]) * UINT64_C(1099511628211);
    return hash;
}
