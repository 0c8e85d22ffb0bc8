/* Where an output goes.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "io/place.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char *rst_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? strndup(path, (size_t)(slash - path) + 1) : strdup("./");
}

/* Replace the name of a link by its target. Returns 0 or an errno. */
static int follow(char **name)
{
    char content[4096];
    const ssize_t length = readlink(*name, content, sizeof content);
    if (length < 0) return errno;
    if (length == (ssize_t)sizeof content) return ENAMETOOLONG;
    char *folder = *content == '/' ? strdup("") : rst_folder_of(*name);
    const size_t size = (folder ? strlen(folder) : 0) + (size_t)length + 1;
    char *next = folder ? malloc(size) : NULL;
    if (next) {
        snprintf(next, size, "%s%.*s", folder, (int)length, content);
        free(*name);
        *name = next;
    }
    free(folder);
    return next ? 0 : ENOMEM;
}

/* A link in /proc is an open file and not a place. Output to it must not replace the file of that
 * name. */
static int is_open_file(const char *link, int *descriptor)
{
    char own[40];
    char *folder = rst_folder_of(link), *real = folder ? realpath(folder, NULL) : NULL;
    const int found = real && strncmp(real, "/proc/", strlen("/proc/")) == 0;
    snprintf(own, sizeof own, "/proc/%lld/fd", (long long)getpid());
    *descriptor = found && strcmp(real, own) == 0 ? atoi(strrchr(link, '/') + 1) : -1;
    free(folder);
    free(real);
    return found;
}

/* Follow links to the end, or to an open file. Returns 0 or an errno. */
static int walk(struct rst_place *place)
{
    enum { most_links = 40 };
    for (int links = 0; links <= most_links; links++) {
        place->exists = lstat(place->target, &place->status) == 0;
        if (!place->exists) return errno == ENOENT ? 0 : errno;
        if (!S_ISLNK(place->status.st_mode)) return 0;
        if (is_open_file(place->target, &place->descriptor)) {
            place->through = 1;
            return stat(place->target, &place->status) == 0 ? 0 : errno;
        }
        const int problem = follow(&place->target);
        if (problem) return problem;
    }
    return ELOOP;
}

int rst_place_find(const char *path, struct rst_place *place)
{
    *place = (struct rst_place){.target = strdup(path), .descriptor = -1};
    int problem = place->target ? walk(place) : ENOMEM;
    const mode_t mode = place->status.st_mode;
    if (!problem && place->exists && !S_ISREG(mode)) {
        place->through = S_ISCHR(mode) || S_ISFIFO(mode);
        if (!place->through && place->descriptor < 0) problem = S_ISDIR(mode) ? EISDIR : ENOTSUP;
    }
    if (problem) rst_place_release(place);
    return problem;
}

void rst_place_release(struct rst_place *place)
{
    free(place->target);
    place->target = NULL;
}

int rst_place_check(const struct rst_place *place)
{
    if (place->descriptor >= 0) {
        const int flags = fcntl(place->descriptor, F_GETFL);
        return flags < 0 || (flags & O_ACCMODE) == O_RDONLY ? EBADF : 0;
    }
    if (place->exists && access(place->target, W_OK) != 0) return errno;
    if (place->through) return 0;
    char *folder = rst_folder_of(place->target);
    const int problem = !folder ? ENOMEM : access(folder, W_OK | X_OK) != 0 ? errno : 0;
    free(folder);
    return problem;
}
