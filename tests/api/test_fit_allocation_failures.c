/* Allocations of the component fit fail in turn: ERROR_MEMORY, outputs untouched, no leak, and the
 * same call gives the same bits afterwards. First only our own; then those of GSL as well, which
 * leaks blocks.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"
#include "../support/fit.h"

enum { N = 4 };

static int fit_with(size_t n, int model, int loss, struct given *given)
{
    static const double times[N] = {3.0e-3, 2.62e-3, 2.40e-3, 2.28e-3};
    restitute_scene scenes[N];
    restitute_fit_point points[N];
    restitute_fit_options options = fit_options(model);
    PREPARED(fit_result, r);
    restitute_error error;
    int status;
    drops(n, 0.1, 0.4, scenes, points);
    for (size_t i = 0; i < n; i++)
        points[i].contact_time = times[i],
        points[i].ez = model == RESTITUTE_FIT_MODEL_ELASTIC ? NAN : 0.9 - 0.01 * (double)i;
    options.starts = 1, options.loss = loss;
    r.rms = 77;
    ARMED(status, restitute_fit(n, points, &options, &r, &error));
    CHECK(status >= 0 || r.rms == 77, "touched");
    if (status < 0) return status;
    for (size_t i = 0; i < r.constants; i++)
        give(given, r.value[i]), give(given, r.low[i]), give(given, r.high[i]);
    give(given, r.rms);
    give(given, (double)r.impacts);
    restitute_material_destroy(r.material);
    return status;
}

#define FIT(name, n, model, loss)                                                                                      \
    static int name(struct given *given)                                                                               \
    {                                                                                                                  \
        return fit_with(n, RESTITUTE_FIT_MODEL_##model, RESTITUTE_FIT_LOSS_##loss, given);                             \
    }
FIT(elastic, N, ELASTIC, SQUARES)
FIT(damped, N, KELVIN_VOIGT, HUBER)
FIT(plain, 2, KELVIN_VOIGT, SQUARES)

static int curve(struct given *given)
{
    static const double f[] = {0.01, 0.1, 1, 10, 100}, storage[] = {1e5, 2e5, 5e5, 1e6, 1.2e6},
                        loss[] = {5e4, 1e5, 2e5, 2e5, 1e5};
    PREPARED(dma_result, r);
    restitute_error error;
    int status;
    r.rms = 77;
    ARMED(status, restitute_dma_fit(5, f, storage, loss, NULL, NULL, &r, &error));
    CHECK(status >= 0 || r.rms == 77, "touched");
    if (status < 0) return status;
    for (size_t k = 0; k < r.terms; k++)
        give(given, r.relaxation_time[k]), give(given, r.modulus[k]);
    give(given, r.rms);
    restitute_material_destroy(r.material);
    return status;
}

static void every_call(void **state)
{
    (void)state;
    allocator.ours_alone = 1;
    FAIL_EACH({"elastic", .call = elastic, .stride = 6}, {"damped", .call = damped, .stride = 3},
              {"curve", .call = curve, .stride = 6});
    allocator.ours_alone = 0;
}

/* The first 30 make the workspaces of the first fit, later ones would be those of a step. */
static void every_call_of_gsl(void **state)
{
    (void)state;
    allocator.others_alone = allocator.others_lose = 1;
    FAIL_EACH({"plain", .call = plain, .stride = 30}, {"curve", .call = curve, .stride = 30});
    allocator.others_alone = allocator.others_lose = 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_call), cmocka_unit_test(every_call_of_gsl)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, NULL));
}
