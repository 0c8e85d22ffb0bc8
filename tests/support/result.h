/* What holds of every result.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_RESULT_H
#define TEST_RESULT_H

#include <math.h>
#include <restitute/restitute.h>

static inline int is_pair(double ez, double ex)
{
    return ez >= 0 && ez <= 1 && ex >= -1 && ex <= 1; /* false for NaN */
}

/* What is wrong with the result of a call that returned `status`; NULL: nothing. */
static inline const char *fault_of(const restitute_result *r, int status)
{
    const double not_negative[] = {
        r->error_ez,      r->error_ex, r->max_indentation, r->max_contact_radius, r->max_normal_force,
        r->merging_bound, r->work,     (double)r->steps};
    if (!is_pair(r->ez, r->ex)) return "no pair";
    for (size_t i = 0; i < sizeof not_negative / sizeof *not_negative; i++)
        if (!(not_negative[i] >= 0)) return "a number is negative";
    if (!(r->contact_time > 0)) return "no contact time";
    if (status == RESTITUTE_NO_REBOUND && !(r->ez == 0 && isinf(r->contact_time))) return "NO_REBOUND with a rebound";
    if (!r->method || !*r->method) return "no method";
    return NULL;
}

#endif
