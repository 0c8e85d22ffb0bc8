/* Structs that grow at their end: a caller's is shorter than ours where it was compiled with older
 * headers.
 *
 * RST_DEFAULTS defines the _init_sized function of a struct. An entry point reads an input through
 * a copy of full length (RST_TAKE), checks an output (RST_CHECK) and writes no more of it than the
 * caller has (RST_GIVE). Of an array all structs have one size (RST_CHECK_ARRAY). Hot calls read in
 * place what every caller has: the members of the first release.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SIZED_H
#define RST_SIZED_H

#include <restitute/restitute.h>

#include "base/first_release.h"

struct rst_layout {
    const char *name;
    size_t first, size; /* bytes in the first release that has the struct, and now */
};

#define RST_SIZE_UP_TO(type, member) (offsetof(type, member) + sizeof(((type *)0)->member))

#define RST_LAYOUT(NAME)                                                                                               \
    {                                                                                                                  \
        "restitute_" #NAME, RST_SIZE_UP_TO(restitute_##NAME, RST_LAST_##NAME), sizeof(restitute_##NAME)                \
    }

/* Defines restitute_NAME_init_sized with the defaults that are named; all else is 0. A size below
 * that of struct_size leaves the value as it is. */
#define RST_DEFAULTS(NAME, ...)                                                                                        \
    void restitute_##NAME##_init_sized(restitute_##NAME *value, size_t size)                                           \
    {                                                                                                                  \
        static const restitute_##NAME defaults = {__VA_ARGS__};                                                        \
        rst_init(value, size, &defaults, sizeof defaults);                                                             \
    }

/* A status: `value`, a struct restitute_NAME of the caller, was prepared with headers that are not
 * later than ours. */
#define RST_CHECK(NAME, value, error) rst_check_layout(&(const struct rst_layout)RST_LAYOUT(NAME), value, error)

/* The same in a hot call, in place: no function is called. */
#define RST_IS_SIZED(NAME, value)                                                                                      \
    (RST_SIZE_UP_TO(restitute_##NAME, RST_LAST_##NAME) <= (value)->struct_size &&                                      \
     (value)->struct_size <= sizeof *(value) && (value)->struct_size % sizeof(size_t) == 0)

/* A status: all n structs of an array, the argument `argument`, have one such size. */
#define RST_CHECK_ARRAY(NAME, array, n, argument, error)                                                               \
    rst_check_array(&(const struct rst_layout)RST_LAYOUT(NAME), array, n, argument, error)

/* A status: checks theirs and copies them into ours. Members that they have not get their defaults,
 * all members if theirs are NULL. */
#define RST_TAKE(NAME, ours, theirs, error)                                                                            \
    (restitute_##NAME##_init(ours), rst_take(&(const struct rst_layout)RST_LAYOUT(NAME), ours, theirs, error))

/* Copies ours into theirs (already checked), as far as they have it. */
#define RST_GIVE(ours, theirs) rst_copy(theirs, sizeof *(theirs), ours)

void rst_init(void *value, size_t size, const void *defaults, size_t size_of_defaults);

int rst_check_layout(const struct rst_layout *layout, const void *value, restitute_error *error);

int rst_check_array(const struct rst_layout *layout, const void *array, size_t n, const char *name,
                    restitute_error *error);

int rst_take(const struct rst_layout *layout, void *ours, const void *theirs, restitute_error *error);

/* All but struct_size, as long as the shorter of both; `size` is our own size of either. */
void rst_copy(void *to, size_t size, const void *from);

/* The i-th of an array of the caller's: the first names the distance. */
static inline void *rst_at(const void *array, size_t i)
{
    return (char *)array + i * *(const size_t *)array;
}

#endif
