/* One impact that takes longer than its limit of time.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_TIME_LIMIT_H
#define TEST_TIME_LIMIT_H

#include <math.h>
#include <string.h>
#include <time.h>

#include "solve.h"

/* The call ends in time, with a status that the tolerance was missed and a message that names the
 * limit. It may take five times the limit: twice is promised, and clock() includes other work of
 * the process. The accuracy of the result depends on the machine, but that of the estimate does
 * not: one in twenty may be too low, and none by a factor of three. `ex` is by `sync` at 1e-7.
 * `limit` 0: the default, 1 s. Slow builds (sanitizers) may have no result at all by then: for them
 * the limit is doubled, at most four times. */
static inline void check_time_limit(restitute_options options, restitute_impact impact, double limit, double ex)
{
    double seconds, taken;
    char named[40];
    PREPARED(result, r);
    restitute_error error;
    int status, doublings = 0;
    do {
        options.time_limit = ldexp(limit, doublings);
        seconds = limit > 0 ? options.time_limit : 1;
        snprintf(named, sizeof named, "time_limit = %g s", seconds);
        restitute_solver *solver = make_solver(&options);
        const clock_t start = clock();
        status = restitute_solve(solver, &impact, &r, NULL, NULL, &error);
        taken = (double)(clock() - start) / CLOCKS_PER_SEC;
        restitute_solver_destroy(solver);
    } while (status == RESTITUTE_ERROR_TOO_MUCH_WORK && doublings++ < 4);
    CHECK(status == RESTITUTE_TOLERANCE_NOT_REACHED, "status %d: %s", status, error.message);
    CHECK(strstr(error.message, named) != NULL, "\"%s\" is not in \"%s\"", named, error.message);
    CHECK(taken <= 5 * seconds, "%g s, %s", taken, named);
    CHECK(r.error_ex > options.tolerance && fabs(r.ex - ex) <= 3 * r.error_ex, "ex %g +- %g", r.ex, r.error_ex);
}

#endif
