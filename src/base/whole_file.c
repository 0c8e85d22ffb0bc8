/* Reading a whole regular file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/report.h"

/* Without O_NONBLOCK a FIFO would wait for its writer. */
static int open_regular(const char *path, const char *name, uint64_t most, int *file, size_t *size,
                        restitute_error *error)
{
    struct stat status;
    *file = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (*file < 0 || fstat(*file, &status) != 0) {
        const int reason = errno;
        if (*file >= 0) close(*file);
        return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: cannot be read: %s", name, strerror(reason));
    }
    const uint64_t bytes = status.st_size > 0 ? (uint64_t)status.st_size : 0;
    *size = (size_t)bytes;
    if (S_ISREG(status.st_mode) && bytes <= most && bytes < SIZE_MAX - 1) return RESTITUTE_OK;
    close(*file);
    if (S_ISDIR(status.st_mode))
        return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: cannot be read: %s", name, strerror(EISDIR));
    if (!S_ISREG(status.st_mode)) return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: is not a regular file", name);
    return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: has %llu bytes: must be at most %llu", name,
                      (unsigned long long)bytes, (unsigned long long)most);
}

int rst_read_whole(const char *path, const char *name, uint64_t most, char **bytes, size_t *size,
                   restitute_error *error)
{
    int file = -1;
    size_t expected = 0, length = 0;
    const int status = open_regular(path, name, most, &file, &expected, error);
    if (status != RESTITUTE_OK) return status;
    char *text = malloc(expected + 2); /* room for one byte more shows a file that grows, and for the NUL */
    ssize_t count = text ? 1 : 0;
    while (count > 0 && length <= expected) {
        do
            count = read(file, text + length, expected + 1 - length);
        while (count < 0 && errno == EINTR);
        if (count > 0) length += (size_t)count;
    }
    const int reason = errno;
    close(file);
    if (text && count >= 0 && length <= expected) {
        text[length] = '\0';
        *bytes = text;
        *size = length;
        return RESTITUTE_OK;
    }
    free(text);
    if (!text) return rst_report(error, RESTITUTE_ERROR_MEMORY, "%.120s: out of memory for %zu bytes", name, expected);
    return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: cannot be read: %s", name,
                      count < 0 ? strerror(reason) : "it changes meanwhile");
}
