/* Campaign: the error of a method over the whole domain of the default tolerance, against sync at 1e-8.
 *
 *     default_error CASES SEED FILE.csv [euler|sync [TOLERANCE]]      default euler 1e-3; summary on stderr
 *
 * The precise runs are checked against independent truth values by tests/physics. SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/restitute.h>

#include "../support/random.h"

static const double reference_tolerance = 1e-8;

static uint64_t state;

static double uniform(void)
{
    return random_in(&state, 0, 1);
}

static double log_uniform(double low, double high)
{
    return low * pow(high / low, uniform());
}

/* The domain in which the default error is promised; one case in six on a face of it. */
static void draw(restitute_impact *impact)
{
    restitute_impact_init(impact);
    double face = uniform();
    impact->chi = uniform() < 0.4 ? 7.0 / 6.0 : 1.0 / 3.0 + uniform() * (4 - 1.0 / 3.0);
    impact->psi = log_uniform(0.05, 10);
    impact->delta1 = log_uniform(1e-3, 100);
    impact->gamma = log_uniform(1e-3, 1e3);
    if (face < 0.06) impact->delta1 = 0;
    if (face > 0.94) impact->gamma = 0;
    if (face > 0.45 && face < 0.48) impact->psi = 0.05;
    if (face > 0.48 && face < 0.51) impact->chi = 4;
    if (face > 0.51 && face < 0.53) impact->chi = 1.0 / 3.0;
}

static int solve(restitute_solver *solver, const restitute_impact *impact, restitute_result *result)
{
    restitute_error error;
    restitute_result_init(result);
    int status = restitute_solve(solver, impact, result, NULL, NULL, &error);
    if (status < 0) fprintf(stderr, "status %d: %s\n", status, error.message);
    return status < 0;
}

struct summary {
    double worst_ez, worst_ex, worst_ratio;
    int above, underestimated;
};

static void compare(const restitute_impact *i, const restitute_result *r, const restitute_result *finer,
                    double tolerance, FILE *out, struct summary *s)
{
    double ez = fabs(r->ez - finer->ez), ex = fabs(r->ex - finer->ex);
    fprintf(out, "%.17g,%.17g,%.17g,%.17g,%.9f,%.9f,%.3e,%.3e,%.3e,%.3e,%lld,%lld\n", i->chi, i->psi, i->delta1,
            i->gamma, finer->ez, finer->ex, ez, ex, r->error_ez, r->error_ex, (long long)r->elements,
            (long long)r->steps);
    s->worst_ez = fmax(s->worst_ez, ez);
    s->worst_ex = fmax(s->worst_ex, ex);
    s->above += ez > tolerance || ex > tolerance;
    s->underestimated += ez > r->error_ez + finer->error_ez || ex > r->error_ex + finer->error_ex;
    s->worst_ratio = fmax(s->worst_ratio, (ez - finer->error_ez) / r->error_ez);
    if (r->error_ex > 0) s->worst_ratio = fmax(s->worst_ratio, (ex - finer->error_ex) / r->error_ex);
}

int main(int argc, char **argv)
{
    restitute_options options, tested;
    restitute_solver *standard, *fine;
    struct summary summary = {0};
    if (argc < 4 || argc > 6) {
        fprintf(stderr, "usage: default_error CASES SEED FILE.csv [euler|sync [TOLERANCE]]\n");
        return 2;
    }
    long cases = strtol(argv[1], NULL, 10);
    state = strtoull(argv[2], NULL, 10);
    FILE *out = fopen(argv[3], "w");
    restitute_options_init(&options);
    restitute_options_init(&tested);
    options.method = restitute_method_sync();
    options.tolerance = reference_tolerance;
    if (argc > 4 && strcmp(argv[4], "sync") == 0) tested.method = restitute_method_sync();
    if (argc > 5) tested.tolerance = strtod(argv[5], NULL);
    if (!out || restitute_solver_create(&tested, &standard, NULL) || restitute_solver_create(&options, &fine, NULL)) {
        fprintf(stderr, "default_error: cannot write %s or out of memory\n", argv[3]);
        return 1;
    }
    fprintf(out, "chi,psi,delta1,gamma,ez,ex,true_error_ez,true_error_ex,estimate_ez,estimate_ex,elements,steps\n");
    for (long n = 0; n < cases; n++) {
        restitute_impact impact;
        restitute_result result, finer;
        draw(&impact);
        if (solve(standard, &impact, &result) || solve(fine, &impact, &finer)) continue;
        compare(&impact, &result, &finer, tested.tolerance, out, &summary);
        fflush(out);
        if ((n + 1) % 50 == 0 || n + 1 == cases)
            fprintf(stderr,
                    "%ld of %ld: worst ez %.2e, ex %.2e; %d above %g; %d above their estimate, at most %.1f times\n",
                    n + 1, cases, summary.worst_ez, summary.worst_ex, summary.above, tested.tolerance,
                    summary.underestimated, summary.worst_ratio);
    }
    restitute_solver_destroy(standard);
    restitute_solver_destroy(fine);
    return fclose(out) != 0 || summary.above > 0;
}
