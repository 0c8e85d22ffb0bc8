/* Faults on demand, for LD_PRELOAD. Calls that make, change, rename or remove a file beneath
 * FAULT_FOLDER, an absolute path, are counted, and one line for each goes into the file FAULT_LOG.
 * At number FAULT_AT:
 *     FAULT=kill   the process ends as by kill -9, before the call
 *     FAULT=stop   it stops, until SIGCONT
 *     FAULT=N      the call fails with errno N; FAULT_ON=yes: and all after it but removals
 * FAULT_SHORT=yes: writes take half of what they are given. And fault_memory(n, for_good), by
 * ctypes: allocation n of our libraries fails, with for_good all after it; 0: none.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../support/failing_allocator.h"

/* Allocations of our libraries that failed or could have failed since the last call. */
SEEN_BY_LIBRARIES long fault_memory(long failing, int for_good)
{
    const long count = allocator.count;
    allocator.armed = failing != 0;
    allocator.ours_alone = 1;
    allocator.count = 0;
    allocator.failing = failing;
    allocator.for_good = for_good;
    return count;
}

static int is_beneath(const char *path)
{
    const char *folder = getenv("FAULT_FOLDER");
    char here[4096];
    if (!folder) return 0;
    if (*path != '/') return getcwd(here, sizeof here) && !strncmp(here, folder, strlen(folder));
    return !strncmp(path, folder, strlen(folder));
}

static int is_open_beneath(int descriptor)
{
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return 0;
    path[length] = '\0';
    return *path == '/' && is_beneath(path);
}

/* Whether this call fails; `removes` if it needs no room. */
static int fails(const char *call, const char *path, int removes)
{
    static long count;
    const char *at = getenv("FAULT_AT"), *fault = getenv("FAULT"), *log = getenv("FAULT_LOG");
    static int (*really_open)(const char *, int, ...);
    const long number = ++count, failing = at ? atol(at) : 0;
    if (log) {
        if (!really_open) *(void **)&really_open = dlsym(RTLD_NEXT, "open");
        const int file = really_open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        dprintf(file, "%s %s\n", call, path);
        close(file);
    }
    if (!fault || number < failing || !failing) return 0;
    if (number == failing && (!strcmp(fault, "kill") || !strcmp(fault, "stop")))
        raise(*fault == 'k' ? SIGKILL : SIGSTOP);
    if (!atoi(fault) || removes || (number > failing && !getenv("FAULT_ON"))) return 0;
    errno = atoi(fault);
    return 1;
}

#define REAL(name) (*(void **)&real = dlsym(RTLD_NEXT, #name))

#define OPENER(name)                                                                                                   \
    SEEN_BY_LIBRARIES int name(const char *path, int flags, ...)                                                       \
    {                                                                                                                  \
        static int (*real)(const char *, int, ...);                                                                    \
        va_list more;                                                                                                  \
        va_start(more, flags);                                                                                         \
        const mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(more, mode_t) : 0;                                \
        va_end(more);                                                                                                  \
        if (!real) REAL(name);                                                                                         \
        const int writes = (flags & O_ACCMODE) != O_RDONLY || flags & O_CREAT;                                         \
        return writes && is_beneath(path) && fails("open", path, 0) ? -1 : real(path, flags, mode);                    \
    }
OPENER(open)
OPENER(open64)

#define ON_DESCRIPTOR(name, type, declared, given)                                                                     \
    SEEN_BY_LIBRARIES type name declared                                                                               \
    {                                                                                                                  \
        static type(*real) declared;                                                                                   \
        if (!real) REAL(name);                                                                                         \
        return is_open_beneath(file) && fails(#name, "", 0) ? -1 : real given;                                         \
    }
ON_DESCRIPTOR(fsync, int, (int file), (file))
ON_DESCRIPTOR(ftruncate, int, (int file, off_t size), (file, size))
ON_DESCRIPTOR(ftruncate64, int, (int file, off_t size), (file, size))
ON_DESCRIPTOR(write, ssize_t, (int file, const void *bytes, size_t size),
              (file, bytes, getenv("FAULT_SHORT") ? (size + 1) / 2 : size))

#define ON_PATH(name, declared, given, removes)                                                                        \
    SEEN_BY_LIBRARIES int name declared                                                                                \
    {                                                                                                                  \
        static int(*real) declared;                                                                                    \
        if (!real) REAL(name);                                                                                         \
        return is_beneath(path) && fails(#name, path, removes) ? -1 : real given;                                      \
    }
ON_PATH(rename, (const char *path, const char *to), (path, to), 0)
ON_PATH(mkdir, (const char *path, mode_t mode), (path, mode), 0)
ON_PATH(unlink, (const char *path), (path), 1)
