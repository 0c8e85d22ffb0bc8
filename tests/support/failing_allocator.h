/* An allocator that fails on demand: a program that includes this defines malloc and related
 * functions in front of those of the C library. The sanitizers do the same. With them, or with
 * another C library than that of GNU, nothing can fail: CAN_FAIL is 0, IF_CAN_FAIL runs nothing.
 *
 * A subject is a call of the library. It is called with a failure of its first allocation, then of
 * its second, and so on until none fails. Then the same with a failure of all allocations from
 * there on. Those who include this ask for the GNU C library's own functions first.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_FAILING_ALLOCATOR_H
#define TEST_FAILING_ALLOCATOR_H

#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/restitute.h>

#include "check.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define CAN_FAIL 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define CAN_FAIL 0
#endif
#endif
#ifndef CAN_FAIL
#define CAN_FAIL 1
#endif
#define IF_CAN_FAIL(run) (CAN_FAIL ? (run) : (printf("skipped: no allocation can be made to fail here\n"), 0))

/* Allocations are counted while armed, with `ours_alone` only those of our libraries,
 * with `others_alone` all others. Number `failing` fails, and with `for_good` all after it. None
 * fails within the function `spared`, see spare(). `live`: blocks not yet freed. With `others_lose`
 * blocks that other libraries leak are allowed. One thread. Volatile, since compilers take malloc
 * for a function that changes no variable. */
static volatile struct {
    int armed, ours_alone, others_alone, others_lose, for_good;
    long count, failing, live;
    const char *spared;
} allocator;

#if CAN_FAIL
#include <execinfo.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *block);

/* Or the libraries, and what they call, would take those of the C library. */
#define SEEN_BY_LIBRARIES __attribute__((visibility("default")))

/* Whether the code at this address is ours: of the program itself, or of such a library. */
static int is_ours(void *code)
{
    Dl_info found, program;
    if (!dladdr(code, &found) || !dladdr((void *)(uintptr_t)is_ours, &program)) return 0;
    const char *slash = strrchr(found.dli_fname, '/'), *name = slash ? slash + 1 : found.dli_fname;
    return found.dli_fbase == program.dli_fbase || !strncmp(name, "librestitute", 12);
}

/* Whether a call of the function `spared` is under way. */
static int is_spared(void)
{
    void *callers[32];
    Dl_info found;
    if (!allocator.spared) return 0;
    for (int i = backtrace(callers, 32) - 1; i >= 0; i--)
        if (dladdr(callers[i], &found) && found.dli_sname && !strcmp(found.dli_sname, allocator.spared)) return 1;
    return 0;
}

static int allocation_fails(void *caller)
{
    if (!allocator.armed || (allocator.ours_alone && !is_ours(caller))) return 0;
    if (allocator.others_alone && is_ours(caller)) return 0;
    const long number = ++allocator.count, failing = allocator.failing; /* 0: none */
    if (number != failing && !(allocator.for_good && failing && number > failing)) return 0;
    if (is_spared()) return 0;
    errno = ENOMEM;
    return 1;
}

static void *counted(void *block)
{
    allocator.live += block != NULL;
    return block;
}

#define ALLOCATES(declared, call)                                                                                      \
    SEEN_BY_LIBRARIES void *declared                                                                                   \
    {                                                                                                                  \
        return allocation_fails(__builtin_return_address(0)) ? NULL : counted(call);                                   \
    }
ALLOCATES(malloc(size_t size), __libc_malloc(size))
ALLOCATES(calloc(size_t count, size_t size), __libc_calloc(count, size))
ALLOCATES(memalign(size_t alignment, size_t size), __libc_memalign(alignment, size))
ALLOCATES(aligned_alloc(size_t alignment, size_t size), __libc_memalign(alignment, size))

SEEN_BY_LIBRARIES void *realloc(void *block, size_t size)
{
    if (allocation_fails(__builtin_return_address(0))) return NULL;
    return block ? __libc_realloc(block, size) : counted(__libc_realloc(block, size));
}

SEEN_BY_LIBRARIES int posix_memalign(void **block, size_t alignment, size_t size)
{
    void *found = allocation_fails(__builtin_return_address(0)) ? NULL : counted(__libc_memalign(alignment, size));
    if (!found) return ENOMEM;
    *block = found;
    return 0;
}

SEEN_BY_LIBRARIES void free(void *block)
{
    allocator.live -= block != NULL;
    __libc_free(block);
}
#endif

/* From now on no allocation fails within this function, which would crash. */
static inline void spare(const char *function)
{
#if CAN_FAIL
    backtrace((void *[1]){NULL}, 1); /* its first call allocates what stays */
#endif
    allocator.spared = function;
}

