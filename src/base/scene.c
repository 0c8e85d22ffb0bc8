/* From spheres in SI units to the dimensionless problem (22)-(24), docs/theory.md, sections 2 and
 * 10.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stddef.h>

#include "base/material.h"
#include "base/problem.h"
#include "base/sized.h"
#include "base/status.h"

RST_DEFAULTS(scene, .deformable = RESTITUTE_ONE_BODY_DEFORMS, .radius2 = INFINITY, .mass2 = INFINITY)
RST_DEFAULTS(numbers, 0)

static int check_bodies(const restitute_scene *s, restitute_error *error)
{
    int status = rst_check_within(s->radius1, rst_sizes, NAN, "radius1 (m)", error);
    if (!status) status = rst_check_within(s->mass1, rst_sizes, NAN, "mass1 (kg)", error);
    if (!status) status = rst_check_within(s->radius2, rst_sizes, INFINITY, "radius2 (m)", error);
    if (!status) status = rst_check_within(s->mass2, rst_sizes, INFINITY, "mass2 (kg)", error);
    if (!status) status = rst_check_within(s->inertia1, rst_inertias, 0, "inertia1 (kg m^2)", error);
    if (!status) status = rst_check_within(s->inertia2, rst_inertias, 0, "inertia2 (kg m^2)", error);
    if (status) return status;
    if (isinf(s->radius2) && s->spin2 != 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "spin2 = %.17g rad/s: must be 0 with radius2 = inf (a wall)",
                          s->spin2);
    if (isinf(s->radius2) && s->inertia2 != 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "inertia2 = %.17g kg m^2: must be left at 0 with radius2 = inf (a wall)", s->inertia2);
    return RESTITUTE_OK;
}

static int check_scene(const restitute_scene *s, restitute_error *error)
{
    if (!s->material) return rst_report(error, RESTITUTE_ERROR_NULL, "scene.material is NULL");
    if (s->deformable != RESTITUTE_ONE_BODY_DEFORMS && s->deformable != RESTITUTE_BOTH_BODIES_DEFORM)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "deformable = %d: must be 1 (one body deforms) or 2 (both deform)", s->deformable);
    if (s->deformable == RESTITUTE_BOTH_BODIES_DEFORM && s->material->is_effective)
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "deformable = 2: must be 1 with a material from restitute_material_effective, which is the solid of both");
    int status = check_bodies(s, error);
    if (!status && s->friction != 0 && !(s->friction >= rst_least_friction))
        status = rst_report(error, RESTITUTE_ERROR_DOMAIN, "friction = %.17g: must be 0 or >= %g (inf: no slip)",
                            s->friction, rst_least_friction);
    if (!status) status = rst_check_within(s->normal_speed, rst_sizes, NAN, "normal_speed (m/s)", error);
    if (!status) status = rst_check_within(s->tangential_speed, rst_speeds, NAN, "tangential_speed (m/s)", error);
    if (!status) status = rst_check_within(s->wave_density, rst_densities, 0, "wave_density (kg/m^3)", error);
    if (!status) status = rst_check_within(s->spin1, rst_spins, NAN, "spin1 (rad/s)", error);
    if (!status) status = rst_check_within(s->spin2, rst_spins, NAN, "spin2 (rad/s)", error);
    if (!status)
        status = rst_check_within(rst_sliding_speed(s), rst_speeds, NAN,
                                  "tangential_speed + radius1 spin1 + radius2 spin2 (m/s)", error);
    return status;
}

/* 1/m + R^2/J of one body, its share of the contact point's tangential mobility. */
static double tangential_mobility(double mass, double radius, double inertia, int blocked)
{
    if (isinf(mass)) return 0;
    if (blocked || isinf(radius)) return 1 / mass;
    if (inertia == 0) return 3.5 / mass; /* solid sphere: m R^2/J = 5/2 */
    return 1 / mass + radius * radius / inertia;
}

/* Moduli of the pair: two bodies of one material are two equal springs in series. */
static double pair_factor(const restitute_scene *s)
{
    return s->deformable == RESTITUTE_BOTH_BODIES_DEFORM ? 0.5 : 1.0;
}

static double reference_modulus(const restitute_scene *s, double m, double r)
{
    const restitute_material *material = s->material;
    double sum = material->g_inf;
    if (sum <= 0)
        for (size_t k = 0; k < material->n_terms; k++)
            sum += material->g[k];
    if (sum > 0) return pair_factor(s) * sum;
    return rst_damping_modulus(m, r, s->normal_speed, pair_factor(s) * material->eta, material->nu);
}

