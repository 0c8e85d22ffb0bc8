/* Checks for the cmocka tests that say, when they fail, what was compared with what and why it
 * matters. With PLAIN_CHECKS, for programs without cmocka, what fails ends by a signal.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CHECK_H
#define TEST_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef PLAIN_CHECKS
#include <stdlib.h>
#define print_error(...) fprintf(stderr, __VA_ARGS__)
#define fail() (fprintf(stderr, "%s:%d\n", __FILE__, __LINE__), abort())
#else
#include <cmocka.h>
#endif

/* The condition holds; the rest is a printf format and its values, shown if it does not. */
#define CHECK(condition, ...)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            print_error("%s: ", #condition);                                                                           \
            print_error(__VA_ARGS__);                                                                                  \
            print_error("\n");                                                                                         \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

/* |found - expected| <= tolerance; false for NaN. */
#define CHECK_NEAR(found, expected, tolerance, ...)                                                                    \
    do {                                                                                                               \
        double found_ = (found), expected_ = (expected), tolerance_ = (tolerance);                                     \
        if (!(fabs(found_ - expected_) <= tolerance_)) {                                                               \
            print_error("%s = %.17g, expected %.17g, off by %.3g, tolerance %.3g: ", #found, found_, expected_,        \
                        found_ - expected_, tolerance_);                                                               \
            print_error(__VA_ARGS__);                                                                                  \
            print_error("\n");                                                                                         \
            fail();                                                                                                    \
        }                                                                                                              \
    } while (0)

#endif
