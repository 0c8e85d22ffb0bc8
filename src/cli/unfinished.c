/* Unfinished runs: open, lock, append, commit.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "unfinished.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool fails(const struct unfinished *u, const char *what, int problem, struct reason *why)
{
    return refuse(why, "%.200s: cannot be %s: %s", u->path, what, strerror(problem));
}

/* Lock what was opened. False with `why`, or, if the name has gone to another file meanwhile, with
 * `again`. */
static bool lock(const struct unfinished *u, bool *again, struct reason *why)
{
    const int problem = rst_lock(u->file, u->path);
    *again = problem == ESTALE;
    if (problem == EWOULDBLOCK) return refuse(why, "%.200s is being written by another process", u->path);
    return !*again;
}

/* Open the file that is there, or make it. */
static bool open_once(struct unfinished *u, const struct rst_place *output, bool resume, bool *again,
                      struct reason *why)
{
    struct stat status;
    u->file = rst_create(u->path, output);
    const bool found = u->file < 0 && errno == EEXIST;
    if (found) u->file = open(u->path, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (u->file < 0) return fails(u, "written", errno, why);
    if (fstat(u->file, &status) != 0 || !S_ISREG(status.st_mode))
        return refuse(why, "%.200s is not a regular file: remove it", u->path);
    if (!lock(u, again, why)) return false;
    if (found && !resume)
        return refuse(why, "%.200s is left from an interrupted run: continue it with --resume, or remove it", u->path);
    u->empty = status.st_size == 0;
    return true;
}

bool unfinished_open(const char *output, bool resume, struct unfinished *u, struct reason *why)
{
    struct rst_place place;
    bool good = false, again = true;
    memset(u, 0, sizeof *u);
    const int problem = rst_place_find(output, &place);
    if (problem) return refuse(why, "%.200s: cannot be written: %s", output, strerror(problem));
    if (place.through) {
        rst_place_release(&place);
        return refuse(why, "%.200s: is not a regular file, which a run that can be continued needs", output);
    }
    u->path = path_with_suffix(place.target, ".partial");
    while (again) {
        again = false;
        good = open_once(u, &place, resume, &again, why);
        if (again) close(u->file);
    }
    rst_place_release(&place);
    if (!good) unfinished_leave(u);
    return good;
}

bool unfinished_lock_again(struct unfinished *u, struct reason *why)
{
    bool again = false;
    struct unfinished now = {.path = u->path};
    now.file = open(u->path, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (now.file < 0) return fails(u, "written", errno, why);
    const bool good = lock(&now, &again, why);
    close(good ? u->file : now.file);
    if (good) u->file = now.file;
    return good || (again && refuse(why, "%.200s is being written by another process", u->path));
}

/* Complete lines, and where the last of them ends. */
static bool scan(const struct unfinished *u, size_t *lines, off_t *length)
{
    FILE *stream = fopen(u->path, "rb");
    bool quoted = false;
    if (!stream) return false;
    *lines = 0;
    *length = 0;
    off_t position = 0;
    for (int c = getc(stream); c != EOF; c = getc(stream)) {
        position++;
        if (c == '"') quoted = !quoted;
        if (c != '\n' || quoted) continue;
        *length = position;
        ++*lines;
    }
    const bool good = !ferror(stream);
    fclose(stream);
    return good;
}

bool unfinished_cut(struct unfinished *u, struct reason *why)
{
    size_t lines;
    off_t length;
    if (!scan(u, &lines, &length) || ftruncate(u->file, length) != 0 || lseek(u->file, length, SEEK_SET) < 0)
        return fails(u, "continued", errno, why);
    u->empty = length == 0;
    return true;
}

bool unfinished_append(struct unfinished *u, struct output *lines, struct reason *why)
{
    return output_send(lines, u->file, u->path, why);
}

bool unfinished_commit(struct unfinished *u, const char *output, size_t lines, struct reason *why)
{
    struct rst_place place;
    size_t found;
    off_t length;
    if (!scan(u, &found, &length)) return fails(u, "read", errno, why);
    if (found != lines)
        return refuse(why, "%.200s has %zu lines, not %zu: something else wrote to it", u->path, found, lines);
    if (fsync(u->file) != 0) return fails(u, "written", errno, why);
    int problem = rst_place_find(output, &place);
    if (!problem) {
        problem = rst_rename(u->path, place.target);
        rst_place_release(&place);
    }
    if (problem) return refuse(why, "%.200s: cannot be written: %s", output, strerror(problem));
    unfinished_leave(u);
    return true;
}

void unfinished_leave(struct unfinished *u)
{
    if (u->path && u->file >= 0) close(u->file);
    free(u->path);
    memset(u, 0, sizeof *u);
}

void unfinished_remove(struct unfinished *u)
{
    if (u->path) unlink(u->path);
    unfinished_leave(u);
}
