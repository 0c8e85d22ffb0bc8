/* What the targets share: bytes that become numbers and structs, and what must hold of every call.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_FUZZ_H
#define TEST_FUZZ_H

#include <fenv.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "../support/check.h"
#include "../support/prepared.h"
#include "../support/result.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* ---- bytes */

struct bytes {
    const uint8_t *at;
    size_t left;
};

/* The next n bytes as a number, low byte first; zeros beyond the end. */
static inline uint64_t take(struct bytes *b, int n)
{
    uint64_t value = 0;
    for (int i = 0; i < n; i++) {
        value |= (uint64_t)(b->left ? *b->at : 0) << 8 * i;
        b->at += b->left > 0;
        b->left -= b->left > 0;
    }
    return value;
}

static inline int below(struct bytes *b, int n)
{
    return (int)(take(b, 1) % (unsigned)n);
}

/* Mostly one of [low, high], evenly in its logarithm; else a special value, or any bits. */
static inline double number(struct bytes *b, double low, double high)
{
    const double special[] = {0,         -0.0,     1,         -1,     low,     high,    -low,
                              -high,     NAN,      INFINITY,  0.5,    DBL_MAX, DBL_MIN, DBL_TRUE_MIN,
                              0.5 * low, 2 * high, -INFINITY, 1e-300, 1e300,   -DBL_MAX};
    const unsigned kind = (unsigned)take(b, 1);
    if (kind < 200) return low * pow(high / low, (double)(256 * kind + take(b, 1)) / (256 * 200));
    if (kind < 240) return special[(kind - 200) % (sizeof special / sizeof *special)];
    const uint64_t bits = take(b, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline double signed_number(struct bytes *b, double low, double high)
{
    const double value = number(b, low, high);
    return below(b, 2) ? -value : value;
}

/* A copy of a struct, with some other struct_size at times, in a block of no more bytes than that
 * says: the address sanitizer sees what reads beyond. For free(). */
static inline void *sized(struct bytes *b, const void *value)
{
    const size_t own = *(const size_t *)value, step = sizeof(size_t);
    const size_t other[] = {0, 1, step, own - step, own + step, own - 1, own + 1, SIZE_MAX, (size_t)take(b, 2)};
    const unsigned kind = (unsigned)take(b, 1);
    const size_t size = kind < 240 ? own : other[kind % 9], room = size < own ? size : own;
    char *copy = malloc(room < step ? step : room);
    CHECK(copy, "out of memory");
    memcpy(copy, value, room < step ? step : room);
    memcpy(copy, &size, step);
    return copy;
}

/* ---- calls */

static restitute_error fuzz_error; /* of the last call */

/* A call that ends with an error: its status is known, told in one line, and no floating-point flag
 * is raised, unless a number was refused. CALL_FLAGS: any flag may be. */
#define CALL_IF(no_flags, function, ...)                                                                               \
    (before_call(), after_call(#function, function(__VA_ARGS__, &fuzz_error), no_flags))
#define CALL(function, ...) CALL_IF(1, function, __VA_ARGS__)
#define CALL_FLAGS(function, ...) CALL_IF(0, function, __VA_ARGS__)

static inline void before_call(void)
{
    memset(&fuzz_error, 0x5a, sizeof fuzz_error);
    feclearexcept(FE_ALL_EXCEPT);
}

static inline int after_call(const char *name, int status, int no_flags)
{
    const int flags = fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    const char *message = fuzz_error.message, *end = memchr(message, 0, sizeof fuzz_error.message);
    CHECK(strcmp(restitute_status_text(status), "unknown status") != 0, "%s: %d", name, status);
    CHECK(fuzz_error.status == status, "%s: %d in the error, %d returned", name, fuzz_error.status, status);
    CHECK(end, "%s: the message has no end", name);
    CHECK(status >= 0 || end > message, "%s: %d without a message", name, status);
    for (const char *c = message; c < end; c++)
        CHECK((unsigned char)*c >= ' ' && *c != 127, "%s: character %d in \"%s\"", name, *c, message);
    CHECK(!flags || !no_flags || status == RESTITUTE_ERROR_DOMAIN || status == RESTITUTE_ERROR_FORMAT,
          "%s: floating-point flags %x, status %d, \"%s\"", name, (unsigned)flags, status, message);
    CHECK(status != RESTITUTE_ERROR_INTERNAL, "%s: %s", name, message);
    return status;
}

/* ---- what calls are given */

/* Any solid: NULL where the library refuses it, which it may do at the borders alone. */
static inline restitute_material *any_material(struct bytes *b)
{
    double tau[32], g[32];
    restitute_material *material = NULL;
    const int count = (int)take(b, 1), terms = count < 224 ? count % 7 : count - 224, kind = below(b, 4);
    const double equilibrium = kind & 1 ? 0 : number(b, 1e-2, 1e12), nu = below(b, 2) ? 0.5 : number(b, 1e-3, 0.5);
    const double viscosity = kind & 2 ? number(b, 1e-8, 1e8) : 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = number(b, 1e-9, 1e9);
        g[k] = number(b, 1e-2, 1e12);
    }
    const int status = CALL(restitute_material_prony, equilibrium, viscosity, (size_t)terms, tau, g, nu, &material);
    CHECK((status == RESTITUTE_OK) == (material != NULL), "status %d", status);
    return material;
}

#endif
