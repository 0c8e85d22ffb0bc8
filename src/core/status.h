/* The checks that most calls share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_STATUS_H
#define RST_STATUS_H

#include "report.h"

/* The struct was prepared by its _init function, of this version. */
int rst_check_size(size_t found, size_t expected, const char *name, restitute_error *error);

/* low <= value <= high; NaN fails. */
int rst_check_range(double value, double low, double high, const char *name, restitute_error *error);

/* 0 < value < infinity, or <= infinity where that has a meaning. */
int rst_check_positive(double value, int infinity_allowed, const char *name, restitute_error *error);

/* Any finite value. */
int rst_check_finite(double value, const char *name, restitute_error *error);

#endif
