/* A user's program that solves an impact by boundary elements. Exit status 0 if it rebounds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/bem.h>

int main(void)
{
    restitute_options options;
    restitute_solver *solver = NULL;
    restitute_impact impact;
    restitute_result result;
    restitute_error error;
    restitute_options_init(&options);
    options.method = restitute_method_bem();
    options.tolerance = 0.01;
    restitute_impact_init(&impact);
    impact.psi = 0.7, impact.delta1 = 1, impact.gamma = 1;
    restitute_result_init(&result);
    if (restitute_solver_create(&options, &solver, &error) < 0 ||
        restitute_solve(solver, &impact, &result, NULL, NULL, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("%s: ez = %.3f, ex = %.3f\n", result.method, result.ez, result.ex);
    restitute_solver_destroy(solver);
    return !(result.ez > 0);
}
