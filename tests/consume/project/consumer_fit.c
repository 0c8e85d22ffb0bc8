/* A user's program that fits a modulus to contact times of an elastic ball. Exit status 0 if it
 * finds it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/fit.h>

int main(void)
{
    static const double times[] = {3e-3, 2.611652e-3, 2.408224e-3, 2.273575e-3}; /* they fall with speed^(-1/5) */
    restitute_scene scenes[4];
    restitute_fit_point points[4];
    restitute_fit_options options;
    restitute_fit_result result;
    restitute_error error;
    restitute_fit_options_init(&options);
    restitute_fit_result_init(&result);
    options.model = RESTITUTE_FIT_MODEL_ELASTIC;
    for (int i = 0; i < 4; i++) {
        restitute_scene_init(&scenes[i]);
        restitute_fit_point_init(&points[i]);
        restitute_scene_init(&scenes[i]);
        scenes[i].radius1 = 0.005, scenes[i].mass1 = 0.004, scenes[i].normal_speed = 0.1 * (i + 1);
        points[i].scene = &scenes[i], points[i].contact_time = times[i];
    }
    if (restitute_fit(4, points, &options, &result, &error) < 0) {
        puts(error.message);
        return 1;
    }
    printf("%s = %g in [%g, %g]\n", result.name[0], result.value[0], result.low[0], result.high[0]);
    restitute_material_destroy(result.material);
    return !(result.value[0] > 0 && result.high[0] < 1.01 * result.low[0]);
}
