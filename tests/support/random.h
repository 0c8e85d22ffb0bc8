/* Seeded random numbers (SplitMix64): the same on every machine, so that a failing case can be
 * named by its number. One draw a declaration: C leaves it to the compiler which argument of a call
 * is made first.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef SUPPORT_RANDOM_H
#define SUPPORT_RANDOM_H

#include <math.h>
#include <stdint.h>

static inline uint64_t random_bits(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Even in [low, high). */
static inline double random_in(uint64_t *state, double low, double high)
{
    return low + (high - low) * (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* Even in the logarithm; 0 < low < high. */
static inline double random_log(uint64_t *state, double low, double high)
{
    return exp(random_in(state, log(low), log(high)));
}

/* 0 to n - 1. */
static inline int random_below(uint64_t *state, int n)
{
    return (int)(random_bits(state) % (uint64_t)n);
}

#endif
