/* The loop over elements gives the same bits in every vector width that this processor has.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../support/check.h"
#include "lanes.h"
#include "sync.h"

/* One impact through the method itself, with the loop told. psi > 1, partial slip, all kinds of solids. */
static struct rst_outcome solve(sync_loop *loop, double chi, double psi, double eta, int64_t n_terms, double tolerance)
{
    double g[] = {1.3, 0.4, 2.5}, tau[] = {0.01, 0.3, 1.7};
    struct rst_workspace workspace = {.loop = loop};
    struct rst_problem problem = {.chi = chi,
                                  .psi = psi,
                                  .mode = psi > 1 ? RST_GROSS_SLIP : RST_PARTIAL_SLIP,
                                  .solid = {.g_inf = 1, .eta = eta, .n_terms = n_terms, .g = g, .tau = tau},
                                  .tolerance = tolerance,
                                  .time_unit = 1,
                                  .unit_name = "T",
                                  .max_updates = 1000000000};
    struct rst_outcome outcome;
    restitute_error error;
    CHECK(rst_workspace_terms(&workspace, 3) == 0, "memory");
    const int status = rst_method_sync.solve(&problem, &workspace, 0, &outcome, &error);
    rst_workspace_free(&workspace);
    CHECK(status == RESTITUTE_OK, "%s", error.message);
    return outcome;
}

static void all_widths_give_the_same_bits(void **state)
{
    int compared = 0;
    (void)state;
    for (int i = 1; rst_lanes_variant(i).name; i++)
        for (int64_t terms = 0; terms <= 3; terms++)
            for (double psi = 0.1; psi < 2; psi += 0.3)
                for (double tolerance = 1e-2; tolerance > 1e-6; tolerance /= 7) {
                    const double eta = terms == 2 ? 0.2 : 0, chi = 0.6 + psi;
                    const struct rst_outcome a = solve(rst_sync_lanes_any, chi, psi, eta, terms, tolerance);
                    const struct rst_outcome b = solve(rst_lanes_variant(i).loop, chi, psi, eta, terms, tolerance);
                    CHECK(a.velocity == b.velocity && a.shear_velocity == b.shear_velocity &&
                              a.error_ex == b.error_ex && a.updates == b.updates,
                          "%s: %lld terms, psi %g: U' %.17g, not %.17g", rst_lanes_variant(i).name, (long long)terms,
                          psi, b.shear_velocity, a.shear_velocity);
                    compared++;
                }
    if (compared == 0) skip();
}

static void the_list_begins_with_what_every_processor_has(void **state)
{
    (void)state;
    CHECK(rst_lanes_variant(0).loop == rst_sync_lanes_any, "first variant");
    CHECK(rst_lanes_variant(1000).name == NULL, "the list ends");
    CHECK(rst_widest_lanes() != NULL, "widest");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_widths_give_the_same_bits),
                                       cmocka_unit_test(the_list_begins_with_what_every_processor_has)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
