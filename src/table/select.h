/* Selections of numbers that are not foreseen: compilers like to make branches of `?:`, and every other lookup would
 * take the wrong one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_SELECT_H
#define RST_TABLE_SELECT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/* a > b ? a : b; b if one is NaN. */
static inline double rst_larger(double a, double b)
{
#if defined(__SSE2__)
    return _mm_cvtsd_f64(_mm_max_sd(_mm_set_sd(a), _mm_set_sd(b)));
#else
    return a > b ? a : b;
#endif
}

/* a < b ? a : b; b if one is NaN. */
static inline double rst_smaller(double a, double b)
{
#if defined(__SSE2__)
    return _mm_cvtsd_f64(_mm_min_sd(_mm_set_sd(a), _mm_set_sd(b)));
#else
    return a < b ? a : b;
#endif
}

/* a > b ? yes : no. */
static inline double rst_if_larger(double a, double b, double yes, double no)
{
#if defined(__SSE2__)
    const __m128d mask = _mm_cmpgt_sd(_mm_set_sd(a), _mm_set_sd(b));
    return _mm_cvtsd_f64(_mm_or_pd(_mm_and_pd(mask, _mm_set_sd(yes)), _mm_andnot_pd(mask, _mm_set_sd(no))));
#else
    return a > b ? yes : no;
#endif
}

/* Two numbers, and two as they stand in an array. */
#if defined(__GNUC__)
typedef double rst_two __attribute__((__vector_size__(16)));
typedef double rst_kept_two __attribute__((__vector_size__(16), __aligned__(8), __may_alias__));
typedef int64_t rst_whole_two __attribute__((__vector_size__(16)));
_Static_assert(_Alignof(rst_two) <= _Alignof(max_align_t), "such numbers are kept in memory from malloc");
#else
#error "select.h needs the vector types of gcc and clang"
#endif

static inline rst_two rst_two_at(const double *c)
{
    return *(const rst_kept_two *)(const void *)c;
}

static inline rst_two rst_two_of(double x)
{
    return (rst_two){x, x};
}

static inline rst_two rst_two_turned(rst_two a)
{
    return (rst_two){a[1], a[0]};
}

/* rst_larger and rst_smaller of both. */
static inline rst_two rst_two_larger(rst_two a, rst_two b)
{
#if defined(__SSE2__)
    return (rst_two)_mm_max_pd((__m128d)a, (__m128d)b);
#else
    return (rst_two){rst_larger(a[0], b[0]), rst_larger(a[1], b[1])};
#endif
}

static inline rst_two rst_two_smaller(rst_two a, rst_two b)
{
#if defined(__SSE2__)
    return (rst_two)_mm_min_pd((__m128d)a, (__m128d)b);
#else
    return (rst_two){rst_smaller(a[0], b[0]), rst_smaller(a[1], b[1])};
#endif
}

/* NaN: low. */
static inline double rst_clamp(double value, double low, double high)
{
    return rst_smaller(rst_larger(value, low), high);
}

#endif
