/* The method sync gives the same bits in every vector width that this processor has.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../support/check.h"
#include "../support/random.h"
#include "sync.h"

/* One impact through the method itself, by the kernel told. */
static struct rst_outcome solve(const struct sync_kernel *kernel, double chi, double psi, struct rst_solid solid,
                                double tolerance, int *status)
{
    struct rst_workspace workspace = {.kernel = kernel};
    struct rst_problem problem = {.chi = chi,
                                  .psi = psi,
                                  .mode = psi > 1 ? RST_GROSS_SLIP : RST_PARTIAL_SLIP,
                                  .solid = solid,
                                  .tolerance = tolerance,
                                  .time_unit = 1,
                                  .unit_name = "T",
                                  .max_updates = 1000000000};
    struct rst_outcome outcome = {0};
    restitute_error error;
    CHECK(rst_workspace_terms(&workspace, 3) == 0, "memory");
    *status = rst_method_sync.solve(&problem, &workspace, 0, &outcome, &error);
    rst_workspace_free(&workspace);
    return outcome;
}

static void compare(const struct sync_kernel *kernel, double chi, double psi, struct rst_solid solid, double tolerance)
{
    int status_a, status_b;
    const struct rst_outcome a = solve(rst_sync_kernel(0), chi, psi, solid, tolerance, &status_a);
    const struct rst_outcome b = solve(kernel, chi, psi, solid, tolerance, &status_b);
    CHECK(status_a == status_b && a.velocity == b.velocity && a.shear_velocity == b.shear_velocity &&
              a.error_ez == b.error_ez && a.error_ex == b.error_ex && a.contact_time == b.contact_time &&
              a.max_normal_force == b.max_normal_force && a.updates == b.updates,
          "%s: %lld terms, chi %.17g, psi %.17g, tolerance %g: U' %.17g, not %.17g", kernel->name,
          (long long)solid.n_terms, chi, psi, tolerance, b.shear_velocity, a.shear_velocity);
}

/* psi up to 2, all kinds of solids. */
static void all_widths_give_the_same_bits(void **state)
{
    double g[] = {1.3, 0.4, 2.5}, tau[] = {0.01, 0.3, 1.7};
    (void)state;
    if (!rst_sync_kernel(1)) skip();
    for (int i = 1; rst_sync_kernel(i); i++)
        for (int64_t terms = 0; terms <= 3; terms++)
            for (double psi = 0.01; psi < 2; psi += 0.29)
                for (double tolerance = 1e-2; tolerance > 1e-6; tolerance /= 7) {
                    const struct rst_solid solid = {
                        .g_inf = 1, .eta = terms == 2 ? 0.2 : 0, .n_terms = terms, .g = g, .tau = tau};
                    compare(rst_sync_kernel(i), 0.6 + psi, psi, solid, tolerance);
                }
}

/* Standard solids and Kelvin-Voigt ones, fronts and elements. */
static void random_impacts_too(void **state)
{
    uint64_t seed = 4;
    (void)state;
    if (!rst_sync_kernel(1)) skip();
    for (int i = 1; rst_sync_kernel(i); i++)
        for (int k = 0; k < 2000; k++) {
            const double chi = random_in(&seed, 0.6, 3), psi = random_in(&seed, 0, 3);
            const double theta = random_log(&seed, 1e-3, 30), gamma = random_log(&seed, 1e-3, 100);
            double g = 1 / gamma, tau = gamma * theta;
            const int viscous = k % 8 == 0;
            const struct rst_solid solid = {
                .g_inf = 1, .eta = viscous ? theta : 0, .n_terms = viscous ? 0 : 1, .g = &g, .tau = &tau};
            compare(rst_sync_kernel(i), chi, psi, solid, random_log(&seed, 1e-6, 1e-2));
        }
}

static void the_list_begins_with_what_every_processor_has(void **state)
{
    (void)state;
    CHECK(rst_sync_kernel(0) != NULL, "first variant");
    CHECK(rst_sync_kernel(1000) == NULL, "the list ends");
    CHECK(rst_widest_sync_kernel() != NULL, "widest");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_widths_give_the_same_bits), cmocka_unit_test(random_impacts_too),
                                       cmocka_unit_test(the_list_begins_with_what_every_processor_has)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
