/* Atomic files and standard output.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool output_is_standard(const char *path)
{
    return !path || strcmp(path, "-") == 0;
}

char *path_with_suffix(const char *path, const char *suffix)
{
    const size_t size = strlen(path) + strlen(suffix) + 1;
    char *joined = allocate(size, 1);
    snprintf(joined, size, "%s%s", path, suffix);
    return joined;
}

bool output_check(const char *path, const char *option, struct reason *why)
{
    if (output_is_standard(path)) return true;
    struct stat status;
    if (!*path) return refuse(why, "%s is empty: must be a file name", option);
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return refuse(why, "%s = %.200s: is not a regular file; - is standard output", option, path);
    char *copy = copy_of(path);
    const int closed = access(dirname(copy), W_OK | X_OK);
    free(copy);
    if (closed != 0) return refuse(why, "%s = %.200s: cannot be written: %s", option, path, strerror(errno));
    return true;
}

bool output_spares(const char *path, const char *option, const char *input, struct reason *why)
{
    struct stat written, read;
    if (output_is_standard(path) || !input || stat(path, &written) != 0 || stat(input, &read) != 0) return true;
    if (written.st_dev != read.st_dev || written.st_ino != read.st_ino) return true;
    return refuse(why, "%s = %.200s: is an input of this run and would be overwritten", option, path);
}

/* The folder of a path; false if there is none. */
static bool folder_of(const char *path, struct stat *status)
{
    char *copy = copy_of(path);
    const bool found = stat(dirname(copy), status) == 0;
    free(copy);
    return found;
}

bool output_same(const char *path, const char *other)
{
    struct stat one, two;
    if (output_is_standard(path) || output_is_standard(other))
        return output_is_standard(path) && output_is_standard(other);
    const char *slash = strrchr(path, '/'), *other_slash = strrchr(other, '/');
    if (strcmp(slash ? slash + 1 : path, other_slash ? other_slash + 1 : other) != 0) return false;
    return folder_of(path, &one) && folder_of(other, &two) && one.st_dev == two.st_dev && one.st_ino == two.st_ino;
}

bool output_open(const char *path, struct output *output, struct reason *why)
{
    memset(output, 0, sizeof *output);
    if (output_is_standard(path)) {
        output->stream = stdout;
        return true;
    }
    output->temporary = path_with_suffix(path, ".XXXXXX");
    const int file = mkstemp(output->temporary);
    output->stream = file >= 0 ? fdopen(file, "w") : NULL;
    if (!output->stream) {
        free(output->temporary);
        memset(output, 0, sizeof *output);
        return refuse(why, "%.200s: cannot be written: %s", path, strerror(errno));
    }
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(file, 0666 & ~mask); /* mkstemp makes it private, but this is the user's result */
    output->place = copy_of(path);
    return true;
}

/* The new name itself must reach the disk too; a file system that cannot do this is no reason to fail. */
static void flush_folder(const char *place)
{
    char *copy = copy_of(place);
    const int folder = open(dirname(copy), O_RDONLY);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
    free(copy);
}

bool output_rename(FILE *stream, const char *temporary, const char *place, struct reason *why)
{
    const bool written = !ferror(stream) && fflush(stream) == 0 && fsync(fileno(stream)) == 0;
    int problem = written ? 0 : errno;
    if (fclose(stream) != 0 && !problem) problem = errno;
    if (!problem && rename(temporary, place) != 0) problem = errno;
    if (problem) return refuse(why, "%.200s: cannot be written: %s", place, strerror(problem));
    flush_folder(place);
    return true;
}

bool output_finish(struct output *output, struct reason *why)
{
    bool done;
    if (!output->place) {
        done = !ferror(output->stream) && fflush(output->stream) == 0;
        return done ? true : refuse(why, "standard output cannot be written: %s", strerror(errno));
    }
    done = output_rename(output->stream, output->temporary, output->place, why);
    output->stream = NULL;
    if (!done) unlink(output->temporary);
    free(output->temporary);
    free(output->place);
    return done;
}

void output_abandon(struct output *output)
{
    if (!output->place) return;
    if (output->stream) fclose(output->stream);
    unlink(output->temporary);
    free(output->temporary);
    free(output->place);
    memset(output, 0, sizeof *output);
}
