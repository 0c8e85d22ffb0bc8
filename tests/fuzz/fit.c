/* Fits to any measurements: drops, and moduli over frequency.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/fit.h>

#include "fuzz.h"

enum { most_points = 4, most_rows = 12, most_batches = 20 };

static int enough(void *asked)
{
    return ++*(int *)asked > most_batches;
}

static void check_text(const char *text, size_t size)
{
    REQUIRE(memchr(text, 0, size), "a text has no end");
}

static void impacts(struct bytes *b)
{
    restitute_fit_point point[most_points];
    restitute_fit_options o;
    restitute_fit_result result;
    restitute_scene scene;
    double tau[20], known[21];
    int asked = 0;
    restitute_scene_init(&scene);
    restitute_fit_options_init(&o);
    restitute_fit_result_init(&result);
    scene.radius1 = number(b, 1e-4, 0.1);
    scene.mass1 = number(b, 1e-6, 1);
    scene.normal_speed = number(b, 1e-3, 10);
    scene.tangential_speed = below(b, 2) ? 0 : number(b, 1e-3, 10);
    scene.friction = below(b, 2) ? 0.3 : NAN;
    const size_t n = (size_t)(1 + below(b, most_points));
    for (size_t i = 0; i < n; i++) {
        restitute_fit_point_init(&point[i]);
        point[i].scene = &scene;
        point[i].ez = number(b, 1e-3, 1);
        if (!below(b, 2)) point[i].ex = signed_number(b, 1e-3, 1);
        if (!below(b, 2)) point[i].contact_time = number(b, 1e-6, 1);
        if (!below(b, 4)) point[i].sigma_ez = number(b, 1e-6, 1);
        if (!below(b, 4)) point[i].temperature = number(b, 1, 300);
    }
    o.model = below(b, 8) ? 1 + below(b, 5) : (int)take(b, 4);
    o.terms = (size_t)below(b, 21);
    for (int i = 0; i < 21; i++) {
        if (i < 20 && i < (int)o.terms) tau[i] = number(b, 1e-6, 1e3);
        known[i] = i < 3 && !below(b, 2) ? number(b, 1e3, 1e9) : NAN;
    }
    o.relaxation_time = tau;
    o.known = below(b, 2) ? known : NULL;
    o.loss = below(b, 4);
    o.starts = 1;
    o.interrupted = enough;
    o.interrupted_data = &asked;
    restitute_fit_options *given = sized(b, &o);
    const int status = CALL_FLAGS(restitute_fit, n, point, given, &result);
    REQUIRE((status < 0) == !result.material, "status %d", status);
    if (status >= 0) {
        check_text(result.remarks, sizeof result.remarks);
        REQUIRE(result.constants >= 1 && result.constants <= RESTITUTE_FIT_CONSTANTS, "%zu", result.constants);
        for (size_t i = 0; i < result.constants; i++) {
            check_text(result.name[i], sizeof result.name[i]);
            REQUIRE(isfinite(result.value[i]) && result.low[i] <= result.value[i] && result.value[i] <= result.high[i],
                    "%s: %g in [%g, %g]", result.name[i], result.value[i], result.low[i], result.high[i]);
        }
    }
    restitute_material_destroy(result.material);
    free(given);
}

static void dma(struct bytes *b)
{
    double frequency[most_rows], storage[most_rows], loss[most_rows], temperature[most_rows];
    restitute_dma_options o;
    restitute_dma_result result;
    restitute_dma_options_init(&o);
    restitute_dma_result_init(&result);
    o.tension = below(b, 2);
    if (below(b, 2)) o.noise = number(b, 1e-4, 0.5);
    if (!below(b, 4)) o.poisson_ratio = number(b, 1e-3, 0.5);
    const size_t n = (size_t)below(b, most_rows + 1);
    const int warm = below(b, 4);
    for (size_t i = 0; i < n; i++) {
        frequency[i] = number(b, 1e-3, 1e3);
        storage[i] = number(b, 1e5, 1e9);
        loss[i] = number(b, 1e5, 1e9);
        temperature[i] = 10 * below(b, 3);
        if (warm == 1 && !below(b, 8)) temperature[i] = signed_number(b, 1, 300);
    }
    restitute_dma_options *given = sized(b, &o);
    const int status =
        CALL_FLAGS(restitute_dma_fit, n, frequency, storage, loss, warm < 2 ? temperature : NULL, given, &result);
    REQUIRE((status < 0) == !result.material, "status %d", status);
    if (status >= 0) {
        check_text(result.remarks, sizeof result.remarks);
        REQUIRE(result.terms <= RESTITUTE_DMA_TERMS && result.rms >= 0, "%zu terms, rms %g", result.terms, result.rms);
        for (size_t k = 0; k < result.terms; k++)
            REQUIRE(result.modulus[k] > 0 && isfinite(result.modulus[k]) && result.relaxation_time[k] > 0, "term %zu",
                    k);
    }
    restitute_material_destroy(result.material);
    free(given);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, size};
    const clock_t begin = clock();
    below(&b, 2) ? dma(&b) : impacts(&b);
    REQUIRE(clock() - begin < 20 * CLOCKS_PER_SEC, "too slow");
    return 0;
}
