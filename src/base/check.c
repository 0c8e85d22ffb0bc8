/* Checks of single values; every message names the value, the place and the allowed range.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/status.h"

int rst_check_range(double value, double low, double high, const char *name, restitute_error *error)
{
    if (value >= low && value <= high) return RESTITUTE_OK;
    if (isinf(high))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be >= %g (inf allowed)", name, value, low);
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be in [%g, %g]", name, value, low, high);
}

int rst_check_within(double value, struct rst_range range, double besides, const char *name, restitute_error *error)
{
    if (rst_is_within(value, range, besides)) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %.17g: must be in [%g, %g]%s", name, value, range.low,
                      range.high,
                      besides == 0     ? " or 0"
                      : isinf(besides) ? " or inf"
                                       : "");
}
