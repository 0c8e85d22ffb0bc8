/* How an output is written.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE /* flock, the lock that belongs to the open file and not to the process */

#include "io/new_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* Lock an open file as long as it is open. Returns 0; EWOULDBLOCK: another process has locked it;
 * ESTALE: it no longer has this name; another errno: the file system has no locks. */
static int lock(int descriptor, const char *name)
{
    struct stat ours, named;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno;
    const int same = fstat(descriptor, &ours) == 0 && lstat(name, &named) == 0 && ours.st_dev == named.st_dev &&
                     ours.st_ino == named.st_ino;
    return same ? 0 : ESTALE;
}

/* Copy owner and mode of an existing file. If the group cannot be set, the group gets no more
 * rights than others. */
static void make_alike(int descriptor, const struct stat *model)
{
    mode_t mode = model->st_mode & 0777;
    if (fchown(descriptor, model->st_uid, model->st_gid) != 0 && fchown(descriptor, (uid_t)-1, model->st_gid) != 0)
        mode = (mode & 0707) | (mode & (mode & 0007) << 3);
    fchmod(descriptor, mode);
}

/* Make a file that is not there yet. Returns the descriptor, or -1 with errno. */
static int create(const char *name, const struct rst_place *place)
{
    const int file = open(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, place->exists ? 0600 : 0666);
    if (file >= 0 && place->exists) make_alike(file, &place->status);
    return file;
}

/* Whether a killed process left this temporary file: a running process keeps it locked. */
static void remove_stale(const char *name)
{
    const int file = open(name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    if (lock(file, name) == 0) unlink(name);
    close(file);
}

/* Create it with the first free number. Before it is locked, another process may take it for an
 * abandoned file. */
static int open_temporary(struct rst_new_file *file)
{
    enum { numbers = 1000 };
    const size_t size = strlen(file->place.target) + 32;
    int problem = EEXIST;
    file->temporary = malloc(size);
    if (!file->temporary) return ENOMEM;
    for (int i = 0; i < numbers && problem == EEXIST; i++) {
        snprintf(file->temporary, size, "%s.restitute-%d.tmp", file->place.target, i);
        remove_stale(file->temporary);
        file->descriptor = create(file->temporary, &file->place);
        problem = file->descriptor < 0 ? errno : 0;
        if (problem) continue;
        const int locked = lock(file->descriptor, file->temporary);
        if (locked != EWOULDBLOCK && locked != ESTALE) return 0;
        close(file->descriptor);
        problem = EEXIST;
    }
    file->descriptor = -1;
    free(file->temporary);
    file->temporary = NULL;
    return problem;
}

static int open_through(const struct rst_place *place)
{
    if (place->descriptor >= 0) return fcntl(place->descriptor, F_DUPFD_CLOEXEC, 3);
    return open(place->target, O_WRONLY | O_APPEND | O_NOCTTY | O_CLOEXEC);
}

static int write_all(int descriptor, const char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t count = write(descriptor, bytes, size);
        if (count == 0) return EIO;
        if (count < 0 && errno != EINTR) return errno;
        if (count < 0) continue;
        bytes += count;
        size -= (size_t)count;
    }
    return 0;
}

static void drop(struct rst_new_file *file)
{
    if (file->temporary) unlink(file->temporary);
    if (file->descriptor >= 0) close(file->descriptor);
    free(file->temporary);
    rst_place_release(&file->place);
    *file = (struct rst_new_file){.descriptor = -1};
}

int rst_new_file_write(const char *path, const void *bytes, size_t size, struct rst_new_file *file)
{
    *file = (struct rst_new_file){.descriptor = -1};
    int problem = rst_place_find(path, &file->place);
    if (!problem) problem = rst_place_check(&file->place);
    if (!problem && !file->place.through)
        problem = open_temporary(file);
    else if (!problem && (file->descriptor = open_through(&file->place)) < 0)
        problem = errno;
    if (!problem) problem = write_all(file->descriptor, bytes, size);
    if (!problem && file->temporary && fsync(file->descriptor) != 0) problem = errno;
    if (problem) drop(file);
    return problem;
}

/* Flush the folder, too, so that the new name is on the disk. A file system that cannot do this is
 * not an error. */
static int give_name(const char *name, const char *target)
{
    if (rename(name, target) != 0) return errno;
    char *folder = rst_folder_of(target);
    const int file = folder ? open(folder, O_RDONLY | O_CLOEXEC) : -1;
    if (file >= 0) {
        fsync(file);
        close(file);
    }
    free(folder);
    return 0;
}

int rst_new_file_commit(struct rst_new_file *file)
{
    int problem = 0;
    if (file->temporary) problem = give_name(file->temporary, file->place.target);
    if (!problem) {
        free(file->temporary);
        file->temporary = NULL;
    }
    drop(file);
    return problem;
}
