/* What is promised of structs that grow at their end.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SIZED_H
#define TEST_SIZED_H

#include <restitute/restitute.h>
#include <string.h>

#include "check.h"

enum { guarded_bytes = 16384 };

/* `call` of a struct restitute_NAME at `place`, of which `why` is the error: it refuses one that is
 * shorter than in the first release and one that is longer than the library's, says which, and
 * touches nothing of them. Nor does the init function write beyond the size that it is given. What
 * a longer one has beyond ours becomes 0. No padding is behind the last member, since a later one
 * must begin behind the struct of an old caller. */
#define CHECK_SIZES(NAME, last, place, why, call)                                                                      \
    do {                                                                                                               \
        _Static_assert(offsetof(restitute_##NAME, last) + sizeof((restitute_##NAME *)0)->last ==                       \
                           sizeof(restitute_##NAME),                                                                   \
                       "restitute_" #NAME " ends with padding");                                                       \
        const size_t own_ = sizeof(restitute_##NAME), sizes_[] = {own_ - sizeof(double), own_ + sizeof(double)};       \
        for (int longer_ = 0; longer_ < 2; longer_++) {                                                                \
            memset(place, 0xa5, guarded_bytes);                                                                        \
            restitute_##NAME##_init_sized((void *)(place), sizes_[longer_]);                                           \
            check_prepared(place, own_, sizes_[longer_]);                                                              \
            const int status_ = (call);                                                                                \
            CHECK(status_ == RESTITUTE_ERROR_STRUCT_SIZE, "%s, %zu bytes: %d", #call, sizes_[longer_], status_);       \
            check_words("restitute_" #NAME, sizes_[longer_], longer_, (why)->message);                                 \
            CHECK(memcmp(place, prepared_place, guarded_bytes) == 0, "%s has written", #call);                         \
        }                                                                                                              \
    } while (0)

static inline void check_words(const char *name, size_t size, int longer, const char *message)
{
    char words[100];
    snprintf(words, sizeof words, "%s.struct_size = %zu: must be ", name, size);
    CHECK(strstr(message, words), "\"%s\" does not say \"%s\"", message, words);
    snprintf(words, sizeof words, "prepare the struct with %s_init", name);
    CHECK(strstr(message, longer ? "compiled with later headers" : words), "%s", message);
}

static unsigned char prepared_place[guarded_bytes]; /* as the init function left it */

static inline void check_prepared(const unsigned char *place, size_t own, size_t size)
{
    size_t found;
    memcpy(&found, place, sizeof found);
    CHECK(found == size, "struct_size %zu in place of %zu", found, size);
    for (size_t i = own; i < size; i++)
        CHECK(place[i] == 0, "byte %zu of a struct of %zu bytes is not 0", i, size);
    for (size_t i = size; i < guarded_bytes; i++)
        CHECK(place[i] == 0xa5, "byte %zu of a struct of %zu bytes was written", i, size);
    memcpy(prepared_place, place, guarded_bytes);
}

#endif
