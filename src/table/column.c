/* Columns by restitute_solve_scene: a solver keeps the normal motion of the impact before, which a column shares.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "column.h"

/* Some hundred levels: an impact that hardly rebounds would take a hundred times the usual work, and says by its
 * estimated error that it was not finished. */
static const int64_t most_updates = 1000000;

static int unit_numbers(const restitute_scene *scene, restitute_scene *unit, restitute_numbers *numbers,
                        restitute_error *error)
{
    *unit = *scene;
    unit->normal_speed = unit->tangential_speed = unit->friction = 1;
    unit->spin1 = unit->spin2 = 0;
    restitute_numbers_init(numbers);
    return restitute_scene_numbers(unit, numbers, error);
}

/* A spring alone, or a dashpot alone, gives the same pair at any speed. */
static int without_time(const restitute_material *material)
{
    double g_inf, eta;
    restitute_material_series(material, &g_inf, &eta, NULL, NULL);
    return restitute_material_terms(material) == 0 && (g_inf <= 0 || eta <= 0);
}

int rst_contact_set(const restitute_scene *scene, struct rst_contact *contact, restitute_error *error)
{
    restitute_scene plain = *scene;
    if (scene->struct_size == sizeof *scene) {
        plain.normal_speed = 1;
        plain.tangential_speed = plain.spin1 = plain.spin2 = 0;
    }
    restitute_numbers_init(&contact->numbers);
    int status = restitute_scene_numbers(&plain, &contact->numbers, error); /* refuses what is wrong with it */
    if (!status) status = unit_numbers(&plain, &contact->scene, &contact->numbers, error);
    if (status) return status;
    contact->friction = scene->friction;
    contact->sliding = scene->friction <= 0      ? RST_NO_FRICTION
                       : isinf(scene->friction) ? RST_NEVER_SLIPS
                                                : RST_SLIDES;
    if (contact->sliding != RST_SLIDES) contact->scene.friction = scene->friction;
    contact->timeless = without_time(scene->material);
    return RESTITUTE_OK;
}

int rst_column_solver_create(const struct rst_contact *contact, double tolerance, struct rst_column_solver *s,
                             restitute_error *error)
{
    restitute_options options;
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    options.tolerance = fmax(1e-8, tolerance);
    options.max_updates = most_updates;
    s->contact = contact;
    s->tolerance = options.tolerance;
    s->levels = 0;
    return restitute_solver_create(&options, &s->solver, error);
}

void rst_column_solver_destroy(struct rst_column_solver *s)
{
    restitute_solver_destroy(s->solver);
    s->solver = NULL;
}

/* An impact that the solver gives up is solved to larger tolerances; its estimated error says what it is worth. */
static int solve_looser(const struct rst_column_solver *s, const restitute_scene *scene, restitute_result *result,
                        restitute_error *error)
{
    static const double looser = 4, loosest = 0.02;
    restitute_options options;
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    options.max_updates = most_updates;
    options.tolerance = s->tolerance;
    int status = RESTITUTE_ERROR_TOO_MUCH_WORK;
    while (status == RESTITUTE_ERROR_TOO_MUCH_WORK && options.tolerance * looser <= loosest) {
        options.tolerance *= looser;
        status = restitute_solve_scenes(&options, 1, scene, result, NULL, 1, error);
    }
    return status;
}

static int solve(struct rst_column_solver *s, double speed, double psi, restitute_result *result,
                 restitute_error *error)
{
    static const double beside = 1e-6;
    const struct rst_contact *c = s->contact;
    restitute_scene scene = c->scene;
    restitute_error why = {.message = ""};
    scene.normal_speed = speed;
    scene.tangential_speed = c->sliding == RST_SLIDES ? psi * speed / c->numbers.psi : 0;
    restitute_result_init(result);
    int status = restitute_solve_scene(s->solver, &scene, result, NULL, NULL, &why);
    if (status == RESTITUTE_ERROR_TOO_MUCH_WORK && psi > 0) {
        /* slip that would end just where D' = 0, psi = 2 chi (THEORY 4.3): a millionth beside */
        scene.tangential_speed *= 1 + beside;
        status = restitute_solve_scene(s->solver, &scene, result, NULL, NULL, &why);
        if (status >= 0) result->error_ex += 2 * beside;
    }
    if (status == RESTITUTE_ERROR_TOO_MUCH_WORK) status = solve_looser(s, &scene, result, &why);
    if (status >= 0 && result->elements > s->levels) s->levels = result->elements;
    if (status >= 0) return status;
    if (status == RESTITUTE_ERROR_TOO_MUCH_WORK)
        return rst_report(error, status,
                          "speed (m/s) = %g, psi = %g: too much work, or a rebound that is lost in rounding: the damping "
                          "is too strong for a table; lower the upper end of speed",
                          speed, psi);
    return rst_report(error, status, "speed (m/s) = %g, psi = %g: %.160s", speed, psi, why.message);
}

int rst_column_solve(struct rst_column_solver *s, double speed, struct rst_column_normal *normal, int64_t n,
                     const double *psi, double *ex, double *error_ex, restitute_error *error)
{
    restitute_result r;
    int status = normal ? solve(s, speed, 0, &r, error) : RESTITUTE_OK;
    if (status < 0) return status;
    if (normal)
        *normal = (struct rst_column_normal){
            r.ez,
            r.error_ez,
            {r.speed_ratio, r.radius_ratio, r.max_indentation / r.max_contact_radius},
            status == RESTITUTE_NO_REBOUND};
    for (int64_t i = 0; i < n; i++) {
        status = solve(s, speed, psi[i], &r, error);
        if (status < 0) return status;
        ex[i] = r.ex;
        error_ex[i] = r.error_ex;
    }
    return RESTITUTE_OK;
}
