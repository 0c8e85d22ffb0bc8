/* Numbers that measure the assumptions of the model (3), (4), docs/theory.md, section 11.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "solver/validity.h"

#include <math.h>

#include "base/material.h"
#include "base/window.h"

const char *restitute_flag_text(int flag)
{
    switch (flag) {
#define TEXT_OF(name, bit, text)                                                                                       \
    case RESTITUTE_FLAG_##name:                                                                                        \
        return text;
        RESTITUTE_FLAG_LIST(TEXT_OF)
#undef TEXT_OF
    default:
        return "unknown flag";
    }
}

/* Normal speed over the speed of shear waves in the deformable body, with the modulus at the time
 * scale of the impact. For a mere dashpot this modulus is 0 and waves do not travel: the ratio is
 * infinite. */
static double speed_ratio(const restitute_scene *scene, const restitute_numbers *numbers)
{
    const double none = 1e-100; /* Pa; what fades has no end before it underflows */
    double modulus = restitute_material_modulus(scene->material, numbers->time);
    return modulus > none ? scene->normal_speed / sqrt(modulus / numbers->density) : INFINITY;
}

void rst_judge_validity(const restitute_options *options, const restitute_scene *scene,
                        const restitute_numbers *numbers, const struct rst_outcome *outcome, restitute_result *result)
{
    result->speed_ratio = result->radius_ratio = result->displacement_ratio = NAN;
    result->dundurs_beta = 0;
    result->flags = 0;
    if (!scene) return;
    double depth = outcome->max_indentation * numbers->length_z;
    double radius = outcome->max_contact_radius * numbers->length_x, shortest, longest;
    result->speed_ratio = speed_ratio(scene, numbers);
    result->radius_ratio = radius / numbers->radius;
    result->displacement_ratio = fabs(rst_sliding_speed(scene)) * (depth / scene->normal_speed) / radius;
    result->dundurs_beta = numbers->dundurs_beta;
    if (!(result->speed_ratio <= options->speed_limit)) result->flags |= RESTITUTE_FLAG_FAST;
    if (!(result->radius_ratio <= options->radius_limit)) result->flags |= RESTITUTE_FLAG_LARGE_CONTACT;
    if (!(result->displacement_ratio <= options->displacement_limit)) result->flags |= RESTITUTE_FLAG_LONG_SLIDE;
    if (scene->friction > 0 && !(fabs(result->dundurs_beta) <= options->dundurs_limit))
        result->flags |= RESTITUTE_FLAG_COUPLED; /* without shear nothing is coupled */
    restitute_material_window(scene->material, &shortest, &longest, NULL);
    if (!(result->contact_time >= shortest && result->contact_time <= longest))
        result->flags |= RESTITUTE_FLAG_UNMEASURED;
}

/* What a large contact costs, in words, if the sphere is what deforms: the bounds of
 * docs/soft_contacts.md, from the target that its last section names. */
static void name_cost(const restitute_scene *scene, double ratio, char *text, size_t size)
{
    const double most = 0.5, of_sphere = 1, ez = 0.18 * ratio, ex = 1.3 * pow(ratio, 0.65);
    const int elastic = scene->material->n_terms == 0 && scene->material->eta <= 0; /* e_z = 1 */
    text[0] = '\0';
    if (ratio > of_sphere)
        rst_print(text, size, " (more than the sphere: are moduli in Pa, lengths in m, speeds in m/s?)");
    else if (ratio > most)
        rst_print(text, size, " (beyond %g no bound of the error is known)", most);
    else if (elastic && scene->friction > 0)
        rst_print(text, size, " (ex is known to about +-%.1g if it sticks)", ex);
    else if (scene->friction > 0)
        rst_print(text, size, " (ez is known to about +-%.1g, ex to +-%.1g if it sticks)", ez, ex);
    else if (!elastic)
        rst_print(text, size, " (ez is known to about +-%.1g)", ez);
}

void rst_name_limits(const restitute_options *options, const restitute_scene *scene, const restitute_result *result,
                     restitute_error *error)
{
    char text[64];
    const struct {
        const char *name;
        double value, limit;
        int flag;
    } limits[] = {
        {"v_z0/wave speed", result->speed_ratio, options->speed_limit, RESTITUTE_FLAG_FAST},
        {"contact radius/R", result->radius_ratio, options->radius_limit, RESTITUTE_FLAG_LARGE_CONTACT},
        {"slide/contact radius", result->displacement_ratio, options->displacement_limit, RESTITUTE_FLAG_LONG_SLIDE},
        {"|Dundurs' beta|", fabs(result->dundurs_beta), options->dundurs_limit, RESTITUTE_FLAG_COUPLED}};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        if (!(result->flags & limits[i].flag)) continue;
        char cost[96] = "";
        if (limits[i].flag == RESTITUTE_FLAG_LARGE_CONTACT) name_cost(scene, limits[i].value, cost, sizeof cost);
        rst_remark(error, "%s = %.3g exceeds the limit %g%s", limits[i].name, limits[i].value, limits[i].limit, cost);
    }
    if (!(result->flags & RESTITUTE_FLAG_UNMEASURED)) return;
    rst_print(text, sizeof text, "contact time %.3g s is outside", result->contact_time);
    rst_remark_window(text, scene->material, error);
}
