/* Numbers that measure the assumptions of the model (3), (4), docs/theory.md, section 11.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "solver/validity.h"

#include <math.h>

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

static double sphere_density(double mass, double radius)
{
    return mass / (4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius);
}

/* The denser body has the slower waves. The density of a wall or of a fixed body is unknown. */
static double denser_sphere(const restitute_scene *scene)
{
    double first = isinf(scene->mass1) ? 0 : sphere_density(scene->mass1, scene->radius1);
    return isinf(scene->mass2) || isinf(scene->radius2) ? first
                                                        : fmax(first, sphere_density(scene->mass2, scene->radius2));
}

/* Normal speed over the speed of shear waves in the deformable body, with the modulus at the time
 * scale of the impact. For a mere dashpot this modulus is 0 and waves do not travel: the ratio is
 * infinite. */
static double speed_ratio(const restitute_scene *scene, double time)
{
    const double none = 1e-100; /* Pa; what fades has no end before it underflows */
    double density = scene->wave_density > 0 ? scene->wave_density : denser_sphere(scene);
    double modulus = restitute_material_modulus(scene->material, time);
    return modulus > none ? scene->normal_speed / sqrt(modulus / density) : INFINITY;
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
    result->speed_ratio = speed_ratio(scene, numbers->time);
    result->radius_ratio = radius / numbers->radius;
    result->displacement_ratio = fabs(rst_sliding_speed(scene)) * (depth / scene->normal_speed) / radius;
    result->dundurs_beta = restitute_material_dundurs(scene->material);
    if (!(result->speed_ratio <= options->speed_limit)) result->flags |= RESTITUTE_FLAG_FAST;
    if (!(result->radius_ratio <= options->radius_limit)) result->flags |= RESTITUTE_FLAG_LARGE_CONTACT;
    if (!(result->displacement_ratio <= options->displacement_limit)) result->flags |= RESTITUTE_FLAG_LONG_SLIDE;
    if (!(fabs(result->dundurs_beta) <= options->dundurs_limit)) result->flags |= RESTITUTE_FLAG_COUPLED;
    restitute_material_window(scene->material, &shortest, &longest, NULL);
    if (!(result->contact_time >= shortest && result->contact_time <= longest))
        result->flags |= RESTITUTE_FLAG_UNMEASURED;
}

/* Error of e_z over a_max/R if the sphere is what deforms: docs/soft_contacts.md, from the target
 * that its last section names. */
static const double soft_contact_error = 0.18;

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
        char cost[40] = "";
        if (limits[i].flag == RESTITUTE_FLAG_LARGE_CONTACT)
            rst_print(cost, sizeof cost, " (ez is known to about +-%.1g)",
                      fmin(soft_contact_error * limits[i].value, 1));
        rst_remark(error, "%s = %.3g exceeds the limit %g%s", limits[i].name, limits[i].value, limits[i].limit, cost);
    }
    if (!(result->flags & RESTITUTE_FLAG_UNMEASURED)) return;
    rst_print(text, sizeof text, "contact time %.3g s is outside", result->contact_time);
    rst_remark_window(text, scene->material, error);
}
