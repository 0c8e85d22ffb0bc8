/* One impact that takes longer than its limit of time.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_TIME_LIMIT_H
#define TEST_TIME_LIMIT_H

#include <string.h>
#include <time.h>

#include "solve.h"

/* The call ends in time, with a status that the tolerance was missed and a message that names the
 * limit. It may take five times the limit: twice is promised, and clock() includes other work of
 * the process. The accuracy of the result depends on the machine, but that of the estimate does
 * not: one in twenty may be too low, and none by a factor of three. `ex` is by `sync` at 1e-7.
 * `limit` 0: the default, 1 s. */
static inline void check_time_limit(restitute_options options, restitute_impact impact, double limit, double ex)
{
    const double seconds = limit > 0 ? limit : 1;
    char named[40];
    restitute_solver *solver;
    restitute_result r;
    restitute_error error;
    restitute_result_init(&r);
    options.time_limit = limit;
    snprintf(named, sizeof named, "time_limit = %g s", seconds);
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    const clock_t start = clock();
    const int status = restitute_solve(solver, &impact, &r, NULL, NULL, &error);
    const double taken = (double)(clock() - start) / CLOCKS_PER_SEC;
    restitute_solver_destroy(solver);
    CHECK(status == RESTITUTE_TOLERANCE_NOT_REACHED, "status %d: %s", status, error.message);
    CHECK(strstr(error.message, named) != NULL, "\"%s\" is not in \"%s\"", named, error.message);
    CHECK(taken <= 5 * seconds, "%g s, %s", taken, named);
    CHECK(r.error_ex > options.tolerance && fabs(r.ex - ex) <= 3 * r.error_ex, "ex %g +- %g", r.ex, r.error_ex);
}

#endif
