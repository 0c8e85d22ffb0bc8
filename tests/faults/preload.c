/* Faults on demand, for LD_PRELOAD. Calls that make, change, rename or remove a file beneath
 * FAULT_FOLDER, an absolute path, are counted, and one line for each goes into the file FAULT_LOG.
 * From number FAULT_AT to FAULT_LAST, FAULT=N: the call fails with errno N, unless it removes; with
 * a negative N the process gets the signal -N, before the call.
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

static long number_in(const char *variable)
{
    const char *text = getenv(variable);
    return text ? atol(text) : 0;
}

/* Whether this call fails; `removes` if it needs no room. */
static int fails(const char *call, const char *path, int removes)
{
    static long count;
    const char *log = getenv("FAULT_LOG");
    const long number = ++count, fault = number_in("FAULT");
    if (log) {
        const int file = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        dprintf(file, "%s %s\n", call, path);
        close(file);
    }
    if (number < number_in("FAULT_AT") || number > number_in("FAULT_LAST")) return 0;
    if (fault < 0) raise((int)-fault);
    if (fault < 0 || removes) return 0;
    errno = (int)fault;
    return 1;
}

#define OPENER(name)                                                                                                   \
    SEEN_BY_LIBRARIES int name(const char *path, int flags, ...)                                                       \
    {                                                                                                                  \
        static int (*real)(const char *, int, ...);                                                                    \
        va_list more;                                                                                                  \
        va_start(more, flags);                                                                                         \
        const mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(more, mode_t) : 0;                                \
        va_end(more);                                                                                                  \
        if (!real) *(void **)&real = dlsym(RTLD_NEXT, #name);                                                          \
        const int writes = (flags & O_ACCMODE) != O_RDONLY || flags & O_CREAT;                                         \
        return writes && is_beneath(path) && fails("open", path, 0) ? -1 : real(path, flags, mode);                    \
    }
OPENER(open)
OPENER(open64)

#define INSTEAD_OF(type, name, declared, given, fault)                                                                 \
    SEEN_BY_LIBRARIES type name declared                                                                               \
    {                                                                                                                  \
        static type(*real) declared;                                                                                   \
        if (!real) *(void **)&real = dlsym(RTLD_NEXT, #name);                                                          \
        return (fault) ? -1 : real given;                                                                              \
    }
INSTEAD_OF(int, fsync, (int file), (file), is_open_beneath(file) && fails("fsync", "", 0))
INSTEAD_OF(int, ftruncate, (int file, off_t size), (file, size), is_open_beneath(file) && fails("ftruncate", "", 0))
INSTEAD_OF(int, ftruncate64, (int file, off_t size), (file, size), is_open_beneath(file) && fails("ftruncate", "", 0))
INSTEAD_OF(ssize_t, write, (int file, const void *bytes, size_t size),
           (file, bytes, getenv("FAULT_SHORT") ? (size + 1) / 2 : size), is_open_beneath(file) && fails("write", "", 0))
INSTEAD_OF(int, rename, (const char *path, const char *to), (path, to), is_beneath(path) && fails("rename", path, 0))
INSTEAD_OF(int, mkdir, (const char *path, mode_t mode), (path, mode), is_beneath(path) && fails("mkdir", path, 0))
INSTEAD_OF(int, unlink, (const char *path), (path), is_beneath(path) && fails("unlink", path, 1))
