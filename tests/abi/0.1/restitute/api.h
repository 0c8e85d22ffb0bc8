/** @file api.h
 *  Version, exported functions and growing structs: what all headers of `restitute` share.
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_API_H
#define RESTITUTE_API_H

#include <stddef.h>
#include <stdint.h>

/** Version of these headers; @ref restitute_version is that of the library in use. */
#define RESTITUTE_VERSION_MAJOR 0
#define RESTITUTE_VERSION_MINOR 1
#define RESTITUTE_VERSION_PATCH 0

/** To compare versions: `#if RESTITUTE_VERSION >= RESTITUTE_VERSION_OF(0, 2, 0)`. */
#define RESTITUTE_VERSION_OF(major, minor, patch) ((major) * 10000 + (minor) * 100 + (patch))
#define RESTITUTE_VERSION                                                                          \
    RESTITUTE_VERSION_OF(RESTITUTE_VERSION_MAJOR, RESTITUTE_VERSION_MINOR, RESTITUTE_VERSION_PATCH)

/** An exported function, and the version since which there is one. */
#if defined(__GNUC__) && !defined(_WIN32)
#define RESTITUTE_SINCE_0_1 __attribute__((visibility("default")))
#else
#define RESTITUTE_SINCE_0_1
#endif

/** Declares restitute_NAME_init(&value), which sets the defaults that stand beside the members.
 *
 *  It tells the library how long the caller's struct is, so that a program keeps working with a
 *  later library whose struct has more members. Languages without inline functions call
 *  restitute_NAME_init_sized. A struct longer than the library's gets zeros behind the
 *  members that the library knows: the program was compiled with later headers, and every call that
 *  is given the struct refuses it. */
#define RESTITUTE_INIT(since, name)                                                                \
    since void restitute_##name##_init_sized(restitute_##name *value, size_t size);                \
    static inline void restitute_##name##_init(restitute_##name *value)                            \
    {                                                                                              \
        restitute_##name##_init_sized(value, sizeof *value);                                       \
    }

#endif
