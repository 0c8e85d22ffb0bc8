/* Temperatures of measurements, and their time shifts.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/report.h"
#include "fit/model.h"

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* NaN: at T_r - c2 or below, where the law has its pole, or a shift beyond 1e30, where no
 * relaxation time is left. */
double rst_temperatures_wlf(const struct rst_temperatures *t, size_t k)
{
    const double difference = t->value[k] - t->reference_value, shift = -t->c1 * difference / (t->c2 + difference);
    return t->c2 + difference > 0 && fabs(shift) <= 30 ? shift : NAN;
}

/* Sort into distinct ones; invalid values are refused. */
static int add(double value, const char *place, struct rst_temperatures *t, restitute_error *error)
{
    size_t k = 0;
    if (isinf(value)) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s.temperature = %g: must be finite", place, value);
    if (isnan(t->reference_value))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "%s.temperature = %g: the first one or options.reference_temperature must be given too", place, value);
    while (k < t->count && t->value[k] != value)
        k++;
    if (k == RESTITUTE_DMA_SHIFTS)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s: more than %d temperatures", place, RESTITUTE_DMA_SHIFTS);
    t->value[k] = value;
    if (k == t->count) t->count++;
    if (isnan(t->c1) || !isnan(rst_temperatures_wlf(t, k))) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "%s.temperature = %g: must be above the pole of WLF, %g, with a_T in [1e-30, 1e30]", place, value,
                      t->reference_value - t->c2);
}

int rst_temperatures_sort(size_t n, const double *measured, const char *what, struct rst_temperatures *t, size_t *at,
                          restitute_error *error)
{
    char place[40];
    if (isnan(t->c1) != isnan(t->c2))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "options.wlf_c1, wlf_c2: must be both given or both NaN");
    if (isnan(t->reference_value)) t->reference_value = measured[0];
    t->value[0] = t->reference_value, t->count = 1;
    for (size_t i = 0; i < n; i++) {
        snprintf(place, sizeof place, "%s[%zu]", what, i);
        const int status = isnan(measured[i]) ? RESTITUTE_OK : add(measured[i], place, t, error);
        if (status) return status;
    }
    qsort(t->value, t->count, sizeof *t->value, ascending);
    while (t->value[t->reference] < t->reference_value)
        t->reference++;
    for (size_t i = 0; i < n; i++) {
        at[i] = isnan(measured[i]) ? t->reference : 0;
        while (!isnan(measured[i]) && t->value[at[i]] < measured[i])
            at[i]++;
    }
    return RESTITUTE_OK;
}
