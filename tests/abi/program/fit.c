/* The calls of fit.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/fit.h>

#include "caller.h"

enum { POINTS = 3, ROWS = 12 };

/* What the solid of `ball` is measured to do. */
static void measure(restitute_fit_point *points, restitute_scene *scenes)
{
    restitute_material *material = rubber();
    MANY(result, results, POINTS);
    for (int i = 0; i < POINTS; i++) {
        ball(&scenes[i], material);
        scenes[i].normal_speed = 0.05 * pow(4, i), scenes[i].tangential_speed = 0;
    }
    DONE(restitute_solve_scene_many(POINTS, scenes, NULL, results, NULL, &error));
    for (int i = 0; i < POINTS; i++) {
        scenes[i].material = NULL; /* of the partner */
        points[i].scene = &scenes[i], points[i].ez = results[i].ez, points[i].contact_time = results[i].contact_time;
    }
    restitute_material_destroy(material);
}

static void impacts(void)
{
    const double known[] = {1e6, NAN, NAN};
    double part = 0, ez[POINTS];
    restitute_fitter *fitter;
    MANY(scene, scenes, POINTS);
    MANY(fit_point, points, POINTS);
    ONE(fit_options, options);
    ONE(fit_result, result);
    measure(points, scenes);
    options->known = known, options->starts = 1;
    DONE(restitute_fit(POINTS, points, options, result, &error));
    SHOW((double)result->constants, (double)result->values, (double)result->rank, result->rms < 1e-2);
    TEXT(result->name[1]);
    printf("    %.2g %.2g\n", result->value[1], result->value[2]); /* within the error of the measured values */
    restitute_material_destroy(result->material);
    DONE(restitute_fitter_create(POINTS, points, options, &fitter, &error));
    while (part < 1 && restitute_fitter_run(fitter, &part, &error) == RESTITUTE_OK)
        continue;
    DONE(restitute_fitter_result(fitter, result, &error));
    DONE(restitute_fitter_values(fitter, ez, NULL, NULL, &error));
    printf("    %.2g %.2g\n", result->value[1], ez[1]);
    restitute_material_destroy(result->material);
    restitute_fitter_destroy(fitter);
}

/* Storage and loss moduli of the standard solid 1e6 Pa, 2e6 Pa, 25e-6 s. */
static void spectrum(void)
{
    double frequency[ROWS], storage[ROWS], loss[ROWS];
    ONE(dma_options, options);
    ONE(dma_result, result);
    for (int i = 0; i < ROWS; i++) {
        const double x = 0.02 * pow(2, i);
        frequency[i] = x / (2 * acos(-1) * 25e-6);
        storage[i] = 1e6 + 2e6 * x * x / (1 + x * x), loss[i] = 2e6 * x / (1 + x * x);
    }
    DONE(restitute_dma_fit(ROWS, frequency, storage, loss, NULL, options, result, &error));
    SHOW((double)result->terms, (double)result->temperatures, result->rms < 1e-2);
    printf("    %.2g %.2g\n", result->equilibrium_modulus, restitute_material_modulus(result->material, 25e-6));
    restitute_material_destroy(result->material);
}

void call_fit(void)
{
    impacts();
    spectrum();
}
