/* The checks that most calls share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_STATUS_H
#define RST_STATUS_H

#include "base/ranges.h"
#include "base/report.h"

/* low <= value <= high; NaN fails. */
int rst_check_range(double value, double low, double high, const char *name, restitute_error *error);

static inline int rst_is_within(double value, struct rst_range range, double besides)
{
    return (value >= range.low && value <= range.high) || value == besides;
}

/* In the range, or equal to `besides`: 0 or infinity where that has a meaning; NAN if neither
 * has. */
int rst_check_within(double value, struct rst_range range, double besides, const char *name, restitute_error *error);

#endif
