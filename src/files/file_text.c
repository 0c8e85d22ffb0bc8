/* A whole file as text, and its fingerprint.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "file_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *file_name_for_message(const char *path)
{
    const size_t longest = 96;
    const size_t length = strlen(path);
    if (strcmp(path, "-") == 0) return "standard input";
    return length > longest ? path + (length - longest) : path;
}

/* Read the open stream to its end. On failure errno tells why and nothing is left allocated. */
static int read_stream(FILE *stream, struct file_text *text)
{
    char *bytes = NULL;
    size_t length = 0, capacity = 0;
    for (;;) {
        if (capacity - length < 2) {
            capacity = capacity ? 2 * capacity : 16384;
            char *larger = realloc(bytes, capacity);
            if (!larger) {
                free(bytes);
                errno = ENOMEM;
                return RESTITUTE_ERROR_MEMORY;
            }
            bytes = larger;
        }
        const size_t count = fread(bytes + length, 1, capacity - length - 1, stream);
        length += count;
        if (count == 0) break;
    }
    if (ferror(stream)) {
        const int reason = errno;
        free(bytes);
        errno = reason;
        return RESTITUTE_ERROR_FILE;
    }
    bytes[length] = '\0';
    text->bytes = bytes;
    text->length = length;
    return RESTITUTE_OK;
}

int file_text_read(const char *path, struct file_text *text, restitute_error *error)
{
    const int standard = strcmp(path, "-") == 0;
    FILE *stream = standard ? stdin : fopen(path, "rb");
    if (!stream)
        return rst_report(error, RESTITUTE_ERROR_FILE, "%s: cannot be read: %s", file_name_for_message(path),
                          strerror(errno));
    const int status = read_stream(stream, text);
    const int reason = errno;
    if (!standard) fclose(stream);
    if (status != RESTITUTE_OK)
        return rst_report(error, status, "%s: cannot be read: %s", file_name_for_message(path), strerror(reason));
    return RESTITUTE_OK;
}

uint64_t file_text_fingerprint(const struct file_text *text, uint64_t start)
{
    uint64_t hash = start;
    for (size_t i = 0; i < text->length; i++)
        hash = (hash ^ (unsigned char)text->bytes[i]) * UINT64_C(1099511628211);
    return hash;
}