/* A call under test, armed. */
#define ARMED(status, call) (allocator.armed = 1, (status) = (call), allocator.armed = 0)

/* An address that no call gives: the output of a call that fails still has it. */
#define UNTOUCHED ((void *)(uintptr_t)&allocator)

/* Of a subject, the function `name`, whose call makes a restitute_TYPE, `made`; the rest gives what
 * is in it, and destroys it. */
#define MAKES(TYPE, name, call, ...)                                                                                   \
    static int name(struct given *given)                                                                               \
    {                                                                                                                  \
        int status;                                                                                                    \
        restitute_##TYPE *made = UNTOUCHED;                                                                            \
        ARMED(status, call);                                                                                           \
        CHECK(status >= 0 || made == UNTOUCHED, #TYPE " touched");                                                     \
        give(given, status);                                                                                           \
        if (status >= 0) __VA_ARGS__;                                                                                  \
        return status;                                                                                                 \
    }

enum { subject_numbers = 512 };

/* What a call gave, as numbers that two runs must share bit by bit. */
struct given {
    size_t count;
    double number[subject_numbers];
};

static inline void give(struct given *given, double number)
{
    CHECK(given->count < subject_numbers, "too many numbers");
    given->number[given->count++] = number;
}

/* `call` makes the call with ARMED, checks that outputs are untouched if it failed, and else gives
 * what came out. `begin` and `end`, both optional, make and destroy the objects that it uses.
 * `stride`: of the failing allocations all up to this number are tried, and about as many of each
 * that are twice as late; 0: all. `settles`: calls behind the second take no more memory. */
struct subject {
    const char *name;
    int (*call)(struct given *given);
    void (*begin)(void), (*end)(void);
    long stride;
    int settles;
};

static inline int subject_call(const struct subject *s, long failing, struct given *given)
{
    memset(given, 0, sizeof *given);
    allocator.count = 0;
    allocator.failing = failing;
    return s->call(given);
}

static inline void subject_must(const struct subject *s, long failing, const char *what, const struct given *expected)
{
    struct given given;
    const int status = subject_call(s, 0, &given);
    CHECK(status >= 0, "%s, allocation %ld: %s: status %d", s->name, failing, what, status);
    CHECK(memcmp(&given, expected, sizeof given) == 0, "%s, allocation %ld: %s: other numbers", s->name, failing, what);
}

/* One round with one failing allocation; 0: there are fewer allocations. */
static inline int subject_round(const struct subject *s, long failing, const struct given *expected, long *refused)
{
    struct given given;
    const long live = allocator.live;
    if (s->begin) s->begin();
    const int status = subject_call(s, failing, &given);
    const int reached = allocator.count >= failing;
    CHECK(status >= 0 || (reached && status == RESTITUTE_ERROR_MEMORY), "%s, allocation %ld: status %d", s->name,
          failing, status);
    *refused += status < 0;
    if (status >= 0)
        CHECK(memcmp(&given, expected, sizeof given) == 0, "%s, allocation %ld: other numbers", s->name, failing);
    subject_must(s, failing, "again", expected);
    if (s->settles) {
        subject_must(s, failing, "and again", expected);
        CHECK(allocator.count == 0, "%s: %ld allocations in later calls", s->name, allocator.count);
    }
    if (s->end) s->end();
    CHECK(allocator.live == live || allocator.others_lose, "%s, allocation %ld: %ld blocks lost", s->name, failing,
          allocator.live - live);
    return reached;
}

static inline void fail_each_allocation(const struct subject *s)
{
    struct given expected;
    if (s->begin) s->begin();
    const int status = subject_call(s, 0, &expected);
    CHECK(status >= 0, "%s: status %d", s->name, status);
    const long all = allocator.count;
    if (s->end) s->end();
    for (allocator.for_good = 0; allocator.for_good < 2; allocator.for_good++) {
        long refused = 0, failing = 1;
        while (subject_round(s, failing, &expected, &refused))
            failing += s->stride && failing > s->stride ? failing / s->stride : 1;
        CHECK(refused > 0 || all == 0, "%s: none of %ld allocations is missed", s->name, all);
    }
    allocator.for_good = 0;
    print_message("%s: %ld allocations\n", s->name, all);
}

/* Subjects, each in braces. */
#define FAIL_EACH(...)                                                                                                 \
    do {                                                                                                               \
        const struct subject all_[] = {__VA_ARGS__};                                                                   \
        for (size_t i_ = 0; i_ < sizeof all_ / sizeof *all_; i_++)                                                     \
            fail_each_allocation(&all_[i_]);                                                                           \
    } while (0)

#endif
