/* A whole file as text, and its fingerprint.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "files/file_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "base/whole_file.h"

const char *rst_file_name_for_message(const char *path)
{
    const size_t longest = 96;
    const size_t length = strlen(path);
    if (strcmp(path, "-") == 0) return "standard input";
    return length > longest ? path + (length - longest) : path;
}

/* Standard input has no known size. On failure errno has the reason (0: too large), and everything
 * is released. */
static int read_standard_input(uint64_t most, struct file_text *text)
{
    char *bytes = NULL;
    size_t length = 0, capacity = 0, count = 1;
    errno = 0;
    while (count > 0 && length <= most) {
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
        count = fread(bytes + length, 1, capacity - length - 1, stdin);
        length += count;
    }
    if (length > most || ferror(stdin)) {
        const int reason = length > most ? 0 : errno;
        free(bytes);
        errno = reason;
        return RESTITUTE_ERROR_FILE;
    }
    bytes[length] = '\0';
    text->bytes = bytes;
    text->length = length;
    return RESTITUTE_OK;
}

int rst_file_text_read(const char *path, uint64_t most, struct file_text *text, restitute_error *error)
{
    const char *name = rst_file_name_for_message(path);
    if (strcmp(path, "-") != 0) return rst_read_whole(path, name, most, &text->bytes, &text->length, error);
    const int status = read_standard_input(most, text);
    if (status == RESTITUTE_OK) return status;
    if (errno) return rst_report(error, status, "%s: cannot be read: %s", name, strerror(errno));
    return rst_report(error, status, "%s: has more than %llu bytes", name, (unsigned long long)most);
}

uint64_t rst_file_text_fingerprint(const struct file_text *text, uint64_t start)
{
    uint64_t hash = start;
    for (size_t i = 0; i < text->length; i++)
        hash = (hash ^ (unsigned char)text->bytes[i]) * UINT64_C(1099511628211);
    return hash;
}
