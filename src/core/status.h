/* Setting the optional error of a call, and the checks that most calls share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_STATUS_H
#define RST_STATUS_H

#include <restitute/restitute.h>

#if defined(__GNUC__)
#define RST_PRINTF(position, first) __attribute__((__format__(__printf__, position, first)))
#else
#define RST_PRINTF(position, first)
#endif

/* Fill `error` (if wanted) and return `status`. */
int rst_report(restitute_error *error, int status, const char *format, ...) RST_PRINTF(3, 4);

/* Clear `error` (if wanted) and return OK. */
int rst_done(restitute_error *error);

/* The struct was prepared by its _init function, of this version. */
int rst_check_size(size_t found, size_t expected, const char *name, restitute_error *error);

/* low <= value <= high; NaN fails. */
int rst_check_range(double value, double low, double high, const char *name, restitute_error *error);

/* 0 < value < infinity, or <= infinity where that has a meaning. */
int rst_check_positive(double value, int infinity_allowed, const char *name, restitute_error *error);

/* Any finite value. */
int rst_check_finite(double value, const char *name, restitute_error *error);

#endif
