/* Selections of numbers that are not foreseen: compilers like to make branches of `?:`, and every other lookup would
 * take the wrong one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_SELECT_H
#define RST_TABLE_SELECT_H

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

/* NaN: low. */
static inline double rst_clamp(double value, double low, double high)
{
    return rst_smaller(rst_larger(value, low), high);
}

#endif