/* delta1, gamma, delta2 where the solid has them. */
static void standard_numbers(const restitute_material *material, double factor, restitute_numbers *n)
{
    n->delta1 = n->gamma = n->delta2 = NAN;
    if (material->g_inf <= 0 || material->n_terms > 1 || (material->n_terms == 1 && material->eta > 0)) return;
    double eta = material->n_terms ? material->g[0] * material->tau[0] : material->eta;
    n->delta1 = factor * eta / (n->modulus * n->time) / rst_theta_from_delta1(1);
    n->gamma = material->n_terms ? material->g_inf / material->g[0] : eta > 0 ? 0 : INFINITY;
    n->delta2 = n->delta1 > 0 ? n->delta1 * sqrt(n->gamma) : 0;
}

/* The denser body has the slower waves. The density of a wall or of a fixed body is unknown. */
static double wave_density(const restitute_scene *s)
{
    const double unit_sphere = 4.0 / 3 * 3.14159265358979323846, r1 = s->radius1, r2 = s->radius2;
    const double first = isinf(s->mass1) ? 0 : s->mass1 / (unit_sphere * r1 * r1 * r1);
    if (s->wave_density > 0) return s->wave_density;
    return isinf(s->mass2) || isinf(r2) ? first : fmax(first, s->mass2 / (unit_sphere * r2 * r2 * r2));
}

/* Of both bodies, the deformable one first. A rigid partner has 1/G = 0. */
static double dundurs_beta(const restitute_scene *s)
{
    const int alone = s->deformable == RESTITUTE_ONE_BODY_DEFORMS && !s->material->is_effective;
    return alone ? (1 - 2 * s->material->nu) / (2 - 2 * s->material->nu) : s->material->beta;
}

double rst_sliding_speed(const restitute_scene *scene)
{
    double second = isinf(scene->radius2) ? 0 : scene->radius2 * scene->spin2;
    return scene->tangential_speed + scene->radius1 * scene->spin1 + second;
}

static int numbers_of(const restitute_scene *s, restitute_numbers *n, restitute_error *error)
{
    double nu = s->material->nu;
    n->radius = isinf(s->radius2) ? s->radius1 : 1 / (1 / s->radius1 + 1 / s->radius2);
    n->mass = isinf(s->mass2) ? s->mass1 : 1 / (1 / s->mass1 + 1 / s->mass2);
    n->modulus = reference_modulus(s, n->mass, n->radius);
    n->length_x = rst_elastic_contact_radius(n->mass, n->radius, s->normal_speed, n->modulus, nu);
    n->length_z = n->length_x * (n->length_x / n->radius);
    n->time = n->length_z / s->normal_speed;
    n->force = n->mass * s->normal_speed / n->time;
    n->chi = rst_tangential_mass_ratio(n->mass,
                                       tangential_mobility(s->mass1, s->radius1, s->inertia1, s->rotation_blocked) +
                                           tangential_mobility(s->mass2, s->radius2, s->inertia2, s->rotation_blocked),
                                       nu);
    double sliding = rst_sliding_speed(s);
    n->psi = s->friction <= 0 ? INFINITY : rst_sliding_ratio(sliding, s->friction, s->normal_speed, nu);
    standard_numbers(s->material, pair_factor(s), n);
    n->density = wave_density(s);
    n->dundurs_beta = dundurs_beta(s);
    if (n->chi > rst_largest_chi && s->friction > 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %g: must be <= %g; check inertia", n->chi,
                          rst_largest_chi);
    return RESTITUTE_OK;
}

int restitute_scene_numbers(const restitute_scene *scene, restitute_numbers *numbers, restitute_error *error)
{
    restitute_scene s;
    restitute_numbers n;
    if (!scene || !numbers) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", scene ? "numbers" : "scene");
    int status = RST_TAKE(scene, &s, scene, error);
    if (!status) status = RST_CHECK(numbers, numbers, error);
    if (status) return status;
    restitute_numbers_init(&n);
    status = check_scene(&s, error);
    if (!status) status = numbers_of(&s, &n, error);
    if (status) return status;
    RST_GIVE(&n, numbers);
    return rst_done(error);
}

int rst_problem_from_scene(const restitute_scene *scene, restitute_numbers *numbers, struct rst_problem *problem,
                           restitute_error *error)
{
    int status = check_scene(scene, error);
    if (!status) status = numbers_of(scene, numbers, error);
    if (status) return status;

    rst_solid_of(scene->material, pair_factor(scene) / numbers->modulus, numbers->time, &problem->solid);
    problem->chi = fmin(numbers->chi, rst_largest_chi); /* without friction any value will do */
    rst_set_sliding(numbers->psi, problem);
    problem->time_unit = numbers->time;
    problem->unit_name = "s";
    return rst_check_damping(&problem->solid, error);
}
